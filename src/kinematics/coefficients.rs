//! Constants of one contact, and what follows from them.

use super::parameters::{EllipticContact, GroovePath, Path};
use super::{ContactSlip, abs, sane_speed};
use crate::math;

/// Which raceway; carries the sign that (3) to (40) print as upper and lower.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Groove {
    /// Inner contact, upper sign.
    Screw,
    /// Outer contact, lower sign.
    Nut,
}

impl Groove {
    #[inline]
    const fn sign(self) -> f32 {
        match self {
            Self::Screw => 1.0,
            Self::Nut => -1.0,
        }
    }
}

/// A contact angle, resolved against path and axis of rotation.
pub(super) struct Direction {
    pub sine: f32,
    pub cosine: f32,
    /// `A_k / r'_k`.
    pub reach: f32,
    /// `b_k`.
    pub grip: f32,
    /// `n_k`.
    pub lean: f32,
    /// Semi-axes of the ellipse, m.
    semi_major: f32,
    semi_minor: f32,
}

/// The ratios of Alberdi et al., eqs. (37) to (40), at the centre of a contact.
///
/// They depend neither on the speed nor on its sign.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SlipRatios {
    /// Angle from the direction of rolling to the entrainment velocity (`gamma`), rad.
    pub entrainment_angle: f32,
    /// Sliding speed over entrainment speed (`SRR`).
    pub slide_to_roll: f32,
    /// Angle from the direction of rolling to the slip (`phi`), rad, in (-pi, pi], for a positive
    /// speed of the screw. 0 where `slide_to_roll` is 0: no slip has no direction.
    pub slide_angle: f32,
    /// Spin times the ellipse's mean semi-axis `sqrt(a b)` over entrainment speed (`S_p`), with the
    /// sign of the spin for a positive speed.
    pub spin_to_roll: f32,
}

/// Slip at one point of a contact ellipse, m/s.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SlipVector {
    /// Along the direction of rolling (`x`): rolling slip and the part of spin.
    pub rolling: f32,
    /// Across it (`y`): side slip and the part of spin.
    pub side: f32,
}

/// Constants of one contact per rad/s of the screw.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ContactCoefficients {
    /// Rolling slip at the centre, m.
    pub(super) rolling_slip: f32,
    /// Side slip at the centre, m.
    pub(super) side_slip: f32,
    /// Spin, 1.
    pub(super) spin: f32,
    entrainment_rolling: f32,
    entrainment_side: f32,
    entrainment_speed: f32,
    /// Rolling slip per metre that the surface lies inside the rolling radius, 1.
    rolling_gradient: f32,
    /// Side slip per metre from the ball's centre, 1.
    side_gradient: f32,
    /// `S_k` at the centre, m.
    pub(super) distance: f32,
    /// `1 / (2 R_k)`, 1/m.
    half_curvature: f32,
    pub(super) semi_major: f32,
    pub(super) semi_minor: f32,
}

impl Path {
    /// Resolves one contact.
    #[inline]
    pub fn direction(
        &self,
        groove_path: &GroovePath,
        contact: EllipticContact,
        groove: Groove,
    ) -> Direction {
        let (sine, cosine) = math::sin_cos(contact.contact_angle);
        Direction {
            sine,
            cosine,
            reach: groove_path.path_over_rolling - groove.sign() * self.cos_lead * cosine,
            grip: self.axis_binormal * cosine + self.axis_normal * sine,
            lean: self.axis_binormal * sine - self.axis_normal * cosine,
            semi_major: contact.semi_major,
            semi_minor: contact.semi_minor,
        }
    }

    /// Constants of one contact: `relative_speed` is `omega_k / omega` (frame of the orbiting ball
    /// against the raceway), `spin_speed` is `omega_R / omega`.
    #[inline]
    pub fn fold(
        &self,
        groove_path: &GroovePath,
        direction: &Direction,
        relative_speed: f32,
        groove: Groove,
        spin_speed: f32,
    ) -> (ContactSlip, ContactCoefficients) {
        // Symbols of Alberdi et al.: w = omega_k / omega, S, psi, alpha, beta, beta'.
        let w = relative_speed;
        let turning = groove.sign() * spin_speed;
        let z = direction.semi_major * direction.semi_major * self.inverse_ball_radius_squared;
        let [c1, c2, c3, c4] = groove_path.deficit;
        let deficit = z * (c1 + z * (c2 + z * (c3 + z * c4)));
        // r' - S: two small numbers added, in place of the difference of two speeds in (31).
        let inside = groove_path.rolling_excess + deficit;
        let distance = groove_path.rolling_radius - inside;

        let rolling_gradient = w * groove_path.path_over_rolling;
        let climb = w * self.sin_lead;
        let swerve = turning * self.axis_tangent;
        let rolling_slip = rolling_gradient * inside;
        let side_gradient = climb + swerve;
        let side_slip = side_gradient * distance;
        let spin = w * self.cos_lead * direction.sine - turning * direction.lean;

        // (36): half the sum of both surfaces' velocities relative to the moving contact.
        let across = groove.sign() * self.cos_lead * direction.cosine;
        let entrainment_rolling = 0.5 * w * (self.radius + distance * (direction.reach - across));
        let entrainment_side = 0.5 * distance * (climb - swerve);
        let entrainment_speed = math::sqrt(
            entrainment_rolling * entrainment_rolling + entrainment_side * entrainment_side,
        );
        (
            ContactSlip {
                rolling_slip,
                side_slip,
                spin,
                entrainment_speed,
            },
            ContactCoefficients {
                rolling_slip,
                side_slip,
                spin,
                entrainment_rolling,
                entrainment_side,
                entrainment_speed,
                rolling_gradient,
                side_gradient,
                distance,
                half_curvature: groove_path.half_curvature,
                semi_major: direction.semi_major,
                semi_minor: direction.semi_minor,
            },
        )
    }
}

