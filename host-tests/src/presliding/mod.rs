//! Friction before gross sliding: a hysteresis in angle, exactly.
//!
//! Stick gives way to slip from the edge of the contact inwards (Cattaneo 1938, Mindlin 1949). The first loading is the *backbone*; what
//! follows repeats it, doubled in both directions, from every turning point (Masing 1926), and a loop that closes is forgotten (Madelung
//! 1905). Parallel elements that stick and slip (Iwan 1966) do the same for a backbone of straight pieces.
//!
//! Units: an angle is one over the breakaway angle of gross slip across, a torque one over the limit under the reference load, a load one
//! over the reference load. So the first stiffness is 1.5 under any load.

pub mod answers;
pub mod backbone;
pub mod elements;
pub mod load_exact;
pub mod masing;
pub mod physics;
pub mod row;
pub mod tables;

/// Limits of sliding at a tick, over the limit under the reference load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Friction of sliding in the positive direction.
    pub forward: f64,
    /// Friction of sliding in the negative direction, as a positive number.
    pub backward: f64,
}

impl Limits {
    /// One in both directions.
    pub const UNIT: Self = Self {
        forward: 1.0,
        backward: 1.0,
    };

    /// These limits times `factor`.
    pub fn times(self, factor: f64) -> Self {
        Self {
            forward: self.forward * factor,
            backward: self.backward * factor,
        }
    }

    /// `torque` brought between the limits.
    pub fn hold(self, torque: f64) -> f64 {
        torque.min(self.forward).max(-self.backward)
    }
}
