//! How contact angles deviate along a groove: manufacturing errors, as a table made once.

use crate::error::{Error, attempt, in_range};

/// Samples of a period. Straight lines between them are within 1.2e-3 of a wave's amplitude; eight stand for a wave of [`HIGHEST_ORDER`].
const SAMPLES: usize = 64;

/// Bits of a phase that count: 6 for the sample, 14 for the fraction of the distance to the next one.
pub(super) const PHASE_BITS: u32 = 20;
const FRACTION_BITS: u32 = 14;

/// Largest sample in units of the table: the difference of two stays within 16 bits.
const LARGEST: f32 = 16383.0;

/// Largest deviation of a contact angle, rad: that of the closed form of a row
/// ([`ScrewRow::largest_deviation`](crate::ball::ScrewRow::largest_deviation)), four times the 2 to 3 degrees of Lin 2019.
pub const LARGEST_DEVIATION: f32 = 0.2;

/// Highest order of a harmonic: eight samples to a wave.
pub const HIGHEST_ORDER: u8 = 8;

/// One wave of a deviation along a groove: `cosine cos(order p) + sine sin(order p)` at the phase `p` of the period.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Harmonic {
    /// Waves in a period, 0 (a constant) to [`HIGHEST_ORDER`].
    pub order: u8,
    /// Amplitude of the cosine, rad, at most [`LARGEST_DEVIATION`].
    pub cosine: f32,
    /// Amplitude of the sine, rad, at most [`LARGEST_DEVIATION`].
    pub sine: f32,
}

/// Deviation of a groove's contact angles along the track, periodic: a table of 64 samples.
///
/// Where it is positive the right flank's contact angle is larger by it and the left flank's smaller
/// (Lin 2019, Fig. 3.21: `+theta` on SR, `-theta` on SL). Made at compile time, it lies in flash:
///
/// ```
/// use epas_friction::{DeviationMap, Harmonic};
/// // Two waves of 2.3 degrees in every turn, as in Lin 2019, Fig. 3.23.
/// static SCREW: DeviationMap = match DeviationMap::from_harmonics(
///     1,
///     &[Harmonic { order: 2, cosine: 0.0, sine: 0.04014 }],
/// ) {
///     Ok(map) => map,
///     Err(_) => panic!("a deviation is too large"),
/// };
/// // An eighth of a turn on, at a crest of the two waves.
/// assert!((SCREW.at(1 << 29) - 0.04014).abs() < 1e-5);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct DeviationMap {
    /// In the upper 16 bits a sample, in the lower ones its difference to the next sample.
    samples: [i32; SAMPLES],
    /// Deviation of one unit of a sample over one unit of the fraction, rad.
    unit: f32,
    /// Turns of a ball screw in a period, 1 to 100.
    turns: u16,
}

impl Default for DeviationMap {
    fn default() -> Self {
        Self::NONE
    }
}

impl DeviationMap {
    /// No deviation.
    pub const NONE: Self = Self {
        samples: [0; SAMPLES],
        unit: 0.0,
        turns: 1,
    };

    /// A sum of waves over a period of `turns` turns of a ball screw; on a straight track the period is
    /// that part of its length.
    ///
    /// # Errors
    /// [`Error`] naming `turns` (1 to 100), `order`, `cosine`, `sine`, or `deviation` where the sum of the
    /// waves is too large.
    pub const fn from_harmonics(turns: u16, harmonics: &[Harmonic]) -> Result<Self, Error> {
        let mut samples = [0.0; SAMPLES];
        let mut wave = 0;
        while wave < harmonics.len() {
            let Harmonic {
                order,
                cosine,
                sine,
            } = harmonics[wave];
            attempt!(in_range("order", order as f32, 0.0, HIGHEST_ORDER as f32));
            let most = LARGEST_DEVIATION;
            attempt!(in_range("cosine", cosine, -most, most));
            attempt!(in_range("sine", sine, -most, most));
            let mut sample = 0;
            while sample < SAMPLES {
                let phase = sample * order as usize;
                samples[sample] +=
                    cosine * SINES[(phase + SAMPLES / 4) % SAMPLES] + sine * SINES[phase % SAMPLES];
                sample += 1;
            }
            wave += 1;
        }
        Self::from_samples(turns, &samples)
    }

    /// Measured deviations, rad, at equal distances along a period of `turns` turns, from its start.
    ///
    /// # Errors
    /// [`Error`] naming `turns` (1 to 100), or `deviation` (plus or minus [`LARGEST_DEVIATION`]).
    pub const fn from_samples(turns: u16, deviations: &[f32; SAMPLES]) -> Result<Self, Error> {
        attempt!(in_range("turns", turns as f32, 1.0, 100.0));
        let mut largest: f32 = 1e-9;
        let mut sample = 0;
        while sample < SAMPLES {
            let (deviation, most) = (deviations[sample], LARGEST_DEVIATION);
            attempt!(in_range("deviation", deviation, -most, most));
            largest = largest.max(deviation.abs());
            sample += 1;
        }
        let scale = LARGEST / largest;
        let mut rounded = [0_i16; SAMPLES];
        sample = 0;
        while sample < SAMPLES {
            let scaled = deviations[sample] * scale;
            rounded[sample] = (scaled + 0.5_f32.copysign(scaled)) as i16;
            sample += 1;
        }
        let mut samples = [0; SAMPLES];
        sample = 0;
        while sample < SAMPLES {
            let here = rounded[sample] as i32;
            let rise = rounded[(sample + 1) % SAMPLES] as i32 - here;
            samples[sample] = (here << 16) + rise;
            sample += 1;
        }
        Ok(Self {
            samples,
            unit: largest / (LARGEST * (1_u32 << FRACTION_BITS) as f32),
            turns,
        })
    }

