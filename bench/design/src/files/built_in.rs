//! Numbers of the built-in designs that stand on no drawing.

use epas_friction::geometry::{FINE_LEAD_SIZES, STEERING_SIZES};
use epas_friction::{Clearance, defaults};

/// Five counts of an encoder of 14 bits in a millisecond, rad/s.
const REVERSAL_SPEED: f32 = 2.0;

/// What no drawing of a built-in design says, the same in every scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Friction coefficient of ball and groove.
    pub friction: f32,
    /// How the balls fit.
    pub clearance: Clearance,
    /// Nut speed over which friction changes its direction, rad/s.
    pub reversal_speed: f32,
}

impl Settings {
    /// A size of no paper, and a file that does not say them.
    pub const USUAL: Self = Self {
        friction: defaults::FRICTION,
        clearance: defaults::CLEARANCE,
        reversal_speed: REVERSAL_SPEED,
    };
    /// A size of a paper that prints no coefficient: that of the example of Lin, Velinsky, Ravani 1994.
    const PAPERS: Self = Self {
        friction: 0.075,
        clearance: Clearance::ZERO,
        reversal_speed: 0.5,
    };
    /// Section 3.4.4 of Lin 2019, which prints its coefficient.
    const LIN_3_6: Self = Self {
        friction: 0.1,
        ..Self::PAPERS
    };

    pub fn of(name: &str) -> Self {
        let mut usual = FINE_LEAD_SIZES.iter().chain(&STEERING_SIZES);
        match name {
            "lin-3.6" => Self::LIN_3_6,
            _ if usual.any(|size| size.name == name) => Self::USUAL,
            _ => Self::PAPERS,
        }
    }
}
