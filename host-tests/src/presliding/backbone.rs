//! First loading of a contact: torque over angle, from rest without memory.

/// A backbone: concave, zero at zero, with the slope 1.5 there, one in the end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Backbone {
    /// Slip across the path: `1 - (1 - z)^(3/2)` up to `z = 1` (Cattaneo 1938, Mindlin 1949), exact for a Hertzian contact of any ellipse.
    Slip,
    /// Spin: `y / sqrt(1 + y^2)` with `y = 1.5 z`: within 0.004 of bristles on ellipses with axis ratios of 0.17 to 0.22, as balls
    /// have in their grooves, within 0.033 on a circle.
    Spin,
}

impl Backbone {
    /// Torque at `angle`, not negative.
    pub fn torque(self, angle: f64) -> f64 {
        match self {
            Self::Slip if angle >= 1.0 => 1.0,
            Self::Slip => 1.0 - (1.0 - angle).powf(1.5),
            Self::Spin => {
                let y = 1.5 * angle;
                y / y.hypot(1.0)
            }
        }
    }

    /// Slope at `angle`, not negative.
    pub fn stiffness(self, angle: f64) -> f64 {
        match self {
            Self::Slip => 1.5 * (1.0 - angle).max(0.0).sqrt(),
            Self::Spin => 1.5 * (1.5 * angle).hypot(1.0).powi(-3),
        }
    }
}
