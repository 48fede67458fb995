//! A function of the logarithm of a load, in eight cubic parts.

use crate::error::{Error, attempt, in_range};

/// Parts of a [`LoadCurve`].
pub const PARTS: usize = 8;

/// Exponent's bias and mantissa's bits of an `f32`.
const BIAS: u32 = 127;
const MANTISSA: u32 = 23;

/// Coefficients of `log2(1 + m)` by the powers 1 to 4 of `m`: value and slope are continuous where the exponent changes (they add up to 1, and
/// the slope at 0 is twice that at 1); the two that this leaves free are those of the least error.
const LOGARITHM: [f32; 4] = [1.438_308_4, -0.674_842_3, 0.315_605_3, -0.079_071_4];

/// Logarithm of a positive number to the base 2, plus 127, within 1.3e-4: the biased exponent and a polynomial of the mantissa.
///
/// Value and slope are continuous, so that a curve over it has no kinks of its own. 0 gives 0.
#[inline(always)]
#[must_use]
pub const fn octaves(number: f32) -> f32 {
    let bits = number.to_bits();
    let mantissa = f32::from_bits(bits & ((1 << MANTISSA) - 1) | (BIAS << MANTISSA)) - 1.0;
    let [a, b, c, d] = LOGARITHM;
    (bits >> MANTISSA) as f32 + mantissa * (a + mantissa * (b + mantissa * (c + mantissa * d)))
}

/// A function of the [`octaves`] of a load: a cubic in each part.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LoadCurve {
    /// Where each part begins, octaves, rising; parts that are not needed begin at `f32::MAX`. The first begins where the curve does.
    pub starts: [f32; PARTS],
    /// Coefficients of the powers 0 to 3 of the octaves above the part's begin.
    pub cubics: [[f32; 4]; PARTS],
}

impl LoadCurve {
    /// The curve's value.
    #[inline(always)]
    pub(crate) const fn at(&self, octaves: f32) -> f32 {
        // Begins are not negative: numbers not below them have bits not below theirs, and integers are compared in half the cycles.
        let bits = octaves.to_bits().cast_signed();
        let mut part = 0;
        let mut step = PARTS / 2;
        while step > 0 {
            // The mask tells the compiler what the halving ensures: the index is one of an array.
            if bits >= self.starts[(part + step) % PARTS].to_bits().cast_signed() {
                part += step;
            }
            step /= 2;
        }
        let [a, b, c, d] = self.cubics[part % PARTS];
        let along = octaves - self.starts[part % PARTS];
        a + along * (b + along * (c + along * d))
    }

    /// Refuses numbers that are no curve.
    pub(super) const fn checked(self) -> Result<Self, Error> {
        let mut part = 0;
        while part < PARTS {
            let least = if part == 0 {
                0.0
            } else {
                self.starts[part - 1]
            };
            attempt!(in_range("starts", self.starts[part], least, f32::MAX));
            let [a, b, c, d] = self.cubics[part];
            attempt!(in_range("cubics", a, 0.0, 1e9));
            attempt!(in_range("cubics", b, -1e9, 1e9));
            attempt!(in_range("cubics", c, -1e9, 1e9));
            attempt!(in_range("cubics", d, -1e9, 1e9));
            part += 1;
        }
        Ok(self)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Within 1.4e-4 of the logarithm, from the least to the largest normal number.
    #[test]
    fn octaves_are_logarithms() {
        for step in 0..25_300_u16 {
            let exponent = -126.0 + 0.01 * f64::from(step);
            let number = libm::exp2(exponent) as f32;
            let found = f64::from(octaves(number)) - 127.0;
            assert!((found - exponent).abs() < 1.4e-4, "{exponent}: {found}");
        }
    }

    /// A curve of four parts with these values at their begins, which rises by half a unit an octave.
    pub(crate) fn curve(of: [f32; 4]) -> LoadCurve {
        let mut starts = [f32::MAX; PARTS];
        let mut cubics = [[0.0; 4]; PARTS];
        for (part, value) in of.iter().enumerate() {
            starts[part] = 120.0 + 2.0 * part as f32;
            cubics[part] = [*value, 0.5, 0.0, 0.0];
        }
        LoadCurve { starts, cubics }
    }

    /// Each load meets the part in which it lies, its begin included.
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
}
