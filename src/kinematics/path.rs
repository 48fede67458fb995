//! What the set-up fixes: helix, axis of rotation and grooves, checked once.

use super::parameters::{EllipticContact, KinematicsParameters};
use crate::error::{Error, Range, attempt, in_range};
use crate::math::constant;
use crate::ranges;
use core::f32::consts::FRAC_PI_2;

/// Diameter of a ball, m.
const BALL_DIAMETER: Range = Range::new(
    2.0 * ranges::BALL_RADIUS.minimum,
    2.0 * ranges::BALL_RADIUS.maximum,
);

/// Hertz' half-space holds for ellipses small beside the ball: the share of the ball's radius that
/// the semi-major axis may have.
#[doc(hidden)]
pub const LARGEST_ELLIPSE: f32 = 0.3;
/// Constants of one groove.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct GroovePath {
    /// `q / r'`: path radius over rolling radius.
    pub path_over_rolling: f32,
    /// `r'`, m.
    pub rolling_radius: f32,
    /// `r' - D/2`, m; exact in f32 because the two are within a factor of two (Sterbenz).
    pub rolling_excess: f32,
    /// Half the curvature of the deformed surface, `1 / (2 R)`, 1/m; eq. (15).
    pub half_curvature: f32,
    /// Sagitta of ball and deformed surface over the ellipse, `D/2 - S(0)` with `S` of eq. (14), as a polynomial in `(a / (D/2))^2`.
    pub deficit: [f32; 3],
}

/// `z^4` for `z` from 0 to 0.09, the square of [`LARGEST_ELLIPSE`], by `z`, `z^2` and `z^3`: what Chebyshev's
/// polynomial of the fourth degree leaves, with its first zero at 0. Within 6e-7, which is 1e-8 ball radii of sagitta.
#[doc(hidden)]
pub const FOURTH_POWER: [f32; 3] = {
    // Half the interval, and its middle.
    let half = 0.09 / (1.0 + 0.923_879_5);
    let middle = 0.09 - half;
    [
        4.0 * middle * middle * middle - 2.0 * half * half * middle,
        half * half - 6.0 * middle * middle,
        4.0 * middle,
    ]
};

impl GroovePath {
    const fn new(
        path_radius: f32,
        ball_radius: f32,
        groove_radius: f32,
        rolling_radius: f32,
    ) -> Self {
        let ball_diameter = 2.0 * ball_radius;
        // rho = (D/2) / R = (2 r + D) / (4 r); 1 - rho from 2 r - D, which is exact for
        // D/2 <= 2 r <= 2 D: conformity would otherwise lose 1 / (2 r / D - 1) = 20 fold.
        let gap = (2.0 * groove_radius - ball_diameter) / (4.0 * groove_radius);
        let rho = (2.0 * groove_radius + ball_diameter) / (4.0 * groove_radius);
        let rho_2 = rho * rho;
        let rho_4 = rho_2 * rho_2;
        // D/2 - S(0) = [u - sqrt(u^2 - a^2)] - [R - sqrt(R^2 - a^2)] from (14) by 1 - sqrt(1 - z) =
        // z/2 + z^2/8 + z^3/16 + 5 z^4/128 + ..., and 1 - rho^(2n-1) = (1 - rho)(1 + rho + ...).
        let sum_3 = 1.0 + rho + rho_2;
        let sum_5 = sum_3 + rho_2 * rho + rho_4;
        let sum_7 = sum_5 + rho_4 * rho + rho_4 * rho_2;
        let scale = ball_radius * gap;
        let fourth = sum_7 * 0.0390625;
        Self {
            path_over_rolling: path_radius / rolling_radius,
            rolling_radius,
            rolling_excess: rolling_radius - ball_radius,
            half_curvature: 0.5 * rho / ball_radius,
            deficit: [
                scale * (0.5 + fourth * FOURTH_POWER[0]),
                scale * (sum_3 * 0.125 + fourth * FOURTH_POWER[1]),
                scale * (sum_5 * 0.0625 + fourth * FOURTH_POWER[2]),
            ],
        }
    }
}

/// Constants of the ball: helix, axis of rotation, both grooves.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Path {
    /// `sin psi`.
    pub sin_lead: f32,
    /// `cos psi`.
    pub cos_lead: f32,
    /// `q = r_m / cos psi`, m.
    pub radius: f32,
    /// `q / 2`, m.
    pub half_radius: f32,
    /// `h = cos beta cos beta'`: direction of the axis of rotation against the binormal.
    pub axis_binormal: f32,
    /// `t = cos beta sin beta'`: along the path.
    pub axis_tangent: f32,
    /// `sin beta`: against the normal.
    pub axis_normal: f32,
    /// `1 / (D/2)^2`, 1/m^2.
    pub inverse_ball_radius_squared: f32,
    /// Largest semi-major axis, m.
    pub largest_ellipse: f32,
    pub screw: GroovePath,
    pub nut: GroovePath,
}

