//! Friction of a contact that slips across the track by a given speed, as a table over its size.

use crate::error::{Error, attempt, in_range};
use crate::math::constant;
use crate::math::elliptic::{incomplete, narrow_integral};

const CELLS: usize = 10;

/// Keeps the division by the slip and the spin from zero, m.
const LEAST_SLIP: f32 = 1e-30;

/// A contact of ball and groove that slips across the track by a given speed and spins, under any load.
///
/// With the speed `r = a |w|` that the spin gives the end of the major axis, and the slip `v`, power loss and compliance over the sum of `r` and
/// `c v` are functions of `t = r/(r + c v)` alone, smooth from the lightest contact, which slides (`t = 0`), to the heaviest, which rolls (`t = 1`):
///
/// ```text
/// D = (r + c v) F(t)    dD/d ln r = r (F + (1 - t) F')    dD/dv = c (F - t F')      c = 1/sqrt(k)
/// ```
///
/// and the compliance alike. Cubics between eleven places, with values and slopes there by the exact integrals.
///
/// Largest errors against the integrals, axis ratios 0.05 to 0.35 (0.02 to 0.95): power loss 5e-5 (2.1e-4) and compliance
/// 3.1e-4 (1.6e-3) of themselves, share of sliding friction 6.7e-4 (2.0e-3); both changes 3.7e-4 (1.7e-3) of the power
/// loss and 2.7e-3 (1.5e-2) of the compliance.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct AcrossTable {
    /// `c v`, m.
    slip: f32,
    /// `c`.
    reach: f32,
    /// Friction force over `mu F` by the ratio of slip and the end's speed, where that is small.
    share_slope: f32,
    /// `F` and its slope by a cell, then those of the compliance.
    nodes: [[f32; 4]; CELLS + 1],
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Across {
    /// Power loss over `mu F`, m per unit of nut speed.
    pub(crate) drag: f32,
    /// Slip along the track over the friction force that resists it, times `mu F`, in the same unit.
    pub(crate) compliance: f32,
    /// Friction force across the track over `mu F`, 0 to 1.
    pub(crate) share: f32,
    /// Change of the drag with the logarithm of the ellipse's size or of the spin.
    pub(crate) drag_growth: f32,
    /// Change of the compliance with it.
    pub(crate) compliance_growth: f32,
}

impl AcrossTable {
    /// The table of a contact with the axis ratio `b/a`, 0.02 to 0.95, that slips by `slip`, m.
    pub(crate) const fn new(axis_ratio: f32, slip: f32) -> Result<Self, Error> {
        let k = attempt!(checked_axis_ratio(axis_ratio));
        let reach = 1.0 / constant::sqrt(k);
        let cell = 1.0 / CELLS as f32;
        // A contact that slides: both are the slip, whatever its size.
        let sliding = 1.0 / reach;
        let mut nodes = [[sliding, -sliding * cell, sliding, -sliding * cell]; CELLS + 1];
        let mut node = 1;
        while node <= CELLS {
            let t = node as f32 * cell;
            let slip = (1.0 / t - 1.0) / reach;
            let [drag, drag_growth, compliance, compliance_growth] = spinning(k, slip);
            let (value, compliance_value) = (t * drag, t * compliance);
            nodes[node] = if node < CELLS {
                let per_cell = cell / (1.0 - t);
                [
                    value,
                    (drag_growth - value) * per_cell,
                    compliance_value,
                    (compliance_growth - compliance_value) * per_cell,
                ]
            } else {
                // Both are even in the slip.
                [
                    value,
                    value * cell,
                    compliance_value,
                    compliance_value * cell,
                ]
            };
            node += 1;
        }
        let (_, across) = incomplete(k * k, 0.0);
        Ok(Self {
            slip: reach * slip + LEAST_SLIP,
            reach,
            share_slope: 0.75 * across,
            nodes,
        })
    }

    pub(crate) const fn share_slope(&self) -> f32 {
        self.share_slope
    }

    /// The contact where the spin gives the end of the major axis the speed `end_speed = a |w|`, m.
    pub(crate) const fn at(&self, end_speed: f32) -> Across {
        let whole = end_speed + self.slip;
        let position = end_speed / whole * CELLS as f32;
        let cell = position as usize;
        let cell = if cell < CELLS { cell } else { CELLS - 1 };
        let x = position - cell as f32;
        let [drag, drag_slope, compliance, compliance_slope] = self.nodes[cell];
        let [
            next_drag,
            next_drag_slope,
            next_compliance,
            next_compliance_slope,
        ] = self.nodes[cell + 1];
        let (drag, drag_slope) = cubic(x, [drag, drag_slope], [next_drag, next_drag_slope]);
        let (compliance, compliance_slope) = cubic(
            x,
            [compliance, compliance_slope],
            [next_compliance, next_compliance_slope],
        );
        let remainder = CELLS as f32 - position;
        Across {
            drag: whole * drag,
            compliance: whole * compliance,
            share: self.reach * (drag - position * drag_slope),
            drag_growth: end_speed * (drag + remainder * drag_slope),
            compliance_growth: end_speed * (compliance + remainder * compliance_slope),
        }
    }
}

/// Value and slope of the cubic with given values and slopes at 0 and 1.
#[inline]
const fn cubic(x: f32, [here, slope]: [f32; 2], [there, slope_there]: [f32; 2]) -> (f32, f32) {
    let rise = there - here;
    let third = (slope - rise) + (slope_there - rise);
    let second = (rise - slope) - third;
    let bend = x * third;
    let both = second + bend;
    (
        here + x * (slope + x * both),
        slope + x * (both + both + bend),
    )
}

/// Slip over the speed of the major axis' end from which two terms of the multipole series serve: the next is 1.6e-4 of the power loss.
const FAR: f32 = 2.0;

