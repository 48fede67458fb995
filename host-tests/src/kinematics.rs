//! Contact kinematics of a ball screw, exact in float64.
//!
//! Two routes to the same slip, one test between them:
//! - [`Revised`]: Alberdi et al., eqs. (12) to (40), as printed but for the corrections that each
//!   function names;
//! - [`RigidBody`]: positions of material points of ball, screw and nut as functions of time,
//!   differentiated by dual numbers, with orbital and spin speed from the condition of rolling.
//!
//! Beside them [`Traditional`], the formulation that the paper revises; [`HertzMean`], quadrature over a
//! contact ellipse, and [`friction_power`]; [`pitch_angle`], the methods of the paper's Table 1;
//! [`operating`], contact load, contact angle and ellipse of the paper's screw; [`figures`], the data
//! of its Figures 6 to 13; [`published`], its printed numbers against computed ones.
//!
//! Frame: screw turning by `speed` about its axis `Z` without translation; nut translating without
//! rotation; right-hand thread. At the contact with the screw (inner, upper sign in the paper) `x`
//! is the tangent of the ball's path, at the nut (outer, lower sign) its reverse;
//! `y = (0, sin alpha, cos alpha)` in (tangent, normal, binormal); `z` points to the ball's centre.
//! Slip is ball minus raceway.

pub mod figures;
pub mod operating;
pub mod pitch_angle;
mod power;
pub mod published;
mod revised;
mod rigid_body;
mod traditional;

pub use power::{HertzMean, MeanSlip, friction_power, least_friction_power, mean_slip};
pub use revised::Revised;
pub use rigid_body::RigidBody;
pub use traditional::Traditional;

use std::f64::consts::FRAC_PI_2;

use crate::error::ReferenceError;

/// Which raceway a contact is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Raceway {
    /// Screw: inner contact, upper sign.
    Screw,
    /// Nut: outer contact, lower sign.
    Nut,
}

impl Raceway {
    /// Both.
    pub const BOTH: [Self; 2] = [Self::Screw, Self::Nut];

    /// The paper's upper (+1) or lower (-1) sign.
    #[must_use]
    pub const fn sign(self) -> f64 {
        match self {
            Self::Screw => 1.0,
            Self::Nut => -1.0,
        }
    }
}

/// Geometry and state of one ball, in metres, radians, rad/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KinematicsInput {
    /// `D`.
    pub ball_diameter: f64,
    /// `r_m`.
    pub pitch_radius: f64,
    /// `psi`.
    pub lead_angle: f64,
    /// `r_i`.
    pub groove_radius_screw: f64,
    /// `r_o`.
    pub groove_radius_nut: f64,
    /// `alpha_i`.
    pub contact_angle_screw: f64,
    /// `alpha_o`.
    pub contact_angle_nut: f64,
    /// `beta`.
    pub pitch_angle: f64,
    /// `beta'`.
    pub yaw_angle: f64,
    /// `r'_i`.
    pub rolling_radius_screw: f64,
    /// `r'_o`.
    pub rolling_radius_nut: f64,
    /// `omega`, speed of the screw.
    pub speed: f64,
    /// `a_H` at the screw.
    pub semi_major_screw: f64,
    /// `b_H` at the screw.
    pub semi_minor_screw: f64,
    /// `a_H` at the nut.
    pub semi_major_nut: f64,
    /// `b_H` at the nut.
    pub semi_minor_nut: f64,
}

/// One contact of a [`KinematicsInput`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactInput {
    /// `r_k`.
    pub groove_radius: f64,
    /// `alpha_k`.
    pub contact_angle: f64,
    /// `r'_k`.
    pub rolling_radius: f64,
    /// `a_H`.
    pub semi_major: f64,
    /// `b_H`.
    pub semi_minor: f64,
}

impl KinematicsInput {
    /// The numbers of one contact.
    #[must_use]
    pub const fn contact(&self, raceway: Raceway) -> ContactInput {
        match raceway {
            Raceway::Screw => ContactInput {
                groove_radius: self.groove_radius_screw,
                contact_angle: self.contact_angle_screw,
                rolling_radius: self.rolling_radius_screw,
                semi_major: self.semi_major_screw,
                semi_minor: self.semi_minor_screw,
            },
            Raceway::Nut => ContactInput {
                groove_radius: self.groove_radius_nut,
                contact_angle: self.contact_angle_nut,
                rolling_radius: self.rolling_radius_nut,
                semi_major: self.semi_major_nut,
                semi_minor: self.semi_minor_nut,
            },
        }
    }

