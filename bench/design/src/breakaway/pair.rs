//! The two loaded contacts of a ball in a screw.

use super::contact::ContactStiffness;
use super::parts::Resistance;
use super::parts::first_not_below;
use epas_friction::ball::Clearance;
use epas_friction::contact::{RollingContact, RollingResistance, slip_and_spin};
use epas_friction::error::{Error, Range};
use epas_friction::geometry::{BallScrew, Groove};
use epas_friction::math::constant;

/// Least and largest axis ratio with which the limit surface is evaluated, those of its integrals: it hardly changes beyond.
const AXIS_RATIO: Range = Range::new(0.02, 0.95);

/// On how many points a ball rolls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rolling {
    /// On the two contacts of the loaded diagonal: they spin with `sin(beta) cos(alpha)/2` of the nut's angle, and a third one
    /// slides.
    TwoPoint,
    /// On these two and a third one, or a fourth, that do not slide: all spin with `r_m tan(beta)/(2 r_b cos(alpha))`.
    ThreePoint,
}

/// A ball of a screw with its two loaded contacts, and how far they move with the nut.
///
/// For a nut angle of one radian, with lead angle `alpha`, contact angle `beta`, ball radius `r_b`, pitch radius `r_m`:
///
/// | contact moves | by |
/// |---|---|
/// | across the path | `l_1/2`, `l_1 = r_b sin(alpha)` |
/// | about its normal, two-point rolling | `sin(beta) cos(alpha)/2` |
/// | about its normal, three-point rolling | `r_m tan(beta)/(2 r_b cos(alpha))` |
/// | along the path, rolling | `r_m/(2 cos(alpha))` |
///
/// Every resistance is that of one ball, both contacts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScrewContacts {
    screw: ContactStiffness,
    nut: ContactStiffness,
    /// `l_1`, m.
    slip: f32,
    /// Spin of a contact in two-point and in three-point rolling.
    spin: [f32; 2],
    /// Rolled path, m.
    path: f32,
    /// Contact load over the axial load of a ball, `1/(sin(beta) cos(alpha))`.
    per_axial_load: f32,
}

impl ScrewContacts {
    /// The contacts of a validated design.
    #[must_use]
    pub fn of(design: &BallScrew) -> Self {
        Self::with(
            design,
            ContactStiffness::of(design, Groove::Screw),
            ContactStiffness::of(design, Groove::Nut),
        )
    }

    /// The same with contacts that are known otherwise: from other curvatures or materials.
    #[must_use]
    pub fn with(design: &BallScrew, screw: ContactStiffness, nut: ContactStiffness) -> Self {
        let ball_radius = design.ball_radius();
        let cos_lead = design.cos_lead_angle();
        let angle = design.contact_angle();
        let path = 0.5 * design.path_radius();
        Self {
            screw,
            nut,
            slip: ball_radius * (design.tan_lead_angle() * cos_lead),
            spin: [
                0.5 * angle.sin * cos_lead,
                path / ball_radius * (angle.sin / angle.cos),
            ],
            path,
            per_axial_load: 1.0 / design.axial_per_normal(),
        }
    }

    /// The contact of ball and one groove.
    #[must_use]
    pub fn contact(&self, groove: Groove) -> &ContactStiffness {
        match groove {
            Groove::Screw => &self.screw,
            Groove::Nut => &self.nut,
        }
    }

    /// Load of each of the two loaded contacts of a ball, N, under an axial load, N, that so many balls share evenly, without
    /// preload.
    #[must_use]
    pub fn contact_load(&self, axial_load: f32, loaded_balls: u16) -> f32 {
        self.per_axial_load * axial_load / f32::from(loaded_balls)
    }

    /// The same for balls of any clearance, N. An oversized ball presses on the other diagonal as well, and the loaded one has to bear
    /// that: `F_U^(2/3) + F_D^(2/3) = 2 F_0^(2/3)`, with `F_U - F_D` the load without preload and `F_0` that of
    /// [`Clearance::preload`], which is the result where no axial load acts.
    ///
    /// Cost: 40 halvings; set-up only. An axial load that is not above zero is none.
    #[must_use]
    pub fn preloaded(&self, axial_load: f32, loaded_balls: u16, clearance: Clearance) -> f32 {
        let load = self.contact_load(axial_load, loaded_balls);
        let load = if load > 0.0 { load } else { 0.0 };
        let deflection = self.mean_deflection();
        let sum = -2.0 * clearance.gap() / deflection;
        if !(sum > 0.0) {
            return load;
        }
        let half = 0.5 * sum;
        first_not_below(load, load + half * constant::sqrt(half), |middle| {
            let left = sum - constant::cbrt_squared(middle);
            let other = if left > 0.0 {
                left * constant::sqrt(left)
            } else {
                0.0
            };
            middle - other < load
        })
    }

    /// Mean deflection of both contacts over the load to the power of 2/3, m/N^(2/3).
    #[must_use]
    pub fn mean_deflection(&self) -> f32 {
        let (screw, nut) = (self.screw.contact(), self.nut.contact());
        0.5 * (screw.deflection_coefficient() + nut.deflection_coefficient())
    }

