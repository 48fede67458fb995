//! `contact_kinematics`: slip, spin and entrainment of the two contacts of a ball, at their centres.

use epas_friction::kinematics::{ContactKinematics, ContactSlip, KinematicsParameters, SlipRatios};
use epas_reference::kinematics::{self as exact, KinematicsInput, Revised};
use serde::Serialize;

use super::fields::{BadField, in_range, request, same};
use super::model::{Both, Model};

request! {
    /// A ball between screw and nut, and how it spins.
    #[derive(Clone, Debug, Serialize)]
    pub struct Request {
        /// Ball diameter, m.
        ball_diameter: f64,
        /// Pitch radius, m.
        pitch_radius: f64,
        /// Lead angle, rad, within a right angle.
        lead_angle: f64,
        /// Groove radius of the screw, m.
        groove_radius_screw: f64,
        /// Groove radius of the nut, m.
        groove_radius_nut: f64,
        /// Contact angle at the screw, rad, within a right angle.
        contact_angle_screw: f64,
        /// Contact angle at the nut, rad, within a right angle.
        contact_angle_nut: f64,
        /// Pitch angle of the ball's spin, rad.
        pitch_angle: f64,
        /// Yaw angle of the ball's spin, rad.
        yaw_angle: f64,
        /// Rolling radius at the screw, m.
        rolling_radius_screw: f64,
        /// Rolling radius at the nut, m.
        rolling_radius_nut: f64,
        /// Speed of the screw, rad/s, up to 1e6 either way.
        speed: f64,
        /// Semi-major axis of the contact at the screw, m.
        semi_major_screw: f64,
        /// Semi-minor axis of the contact at the screw, m.
        semi_minor_screw: f64,
        /// Semi-major axis of the contact at the nut, m.
        semi_major_nut: f64,
        /// Semi-minor axis of the contact at the nut, m.
        semi_minor_nut: f64,
    }
}

/// Motion of the ball.
#[derive(Clone, Debug, Serialize)]
pub struct Ball {
    /// Speed of its centre about the axis, rad/s.
    pub orbital_speed: f64,
    /// Speed about its own centre, rad/s.
    pub spin_speed: f64,
    /// Contact at the screw.
    pub screw: Contact,
    /// Contact at the nut.
    pub nut: Contact,
}

/// Motion at the centre of a contact.
#[derive(Clone, Debug, Serialize)]
pub struct Contact {
    /// Slip in the direction of rolling, m/s.
    pub rolling_slip: f64,
    /// Slip across it, m/s.
    pub side_slip: f64,
    /// Spin, rad/s.
    pub spin: f64,
    /// Entrainment speed, m/s.
    pub entrainment_speed: f64,
    /// Direction of entrainment, rad.
    pub entrainment_angle: f64,
    /// Slip over entrainment speed.
    pub slide_to_roll: f64,
    /// Direction of slip, rad; none where nothing slides.
    pub slide_angle: Option<f64>,
    /// Spin over rolling.
    pub spin_to_roll: f64,
}

impl Model for Request {
    const NAME: &'static str = "contact_kinematics";
    type InLoop = Ball;
    type Reference = Ball;

    fn evaluate(&self) -> Result<Both<Ball, Ball>, BadField> {
        in_range("speed", self.speed, -1e6, 1e6)?;
        let in_loop = self.in_loop()?;
        let input = same!(KinematicsInput {
            ball_diameter, pitch_radius, lead_angle, groove_radius_screw, groove_radius_nut,
            contact_angle_screw, contact_angle_nut, pitch_angle, yaw_angle, rolling_radius_screw,
            rolling_radius_nut, speed, semi_major_screw, semi_minor_screw, semi_major_nut,
            semi_minor_nut
        } of self);
        let ball = Revised::new(&input)?.evaluate();
        let reference = same!(Ball { orbital_speed, spin_speed, screw, nut } of ball);
        Ok(Both { in_loop, reference })
    }
}

impl Request {
    fn in_loop(&self) -> Result<Ball, BadField> {
        let model = ContactKinematics::new(&same!(KinematicsParameters {
            ball_diameter, pitch_radius, lead_angle, groove_radius_screw, groove_radius_nut,
            contact_angle_screw, contact_angle_nut, pitch_angle, yaw_angle, rolling_radius_screw,
            rolling_radius_nut, semi_major_screw, semi_minor_screw, semi_major_nut, semi_minor_nut
        } of self, as f32))?;
        let ball = model.tick(self.speed as f32);
        let contact = |slip: ContactSlip, ratios: SlipRatios| Contact {
            rolling_slip: slip.rolling_slip.into(),
            side_slip: slip.side_slip.into(),
            spin: slip.spin.into(),
            entrainment_speed: slip.entrainment_speed.into(),
            entrainment_angle: ratios.entrainment_angle.into(),
            slide_to_roll: ratios.slide_to_roll.into(),
            slide_angle: (ratios.slide_to_roll > 0.0).then(|| ratios.slide_angle.into()),
            spin_to_roll: ratios.spin_to_roll.into(),
        };
        Ok(Ball {
            orbital_speed: ball.orbital_speed.into(),
            spin_speed: ball.spin_speed.into(),
            screw: contact(ball.screw, model.screw().ratios()),
            nut: contact(ball.nut, model.nut().ratios()),
        })
    }
}

impl From<exact::ContactKinematics> for Contact {
    fn from(contact: exact::ContactKinematics) -> Self {
        same!(Self {
            rolling_slip, side_slip, spin, entrainment_speed, entrainment_angle, slide_to_roll, slide_angle,
            spin_to_roll,
        } of contact)
    }
}
