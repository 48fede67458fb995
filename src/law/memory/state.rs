//! What a set of elements remembers.

use crate::error::{Error, attempt, in_range};

/// Largest number that a state may hold, N m or N.
pub(super) const LARGEST: f32 = 1e12;

/// What each of `N` elements holds, N m (N), in the order of the elements.
///
/// Of [`ProportionalElements`](super::ProportionalElements) the friction over the element's share, so that a set of elements can
/// be swapped for one with another table and the friction stays nearly as it was; of
/// [`LoadExactElements`](super::LoadExactElements) the friction itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MemoryState<const N: usize> {
    pub(super) held: [f32; N],
}

impl<const N: usize> MemoryState<N> {
    /// No element holds anything.
    pub const VIRGIN: Self = Self { held: [0.0; N] };

    /// What each element holds, for export.
    #[must_use]
    pub const fn held(&self) -> [f32; N] {
        self.held
    }

    /// A state from what each element holds. What is beyond an element's limit is cut in the next tick.
    ///
    /// # Errors
    /// `held`, where one is not a number within 1e12.
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
