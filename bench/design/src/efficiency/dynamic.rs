//! Correction of the full-sliding efficiency for the inertia of the balls.

use epas_friction::efficiency::EfficiencyGeometry;
use epas_friction::math;

/// Correction of the full-sliding efficiency for the centripetal force on the ball:
/// `eta = eta14 (1 + k1 Pi)` with `Pi = m r_m Omega² / Fa`, `m` the mass of a ball, `Omega` the
/// screw's angular speed and `Fa` the axial load of one ball.
///
/// With `w0 = (1 - a Ca² R² / Cb) / 2` (orbital over screw speed), `s0 = ta / R`, `c0 = Cb / R` and
/// `G = Sb (1 - s0) R / (Cb (Sb - f R))`,
///
/// ```text
/// k1 = w0² / (Cb (1 + s0) + G (Cb c0 + f Sb)) * Ca (Sb - f R)
///      * [ s0 + G c0 - (Sb - f ta) / (Sb - f R) - f G (Cb / Ca² - a R²) / (2 R Sb (R + f Sb)) ]
/// ```
///
/// the first-order term of the exact steady state (Lin, Velinsky, Ravani 1994, eq. (5)-(9)) as the
/// speed rises from zero. Where eq. (14) alone is off by 3.4e-4 (10,000 rpm, 2113 N on a ball), this is
/// off by 5.8e-6.
///
/// ```
/// use epas_design::efficiency::DynamicCorrection;
/// use epas_friction::efficiency::EfficiencyGeometry;
/// let screw = EfficiencyGeometry::new(10f32.to_radians(), 45f32.to_radians(), 0.17984)?;
/// let correction = DynamicCorrection::new(&screw, 0.075);
/// assert!((correction.coefficient() + 4.03e-3).abs() < 1e-5);
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DynamicCorrection {
    efficiency: f32,
    coefficient: f32,
}

impl DynamicCorrection {
    /// `eta14` and `k1` for one geometry and friction coefficient.
    ///
    /// Where driving locks (`f R >= Sb`) there is no steady motion to correct: the coefficient is 0.
    #[must_use]
    pub fn new(geometry: &EfficiencyGeometry, friction: f32) -> Self {
        let sb = geometry.sin_contact_angle();
        let cb = geometry.cos_contact_angle();
        let ta = geometry.tan_lead_angle();
        let a = geometry.ball_ratio();
        let r = geometry.root();
        let f = friction;

        let efficiency = geometry.sliding_efficiency(friction);
        let grip = sb - f * r;
        let ca_squared = 1.0 / (1.0 + ta * ta);
        let w0 = 0.5 * (1.0 - a * ca_squared * r * r / cb);
        let s0 = ta / r;
        let c0 = cb / r;
        let g = sb * (1.0 - s0) * r / (cb * grip);
        let share = cb * (1.0 + s0) + g * (cb * c0 + f * sb);
        let bracket = s0 + g * c0
            - (sb - f * ta) / grip
            - f * g * (cb / ca_squared - a * r * r) / (2.0 * r * sb * (r + f * sb));
        let coefficient = w0 * w0 / share * math::sqrt(ca_squared) * grip * bracket;
        Self {
            efficiency,
            coefficient: if grip > 0.0 && coefficient.is_finite() {
                coefficient
            } else {
                0.0
            },
        }
    }

    /// The coefficient `k1`.
    #[inline]
    #[must_use]
    pub fn coefficient(&self) -> f32 {
        self.coefficient
    }

    /// Efficiency at the dynamic number `Pi = m r_m Omega² / Fa`, at least 0.
    #[inline]
    #[must_use]
    pub fn efficiency(&self, dynamic_number: f32) -> f32 {
        self.efficiency + self.efficiency * (self.coefficient * dynamic_number)
    }
}
