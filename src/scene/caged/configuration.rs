//! What the engineer sets for a caged ball screw.

use crate::ball::Clearance;
use crate::contact::RollingResistance;
use crate::geometry::BallScrew;
use crate::scene::closed_form::{ClosedFormScrewConfiguration, FrictionBranch};
use crate::scene::contract::Limits;

/// What the engineer sets for a caged ball screw; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CagedBallScrewConfiguration {
    /// The validated design; contact angle 0.05 to 1.5 rad for [`FrictionBranch::Contacts`].
    pub design: BallScrew,
    /// Coulomb friction coefficient of ball and groove, 1e-6 to 0.5; 0 to 1 for the closed forms.
    pub friction: f32,
    /// Rolling resistance of every contact of ball and groove; closed forms know none.
    pub rolling_resistance: RollingResistance,
    /// Lever arm of rolling friction over `ball_radius sin(contact_angle)`, eq. (2), 0 to 0.1; for the closed forms alone:
    /// see [`FrictionBranch`].
    pub rolling_tangent: f32,
    /// Which state of the ball the torque is computed for.
    pub branch: FrictionBranch,
    /// How balls fit between the grooves, -0.02 to 0.05 ball radii. The closed forms know no third contact: for them oversize
    /// presses each flank of the nut with [`Clearance::axial_preload`], and play changes nothing.
    pub clearance: Clearance,
    /// Number of balls that carry load, 1 to 1000.
    pub loaded_balls: u16,
    /// Nut speed over which friction changes its direction, rad/s, 1e-6 to 1e3: at this speed it has
    /// 71 % of its full value.
    pub reversal_speed: f32,
    /// Bounds that are kept whatever comes in.
    pub limits: Limits,
}

impl CagedBallScrewConfiguration {
    /// What the closed forms read of it.
    pub(super) const fn closed_form(&self) -> ClosedFormScrewConfiguration {
        ClosedFormScrewConfiguration {
            design: self.design,
            friction: self.friction,
            rolling_tangent: self.rolling_tangent,
            branch: self.branch,
            clearance: self.clearance,
            loaded_balls: self.loaded_balls,
            reversal_speed: self.reversal_speed,
            limits: self.limits,
        }
    }
}
