//! Sliding friction of a screw whose balls do not touch.

use super::faults::Faults;
use super::sliding::SlidingFriction;
use crate::error::Range;
use crate::ranges;
use crate::stored::{Port, Refusal, Stored};

/// Sliding friction of a screw whose balls do not touch, in both directions.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CagedFriction {
    /// Friction torque of motion forward and backward, N m, not negative.
    pub(super) forward: f32,
    pub(super) backward: f32,
    /// Axial load of all balls, preload counted, N.
    pub(super) load: f32,
    pub(super) faults: Faults,
}

impl CagedFriction {
    /// Friction torque in the direction of a sign.
    #[inline(always)]
    pub(super) const fn of(&self, direction: f32) -> f32 {
        if direction < 0.0 {
            self.backward
        } else {
            self.forward
        }
    }

    /// Its sizes in both directions, and the load.
    #[inline(always)]
    pub(super) const fn by_direction(&self) -> SlidingFriction {
        SlidingFriction {
            forward: self.forward,
            backward: self.backward,
            load: self.load,
        }
    }
}

impl Stored for CagedFriction {
    const BYTES: usize = 12 + Faults::BYTES;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.number("forward", &mut self.forward, ranges::STORED_FRICTION)?;
        port.number("backward", &mut self.backward, ranges::STORED_FRICTION)?;
        port.number("load", &mut self.load, Range::new(0.0, 1e13))?;
        self.faults.exchange(port)
    }
}
