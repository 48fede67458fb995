//! The published closed form of one ball in a linear bearing.

use super::loads::loaded;
use crate::contact::FrictionMap;
use crate::error::{Error, attempt, in_range};
use crate::math::{constant, inverse_cube_roots};
use crate::ranges;

/// Slope `k_f` of the friction force over the offset ratio, Lin 2019, Fig. 3.11 (b): the mean up to half the semi-axis; the exact one at
/// the centre is [`FrictionMap::slope`](crate::contact::FrictionMap::slope), 1.442 at conformity 0.56.
pub const PUBLISHED_SLOPE: f32 = 1.38;

/// Added to the sum of the two `F^(2/3)`, N^(2/3): keeps the compliance of a ball without load finite.
const SMALLEST_SUM: f32 = 1e-9;

/// Largest speed deviation that counts: that of a ball which stands still (-1) or moves with the top groove (1).
const LARGEST_SPEED_DEVIATION: f32 = 1.0;

/// Dimensions of a four-point contact linear bearing and of its contact ellipse.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LinearBallParameters {
    /// Ball radius `r_b`, m; 1e-5 to 1.
    pub ball_radius: f32,
    /// Nominal contact angle `beta_0`, rad; 0.05 to 1.5.
    pub contact_angle: f32,
    /// Axis ratio `k = b/a` of the contact ellipse; 0.01 to 1.
    pub axis_ratio: f32,
    /// Semi-major axis `a` over the cube root of the contact force, m/N^(1/3); 1e-8 to 1. In Lin 2019, eq. (3.36): `Psi r_b^(1/3)`.
    pub semi_major_coefficient: f32,
    /// Coulomb friction coefficient `mu` of ball and groove; 1e-6 to 1.
    pub friction: f32,
}

impl LinearBallParameters {
    pub(crate) const fn checked(&self) -> Result<Self, Error> {
        attempt!(ranges::BALL_RADIUS.checked("ball_radius", self.ball_radius));
        attempt!(ranges::ROLLING_CONTACT_ANGLE.checked("contact_angle", self.contact_angle));
        attempt!(
            ranges::SEMI_MAJOR_COEFFICIENT
                .checked("semi_major_coefficient", self.semi_major_coefficient)
        );
        attempt!(ranges::FRICTION.checked("friction", self.friction));
        Ok(*self)
    }
}

/// Published closed form of the speed of a ball in a four-point contact linear bearing.
///
/// With nominal contact angle `beta_0`, angle deviations `dBL`, `dBR`, `dTR`, `dTL`, mean loads `F_U` of
/// BL and TR and `F_D` of BR and TL, `A = F^(2/3)` and `a = Psi r_b^(1/3) F^(1/3)`:
///
/// ```text
/// epsilon    = tan(beta_0) ((dTR - dBL) A_U + (dTL - dBR) A_D) / (2 (A_U + A_D))
/// compliance = tan(beta_0) Psi / (2 k_f mu r_b^(2/3) (A_U + A_D))
/// F_BB       = (epsilon_rear - epsilon_front) / (compliance_rear + compliance_front)
/// ```
///
/// (Lin 2019, eqs. (3.43) and (3.51).) Corrected: the printed factor `1 - cos 2 beta_0` must be
/// `tan beta_0`, which is the same at 45 degrees only (0.577 against 0.5 at 30 degrees), and the printed
/// exponents -2/3 of (3.51) must be +2/3.
///
/// Valid for four loaded contacts with nearly equal loads on a diagonal. Largest error of the speed deviation against the minimum of the dissipation,
/// in units of `v/2`, bottom groove turned by up to 3 degrees: 2.3e-3 for side-force ratios up to 0.5, 5.8e-3 up to 0.8; four independent angles 1.5e-2
/// (rms 2e-3). Of the force between two balls: 0.62 N of up to 5.8 N at deviations of 2 degrees, 1.39 N of up to 9.1 N at 3. From side-force ratios of
/// 0.88 to 0.98 on balls change to two-point rolling, where the weaker diagonal carries less than `(3/8) E (a/r_b)/sin(2 beta_0)` of the stronger one,
/// and this formula keeps the speed from before. Cost of two balls and the force between them: 243 modelled cycles.
///
/// ```
/// use epas_friction::ball::{AnalyticLinearBall, LinearBallParameters, PUBLISHED_SLOPE};
/// let parameters = LinearBallParameters {
///     ball_radius: 0.005,
///     contact_angle: core::f32::consts::FRAC_PI_4,
///     axis_ratio: 0.2321,
///     semi_major_coefficient: 5.307e-4 * 0.171, // Psi r_b^(1/3)
///     friction: 0.1,
/// };
/// let ball = AnalyticLinearBall::new(&parameters, PUBLISHED_SLOPE)?;
/// // Lin 2019, Table 3.4, case (a): a yaw moment on two balls, bottom groove turned by 2 degrees.
/// let turned = 2_f32.to_radians();
/// let angles = [0.7854 - turned, 0.7854 + turned, 0.7854, 0.7854];
/// let (strong, weak) = (113.14, 28.28);
/// let rear = ball.speed_deviation(&angles, &[strong, weak, strong, weak]);
/// let front = ball.speed_deviation(&angles, &[weak, strong, weak, strong]);
/// assert!((rear.speed_deviation - 0.0075).abs() < 1e-4);
/// // Table 3.5: 3.74 N.
/// assert!((rear.contact_force(&front) - 3.74).abs() < 0.01);
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct AnalyticLinearBall {
    half_tangent: f32,
    /// Compliance times the sum of both diagonals' forces to the power of 2/3, N^(-1/3).
    compliance: f32,
    /// Its inverse, N^(1/3).
    impedance: f32,
}

