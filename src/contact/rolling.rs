//! Rolling resistance of one contact: elastic hysteresis and lubricant drag, beside its Coulomb friction.

use crate::curvature::GothicArch;
use crate::error::{Error, attempt};
use crate::geometry::{BallScrew, Groove};
use crate::hertz::HertzContact;
use crate::math;
use crate::ranges;

/// Losses of a contact that rolls without slip: hysteresis of the material, about one per cent of a ball screw's friction, and drag of the lubricant.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct RollingResistance {
    /// Share of the elastic energy that is lost while a contact passes, 0 to 0.2. Steel: at most of the order of one per cent below yield
    /// (Johnson 1985, section 9.2); a measured rolling coefficient of the order of 1e-5 means 0.002 to 0.01. Rubber: 0.1 and more.
    pub hysteresis_loss: f32,
    /// Drag of the lubricant on one contact under 100 N, N, 0 to 10, at one viscosity and speed:
    /// [`RollingDrag`](crate::law::coefficient::RollingDrag) takes its place in a scene with memory.
    pub lubricant_drag: f32,
}

impl RollingResistance {
    /// No rolling resistance.
    pub const NONE: Self = Self {
        hysteresis_loss: 0.0,
        lubricant_drag: 0.0,
    };

    /// Hardened steel without lubricant drag: 0.01 of the elastic energy, the upper end of what is known.
    pub const STEEL: Self = Self {
        hysteresis_loss: 0.01,
        lubricant_drag: 0.0,
    };

    /// The resistance, checked.
    pub const fn checked(self) -> Result<Self, Error> {
        attempt!(ranges::HYSTERESIS_LOSS.checked("hysteresis_loss", self.hysteresis_loss));
        attempt!(ranges::LUBRICANT_DRAG.checked("lubricant_drag", self.lubricant_drag));
        Ok(self)
    }
}

/// Rolling resistance of one contact with its constants folded.
///
/// ```text
/// force = 3/16 loss F b/R1 + drag sqrt(F / 100 N)        b = b_1 F^(1/3)
/// ```
///
/// `F` is the contact's load, `b` its semi-axis along the track, `R1` the relative radius of both bodies along it, `loss` and `drag`
/// the fields of [`RollingResistance`]. The force resists the travel of the contact along its track.
///
/// Source: first term Greenwood, Minshall and Tabor 1961, in the form of Johnson 1985, section 9.2, for an ellipse; second
/// term the load's power between Houpert 2002 (0.47) and SKF's rolling moment of ball bearings (0.54): 5 to 300 N
/// within 7 % of Houpert's where both meet at 40 N. Largest error against the float64 reference, every catalogue size, 1 to 1000 N: 4e-6.
///
/// ```
/// use epas_friction::CATALOGUE;
/// use epas_friction::contact::{RollingContact, RollingResistance};
/// use epas_friction::geometry::Groove;
/// let design = CATALOGUE[15].design()?; // 32 x 20 x 6.35
/// let contact = RollingContact::of(&design, Groove::Screw, RollingResistance::STEEL)?;
/// // Under 64 N, whose cube root is 4: some 1e-5 of the load.
/// let force = contact.force(64.0, 4.0);
/// assert!(force > 0.5e-5 * 64.0 && force < 5e-5 * 64.0);
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct RollingContact {
    /// `3/16 loss b_1/R1`, N^(-1/3).
    hysteresis: f32,
    /// Drag under 1 N, N^(1/2).
    lubricant: f32,
}

impl RollingContact {
    /// No resistance.
    pub const NONE: Self = Self {
        hysteresis: 0.0,
        lubricant: 0.0,
    };

    /// Constants of a contact from its semi-axis along the track over the cube root of the load, m/N^(1/3), 1e-9 to 1,
    /// and the relative curvature of both bodies along the track, 1/m, 1e-3 to 1e6.
    pub const fn new(
        resistance: RollingResistance,
        semi_minor_coefficient: f32,
        rolling_curvature: f32,
    ) -> Result<Self, Error> {
        let RollingResistance {
            hysteresis_loss,
            lubricant_drag,
        } = attempt!(resistance.checked());
        let semi_minor = attempt!(
            ranges::SEMI_MINOR_COEFFICIENT
                .checked("semi_minor_coefficient", semi_minor_coefficient)
        );
        let curvature =
            attempt!(ranges::ROLLING_CURVATURE.checked("rolling_curvature", rolling_curvature));
        Ok(Self {
            hysteresis: 3.0 / 16.0 * hysteresis_loss * (semi_minor * curvature),
            lubricant: 0.1 * lubricant_drag,
        })
    }

    /// Constants of the contact of ball and one groove at its nominal contact angle.
    pub const fn of(
        design: &BallScrew,
        groove: Groove,
        resistance: RollingResistance,
    ) -> Result<Self, Error> {
        let relative = GothicArch::of(design, groove)
            .relative(design.contact_angle(), design.clearance(groove));
        let contact = HertzContact::of(design, groove);
        Self::new(resistance, contact.semi_minor_coefficient(), relative.along)
    }

    /// `3/16 loss b_1/R1`, N^(-1/3), and the drag under 1 N, N^(1/2).
    pub const fn coefficients(&self) -> (f32, f32) {
        (self.hysteresis, self.lubricant)
    }

    /// Force against the travel of the contact along its track, N, from its load, N, and the load's cube root; both not
    /// below zero. Cost: one square root, 3 multiplications, 1 addition.
    #[inline]
    pub fn force(&self, load: f32, load_cube_root: f32) -> f32 {
        self.hysteresis * (load * load_cube_root) + self.lubricant * math::sqrt(load)
    }

    /// Power lost, W, at the speed at which the groove's surface runs past the contact, m/s; a friction torque, N m, where that speed is given
    /// over the nut's, m: for a ball that orbits with `omega_B` it is `|omega_B - omega_k| (q + r_b cos(alpha) n_x)`, with the path radius `q`, the part
    /// `n_x` of the contact's normal away from the axis, and `omega_k` zero on the screw and the nut's speed on the nut.
    #[inline]
    pub fn power(&self, load: f32, load_cube_root: f32, rolling_speed: f32) -> f32 {
        self.force(load, load_cube_root) * rolling_speed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_is_checked() {
        for bad in [f32::NAN, f32::INFINITY, -1e-3, 11.0] {
            let hysteresis = RollingResistance {
                hysteresis_loss: bad,
                ..RollingResistance::STEEL
            };
            let drag = RollingResistance {
                lubricant_drag: bad,
                ..RollingResistance::STEEL
            };
            let steel = RollingResistance::STEEL;
            for (error, field) in [
                (
                    RollingContact::new(hysteresis, 1e-5, 300.0),
                    "hysteresis_loss",
                ),
                (RollingContact::new(drag, 1e-5, 300.0), "lubricant_drag"),
                (
                    RollingContact::new(steel, bad, 300.0),
                    "semi_minor_coefficient",
                ),
                (
                    RollingContact::new(steel, 1e-5, bad - 1e7),
                    "rolling_curvature",
                ),
            ] {
                assert_eq!(error.unwrap_err().field(), field);
            }
        }
    }
}
