//! Stiffness of one contact before it slides.

use core::f32::consts::PI;

use super::parts::{Resistance, SLOPE};
use epas_friction::contact::RollingContact;
use epas_friction::geometry::{BallScrew, Groove, LinearBearing};
use epas_friction::hertz::HertzContact;
use epas_friction::material::Material;
use epas_friction::math::constant;
use epas_friction::math::elliptic::{Complete, complete};

/// Stiffness of a Hertzian contact against slip and spin, while friction holds it.
///
/// With the semi-axes `a >= b = k a` (major axis across the ball path), `e^2 = 1 - k^2`, complete elliptic integrals `K`,
/// `E` of `e`, shear modulus `G` and Poisson's ratio `nu`:
///
/// ```text
/// C_a    = [(1 - nu) K + nu (K - E)/e^2] / (pi G a)              slip along the major axis
/// C_b    = [(1 - nu) K + nu (E - k^2 K)/e^2] / (pi G a)          slip along the minor axis
/// k_tor  = G a^3 (pi/3) (p + q - 4 nu j) / (p q - nu j (p + q))  spin
///          p = (E/k^2 - K)/e^2    q = (K - E)/e^2    j = ((1 + k^2) K - 2 E)/e^4
/// M_0    = 3/8 E mu F a                                          moment of gross spin
/// ```
///
/// `C_a ~ F^(-1/3)`, `k_tor ~ F`, `M_0 ~ F^(4/3)` with the load `F`. At the circle `C_a = (2 - nu)/(4 G a)` and
/// `k_tor = 8/3 G a^3`. Differences of the integrals are taken in forms that stay exact there.
///
/// Two materials: `2/G = 1/G_1 + 1/G_2`, and `nu` is the mean weighed by `1/G`. Exact for traction in the plane of the
/// contact; pressure that traction makes between unlike materials is left out.
///
/// Source: `C_a` Mindlin 1949; torsion from Cerruti's solution by rays: a traction `(-A y, B x)/sqrt(1 - x^2/a^2 - y^2/b^2)`
/// turns the ellipse as a rigid body (Galin's theorem), and the integrals of its two equations are complete elliptic ones.
///
/// Largest errors against float64 quadrature of those rays over the exact ellipse, axis ratios 0.02 to 1, Poisson's ratios 0 to
/// 0.5: compliances 5e-6, torsion 1.7e-5, relative, and nearly all of it the ellipse's; of a catalogue screw's contact 1.2e-5. Cost: five square roots
/// ([`constant::sqrt`]), ten divisions; set-up only.
///
/// ```
/// use epas_design::breakaway::ContactStiffness;
/// use epas_friction::geometry::Groove;
/// use epas_friction::CATALOGUE;
/// let design = CATALOGUE[15].design()?; // 32 x 20 x 6.35
/// let contact = ContactStiffness::of(&design, Groove::Screw);
/// // Under 100 N friction of 10 N holds the contact for 0.4 um, Mindlin's u_b = 1.5 mu F C_a.
/// let held = 1.5 * 0.1 * 100.0 * contact.compliance_across(100.0);
/// assert!(held > 0.3e-6 && held < 0.5e-6);
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactStiffness {
    contact: HertzContact,
    /// Compliance along the major axis times the cube root of the load, m/N^(2/3).
    across: f32,
    /// Compliance along the minor axis times the cube root of the load, m/N^(2/3).
    along: f32,
    /// Stiffness of torsion over the load, m.
    torsion: f32,
    /// `3/8 E a` over the cube root of the load, m/N^(1/3).
    spin_arm: f32,
}

struct Shear {
    /// `2/G = 1/G_1 + 1/G_2`, Pa.
    modulus: f32,
    poisson_ratio: f32,
}

impl Shear {
    fn of(first: &Material, second: &Material) -> Self {
        let (one, other) = (shear_compliance(first), shear_compliance(second));
        let both = one + other;
        Self {
            modulus: 2.0 / both,
            poisson_ratio: (one * first.poisson_ratio + other * second.poisson_ratio) / both,
        }
    }
}

/// `1/G`, 1/Pa.
fn shear_compliance(material: &Material) -> f32 {
    2.0 * (1.0 + material.poisson_ratio) / material.youngs_modulus
}

/// `C_a G a`, `C_b G a`, `k_tor/(G a^3)` and `E` of an ellipse with this axis ratio.
struct Unit {
    across: f32,
    along: f32,
    torsion: f32,
    second: f32,
}