/// Speed of a ball relative to nominal rolling, and its compliance along the track.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SpeedDeviation {
    /// `epsilon`: the ball moves with `(1 + epsilon) v/2`.
    pub speed_deviation: f32,
    /// Change of `epsilon` with a force along the track, 1/N.
    pub compliance: f32,
}

impl AnalyticLinearBall {
    /// Constants of the closed form with a slope `k_f` of the friction force: [`PUBLISHED_SLOPE`] for the
    /// published formula, [`FrictionMap::slope`] for the exact one.
    ///
    /// # Errors
    /// [`Error`] naming the field of [`LinearBallParameters`], or `slope` (0.1 to 10), that is out of range.
    pub const fn new(parameters: &LinearBallParameters, slope: f32) -> Result<Self, Error> {
        let parameters = attempt!(parameters.checked());
        attempt!(FrictionMap::new(parameters.axis_ratio));
        let slope = attempt!(in_range("slope", slope, 0.1, 10.0));
        let (sin, cos) = constant::sin_cos(parameters.contact_angle);
        let half_tangent = 0.5 * sin / cos;
        Ok(Self::folded(&parameters, half_tangent, slope))
    }

    /// The same from parameters that are checked, and `tan(beta_0)/2`.
    pub(crate) const fn folded(
        parameters: &LinearBallParameters,
        half_tangent: f32,
        slope: f32,
    ) -> Self {
        // The loads of a diagonal enter by their sum, the formula by their mean.
        const TWO_TO_TWO_THIRDS: f32 = constant::cbrt_squared(2.0);
        // Psi / (k_f mu r_b^(2/3)), N^(-1/3).
        let compliance = parameters.semi_major_coefficient
            / (slope * parameters.friction * parameters.ball_radius);
        let compliance = TWO_TO_TWO_THIRDS * half_tangent * compliance;
        Self {
            half_tangent,
            compliance,
            impedance: 1.0 / compliance,
        }
    }

    /// Speed deviation and compliance from contact angles, rad, and forces, N, in the order BL, BR, TR, TL.
    ///
    /// Only differences of the angles count; where one is NaN or infinite, the deviation is 0. A diagonal counts with the mean of its two
    /// forces; a sum up to zero, above 1e7 N, or NaN is no load. Powers are within 2.7e-5.
    #[inline]
    pub fn speed_deviation(
        &self,
        contact_angles: &[f32; 4],
        contact_forces: &[f32; 4],
    ) -> SpeedDeviation {
        let [angle_bl, angle_br, angle_tr, angle_tl] = *contact_angles;
        let [force_bl, force_br, force_tr, force_tl] = *contact_forces;
        let up = loaded(force_bl + force_tr);
        let down = loaded(force_br + force_tl);
        let [up_root, down_root] = inverse_cube_roots([up, down]);
        let ball = self.closed_form(
            [up * up_root, down * down_root],
            [angle_tr - angle_bl, angle_tl - angle_br],
        );
        SpeedDeviation {
            // False for NaN too.
            speed_deviation: if ball.speed_deviation.abs() <= LARGEST_SPEED_DEVIATION {
                ball.speed_deviation
            } else {
                0.0
            },
            ..ball
        }
    }

    /// Impedance, N: the inverse of the compliance of [`AnalyticLinearBall::closed_form`].
    #[inline(always)]
    pub(crate) fn impedance(&self, [up, down]: [f32; 2]) -> f32 {
        self.impedance * (up + down)
    }

    /// (3.43) and (3.51) from the powers of 2/3 of both diagonals' sums of forces, `N^(2/3)`, and the differences of angles `dTR - dBL` and
    /// `dTL - dBR`, rad. Linear in the angles.
    #[inline(always)]
    pub(crate) fn closed_form(&self, [up, down]: [f32; 2], turns: [f32; 2]) -> SpeedDeviation {
        let inverse = 1.0 / (up + down + SMALLEST_SUM);
        let turn = turns[0] * up + turns[1] * down;
        SpeedDeviation {
            speed_deviation: self.half_tangent * turn * inverse,
            compliance: self.compliance * inverse,
        }
    }
}

impl SpeedDeviation {
    /// Force with which this ball presses on the one in front of it, N; zero where it lags behind (Lin 2019, eq. (3.51)). For a track speed
    /// above zero; below it rear and front change places.
    #[inline]
    pub fn contact_force(&self, front: &Self) -> f32 {
        let lead = self.speed_deviation - front.speed_deviation;
        if lead > 0.0 {
            lead / (self.compliance + front.compliance)
        } else {
            0.0
        }
    }
}
