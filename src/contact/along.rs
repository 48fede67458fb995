//! A contact that slips along the track and spins: a polynomial inside the ellipse, a series outside.

use crate::error::{Error, attempt, in_range};
use crate::math::elliptic::{Complete, complete};

/// Smallest axis ratio that [`FrictionMap::new`] takes: relative radii of ratio 1 to about 1400.
pub const SMALLEST_AXIS_RATIO: f32 = 0.01;

/// From this offset ratio on a contact only slides: its moment is below 1e-9.
const LARGEST_OFFSET: f32 = 1_073_741_824.0;

/// Friction maps of one contact as functions of the offset ratio `x = c/a` of its velocity centre.
///
/// With the axis ratio `k = b/a`, `e² = 1 - k²` and complete elliptic integrals `K`, `E` of `e`:
///
/// ```text
/// |x| <= 1:  P = p0 + kf x²/2 - k3 x⁴/4,  f = kf x - k3 x³,  M = P - x f          (exact)
///            p0 = 3/8 E,  kf = 3/2 (E - k² K)/e²,  k3 = ((1 + k²) E - 2 k² K)/(2 e⁴)
/// |x| > 1:   P = |x| + c1 u + c5 u⁵,  u = 1/|x|,  f = P',  M = P - x f
/// ```
///
/// `c1` and `c5` follow from `P` and `f` being continuous at `|x| = 1`. The quartic is the integral (3.16)-(3.18) of Lin 2019 in closed form,
/// who uses the straight line `kf = 1.38` ([`PUBLISHED_SLOPE`](crate::ball::PUBLISHED_SLOPE)).
///
/// Input: axis ratio 0.01 to 1 at set-up; any offset ratio, signed, in the loop. Offsets beyond ±2^30
/// are taken as ±2^30, NaN as sliding (2^30), so that every output is finite.
///
/// Largest errors against quadrature of the contact integral, axis ratios 0.05 to 1, all offset ratios
/// (rms in brackets): force 8.2e-4 (1.4e-4), moment 1.8e-3 (3.5e-4) of its value at pure spin, power
/// 2.5e-4 (3.1e-5) of itself; inside the contact 3e-7. Cost: 36 modelled cycles inside the contact, 45 outside.
///
/// ```
/// use epas_friction::contact::FrictionMap;
/// let map = FrictionMap::new(0.232)?;
/// let spinning = map.evaluate(0.0);
/// assert_eq!(spinning.force, 0.0);
/// assert!((spinning.moment - 0.399).abs() < 1e-3); // 3/8 E
/// let sliding = map.evaluate(f32::INFINITY);
/// assert_eq!(sliding.force, 1.0);
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FrictionMap {
    spin_moment: f32,
    slope: f32,
    cubic: f32,
    // c1 and c5 of the outer expansion.
    outer: [f32; 2],
}

/// Friction of one contact in units of `mu F` (force), `mu F a` (moment) and `mu F a |w|` (power), with the signs of a positive spin.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct NormalizedFriction {
    /// `f(x) = P'(x)`, -1 to 1, odd.
    pub force: f32,
    /// `M(x) = P - x P'`, even, `3/8 E` at pure spin, 0 at pure slip.
    pub moment: f32,
    /// `P(x)`, even; `|x|` at pure slip.
    pub power: f32,
}

impl FrictionMap {
    /// Maps of a contact with the axis ratio `b/a`, 0.01 to 1; coefficients within 4e-7. Cost: 374 modelled cycles.
    pub const fn new(axis_ratio: f32) -> Result<Self, Error> {
        let axis_ratio = attempt!(in_range("axis_ratio", axis_ratio, SMALLEST_AXIS_RATIO, 1.0));
        Ok(Self::folded(axis_ratio))
    }

    const fn folded(k: f32) -> Self {
        let Complete {
            first: first_kind,
            tail,
            ..
        } = complete(k);
        let k2 = k * k;
        let eccentricity2 = (1.0 - k) * (1.0 + k);
        let second_over_first = 0.5 * (1.0 + k2) - eccentricity2 * eccentricity2 * tail;

        let spin_moment = 0.375 * first_kind * second_over_first;
        let slope = 1.5 * first_kind * (0.5 - eccentricity2 * tail);
        let cubic = 0.5 * first_kind * (0.5 - (1.0 + k2) * tail);

        // P - 1 and f - 1 at the end: c1 + c5 = power_gap, c1 + 5 c5 = -force_gap.
        let power_gap = (spin_moment - 1.0) + 0.5 * slope - 0.25 * cubic;
        let force_gap = (slope - 1.0) - cubic;
        let fifth = 0.25 * (-force_gap - power_gap);
        Self {
            spin_moment,
            slope,
            cubic,
            outer: [power_gap - fifth, fifth],
        }
    }

