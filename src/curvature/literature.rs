//! The formula of catalogues and of ISO 3408-5: a ball bearing's, without lead.

use crate::geometry::{BallScrew, ContactAngle, Groove};

/// Literature formula for the first principal curvature:
/// `kappa1 = zeta cos(beta) / (r_m - zeta r_b cos(beta))`, `zeta` = +1 screw, -1 nut
/// (Bertolino et al. 2023, eq. (27), (28)).
///
/// It ignores the lead; at a lead angle of 45 degrees it is wrong by a factor of two. It stands here
/// as the unit of cost and because it is what most programs use.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LiteratureCurvature {
    signed_pitch_radius: f32,
    ball_radius: f32,
}

impl LiteratureCurvature {
    /// Constants of one groove from the pitch radius `r_m` and the ball radius `r_b`, m.
    #[inline]
    #[must_use]
    pub const fn new(groove: Groove, pitch_radius: f32, ball_radius: f32) -> Self {
        Self {
            signed_pitch_radius: groove.sign() * pitch_radius,
            ball_radius,
        }
    }

    /// Constants of one groove of a validated design; a constant can take them.
    #[must_use]
    pub const fn of(design: &BallScrew, groove: Groove) -> Self {
        Self::new(groove, design.pitch_radius(), design.ball_radius())
    }

    /// First principal curvature, 1/m. Cost: one division, 2 other operations.
    #[inline]
    #[must_use]
    pub const fn first(&self, contact_angle: ContactAngle) -> f32 {
        contact_angle.cos / (self.signed_pitch_radius - self.ball_radius * contact_angle.cos)
    }
}
