//! The contact ellipse: axis ratio, semi-axes, deflection and pressure of one Hertzian contact, folded at set-up but for the cube root of the load.

use crate::curvature::{GothicArch, RelativeCurvatures};
use crate::error::{Error, attempt, in_range};
use crate::geometry::{BallScrew, Groove, LinearBearing};
use crate::material::contact_modulus;
use crate::math::elliptic::{Complete, complete};
use crate::math::{self, constant};

/// Largest ratio of the two relative radii, of conformities from 0.500 01 on.
pub const LARGEST_RADIUS_RATIO: f32 = 1e5;

/// A Hertzian contact with folded constants.
///
/// ```text
/// a     = (3 E Rs F / (pi k² E*))^(1/3)      Rs = R1 R2 / (R1 + R2)
/// b     = k a
/// delta = 3 K F / (2 pi a E*)
/// p0    = 3 F / (2 pi a b)
/// ```
///
/// with relative radii `R1 <= R2`, contact modulus `E*` and complete elliptic integrals `E`, `K` of `sqrt(1 - k²)` (Johnson's theory as in Lin 2019,
/// eqs. (B.1), (B.7), (B.10), (B.11); Alberdi et al., eqs. (4), (5)). **Corrected:** the exponents of (B.11) are 1/3. Errors against exact elliptic
/// integrals, ratios 1 to 1e5: axis ratio 1.2e-5, semi-axes 1e-5, deflection 5e-6, pressure 1e-5.
///
/// ```
/// use epas_friction::CATALOGUE;
/// use epas_friction::geometry::Groove;
/// use epas_friction::hertz::HertzContact;
/// let design = CATALOGUE[15].design()?; // 32 x 20 x 6.35
/// let contact = HertzContact::of(&design, Groove::Screw);
/// let ellipse = contact.at(100.0);
/// assert!(ellipse.semi_major > 5.0 * ellipse.semi_minor);
/// assert!((ellipse.max_pressure - 1.4286e9).abs() < 1e5);
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct HertzContact {
    axis_ratio: f32,
    semi_major: f32,
    semi_minor: f32,
    deflection: f32,
    max_pressure: f32,
}

/// The contact ellipse under one load.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ContactEllipse {
    /// Semi-major axis `a`, m (across the ball path in a groove).
    pub semi_major: f32,
    /// Semi-minor axis `b`, m (along the ball path in a groove).
    pub semi_minor: f32,
    /// Approach `delta` of the two bodies, m.
    pub deflection: f32,
    /// Pressure `p0` in the centre, Pa (Lin 2019, eqs. (3.15), (B.7)).
    pub max_pressure: f32,
}

impl HertzContact {
    /// Constants from the two relative curvatures, 1/m in either order, and the contact modulus, Pa; unchecked. Cost: 2 cube roots, 5 square
    /// roots, 8 divisions.
    #[must_use]
    pub const fn new(relative: RelativeCurvatures, contact_modulus: f32) -> Self {
        let (steep, flat) = if relative.along >= relative.across {
            (relative.along, relative.across)
        } else {
            (relative.across, relative.along)
        };
        let axis_ratio = axis_ratio(flat / steep);
        let Complete { first, second, .. } = complete(axis_ratio);

        // The load is factored out: a = semi_major F^(1/3), and likewise the others.
        let semi_major = constant::cbrt(
            3.0 * second
                / (core::f32::consts::PI * axis_ratio * axis_ratio)
                / ((steep + flat) * contact_modulus),
        );
        let semi_minor = axis_ratio * semi_major;
        let shared = 3.0 / core::f32::consts::TAU / semi_major;
        Self {
            axis_ratio,
            semi_major,
            semi_minor,
            deflection: shared * first / contact_modulus,
            max_pressure: shared / semi_minor,
        }
    }

    /// Constants from two relative radii, m in either order, and the contact modulus, Pa; checked.
    ///
    /// # Errors
    /// [`Error`] naming `relative_radius_1`, `relative_radius_2` (1e-9 to 1e9, ratio at most
    /// [`LARGEST_RADIUS_RATIO`]) or `contact_modulus` (1e3 to 1e15).
    pub const fn checked(
        relative_radius_1: f32,
        relative_radius_2: f32,
        contact_modulus: f32,
    ) -> Result<Self, Error> {
        let first = attempt!(in_range("relative_radius_1", relative_radius_1, 1e-9, 1e9));
        let smallest = (first / LARGEST_RADIUS_RATIO).max(1e-9);
        let largest = (first * LARGEST_RADIUS_RATIO).min(1e9);
        let radius = relative_radius_2;
        let second = attempt!(in_range("relative_radius_2", radius, smallest, largest));
        let modulus = attempt!(in_range("contact_modulus", contact_modulus, 1e3, 1e15));
        let relative = RelativeCurvatures {
            along: 1.0 / first,
            across: 1.0 / second,
        };
        Ok(Self::new(relative, modulus))
    }

