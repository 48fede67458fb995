//! The potential of a contact over spin and semi-major axis.

/// Derivatives of `P` by `x` (along) and `z` (across), and `M = P - x P_x - z P_z` (moment): numbers without unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Potential {
    pub(super) moment: f32,
    pub(super) along: f32,
    pub(super) across: f32,
    pub(super) along_along: f32,
    pub(super) mixed: f32,
    pub(super) across_across: f32,
}
