//! Closed-form efficiency of a ball screw, and self-locking, both after Lin, Velinsky, Ravani 1994:
//!
//! - **rolling**, eq. (3): the ball rolls; only the contact at the screw slips, across the groove. For the friction of a gear in service.
//! - **sliding**, eq. (14) and (17): both main contacts slide along the path, a state that is unstable nearly everywhere. For the margin against
//!   self-locking.
//!
//! At the paper's own case (lead angle 10 degrees, contact angle 45 degrees, friction 0.075) the first gives 0.980, the second 0.860.

use crate::error::{Error, attempt, in_range};
use crate::geometry::{BallScrew, ContactAngle};
use crate::math::constant;
use core::f32::consts::FRAC_PI_2;

/// Direction of the power flow through the ball screw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Drive {
    /// Rotation moves the load: rotary into linear motion.
    Driving,
    /// The load turns the screw or nut: linear into rotary motion.
    BackDriving,
}

/// The geometry that the efficiency depends on; friction comes per call.
///
/// `Sb`, `Cb` are sine and cosine of the contact angle, `ta` the tangent of the lead angle, `a` the
/// ball radius over the pitch radius, `R = sqrt(Cb² + ta²)`, `f` the friction coefficient (0 to 1), `t` the rolling tangent, eq. (2):
/// `t = f_r / (r_b Sb)` with the lever arm `f_r` of rolling friction, m.
///
/// Each efficiency is the raw value of its formula, negative where the screw locks; each loss, one less the efficiency, has its own formula. Errors over
/// friction 0.001 to 0.3, lead angles 0.5 to 60 and contact angles 5 to 85 degrees: 3e-7 absolute for an efficiency between 0 and 1, 4e-7 relative for a loss.
///
/// ```
/// use epas_friction::efficiency::EfficiencyGeometry;
/// let screw = EfficiencyGeometry::new(10f32.to_radians(), 45f32.to_radians(), 0.17984)?;
/// assert!((screw.rolling_efficiency(0.075, 0.0) - 0.979796).abs() < 1e-6);
/// assert!((screw.sliding_efficiency(0.075) - 0.860112).abs() < 1e-6);
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct EfficiencyGeometry {
    /// `Sb`.
    pub(super) sin_contact: f32,
    /// `Cb`.
    pub(super) cos_contact: f32,
    /// `ta`.
    pub(super) tan_lead: f32,
    /// `1 / Ca² = 1 + ta²`.
    pub(super) secant_squared: f32,
    /// `R`.
    pub(super) root: f32,
    /// `a`.
    pub(super) ball_ratio: f32,
    /// `1 / (Ca² Sb)`.
    drive_scale: f32,
    /// `1 / (Ca² R)`.
    pub(super) backdrive_scale: f32,
    rolling: Rolling,
}

/// Constants of [`EfficiencyGeometry::rolling_loss`], in which `ta` is at least [`LEAST_TANGENT`]: with a lead of zero the formula would be 0/0
/// without rolling resistance.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct Rolling {
    /// `a ta`.
    slide: f32,
    /// `1 + ta²`.
    resistance: f32,
    /// `ta Sb`.
    grip: f32,
    /// `ta (a - Cb)`.
    gain: f32,
}

/// Stands for the tangent of a lead angle of zero; its products with friction coefficients stay far from underflow.
const LEAST_TANGENT: f32 = 1e-20;

impl EfficiencyGeometry {
    /// Constants from the lead angle `alpha` (rad, 0 to 1.5), the contact angle `beta` (rad, 0.001 to pi/2) and the ball ratio `a` (0 to 1).
    pub const fn new(lead_angle: f32, contact_angle: f32, ball_ratio: f32) -> Result<Self, Error> {
        attempt!(in_range("lead_angle", lead_angle, 0.0, 1.5));
        attempt!(in_range("contact_angle", contact_angle, 0.001, FRAC_PI_2));
        attempt!(in_range("ball_ratio", ball_ratio, 0.0, 1.0));
        let (sin, cos) = constant::sin_cos(lead_angle);
        Ok(Self::from_parts(
            sin / cos,
            ContactAngle::new(contact_angle),
            ball_ratio,
        ))
    }