impl ContactCoefficients {
    /// The speed-free ratios at the contact's centre.
    ///
    /// `entrainment_angle = atan2(-v_e,y, -v_e,x)`, `slide_to_roll = |v_s| / |v_e|`,
    /// `slide_angle = atan2(side_slip, rolling_slip)`,
    /// `spin_to_roll = spin sqrt(a b) / |v_e|`: Alberdi et al., eqs. (37) to (40), with `v_e` of (36).
    /// **Corrected:** (37) and (39) print an arc tangent of a quotient, which loses the quadrant, and
    /// (36) has the sign against the direction of rolling (`v_e,x < 0`); with atan2 the entrainment
    /// angle takes both components reversed. The printed values 0.87 and 1.19° are exchanged:
    /// 1.19° belongs to the screw (inner), 0.88° to the nut.
    ///
    /// They stay the same until the next update: call this after one, not in every interrupt.
    ///
    /// Errors: ERRORS_RATIOS
    ///
    /// Cost: CYCLES_RATIOS
    #[must_use]
    pub fn ratios(&self) -> SlipRatios {
        let sliding =
            math::sqrt(self.rolling_slip * self.rolling_slip + self.side_slip * self.side_slip);
        let slide_angle = if sliding > 0.0 {
            // Adding zero turns -0 into +0: slip straight back is pi, never -pi.
            libm::atan2f(self.side_slip + 0.0, self.rolling_slip)
        } else {
            0.0
        };
        let mean_axis = math::sqrt(self.semi_major * self.semi_minor);
        let inverse = 1.0 / self.entrainment_speed;
        SlipRatios {
            entrainment_angle: libm::atan2f(-self.entrainment_side, -self.entrainment_rolling),
            slide_to_roll: sliding * inverse,
            slide_angle,
            spin_to_roll: self.spin * mean_axis * inverse,
        }
    }

    /// Slip (m/s) at a point of the ellipse: `x` (m) along the direction of rolling, `y` (m) across
    /// it, from the centre; `speed` of the screw in rad/s.
    ///
    /// Sum of rolling slip `omega w q / r' (r' - S(y))`, side slip `omega w S(y) (...)` and spin
    /// `(-spin y, spin x)`, Alberdi et al., eq. (30), with `S(y)` of (14): the full field, parabola
    /// included. Points outside the rectangle about the ellipse (NaN too) touch nothing and give 0;
    /// a wrong speed counts as 0, as in [`tick`](super::ContactKinematics::tick).
    #[must_use]
    pub fn slip_at(&self, speed: f32, x: f32, y: f32) -> SlipVector {
        if !(abs(x) <= self.semi_minor && abs(y) <= self.semi_major) {
            return SlipVector {
                rolling: 0.0,
                side: 0.0,
            };
        }
        let speed = sane_speed(speed);
        // S(0) - S(y) = R - sqrt(R^2 - y^2) = y^2 k / (1 + sqrt(1 - (2 k y)^2)) * 2 with k = 1/(2R).
        let slope = 2.0 * self.half_curvature * y;
        let sagitta = slope * y / (1.0 + math::sqrt(1.0 - slope * slope));
        let rolling = self.rolling_slip + self.rolling_gradient * sagitta - self.spin * y;
        let side = self.side_slip - self.side_gradient * sagitta + self.spin * x;
        SlipVector {
            rolling: speed * rolling,
            side: speed * side,
        }
    }

    /// Coefficients of `y^2` in rolling and side slip, 1/m: the parabola of the deformed surface.
    #[inline]
    pub(super) fn parabolas(&self) -> (f32, f32) {
        (
            self.rolling_gradient * self.half_curvature,
            -self.side_gradient * self.half_curvature,
        )
    }

    /// Mean of `S_k` over the ellipse, weighted by pressure, m: `<y^2> = a^2 / 5`.
    #[inline]
    pub(super) fn mean_distance(&self) -> f32 {
        self.distance - 0.2 * self.half_curvature * self.semi_major * self.semi_major
    }
}
