//! The structures of the functions without state: what is asked, and the answer.

use crate::types::BallScrew;

/// The clearance itself is given, m.
pub const EPAS_GIVEN_CLEARANCE: u32 = 0u32;
/// The force of each of a ball's four contacts without load is given, N, 1e-3 to 1e6.
pub const EPAS_GIVEN_PRELOAD: u32 = 1u32;
/// The travel of the nut along the axis from one flank to the other is given, m.
pub const EPAS_GIVEN_AXIAL_PLAY: u32 = 2u32;

/// How balls fit between the grooves, in the words of a drawing or a data sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct ClearanceRequest {
    /// The design.
    pub design: BallScrew,
    /// What the value is, one of `EPAS_GIVEN_...`.
    pub given: u32,
    /// The value, in m or N. Its field is named after what it is.
    pub value: f32,
    /// Number of balls that carry load, 1 to 1000.
    pub loaded_balls: u32,
}

/// One clearance in all its words.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Clearance {
    /// Radial gap of every contact at a centred ball without load, m: what the configurations take.
    pub clearance: f32,
    /// Force of each of a ball's four contacts without load, N; 0 with play.
    pub preload: f32,
    /// Axial preload of all loaded balls on each flank of the nut, N; 0 with play.
    pub axial_preload: f32,
    /// Travel of the nut along the axis from one flank to the other, m; 0 with oversize.
    pub axial_play: f32,
}

/// Groove of the screw shaft.
pub const EPAS_GROOVE_SCREW: u32 = 0u32;
/// Groove of the nut.
pub const EPAS_GROOVE_NUT: u32 = 1u32;

/// What the closed-form efficiency depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct EfficiencyRequest {
    /// Lead angle, rad, 0 to 1.5.
    pub lead_angle: f32,
    /// Contact angle, rad, 0.001 to pi/2.
    pub contact_angle: f32,
    /// Ball radius over pitch radius, 0 to 1.
    pub ball_ratio: f32,
    /// Coulomb friction coefficient, 0 to 1.
    pub friction: f32,
    /// Lever arm of rolling friction over `ball_radius sin(contact_angle)`, 0 to 0.1.
    pub rolling_tangent: f32,
}

/// Efficiencies in closed form; each is negative where the screw locks.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Efficiency {
    /// Rolling, rotation moves the load: the expected value.
    pub rolling_drive: f32,
    /// Rolling, the load turns the screw; -infinity where there is no lead but rolling resistance.
    pub rolling_backdrive: f32,
    /// Full sliding, rotation moves the load: the pessimistic bound.
    pub sliding_drive: f32,
    /// Full sliding, the load turns the screw.
    pub sliding_backdrive: f32,
    /// 1 where full sliding locks the drive, else 0.
    pub locked_drive: u32,
    /// 1 where full sliding locks the back-drive, else 0.
    pub locked_backdrive: u32,
}

/// Which curvature is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct CurvatureRequest {
    /// The design.
    pub design: BallScrew,
    /// Which groove, one of `EPAS_GROOVE_...`.
    pub groove: u32,
    /// Contact angle, rad, 0 to pi/2.
    pub contact_angle: f32,
}

/// Principal curvatures of a groove at a contact point, 1/m; the normal points into the metal: at the
/// screw the first is positive, at the nut negative.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Curvature {
    /// First curvature (along the ball path), exact.
    pub first: f32,
    /// Second curvature (across the ball path), exact.
    pub second: f32,
    /// First curvature of a circular groove along the helix: within 1 % on catalogue sizes.
    pub circular_groove: f32,
    /// First curvature by the formula of the literature, which ignores the lead.
    pub literature: f32,
}
