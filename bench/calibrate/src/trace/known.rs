//! An effort that is known and that the controller did not command: a pulse, a weight on a cord, another drive.
//!
//! It acts in the direction of positive motion. Some recorders add it to the motor's effort, because it is made at the controller's output;
//! others do not: whichever explains the motion better.

/// An effort that is known and that the controller did not command.
#[derive(Clone, Debug, PartialEq)]
pub struct KnownEffort {
    /// At every sample, N m or N, in the direction of positive motion.
    pub values: Vec<f64>,
    /// Whether the motor's effort holds it already.
    pub in_effort: bool,
}

impl KnownEffort {
    /// What acts beside the motor's effort.
    pub fn beside(&self) -> Option<&[f64]> {
        (!self.in_effort).then_some(self.values.as_slice())
    }

    /// What the motor's effort holds beside the controller's.
    pub fn within(&self) -> Option<&[f64]> {
        self.in_effort.then_some(self.values.as_slice())
    }
}
