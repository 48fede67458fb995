//! What is folded: a caged ball screw with its numbers.

use epas_friction::ranges::ROLLING_CONTACT_ANGLE;
use epas_friction::{BallScrew, Clearance, Error, Limits, Range, RollingResistance};
use epas_reference::friction::held_ball::HeldBall;
use epas_reference::friction::patch::Integration;
use epas_reference::friction::rolling_resistance::RollingResistance as ExactResistance;

use crate::drawing::drawing;

const REVERSAL_SPEED: Range = Range::new(1e-6, 1e3);

/// Range of a friction coefficient that is folded.
pub(crate) const FRICTION: Range = Range::new(1e-3, 0.5);

const LOADED_BALLS: Range = Range::new(1.0, 1e3);

/// A ball screw whose balls do not touch (caged, or with spacer balls), with its numbers; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CagedDesign {
    /// The validated design; contact angle 0.05 to 1.5 rad.
    pub design: BallScrew,
    /// Coulomb friction coefficient of ball and groove, 1e-3 to 0.5: the one that is folded; of a range, the one before another is set.
    pub friction: f32,
    /// Rolling resistance of every contact of ball and groove.
    pub rolling_resistance: RollingResistance,
    /// How balls fit between the grooves, -0.02 to 0.05 ball radii.
    pub clearance: Clearance,
    /// Number of balls that carry load, 1 to 1000.
    pub loaded_balls: u16,
    /// Nut speed over which friction changes its direction, rad/s, 1e-6 to 1e3: at this speed it has 71 % of its full value.
    pub reversal_speed: f32,
    /// Bounds that are kept whatever comes in.
    pub limits: Limits,
}

impl CagedDesign {
    /// The design, checked.
    pub fn checked(self) -> Result<Self, Error> {
        let contact_angle = self.design.parameters().contact_angle;
        ROLLING_CONTACT_ANGLE.checked("contact_angle", contact_angle)?;
        FRICTION.checked("friction", self.friction)?;
        LOADED_BALLS.checked("loaded_balls", self.loaded_balls.into())?;
        REVERSAL_SPEED.checked("reversal_speed", self.reversal_speed)?;
        Ok(Self {
            rolling_resistance: self.rolling_resistance.checked()?,
            clearance: self.clearance.checked(&self.design)?,
            limits: self.limits.checked()?,
            ..self
        })
    }
}

impl CagedDesign {
    /// The exact ball of it, with a friction coefficient.
    #[must_use]
    pub fn exact_ball(&self, friction: f32) -> HeldBall {
        HeldBall {
            design: drawing(self.design.parameters()),
            clearance: self.clearance.gap().into(),
            friction: friction.into(),
            rolling: ExactResistance {
                hysteresis_loss: self.rolling_resistance.hysteresis_loss.into(),
                lubricant_drag: self.rolling_resistance.lubricant_drag.into(),
            },
            integration: Integration::Full,
        }
    }
}
