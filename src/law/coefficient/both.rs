//! Friction coefficients of both directions.

/// Friction coefficients of both directions at one speed: what the limits of a memory need.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct DirectionalCoefficient {
    /// In the positive direction.
    pub forward: f32,
    /// In the negative direction.
    pub backward: f32,
}

impl DirectionalCoefficient {
    /// That of the direction of a sign, and that of the opposite one.
    #[inline(always)]
    #[must_use]
    pub const fn of(&self, way: f32) -> (f32, f32) {
        if way < 0.0 {
            (self.backward, self.forward)
        } else {
            (self.forward, self.backward)
        }
    }

    /// Both, at most so large.
    #[inline(always)]
    #[must_use]
    pub const fn within(self, largest: f32) -> Self {
        Self {
            forward: if self.forward < largest {
                self.forward
            } else {
                largest
            },
            backward: if self.backward < largest {
                self.backward
            } else {
                largest
            },
        }
    }

    /// Both over that of the direction of a sign, forward first.
    #[inline(always)]
    #[must_use]
    pub const fn over_own(&self, way: f32) -> [f32; 2] {
        let (own, opposite) = self.of(way);
        let ratio = opposite / own;
        if way < 0.0 {
            [ratio, 1.0]
        } else {
            [1.0, ratio]
        }
    }
}
