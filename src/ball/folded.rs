//! The law of one ball, solved on a host and folded into constants: friction torque over its load by one logarithm, one search among
//! eight parts, one cubic.

use crate::error::{Error, attempt, in_range};
use crate::ranges;
use crate::stored::{Port, Refusal, Stored};

/// Parts of a [`LoadCurve`].
pub const PARTS: usize = 8;

/// Change of a friction coefficient, over it, below which it counts as the same: rounding.
const SAME_FRICTION: f32 = 1e-3;

const BIAS: u32 = 127;
const MANTISSA: u32 = 23;

/// Coefficients of `log2(1 + m)` by the powers 1 to 4 of `m`, of least error where value and slope are continuous where the exponent
/// changes (they add up to 1, and the slope at 0 is twice that at 1).
const LOGARITHM: [f32; 4] = [1.438_308_4, -0.674_842_3, 0.315_605_3, -0.079_071_4];

/// `log2(x) + 127` of a positive number, within 1.3e-4: the biased exponent and a polynomial of the mantissa. 0 gives 0.
#[inline(always)]
pub const fn log2_biased(number: f32) -> f32 {
    let bits = number.to_bits();
    let mantissa = f32::from_bits(bits & ((1 << MANTISSA) - 1) | (BIAS << MANTISSA)) - 1.0;
    let [a, b, c, d] = LOGARITHM;
    (bits >> MANTISSA) as f32 + mantissa * (a + mantissa * (b + mantissa * (c + mantissa * d)))
}

/// Index of the last of `M` rising starts that is not above a number, or 0; `M` is a power of two. `start` takes the remainder of its
/// index by `M`, which tells the compiler what the halving ensures.
#[inline(always)]
pub(super) fn last_not_above<const M: usize>(number: f32, start: impl Fn(usize) -> f32) -> usize {
    // Starts are not negative: their bits rise with them, and integers are compared in half the cycles.
    let bits = number.to_bits().cast_signed();
    let mut index = 0;
    let mut step = M / 2;
    while step > 0 {
        if bits >= start(index + step).to_bits().cast_signed() {
            index += step;
        }
        step /= 2;
    }
    index
}

/// A function of [`log2_biased`] of a load: a cubic in each part.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LoadCurve {
    /// Where each part begins, `log2_biased`, rising; unused parts begin at `f32::MAX`. The first begins where the curve does.
    pub starts: [f32; PARTS],
    /// Coefficients of the powers 0 to 3 of the distance from the part's begin.
    pub cubics: [[f32; 4]; PARTS],
}

impl LoadCurve {
    #[inline(always)]
    fn at(&self, log2: f32) -> f32 {
        let part = last_not_above::<PARTS>(log2, |part| self.starts[part % PARTS]);
        let [a, b, c, d] = self.cubics[part % PARTS];
        let along = log2 - self.starts[part % PARTS];
        a + along * (b + along * (c + along * d))
    }

    const fn checked(self) -> Result<Self, Error> {
        let mut part = 0;
        while part < PARTS {
            let least = if part == 0 {
                0.0
            } else {
                self.starts[part - 1]
            };
            attempt!(in_range("starts", self.starts[part], least, f32::MAX));
            attempt!(in_range("cubics", self.cubics[part][0], 0.0, 1e9));
            let mut power = 1;
            while power < 4 {
                attempt!(in_range("cubics", self.cubics[part][power], -1e9, 1e9));
                power += 1;
            }
            part += 1;
        }
        Ok(self)
    }
}

/// A friction coefficient, and the nodes of a law between which it lies.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FrictionInterval {
    friction: f32,
    /// The node below it, and its fraction of the distance to the next node by logarithms, 0 to 1.
    node: u32,
    fraction: f32,
}

impl FrictionInterval {
    /// The friction coefficient.
    pub const fn friction(&self) -> f32 {
        self.friction
    }

    #[inline(always)]
    pub(crate) const fn among<const NODES: usize>(
        frictions: &[f32; NODES],
        octaves_of: &[f32; NODES],
        friction: f32,
    ) -> Self {
        let mut node = 0;
        let mut number = 1;
        while number + 1 < NODES {
            if friction > frictions[number] {
                node = number;
            }
            number += 1;
        }
        let fraction = if NODES == 1 || friction <= frictions[0] {
            0.0
        } else if friction < frictions[NODES - 1] {
            let [low, high] = [octaves_of[node % NODES], octaves_of[(node + 1) % NODES]];
            (log2_biased(friction) - low) / (high - low)
        } else {
            1.0
        };
        Self {
            friction,
            node: node as u32,
            fraction,
        }
    }

    #[inline(always)]
    pub(crate) const fn node(&self) -> usize {
        self.node as usize
    }

    #[inline(always)]
    pub(crate) const fn fraction(&self) -> f32 {
        self.fraction
    }
}

/// The friction coefficient alone: the scene finds its interval.
impl Stored for FrictionInterval {
    const BYTES: usize = 4;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.number("friction", &mut self.friction, ranges::FRICTION_OF_A_ROW)
    }
}

