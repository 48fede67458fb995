//! What the engineer sets for a drive without a drawing.

use crate::scene::contract::Limits;

/// What the engineer sets for a drive without a drawing; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LoadProportionalConfiguration {
    /// Torque about the nut's axis of a unit of [`Inputs::axial_load`](crate::Inputs::axial_load), m, 1e-6 to 1e3: `lead / 2 pi` of a
    /// load in N. At 1 the load is given as its torque, N m, and its limit is one of a torque.
    pub load_lever: f32,
    /// Friction torque without a load, N m, 0 to 1e6.
    pub coulomb_friction: f32,
    /// Friction torque over the speed, N m s/rad, 0 to 1e6.
    pub viscous_friction: f32,
    /// Friction torque over the torque of a load that the motor drives, 0 to 10: the efficiency is at most `1 / (1 + driving_loss)`.
    pub driving_loss: f32,
    /// Friction torque over the torque of a load that drives the motor, 0 to 10: the efficiency is at most `1 - back_driving_loss`, and
    /// from 1 on no load drives.
    pub back_driving_loss: f32,
    /// Nut speed over which friction changes its direction, rad/s, 1e-6 to 1e3: at this speed it has 71 % of its full value.
    pub reversal_speed: f32,
    /// Limits of inputs and outputs.
    pub limits: Limits,
}