    /// Turns of a ball screw in a period.
    pub const fn turns(&self) -> u16 {
        self.turns
    }

    /// Bound of the size of [`DeviationMap::at`] at any phase, rad: the largest sample, to a rounding of `f32`.
    pub const fn largest(&self) -> f32 {
        self.unit * (LARGEST * (1_u32 << FRACTION_BITS) as f32)
    }

    /// [`DeviationMap::largest`], or the error that names `field` where that is beyond `largest`.
    pub(crate) const fn checked(&self, field: &'static str, largest: f32) -> Result<f32, Error> {
        // A map keeps its largest sample within a rounding.
        let margin = 1.0 + 4.0 * f32::EPSILON;
        in_range(field, self.largest(), 0.0, largest * margin)
    }

    pub(crate) const fn extremes(&self) -> (f32, f32) {
        let (mut least, mut largest) = (f32::INFINITY, f32::NEG_INFINITY);
        let mut index = 0;
        while index < SAMPLES {
            // The lower half is the signed step to the next sample, which borrows from the upper one where it is below zero.
            let sample = ((self.samples[index] + 0x8000) >> 16) as f32;
            (least, largest) = (least.min(sample), largest.max(sample));
            index += 1;
        }
        let unit = self.unit * (1_u32 << FRACTION_BITS) as f32;
        (unit * least, unit * largest)
    }

    /// Deviation at a phase of the period in units of 2^-32, rad: linear between samples, which is within
    /// `(pi order/64)²/2` of a wave's amplitude, 1.2e-3 for the first order.
    #[inline]
    pub fn at(&self, phase: u32) -> f32 {
        self.units(phase >> (32 - PHASE_BITS)) as f32 * self.unit
    }

    /// Deviation at a phase in units of 2^-20 of the period, over [`DeviationMap::unit`]; full periods do not count.
    #[inline(always)]
    pub(super) fn units(&self, phase: u32) -> i32 {
        let index = (phase >> FRACTION_BITS) as usize % SAMPLES;
        let fraction = (phase & ((1 << FRACTION_BITS) - 1)) as i32;
        self.samples.get(index).map_or(0, |&sample| {
            // The packed word shifted right by 2 is sample x 2^14 plus a quarter of the packed difference: an error of 2^-16 of
            // the step to the next sample.
            (sample >> (16 - FRACTION_BITS)) + i32::from(sample as i16) * fraction
        })
    }

    #[inline(always)]
    pub(super) const fn unit(&self) -> f32 {
        self.unit
    }
}

/// Sines of the samples' phases, by rotation from one to the next at compile time.
#[doc(hidden)]
pub const SINES: [f32; SAMPLES] = {
    // cos and sin of 2 pi/64.
    const STEP: (f64, f64) = (0.995_184_726_672_196_9, 0.098_017_140_329_560_6);
    let mut sines = [0.0; SAMPLES];
    let (mut cos, mut sin) = (1.0_f64, 0.0_f64);
    let mut sample = 0;
    while sample < SAMPLES {
        sines[sample] = sin as f32;
        (cos, sin) = (cos * STEP.0 - sin * STEP.1, sin * STEP.0 + cos * STEP.1);
        sample += 1;
    }
    sines
};

#[cfg(test)]
mod tests {
    use super::*;

    /// Nothing between the samples is beyond the largest one or beyond the extremes, and a crest that falls off is counted whole.
    #[test]
    fn bounds_hold_at_every_phase() {
        for order in 0..=HIGHEST_ORDER {
            for (cosine, sine) in [(0.0123, 0.0), (0.0, -0.0123), (-0.031, 0.0077)] {
                let wave = Harmonic {
                    order,
                    cosine,
                    sine,
                };
                let other = Harmonic {
                    order: 5,
                    cosine: 0.3 * sine,
                    sine: 0.7 * cosine,
                };
                for waves in [&[wave][..], &[wave, other]] {
                    let Ok(map) = DeviationMap::from_harmonics(1, waves) else {
                        panic!("{waves:?}")
                    };
                    let (least, largest) = map.extremes();
                    // One rounding of a product, in the extremes alone.
                    let rounding = f32::EPSILON * map.largest();
                    for phase in 0..1_u32 << PHASE_BITS {
                        let at = map.at(phase << (32 - PHASE_BITS));
                        assert!(at.abs() <= map.largest(), "{order} {at}");
                        assert!(
                            at >= least - rounding && at <= largest + rounding,
                            "{order} {at} {least} {largest}"
                        );
                    }
                    // A map of zeros keeps 1e-9 rad to divide by.
                    let off = (largest.max(-least) - map.largest()).abs();
                    assert!(off <= rounding.max(1e-9), "{order} {least} {largest}");
                }
            }
        }
    }

    /// Samples are rounded to a part in 16383 of the largest one.
    #[test]
    fn extremes_are_those_of_the_samples() {
        let map = |order, cosine| {
            DeviationMap::from_harmonics(
                1,
                &[Harmonic {
                    order,
                    cosine,
                    sine: 0.0,
                }],
            )
        };
        for (order, cosine, expected) in [
            (0, 0.03, (0.03, 0.03)),
            (0, -0.03, (-0.03, -0.03)),
            (2, 0.1, (-0.1, 0.1)),
            (0, 0.0, (0.0, 0.0)),
        ] {
            let Ok(map) = map(order, cosine) else {
                panic!("{order} {cosine}")
            };
            let (least, largest) = map.extremes();
            assert!((least - expected.0).abs() < 1e-5, "{least}");
            assert!((largest - expected.1).abs() < 1e-5, "{largest}");
        }
        assert_eq!(DeviationMap::NONE.extremes(), (0.0, 0.0));
    }
}