/// Whether a friction coefficient is within the least and the largest of some, but for rounding.
#[inline(always)]
pub(crate) const fn holds((least, largest): (f32, f32), friction: f32) -> bool {
    friction >= (1.0 - SAME_FRICTION) * least && friction <= (1.0 + SAME_FRICTION) * largest
}

pub(crate) const fn node_octaves<const NODES: usize>(frictions: &[f32; NODES]) -> [f32; NODES] {
    let mut all = [0.0; NODES];
    let mut number = 0;
    while number < NODES {
        all[number] = log2_biased(frictions[number]);
        number += 1;
    }
    all
}

/// The curves for one friction coefficient.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FrictionNode {
    /// Friction coefficient of ball and groove, 1e-6 to 0.5.
    pub friction: f32,
    /// Friction torque over load and friction coefficient, m, under a load that opposes the motion and under one that assists it.
    pub curves: [LoadCurve; 2],
    /// By how many octaves the load at which a contact begins to carry is higher at the next node's friction coefficient, of both curves, -30 to
    /// 30; 0 of the last node.
    pub shift: [f32; 2],
}

/// Friction torque of one ball over its load, for `NODES` friction coefficients: what `epas-design` folds and a scene evaluates.
///
/// ```text
/// T = mu W [(1 - t) c_k(x - t d w) + t c_(k+1)(x + (1 - t) d w)],    W = |F| + F_0,    x = log2(W) + 127
/// ```
///
/// with the axial load `F` of the ball, the lift-off load `F_0` of its preload, the curves `c` of the two nodes around the friction coefficient
/// `mu`, its fraction `t` of the distance between them (0 to 1, by logarithms), and the shift `d` that aligns the loads at which a contact begins to
/// carry. Lift-off of a preload does not depend on friction: `w` rises from 0 there to 1 an octave above it; without a preload it is 1.
/// Below the least load the torque is in proportion to `W`.
///
/// Accuracy: that of the block's certificate. Cost: part of a step of [`CagedBallScrew`](crate::CagedBallScrew).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LoadLaw<const NODES: usize> {
    /// Nodes by rising friction coefficient.
    pub nodes: [FrictionNode; NODES],
    /// Least and largest [`log2_biased`] of `W`.
    pub ends: [f32; 2],
    /// Axial load of one ball at which the preload's unloaded side lifts off, N, 0 to 1e7; 0 without a preload.
    pub lift_off: f32,
    /// [`log2_biased`] of the `W` from which on loads are shifted between nodes: that of lift-off, 1 to 254; 1 without a preload.
    pub shifted_from: f32,
}

impl<const NODES: usize> LoadLaw<NODES> {
    pub(crate) const fn checked(self) -> Result<Self, Error> {
        const { assert!(NODES > 0) };
        let [least, most] = self.ends;
        attempt!(in_range("ends", least, 1.0, 254.0));
        attempt!(in_range("ends", most, least, 254.0));
        attempt!(in_range("lift_off", self.lift_off, 0.0, 1e7));
        attempt!(in_range("shifted_from", self.shifted_from, 1.0, 254.0));
        let mut number = 0;
        while number < NODES {
            let FrictionNode {
                friction,
                curves: [drive, backdrive],
                shift: [forward, backward],
            } = self.nodes[number];
            attempt!(ranges::FRICTION_OF_A_ROW.checked("friction", friction));
            if number > 0 {
                let least = 1.01 * self.nodes[number - 1].friction;
                attempt!(in_range("friction", friction, least, 0.5));
            }
            attempt!(drive.checked());
            attempt!(backdrive.checked());
            attempt!(in_range("shift", forward, -30.0, 30.0));
            attempt!(in_range("shift", backward, -30.0, 30.0));
            number += 1;
        }
        Ok(self)
    }

    /// Least and largest friction coefficient.
    pub const fn friction_range(&self) -> (f32, f32) {
        (self.nodes[0].friction, self.nodes[NODES - 1].friction)
    }

    #[inline(always)]
    pub(crate) const fn holds(&self, friction: f32) -> bool {
        holds(self.friction_range(), friction)
    }

    const fn frictions(&self) -> [f32; NODES] {
        let mut all = [0.0; NODES];
        let mut number = 0;
        while number < NODES {
            all[number] = self.nodes[number].friction;
            number += 1;
        }
        all
    }

    pub(crate) const fn node_octaves(&self) -> [f32; NODES] {
        node_octaves(&self.frictions())
    }

    /// The nodes between which a friction coefficient lies. Beyond the outermost nodes the torque is in proportion to it.
    #[inline(always)]
    pub(crate) const fn interval(
        &self,
        friction: f32,
        node_octaves: &[f32; NODES],
    ) -> FrictionInterval {
        FrictionInterval::among(&self.frictions(), node_octaves, friction)
    }

