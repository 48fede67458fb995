//! A request, and what the float64 reference answers.

use epas_friction::BallScrew;
use epas_reference::friction::ball_screw_row::{ElasticRow, RowBall, RowMotion};
use epas_reference::friction::patch::Integration;
use serde::Serialize;

use crate::fields::{BadField, Fields, in_range};
use crate::train::{LARGEST_TRAIN, ScrewNumbers, solved};

/// Largest deviation of the arc centres, rad.
const LARGEST_DEVIATION: f64 = 0.2;

/// A quantity that was not found is none.
#[derive(Default, Serialize)]
pub struct Row {
    /// Orbital over nut speed, no neighbour pressing.
    pub free_speed: Option<Vec<f64>>,
    pub contact_force: Option<Vec<f64>>,
    pub groove_torque: Option<f64>,
    pub groove_torque_free: Option<f64>,
    /// SL, SR, NL, NR, no neighbour pressing.
    pub loads: Option<Vec<[f64; 4]>>,
}

/// A row of balls in a ball screw.
pub struct Request {
    pub pitch_radius: f64,
    pub lead: f64,
    pub ball_radius: f64,
    pub groove_radius: f64,
    pub contact_angle: f64,
    pub youngs_modulus: f64,
    pub poisson_ratio: f64,
    pub friction: f64,
    pub ball_friction: f64,
    pub clearance: f64,
    pub nut_speed: f64,
    pub balls: Vec<RowBall>,
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
    /// Reads a request; what else stands in it is left.
    pub fn read(fields: &mut Fields) -> Result<Self, BadField> {
        Ok(Self {
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
            balls: fields.balls(LARGEST_TRAIN, ball)?,
        })
    }

    /// Refuses what is out of range.
    pub fn check(&self) -> Result<(), BadField> {
        self.numbers().check()?;
        in_range("contact_angle", self.contact_angle, 0.25, 1.3)?;
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

    /// What the float64 reference finds; nothing where it has no solution.
    pub fn reference(&self) -> Result<Row, BadField> {
        let row = ElasticRow {
            design: self.numbers().exact(self.contact_angle),
            clearance: self.clearance,
            friction: self.friction,
            ball_friction: self.ball_friction,
            nut_speed: self.nut_speed,
            balls: self.balls.clone(),
            integration: Integration::Coarse,
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

    const fn numbers(&self) -> ScrewNumbers {
        ScrewNumbers {
            pitch_radius: self.pitch_radius,
            lead: self.lead,
            ball_radius: self.ball_radius,
            groove_radius: self.groove_radius,
            youngs_modulus: self.youngs_modulus,
            poisson_ratio: self.poisson_ratio,
        }
    }

    /// The crate's design.
    pub fn design(&self) -> Result<BallScrew, BadField> {
        self.numbers()
            .design(self.contact_angle as f32)
            .map_err(|error| BadField::from(error).renamed("axis_ratio", "groove_radius"))
    }
}
