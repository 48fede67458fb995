//! The structures of the functions without state: what is asked, and the answer.

use crate::types::BallScrew;

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
