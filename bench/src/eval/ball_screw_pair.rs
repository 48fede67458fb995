//! `ball_screw_pair`: a row of touching balls in a ball screw, each with its own axial load, in grooves with a clearance of either sign.
//!
//! The reference solves every ball's elastic equilibrium with exact contact integrals. What the scene of a ball screw without cage computes is
//! a closed form, and cannot do all that is asked here:
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
use epas_reference::design::BallScrewDesign;
use epas_reference::friction::ball_screw_row::{ElasticRow, RowBall, RowMotion};
use epas_reference::friction::patch::Integration;
use epas_reference::material::Elastic;
use serde::Serialize;

use super::answer::Answer;
use super::fields::{BadField, Fields, in_range};
use super::train::{LARGEST_TRAIN, ScrewNumbers, contact_forces, pressed, room_of_a_row, solved};

/// Largest deviation of the arc centres, rad.
const LARGEST_DEVIATION: f64 = 0.2;

/// A quantity that was not found is none.
#[derive(Default, Serialize)]
struct Row {
    /// Orbital over nut speed, no neighbour pressing.
    free_speed: Option<Vec<f64>>,
    contact_force: Option<Vec<f64>>,
    groove_torque: Option<f64>,
    groove_torque_free: Option<f64>,
    /// SL, SR, NL, NR, no neighbour pressing.
    loads: Option<Vec<[f64; 4]>>,
}

struct Request {
    pitch_radius: f64,
    lead: f64,
    ball_radius: f64,
    groove_radius: f64,
    contact_angle: f64,
    youngs_modulus: f64,
    poisson_ratio: f64,
    friction: f64,
    ball_friction: f64,
    clearance: f64,
    nut_speed: f64,
    balls: Vec<RowBall>,
}

/// Answers one request.
pub fn evaluate(mut fields: Fields) -> Result<Answer, BadField> {
    let request = Request {
        pitch_radius: fields.number("pitch_radius")?,
        lead: fields.number("lead")?,
        ball_radius: fields.number("ball_radius")?,
        groove_radius: fields.number("groove_radius")?,
        contact_angle: fields.number("contact_angle")?,
        youngs_modulus: fields.number("youngs_modulus")?,
        poisson_ratio: fields.number("poisson_ratio")?,
        friction: fields.number("friction")?,
        ball_friction: fields.optional_number("ball_friction")?.unwrap_or(0.0),
        clearance: fields.number("clearance")?,
        nut_speed: fields.number("nut_speed")?,
        balls: fields
            .objects("balls", LARGEST_TRAIN)?
            .into_iter()
            .enumerate()
            .map(|(index, given)| ball(given).map_err(|error| error.of_ball(index)))
            .collect::<Result<_, _>>()?,
    };
    fields.finish()?;
    request.check()?;
    if request.nut_speed == 0.0 {
        // Coulomb friction has no direction at rest.
        return Answer::both(&Row::default(), &Row::default());
    }
    Answer::both(&request.scene()?, &request.reference()?)
}

fn ball(mut given: Fields) -> Result<RowBall, BadField> {
    let ball = RowBall {
        screw_deviation: given.number("screw_deviation")?,
        nut_deviation: given.number("nut_deviation")?,
        axial_load: given.number("axial_load")?,
    };
    given.finish()?;
    Ok(ball)
}

impl Request {
    fn check(&self) -> Result<(), BadField> {
        in_range("pitch_radius", self.pitch_radius, 1e-4, 10.0)?;
        in_range("lead", self.lead, 0.0, 20.0 * self.pitch_radius)?;
        in_range(
            "ball_radius",
            self.ball_radius,
            1e-5,
            0.8 * self.pitch_radius,
        )?;
        // A ball that fills its groove has no place of its own.
        in_range(
            "groove_radius",
            self.groove_radius,
            1.002 * self.ball_radius,
            1.999 * self.ball_radius,
        )?;
        in_range("contact_angle", self.contact_angle, 0.25, 1.3)?;
        in_range("youngs_modulus", self.youngs_modulus, 1e6, 1e13)?;
        in_range("poisson_ratio", self.poisson_ratio, 0.0, 0.49)?;
        in_range("friction", self.friction, 1e-3, 0.5)?;
        in_range("ball_friction", self.ball_friction, 0.0, 0.5)?;
        let radius = self.ball_radius;
        in_range("clearance", self.clearance, -0.05 * radius, 0.2 * radius)?;
        in_range("nut_speed", self.nut_speed, -1e6, 1e6)?;
        if self.balls.len() < 2 {
            return Err(BadField::new("balls", "a row has two balls or more"));
        }
        for (index, ball) in self.balls.iter().enumerate() {
            let (least, most) = (-LARGEST_DEVIATION, LARGEST_DEVIATION);
            in_range("screw_deviation", ball.screw_deviation, least, most)
                .and_then(|_| in_range("nut_deviation", ball.nut_deviation, least, most))
                .and_then(|_| in_range("axial_load", ball.axial_load, -1e6, 1e6))
                .map_err(|error| error.of_ball(index))?;
        }
        Ok(())
    }