impl Unit {
    /// `q = K (1/2 + e^2 t)`, `k^2 p = K (1/2 - e^2 t)` and `j = 2 K t` with the tail `t` of [`Complete`].
    fn of(k: f32, nu: f32) -> Self {
        let Complete {
            first,
            second,
            tail,
        } = complete(k);
        let bend = (1.0 - k) * (1.0 + k) * tail;
        let (long, short) = (first * (0.5 + bend), first * (0.5 - bend));
        // All three times k^2, so that none of them grows without bound.
        let (p, q, j) = (short, k * k * long, k * k * (2.0 * first * tail));
        let coupled = nu * j;
        Self {
            across: ((1.0 - nu) * first + nu * long) / PI,
            along: ((1.0 - nu) * first + nu * short) / PI,
            torsion: k * k * (PI / 3.0) * (p + q - 4.0 * coupled) / (p * q - coupled * (p + q)),
            second,
        }
    }
}

impl ContactStiffness {
    /// Stiffness of a contact of two bodies, unchecked: for materials that [`Material::checked`] has passed.
    #[must_use]
    pub fn new(contact: &HertzContact, first: &Material, second: &Material) -> Self {
        let shear = Shear::of(first, second);
        let unit = Unit::of(contact.axis_ratio(), shear.poisson_ratio);
        let semi_major = contact.semi_major_coefficient();
        let per_size = 1.0 / (shear.modulus * semi_major);
        Self {
            contact: *contact,
            across: unit.across * per_size,
            along: unit.along * per_size,
            torsion: unit.torsion * (shear.modulus * semi_major) * semi_major * semi_major,
            spin_arm: 0.375 * unit.second * semi_major,
        }
    }

    /// The contact of ball and one groove of a validated ball screw, at its nominal contact angle.
    #[must_use]
    pub fn of(design: &BallScrew, groove: Groove) -> Self {
        let parameters = design.parameters();
        Self::new(
            &HertzContact::of(design, groove),
            &parameters.ball_material,
            &parameters.groove_material,
        )
    }

    /// The contact of ball and groove of a validated linear bearing.
    #[must_use]
    pub fn of_linear(design: &LinearBearing) -> Self {
        let parameters = design.parameters();
        Self::new(
            &HertzContact::of_linear(design),
            &parameters.ball_material,
            &parameters.groove_material,
        )
    }

    /// The contact ellipse and its constants.
    #[must_use]
    pub fn contact(&self) -> &HertzContact {
        &self.contact
    }

    /// Slip across the ball path over the force that makes it, m/N, both bodies, under a load above 0, N.
    #[must_use]
    pub fn compliance_across(&self, load: f32) -> f32 {
        self.across / constant::cbrt(load)
    }

    /// Slip along the ball path over the force that makes it, m/N, both bodies, under a load above 0, N.
    #[must_use]
    pub fn compliance_along(&self, load: f32) -> f32 {
        self.along / constant::cbrt(load)
    }

    /// Moment over the angle of spin, N m/rad, both bodies, under a load, N.
    #[must_use]
    pub fn torsion_stiffness(&self, load: f32) -> f32 {
        self.torsion * load
    }

    /// Moment of gross spin, N m, under a load, N.
    #[must_use]
    pub fn spin_moment(&self, friction: f32, load: f32) -> f32 {
        self.spin_arm * friction * (load * constant::cbrt(load))
    }

    /// Spin by `per_motion` rad for each unit of the motion, and nothing beside it.
    #[must_use]
    pub fn spin(&self, friction: f32, load: f32, per_motion: f32) -> Resistance {
        Resistance {
            limit: self.spin_moment(friction, load) * per_motion,
            stiffness: self.torsion_stiffness(load) * (per_motion * per_motion),
        }
    }

    /// Rolling by `per_motion` m along the track for each unit of the motion, under a load above 0, N: the resistance builds up
    /// over a path of `2 b`, the length of the contact.
    #[must_use]
    pub fn rolling(&self, resistance: &RollingContact, load: f32, per_motion: f32) -> Resistance {
        let root = constant::cbrt(load);
        let (hysteresis, lubricant) = resistance.coefficients();
        let force = hysteresis * (load * root) + lubricant * constant::sqrt(load);
        let limit = per_motion * force;
        let length = 2.0 * self.contact.semi_minor_coefficient() * root;
        Resistance {
            limit,
            stiffness: SLOPE * limit * per_motion / length,
        }
    }
}
