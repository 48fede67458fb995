//! Finds place and motion of a ball in elastic grooves from nothing: by Newton's method from a guess, along a path of ever sharper friction
//! at rest, or by a search that cannot miss.
//!
//! Two halves of the problem are convex: under given friction forces the ball lies where the elastic energy is least; at a given place it
//! moves so that it loses the least power. What couples them is, above all, the push towards the third contact: the sum of the friction
//! forces across the diagonal that carries the load. The guess takes it as that of a third contact that spins with the ball. The search
//! bisects it: Coulomb's law bounds the push, and the push that the motion answers follows it continuously.

use nalgebra::{SMatrix, Vector3, Vector4};

use super::ball_screw_ball::{ScrewRow, ball_dissipation, rolling};
use super::ball_screw_placed::{BallState, Drive, PlacedBall, Solved, main_direction};
use super::newton::{Local, Minimum, minimise, root_between};
use crate::error::ReferenceError;

pub(crate) fn settle(
    ball: &PlacedBall<'_>,
    drive: Drive,
    hint: Option<&BallState>,
) -> Result<Solved, ReferenceError> {
    let unit = unit(ball);
    let search = Search::new(ball, drive, unit);
    let mut best: Option<Solved> = None;
    let mut sharp = |start: BallState| {
        let Some(solved) = ball.newton(&start, drive, unit) else {
            return false;
        };
        if best.is_none_or(|best| solved.residual < best.residual) {
            best = Some(solved);
        }
        solved.residual <= SHARP * ball.accuracy(&solved.state).1
    };
    let _ = hint.copied().is_some_and(&mut sharp)
        || search.guess().is_some_and(&mut sharp)
        || by_smoothing(ball, drive, unit).is_some_and(&mut sharp)
        || search.bracketed(1e-3).is_some_and(&mut sharp)
        || search.bracketed(1e-10).is_some_and(&mut sharp);
    match best {
        Some(solved) if solved.residual <= ball.accuracy(&solved.state).1 => Ok(solved),
        _ => Err(ReferenceError::unbalanced(
            best.map_or(f64::INFINITY, |best| best.residual),
        )),
    }
}

/// A start for [`settle`] that costs little, for a ball without friction of its neighbours: the same guess as there, its motion to a thousandth
/// of the friction limits only. Where Newton's method does not lead on from it, `settle` begins from nothing.
pub(crate) fn near(ball: &PlacedBall<'_>) -> Option<BallState> {
    let search = Search::new(ball, Drive::Force(0.0), unit(ball));
    let (place, rows) = search.guessed_place()?;
    let total: f64 = rows.iter().map(|row| row.patch.friction_limit).sum();
    let motion = [1e-1, 1e-2, 1e-3, ball.rest_spin].into_iter().fold(
        rolling(&ball.grooves.track),
        |from, rest_spin| {
            minimise(from, 1e-3 * total, |y| {
                ball_dissipation(&rows, y, rest_spin)
            })
            .point
        },
    );
    Some(BallState::new(place, motion, 0.0))
}

/// Share of the accepted residual at which no other start is tried: where the motion is soft, as with two contacts that both slide across, a
/// residual that is just accepted belongs to a motion that is not.
const SHARP: f64 = 0.01;

pub(crate) fn unit(ball: &PlacedBall<'_>) -> f64 {
    let (_, reach) = ball.grooves.two_point_start(ball.axial_load);
    reach.max(ball.grooves.oversize.abs())
}

