//! The exact principal curvatures of a gothic-arch groove.

use crate::error::{Error, attempt, in_range};
use crate::geometry::{BallScrew, ContactAngle, Groove, GrooveProfile, HelixPath, SMALLEST_AREA};
use crate::math::{self, constant};

/// Both principal curvatures at a contact point, 1/m; normal into the metal, `kappa1 > kappa2`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct PrincipalCurvatures {
    /// Curvature about along the ball path: positive for the screw, negative for the nut.
    pub kappa1: f32,
    /// Curvature about across the ball path: about `-1 / groove_radius`.
    pub kappa2: f32,
}

/// Sums of the curvatures of ball and groove in the two principal planes, 1/m.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct RelativeCurvatures {
    /// Along the ball path, `1/r_b + kappa1`.
    pub along: f32,
    /// Across the ball path, `1/r_b + kappa2`: about a twentieth of the other.
    pub across: f32,
}

/// The shape operator in orthonormal directions, its elements times `D³`, before the two roots that its eigenvalues need: the loop takes them
/// by an instruction, set-up by [`constant::sqrt`](crate::math::constant::sqrt).
pub(super) struct ShapeOperator {
    /// `A`.
    pub(super) area: f32,
    /// `(tau p)²`.
    pub(super) twist_squared: f32,
    /// `D²`.
    pub(super) scale_squared: f32,
    pub(super) h11: f32,
    pub(super) h22: f32,
    pub(super) h12_squared: f32,
    /// `h`.
    pub(super) half_difference: f32,
    /// `h² + h12²`.
    pub(super) radicand: f32,
}

impl ShapeOperator {
    /// `q = h12² / (h + root)` and `1 / D³`, from `root = sqrt(radicand)` and `scale = D`.
    #[inline]
    pub(super) const fn quotients(&self, root: f32, scale: f32) -> (f32, f32) {
        (
            self.h12_squared / (self.half_difference + root),
            1.0 / (self.scale_squared * scale),
        )
    }

    /// Both principal curvatures by one division: `kappa1 = (h22 spread + h12²)/(spread D³)`, `spread = h + root`.
    #[inline]
    pub(super) const fn eigenvalues(&self, root: f32, scale: f32) -> PrincipalCurvatures {
        let (cube, spread) = (self.scale_squared * scale, self.half_difference + root);
        let inverse = 1.0 / (cube * spread);
        let (first, second) = (self.h22 * spread, self.h11 * spread);
        PrincipalCurvatures {
            kappa1: (first + self.h12_squared) * inverse,
            kappa2: (second - self.h12_squared) * inverse,
        }
    }
}

/// The exact principal curvatures of a gothic-arch groove swept along a helix.
///
/// With `zeta` = +1 screw, -1 nut, path curvature `kappa` and torsion `tau`, `c = cos(beta)`,
/// `s = sin(beta)`, `w = H c + L s`, `p = H s - L c`, `rho = r_s - w`,
/// `A = 1 + zeta kappa (H - r_s c)`, `D² = A² + tau² p²`, the shape operator in orthonormal directions
/// is
///
/// ```text
/// h11 = -A / (r_s D)
/// h12 = zeta tau (A w / r_s - zeta kappa p s) / D²
/// h22 = { zeta kappa [A² c + tau² p (p c - rho s)] + tau² A rho w / r_s } / D³
/// h = (h22 - h11) / 2,   q = h12² / (h + sqrt(h² + h12²))
/// kappa1 = h22 + q,      kappa2 = h11 - q
/// ```
///
/// It equals the eigenvalues of the Weingarten map (Bertolino et al. 2023, eq. (17)-(24)) without their cancelling subtraction. Two misprints of
/// Appendix B are **corrected** by construction: (A1a) returns `kappa2`, and (A1m) lacks a `zeta`. Error over lead angles and contact angles 0 to 80
/// degrees: `kappa1` within 6e-7, `kappa2` within 3e-7; close to the nut's zero of `kappa1` within 1e-7 of `kappa2`.
///
/// ```
/// use epas_friction::CATALOGUE;
/// use epas_friction::curvature::GothicArch;
/// use epas_friction::geometry::{ContactAngle, Groove};
/// let design = CATALOGUE[15].design()?; // 32 x 20 x 6.35
/// let screw = GothicArch::of(&design, Groove::Screw);
/// let curvatures = screw.principal(ContactAngle::new(45f32.to_radians()));
/// assert!((curvatures.kappa1 - 49.18).abs() < 0.01); // the path bends with a radius of 20 mm
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct GothicArch {
    groove: Groove,
    path: HelixPath,
    /// `zeta kappa`.
    signed_curvature: f32,
    /// `r_s`.
    groove_radius: f32,
    /// `1 / r_s`.
    profile_curvature: f32,
    /// `A = area_offset - area_slope c`: `1 + zeta kappa H` and `zeta kappa r_s`.
    area_offset: f32,
    area_slope: f32,
    /// `tau H`, `tau L`: `tau p = twist_h s - twist_l c`, `tau w = twist_h c + twist_l s`.
    twist_h: f32,
    twist_l: f32,
    /// `tau r_s`.
    twist_radius: f32,
}

