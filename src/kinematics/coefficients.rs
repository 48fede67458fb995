//! Constants of one contact, and what follows from them.

use super::ball::{ContactSlip, sane_speed};
use super::path::{Direction, GroovePath, Path};
use crate::geometry::Groove;
use crate::math;

/// The ratios of Alberdi et al., eqs. (37) to (40), at the centre of a contact, at any speed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SlipRatios {
    /// Angle from the direction of rolling to the entrainment velocity (`gamma`), rad.
    pub entrainment_angle: f32,
    /// Sliding speed over entrainment speed (`SRR`).
    pub slide_to_roll: f32,
    /// Angle from the direction of rolling to the slip, rad, in (-pi, pi], for a positive speed; 0 where `slide_to_roll` is 0.
    pub slide_angle: f32,
    /// Spin times the ellipse's mean semi-axis `sqrt(a b)` over entrainment speed (`S_p`), for a positive speed.
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
    /// At the centre: m, m, 1, m.
    pub(super) slip: ContactSlip,
    entrainment_rolling: f32,
    entrainment_side: f32,
    /// Rolling slip per metre that the surface lies inside the rolling radius, 1.
    rolling_gradient: f32,
    /// `S_k` at the centre, m.
    pub(super) distance: f32,
    /// `1 / (2 R_k)`, 1/m.
    half_curvature: f32,
    pub(super) semi_major: f32,
    pub(super) semi_minor: f32,
}

impl ContactCoefficients {
    pub(super) const fn new(groove_path: &GroovePath) -> Self {
        Self {
            slip: ContactSlip {
                rolling_slip: 0.0,
                side_slip: 0.0,
                spin: 0.0,
                entrainment_speed: 0.0,
            },
            entrainment_rolling: 0.0,
            entrainment_side: 0.0,
            rolling_gradient: 0.0,
            distance: 0.0,
            half_curvature: groove_path.half_curvature,
            semi_major: 0.0,
            semi_minor: 0.0,
        }
    }

    /// Forms everything from one contact's direction, with `relative_speed = omega_k / omega` of the orbiting ball's frame against the raceway
    /// and the ball's rotation `omega_R / omega` along binormal, tangent and normal of the path; of the entrainment speed the square, because loop
    /// and set-up differ in the root.
    #[inline]
    #[must_use]
    pub(super) const fn fold(
        &mut self,
        path: &Path,
        groove_path: &GroovePath,
        direction: &Direction,
        relative_speed: f32,
        groove: Groove,
        [binormal, tangent, normal]: [f32; 3],
    ) -> f32 {
        // Symbols of Alberdi et al.: w = omega_k / omega, z = (a / (D/2))^2.
        let w = relative_speed;
        let sign = groove.sign();
        let z = direction.semi_major * direction.semi_major * path.inverse_ball_radius_squared;
        let [c1, c2, c3] = groove_path.deficit;
        let deficit = z * (c1 + z * (c2 + z * c3));
        // r' - S as a sum of two small numbers; (31) takes it as the difference of two speeds.
        let inside = groove_path.rolling_excess + deficit;
        let distance = groove_path.rolling_radius - inside;

        let rolling_gradient = w * groove_path.path_over_rolling;
        let by_lead = w * path.sin_lead;
        let by_yaw = sign * tangent;
        let side_gradient = by_lead + by_yaw;
        let spin = (w * path.cos_lead - sign * binormal) * direction.sine
            + (sign * normal) * direction.cosine;

        // (36): half the sum of both surfaces' velocities relative to the moving contact.
        let across = sign * path.cos_lead * direction.cosine;
        let half_distance = 0.5 * distance;
        let entrainment_rolling =
            w * (path.half_radius + half_distance * (direction.reach - across));
        let entrainment_side = half_distance * (by_lead - by_yaw);
        self.slip = ContactSlip {
            rolling_slip: rolling_gradient * inside,
            side_slip: side_gradient * distance,
            spin,
            entrainment_speed: 0.0,
        };
        self.entrainment_rolling = entrainment_rolling;
        self.entrainment_side = entrainment_side;
        self.rolling_gradient = rolling_gradient;
        self.distance = distance;
        self.semi_major = direction.semi_major;
        self.semi_minor = direction.semi_minor;
        entrainment_rolling * entrainment_rolling + entrainment_side * entrainment_side
    }

