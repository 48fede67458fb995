//! What the elements of a memory are built from.

use super::resistance::{Resistance, SLOPE};

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
