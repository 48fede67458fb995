//! What the engineer sets for a screw by a closed form.

use crate::ball::Clearance;
use crate::geometry::BallScrew;
use crate::scene::contract::Limits;

/// What the engineer sets for a screw by a closed form; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ClosedFormScrewConfiguration {
    /// The validated design.
    pub design: BallScrew,
    /// Coulomb friction coefficient of ball and groove, 0 to 1.
    pub friction: f32,
    /// Lever arm of rolling friction over `ball_radius sin(contact_angle)`, eq. (2), 0 to 0.1.
    pub rolling_tangent: f32,
    /// Which state of the ball the torque is computed for.
    pub branch: FrictionBranch,
    /// How balls fit between the grooves, -0.02 to 0.05 ball radii: oversize presses each flank of the nut with
    /// [`Clearance::axial_preload`]; play changes nothing, for the closed forms know no third contact.
    pub clearance: Clearance,
    /// Number of balls that carry load, 1 to 1000.
    pub loaded_balls: u16,
    /// Nut speed over which friction changes its direction, rad/s, 1e-6 to 1e3: at this speed it has 71 % of its full value.
    pub reversal_speed: f32,
    /// Limits of inputs and outputs.
    pub limits: Limits,
}

/// Which state of the ball the friction torque is computed for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum FrictionBranch {
    /// The ball rolls and slips across the groove at the screw, eq. (3) of Lin, Velinsky and Ravani 1994. It leaves out spin, the
    /// third contact, clearance but for a preload, and the contacts' size: torque is in proportion to the load, and without
    /// [`rolling_tangent`](ClosedFormScrewConfiguration::rolling_tangent) hardly depends on the lead.
    Rolling,
    /// The ball slides along the path at both contacts, eq. (14) and (17) of the same: a pessimistic bound. It leaves out that
    /// balls roll.
    Sliding,
}
