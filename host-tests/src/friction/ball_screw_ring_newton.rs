//! Newton's step of balls that press on each other: all of a row of touching balls at once.
//!
//! What two neighbours do to each other depends on three numbers, the force along the track and the two components of their slip: a row of `m`
//! balls has `3 (m - 1)` unknowns.

use nalgebra::{DMatrix, DVector, SMatrix, SVector};

use super::ball_screw_placed::{BallState, Drive, PlacedBall, Rubbing};
use super::ball_screw_rubbing::BallContactSlope;
use super::ball_screw_settle::{least_motion, unit};
use super::ball_screw_tangent::Tangent;

/// Longest step of a motion over the nut's speed, and of a place over its unit.
const LONGEST_TURN: f64 = 0.5;
const LONGEST_WAY: f64 = 2.0;

/// Change of a ball's force with its speed over the nut's speed where it carries no load, N: it goes along with its neighbours.
pub(crate) const UNLOADED: f64 = 1e-6;

/// A ball under load, on its way to its balance.
#[derive(Clone, Copy)]
pub(crate) struct Moving<'a> {
    pub ball: PlacedBall<'a>,
    pub state: BallState,
    unit: f64,
    tangent: Tangent,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Target {
    /// Change of place over its unit, and of the motion.
    pub change: SVector<f64, 7>,
    pub speed: f64,
    /// Of the neighbours, in the direction of orbiting, N.
    pub force: f64,
    pub rubbing: Rubbing,
}

impl<'a> Moving<'a> {
    pub fn new(ball: &PlacedBall<'a>, state: BallState) -> Option<Self> {
        let unit = unit(ball);
        let tangent = ball.tangent(&state, unit)?;
        Some(Self {
            ball: *ball,
            state,
            unit,
            tangent,
        })
    }

    /// Largest unbalanced force over the sum of the loads.
    pub fn residual(&self) -> f64 {
        self.tangent.balance.amax() / self.tangent.loads
    }

    /// What neighbours do to the ball: the balance holds it as given.
    pub fn push(&mut self, force: f64, rubbing: Rubbing) {
        self.tangent.balance -= self.ball.given(&self.state);
        self.ball.rubbing = rubbing;
        self.state.force = force;
        self.tangent.balance += self.ball.given(&self.state);
    }

    /// Changes of place and motion that balance what is unbalanced, and that answer given forces.
    pub fn answers<const N: usize>(
        &self,
        forces: &SMatrix<f64, 7, N>,
    ) -> Option<(SVector<f64, 7>, SMatrix<f64, 7, N>)> {
        let factors = self.tangent.jacobian.lu();
        let missing = -factors.solve(&self.tangent.balance)?;
        let by_force = -factors.solve(forces)?;
        let finite = missing.iter().chain(&by_force).all(|x| x.is_finite());
        finite.then_some((missing, by_force))
    }

    /// Law of speed and force along the track: `(unforced, compliance)`.
    pub fn law(&self) -> Option<(f64, f64)> {
        let push = SVector::<f64, 7>::ith(3, self.ball.path());
        let (missing, by_force) = self.answers(&push)?;
        let compliance = by_force[3];
        let unforced = self.state.motion[0] + missing[3] - compliance * self.state.force;
        (compliance > 0.0).then_some((unforced, compliance))
    }

    pub fn follow(&mut self, target: &Target) {
        let change = &target.change;
        let shift = change.fixed_rows::<3>(0).amax() / LONGEST_WAY;
        let turn = change.fixed_rows::<4>(3).amax() / LONGEST_TURN;
        let longest = shift.max(turn);
        let mut fraction = if longest > 1.0 { 1.0 / longest } else { 1.0 };
        let enough = self.tangent.balance.norm().max(1e-9 * self.tangent.loads);
        for _ in 0..6 {
            let mut there = *self;
            there.state.place += change.fixed_rows::<3>(0) * (self.unit * fraction);
            there.state.motion += change.fixed_rows::<4>(3) * fraction;
            there.state.force += (target.force - self.state.force) * fraction;
            there.ball.rubbing = between(&self.ball.rubbing, &target.rubbing, fraction);
            if fraction == 1.0 {
                there.state.motion[0] = target.speed;
            }
            if there.renewed().is_some() && there.tangent.balance.norm() < enough
                || there.least_motion().is_some() && there.tangent.balance.norm() < enough
            {
                *self = there;
                return;
            }
            fraction *= 0.5;
        }
    }

    fn renewed(&mut self) -> Option<()> {
        self.tangent = self.ball.tangent(&self.state, self.unit)?;
        Some(())
    }

    /// The motion of least power under the present force: where a contact sticks, tangents lead no farther than a 1e-4 of its slip, and this
    /// search, which is convex, does.
    fn least_motion(&mut self) -> Option<()> {
        let rows = self.ball.rows(&self.state.place)?;
        let drive = Drive::Force(self.state.force);
        let (motion, _) = least_motion(&self.ball, drive, &rows, &self.state.motion)?;
        self.state = BallState::new(self.state.place, motion, self.state.force);
        self.renewed()
    }
}

fn between(from: &Rubbing, to: &Rubbing, fraction: f64) -> Rubbing {
    let mix = |a: f64, b: f64| a + (b - a) * fraction;
    Rubbing {
        in_plane: [
            mix(from.in_plane[0], to.in_plane[0]),
            mix(from.in_plane[1], to.in_plane[1]),
        ],
        motion: from.motion + (to.motion - from.motion) * fraction,
    }
}

