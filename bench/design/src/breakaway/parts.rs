//! What the elements of a memory are built from.

/// Breakaway angle of a part without friction, rad: any number above zero would do, because its share is none.
const NO_PART: f32 = 1e-3;

/// How friction of a contact comes about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mechanism {
    /// Slip across the ball path. Backbone of Mindlin: `1 - (1 - z)^(3/2)`, with the motion `z` over the breakaway angle.
    Slip,
    /// Spin about the contact's normal. Backbone `1.5 z / sqrt(1 + 2.25 z^2)`.
    Spin,
    /// Rolling resistance. Backbone taken as that of slip, by analogy.
    RollingResistance,
}

/// One mechanism of a screw or a bearing: elements with its backbone, scaled by its share and its breakaway angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BreakawayPart {
    /// The mechanism, which decides on the backbone.
    pub mechanism: Mechanism,
    /// Share of the friction of gross sliding, 0 to 1; the shares of all parts add up to 1. A part without a share needs no
    /// elements.
    pub share: f32,
    /// Motion in which the backbone's unit is reached: rad of the nut, or m of the carriage; above 0.
    pub breakaway_angle: f32,
    /// Initial stiffness, N m/rad or N/m: `1.5 share friction / breakaway_angle`.
    pub stiffness: f32,
}

impl BreakawayPart {
    /// The part that a mechanism has in the friction `whole` of all, N m or N.
    pub(super) fn of(mechanism: Mechanism, resistance: Resistance, whole: f32) -> Self {
        let none = Self {
            mechanism,
            share: 0.0,
            breakaway_angle: NO_PART,
            stiffness: 0.0,
        };
        if resistance.limit > 0.0 && resistance.stiffness > 0.0 {
            Self {
                share: resistance.limit / whole,
                breakaway_angle: resistance.breakaway(),
                stiffness: resistance.stiffness,
                ..none
            }
        } else {
            none
        }
    }

    /// The same with another breakaway angle above 0; a part without a share stays as it is.
    pub(super) fn within(self, breakaway_angle: f32, whole: f32) -> Self {
        if self.share > 0.0 && breakaway_angle > 0.0 {
            Self {
                breakaway_angle,
                stiffness: SLOPE * self.share * whole / breakaway_angle,
                ..self
            }
        } else {
            self
        }
    }
}

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

/// Halvings: 24 for the digits of an f32, and 16 for roots that are small beside the interval.
const HALVINGS: u8 = 40;

/// Upper end of the interval in which `is_below` changes from true to false, after 40 halvings of the interval from `low` to `high`.
pub fn first_not_below(mut low: f32, mut high: f32, is_below: impl Fn(f32) -> bool) -> f32 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if is_below(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}
