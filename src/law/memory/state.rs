//! State of elements, and their sliders, which leave a finite number finite, whatever the limits are: NaN never stays in a state.

use crate::error::{Error, Range, attempt, in_range};
use crate::stored::{Port, Refusal, Stored};

/// Largest number that a state may hold, N m or N.
pub(super) const LARGEST: f32 = 1e12;

/// Numbers of `N` elements, N m (N): of [`ProportionalElements`](super::ProportionalElements) the friction over the element's share, so that
/// tables can be swapped while it runs; of [`LoadExactElements`](super::LoadExactElements) the friction itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MemoryState<const N: usize> {
    pub(super) held: [f32; N],
}

impl<const N: usize> MemoryState<N> {
    /// No element holds anything.
    pub const VIRGIN: Self = Self { held: [0.0; N] };

    /// Number of each element, for export.
    pub const fn held(&self) -> [f32; N] {
        self.held
    }

    /// A state from the number of each element; beyond an element's limit it is cut in the next tick.
    ///
    /// # Errors
    /// [`Error`] naming `held`, where one is NaN or beyond 1e12.
    pub const fn from_held(held: [f32; N]) -> Result<Self, Error> {
        let mut index = 0;
        while index < N {
            attempt!(in_range("held", held[index], -LARGEST, LARGEST));
            index += 1;
        }
        Ok(Self { held })
    }
}

#[cfg(feature = "defmt")]
impl<const N: usize> defmt::Format for MemoryState<N> {
    fn format(&self, formatter: defmt::Formatter<'_>) {
        defmt::write!(formatter, "MemoryState {{ held: {=[?]} }}", &self.held[..]);
    }
}

/// Turns below this size, rad (m), are turns: `2^20`, far beyond any sensor's.
const TURN_BEYOND: f32 = 1_048_576.0;

/// A turn, or none where it is NaN or beyond any sensor's. Bits of positive numbers rise with them, those of NaN above all: a comparison of
/// integers costs three cycles less than one of numbers.
#[inline(always)]
pub(super) fn turned(turn: f32) -> f32 {
    let size = turn.to_bits() << 1;
    if size < TURN_BEYOND.to_bits() << 1 {
        turn
    } else {
        0.0
    }
}

#[inline(always)]
pub(super) fn held(force: f32, low: f32, high: f32) -> f32 {
    let force = if force > high { high } else { force };
    if force < low { low } else { force }
}

/// Two at once, operation by operation: the core waits a cycle where an operation needs the result of the one before.
#[inline(always)]
pub(super) fn held_pair([f, g]: [f32; 2], low: [f32; 2], high: [f32; 2]) -> [f32; 2] {
    let f = if f > high[0] { high[0] } else { f };
    let g = if g > high[1] { high[1] } else { g };
    let f = if f < low[0] { low[0] } else { f };
    let g = if g < low[1] { low[1] } else { g };
    [f, g]
}

#[inline(always)]
pub(super) fn not_negative(value: f32) -> f32 {
    if value < 0.0 { 0.0 } else { value }
}

impl<const N: usize> Stored for MemoryState<N> {
    const BYTES: usize = 4 * N;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.numbers("held", &mut self.held, Range::new(-LARGEST, LARGEST))
    }
}
