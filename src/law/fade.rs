//! How much a reading still counts by its age.

use super::coefficient::TEMPERATURE;
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
    pub(crate) const fn new(
        (hold_name, hold, holds): (&'static str, f32, Range),
        (fade_name, fade, fades): (&'static str, f32, Range),
    ) -> Result<Self, Error> {
        Ok(Self {
            hold: attempt!(holds.checked(hold_name, hold)),
            rate: 1.0 / attempt!(fades.checked(fade_name, fade)),
        })
    }

    /// Whether a reading of an age, s, counts as it is: not where the age is NaN.
    #[inline(always)]
    pub(crate) const fn holds(&self, age: f32) -> bool {
        age <= self.hold
    }

    /// Part of a reading of an age, s, that counts: 1 while it holds, 0 once it has faded or where the age is NaN.
    #[inline(always)]
    pub(crate) const fn left(&self, age: f32) -> f32 {
        if self.holds(age) {
            return 1.0;
        }
        let left = 1.0 - (age - self.hold) * self.rate;
        if left > 0.0 { left } else { 0.0 }
    }
}

/// Longest time, s: a day.
const TIME: Range = Range::new(0.0, 86_400.0);

/// Temperature by the last reading and its age: the reading, and then, little by little, a fallback.
///
/// ```text
/// age <= hold             the reading
/// hold < age < hold + fade        a straight line from one to the other
/// age >= hold + fade      the fallback
/// ```
///
/// The fallback is a temperature at which a wrong coefficient does least harm: for a compensation that with the least friction.
///
/// ```
/// use epas_friction::law::coefficient::TemperatureFade;
/// // Trusted for ten seconds, given up after a minute more.
/// let fade = TemperatureFade::new(353.15, 10.0, 60.0)?;
/// assert_eq!(fade.at(293.15, 5.0), 293.15);
/// assert_eq!(fade.at(293.15, 40.0), 323.15);
/// assert_eq!(fade.at(f32::NAN, 0.0), 353.15);
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct TemperatureFade {
    fallback: f32,
    fade: Fade,
}

impl TemperatureFade {
    /// Readings of the last minute as they are, which fade in another one to 40 degrees Celsius.
    pub const DEFAULT: Self = match Self::new(313.15, 60.0, 60.0) {
        Ok(fade) => fade,
        Err(_) => panic!("the default is out of range"),
    };

    /// Fallback, K, 150 to 500; time for which a reading holds, s, 0 to 86400; time in which it fades after that, s, 1e-3 to 86400.
    pub const fn new(
        fallback_temperature: f32,
        hold_time: f32,
        fade_time: f32,
    ) -> Result<Self, Error> {
        const FADE: Range = Range::new(1e-3, TIME.maximum);
        Ok(Self {
            fallback: attempt!(TEMPERATURE.checked("fallback_temperature", fallback_temperature)),
            fade: attempt!(Fade::new(
                ("hold_time", hold_time, TIME),
                ("fade_time", fade_time, FADE)
            )),
        })
    }

    /// Whether a reading, K, is a temperature of a lubricant.
    #[must_use]
    pub const fn is_temperature(&self, temperature: f32) -> bool {
        TEMPERATURE.contains(temperature)
    }

    /// Whether a reading of an age, s, counts as it is.
    #[must_use]
    pub const fn holds(&self, age: f32) -> bool {
        self.fade.holds(age)
    }

    /// The fallback, K.
    pub const fn fallback(&self) -> f32 {
        self.fallback
    }

    /// Temperature to take, K, from the last reading, K, and its age, s; the fallback where the reading is beyond 150 to 500 K or the age NaN.
    pub const fn at(&self, temperature: f32, age: f32) -> f32 {
        let left = self.fade.left(age);
        if !self.is_temperature(temperature) || left == 0.0 {
            self.fallback
        } else if left < 1.0 {
            self.fallback + left * (temperature - self.fallback)
        } else {
            temperature
        }
    }
}