    fn reference(&self) -> Result<Row, BadField> {
        let material = Elastic {
            youngs_modulus: self.youngs_modulus,
            poisson_ratio: self.poisson_ratio,
        };
        let row = ElasticRow {
            design: BallScrewDesign {
                pitch_radius: self.pitch_radius,
                lead: self.lead,
                ball_radius: self.ball_radius,
                screw_groove_radius: self.groove_radius,
                nut_groove_radius: self.groove_radius,
                contact_angle: self.contact_angle,
                ball: material,
                groove: material,
            },
            clearance: self.clearance,
            friction: self.friction,
            ball_friction: self.ball_friction,
            nut_speed: self.nut_speed,
            balls: self.balls.clone(),
            integration: Integration::Full,
        };
        let found = solved(row.solve()).map_err(|error| {
            error
                .renamed("offset_h", "groove_radius")
                .renamed("relative_radius_1", "pitch_radius")
                .renamed("relative_radius_2", "groove_radius")
                .renamed("contact_modulus", "youngs_modulus")
        })?;
        Ok(found.map_or_else(Row::default, |row| self.answer(&row)))
    }

    fn answer(&self, row: &RowMotion) -> Row {
        let speed = self.nut_speed.abs();
        let balls = &row.free;
        Row {
            free_speed: Some(
                balls
                    .iter()
                    .map(|ball| ball.motion.orbital_speed / self.nut_speed)
                    .collect(),
            ),
            contact_force: Some(row.contact_forces.clone()),
            groove_torque: Some(row.groove_loss() / speed),
            groove_torque_free: Some(row.free_groove_loss() / speed),
            loads: Some(balls.iter().map(|ball| ball.loads).collect()),
        }
    }

    /// What the scene computes in f32.
    fn scene(&self) -> Result<Row, BadField> {
        let design = self.design()?;
        let (friction, nut_speed) = (self.friction as f32, self.nut_speed as f32);
        let row = self.row(&design, friction, nut_speed)?;
        let path = design.pitch_radius() / design.cos_lead_angle();
        // Speeds over that of a nominal ball against the nut, as in the scene.
        let speed = path - row.nominal_speed();
        let (mut free, mut compliance) = ([0.0; LARGEST_TRAIN], [1.0; LARGEST_TRAIN]);
        let mut torque = 0.0;
        let mut free_speed = Vec::with_capacity(self.balls.len());
        let mut loads = Vec::with_capacity(self.balls.len());
        for ((given, free), compliance) in self.balls.iter().zip(&mut free).zip(&mut compliance) {
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
        let count = self.balls.len();
        let mut press = Press::new();
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
            loads: Some(loads),
        })
    }

    /// The closed form with the fit that is nearest to the clearance.
    fn row(&self, design: &BallScrew, friction: f32, nut_speed: f32) -> Result<ScrewRow, BadField> {
        let clearance = self.clearance as f32;
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
            let count = self.balls.len() as f32;
            let mean = self
                .balls
                .iter()
                .map(|ball| ball.axial_load.abs() as f32)
                .sum::<f32>()
                / count;
            let loads = row.contacts(nut_speed, mean, 0.0, 0.0).forces;
            // A load along z: SL and NR carry, and SR or NL is the third contact.
            let share = loads[1].max(loads[2]) / loads[0];
            let sine = (2.0 * self.contact_angle as f32).sin();
            let offset = (self.groove_radius - self.ball_radius) as f32;
            // Play `g` takes `4 g/(D sin^2(2 beta))` of the main load from the third contact: all that it has?
            if 4.0 * clearance > share * offset * sine * sine {
                return Ok(ScrewRow::new(design, friction, GrooveFit::Play)?);
            }
        }
        Ok(row)
    }

    fn design(&self) -> Result<BallScrew, BadField> {
        ScrewNumbers {
            pitch_radius: self.pitch_radius,
            lead: self.lead,
            ball_radius: self.ball_radius,
            groove_radius: self.groove_radius,
            youngs_modulus: self.youngs_modulus,
            poisson_ratio: self.poisson_ratio,
        }
        .design(self.contact_angle as f32)
        .map_err(|error| BadField::from(error).renamed("axis_ratio", "groove_radius"))
    }
}
