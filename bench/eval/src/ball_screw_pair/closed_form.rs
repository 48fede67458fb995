//! The closed form of a row of balls, which cannot do all that is asked:
//!
//! * It knows three fits, not a clearance. Oversize becomes the preload that it makes of the centred ball. Play becomes two-point contact
//!   where it takes the whole load of a nominal ball's third contact, and no play below that: in between the third contact's load is too
//!   large, and the force between balls with it.
//! * A deviation that takes load from the third contact makes that contact slide over its whole area. The closed form takes it as rolling:
//!   forces of that sign are too large, by 10 % to a factor two.
//! * Loads of a ball follow from its axial load alone, not from deviations or from forces between balls, and friction in the grooves is that
//!   of balls that do not press: `groove_torque` is `groove_torque_free`.
//! * Friction between balls does not change the forces between them.

use epas_friction::ball::{GrooveFit, ScrewRow};
use epas_friction::geometry::Groove;
use epas_friction::hertz::HertzContact;
use epas_friction::train::Press;
use epas_friction::{BallScrew, LoadShare};

use super::super::fields::BadField;
use super::super::train::{LARGEST_TRAIN, contact_forces, pressed, room_of_a_row};
use super::request::{Request, Row};

pub fn row(request: &Request, design: &BallScrew) -> Result<Row, BadField> {
    let (friction, nut_speed) = (request.friction as f32, request.nut_speed as f32);
    let row = fitted(request, design, friction, nut_speed)?;
    let path = design.pitch_radius() / design.cos_lead_angle();
    // Speeds over that of a nominal ball against the nut, as in the scene.
    let speed = path - row.nominal_speed();
    let (mut free, mut compliance) = ([0.0; LARGEST_TRAIN], [1.0; LARGEST_TRAIN]);
    let mut torque = 0.0;
    let mut free_speed = Vec::with_capacity(request.balls.len());
    let mut loads = Vec::with_capacity(request.balls.len());
    for ((given, free), compliance) in request.balls.iter().zip(&mut free).zip(&mut compliance) {
        let (screw, nut) = (given.screw_deviation as f32, given.nut_deviation as f32);
        let load = given.axial_load as f32;
        let tick = row.at(nut_speed, load);
        let ball = tick.ball(screw, nut, &LoadShare::MEAN);
        *free = ball.speed_deviation / speed;
        *compliance = ball.compliance / speed;
        torque += f64::from(ball.groove_torque);
        free_speed.push(f64::from(
            (tick.nominal_speed() + ball.speed_deviation) / path,
        ));
        let contacts = row.contacts(nut_speed, load, screw, nut);
        loads.push(contacts.forces.map(f64::from));
    }
    let count = request.balls.len();
    let mut press = Press::<LARGEST_TRAIN>::new();
    let presses = pressed(&mut press, &free, &compliance, &room_of_a_row(count));
    Ok(Row {
        free_speed: Some(free_speed),
        contact_force: presses.then(|| {
            contact_forces(&press)
                .iter()
                .take(count - 1)
                .map(|&force| force.into())
                .collect()
        }),
        groove_torque: Some(torque),
        groove_torque_free: Some(torque),
        ball_torque: None,
        loads: Some(loads),
    })
}

fn fitted(
    request: &Request,
    design: &BallScrew,
    friction: f32,
    nut_speed: f32,
) -> Result<ScrewRow, BadField> {
    let clearance = request.clearance as f32;
    if clearance < 0.0 {
        let compliance: f32 = [Groove::Screw, Groove::Nut]
            .into_iter()
            .map(|groove| HertzContact::of(design, groove).deflection_coefficient())
            .sum();
        // Both contacts of a diagonal deflect by twice the oversize together.
        let contact_force = (-2.0 * clearance / compliance).powf(1.5);
        // Below the least preload that counts there is none to speak of.
        if contact_force >= 1e-3 {
            return Ok(ScrewRow::new(
                design,
                friction,
                GrooveFit::Preload { contact_force },
            )?);
        }
    }
    let row = ScrewRow::new(design, friction, GrooveFit::Zero)?;
    if clearance > 0.0 {
        let count = request.balls.len() as f32;
        let mean = request
            .balls
            .iter()
            .map(|ball| ball.axial_load.abs() as f32)
            .sum::<f32>()
            / count;
        let loads = row.contacts(nut_speed, mean, 0.0, 0.0).forces;
        // A load along z: SL and NR carry, and SR or NL is the third contact.
        let share = loads[1].max(loads[2]) / loads[0];
        let sine = (2.0 * request.contact_angle as f32).sin();
        let offset = (request.screw.groove_radius - request.screw.ball_radius) as f32;
        // Play `g` takes `4 g/(D sin^2(2 beta))` of the main load from the third contact: all that it has?
        if 4.0 * clearance > share * offset * sine * sine {
            return Ok(ScrewRow::new(design, friction, GrooveFit::Play)?);
        }
    }
    Ok(row)
}
