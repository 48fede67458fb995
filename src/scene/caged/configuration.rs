//! What the engineer sets for a caged ball screw.

use crate::ball::Clearance;
use crate::contact::RollingResistance;
use crate::geometry::BallScrew;
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

/// Which state of the ball the friction torque is computed for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum FrictionBranch {
    /// What the contacts of a ball dissipate in its balance between elastic grooves: they spin and slip, along the track and
    /// across it, all of them that carry; with their rolling resistance. It is the friction of an
    /// [`UncagedBallScrew`](crate::UncagedBallScrew) whose balls do not press on each other.
    ///
    /// Before the first tick the friction torque is folded into a law over the load, 0.01 to 1000 N a ball, for both
    /// directions. Where friction coefficient or clearance are set while the model runs
    /// ([`FrictionModel::set_friction`](crate::FrictionModel::set_friction)), a ball is renewed in every tick instead.
    #[default]
    Contacts,
    /// The ball rolls and slips across the groove at the screw, eq. (3) of Lin, Velinsky and Ravani 1994: a closed form, for
    /// comparison. It leaves out spin, the third contact, clearance but for a preload, and the contacts' size: torque is in
    /// proportion to the load, and without [`rolling_tangent`](CagedBallScrewConfiguration::rolling_tangent) hardly depends
    /// on the lead.
    Rolling,
    /// The ball slides along the path at both contacts, eq. (14) and (17) of the same: a closed form for comparison, a
    /// pessimistic bound. It leaves out that balls roll.
    Sliding,
}
