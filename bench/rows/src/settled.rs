//! A row of balls as the scene of a ball screw without cage has it once it has settled: every ball in elastic grooves,
//! renewed by Newton steps of place and motion together, and pressing on its neighbours by its
//! linear law of speed and force.
//!
//! The scene renews one or two balls a tick; here all of them are renewed in rounds, until nothing changes any more.

use epas_friction::BallScrew;
use epas_friction::ball::elastic::{BallInputs, ElasticGrooves, Renewal, Settled};
use epas_friction::train::Press;

use crate::{contact_forces, pressed, room_of_a_row};

/// Renewals of a ball by itself: the slowest of the stored pairs needs 20.
const ALONE: usize = 60;

/// Rounds in which forces between balls are found anew, and renewals of each ball in one.
const ROUNDS: usize = 12;
const IN_A_ROUND: usize = 4;

/// What balls of a row do, rear to front.
#[derive(Clone, Debug, PartialEq)]
pub struct SettledRow {
    /// Each ball by itself: centre speed, torque and loads are in it.
    pub alone: Vec<Renewal>,
    /// Pressing on each other; none where a ball loses its grooves then, or runs further from nominal rolling than the scene takes.
    pub pressing: Option<Pressing>,
}

/// Balls that press on each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Pressing {
    /// Between each ball and the next, N; one shorter than the row.
    pub forces: Vec<f32>,
    /// Each ball.
    pub balls: Vec<Renewal>,
}

/// One ball on its way.
struct Ball {
    inputs: BallInputs,
    settled: Settled,
    found: Renewal,
}

impl Ball {
    /// A ball by itself; none where it loses its grooves.
    fn alone(grooves: &ElasticGrooves, inputs: BallInputs) -> Option<Self> {
        // As in the scene: balls start as nominal ones.
        let mut settled = grooves.start(&BallInputs {
            screw_deviation: 0.0,
            nut_deviation: 0.0,
            ..inputs
        });
        let found = grooves.renew(&mut settled, &inputs);
        let mut ball = Self {
            inputs,
            settled,
            found,
        };
        ball.renew(grooves, ALONE)?;
        Some(ball)
    }

    fn renew(&mut self, grooves: &ElasticGrooves, times: usize) -> Option<()> {
        for _ in 0..times {
            let before = self.settled;
            self.found = grooves.renew(&mut self.settled, &self.inputs);
            // A renewal follows from the state and the inputs alone: all further ones would be this one.
            if self.settled == before {
                break;
            }
        }
        (!self.found.lost).then_some(())
    }
}

/// Settles a row of up to `N` balls; none where a ball by itself carries no load or loses its grooves.
pub fn settled<const N: usize>(
    design: &BallScrew,
    grooves: &ElasticGrooves,
    inputs: impl Iterator<Item = BallInputs>,
    ball_friction: f32,
) -> Option<SettledRow> {
    let mut balls = inputs
        // A ball without load has no place in its grooves.
        .map(|inputs| (inputs.axial_load != 0.0).then(|| Ball::alone(grooves, inputs))?)
        .collect::<Option<Vec<_>>>()?;
    let alone = balls.iter().map(|ball| ball.found).collect();
    let path = design.pitch_radius() / design.cos_lead_angle();
    let rolling = design.ball_radius() * design.cos_lead_angle() * design.contact_angle().cos;
    let nominal = 0.5 * (path + rolling);
    let forces = press::<N>(
        grooves,
        &mut balls,
        ball_friction,
        (nominal, path - nominal),
    );
    let pressing = forces.map(|forces| Pressing {
        forces,
        balls: balls.iter().map(|ball| ball.found).collect(),
    });
    Some(SettledRow { alone, pressing })
}

/// Lets the balls press on each other until their forces stand; speeds count from that of a nominal ball over its speed
/// against the nut. None where a ball loses its grooves, or runs further from nominal rolling than the scene takes.
fn press<const N: usize>(
    grooves: &ElasticGrooves,
    balls: &mut [Ball],
    ball_friction: f32,
    (nominal, against): (f32, f32),
) -> Option<Vec<f32>> {
    let room = room_of_a_row::<N>(balls.len());
    let mut press = Press::<N>::new();
    let mut forces = [0.0; N];
    for _ in 0..ROUNDS {
        let (mut free, mut compliance) = ([0.0; N], [1.0; N]);
        for ((ball, free), compliance) in balls.iter().zip(&mut free).zip(&mut compliance) {
            let Renewal {
                speed,
                compliance: found,
                ..
            } = ball.found;
            *free = (speed - found * ball.inputs.force - nominal) / against;
            *compliance = found / against;
        }
        if !pressed(&mut press, &free, &compliance, &room) {
            return None;
        }
        forces = contact_forces(&press);
        let mut behind = 0.0;
        for (ball, &ahead) in balls.iter_mut().zip(&forces) {
            ball.inputs.force = behind - ahead;
            ball.inputs.rubbing = [
                ball_friction * (behind + ahead),
                ball_friction * (ahead - behind),
            ];
            behind = ahead;
            ball.renew(grooves, IN_A_ROUND)?;
        }
    }
    let pairs = balls.len() - 1;
    Some(forces.iter().take(pairs).copied().collect())
}
