//! Full friction of a caged ball screw.

use crate::scene::faults::Faults;

/// Full friction of a caged ball screw in both directions.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CagedFull {
    /// Friction torque of motion forward and backward, N m, not negative.
    pub(in crate::scene) forward: f32,
    pub(in crate::scene) backward: f32,
    /// Axial load of all balls, preload counted, N.
    pub(in crate::scene) load: f32,
    pub(in crate::scene) faults: Faults,
}

impl CagedFull {
    /// Friction torque in the direction of a sign.
    #[inline(always)]
    pub(in crate::scene) const fn of(&self, way: f32) -> f32 {
        if way < 0.0 {
            self.backward
        } else {
            self.forward
        }
    }
}