pub(crate) enum InRow<'a, 'b> {
    Loaded(&'b Moving<'a>),
    Idle {
        /// Over the nut's speed: at present, and without force.
        speed: f64,
        unforced: f64,
        /// At present, N.
        force: f64,
    },
}

pub(crate) struct RowStep {
    /// Changes of place and motion; of a ball that carries no load, of its speed alone.
    pub changes: Vec<SVector<f64, 7>>,
    /// Changes of the forces between a ball and the next.
    pub forces: Vec<f64>,
}

/// How a ball answers: by itself, then to the pair behind it and to the pair ahead.
struct Answer {
    alone: SVector<f64, 7>,
    pairs: SMatrix<f64, 7, 6>,
    present: SVector<f64, 7>,
}

impl Answer {
    fn of(
        ball: &InRow<'_, '_>,
        behind: Option<&BallContactSlope>,
        ahead: Option<&BallContactSlope>,
    ) -> Option<Self> {
        match ball {
            InRow::Loaded(m) => {
                let mut forces = SMatrix::<f64, 7, 6>::zeros();
                if let Some(slope) = behind {
                    forces.fixed_columns_mut::<3>(0).copy_from(&slope.on_front);
                }
                if let Some(slope) = ahead {
                    forces.fixed_columns_mut::<3>(3).copy_from(&slope.on_rear);
                }
                let (alone, pairs) = m.answers(&forces)?;
                let mut present = SVector::<f64, 7>::zeros();
                present.fixed_rows_mut::<4>(3).copy_from(&m.state.motion);
                Some(Self {
                    alone,
                    pairs,
                    present,
                })
            }
            InRow::Idle {
                speed,
                unforced,
                force,
            } => {
                let mut pairs = SMatrix::zeros();
                pairs[(3, 0)] = 1.0 / UNLOADED;
                pairs[(3, 3)] = -1.0 / UNLOADED;
                Some(Self {
                    alone: SVector::ith(3, unforced + force / UNLOADED - speed),
                    pairs,
                    present: SVector::ith(3, *speed),
                })
            }
        }
    }
}

/// Newton's step of balls that press, rear to front; `slopes` of each and the next.
pub(crate) fn row_step(balls: &[InRow<'_, '_>], slopes: &[BallContactSlope]) -> Option<RowStep> {
    let answers = balls
        .iter()
        .enumerate()
        .map(|(at, ball)| {
            let behind = at.checked_sub(1).and_then(|before| slopes.get(before));
            Answer::of(ball, behind, slopes.get(at))
        })
        .collect::<Option<Vec<_>>>()?;
    let mut unknowns = DVector::zeros(3 * slopes.len());
    if !slopes.is_empty() {
        let (matrix, right) = equations(balls, slopes, &answers);
        unknowns = matrix.lu().solve(&right)?;
    }
    let three = |pair: usize| -> SVector<f64, 3> { unknowns.fixed_rows::<3>(3 * pair).into() };
    let changes = answers
        .iter()
        .enumerate()
        .map(|(at, answer)| {
            let mut change = answer.alone;
            if at > 0 {
                change += answer.pairs.fixed_columns::<3>(0) * three(at - 1);
            }
            if at < slopes.len() {
                change += answer.pairs.fixed_columns::<3>(3) * three(at);
            }
            change
        })
        .collect();
    Some(RowStep {
        changes,
        forces: (0..slopes.len()).map(|pair| unknowns[3 * pair]).collect(),
    })
}

/// Three equations for each pair: equal speeds, and changes of its slip that are those of the motions.
fn equations(
    balls: &[InRow<'_, '_>],
    slopes: &[BallContactSlope],
    answers: &[Answer],
) -> (DMatrix<f64>, DVector<f64>) {
    let size = 3 * slopes.len();
    let (mut matrix, mut right) = (DMatrix::zeros(size, size), DVector::zeros(size));
    for (pair, slope) in slopes.iter().enumerate() {
        let at = 3 * pair;
        // Balls that carry no load have no slip that matters.
        let slips = matches!(
            (&balls[pair], &balls[pair + 1]),
            (InRow::Loaded(_), InRow::Loaded(_))
        );
        for k in 1..3 {
            matrix[(at + k, at + k)] = -1.0;
        }
        for (ball, sign, of) in [
            (pair, 1.0, slope.slips[0]),
            (pair + 1, -1.0, slope.slips[1]),
        ] {
            let answer = &answers[ball];
            let mut wanted = SMatrix::<f64, 3, 7>::zeros();
            wanted[(0, 3)] = sign;
            if slips {
                wanted.fixed_view_mut::<2, 4>(1, 3).copy_from(&of);
            }
            let mut rows = right.fixed_rows_mut::<3>(at);
            rows -= wanted * answer.alone;
            right[at] -= sign * answer.present[3];
            let by_pairs = wanted * answer.pairs;
            // The pair behind a ball has its index less one, the pair ahead its own.
            for (other, columns) in [(ball.checked_sub(1), 0), (Some(ball), 3)] {
                if let Some(other) = other
                    && other < slopes.len()
                {
                    let mut block = matrix.fixed_view_mut::<3, 3>(at, 3 * other);
                    block += by_pairs.fixed_columns::<3>(columns);
                }
            }
        }
    }
    (matrix, right)
}
