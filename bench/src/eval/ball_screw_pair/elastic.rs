//! A row of balls as the scene of a ball screw without cage has it once it has settled: every ball in elastic grooves,
//! renewed by Newton steps of place and motion together, and pressing on its neighbours by its
//! linear law of speed and force.
//!
//! The scene renews one or two balls a tick; here all of them are renewed in rounds, until nothing changes any more.

use epas_friction::ball::elastic::{BallInputs, ElasticGrooves, Renewal, Settled};
use epas_friction::train::Press;
use epas_friction::{BallScrew, Clearance};

use super::super::fields::BadField;
use super::super::train::{LARGEST_TRAIN, contact_forces, pressed, room_of_a_row};
use super::{Request, Row};

/// Renewals of a ball by itself: the slowest of the stored pairs needs 20.
const ALONE: usize = 60;

/// Rounds in which forces between balls are found anew, and renewals of each ball in one.
const ROUNDS: usize = 12;
const IN_A_ROUND: usize = 4;

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
            self.found = grooves.renew(&mut self.settled, &self.inputs);
        }
        (!self.found.lost).then_some(())
    }
}

/// What the scene computes in f32; nothing where its clearance is not among those that the scene takes, or where a ball
/// carries no load or loses its grooves.
pub fn row(request: &Request, design: &BallScrew) -> Result<Row, BadField> {
    let Ok(clearance) =
        Clearance::new(request.clearance as f32).and_then(|clearance| clearance.checked(design))
    else {
        return Ok(Row::default());
    };
    let grooves = ElasticGrooves::new(design)
        .map_err(|error| BadField::from(error).renamed("axis_ratio", "groove_radius"))?;
    Ok(settled(request, design, &grooves, clearance).unwrap_or_default())
}

fn settled(
    request: &Request,
    design: &BallScrew,
    grooves: &ElasticGrooves,
    clearance: Clearance,
) -> Option<Row> {
    // In the frame in which the nut turns forward.
    let backward = request.nut_speed < 0.0;
    let way = if backward { -1.0 } else { 1.0 };
    let mut balls = request
        .balls
        .iter()
        .map(|ball| {
            let inputs = BallInputs {
                axial_load: way * ball.axial_load as f32,
                force: 0.0,
                rubbing: [0.0; 2],
                screw_deviation: way * ball.screw_deviation as f32,
                nut_deviation: way * ball.nut_deviation as f32,
                friction: request.friction as f32,
                clearance: clearance.gap(),
            };
            // A ball without load has no place in its grooves.
            (inputs.axial_load != 0.0).then(|| Ball::alone(grooves, inputs))?
        })
        .collect::<Option<Vec<_>>>()?;
    let path = design.pitch_radius() / design.cos_lead_angle();
    let torque =
        |balls: &[Ball]| -> f64 { balls.iter().map(|ball| f64::from(ball.found.torque)).sum() };
    let mut row = Row {
        free_speed: Some(
            balls
                .iter()
                .map(|ball| f64::from(ball.found.speed / path))
                .collect(),
        ),
        groove_torque_free: Some(torque(&balls)),
        loads: Some(balls.iter().map(|ball| loads(ball, backward)).collect()),
        ..Row::default()
    };
    let rolling = design.ball_radius() * design.cos_lead_angle() * design.contact_angle().cos;
    let nominal = 0.5 * (path + rolling);
    let ball_friction = request.ball_friction as f32;
    if let Some(forces) = press(
        grooves,
        &mut balls,
        ball_friction,
        (nominal, path - nominal),
    ) {
        row.contact_force = Some(forces);
        row.groove_torque = Some(torque(&balls));
    }
    Some(row)
}

/// Loads of SL, SR, NL, NR as they are on the screw: where the nut turns backward, left and right are changed.
fn loads(ball: &Ball, backward: bool) -> [f64; 4] {
    let [a, b, c, d] = ball.found.loads.map(f64::from);
    if backward { [b, a, d, c] } else { [a, b, c, d] }
}

/// Lets the balls press on each other until their forces stand; speeds count from that of a nominal ball over its speed
/// against the nut. None where a ball loses its grooves, or runs further from nominal rolling than the scene takes.
fn press(
    grooves: &ElasticGrooves,
    balls: &mut [Ball],
    ball_friction: f32,
    (nominal, against): (f32, f32),
) -> Option<Vec<f64>> {
    let room = room_of_a_row(balls.len());
    let mut press = Press::new();
    let mut forces = [0.0; LARGEST_TRAIN];
    for _ in 0..ROUNDS {
        let (mut free, mut compliance) = ([0.0; LARGEST_TRAIN], [1.0; LARGEST_TRAIN]);
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
    Some(
        forces
            .iter()
            .take(pairs)
            .map(|&force| force.into())
            .collect(),
    )
}
