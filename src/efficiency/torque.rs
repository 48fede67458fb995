//! Friction torque over the axial load in closed form, and the contact forces of a load.

use super::closed_form::{Drive, EfficiencyGeometry};
use crate::math::constant;

impl EfficiencyGeometry {
    /// Normal load of a contact per axial load on one ball, friction neglected: `Q / Fa = 1 / (Ca
    /// Sb)`, eq. (20) (printed with `C_ci` for `C_alpha`). Set-up only.
    #[must_use]
    pub const fn normal_per_axial_load(&self) -> f32 {
        constant::sqrt(self.secant_squared) / self.sin_contact
    }

    /// Normal load of a contact per torque on one ball, friction neglected, times the pitch radius:
    /// `Q r_m / M = 1 / (Sa Sb)`, eq. (21). Infinite without lead. Set-up only.
    #[must_use]
    pub const fn normal_per_torque(&self) -> f32 {
        constant::sqrt(self.secant_squared) / (self.tan_lead * self.sin_contact)
    }

    /// Friction torque per axial load, m, of a rolling screw: `r_m [f a ta + t (1 + ta²)] / (Sb -+ f
    /// Cb -+ t ta)`, upper sign driving. Finite at zero lead.
    ///
    /// It is the torque of eq. (1) over its axial force, less the load's own, with the `a` that its first line prints as `alpha`;
    /// and eq. (3) as a torque, `r_m ta (1/eta - 1)` driving and `r_m ta (1 - eta)` back-driving,
    /// without the division by a vanishing lead. Infinite or negative where driving locks.
    #[must_use]
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
    #[must_use]
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
