//! Geometry and state of one ball, and where the model exists.

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
    pub fn advance(&self) -> f64 {
        self.pitch_radius * self.lead_angle.tan()
    }

    /// `cos beta cos beta' cos alpha_k + sin beta sin alpha_k`, the last factor of (22).
    pub fn surface_speed_factor(&self, raceway: Raceway) -> f64 {
        let alpha = self.contact(raceway).contact_angle;
        let (sin_beta, cos_beta) = self.pitch_angle.sin_cos();
        cos_beta * self.yaw_angle.cos() * alpha.cos() + sin_beta * alpha.sin()
    }

    /// `(r_m -+ r'_k cos alpha_k) cos psi + L / (2 pi) sin psi`, the other factor of (22), m.
    pub(super) fn rolling_path(&self, raceway: Raceway) -> f64 {
        let contact = self.contact(raceway);
        let (sin_psi, cos_psi) = self.lead_angle.sin_cos();
        (self.pitch_radius - raceway.sign() * contact.rolling_radius * contact.contact_angle.cos())
            * cos_psi
            + self.advance() * sin_psi
    }

    /// Checks that every number lies where the model exists.
    pub fn validate(&self) -> Result<(), ReferenceError> {
        self.check_lengths_and_angles()?;
        for raceway in Raceway::BOTH {
            self.check_ellipse(raceway)?;
        }
        for raceway in Raceway::BOTH {
            self.check_rolling(raceway)?;
        }
        Ok(())
    }

    fn check_lengths_and_angles(&self) -> Result<(), ReferenceError> {
        let positive = |field, value: f64| check(field, value, value > 0.0, "positive");
        let right_angle = "within -pi/2 to pi/2";
        positive("ball_diameter", self.ball_diameter)?;
        positive("pitch_radius", self.pitch_radius)?;
        let lead_angle = self.lead_angle;
        check(
            "lead_angle",
            lead_angle,
            lead_angle.abs() < FRAC_PI_2,
            right_angle,
        )?;
        for (field, radius) in [
            ("groove_radius_screw", self.groove_radius_screw),
            ("groove_radius_nut", self.groove_radius_nut),
        ] {
            let fits = radius >= 0.5 * self.ball_diameter;
            check(field, radius, fits, "at least the ball's radius")?;
        }
        for (field, angle) in [
            ("contact_angle_screw", self.contact_angle_screw),
            ("contact_angle_nut", self.contact_angle_nut),
            ("pitch_angle", self.pitch_angle),
            ("yaw_angle", self.yaw_angle),
        ] {
            check(field, angle, angle.abs() <= FRAC_PI_2, right_angle)?;
        }
        positive("rolling_radius_screw", self.rolling_radius_screw)?;
        positive("rolling_radius_nut", self.rolling_radius_nut)?;
        check("speed", self.speed, true, "a finite number")
    }

    fn check_ellipse(&self, raceway: Raceway) -> Result<(), ReferenceError> {
        let [major_field, minor_field] = match raceway {
            Raceway::Screw => ["semi_major_screw", "semi_minor_screw"],
            Raceway::Nut => ["semi_major_nut", "semi_minor_nut"],
        };
        let ContactInput {
            semi_major: major,
            semi_minor: minor,
            ..
        } = self.contact(raceway);
        check(
            major_field,
            major,
            major >= 0.0 && major < 0.5 * self.ball_diameter,
            "0 or more, and less than the ball's radius",
        )?;
        check(
            minor_field,
            minor,
            minor >= 0.0 && minor <= major,
            "0 or more, and not above the semi-major axis",
        )
    }

    /// The ball can roll on the raceway: both factors of (22) are positive.
    fn check_rolling(&self, raceway: Raceway) -> Result<(), ReferenceError> {
        let [angle_field, radius_field] = match raceway {
            Raceway::Screw => ["contact_angle_screw", "rolling_radius_screw"],
            Raceway::Nut => ["contact_angle_nut", "rolling_radius_nut"],
        };
        let contact = self.contact(raceway);
        check(
            angle_field,
            contact.contact_angle,
            self.surface_speed_factor(raceway) > 0.0,
            "less than a right angle from the axis about which the ball turns",
        )?;
        check(
            radius_field,
            contact.rolling_radius,
            self.rolling_path(raceway) > 0.0,
            "small enough that the ball's path does not fold past the axis of the screw",
        )
    }
}

fn check(
    field: &'static str,
    value: f64,
    holds: bool,
    requirement: &str,
) -> Result<(), ReferenceError> {
    if value.is_finite() && holds {
        Ok(())
    } else {
        Err(ReferenceError::input(
            field,
            format!("{value} must be {requirement}"),
        ))
    }
}
