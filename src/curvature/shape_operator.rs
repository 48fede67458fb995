//! The shape operator of a groove at a contact point, and its eigenvalues: the principal curvatures.

/// Both principal curvatures at a contact point, 1/m; normal into the metal, `kappa1 > kappa2`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct PrincipalCurvatures {
    /// Curvature about along the ball path: positive for the screw, negative for the nut.
    pub kappa1: f32,
    /// Curvature about across the ball path: about `-1 / groove_radius`.
    pub kappa2: f32,
}

/// Sums of the curvatures of ball and groove in the two principal planes, 1/m: the input of the
/// contact ellipse.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct RelativeCurvatures {
    /// Along the ball path, `1/r_b + kappa1`.
    pub along: f32,
    /// Across the ball path, `1/r_b + kappa2`: about a twentieth of the other.
    pub across: f32,
}

/// The shape operator in orthonormal directions, its elements times `D³`, before the two roots that its
/// eigenvalues need: the loop takes them by an instruction, set-up by [`constant::sqrt`](crate::math::constant::sqrt), and all else is written
/// once.
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

    /// Both principal curvatures by one division: `kappa1 = (h22 spread + h12²)/(spread D³)` with
    /// `spread = h + root`, and `kappa2` likewise.
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
