//! Rolling resistance of all contacts of a ball, beside what friction takes in them.

use crate::contact::{RollingContact, RollingResistance};
use crate::error::{Error, attempt};
use crate::geometry::{BallScrew, Groove};
use crate::math::{self, inverse_cube_roots};

/// Rolling resistance of a ball between its grooves, folded.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct BallResistance {
    /// Torque of hysteresis on the nut over the power 4/3 of a contact's load: of the screw's contacts and of the nut's.
    screw: f32,
    nut: f32,
    /// Torque of the lubricant's drag over the root of a contact's load.
    lubricant: f32,
}

impl BallResistance {
    /// Folds the resistance of a design's contacts.
    ///
    /// The grooves run past the contacts of a ball that rolls with half the speed of pure rolling on both sides:
    ///
    /// ```text
    /// v/omega_N = omega_B/omega_N (q - c) = (1 - omega_B/omega_N) (q + c) = (q² - c²)/(2 q)
    /// c = r_b cos(alpha) cos(beta)
    /// ```
    ///
    /// with the speed `v` at which a contact runs along a groove and the path radius `q`, the track's length per radian.
    ///
    /// # Errors
    /// As [`RollingContact::of`].
    pub(super) const fn new(
        design: &BallScrew,
        resistance: RollingResistance,
    ) -> Result<Self, Error> {
        let (screw, lubricant) =
            attempt!(RollingContact::of(design, Groove::Screw, resistance)).coefficients();
        let (nut, _) = attempt!(RollingContact::of(design, Groove::Nut, resistance)).coefficients();
        let path = design.path_radius();
        let arm = design.ball_radius() * design.cos_lead_angle() * design.contact_angle().cos;
        let travel = 0.5 * (path * path - arm * arm) / path;
        Ok(Self {
            screw: screw * travel,
            nut: nut * travel,
            lubricant: lubricant * travel,
        })
    }

    /// Torque on the nut, N m, of contacts with these loads, N: SL, SR, NL, NR; 0 where a contact is open.
    #[inline(always)]
    pub(super) fn torque(&self, [sl, sr, nl, nr]: [f32; 4]) -> f32 {
        let screw = self.screw * powers(sl, sr);
        let hysteresis = screw + self.nut * powers(nl, nr);
        // A dry contact saves four roots.
        if self.lubricant > 0.0 {
            let roots = math::sqrt(sl) + math::sqrt(sr) + (math::sqrt(nl) + math::sqrt(nr));
            hysteresis + self.lubricant * roots
        } else {
            hysteresis
        }
    }
}

/// `x^(4/3) + y^(4/3)`, within 6e-5.
#[inline(always)]
fn powers(x: f32, y: f32) -> f32 {
    let [p, q] = inverse_cube_roots([x, y]);
    let (x, y) = (x * p, y * q);
    x * x + y * y
}
