//! A row of balls as the scene of a ball screw without cage has it once it has settled ([`epas_rows::settled`]).

use epas_friction::ball::elastic::{BallInputs, ElasticGrooves, Renewal};
use epas_friction::{BallScrew, Clearance};
use epas_rows::LARGEST_TRAIN;
use epas_rows::settled::{SettledRow, settled};

use super::super::fields::BadField;
use super::request::{Request, Row};

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
    // In the frame in which the nut turns forward.
    let backward = request.nut_speed < 0.0;
    let way = if backward { -1.0 } else { 1.0 };
    let inputs = request.balls.iter().map(|ball| BallInputs {
        axial_load: way * ball.axial_load as f32,
        force: 0.0,
        rubbing: [0.0; 2],
        screw_deviation: way * ball.screw_deviation as f32,
        nut_deviation: way * ball.nut_deviation as f32,
        friction: request.friction as f32,
        clearance: clearance.gap(),
    });
    let found = settled::<LARGEST_TRAIN>(design, &grooves, inputs, request.ball_friction as f32);
    Ok(found.map_or_else(Row::default, |found| answer(&found, design, backward)))
}

fn answer(found: &SettledRow, design: &BallScrew, backward: bool) -> Row {
    let path = design.pitch_radius() / design.cos_lead_angle();
    let torque =
        |balls: &[Renewal]| -> f64 { balls.iter().map(|ball| f64::from(ball.torque)).sum() };
    let speed = |ball: &Renewal| f64::from(ball.speed / path);
    let pressing = found.pressing.as_ref();
    Row {
        free_speed: Some(found.alone.iter().map(speed).collect()),
        groove_torque_free: Some(torque(&found.alone)),
        loads: Some(
            found
                .alone
                .iter()
                .map(|ball| loads(ball, backward))
                .collect(),
        ),
        contact_force: pressing
            .map(|pressing| pressing.forces.iter().map(|&force| force.into()).collect()),
        groove_torque: pressing.map(|pressing| torque(&pressing.balls)),
    }
}

/// Loads of SL, SR, NL, NR as they are on the screw: where the nut turns backward, left and right are changed.
fn loads(ball: &Renewal, backward: bool) -> [f64; 4] {
    let [a, b, c, d] = ball.loads.map(f64::from);
    if backward { [b, a, d, c] } else { [a, b, c, d] }
}
