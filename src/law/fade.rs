//! How much a reading still counts.

use crate::error::{Error, Range, attempt};

/// A reading that counts as it is for some time, and then fades away in proportion to time.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct Fade {
    hold: f32,
    /// 1 over the time in which it fades, 1/s.
    rate: f32,
}

impl Fade {
    /// Holds for a time, s, and fades in another one, s; each with its name and range.
    ///
    /// # Errors
    /// [`Error`] naming the time that is out of its range.
    pub(crate) const fn new(
        (hold_name, hold, holds): (&'static str, f32, Range),
        (fade_name, fade, fades): (&'static str, f32, Range),
    ) -> Result<Self, Error> {
        Ok(Self {
            hold: attempt!(holds.checked(hold_name, hold)),
            rate: 1.0 / attempt!(fades.checked(fade_name, fade)),
        })
    }

    /// Whether a reading of an age, s, counts as it is: not where the age is no number.
    #[inline(always)]
    pub(crate) const fn holds(&self, age: f32) -> bool {
        age <= self.hold
    }

    /// Part of a reading of an age, s, that counts: 1 while it holds, 0 once it has faded or where the age is no number. An age
    /// below 0 is a fresh reading.
    #[inline(always)]
    pub(crate) const fn left(&self, age: f32) -> f32 {
        if self.holds(age) {
            return 1.0;
        }
        let left = 1.0 - (age - self.hold) * self.rate;
        if left > 0.0 { left } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reading_holds_and_fades() {
        let range = Range::new(0.0, 10.0);
        let fade = Fade::new(("hold", 2.0, range), ("fade", 4.0, range)).unwrap();
        for (age, left) in [
            (f32::NEG_INFINITY, 1.0),
            (-1.0, 1.0),
            (0.0, 1.0),
            (2.0, 1.0),
            (3.0, 0.75),
            (5.0, 0.25),
            (6.0, 0.0),
            (f32::INFINITY, 0.0),
            (f32::NAN, 0.0),
        ] {
            assert_eq!(fade.left(age).to_bits(), f32::to_bits(left), "{age}");
            assert_eq!(fade.holds(age), age <= 2.0, "{age}");
        }
        let error = Fade::new(("hold", 11.0, range), ("fade", 4.0, range)).unwrap_err();
        assert_eq!(error.field(), "hold");
    }
}
