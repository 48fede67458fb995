//! Motion of one ball, slip of its two contacts and the ratios that characterise it.

use super::input::Raceway;

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
    pub const fn contact(&self, raceway: Raceway) -> &ContactKinematics {
        match raceway {
            Raceway::Screw => &self.screw,
            Raceway::Nut => &self.nut,
        }
    }
}
