//! The helix that ball centres follow, and the section of a gothic-arch groove normal to it.

use crate::error::{Error, Range, attempt, in_range};
use crate::math::constant;
use core::f32::consts::{FRAC_PI_2, TAU};

/// Radius of the cylinder on which the balls of a screw or a bearing run, m: 1e-3 to 0.5.
pub const PITCH_RADIUS: Range = Range::new(1e-3, 0.5);

/// Lead of a ball screw, m: 0 to 0.2; 0 is a ball bearing.
pub const LEAD: Range = Range::new(0.0, 0.2);

/// Ball radius, m: 1e-4 to 0.05. In a ball screw it also stays below 0.9 of the pitch radius.
pub const BALL_RADIUS: Range = Range::new(1e-4, 0.05);

/// Smallest conformity `groove_radius / (2 ball_radius)`: at 0.5 ball and groove coincide; catalogues have 0.505 to 0.58.
pub const SMALLEST_CONFORMITY: f32 = 0.5005;

/// Largest conformity: the groove radius is the ball's diameter.
pub const LARGEST_CONFORMITY: f32 = 1.0;

/// Largest nominal contact angle, rad (89 degrees).
pub const LARGEST_CONTACT_ANGLE: f32 = 1.5533;

/// Smallest `A = 1 + zeta kappa (H - r_s cos(beta))` of a groove: at 0 its surface folds, and curvatures have an error of `6e-8 / A`.
pub const SMALLEST_AREA: f32 = 1e-4;

/// Angle between the contact normal and the plane normal to the axis, through its cosine and sine.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ContactAngle {
    /// Cosine of the contact angle, 0 to 1.
    pub cos: f32,
    /// Sine of the contact angle, 0 to 1.
    pub sin: f32,
}

impl ContactAngle {
    /// Cosine and sine of `angle`, rad, useful range 0 to pi/2.
    #[inline]
    #[must_use]
    pub const fn new(angle: f32) -> Self {
        let (sin, cos) = constant::sin_cos(angle);
        Self { cos, sin }
    }

    /// As [`ContactAngle::new`] with the range 0 to pi/2 checked.
    pub const fn checked(angle: f32) -> Result<Self, Error> {
        let angle = attempt!(in_range("contact_angle", angle, 0.0, FRAC_PI_2));
        Ok(Self::new(angle))
    }
}

/// Which of the two grooves a ball runs between.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Groove {
    /// Groove of the screw shaft, inside the ball path (the inner race of a bearing).
    Screw,
    /// Groove of the nut, outside the ball path (the outer race of a bearing).
    Nut,
}

impl Groove {
    /// The papers' `zeta`: +1 for the screw, -1 for the nut.
    #[inline]
    pub const fn sign(self) -> f32 {
        match self {
            Self::Screw => 1.0,
            Self::Nut => -1.0,
        }
    }
}

/// The helix of the ball centres, by its curvature and torsion.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct HelixPath {
    /// Curvature `cos²(alpha) / r_m`, 1/m.
    pub curvature: f32,
    /// Torsion `sin(alpha) cos(alpha) / r_m`, 1/m; positive for a right-hand thread.
    pub torsion: f32,
}

impl HelixPath {
    /// Curvature and torsion from the lead: `r_m / (r_m² + h²)` and `h / (r_m² + h²)` with the reduced lead `h = lead / (2 pi)`, m: no loss of digits
    /// at any lead. Cost: two divisions, 5 other operations.
    #[must_use]
    pub const fn from_lead(pitch_radius: f32, lead: f32) -> Self {
        let reduced = lead * (1.0 / TAU);
        // Scaled by the pitch radius: no square overflows or underflows at any unit of length.
        let tangent = reduced / pitch_radius;
        let curvature = 1.0 / (pitch_radius * (1.0 + tangent * tangent));
        Self {
            curvature,
            torsion: curvature * tangent,
        }
    }

    /// Curvature and torsion from the lead angle `alpha`, rad, 0 to pi/2.
    #[must_use]
    pub const fn from_lead_angle(pitch_radius: f32, lead_angle: f32) -> Self {
        let (sin, cos) = constant::sin_cos(lead_angle);
        let scaled = cos / pitch_radius;
        Self {
            curvature: cos * scaled,
            torsion: sin * scaled,
        }
    }

    /// As [`HelixPath::from_lead_angle`] with both fields checked.
    ///
    /// # Errors
    /// [`Error`] naming `pitch_radius` (1e-9 to 1e9, any unit of length) or `lead_angle` (0 to pi/2).
    pub const fn checked_from_lead_angle(
        pitch_radius: f32,
        lead_angle: f32,
    ) -> Result<Self, Error> {
        attempt!(in_range("pitch_radius", pitch_radius, 1e-9, 1e9));
        attempt!(in_range("lead_angle", lead_angle, 0.0, FRAC_PI_2));
        Ok(Self::from_lead_angle(pitch_radius, lead_angle))
    }
}

/// How a drawing gives the size of a groove.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum GrooveSize {
    /// Conformity `f_s = groove_radius / (2 ball_radius)` (Bertolino et al. 2023, eq. (2)), [`SMALLEST_CONFORMITY`] to
    /// [`LARGEST_CONFORMITY`]. The better conditioned of the two.
    Conformity(f32),
    /// Groove radius, m, within the same bounds relative to the ball.
    Radius(f32),
}

impl GrooveSize {
    /// Groove radius and its excess over the ball radius, m; checked. The subtractions are exact (Sterbenz).
    pub(super) const fn radius_and_clearance(self, ball_radius: f32) -> Result<(f32, f32), Error> {
        let (least, largest) = (SMALLEST_CONFORMITY, LARGEST_CONFORMITY);
        let diameter = 2.0 * ball_radius;
        match self {
            Self::Conformity(conformity) => {
                attempt!(in_range("conformity", conformity, least, largest));
                Ok((conformity * diameter, (conformity - 0.5) * diameter))
            }
            Self::Radius(radius) => {
                let (least, largest) = (least * diameter, largest * diameter);
                attempt!(in_range("groove_radius", radius, least, largest));
                Ok((radius, radius - ball_radius))
            }
        }
    }
}

/// Section of one half of a gothic-arch groove in the plane normal to the ball path: a circle whose
/// centre is offset from the nominal ball centre by `H` along the normal and `L` along the binormal.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct GrooveProfile {
    /// Radius `r_s` of the profile circle, m.
    pub groove_radius: f32,
    /// Offset `H` of its centre along the path's normal, m; 0 for a circular groove.
    pub offset_h: f32,
    /// Offset `L` of its centre along the path's binormal, m; 0 for a circular groove.
    pub offset_l: f32,
}

impl GrooveProfile {
    /// Offsets for a nominal contact angle `beta_0`: `H = D_s cos(beta_0)`, `L = D_s sin(beta_0)` (Bertolino et al. 2023, eqs. (3),
    /// (4)), from the groove radius `r_s`, m, and its excess `D_s = r_s - r_b`, m, whose difference would lose its digits. Unchecked.
    #[must_use]
    pub const fn new(groove_radius: f32, clearance: f32, contact_angle: ContactAngle) -> Self {
        Self {
            groove_radius,
            offset_h: clearance * contact_angle.cos,
            offset_l: clearance * contact_angle.sin,
        }
    }
}
