//! Friction torque of a nominal ball over the load: folded before the first tick, read in every one.

use super::constants::BallConstants;
use super::nominal::{Grooving, NominalBall};
use crate::math;

/// Parts of a law; the power of two from which on half of those left are looked at.
const PARTS: usize = 48;
const HALVES: usize = 32;

/// Octaves of loads for which a law holds.
const OCTAVES: u32 = 17;

/// Widest and narrowest part, octaves; a part in which the ball is not known well is at most so wide.
const WIDEST: f32 = 1.0;
const NARROWEST: f32 = 1.0 / 128.0;
const WIDEST_BEYOND: f32 = 0.5;

/// Error of a part over its friction, in the middle of its halves; the next where parts do not suffice.
const TOLERANCES: [f32; 3] = [2.5e-4, 7e-4, 4e-3];

/// Renewals of the first ball and of each other at most.
const FIRST_RENEWALS: u32 = 60;
const RENEWALS: u32 = 40;

/// Exponent's bias and mantissa's bits of an `f32`.
const BIAS: u32 = 127;
const MANTISSA: u32 = 23;

/// Least and largest exponent of the largest load, N.
const EXPONENTS: (u32, u32) = (BIAS + 10, BIAS + 20);

/// Friction torque over the whole contact force, for one sign of the load: parabolas over [`octaves`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct LoadLaw {
    /// From the largest load to the smallest.
    parts: [Part; PARTS],
    /// Whether the ball stands in two contacts, or did not settle, somewhere in a part.
    beyond: [bool; PARTS],
}

/// A part of a law.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct Part {
    /// Where it ends, [`octaves`].
    low: f32,
    /// Ratio there, m; its slope and half its second derivative there.
    ratio: f32,
    slope: f32,
    bend: f32,
}

/// Loads for which laws hold: so many octaves up to the first one that is not below a largest load.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct LoadRange {
    /// Exponent of the largest load, with its bias.
    exponent: u32,
}

/// Logarithm of a load to the base 2, with the exponent's bias: `e + m (4 - m)/3` with exponent `e` and mantissa `1 + m`.
/// It is 0.01 off the logarithm, and smooth: its slope is 4/3 where an octave begins and half of it where it ends.
#[inline(always)]
pub(crate) fn octaves(load: f32) -> f32 {
    let bits = load.to_bits();
    let mantissa = f32::from_bits(bits & ((1 << MANTISSA) - 1) | (BIAS << MANTISSA)) - 1.0;
    (bits >> MANTISSA) as f32 + mantissa * (4.0 - mantissa) * (1.0 / 3.0)
}

/// The load at so many [`octaves`], N.
fn load(octaves: f32) -> f32 {
    let exponent = octaves as u32;
    let part = octaves - exponent as f32;
    // m (4 - m)/3 = part
    f32::from_bits(exponent << MANTISSA) * (3.0 - math::sqrt(4.0 - 3.0 * part))
}

impl LoadRange {
    /// Up to a largest load, N, above 0.
    pub(crate) const fn to(largest: f32) -> Self {
        let exponent = (largest.to_bits() >> MANTISSA) + 1;
        let (least, most) = EXPONENTS;
        Self {
            exponent: if exponent < least {
                least
            } else if exponent < most {
                exponent
            } else {
                most
            },
        }
    }

    /// Octaves of the largest load and of the smallest.
    const fn ends(self) -> (f32, f32) {
        (self.exponent as f32, (self.exponent - OCTAVES) as f32)
    }
}

/// A ball that settles under one load after the other.
struct Folding<'a> {
    ball: &'a BallConstants,
    grooving: &'a Grooving,
    /// Sign of the load.
    side: f32,
}

/// A ball under a load.
#[derive(Clone, Copy)]
struct Known {
    octaves: f32,
    nominal: NominalBall,
}

impl Known {
    /// Whether its friction is known as well as elsewhere.
    fn is_sound(&self) -> bool {
        !(self.nominal.in_two_points() || self.nominal.changed())
    }
}

