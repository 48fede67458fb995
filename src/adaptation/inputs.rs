//! What an adaptation is told at a tick.

use crate::law::FrictionLevel;
use crate::scene::{Faults, Regime};

/// What an adaptation is told at a tick, after the model's step.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct AdaptationInputs {
    /// Torque that the motor had to add to overcome friction, N m: its torque about the nut's axis, less what the inertia took, less
    /// `load_torque`. With the sign of the speed where friction opposes it.
    pub observed: f32,
    /// Friction torque that the model gave, N m: `friction_torque` of its outputs. This and the other torques up to `largest_torque`.
    pub modelled: f32,
    /// Lubricant drag in both, N m, which no level scales: [`FrictionModel::drag_torque`](crate::FrictionModel::drag_torque) of a scene with
    /// memory, 0 without one.
    pub lubricant_drag: f32,
    /// Levels that the model had when it gave it ([`FrictionModel::set_level`](crate::FrictionModel::set_level));
    /// [`FrictionLevel::ONE`] where none were set.
    pub level: FrictionLevel,
    /// Nut speed, rad/s, up to the configuration's `largest_speed`.
    pub nut_speed: f32,
    /// Load torque that was taken off, N m: `load_torque` of the model's outputs.
    pub load_torque: f32,
    /// What the mechanism did, of the model's outputs.
    pub regime: Regime,
    /// Flags of the model's outputs: with any of them the tick does not count.
    pub faults: Faults,
    /// Whether the motor was at its limit, so that its torque is not what was asked for.
    pub saturated: bool,
}
