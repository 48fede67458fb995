//! Friction coefficients of both directions.

/// Friction coefficients of ball and groove in both directions at one speed: what the limits of a memory need.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct DirectionalCoefficient {
    /// In the positive direction, 1e-6 to 1.
    pub forward: f32,
    /// In the negative direction, 1e-6 to 1.
    pub backward: f32,
}

impl DirectionalCoefficient {
    /// Coefficient of a direction, given by its sign, and of the opposite direction; 0 and NaN count as forward. No
    /// arithmetic.
    #[inline(always)]
    #[must_use]
    pub const fn of(&self, direction: f32) -> (f32, f32) {
        if direction < 0.0 {
            (self.backward, self.forward)
        } else {
            (self.forward, self.backward)
        }
    }

    /// Both coefficients, cut to `largest`; NaN becomes that.
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

    /// Both coefficients over the one of a direction, given by its sign, forward first: 1 and a ratio, 1e-6 to 1e6. Cost: one
    /// division.
    #[inline(always)]
    #[must_use]
    pub const fn over_own(&self, direction: f32) -> [f32; 2] {
        let (own, opposite) = self.of(direction);
        let ratio = opposite / own;
        if direction < 0.0 {
            [ratio, 1.0]
        } else {
            [1.0, ratio]
        }
    }
}