impl Folding<'_> {
    /// The ball of a known one under another load.
    fn at(&self, known: &Known, octaves: f32) -> Known {
        self.settled(known.nominal, octaves, RENEWALS)
    }

    fn settled(&self, mut nominal: NominalBall, octaves: f32, most: u32) -> Known {
        let axial = self.side * load(octaves);
        nominal.settle(self.ball, self.grooving, axial, most);
        Known { octaves, nominal }
    }

    /// Folds a law within a tolerance; says whether its parts suffice.
    fn fold(&self, law: &mut LoadLaw, range: LoadRange, tolerance: f32) -> bool {
        let (top, bottom) = range.ends();
        let axial = self.side * load(top);
        let nominal = NominalBall::new(self.ball, self.grooving, axial, 0.0);
        let mut high = self.settled(nominal, top, FIRST_RENEWALS);
        let mut width = WIDEST;
        for (number, (part, beyond)) in law.parts.iter_mut().zip(&mut law.beyond).enumerate() {
            let left = high.octaves - bottom;
            let last = number + 1 == PARTS;
            if left > 0.0 && !last {
                let (found, low, sound) = self.part(&high, least(width, left), tolerance);
                width = least(2.0 * (high.octaves - low.octaves), WIDEST);
                *beyond = !sound;
                high = low;
                *part = found;
            } else {
                *part = Part::level(high.nominal.ratio());
                *beyond = left > 0.0;
            }
        }
        high.octaves <= bottom
    }

    /// The widest part from a load downwards, its lower end, and whether the ball is known well all over it.
    fn part(&self, high: &Known, width: f32, tolerance: f32) -> (Part, Known, bool) {
        let mut width = width;
        let mut middle = self.at(high, high.octaves - 0.5 * width);
        let mut low = self.at(&middle, high.octaves - width);
        loop {
            let above = self.at(high, high.octaves - 0.25 * width);
            let below = self.at(&middle, high.octaves - 0.75 * width);
            let all = [high, &above, &middle, &below, &low];
            let sound = all.iter().all(|known| known.is_sound());
            let part = Part::through(high, &middle, &low);
            let close = |known: &Known| {
                let ratio = known.nominal.ratio();
                let error = (part.ratio(known.octaves) - ratio).abs();
                error <= tolerance * ratio
            };
            let known = if sound {
                close(&above) && close(&below)
            } else {
                width <= WIDEST_BEYOND
            };
            if known || width <= NARROWEST {
                return (part, low, sound);
            }
            width *= 0.5;
            low = middle;
            middle = above;
        }
    }
}

impl Part {
    /// The same ratio down to no load.
    const fn level(ratio: f32) -> Self {
        Self {
            low: 0.0,
            ratio,
            slope: 0.0,
            bend: 0.0,
        }
    }

    /// The parabola through three loads, the second one in the middle.
    fn through(high: &Known, middle: &Known, low: &Known) -> Self {
        let ratio = low.nominal.ratio();
        let inverse = 1.0 / (high.octaves - low.octaves);
        let (half, rise) = (middle.nominal.ratio() - ratio, high.nominal.ratio() - ratio);
        Self {
            low: low.octaves,
            ratio,
            slope: (4.0 * half - rise) * inverse,
            bend: (2.0 * rise - 4.0 * half) * inverse * inverse,
        }
    }

    #[inline(always)]
    fn ratio(&self, octaves: f32) -> f32 {
        let along = octaves - self.low;
        self.ratio + along * (self.slope + along * self.bend)
    }
}

impl LoadLaw {
    /// No friction.
    pub(crate) const NONE: Self = Self {
        parts: [Part::level(0.0); PARTS],
        beyond: [false; PARTS],
    };

    /// Settles a ball under every load, from the largest to the smallest, of the sign of `side`.
    pub(crate) fn fold(
        &mut self,
        ball: &BallConstants,
        grooving: &Grooving,
        range: LoadRange,
        side: f32,
    ) {
        let folding = Folding {
            ball,
            grooving,
            side,
        };
        for tolerance in TOLERANCES {
            if folding.fold(self, range, tolerance) {
                break;
            }
        }
    }

    /// [`LoadLaw::at`] as a call: for steps that look several laws up.
    #[inline(never)]
    pub(crate) fn found(&self, range: LoadRange, load: f32) -> (f32, bool) {
        self.at(range, load)
    }

    /// Friction torque over the whole contact force, m, under a load of a size, N; and whether the ball stands in two
    /// contacts, or did not settle. Below the smallest load the ratio is that of the smallest, as without friction of the
    /// third contact; above the largest that of the largest.
    #[inline(always)]
    pub(crate) fn at(&self, range: LoadRange, load: f32) -> (f32, bool) {
        let (top, bottom) = range.ends();
        let octaves = octaves(load);
        let octaves = if octaves < top { octaves } else { top };
        let octaves = if octaves > bottom { octaves } else { bottom };
        let mut number = 0;
        let mut step = HALVES;
        while step > 0 {
            if let Some(part) = self.parts.get(number + step - 1)
                && part.low > octaves
            {
                number += step;
            }
            step /= 2;
        }
        let ratio = self
            .parts
            .get(number)
            .map_or(0.0, |part| part.ratio(octaves));
        // A parabola may pass below what it goes through; friction never drives.
        let ratio = if ratio > 0.0 { ratio } else { 0.0 };
        let beyond = self.beyond.get(number).copied().unwrap_or(true);
        (ratio, beyond)
    }
}

#[inline(always)]
const fn least(first: f32, second: f32) -> f32 {
    if first < second { first } else { second }
}
