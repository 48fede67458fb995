//! Friction torque of a nominal ball over the load: folded before the first tick, read in every one.

use super::constants::BallConstants;
use super::nominal::{Grooving, NominalBall};

/// Loads of the law in each octave, and octaves.
const PER_OCTAVE: u32 = 4;
const OCTAVES: u32 = 17;

/// Loads of the law: one below and one above those between which it is read, for the slopes there.
const LOADS: usize = (PER_OCTAVE * OCTAVES) as usize + 3;

/// Renewals of the first ball and of each other at most.
const FIRST_RENEWALS: u32 = 60;
const RENEWALS: u32 = 24;

/// Exponent's bias and mantissa's bits of an `f32`.
const BIAS: u32 = 127;
const MANTISSA: u32 = 23;

/// Least and largest exponent of the largest load, N.
const EXPONENTS: (u32, u32) = (BIAS + 4, BIAS + 20);

/// Friction torque over the whole contact force, for one sign of the load; loads are evenly spaced in [`octaves`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct LoadLaw {
    /// m.
    ratios: [f32; LOADS],
    /// A bit for each part between two loads: whether the ball stands in two contacts, or did not settle, at one of them.
    beyond: [u32; LOADS.div_ceil(32)],
}

/// Where a law is read.
#[derive(Clone, Copy)]
pub(crate) struct Place {
    part: usize,
    /// From its beginning to its end, 0 to 1.
    along: f32,
}

/// Loads for which laws hold: so many octaves up to the first one that is not below a largest load.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct LoadRange {
    /// Exponent of the smallest load, with its bias.
    exponent: u32,
}

/// Logarithm of a load to the base 2, with the exponent's bias: `e + m (4 - m)/3` with exponent `e` and mantissa `1 + m`.
/// It is 0.01 off the logarithm, and smooth: its slope is 4/3 where an octave begins and half of it where it ends.
#[inline(always)]
fn octaves(load: f32) -> f32 {
    let bits = load.to_bits();
    let mantissa = f32::from_bits(bits & ((1 << MANTISSA) - 1) | (BIAS << MANTISSA)) - 1.0;
    (bits >> MANTISSA) as f32 + mantissa * (4.0 - mantissa) * (1.0 / 3.0)
}

impl LoadRange {
    /// Up to a largest load, N, above 0.
    pub(crate) const fn to(largest: f32) -> Self {
        let exponent = (largest.to_bits() >> MANTISSA) + 1;
        let (least, most) = EXPONENTS;
        let exponent = if exponent < least {
            least
        } else if exponent < most {
            exponent
        } else {
            most
        };
        Self {
            exponent: exponent - OCTAVES,
        }
    }

    /// The load with a number, N.
    fn load(self, number: usize) -> f32 {
        // The first one lies below the smallest load.
        let steps = number as u32 + PER_OCTAVE - 1;
        let power = f32::from_bits((self.exponent - 1 + steps / PER_OCTAVE) << MANTISSA);
        let part = (steps % PER_OCTAVE) as f32 / PER_OCTAVE as f32;
        // m (4 - m)/3 = part
        power * (3.0 - crate::math::sqrt(4.0 - 3.0 * part))
    }

    /// Where the law of a load, N, not below 0, is read.
    #[inline(always)]
    pub(crate) fn place(self, load: f32) -> Place {
        let steps = (octaves(load) - self.exponent as f32) * PER_OCTAVE as f32;
        let last = (PER_OCTAVE * OCTAVES) as f32;
        let steps = if steps > 0.0 { steps } else { 0.0 };
        let steps = if steps < last { steps } else { last };
        // The last load ends the last part.
        let part = steps as u32;
        let part = if part < PER_OCTAVE * OCTAVES {
            part
        } else {
            PER_OCTAVE * OCTAVES - 1
        };
        Place {
            part: part as usize,
            along: steps - part as f32,
        }
    }
}

impl LoadLaw {
    /// No friction.
    const NONE: Self = Self {
        ratios: [0.0; LOADS],
        beyond: [0; LOADS.div_ceil(32)],
    };

    /// Settles a ball under every load, from the largest to the smallest, of the sign of `side`.
    pub(crate) fn new(
        ball: &BallConstants,
        grooving: &Grooving,
        range: LoadRange,
        side: f32,
    ) -> Self {
        let mut law = Self::NONE;
        let mut nominal = NominalBall::new(ball, grooving, side * range.load(LOADS - 1), 0.0);
        let mut most = FIRST_RENEWALS;
        for (number, ratio) in law.ratios.iter_mut().enumerate().rev() {
            nominal.settle(ball, grooving, side * range.load(number), most);
            most = RENEWALS;
            *ratio = nominal.ratio;
            if nominal.in_two_points() || nominal.settles() {
                // The load ends one part and begins another; the first load does not count.
                for part in [number.wrapping_sub(2), number.wrapping_sub(1)] {
                    if let Some(bits) = law.beyond.get_mut(part / 32) {
                        *bits |= 1 << (part % 32);
                    }
                }
            }
        }
        law
    }

    /// Friction torque over the whole contact force, m: a cubic through four loads.
    #[inline(always)]
    pub(crate) fn ratio(&self, place: Place) -> f32 {
        let Place { part, along } = place;
        let Some(&[before, begin, end, after]) = self.ratios.get(part..part + 4) else {
            return 0.0;
        };
        let rise = end - begin;
        let (first, last) = (0.5 * (end - before), 0.5 * (after - begin));
        let bend = rise - first;
        let turn = first + last - 2.0 * rise;
        begin + along * (first + along * ((bend - turn) + along * turn))
    }

    /// Whether the ball stands in two contacts, or did not settle.
    #[inline(always)]
    pub(crate) fn is_beyond(&self, place: Place) -> bool {
        let bits = self.beyond.get(place.part / 32).copied().unwrap_or(0);
        bits >> (place.part % 32) & 1 == 1
    }
}
