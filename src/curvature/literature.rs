//! First curvature by the formula of the catalogues, and that of a circular groove.

use super::gothic_arch::GothicArch;
use crate::geometry::{BallScrew, ContactAngle, Groove, HelixPath};

/// Literature formula for the first principal curvature:
/// `kappa1 = zeta cos(beta) / (r_m - zeta r_b cos(beta))`, `zeta` = +1 screw, -1 nut
/// (Bertolino et al. 2023, eq. (27), (28)). It ignores the lead; at a lead angle of 45 degrees it is wrong by a factor of two.
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

    /// Constants of one groove of a validated design; for constants too.
    #[must_use]
    pub const fn of(design: &BallScrew, groove: Groove) -> Self {
        Self::new(groove, design.pitch_radius(), design.ball_radius())
    }

    /// First principal curvature, 1/m. Cost: one division, 2 other operations.
    #[inline]
    pub const fn first(&self, contact_angle: ContactAngle) -> f32 {
        contact_angle.cos / (self.signed_pitch_radius - self.ball_radius * contact_angle.cos)
    }
}

/// First principal curvature of a circular groove (`H = L = 0`):
/// `kappa1 = cos(beta) cos²(alpha) / (zeta r_m - r_s cos(beta) cos²(alpha))`
/// (Bertolino et al. 2023, eq. (25), (26)).
///
/// For a gothic arch the error is at most 9.5e-3 on the 31 catalogue sizes (contact angles 0 to 70 degrees, mean 4.3e-3), up to 0.34 at lead and
/// contact angles of 80 degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CircularGrooveCurvature {
    /// `zeta / kappa`, the path's radius of curvature with the groove's sign, m.
    signed_path_radius: f32,
    groove_radius: f32,
}

impl CircularGrooveCurvature {
    /// Constants of one groove from its path and its groove radius `r_s`, m.
    #[inline]
    #[must_use]
    pub const fn new(groove: Groove, path: &HelixPath, groove_radius: f32) -> Self {
        Self {
            signed_path_radius: groove.sign() / path.curvature,
            groove_radius,
        }
    }

    /// Constants of one groove of a validated design; for constants too.
    #[must_use]
    pub const fn of(design: &BallScrew, groove: Groove) -> Self {
        Self::new(groove, design.path(), design.profile(groove).groove_radius)
    }

    /// First principal curvature, 1/m. Cost: one division, 2 other operations: after a division by `cos²(alpha)` the lead costs nothing.
    #[inline]
    pub const fn first(&self, contact_angle: ContactAngle) -> f32 {
        contact_angle.cos / (self.signed_path_radius - self.groove_radius * contact_angle.cos)
    }

    /// Second principal curvature, 1/m: `-1 / r_s`, within 2.6e-5 of the gothic arch on the 31 catalogue sizes.
    #[inline]
    pub const fn second(&self) -> f32 {
        -1.0 / self.groove_radius
    }
}

impl From<&GothicArch> for CircularGrooveCurvature {
    fn from(arch: &GothicArch) -> Self {
        Self::new(arch.groove(), &arch.path(), arch.groove_radius())
    }
}