/// Power loss and moment of a contact that slips across the track and spins, over `mu F a |w|` and `mu F a`, by the slip over
/// the speed `a |w|` of the end of the major axis. At set-up; axis ratio 0.02 to 0.95.
pub const fn slip_and_spin(axis_ratio: f32, slip: f32) -> (f32, f32) {
    if slip < FAR {
        let [power, moment, _, _] = spinning(axis_ratio, slip);
        (power, moment)
    } else {
        // Mean of `sqrt(u^2 + (slip - v)^2)` over the ellipse: the means of u^2, u^4 and u^2 v^2 under a Hertzian pressure are
        // 1/5, 3/35 and k^2/35.
        let inverse = 1.0 / slip;
        let third = (axis_ratio * axis_ratio / 70.0 - 3.0 / 280.0) * (inverse * inverse * inverse);
        (slip + 0.1 * inverse + third, 0.2 * inverse + 4.0 * third)
    }
}

/// Drag, its growth (the change with the logarithm of the end's speed), compliance and its growth, over the end's speed, at a slip over it.
const fn spinning(k: f32, slip: f32) -> [f32; 4] {
    let (square, slip_squared) = (k * k, slip * slip);
    let lambda = if slip_squared > square {
        slip_squared - square
    } else {
        0.0
    };
    let (long, short) = (1.0 + lambda, square + lambda);
    let root = constant::sqrt(lambda);
    let weight = 2.0 * lambda * root / constant::sqrt(long * short);
    let (along, across) = incomplete(square, lambda);
    let both = (across - along) / ((1.0 - k) * (1.0 + k));
    let narrow = fifth_integral(k, lambda, root, along, across);
    let whole = weight + along + square * across;
    let cubic = narrow * slip_squared;
    let share = 0.75 * slip * (across - cubic);
    let moment = 0.1875 * (whole + slip_squared * (3.0 * cubic - 2.0 * across));
    let bend = both * slip_squared;
    let inverse = 1.0 / (along - bend);
    let compliance = (4.0 / 3.0) * inverse;
    [
        moment + slip * share,
        moment,
        compliance,
        compliance - 2.0 * compliance * (bend * inverse),
    ]
}

/// Smallest axis ratio, that of a conformity of about 0.5005.
const SMALLEST_AXIS_RATIO: f32 = 0.02;

/// Largest axis ratio; beyond it differences of the elliptic integrals lose too many digits.
const LARGEST_AXIS_RATIO: f32 = 0.95;

pub(super) const fn checked_axis_ratio(axis_ratio: f32) -> Result<f32, Error> {
    let (least, largest) = (SMALLEST_AXIS_RATIO, LARGEST_AXIS_RATIO);
    in_range("axis_ratio", axis_ratio, least, largest)
}

/// `C5` at `lambda = root²` from `C1` and `C2`: by parts where `lambda` is below `k²`,
/// and beyond by quadrature, where the difference by parts would leave nothing of it.
pub(super) const fn fifth_integral(k: f32, lambda: f32, root: f32, first: f32, second: f32) -> f32 {
    let square = k * k;
    if lambda < square {
        let (long, short) = (1.0 + lambda, square + lambda);
        let weight = 2.0 * lambda * root / constant::sqrt(long * short);
        let fourth = (second - first) / ((1.0 - k) * (1.0 + k));
        (second - fourth - weight / short) / (3.0 * square)
    } else {
        narrow_integral(square, root)
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;

    fn errors(k: f32) -> [f32; 5] {
        let Ok(table) = AcrossTable::new(k, 1.0) else {
            panic!("{k}")
        };
        let mut worst = [0.0_f32; 5];
        let mut end_speed = 0.03_f32;
        while end_speed < 3e3 {
            let found = table.at(end_speed);
            let [drag, drag_growth, compliance, compliance_growth] =
                spinning(k, 1.0 / end_speed).map(|x| x * end_speed);
            let now = [
                found.drag / drag - 1.0,
                found.compliance / compliance - 1.0,
                found.share - (drag - drag_growth),
                (found.drag_growth - drag_growth) / drag,
                (found.compliance_growth - compliance_growth) / compliance,
            ];
            for (worst, now) in worst.iter_mut().zip(now) {
                *worst = worst.max(now.abs());
            }
            end_speed *= 1.037;
        }
        worst
    }

    /// The cubics leave `h^4/384` of the fourth derivative.
    #[test]
    fn contacts_that_slip_across_are_those_of_the_integrals() {
        let mut k = 0.02_f32;
        while k <= 0.95 {
            let found = errors(k);
            let bounds = if k < 0.05 {
                [2.5e-4, 1e-3, 1e-3, 1e-3, 2e-3]
            } else if k < 0.35 {
                [6e-5, 4e-4, 7e-4, 4e-4, 3e-3]
            } else {
                [4e-4, 2e-3, 3e-3, 2e-3, 2e-2]
            };
            std::println!("{k:.3}: {found:?}");
            for (found, bound) in found.iter().zip(bounds) {
                assert!(*found < bound, "axis ratio {k}: {found:e} over {bound:e}");
            }
            k *= 1.13;
        }
    }

    #[test]
    fn without_slip_a_contact_rolls() {
        let Ok(table) = AcrossTable::new(0.2, 0.0) else {
            panic!("0.2")
        };
        let (small, large) = (table.at(1e-6), table.at(1e-3));
        assert!((large.drag / small.drag - 1e3).abs() < 1e-2);
        assert!((small.drag_growth / small.drag - 1.0).abs() < 1e-5);
        assert!((small.compliance_growth / small.compliance - 1.0).abs() < 1e-5);
        assert!(small.share.abs() < 1e-5);
    }
}