/// Largest groove radius times curvature or torsion of the path: more than 1 is for the study of surfaces close to their fold.
const LARGEST_RADIUS: f32 = 10.0;

/// Largest offset of the nut's profile over the path's radius: with its centre on the axis the nut's two curvatures are equal.
const LARGEST_OFFSET: f32 = 0.9;

/// Groove radius over the path's radius of curvature, or 1 / torsion, up to which the two curvatures never change places (swept).
const SURELY_APART: f32 = 0.5;

impl GothicArch {
    /// Constants of one groove from its path and section, unchecked: for a design that [`BallScrew::new`] has checked.
    #[must_use]
    pub const fn new(groove: Groove, path: &HelixPath, profile: &GrooveProfile) -> Self {
        let signed_curvature = groove.sign() * path.curvature;
        Self {
            groove,
            path: *path,
            signed_curvature,
            groove_radius: profile.groove_radius,
            profile_curvature: 1.0 / profile.groove_radius,
            area_offset: 1.0 + signed_curvature * profile.offset_h,
            area_slope: signed_curvature * profile.groove_radius,
            twist_h: path.torsion * profile.offset_h,
            twist_l: path.torsion * profile.offset_l,
            twist_radius: path.torsion * profile.groove_radius,
        }
    }

    /// Constants of one groove of a validated design; for constants too.
    #[must_use]
    pub const fn of(design: &BallScrew, groove: Groove) -> Self {
        Self::new(groove, design.path(), design.profile(groove))
    }

    /// Constants of one groove from plain numbers in any one unit of length, all checked, for contact angles near `contact_angle`.
    ///
    /// # Errors
    /// [`Error`] naming `curvature`, `torsion`, `groove_radius` (1e-9 to 1e9, and ten radii of the path), `offset_h` or `offset_l`;
    /// [`Error::FoldedGroove`] where the surface folds at this contact angle (`A < 1e-4`), the centre of the nut's profile lies within a tenth of
    /// the path's radius from the axis, or the two curvatures change places.
    pub const fn checked(
        groove: Groove,
        path: &HelixPath,
        profile: &GrooveProfile,
        contact_angle: ContactAngle,
    ) -> Result<Self, Error> {
        attempt!(in_range("curvature", path.curvature, 0.0, 1e9));
        attempt!(in_range("torsion", path.torsion, -1e9, 1e9));
        // Cubes of radius times curvature have to stay within f32.
        let steepest = path.curvature.max(path.torsion.abs());
        let largest = (LARGEST_RADIUS / steepest).min(1e9);
        let radius = profile.groove_radius;
        attempt!(in_range("groove_radius", radius, 1e-9, largest));
        attempt!(in_range("offset_h", profile.offset_h, 0.0, radius));
        attempt!(in_range("offset_l", profile.offset_l, 0.0, radius));
        let arch = Self::new(groove, path, profile);
        // A = 1 + zeta kappa (H - r_s c): the screw folds by its groove radius, the nut by its offset.
        let path_radius = 1.0 / path.curvature;
        let nut = matches!(groove, Groove::Nut);
        if nut && path.curvature * profile.offset_h > LARGEST_OFFSET {
            let largest = LARGEST_OFFSET * path_radius;
            return Err(Error::folded("offset_h", profile.offset_h, 0.0, largest));
        }
        if arch.area(contact_angle) < SMALLEST_AREA {
            let room = (1.0 - SMALLEST_AREA) * path_radius + profile.offset_h;
            let largest = room / contact_angle.cos;
            return Err(Error::folded("groove_radius", radius, 0.0, largest));
        }
        // Half the difference of the curvatures about along and about across the path: where it is not positive, its sum with the root cancels.
        let shape = arch.shape_operator(contact_angle);
        if shape.half_difference <= 0.0 {
            let largest = SURELY_APART / steepest;
            return Err(Error::folded("groove_radius", radius, 0.0, largest));
        }
        Ok(arch)
    }

