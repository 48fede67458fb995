//! The phase of the groove that passes by.

use crate::error::Range;
use crate::stored::{Port, Refusal, Stored};

/// Units of a period of the passing groove, and of a track.
pub(super) const UNITS: f32 = 4_294_967_296.0;

/// A phase that advances by parts of a unit and wraps around.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Phase {
    /// Units of 2^-32 of a period.
    units: u32,
    /// Part of the advance so far that is not yet a whole unit.
    remainder: f32,
}

impl Phase {
    #[inline(always)]
    pub(super) const fn units(&self) -> u32 {
        self.units
    }

    #[inline(always)]
    pub(super) fn advance(&mut self, units: f32) {
        let units = units + self.remainder;
        let whole = units as i32;
        self.units = self.units.wrapping_add_signed(whole);
        self.remainder = units - whole as f32;
    }

    /// Sets the phase to a number of periods, of which only the fraction counts; NaN, and what is beyond 8e6 periods,
    /// counts as 0.
    pub(super) fn set(&mut self, periods: f32) {
        let periods = if periods.abs() < 8_388_608.0 {
            periods
        } else {
            0.0
        };
        let fraction = periods - periods as i32 as f32;
        // In half periods, because a whole one does not fit into 31 bits and a sign.
        let half = (fraction * (0.5 * UNITS)) as i32;
        self.units = (half as u32).wrapping_mul(2);
        self.remainder = 0.0;
    }
}

impl Stored for Phase {
    const BYTES: usize = 8;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.word(&mut self.units)?;
        port.number("remainder", &mut self.remainder, Range::new(-1.0, 1.0))
    }
}