    /// Friction torque of a ball over its load `W`, N, under an axial load that opposes or assists the motion, m, not negative; and whether `W`
    /// is above the law's largest, at which the law stays.
    #[inline(always)]
    pub(crate) fn torque_over_load(
        &self,
        load: f32,
        assists: bool,
        interval: FrictionInterval,
    ) -> (f32, bool) {
        let [least, most] = self.ends;
        let log2 = log2_biased(load);
        let beyond = log2 > most;
        let log2 = if beyond { most } else { log2 };
        let log2 = if log2 > least { log2 } else { least };
        let branch = usize::from(assists);
        let below = &self.nodes[interval.node as usize % NODES];
        let value = if NODES == 1 {
            below.curves[branch].at(log2)
        } else {
            let above = &self.nodes[(interval.node as usize + 1) % NODES];
            let shift = below.shift[branch] * shifted_part(log2 - self.shifted_from);
            let low = below.curves[branch].at(log2 - interval.fraction * shift);
            let high = above.curves[branch].at(log2 + (1.0 - interval.fraction) * shift);
            low + interval.fraction * (high - low)
        };
        let torque = if value > 0.0 {
            interval.friction * value
        } else {
            0.0
        };
        (torque, beyond)
    }
}

/// Part of the shift so many octaves above the load from which on there is one: `w` of [`LoadLaw`].
#[inline(always)]
pub const fn shifted_part(above: f32) -> f32 {
    if above > 1.0 {
        1.0
    } else if above > 0.0 {
        above
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Within 1.4e-4 of the logarithm, from the least to the largest normal number.
    #[test]
    fn log2_biased_is_the_logarithm() {
        for step in 0..25_300_u16 {
            let exponent = -126.0 + 0.01 * f64::from(step);
            let number = libm::exp2(exponent) as f32;
            let found = f64::from(log2_biased(number)) - 127.0;
            assert!((found - exponent).abs() < 1.4e-4, "{exponent}: {found}");
        }
    }

    fn curve(of: [f32; 4]) -> LoadCurve {
        let mut starts = [f32::MAX; PARTS];
        let mut cubics = [[0.0; 4]; PARTS];
        for (part, value) in of.iter().enumerate() {
            starts[part] = 120.0 + 2.0 * part as f32;
            cubics[part] = [*value, 0.5, 0.0, 0.0];
        }
        LoadCurve { starts, cubics }
    }

    #[test]
    fn a_load_meets_its_part() {
        let curve = curve([1.0, 2.0, 3.0, 4.0]).checked().unwrap();
        for (at, expected) in [
            (120.0, 1.0),
            (121.0, 1.5),
            (122.0, 2.0),
            (123.5, 2.75),
            (124.0, 3.0),
            (126.0, 4.0),
            (140.0, 11.0),
        ] {
            assert_eq!(curve.at(at), expected, "{at}");
        }
    }

    fn law() -> LoadLaw<2> {
        let node = |friction, value| FrictionNode {
            friction,
            curves: [curve([value; 4]); 2],
            shift: [0.0; 2],
        };
        LoadLaw {
            nodes: [node(0.05, 1.0), node(0.1, 2.0)],
            ends: [120.0, 128.0],
            lift_off: 0.0,
            shifted_from: 1.0,
        }
    }

    /// At a node the law is that node's; between two it lies between theirs; beyond them it is in proportion.
    #[test]
    fn friction_coefficients_lie_between_nodes() {
        let law = law().checked().unwrap();
        let least_load = 0.5_f32.powi(7);
        let over = |friction: f32| {
            let interval = law.interval(friction, &law.node_octaves());
            law.torque_over_load(least_load, false, interval).0 / friction
        };
        assert_eq!(over(0.05), 1.0);
        assert_eq!(over(0.1), 2.0);
        assert_eq!(over(0.03), 1.0);
        assert_eq!(over(0.2), 2.0);
        let middle = over(0.071);
        assert!(middle > 1.4 && middle < 1.6, "{middle}");
        assert!(law.holds(0.05) && law.holds(0.1) && law.holds(0.071));
        assert!(!law.holds(0.0499) && !law.holds(0.1002));
    }

    /// Beyond either end the law stays at it, and says so at the upper one.
    #[test]
    fn law_stays_at_its_ends() {
        let law = law().checked().unwrap();
        let interval = law.interval(0.05, &law.node_octaves());
        let at = |load| law.torque_over_load(load, true, interval);
        assert_eq!(at(0.0), at(0.5_f32.powi(7)));
        assert!(!at(2.0).1);
        assert_eq!(at(2.1), (at(2.0).0, true));
    }

    #[test]
    fn what_is_no_law_is_refused() {
        let wrong = |change: fn(&mut LoadLaw<2>)| {
            let mut law = law();
            change(&mut law);
            law.checked().unwrap_err().field()
        };
        assert_eq!(wrong(|law| law.nodes[1].friction = 0.05), "friction");
        assert_eq!(wrong(|law| law.nodes[0].friction = f32::NAN), "friction");
        assert_eq!(wrong(|law| law.ends[1] = 119.0), "ends");
        assert_eq!(wrong(|law| law.lift_off = -1.0), "lift_off");
        assert_eq!(
            wrong(|law| law.nodes[1].curves[1].starts[2] = 121.0),
            "starts"
        );
        assert_eq!(
            wrong(|law| law.nodes[1].curves[0].cubics[3][0] = -1.0),
            "cubics"
        );
        assert_eq!(wrong(|law| law.nodes[0].shift[1] = f32::NAN), "shift");
    }
}
