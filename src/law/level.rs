//! How large a friction is beside that of its model.

use crate::error::{Error, Range, attempt};

/// Least and largest level.
pub const LEVEL: Range = Range::new(0.1, 10.0);

/// Friction of gross sliding over that of the model, in both directions; 0.1 to 10.
///
/// A level scales the limits of a memory and nothing else: the stiffness of its elements stays, so that friction stays passive
/// however the level changes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FrictionLevel {
    /// In the positive direction.
    pub forward: f32,
    /// In the negative direction.
    pub backward: f32,
}

impl FrictionLevel {
    /// That of the model.
    pub const ONE: Self = Self {
        forward: 1.0,
        backward: 1.0,
    };

    /// These levels, checked.
    ///
    /// # Errors
    /// [`Error`] naming `forward` or `backward`.
    pub const fn checked(self) -> Result<Self, Error> {
        attempt!(LEVEL.checked("forward", self.forward));
        attempt!(LEVEL.checked("backward", self.backward));
        Ok(self)
    }

    /// That of the direction of a sign; 0 counts as forward.
    #[inline(always)]
    #[must_use]
    pub const fn of(&self, way: f32) -> f32 {
        if way < 0.0 {
            self.backward
        } else {
            self.forward
        }
    }
}