    /// `M(0) = P(0) = 3/8 E`: moment and power at pure spin (Lin 2019, eq. (3.32)).
    pub const fn spin_moment(&self) -> f32 {
        self.spin_moment
    }

    /// `f'(0)`: the exact slope `k_f` of the friction force (Lin 2019, eq. (3.35)).
    pub const fn slope(&self) -> f32 {
        self.slope
    }

    /// Friction force over `mu F` at offset ratio `c/a`.
    #[inline]
    pub fn force(&self, offset: f32) -> f32 {
        self.evaluate(offset).force
    }

    /// Friction moment over `mu F a` at offset ratio `c/a`.
    #[inline]
    pub fn moment(&self, offset: f32) -> f32 {
        self.evaluate(offset).moment
    }

    /// Power loss over `mu F a |w|` at offset ratio `c/a`.
    #[inline]
    pub fn power(&self, offset: f32) -> f32 {
        self.evaluate(offset).power
    }

    /// Force, moment and power at offset ratio `c/a`. Far away it only slides (Lin 2019, eq. (3.33)).
    #[inline]
    pub fn evaluate(&self, offset: f32) -> NormalizedFriction {
        // Twice the bits, without the sign: one comparison finds the branch that takes longest, NaN comes last.
        const END: u32 = 1.0_f32.to_bits() << 1;
        const SPAN: u32 = (LARGEST_OFFSET.to_bits() << 1) - END;
        let bits = offset.to_bits() << 1;
        if END.wrapping_sub(bits) >= SPAN.wrapping_neg() {
            // In an order that leaves few operations waiting. With `P = |x| + near` and `M = near + far`, `f = (|x| - far)/x`.
            let [first, fifth] = self.outer;
            let distance = offset.abs();
            let inverse = 1.0 / offset;
            let u = inverse.abs();
            let first = u * first;
            let square = inverse * inverse;
            let fifth = u * fifth;
            let fourth = square * square;
            let fifth = fifth * fourth;
            let near = first + fifth;
            let power = distance + near;
            let slope_excess = 4.0 * fifth;
            let far = near + slope_excess;
            let moment = near + far;
            NormalizedFriction {
                force: inverse * (distance - far),
                moment,
                power,
            }
        } else if bits <= END {
            let (force, moment) = self.inside(offset);
            NormalizedFriction {
                force,
                moment,
                power: moment + offset * force,
            }
        } else {
            NormalizedFriction {
                force: full_force(offset),
                moment: 0.0,
                power: LARGEST_OFFSET,
            }
        }
    }

    /// `f` and `M` inside the contact.
    #[inline]
    fn inside(&self, offset: f32) -> (f32, f32) {
        let square = offset * offset;
        let cubic = self.cubic * square;
        let secant = self.slope - cubic;
        let moment = self.spin_moment - 0.5 * (square * (secant - 0.5 * cubic));
        (offset * secant, moment)
    }
}

/// Force of a contact that only slides: a call of its own, so that the other branches need no stack frame.
#[cold]
#[inline(never)]
fn full_force(offset: f32) -> f32 {
    if offset < 0.0 { -1.0 } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn friction_is_continuous_and_convex_through_the_end() {
        for step in 1_u8..=100 {
            let map = FrictionMap::new(f32::from(step) / 100.0).unwrap();
            let (inner, outer) = (map.evaluate(1.0), map.evaluate(1.0 + f32::EPSILON));
            // Three coefficients of order 10 with roundings of 6e-8.
            assert!(
                (inner.force - outer.force).abs() < 1e-6,
                "axis ratio 0.01 x {step}"
            );
            assert!(
                (inner.moment - outer.moment).abs() < 1e-6,
                "axis ratio 0.01 x {step}"
            );
            let [first, fifth] = map.outer;
            for point in 0_u8..=200 {
                let x = f32::from(point) / 200.0;
                let square = x * x;
                // Slopes of the force: within by the offset ratio, outside over 2 u^3 with u as the ratio's inverse.
                assert!(map.slope - 3.0 * map.cubic * square > 0.0);
                assert!(
                    first + 15.0 * fifth * square * square >= 0.0,
                    "axis ratio 0.01 x {step}, u {x}"
                );
            }
        }
    }
}