    /// Constants of a validated design at its nominal contact angle; for constants too.
    #[must_use]
    pub const fn of(design: &BallScrew) -> Self {
        Self::from_parts(
            design.tan_lead_angle(),
            design.contact_angle(),
            design.ball_ratio(),
        )
    }

    const fn from_parts(tan_lead: f32, contact_angle: ContactAngle, ball_ratio: f32) -> Self {
        let ContactAngle { cos, sin } = contact_angle;
        let secant_squared = 1.0 + tan_lead * tan_lead;
        // Not from 1/Ca² - Sb², a difference that loses digits where R is small.
        let root = constant::sqrt(cos * cos + tan_lead * tan_lead);
        let tangent = tan_lead.max(LEAST_TANGENT);
        Self {
            sin_contact: sin,
            cos_contact: cos,
            tan_lead,
            secant_squared,
            root,
            ball_ratio,
            drive_scale: secant_squared / sin,
            backdrive_scale: secant_squared / root,
            rolling: Rolling {
                slide: ball_ratio * tangent,
                resistance: secant_squared,
                grip: tangent * sin,
                gain: tangent * (ball_ratio - cos),
            },
        }
    }

    /// Rolling efficiency, eq. (3), for a driven screw and for a driven nut alike:
    /// `1 - eta = [f a ta + t (1 + ta²)] / [ta (Sb + f (a - Cb)) + t]`.
    ///
    /// Equation (4), printed for a driven nut, breaks the energy balance by `2 f Cb`; the balance gives eq. (3) for either. Cost: one division, 8
    /// other operations.
    #[inline]
    pub const fn rolling_efficiency(&self, friction: f32, rolling_tangent: f32) -> f32 {
        1.0 - self.rolling_loss(friction, rolling_tangent)
    }

    /// One less [`EfficiencyGeometry::rolling_efficiency`], by its own formula.
    #[inline]
    pub const fn rolling_loss(&self, friction: f32, rolling_tangent: f32) -> f32 {
        // False for NaN. The other branch is a call, so that the usual one needs no stack frame.
        if rolling_tangent >= 0.0 {
            let Rolling {
                slide,
                resistance,
                grip,
                gain,
            } = self.rolling;
            let (slide, gain) = (friction * slide, friction * gain);
            (slide + rolling_tangent * resistance) / ((grip + gain) + rolling_tangent)
        } else {
            self.sliding_while_rolling(friction)
        }
    }

    #[cold]
    #[inline(never)]
    const fn sliding_while_rolling(&self, friction: f32) -> f32 {
        let slide = friction * self.ball_ratio;
        slide / (self.sin_contact + friction * (self.ball_ratio - self.cos_contact))
    }

    /// Rolling efficiency where the load back-drives the screw, eq. (3) with the friction forces reversed:
    /// `1 - eta = [f a ta + t (1 + ta²)] / [ta (Sb + f Cb + t ta)]`; negative infinity with rolling resistance and without lead.
    #[inline]
    pub const fn rolling_backdrive_efficiency(&self, friction: f32, rolling_tangent: f32) -> f32 {
        let slide = friction * self.ball_ratio;
        let grip = self.sin_contact + friction * self.cos_contact + rolling_tangent * self.tan_lead;
        let loss = if rolling_tangent > 0.0 {
            (slide * self.tan_lead + rolling_tangent * self.secant_squared) / (grip * self.tan_lead)
        } else {
            slide / grip
        };
        1.0 - loss
    }

    /// Full-sliding efficiency of driving, eq. (14): `1 - eta = f / (Ca² Sb (R + f Sb))`. As printed the radical seems to span `f Sb` too; it ends
    /// before. Cost: one division, 4 other operations.
    #[inline]
    pub const fn sliding_efficiency(&self, friction: f32) -> f32 {
        1.0 - self.sliding_loss(friction)
    }

    /// One less [`EfficiencyGeometry::sliding_efficiency`], by its own formula.
    #[inline]
    pub const fn sliding_loss(&self, friction: f32) -> f32 {
        friction * self.drive_scale / (self.root + friction * self.sin_contact)
    }