    /// Slip of both contacts across the path, together, over the nut's angle, m: `l_1`.
    #[must_use]
    pub fn slip_per_angle(&self) -> f32 {
        self.slip
    }

    /// Spin of each contact over the nut's angle, 1: see the table of [`ScrewContacts`].
    #[must_use]
    pub fn spin_per_angle(&self, rolling: Rolling) -> f32 {
        let [two_point, three_point] = self.spin;
        match rolling {
            Rolling::TwoPoint => two_point,
            Rolling::ThreePoint => three_point,
        }
    }

    /// Path that each contact rolls over the nut's angle, m: `r_m/(2 cos(alpha))`.
    #[must_use]
    pub fn path_per_angle(&self) -> f32 {
        self.path
    }

    /// Slip across the path of a ball that does not spin, with the friction coefficient `mu` of ball and groove (not checked) and a
    /// load `F` of both contacts above 0, N: limit `mu F l_1`, N m, stiffness `l_1^2/(C_S + C_N)`, N m/rad, both contacts being in
    /// series. Set-up: two cube roots.
    #[must_use]
    pub fn slip(&self, friction: f32, load: f32) -> Resistance {
        let compliance = self.screw.compliance_across(load) + self.nut.compliance_across(load);
        Resistance {
            limit: friction * load * self.slip,
            stiffness: self.slip * self.slip / compliance,
        }
    }

    /// Spin of both contacts of a ball that does not slip, with `mu` and `F` as in [`Self::slip`]: of each the limit `M_0 s`, N m,
    /// and the stiffness `k_tor s^2`, N m/rad, with the spin `s` over the nut's angle ([`Self::spin_per_angle`]). Set-up.
    #[must_use]
    pub fn spin(&self, friction: f32, load: f32, rolling: Rolling) -> Resistance {
        let per_angle = self.spin_per_angle(rolling);
        let screw = self.screw.spin(friction, load, per_angle);
        screw.beside(self.nut.spin(friction, load, per_angle))
    }

    /// Slip and spin of a ball that does both, with `mu` and `F` as in [`Self::slip`]: stiffnesses as alone, limits by the limit surface
    /// of Coulomb friction, N m and N m/rad.
    ///
    /// Slip takes off the spin's moment, and spin off the slip's force: the power of both together is less than the sum. With the slip
    /// `l_1/2` and the spin `s` of each contact over the nut's angle its limits are `mu F a s (P - M)` and `mu F a s M`, `P` and `M`
    /// by the integrals of `contact/integrals.rs` at an axis ratio of 0.02 to 0.95. Exact for gross sliding; before it
    /// within 5 %. Set-up: elliptic integrals for each contact.
    #[must_use]
    pub fn slip_and_spin(
        &self,
        friction: f32,
        load: f32,
        rolling: Rolling,
    ) -> (Resistance, Resistance) {
        self.spinning(friction, load, self.spin_per_angle(rolling))
    }

    /// The same with any spin of both contacts over the nut's angle, above 0.
    pub(super) fn spinning(&self, friction: f32, load: f32, spin: f32) -> (Resistance, Resistance) {
        let screw = self.limits(&self.screw, friction, load, spin);
        let nut = self.limits(&self.nut, friction, load, spin);
        let slip = Resistance {
            limit: screw.0 + nut.0,
            ..self.slip(friction, load)
        };
        let torsion = self.screw.torsion_stiffness(load) + self.nut.torsion_stiffness(load);
        let spin = Resistance {
            limit: screw.1 + nut.1,
            stiffness: torsion * (spin * spin),
        };
        (slip, spin)
    }

    /// Friction of gross slip and of gross spin of one contact that does both, N m.
    fn limits(
        &self,
        contact: &ContactStiffness,
        friction: f32,
        load: f32,
        spin: f32,
    ) -> (f32, f32) {
        let ellipse = contact.contact();
        let end_speed = ellipse.semi_major_coefficient() * constant::cbrt(load) * spin;
        let axis_ratio = ellipse
            .axis_ratio()
            .clamp(AXIS_RATIO.minimum, AXIS_RATIO.maximum);
        let (power, moment) = slip_and_spin(axis_ratio, 0.5 * self.slip / end_speed);
        let whole = friction * load * end_speed;
        (whole * (power - moment), whole * moment)
    }

    /// Rolling resistance of both contacts of a ball under a load of each, N, above 0: limit, N m, that of [`RollingContact::force`]
    /// times the rolled path, stiffness, N m/rad, such that it builds up over a path of `2 b`, the length of the contact. Set-up.
    pub fn rolling(
        &self,
        design: &BallScrew,
        resistance: RollingResistance,
        load: f32,
    ) -> Result<Resistance, Error> {
        let screw = RollingContact::of(design, Groove::Screw, resistance)?;
        let nut = RollingContact::of(design, Groove::Nut, resistance)?;
        let screw = self.screw.rolling(&screw, load, self.path);
        Ok(screw.beside(self.nut.rolling(&nut, load, self.path)))
    }
}