    /// The speed-free ratios at the contact's centre.
    ///
    /// `entrainment_angle = atan2(-v_e,y, -v_e,x)`, `slide_to_roll = |v_s| / |v_e|`,
    /// `slide_angle = atan2(side_slip, rolling_slip)`,
    /// `spin_to_roll = spin sqrt(a b) / |v_e|`: Alberdi et al., eqs. (37) to (40), with `v_e` of (36).
    /// **Corrected:** (37) and (39) print an arc tangent of a quotient, which loses the quadrant, and (36) has the sign against the direction of rolling
    /// (`v_e,x < 0`). The printed values 0.87 and 1.19° are exchanged: 1.19° belongs to the screw (inner), 0.88° to the nut.
    ///
    /// Errors over the domain of [`ContactKinematics`](super::ContactKinematics), largest (rms): slide-to-roll 1.6e-7 (1.3e-8), entrainment angle
    /// 3.5e-8 (4e-9) rad, spin-to-roll 3.2e-8 (4e-9), all absolute; slide angle times the slide-to-roll ratio 2.2e-7 (4e-8), 1.4e-5 (1.1e-6) rad where
    /// that ratio exceeds 1 %. Cost: about 430 cycles (modelled, Cortex-M4F), once after each update.
    pub fn ratios(&self) -> SlipRatios {
        let sliding = math::sqrt(
            self.slip.rolling_slip * self.slip.rolling_slip
                + self.slip.side_slip * self.slip.side_slip,
        );
        let slide_angle = if sliding > 0.0 {
            // Adding zero turns -0 into +0: slip against the direction of rolling has the angle pi.
            libm::atan2f(self.slip.side_slip + 0.0, self.slip.rolling_slip)
        } else {
            0.0
        };
        let mean_axis = math::sqrt(self.semi_major * self.semi_minor);
        let inverse = 1.0 / self.slip.entrainment_speed;
        SlipRatios {
            entrainment_angle: libm::atan2f(-self.entrainment_side, -self.entrainment_rolling),
            slide_to_roll: sliding * inverse,
            slide_angle,
            spin_to_roll: self.slip.spin * mean_axis * inverse,
        }
    }

    /// Slip (m/s) at a point of the ellipse: `x` (m) along the direction of rolling, `y` (m) across
    /// it, from the centre; `speed` of the screw in rad/s.
    ///
    /// Sum of rolling slip `omega w q / r' (r' - S(y))`, side slip `omega w S(y) (...)` and spin `(-spin y, spin x)`, Alberdi et al., eqs. (30), (33),
    /// with `S(y)` of (14). **Corrected:** (30) prints the part of the spin as its second component alone; by (33) it has both. Points outside the
    /// rectangle about the ellipse (NaN too) give 0; a speed as in [`tick`](super::ContactKinematics::tick).
    pub fn slip_at(&self, speed: f32, x: f32, y: f32) -> SlipVector {
        if !(x.abs() <= self.semi_minor && y.abs() <= self.semi_major) {
            return SlipVector {
                rolling: 0.0,
                side: 0.0,
            };
        }
        let speed = sane_speed(speed);
        // S(0) - S(y) = R - sqrt(R^2 - y^2) = y^2 k / (1 + sqrt(1 - (2 k y)^2)) * 2 with k = 1/(2R).
        let slope = 2.0 * self.half_curvature * y;
        let sagitta = slope * y / (1.0 + math::sqrt(1.0 - slope * slope));
        let rolling = self.slip.rolling_slip + self.rolling_gradient * sagitta - self.slip.spin * y;
        let side = self.slip.side_slip - self.side_gradient() * sagitta + self.slip.spin * x;
        SlipVector {
            rolling: speed * rolling,
            side: speed * side,
        }
    }

    #[inline]
    fn side_gradient(&self) -> f32 {
        self.slip.side_slip / self.distance
    }
}
