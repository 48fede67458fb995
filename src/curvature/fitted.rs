//! A five-coefficient fit of the exact first curvature, made once per design.

use super::gothic_arch::GothicArch;
use crate::geometry::{BallScrew, ContactAngle, Groove};
use crate::math::constant;

/// Contact angle, rad (72 degrees), up to which [`FittedCurvature::of`] fits.
pub const DEFAULT_FIT_RANGE: f32 = 1.256_637_1;

const NODES: usize = 5;

/// `cos((2 i + 1) pi / 10)`: the Chebyshev nodes on -1 to 1.
#[doc(hidden)]
pub const CHEBYSHEV: [f32; NODES] = [0.95105652, 0.58778525, 0.0, -0.58778525, -0.95105652];

/// First principal curvature of a gothic-arch groove by a quotient that is exact at five contact
/// angles: `kappa1 = (n0 + n1 cos(beta) + n2 sin(beta)) / (1 - d1 cos(beta) - d2 sin(beta))`.
///
/// The shape is that of a tube about a helix; the coefficients come from the exact curvatures at Chebyshev nodes, by one 5 x 5 linear system. Error on
/// the 31 catalogue sizes, contact angles 0 to 70 degrees: at most 7e-7; over lead angles to 80 degrees with offsets as in use, 1.5e-5. Cost in the
/// loop: one division, 8 other operations.
///
/// ```
/// use epas_friction::CATALOGUE;
/// use epas_friction::curvature::{FittedCurvature, GothicArch};
/// use epas_friction::geometry::{ContactAngle, Groove};
/// let design = CATALOGUE[15].design()?;
/// let angle = ContactAngle::new(50f32.to_radians());
/// let fitted = FittedCurvature::of(&design, Groove::Nut).first(angle);
/// let exact = GothicArch::of(&design, Groove::Nut).principal(angle).kappa1;
/// assert!((fitted / exact - 1.0).abs() < 1.5e-6);
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FittedCurvature {
    n0: f32,
    n1: f32,
    n2: f32,
    d1: f32,
    d2: f32,
}

impl FittedCurvature {
    /// The fit for one groove of a validated design, for contact angles 0 to 72 degrees; for constants too.
    #[must_use]
    pub const fn of(design: &BallScrew, groove: Groove) -> Self {
        Self::new(&GothicArch::of(design, groove), DEFAULT_FIT_RANGE)
    }

    /// The fit for contact angles 0 to `largest_contact_angle`, rad, cut to 0.2 to 1.55. Set-up only.
    #[must_use]
    pub const fn new(arch: &GothicArch, largest_contact_angle: f32) -> Self {
        let half_range = 0.5 * largest_contact_angle.clamp(0.2, 1.55);
        // Curvatures in units of the groove's own, so that the system is free of scale.
        let scale = arch.groove_radius();
        let mut system = [[0.0; NODES + 1]; NODES];
        let mut node = 0;
        while node < NODES {
            let angle = ContactAngle::new(half_range - half_range * CHEBYSHEV[node]);
            let kappa1 = arch.first(angle) * scale;
            system[node] = [
                1.0,
                angle.cos,
                angle.sin,
                kappa1 * angle.cos,
                kappa1 * angle.sin,
                kappa1,
            ];
            node += 1;
        }
        let [n0, n1, n2, d1, d2] = solve(system);
        let unscale = 1.0 / scale;
        Self {
            n0: n0 * unscale,
            n1: n1 * unscale,
            n2: n2 * unscale,
            d1,
            d2,
        }
    }

    /// First principal curvature, 1/m.
    #[inline]
    pub const fn first(&self, contact_angle: ContactAngle) -> f32 {
        let ContactAngle { cos, sin } = contact_angle;
        // The products first: each is ready when a sum takes it.
        let (along, across) = (self.n1 * cos, self.d1 * cos);
        let (along_2, across_2) = (self.n2 * sin, self.d2 * sin);
        ((self.n0 + along) + along_2) / ((1.0 - across) - across_2)
    }
}

/// A pivot smaller than this beside columns of length one is rounding.
const RANK_TOLERANCE: f32 = 4.0 * f32::EPSILON;

/// A row for every node: coefficients, and last the right-hand side.
type Rows = [[f32; NODES + 1]; NODES];

/// Gaussian elimination with scaled columns and partial pivoting. Where a column vanishes but for rounding (a circular groove, a lead of zero), any
/// value of its unknown solves the system: zero is taken.
const fn solve(mut rows: Rows) -> [f32; NODES] {
    let column_scale = scale_columns(&mut rows);
    eliminate(&mut rows);
    let mut solution = substitute_back(&rows);
    let mut column = 0;
    while column < NODES {
        solution[column] *= column_scale[column];
        column += 1;
    }
    solution
}

#[inline]
const fn scale_columns(rows: &mut Rows) -> [f32; NODES] {
    let mut column_scale = [0.0; NODES];
    let mut column = 0;
    while column < NODES {
        let mut sum = 0.0;
        let mut row = 0;
        while row < NODES {
            sum += rows[row][column] * rows[row][column];
            row += 1;
        }
        let scale = if sum > 0.0 {
            1.0 / constant::sqrt(sum)
        } else {
            0.0
        };
        let mut row = 0;
        while row < NODES {
            rows[row][column] *= scale;
            row += 1;
        }
        column_scale[column] = scale;
        column += 1;
    }
    column_scale
}

/// Forward elimination: what lies left of the diagonal counts as zero from then on.
#[inline]
const fn eliminate(rows: &mut Rows) {
    let mut pivot = 0;
    while pivot < NODES {
        // Rows are exchanged one after the other until the largest element is on top: every index is a loop counter, and no bounds check or
        // copy of memory remains.
        let mut below = pivot + 1;
        while below < NODES {
            if rows[below][pivot].abs() > rows[pivot][pivot].abs() {
                let mut column = pivot;
                while column <= NODES {
                    let above = rows[pivot][column];
                    rows[pivot][column] = rows[below][column];
                    rows[below][column] = above;
                    column += 1;
                }
            }
            below += 1;
        }
        let upper = rows[pivot];
        let diagonal = upper[pivot];
        if !(diagonal.abs() <= RANK_TOLERANCE) {
            let mut below = pivot + 1;
            while below < NODES {
                let factor = rows[below][pivot] / diagonal;
                let mut column = pivot + 1;
                while column <= NODES {
                    rows[below][column] -= factor * upper[column];
                    column += 1;
                }
                below += 1;
            }
        }
        pivot += 1;
    }
}

#[inline]
const fn substitute_back(rows: &Rows) -> [f32; NODES] {
    let mut solution = [0.0; NODES];
    let mut solved = 0;
    while solved < NODES {
        let pivot = NODES - 1 - solved;
        let row = &rows[pivot];
        let mut remainder = row[NODES];
        let mut column = pivot + 1;
        while column < NODES {
            remainder -= row[column] * solution[column];
            column += 1;
        }
        if row[pivot].abs() > RANK_TOLERANCE {
            solution[pivot] = remainder / row[pivot];
        }
        solved += 1;
    }
    solution
}
