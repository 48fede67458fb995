//! What one mechanism resists, alone.

/// Slope of both backbones at their beginning: stiffness times breakaway angle over the limit.
///
/// Slip: `1 - (1 - z)^(3/2)`. Spin: `1.5 z / sqrt(1 + 2.25 z^2)`.
pub(super) const SLOPE: f32 = 1.5;

/// Largest friction and initial stiffness of one mechanism; its motion is an angle of the nut, rad, or a travel of the
/// carriage, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resistance {
    /// Friction of gross sliding, N m or N.
    pub limit: f32,
    /// Initial stiffness, N m/rad or N/m: friction over motion at the beginning of the backbone, and by Masing's rule right after each
    /// reversal.
    pub stiffness: f32,
}

impl Resistance {
    /// Nothing resists.
    pub const NONE: Self = Self {
        limit: 0.0,
        stiffness: 0.0,
    };

    /// `number` of it side by side: the balls of a screw.
    #[must_use]
    pub fn times(self, number: f32) -> Self {
        Self {
            limit: number * self.limit,
            stiffness: number * self.stiffness,
        }
    }

    /// This one and another side by side.
    #[must_use]
    pub fn beside(self, other: Self) -> Self {
        Self {
            limit: self.limit + other.limit,
            stiffness: self.stiffness + other.stiffness,
        }
    }

    /// Breakaway angle, rad, or travel, m: `1.5 limit / stiffness`, in which the curve of Mindlin's slip reaches the limit.
    /// The curve of spin has 83 % of its limit there. 0 where nothing resists.
    #[must_use]
    pub fn breakaway(self) -> f32 {
        if self.stiffness > 0.0 {
            SLOPE * self.limit / self.stiffness
        } else {
            0.0
        }
    }
}