/// State at the end of a path along which friction at rest becomes ever sharper.
///
/// Where friction of a contact that sticks is smoothed over a large spin, Newton's method leads from the guess. With the spin of smoothing
/// the states change in proportion to it near the end, so that each is extrapolated from the two before.
fn by_smoothing(ball: &PlacedBall<'_>, drive: Drive, unit: f64) -> Option<BallState> {
    let at = |rest_spin: f64, start: &BallState| {
        let smoothed = PlacedBall { rest_spin, ..*ball };
        let solved = smoothed.newton(start, drive, unit)?;
        (solved.residual <= smoothed.accuracy(&solved.state).1).then_some(solved.state)
    };
    let (mut rest_spin, mut here) = WIDE_SMOOTHING.iter().find_map(|&rest_spin| {
        let smoothed = PlacedBall { rest_spin, ..*ball };
        let start = Search::new(&smoothed, drive, unit).guess()?;
        Some((rest_spin, at(rest_spin, &start)?))
    })?;
    let mut before: Option<(f64, BallState)> = None;
    let mut factor = 0.3_f64;
    while rest_spin > ball.rest_spin {
        let next = (rest_spin * factor).max(ball.rest_spin);
        let predicted = before.as_ref().map_or(here, |(from, state)| {
            here.beyond(state, (next - rest_spin) / (rest_spin - from))
        });
        if let Some(there) = at(next, &predicted).or_else(|| at(next, &here)) {
            before = Some((rest_spin, here));
            (rest_spin, here) = (next, there);
            factor = (factor * factor).max(0.1);
        } else {
            factor = factor.sqrt();
            if factor > SHORTEST_STEP {
                return None;
            }
        }
    }
    Some(here)
}

const WIDE_SMOOTHING: [f64; 4] = [0.1, 1.0, 10.0, 100.0];
/// Largest factor of the spin of smoothing from one state to the next.
const SHORTEST_STEP: f64 = 0.99;

struct Search<'a> {
    ball: &'a PlacedBall<'a>,
    drive: Drive,
    unit: f64,
    across: [f64; 2],
}

impl<'a> Search<'a> {
    fn new(ball: &'a PlacedBall<'a>, drive: Drive, unit: f64) -> Self {
        let [nx, nz] = main_direction(ball.grooves, ball.axial_load);
        Self {
            ball,
            drive,
            unit,
            across: [nz, -nx],
        }
    }

    /// Place of least elastic energy under given friction forces (x, z, axial).
    fn place(&self, friction: &Vector3<f64>, start: Option<&Vector3<f64>>) -> Option<Vector3<f64>> {
        let ball = self.ball;
        let load = ball.axial_load;
        let [rub_x, rub_z] = ball.rubbing.in_plane;
        // The screw is pushed by its load and feels the opposite of what it does to the ball.
        let force = Vector3::new(friction.x + rub_x, friction.y + rub_z, load - friction.z);
        let start = start
            .copied()
            .unwrap_or_else(|| ball.grooves.two_point_place(load));
        let scale = load.abs() * self.unit;
        let end = minimise(start / self.unit, 1e-13 * scale, |y| {
            let mut local = ball.grooves.energy(y, self.unit);
            local.value -= force.dot(y) * self.unit;
            local.gradient -= force * self.unit;
            local
        });
        (end.residual <= 1e-6 * scale).then(|| end.point * self.unit)
    }

    fn motion(&self, rows: &[ScrewRow], start: &Vector4<f64>) -> Option<(Vector4<f64>, f64)> {
        least_motion(self.ball, self.drive, rows, start)
    }

    /// Place and motion under a push across, with all other friction forces those of the motion; and the push that the motion answers.
    fn under(&self, push: f64, from: Option<&BallState>) -> Option<(BallState, f64)> {
        let ball = self.ball;
        let [ax, az] = self.across;
        let mut place = from.map(|state| state.place);
        let mut motion = from.map_or_else(|| rolling(&ball.grooves.track), |state| state.motion);
        let mut friction = Vector3::new(ax * push, az * push, 0.0);
        for round in 0..120 {
            let there = self.place(&friction, place.as_ref())?;
            let rows = ball.rows(&there)?;
            let force;
            (motion, force) = self.motion(&rows, &motion)?;
            place = Some(there);
            let found = ball.friction_in_plane(&rows, &motion);
            let answer = found.x * ax + found.y * az;
            let missing = push - answer;
            let next = found + Vector3::new(ax * missing, az * missing, 0.0);
            let change = (next - friction).amax();
            // Where a contact that sticks answers its own load, rounds swing about the end.
            friction = if round < 15 {
                next
            } else {
                (friction + next) * 0.5
            };
            if change <= 1e-9 * ball.friction * ball.axial_load.abs() {
                let state = BallState::new(there, motion, force);
                return Some((state, answer));
            }
        }
        None
    }

    fn guess(&self) -> Option<BallState> {
        let (place, rows) = self.guessed_place()?;
        let (motion, force) = self.motion(&rows, &rolling(&self.ball.grooves.track))?;
        Some(BallState::new(place, motion, force))
    }

