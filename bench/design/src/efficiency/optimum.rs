//! The contact angle of least loss.

use epas_friction::efficiency::Drive;
use epas_friction::error::{Error, Range};
use epas_friction::math;
use epas_friction::ranges;

/// The contact angle at which full sliding loses least, with the loss-free bound on the lead angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OptimumContactAngle {
    /// The contact angle, rad; `None` where the lead angle is above the largest: the efficiency then
    /// rises up to a contact angle of 90 degrees.
    pub contact_angle: Option<f32>,
    /// Largest lead angle, rad, for which the optimum exists: `pi/4 -+ atan(f)/2`, upper sign driving.
    pub largest_lead_angle: f32,
}

/// The contact angle of highest full-sliding efficiency for a lead angle (rad, 0 to 1.5) and a
/// friction coefficient (0 to 1).
///
/// Equations (15) and (18) solved in closed form: `Ca Sb = sin(pi/4 +- atan(f)/2)`, upper sign
/// driving, which is `Sb² = (1 +- sin(atan f)) (1 + ta²) / 2`. The paper solves them numerically, and
/// prints (18) without the root: it reads `R² = Sb² + 2 f Sb R`.
///
/// ```
/// use epas_design::efficiency::optimum_contact_angle;
/// use epas_friction::efficiency::Drive;
/// let best = optimum_contact_angle(Drive::Driving, 10f32.to_radians(), 0.075)?;
/// assert!((best.contact_angle.unwrap().to_degrees() - 48.106).abs() < 1e-3);
/// # Ok::<(), epas_friction::Error>(())
/// ```
pub fn optimum_contact_angle(
    drive: Drive,
    lead_angle: f32,
    friction: f32,
) -> Result<OptimumContactAngle, Error> {
    Range::new(0.0, 1.5).checked("lead_angle", lead_angle)?;
    ranges::FRICTION_OR_NONE.checked("friction", friction)?;
    let (sin, cos) = math::sin_cos(lead_angle);
    let tan_squared = (sin / cos) * (sin / cos);
    let sin_friction_angle = friction / math::sqrt(1.0 + friction * friction);
    let half_friction_angle = 0.5 * friction.atan();
    let (signed_sine, largest_lead_angle) = match drive {
        Drive::Driving => (
            sin_friction_angle,
            std::f32::consts::FRAC_PI_4 - half_friction_angle,
        ),
        Drive::BackDriving => (
            -sin_friction_angle,
            std::f32::consts::FRAC_PI_4 + half_friction_angle,
        ),
    };
    let sin_squared = 0.5 * (1.0 + signed_sine) * (1.0 + tan_squared);
    // 1 - Sb², without its cancellation near 90 degrees.
    let cos_squared = 0.5 * ((1.0 - signed_sine) - tan_squared * (1.0 + signed_sine));
    let contact_angle =
        (cos_squared >= 0.0).then(|| math::sqrt(sin_squared).atan2(math::sqrt(cos_squared)));
    Ok(OptimumContactAngle {
        contact_angle,
        largest_lead_angle,
    })
}

/// The highest full-sliding efficiency that any contact angle reaches: `(sqrt(1 + f²) - f)²`, the same
/// for both directions and for every lead angle where the optimum exists; 86.1 % at a friction of
/// 0.075.
#[must_use]
pub fn optimum_efficiency(friction: f32) -> f32 {
    // 1 / (sqrt(1 + f²) + f)²: the same number without a subtraction.
    let sum = math::sqrt(1.0 + friction * friction) + friction;
    1.0 / (sum * sum)
}