impl Path {
    pub const fn new(parameters: &KinematicsParameters) -> Result<Self, Error> {
        let p = parameters;
        let diameter = attempt!(BALL_DIAMETER.checked("ball_diameter", p.ball_diameter));
        let pitch_radius = attempt!(ranges::PITCH_RADIUS.checked("pitch_radius", p.pitch_radius));
        let lead_angle = attempt!(in_range("lead_angle", p.lead_angle, -1.2, 1.2));
        let ball_radius = 0.5 * diameter;
        let (least, most) = (ball_radius, 2.0 * diameter);
        let (screw, nut) = (p.groove_radius_screw, p.groove_radius_nut);
        let groove_screw = attempt!(in_range("groove_radius_screw", screw, least, most));
        let groove_nut = attempt!(in_range("groove_radius_nut", nut, least, most));
        let (least, most) = (-FRAC_PI_2, FRAC_PI_2);
        let (screw, nut) = (p.contact_angle_screw, p.contact_angle_nut);
        attempt!(in_range("contact_angle_screw", screw, least, most));
        attempt!(in_range("contact_angle_nut", nut, least, most));
        let pitch_angle = attempt!(in_range("pitch_angle", p.pitch_angle, least, most));
        let yaw_angle = attempt!(in_range("yaw_angle", p.yaw_angle, -0.5, 0.5));
        let (least, most) = (0.5 * ball_radius, diameter);
        let (screw, nut) = (p.rolling_radius_screw, p.rolling_radius_nut);
        let rolling_screw = attempt!(in_range("rolling_radius_screw", screw, least, most));
        let rolling_nut = attempt!(in_range("rolling_radius_nut", nut, least, most));
        let largest_ellipse = LARGEST_ELLIPSE * ball_radius;
        let (major, minor) = (p.semi_major_screw, p.semi_minor_screw);
        let major = attempt!(in_range("semi_major_screw", major, 0.0, largest_ellipse));
        attempt!(in_range("semi_minor_screw", minor, 0.0, major));
        let (major, minor) = (p.semi_major_nut, p.semi_minor_nut);
        let major = attempt!(in_range("semi_major_nut", major, 0.0, largest_ellipse));
        attempt!(in_range("semi_minor_nut", minor, 0.0, major));

        let (sin_lead, cos_lead) = constant::sin_cos(lead_angle);
        let (sin_pitch, cos_pitch) = constant::sin_cos(pitch_angle);
        let (sin_yaw, cos_yaw) = constant::sin_cos(yaw_angle);
        let radius = pitch_radius / cos_lead;
        Ok(Self {
            sin_lead,
            cos_lead,
            radius,
            half_radius: 0.5 * radius,
            axis_binormal: cos_pitch * cos_yaw,
            axis_tangent: cos_pitch * sin_yaw,
            axis_normal: sin_pitch,
            inverse_ball_radius_squared: 1.0 / (ball_radius * ball_radius),
            largest_ellipse,
            screw: GroovePath::new(radius, ball_radius, groove_screw, rolling_screw),
            nut: GroovePath::new(radius, ball_radius, groove_nut, rolling_nut),
        })
    }

    /// True where contact angle and ellipse are within their own ranges.
    #[inline]
    pub fn accepts(&self, contact: EllipticContact) -> bool {
        // Positive numbers are in the order of their bits, with NaN and negative numbers beyond them: the lower
        // bound needs no comparison.
        let (semi_major, semi_minor) = (contact.semi_major.to_bits(), contact.semi_minor.to_bits());
        contact.contact_angle.abs().to_bits() <= FRAC_PI_2.to_bits()
            && (semi_major <= self.largest_ellipse.to_bits() && semi_minor <= semi_major
                || self.accepts_zeros(contact))
    }

    /// True where the ellipse is within its range, zeros of either sign included.
    #[cold]
    #[inline(never)]
    fn accepts_zeros(&self, contact: EllipticContact) -> bool {
        // Written so that a comparison with NaN refuses.
        contact.semi_major <= self.largest_ellipse
            && contact.semi_minor <= contact.semi_major
            && contact.semi_minor >= 0.0
    }
}