    fn guessed_place(&self) -> Option<(Vector3<f64>, Vec<ScrewRow>)> {
        let ball = self.ball;
        let frictionless = self.place(&Vector3::zeros(), None)?;
        let push = 0.35 * self.towards_third() * self.bound(&frictionless);
        let [ax, az] = self.across;
        let place = self.place(
            &Vector3::new(ax * push, az * push, 0.0),
            Some(&frictionless),
        )?;
        let rows = ball.rows(&place)?;
        Some((place, rows))
    }

    /// Sign of the push across: towards SL for SR-NL loads and NL for SL-NR loads where the nut turns forward.
    fn towards_third(&self) -> f64 {
        let third = [self.ball.axial_load.signum(), -1.0];
        let towards = self.across[0] * third[0] + self.across[1] * third[1];
        towards.signum() * self.ball.direction
    }

    /// Friction that all contacts could bear, twice over: more than any push.
    fn bound(&self, frictionless: &Vector3<f64>) -> f64 {
        2.0 * self.ball.friction * self.ball.loads(frictionless).iter().sum::<f64>()
    }

    fn bracketed(&self, tolerance: f64) -> Option<BallState> {
        let frictionless = self.place(&Vector3::zeros(), None)?;
        let bound = self.bound(&frictionless);
        let mut last = None;
        let tolerance = tolerance * bound;
        root_between((-bound, bound), (tolerance, tolerance), |push| {
            let (state, answer) = self
                .under(push, last.as_ref())
                .or_else(|| self.under(push, None))?;
            last = Some(state);
            Some(answer - push)
        })?;
        last
    }
}

/// Least power with friction smoothed over `rest_spin`: directly, or from coarser smoothing.
fn sharpened<const N: usize>(
    start: nalgebra::SVector<f64, N>,
    rest_spin: f64,
    total: f64,
    power: impl Fn(&nalgebra::SVector<f64, N>, f64) -> Local<N>,
) -> Minimum<N> {
    let tolerance = 1e-13 * total;
    let direct = minimise(start, tolerance, |y| power(y, rest_spin));
    if direct.residual <= 1e-9 * total {
        return direct;
    }
    let mut end = direct;
    let mut from = start;
    for coarse in [0.1, 0.01, 1e-3, rest_spin] {
        if coarse >= rest_spin {
            end = minimise(from, tolerance, |y| power(y, coarse));
            from = end.point;
        }
    }
    end
}

pub(crate) fn least_motion(
    ball: &PlacedBall<'_>,
    drive: Drive,
    rows: &[ScrewRow],
    start: &Vector4<f64>,
) -> Option<(Vector4<f64>, f64)> {
    let total: f64 = rows.iter().map(|row| row.patch.friction_limit).sum();
    let mut given = ball.rubbing.motion / ball.friction;
    if let Drive::Force(force) = drive {
        given[0] += ball.path() * force / ball.friction;
    }
    let power = |y: &Vector4<f64>, rest_spin: f64| {
        let mut local = ball_dissipation(rows, y, rest_spin);
        local.value -= given.dot(y);
        local.gradient -= given;
        local
    };
    let (point, residual) = match drive {
        Drive::Force(_) => {
            let end = sharpened(*start, ball.rest_spin, total, power);
            (end.point, end.residual)
        }
        Drive::Speed(speed) => {
            let whole = |y: &Vector3<f64>| Vector4::new(speed, y.x, y.y, y.z);
            let turn = Vector3::new(start.y, start.z, start.w);
            let end = sharpened(turn, ball.rest_spin, total, |y, rest_spin| {
                let all = power(&whole(y), rest_spin);
                Local {
                    value: all.value,
                    gradient: all.gradient.fixed_rows::<3>(1).into(),
                    hessian: SMatrix::from(all.hessian.fixed_view::<3, 3>(1, 1)),
                }
            });
            (whole(&end.point), end.residual)
        }
    };
    let force = match drive {
        Drive::Force(force) => force,
        Drive::Speed(_) => ball.friction * power(&point, ball.rest_spin).gradient[0] / ball.path(),
    };
    (residual <= 1e-7 * total).then_some((point, force))
}