    /// Full-sliding efficiency of back-driving, eq. (17): `1 - eta = f / (Ca² R (Sb + f R))`; the radical as in (14).
    #[inline]
    pub const fn sliding_backdrive_efficiency(&self, friction: f32) -> f32 {
        1.0 - self.sliding_backdrive_loss(friction)
    }

    /// One less [`EfficiencyGeometry::sliding_backdrive_efficiency`], by its own formula.
    #[inline]
    pub const fn sliding_backdrive_loss(&self, friction: f32) -> f32 {
        friction * self.backdrive_scale / (self.sin_contact + friction * self.root)
    }

    /// Whether full sliding locks this direction: eq. (16) `f R >= Sb` for driving, eq. (19) `f Sb >= R` for back-driving.
    #[inline]
    #[must_use]
    pub const fn locks(&self, drive: Drive, friction: f32) -> bool {
        match drive {
            Drive::Driving => friction * self.root >= self.sin_contact,
            Drive::BackDriving => friction * self.sin_contact >= self.root,
        }
    }

    /// Ball ratio `a`, ball radius over pitch radius.
    pub const fn ball_ratio(&self) -> f32 {
        self.ball_ratio
    }

    /// Tangent `ta` of the lead angle.
    pub const fn tan_lead_angle(&self) -> f32 {
        self.tan_lead
    }

    /// Sine `Sb` of the contact angle.
    pub const fn sin_contact_angle(&self) -> f32 {
        self.sin_contact
    }

    /// Cosine `Cb` of the contact angle.
    pub const fn cos_contact_angle(&self) -> f32 {
        self.cos_contact
    }

    /// `R = sqrt(Cb² + ta²)`.
    pub const fn root(&self) -> f32 {
        self.root
    }

    /// Normal load of a contact per axial load on one ball, friction neglected: `Q / Fa = 1 / (Ca Sb)`, eq. (20) (printed with `C_ci` for
    /// `C_alpha`).
    pub const fn normal_per_axial_load(&self) -> f32 {
        constant::sqrt(self.secant_squared) / self.sin_contact
    }

    /// Normal load of a contact per torque on one ball, friction neglected, times the pitch radius:
    /// `Q r_m / M = 1 / (Sa Sb)`, eq. (21). Infinite without lead.
    pub const fn normal_per_torque(&self) -> f32 {
        constant::sqrt(self.secant_squared) / (self.tan_lead * self.sin_contact)
    }

    /// Friction torque per axial load, m, of a rolling screw: `r_m [f a ta + t (1 + ta²)] / (Sb -+ f Cb -+ t ta)`, upper sign driving. It is the
    /// torque of eq. (1) over its axial force, less the load's own, with the `a` that its first line prints as `alpha`. Infinite or negative where
    /// driving locks.
    pub const fn rolling_torque_per_load(
        &self,
        drive: Drive,
        pitch_radius: f32,
        friction: f32,
        rolling_tangent: f32,
    ) -> f32 {
        let loss =
            friction * self.ball_ratio * self.tan_lead + rolling_tangent * self.secant_squared;
        let hold = friction * self.cos_contact + rolling_tangent * self.tan_lead;
        let grip = match drive {
            Drive::Driving => self.sin_contact - hold,
            Drive::BackDriving => self.sin_contact + hold,
        };
        pitch_radius * loss / grip
    }

    /// Friction torque per axial load, m, in full sliding: `r_m ta f / (Ca² Sb R -+ f (Ca R)²)`, upper
    /// sign driving; eq. (14) and (17) as torques. Infinite or negative where driving locks.
    pub const fn sliding_torque_per_load(
        &self,
        drive: Drive,
        pitch_radius: f32,
        friction: f32,
    ) -> f32 {
        let hold = friction * self.root;
        let grip = match drive {
            Drive::Driving => self.sin_contact - hold,
            Drive::BackDriving => self.sin_contact + hold,
        };
        pitch_radius * self.tan_lead * friction * self.backdrive_scale / grip
    }
}
