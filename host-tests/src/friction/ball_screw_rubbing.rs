//! Balls of a row that press and rub on each other, and the checks of what was found.

use nalgebra::{Matrix2, SMatrix, Vector2};

use super::ball_screw_ball::ScrewTrack;
use super::ball_screw_placed::{BallState, PlacedBall, Rubbing, Solved};
use super::ball_screw_press::pressed;
use crate::error::ReferenceError;

/// Largest difference of speeds, over the nut's speed, that is accepted of balls that press.
const UNEQUAL: f64 = 1e-11;
/// Passes in which the friction between balls settles.
const PASSES: usize = 60;

pub(crate) struct Pressing {
    pub balls: Vec<Solved>,
    /// Forces between neighbours, N.
    pub forces: Vec<f64>,
    /// Power lost between balls over `R_B w_N`, N.
    pub ball_loss: f64,
}

pub(crate) fn press_and_rub(
    balls: &mut [PlacedBall<'_>],
    free: &[Solved],
    contact: &BallContact,
) -> Result<Pressing, ReferenceError> {
    let mut found = Pressing {
        balls: free.to_vec(),
        forces: vec![0.0; free.len().saturating_sub(1)],
        ball_loss: 0.0,
    };
    let mut change = f64::INFINITY;
    for _ in 0..PASSES {
        found.balls = pressed(balls, &found.balls)?;
        let mut sum = 0.0;
        change = 0.0;
        for (force, ball) in found.forces.iter_mut().zip(&found.balls) {
            sum -= ball.state.force;
            change = f64::max(change, (sum - *force).abs());
            *force = sum;
        }
        let largest = found.forces.iter().copied().fold(0.0, f64::max);
        if !contact.acts() || change <= 1e-10 * largest {
            return found.checked(balls);
        }
        found.ball_loss = rub(balls, &found, contact);
    }
    Err(ReferenceError::unbalanced(change))
}

impl Pressing {
    /// Complementarity: forces push, no ball overtakes the one in front, those that press are equally fast, and the forces on the row add
    /// up to nothing.
    fn checked(mut self, balls: &[PlacedBall<'_>]) -> Result<Self, ReferenceError> {
        let largest = self.forces.iter().copied().fold(0.0, f64::max);
        let load = balls
            .iter()
            .map(|ball| ball.axial_load.abs())
            .fold(0.0, f64::max);
        let allowed = 1e-7 * largest + 1e-8 * load;
        let left: f64 = self.balls.iter().map(|ball| ball.state.force).sum();
        let mut worst = left.abs();
        for (pair, force) in self.balls.windows(2).zip(&mut self.forces) {
            let overtakes = pair[0].state.motion[0] - pair[1].state.motion[0];
            if overtakes > UNEQUAL || *force > allowed && overtakes < -UNEQUAL {
                return Err(ReferenceError::NotConverged {
                    residual: overtakes,
                    unit: "of the nut's speed",
                });
            }
            worst = worst.max(-*force);
            *force = force.max(0.0);
        }
        if worst <= allowed {
            Ok(self)
        } else {
            Err(ReferenceError::NotConverged {
                residual: worst,
                unit: "N between balls",
            })
        }
    }

    /// What the nut puts in less what is lost, over the latter.
    pub fn power_error(&self, balls: &[PlacedBall<'_>]) -> f64 {
        let (mut put_in, mut lost) = (0.0, self.ball_loss);
        for (ball, solved) in balls.iter().zip(&self.balls) {
            let motion = &solved.state.motion;
            let rows = ball.rows_of(&solved.state).unwrap_or_default();
            put_in += ball.power_in(&rows, motion);
            lost += rows
                .iter()
                .map(|row| {
                    row.local(motion, ball.rest_spin)
                        .gradient
                        .dot(&row.velocity(motion))
                })
                .sum::<f64>()
                * ball.friction;
        }
        (put_in - lost) / lost
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct BallContact {
    slips: [SMatrix<f64, 2, 4>; 2],
    cos: f64,
    path: f64,
    outward: f64,
    friction: f64,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct BetweenBalls {
    pub on_rear: Rubbing,
    pub on_front: Rubbing,
    /// Power lost over `R_B w_N`, N.
    pub loss: f64,
}

/// Changes of the forces of a contact between two balls: on the seven balances of the rear and of the front ball, by the force along the
/// track and by the two components of the slip.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BallContactSlope {
    /// Slip over `R_B w_N` by the motions of the rear and of the front ball.
    pub slips: [SMatrix<f64, 2, 4>; 2],
    pub on_rear: SMatrix<f64, 7, 3>,
    pub on_front: SMatrix<f64, 7, 3>,
}

impl BallContact {
    /// With or without the part of the force that points outward because the track is curved; `direction` is that of the nut.
    pub fn new(track: &ScrewTrack, friction: f64, direction: f64, chord: bool) -> Self {
        let (sin, cos) = track.ball_contact_angle();
        Self {
            slips: track.slip_between(direction),
            cos,
            path: track.path_radius() / track.ball_radius,
            outward: if chord { sin / cos } else { 0.0 },
            friction,
        }
    }

    /// Normal force of the contact by that along the track: they are one where the outward part is left out.
    pub fn normal_force(&self, along: f64) -> f64 {
        along * self.outward.hypot(1.0)
    }

    /// Outward part of a force along the track, on either ball, N.
    pub fn outward_force(&self, along: f64) -> f64 {
        self.outward * along
    }

    pub fn between(&self, along: f64, rear: &BallState, front: &BallState) -> BetweenBalls {
        let slip = self.slip(rear, front);
        let limit = self.friction * self.normal_force(along.max(0.0));
        let [on_rear, on_front] = self.rubbing(along, slip / slip.norm().max(1e-12));
        BetweenBalls {
            on_rear,
            on_front,
            loss: limit * slip.norm(),
        }
    }

    /// Slip of the rear ball on the front one over `R_B w_N`.
    pub fn slip(&self, rear: &BallState, front: &BallState) -> Vector2<f64> {
        self.slips[0] * rear.motion + self.slips[1] * front.motion
    }

    pub fn rubbing(&self, along: f64, direction: Vector2<f64>) -> [Rubbing; 2] {
        let pull = direction * -(self.friction * self.normal_force(along.max(0.0)));
        [(self.slips[0], 1.0), (self.slips[1], -1.0)].map(|(of, side)| {
            let outward = self.outward * along.max(0.0);
            Rubbing {
                in_plane: [side * self.cos * pull.y + outward, side * pull.x],
                motion: of.transpose() * pull,
            }
        })
    }

    pub fn slope(&self, along: f64, rear: &BallState, front: &BallState) -> BallContactSlope {
        let slip: Vector2<f64> = self.slips[0] * rear.motion + self.slips[1] * front.motion;
        let size = slip.norm().max(1e-12);
        let (direction, limit) = (slip / size, self.friction * self.normal_force(1.0));
        let turn = Matrix2::identity() - direction * direction.transpose();
        let by_slip = turn * (-limit * along.max(0.0) / size);
        let pulls = [
            -limit * direction,
            by_slip.column(0).into(),
            by_slip.column(1).into(),
        ];
        let [on_rear, on_front] =
            [(self.slips[0], 1.0), (self.slips[1], -1.0)].map(|(of, side)| {
                let mut all = SMatrix::<f64, 7, 3>::zeros();
                for (column, pull) in pulls.iter().enumerate() {
                    all[(0, column)] = side * self.cos * pull.y;
                    all[(1, column)] = side * pull.x;
                    all.fixed_view_mut::<4, 1>(3, column)
                        .copy_from(&(of.transpose() * pull));
                }
                all[(0, 0)] += self.outward;
                all[(3, 0)] -= side * self.path;
                all
            });
        BallContactSlope {
            slips: self.slips,
            on_rear,
            on_front,
        }
    }

    pub fn smooth(self) -> Self {
        self.in_part(0.0)
    }

    pub fn in_part(self, part: f64) -> Self {
        Self {
            friction: part * self.friction,
            ..self
        }
    }

    pub fn acts(&self) -> bool {
        self.friction > 0.0 || self.outward > 0.0
    }
}

/// Puts the friction between neighbours on the balls; the power that it takes over `R_B w_N`, N.
fn rub(balls: &mut [PlacedBall<'_>], found: &Pressing, contact: &BallContact) -> f64 {
    for ball in balls.iter_mut() {
        ball.rubbing = Rubbing::default();
    }
    let mut loss = 0.0;
    for (index, force) in found.forces.iter().enumerate() {
        let (rear, front) = (&found.balls[index].state, &found.balls[index + 1].state);
        let forces = contact.between(*force, rear, front);
        loss += forces.loss;
        balls[index].rubbing += forces.on_rear;
        balls[index + 1].rubbing += forces.on_front;
    }
    loss
}