    /// The contact of ball and one groove of a ball screw, at its nominal contact angle.
    #[must_use]
    pub const fn of(design: &BallScrew, groove: Groove) -> Self {
        let arch = GothicArch::of(design, groove);
        let parameters = design.parameters();
        Self::new(
            arch.relative(design.contact_angle(), design.clearance(groove)),
            contact_modulus(&parameters.ball_material, &parameters.groove_material),
        )
    }

    /// The contact of ball and groove of a linear bearing: the track is straight.
    #[must_use]
    pub const fn of_linear(design: &LinearBearing) -> Self {
        let parameters = design.parameters();
        let ball_curvature = 1.0 / design.ball_radius();
        Self::new(
            RelativeCurvatures {
                along: ball_curvature,
                across: ball_curvature * design.clearance() / design.groove_radius(),
            },
            contact_modulus(&parameters.ball_material, &parameters.groove_material),
        )
    }

    /// The ellipse under `load`, N; without extent where that is not positive or NaN. An infinite load counts as the largest number. Cost: one cube
    /// root and 5 other operations.
    #[inline]
    pub fn at(&self, load: f32) -> ContactEllipse {
        // False for NaN too.
        let load = if load > 0.0 { load } else { 0.0 };
        let root = math::cbrt(if load < f32::MAX { load } else { f32::MAX });
        ContactEllipse {
            semi_major: self.semi_major * root,
            semi_minor: self.semi_minor * root,
            deflection: self.deflection * (root * root),
            max_pressure: self.max_pressure * root,
        }
    }

    /// Axis ratio `k = b/a`, 0 to 1.
    pub const fn axis_ratio(&self) -> f32 {
        self.axis_ratio
    }

    /// Semi-major axis per cube root of the load, m/N^(1/3).
    pub const fn semi_major_coefficient(&self) -> f32 {
        self.semi_major
    }

    /// Semi-minor axis per cube root of the load, m/N^(1/3).
    pub const fn semi_minor_coefficient(&self) -> f32 {
        self.semi_minor
    }

    /// Deflection per load to the power 2/3, m/N^(2/3).
    pub const fn deflection_coefficient(&self) -> f32 {
        self.deflection
    }

    /// Largest pressure per cube root of the load, Pa/N^(1/3).
    pub const fn max_pressure_coefficient(&self) -> f32 {
        self.max_pressure
    }
}

/// Coefficients of `N(x)` of [`axis_ratio`], from the constant on.
#[doc(hidden)]
pub const AXIS_RATIO_NUMERATOR: [f32; 6] = [
    7.79600917,
    610.73455674,
    5099.78270213,
    4178.1987507,
    7032.48001515,
    -1288.84940892,
];

/// Coefficients of `D(x)`, from the constant on.
#[doc(hidden)]
pub const AXIS_RATIO_DENOMINATOR: [f32; 5] = [
    1.0,
    268.19154063,
    4970.99764586,
    6769.88079708,
    3630.23062516,
];

/// Axis ratio `k = b/a` of the contact ellipse from the ratio `R1/R2` of the relative radii, 1e-5 to 1: `k = x² N(x) / D(x)` with
/// `x = (R1/R2)^(1/3)`, a minimax fit of `k / x²` to the solution of `(E/k² - K) / (K - E) = R2/R1` (Lin 2019, eq. (B.8), whose left side is
/// printed upside down); largest relative error 1.02e-5, in f32 1.1e-5. Made again in `host-tests/tests/generators/axis_ratio.rs`.
#[inline]
const fn axis_ratio(radius_ratio: f32) -> f32 {
    let x = constant::cbrt(radius_ratio);
    let [n0, n1, n2, n3, n4, n5] = AXIS_RATIO_NUMERATOR;
    let numerator = n0 + x * (n1 + x * (n2 + x * (n3 + x * (n4 + x * n5))));
    let [d0, d1, d2, d3, d4] = AXIS_RATIO_DENOMINATOR;
    let denominator = d0 + x * (d1 + x * (d2 + x * (d3 + x * d4)));
    let ratio = x * x * (numerator / denominator);
    if ratio < 1.0 { ratio } else { 1.0 }
}