    /// Advance of the helix per radian, `L / (2 pi) = r_m tan psi`, m.
    #[must_use]
    pub fn advance(&self) -> f64 {
        self.pitch_radius * self.lead_angle.tan()
    }

    /// Checks that every number lies where the model exists.
    ///
    /// # Errors
    /// The first field that does not.
    pub fn validate(&self) -> Result<(), ReferenceError> {
        let check = |field, value: f64, holds: bool, requirement: &str| {
            if value.is_finite() && holds {
                Ok(())
            } else {
                Err(ReferenceError::input(
                    field,
                    format!("{value} must be {requirement}"),
                ))
            }
        };
        let positive = |field, value: f64| check(field, value, value > 0.0, "positive");
        positive("ball_diameter", self.ball_diameter)?;
        positive("pitch_radius", self.pitch_radius)?;
        let lead_angle = self.lead_angle;
        check(
            "lead_angle",
            lead_angle,
            lead_angle.abs() < FRAC_PI_2,
            "within -pi/2 to pi/2",
        )?;
        let half = 0.5 * self.ball_diameter;
        for (field, radius) in [
            ("groove_radius_screw", self.groove_radius_screw),
            ("groove_radius_nut", self.groove_radius_nut),
        ] {
            check(field, radius, radius >= half, "at least the ball's radius")?;
        }
        for (field, angle) in [
            ("contact_angle_screw", self.contact_angle_screw),
            ("contact_angle_nut", self.contact_angle_nut),
            ("pitch_angle", self.pitch_angle),
            ("yaw_angle", self.yaw_angle),
        ] {
            check(
                field,
                angle,
                angle.abs() <= FRAC_PI_2,
                "within -pi/2 to pi/2",
            )?;
        }
        positive("rolling_radius_screw", self.rolling_radius_screw)?;
        positive("rolling_radius_nut", self.rolling_radius_nut)?;
        check("speed", self.speed, true, "a finite number")?;
        for (major_field, major, minor_field, minor) in [
            (
                "semi_major_screw",
                self.semi_major_screw,
                "semi_minor_screw",
                self.semi_minor_screw,
            ),
            (
                "semi_major_nut",
                self.semi_major_nut,
                "semi_minor_nut",
                self.semi_minor_nut,
            ),
        ] {
            check(
                major_field,
                major,
                major >= 0.0 && major < half,
                "0 or more, and less than the ball's radius",
            )?;
            check(
                minor_field,
                minor,
                minor >= 0.0 && minor <= major,
                "0 or more, and not above the semi-major axis",
            )?;
        }
        for (raceway, angle_field, radius_field) in [
            (
                Raceway::Screw,
                "contact_angle_screw",
                "rolling_radius_screw",
            ),
            (Raceway::Nut, "contact_angle_nut", "rolling_radius_nut"),
        ] {
            let contact = self.contact(raceway);
            check(
                angle_field,
                contact.contact_angle,
                revised::surface_speed_factor(self, raceway) > 0.0,
                "less than a right angle from the axis about which the ball turns",
            )?;
            check(
                radius_field,
                contact.rolling_radius,
                revised::rolling_path(self, raceway) > 0.0,
                "small enough that the ball's path does not fold past the axis of the screw",
            )?;
        }
        Ok(())
    }
}

/// Slip of one contact at its centre, and the ratios that characterise it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactKinematics {
    /// m/s; eq. (31).
    pub rolling_slip: f64,
    /// m/s; eq. (32).
    pub side_slip: f64,
    /// rad/s; eq. (34).
    pub spin: f64,
    /// m/s; magnitude of (36).
    pub entrainment_speed: f64,
    /// rad; (37) with atan2 of the reversed components, the same for either sense of rotation.
    pub entrainment_angle: f64,
    /// (38).
    pub slide_to_roll: f64,
    /// rad, (-pi, pi]; (39) with atan2, for a positive speed; `None` where there is no slip.
    pub slide_angle: Option<f64>,
    /// (40), with the sign of the spin for a positive speed.
    pub spin_to_roll: f64,
}

/// The kinematics of one ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallKinematics {
    /// `omega_m`, rad/s; eq. (22).
    pub orbital_speed: f64,
    /// `omega_R`, rad/s; eq. (23), corrected.
    pub spin_speed: f64,
    /// Contact with the screw.
    pub screw: ContactKinematics,
    /// Contact with the nut.
    pub nut: ContactKinematics,
}

impl BallKinematics {
    /// One contact.
    #[must_use]
    pub const fn contact(&self, raceway: Raceway) -> &ContactKinematics {
        match raceway {
            Raceway::Screw => &self.screw,
            Raceway::Nut => &self.nut,
        }
    }
}
