//! Friction torque of nominal balls over the load: folded before the first tick, read in every one.

mod chosen;

use self::chosen::{
    EXPONENTS, FIRST_RENEWALS, HALVES, NARROWEST, OCTAVES, PARTS, RENEWALS, TOLERANCES, WIDEST,
    WIDEST_BEYOND,
};
use super::constants::BallConstants;
use super::nominal::{Grooving, NominalBall};
use crate::math;

/// Exponent's bias and mantissa's bits of an `f32`.
const BIAS: u32 = 127;
const MANTISSA: u32 = 23;

/// Laws that are folded together at most.
const MOST_LAWS: usize = 4;

/// Friction torque over the whole contact force of `N` balls, at most [`MOST_LAWS`]: parabolas over [`octaves`].
///
/// The parts are the same for all, so that a load is looked up once for all of them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct LoadLaws<const N: usize> {
    /// Where parts end, [`octaves`], from the largest load to the smallest.
    low: [f32; PARTS],
    curves: [[Curve; N]; PARTS],
    /// One bit for each law: whether its ball stands in two contacts, or did not settle, somewhere in a part.
    beyond: [u8; PARTS],
}

/// A ball whose law is folded.
#[derive(Clone, Copy)]
pub(crate) struct Grooved {
    pub(crate) grooving: Grooving,
    /// Sign of the load in the frame in which the nut turns forward.
    pub(crate) side: f32,
}

impl Grooved {
    /// Stands for a ball that is not folded.
    const NONE: Self = Self {
        grooving: Grooving::NONE,
        side: 1.0,
    };
}

/// A law in a part.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct Curve {
    /// Ratio where the part ends, m; its slope and half its second derivative there.
    ratio: f32,
    slope: f32,
    bend: f32,
}

/// A load in laws.
#[derive(Clone, Copy)]
pub(crate) struct Place<'a, const N: usize> {
    curves: &'a [Curve; N],
    beyond: u8,
    /// Octaves from the part's end.
    along: f32,
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

/// Balls that settle under one load after the other.
struct Folding<'a> {
    ball: &'a BallConstants,
    grooved: &'a [Grooved],
}

/// Balls under a load: as many as settle.
#[derive(Clone, Copy)]
struct Known {
    octaves: f32,
    balls: [NominalBall; MOST_LAWS],
}

impl Known {
    /// One of the balls.
    fn ball(&self, number: usize) -> &NominalBall {
        let [first, ..] = &self.balls;
        self.balls.get(number).unwrap_or(first)
    }
}

/// Where a part ends, and which balls are not known well in it.
struct Part {
    low: Known,
    beyond: u8,
}

/// Whether the friction of a ball is known as well as elsewhere.
fn is_sound(ball: &NominalBall) -> bool {
    !(ball.in_two_points() || ball.changed())
}

impl Folding<'_> {
    /// Balls that have settled under the largest load.
    fn first(&self, octaves: f32) -> Known {
        let axial = load(octaves);
        let new = |Grooved { grooving, side }: &Grooved| {
            NominalBall::new(self.ball, grooving, side * axial, 0.0)
        };
        let mut known = Known {
            octaves,
            balls: [new(&Grooved::NONE); MOST_LAWS],
        };
        for (ball, grooved) in known.balls.iter_mut().zip(self.grooved) {
            *ball = new(grooved);
        }
        self.settle(&mut known, FIRST_RENEWALS);
        known
    }

    /// Balls of known ones under another load.
    #[inline(never)]
    fn at(&self, known: &Known, octaves: f32) -> Known {
        let mut known = Known { octaves, ..*known };
        self.settle(&mut known, RENEWALS);
        known
    }

    /// One copy of it in flash is enough.
    #[inline(never)]
    fn settle(&self, known: &mut Known, most: u32) {
        let axial = load(known.octaves);
        for (ball, Grooved { grooving, side }) in known.balls.iter_mut().zip(self.grooved) {
            ball.settle(self.ball, grooving, side * axial, most);
        }
    }

    /// Folds laws within a tolerance, with the curves of one part after those of the other; says whether there are parts
    /// enough.
    fn fold(
        &self,
        low: &mut [f32; PARTS],
        curves: &mut [Curve],
        beyond: &mut [u8; PARTS],
        (range, tolerance): (LoadRange, f32),
    ) -> bool {
        let (top, bottom) = range.ends();
        let mut high = self.first(top);
        let mut width = WIDEST;
        let mut rest = curves;
        for (number, (low, beyond)) in low.iter_mut().zip(beyond).enumerate() {
            let Some((curves, others)) = rest.split_at_mut_checked(self.grooved.len()) else {
                return false;
            };
            rest = others;
            let left = high.octaves - bottom;
            let last = number + 1 == PARTS;
            if left > 0.0 && !last {
                let part = self.part(&high, curves, least(width, left), tolerance);
                width = least(2.0 * (high.octaves - part.low.octaves), WIDEST);
                *beyond = part.beyond;
                *low = part.low.octaves;
                high = part.low;
            } else {
                for (curve, ball) in curves.iter_mut().zip(&high.balls) {
                    *curve = Curve::level(ball.ratio());
                }
                *low = 0.0;
                *beyond = if left > 0.0 { u8::MAX } else { 0 };
            }
        }
        high.octaves <= bottom
    }

    /// The widest part from a load downwards, with its curves.
    #[inline(never)]
    fn part(&self, high: &Known, curves: &mut [Curve], width: f32, tolerance: f32) -> Part {
        let mut width = width;
        let mut middle = self.at(high, high.octaves - 0.5 * width);
        let mut low = self.at(&middle, high.octaves - width);
        loop {
            let above = self.at(high, high.octaves - 0.25 * width);
            let below = self.at(&middle, high.octaves - 0.75 * width);
            let narrow = width <= NARROWEST;
            let (mut known, mut beyond) = (true, 0);
            for (number, curve) in curves.iter_mut().enumerate() {
                let all = [high, &above, &middle, &below, &low].map(|known| known.ball(number));
                let [first, above, middle, below, last] = all;
                *curve = Curve::through([first, middle, last], width);
                let close = |ball: &NominalBall, part: f32| {
                    let error = (curve.ratio(part * width) - ball.ratio()).abs();
                    error <= tolerance * ball.ratio()
                };
                if all.into_iter().all(is_sound) {
                    known &= close(above, 0.75) && close(below, 0.25);
                } else {
                    known &= width <= WIDEST_BEYOND;
                    beyond |= 1 << number;
                }
            }
            if known || narrow {
                return Part { low, beyond };
            }
            width *= 0.5;
            low = middle;
            middle = above;
        }
    }
}