    /// Both principal curvatures, 1/m: finite at a contact angle at which [`GothicArch::checked`] accepts the groove. Cost: 2 square roots,
    /// 1 division, 44 other operations.
    #[inline]
    pub fn principal(&self, contact_angle: ContactAngle) -> PrincipalCurvatures {
        let shape = self.shape_operator(contact_angle);
        let (root, scale) = math::sqrt_pair(shape.radicand, shape.scale_squared);
        shape.eigenvalues(root, scale)
    }

    /// The first of them with fewer roundings, for constants that are derived from it.
    pub(super) const fn first(&self, contact_angle: ContactAngle) -> f32 {
        let shape = self.shape_operator(contact_angle);
        let root = constant::sqrt(shape.radicand);
        let (shift, inverse_cube) = shape.quotients(root, constant::sqrt(shape.scale_squared));
        (shape.h22 + shift) * inverse_cube
    }

    /// Sums of the curvatures of groove and ball, 1/m, for a ball whose radius is smaller than the
    /// groove's by `clearance`, m (inverse of the radii of Lin 2019, eq. (B.3); Alberdi et al., eqs. (7), (8)).
    ///
    /// The second sum cancels to a twentieth; it is formed from the clearance and
    /// `kappa2 + 1/r_s = (tau p)² / (r_s D (D + A)) - q`, so that no digit is lost. Cost: 2 square roots, 4 divisions, 46 other operations.
    pub const fn relative(
        &self,
        contact_angle: ContactAngle,
        clearance: f32,
    ) -> RelativeCurvatures {
        let shape = self.shape_operator(contact_angle);
        let scale = constant::sqrt(shape.scale_squared);
        let (shift, inverse_cube) = shape.quotients(constant::sqrt(shape.radicand), scale);
        let ball_curvature = 1.0 / (self.groove_radius - clearance);
        let excess = shape.twist_squared * self.profile_curvature / (scale * (scale + shape.area))
            - shift * inverse_cube;
        RelativeCurvatures {
            along: ball_curvature + (shape.h22 + shift) * inverse_cube,
            across: clearance * ball_curvature * self.profile_curvature + excess,
        }
    }

    /// The groove.
    pub const fn groove(&self) -> Groove {
        self.groove
    }

    /// The path that the groove follows.
    pub const fn path(&self) -> HelixPath {
        self.path
    }

    /// Radius of the profile circle, m.
    pub const fn groove_radius(&self) -> f32 {
        self.groove_radius
    }

    /// `A = 1 + zeta kappa (H - r_s c)`; the surface is regular while it is positive.
    #[inline]
    const fn area(&self, contact_angle: ContactAngle) -> f32 {
        self.area_offset - self.area_slope * contact_angle.cos
    }

    #[inline]
    const fn shape_operator(&self, contact_angle: ContactAngle) -> ShapeOperator {
        let ContactAngle { cos, sin } = contact_angle;
        let area = self.area(contact_angle);
        // tau p, tau w, tau rho, A / r_s
        let twist = self.twist_h * sin - self.twist_l * cos;
        let turn = self.twist_h * cos + self.twist_l * sin;
        let twist_rho = self.twist_radius - turn;
        let area_over_radius = area * self.profile_curvature;

        let area_squared = area * area;
        let twist_squared = twist * twist;
        let scale_squared = area_squared + twist_squared;

        // Everything times D³, so that its root and its division wait for nothing. Only the square of h12 is used.
        let h11 = -(area_over_radius * scale_squared);
        let h22 = self.signed_curvature
            * (area_squared * cos + twist * (twist * cos - twist_rho * sin))
            + area_over_radius * (twist_rho * turn);
        let mixed = area_over_radius * turn - self.signed_curvature * (twist * sin);
        let h12_squared = mixed * mixed * scale_squared;
        let half_difference = 0.5 * (h22 - h11);
        ShapeOperator {
            area,
            twist_squared,
            scale_squared,
            h11,
            h22,
            h12_squared,
            half_difference,
            radicand: half_difference * half_difference + h12_squared,
        }
    }
}
