//! A request, and what the float64 reference answers.

use epas_friction::BallScrew;
use epas_reference::friction::ball_screw_row::{ElasticRow, RowBall, RowMotion};
use epas_reference::friction::patch::Integration;
use serde::Serialize;

use crate::fields::{BadField, Fields, in_range, request, same};
use crate::train::{ScrewNumbers, of_contact, solved};

/// Largest deviation of the arc centres, rad.
const LARGEST_DEVIATION: f64 = 0.2;

/// A row of balls; a quantity that was not found is none.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Row {
    /// Orbital over nut speed of each ball, no neighbour pressing.
    pub free_speed: Option<Vec<f64>>,
    /// Force between each ball and the next, N.
    pub contact_force: Option<Vec<f64>>,
    /// Friction torque of the grooves on the nut, N m, with all that friction between balls adds: in the grooves, where it turns the balls, and
    /// between them.
    pub groove_torque: Option<f64>,
    /// The same, no neighbour pressing.
    pub groove_torque_free: Option<f64>,
    /// Part of `groove_torque` that is lost between balls, N m; the law does not part it from what rubbing adds in the grooves.
    pub ball_torque: Option<f64>,
    /// Loads of SL, SR, NL and NR, N, no neighbour pressing.
    pub loads: Option<Vec<[f64; 4]>>,
}

request! {
    /// A row of balls in a ball screw.
    #[derive(Clone, Debug, Serialize)]
    pub struct Request {
        /// The screw.
        #[serde(flatten)]
        screw: ScrewNumbers = ScrewNumbers::read,
        /// Nominal contact angle, rad, 0.25 to 1.3.
        contact_angle: f64,
        /// Friction coefficient in the grooves, 1e-3 to 0.5.
        friction: f64,
        /// Friction coefficient between balls, 0 to 0.5.
        ball_friction: f64 = |fields: &mut Fields| fields.or("ball_friction", 0.0),
        /// Radial gap of every contact at the centred ball, m, -0.05 to 0.2 ball radii.
        clearance: f64,
        /// Whether forces between balls act along the chord between their centres: with a part that points outward, and reported along it. Without, as in
        /// the papers' figures, along the track.
        #[serde(skip_serializing_if = "std::ops::Not::not")]
        chord: bool = |fields: &mut Fields| fields.flag("chord"),
        /// Speed of the nut, rad/s, up to 1e6 either way.
        nut_speed: f64,
        /// Rear to front in the direction of orbiting, 2 to 64 of them.
        balls: Vec<Ball>,
    }
}

request! {
    /// A ball of the row.
    #[derive(Clone, Debug, Serialize)]
    pub struct Ball {
        /// How far the screw's groove is turned, rad, up to 0.2 either way.
        screw_deviation: f64,
        /// How far the nut's groove is turned, rad, up to 0.2 either way.
        nut_deviation: f64,
        /// Axial load, N, up to 1e6 either way.
        axial_load: f64,
    }
}

impl Request {
    pub(super) fn check(&self) -> Result<(), BadField> {
        self.screw.check()?;
        in_range("contact_angle", self.contact_angle, 0.25, 1.3)?;
        in_range("friction", self.friction, 1e-3, 0.5)?;
        in_range("ball_friction", self.ball_friction, 0.0, 0.5)?;
        let radius = self.screw.ball_radius;
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
    pub(super) fn reference(&self) -> Result<Row, BadField> {
        let row = ElasticRow {
            design: self.screw.exact(self.contact_angle),
            clearance: self.clearance,
            friction: self.friction,
            ball_friction: self.ball_friction,
            nut_speed: self.nut_speed,
            balls: self
                .balls
                .iter()
                .map(|ball| same!(RowBall { screw_deviation, nut_deviation, axial_load } of ball))
                .collect(),
            chord: self.chord,
            integration: Integration::Coarse,
        };
        let found = solved(row.solve()).map_err(of_contact)?;
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
            groove_torque: Some((row.groove_loss() + row.ball_loss) / speed),
            groove_torque_free: Some(row.free_groove_loss() / speed),
            ball_torque: Some(row.ball_loss / speed),
            loads: Some(balls.iter().map(|ball| ball.loads).collect()),
        }
    }

    /// The crate's design.
    pub(super) fn design(&self) -> Result<BallScrew, BadField> {
        self.screw
            .design(self.contact_angle as f32)
            .map_err(|error| BadField::from(error).renamed("axis_ratio", "groove_radius"))
    }
}
