//! What a number of elements remembers.

use crate::error::{Error, attempt, in_range};

/// Largest torque of an element that a state may hold, N m or N.
pub(super) const LARGEST: f32 = 1e12;

/// The friction that each of `N` elements carries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MemoryState<const N: usize> {
    pub(super) torques: [f32; N],
}

impl<const N: usize> MemoryState<N> {
    /// No element carries anything.
    pub const VIRGIN: Self = Self { torques: [0.0; N] };

    /// What each element carries, N m (N), in the order of the elements.
    #[must_use]
    pub const fn torques(&self) -> [f32; N] {
        self.torques
    }

    /// A state from what each element carries. Torques beyond an element's limit are cut in the next tick.
    ///
    /// # Errors
    /// `torques`, where one is not a number within 1e12.
    pub const fn from_torques(torques: [f32; N]) -> Result<Self, Error> {
        let mut index = 0;
        while index < N {
            attempt!(in_range("torques", torques[index], -LARGEST, LARGEST));
            index += 1;
        }
        Ok(Self { torques })
    }
}

#[cfg(feature = "defmt")]
impl<const N: usize> defmt::Format for MemoryState<N> {
    fn format(&self, formatter: defmt::Formatter<'_>) {
        defmt::write!(
            formatter,
            "MemoryState {{ torques: {=[?]} }}",
            &self.torques[..]
        );
    }
}
