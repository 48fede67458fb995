//! How large a friction is beside that of its model.

use crate::error::{Error, Range, attempt};

/// Least and largest level: beyond any change of a sound mechanism. Between -20 and 80 degrees Celsius a friction coefficient changes
/// by a factor of two; where a level of 0.1 or 10 was right, the model was of another screw.
pub const LEVEL: Range = Range::new(0.1, 10.0);

/// Friction of gross sliding over that of the model, in both directions; 0.1 to 10.
///
/// A level scales the limits of a memory and nothing else: the stiffness of its elements stays, so that friction stays passive
/// however the level changes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FrictionLevel {
    /// In the positive direction, 0.1 to 10.
    pub forward: f32,
    /// In the negative direction, 0.1 to 10.
    pub backward: f32,
}

impl FrictionLevel {
    /// Friction as the model has it.
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

    /// Level of a direction, given by its sign; 0 counts as forward.
    #[inline(always)]
    #[must_use]
    pub const fn of(&self, direction: f32) -> f32 {
        if direction < 0.0 {
            self.backward
        } else {
            self.forward
        }
    }
}