impl Curve {
    /// The same ratio down to no load.
    const fn level(ratio: f32) -> Self {
        Self {
            ratio,
            slope: 0.0,
            bend: 0.0,
        }
    }

    /// The parabola through a ball under three loads, the second one in the middle of a part so many octaves wide.
    fn through(balls: [&NominalBall; 3], width: f32) -> Self {
        let [high, middle, low] = balls.map(NominalBall::ratio);
        let inverse = 1.0 / width;
        let (half, rise) = (middle - low, high - low);
        Self {
            ratio: low,
            slope: (4.0 * half - rise) * inverse,
            bend: (2.0 * rise - 4.0 * half) * inverse * inverse,
        }
    }

    /// Friction never drives, though a parabola may pass below what it goes through.
    #[inline(always)]
    fn ratio(&self, along: f32) -> f32 {
        let ratio = self.ratio + along * (self.slope + along * self.bend);
        if ratio > 0.0 { ratio } else { 0.0 }
    }
}

impl<const N: usize> LoadLaws<N> {
    const NO_CURVES: [Curve; N] = [Curve::level(0.0); N];

    /// No friction.
    pub(crate) const NONE: Self = Self {
        low: [0.0; PARTS],
        curves: [Self::NO_CURVES; PARTS],
        beyond: [0; PARTS],
    };

    /// Settles balls under every load, from the largest to the smallest.
    pub(crate) fn fold(&mut self, ball: &BallConstants, grooved: &[Grooved; N], range: LoadRange) {
        const { assert!(N <= MOST_LAWS) };
        let folding = Folding { ball, grooved };
        for tolerance in TOLERANCES {
            let curves = self.curves.as_flattened_mut();
            if folding.fold(&mut self.low, curves, &mut self.beyond, (range, tolerance)) {
                break;
            }
        }
    }

    /// Friction torque over the whole contact force by one law, m, and whether its ball is not known well there.
    #[inline(always)]
    pub(crate) fn found(&self, range: LoadRange, load: f32, law: usize) -> (f32, bool) {
        let place = self.at(range, load);
        (place.ratio(law), place.beyond(law))
    }

    /// Where a load of a size, N, lies. Below the smallest load ratios are those of the smallest, as without friction of the
    /// third contact; above the largest those of the largest.
    #[inline(always)]
    pub(crate) fn at(&self, range: LoadRange, load: f32) -> Place<'_, N> {
        let (top, bottom) = range.ends();
        let octaves = octaves(load);
        let octaves = if octaves < top { octaves } else { top };
        let octaves = if octaves > bottom { octaves } else { bottom };
        let mut number = 0;
        let mut step = HALVES;
        while step > 0 {
            if let Some(low) = self.low.get(number + step - 1)
                && *low > octaves
            {
                number += step;
            }
            step /= 2;
        }
        match (
            self.low.get(number),
            self.curves.get(number),
            self.beyond.get(number),
        ) {
            (Some(low), Some(curves), Some(beyond)) => Place {
                curves,
                beyond: *beyond,
                along: octaves - low,
            },
            _ => Place {
                curves: &Self::NO_CURVES,
                beyond: u8::MAX,
                along: 0.0,
            },
        }
    }
}

impl<const N: usize> Place<'_, N> {
    /// Friction torque over the whole contact force by each law, m.
    #[inline(always)]
    pub(crate) fn ratios(&self) -> [f32; N] {
        self.curves.each_ref().map(|curve| curve.ratio(self.along))
    }

    /// That of one law.
    #[inline(always)]
    pub(crate) fn ratio(&self, law: usize) -> f32 {
        let curve = self.curves.get(law);
        curve.map_or(0.0, |curve| curve.ratio(self.along))
    }

    /// Whether the ball of a law stands in two contacts there, or did not settle.
    #[inline(always)]
    pub(crate) const fn beyond(&self, law: usize) -> bool {
        self.beyond >> law & 1 != 0
    }
}

#[inline(always)]
const fn least(first: f32, second: f32) -> f32 {
    if first < second { first } else { second }
}
