//! A drive without a drawing: Coulomb and viscous friction, and a loss in proportion to the transmitted load.

use super::contract::{
    CheckedInputs, Inputs, Limits, Reversal, ReversalState, Scene, SceneOutputs as _,
};
use super::outputs::Outputs;
use crate::error::{Error, all_in_range, attempt};

/// A drive whose geometry is not known, by four numbers that `epas calibrate` identifies from a trace without a design.
///
/// `T = s (T_C + eta |tau|) + b w`, with the torque `tau` of the load, `eta` the loss of driving (`w tau > 0`: motor power flows to the
/// load) or of back-driving (`w tau < 0`: the load drives the motor), and `s = w / sqrt(w^2 + w_s^2)` at the speed `w`. Friction never
/// drives: the product of `T` and `w` is not negative. Not in it: how the friction coefficient follows speed and temperature, and friction
/// that remembers; both need a design ([`CagedBallScrew`](crate::scene::CagedBallScrew) in [`WithMemory`](crate::scene::WithMemory)).
///
/// ```
/// use epas_friction::{FrictionModel, Inputs, Limits, LoadProportionalConfiguration, LoadProportionalScrew, Regime};
///
/// let mut model = FrictionModel::<LoadProportionalScrew>::new(&LoadProportionalConfiguration {
///     load_lever: 1.0, // the load is given as its torque
///     coulomb_friction: 0.05,
///     viscous_friction: 1e-3,
///     driving_loss: 0.10,
///     back_driving_loss: 0.13,
///     reversal_speed: 0.05,
///     limits: Limits { nut_speed: 100.0, axial_load: 20.0, friction_torque: 5.0 },
/// })?;
/// let driving = model.step(Inputs { nut_speed: 10.0, axial_load: 2.0 });
/// assert!((driving.friction_torque - (0.05 + 0.10 * 2.0 + 1e-3 * 10.0)).abs() < 1e-5);
/// let driven = model.step(Inputs { nut_speed: -10.0, axial_load: 2.0 });
/// assert!((driven.friction_torque + (0.05 + 0.13 * 2.0 + 1e-3 * 10.0)).abs() < 1e-5);
/// assert_eq!(driven.regime, Regime::BackDriving);
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LoadProportionalScrew;

/// Configuration of a drive without a drawing; unchecked.
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

/// Constants of a drive without a drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LoadProportionalConstants {
    load_lever: f32,
    coulomb_friction: f32,
    viscous_friction: f32,
    driving_loss: f32,
    back_driving_loss: f32,
    reversal: Reversal,
    limits: Limits,
}

impl LoadProportionalConstants {
    /// Checks a configuration.
    pub const fn new(configuration: &LoadProportionalConfiguration) -> Result<Self, Error> {
        let c = configuration;
        attempt!(all_in_range(&[
            ("load_lever", c.load_lever, 1e-6, 1e3),
            ("coulomb_friction", c.coulomb_friction, 0.0, 1e6),
            ("viscous_friction", c.viscous_friction, 0.0, 1e6),
            ("driving_loss", c.driving_loss, 0.0, 10.0),
            ("back_driving_loss", c.back_driving_loss, 0.0, 10.0),
        ]));
        Ok(Self {
            load_lever: c.load_lever,
            coulomb_friction: c.coulomb_friction,
            viscous_friction: c.viscous_friction,
            driving_loss: c.driving_loss,
            back_driving_loss: c.back_driving_loss,
            reversal: attempt!(Reversal::new(c.reversal_speed, 1e-6, 1e3)),
            limits: attempt!(c.limits.checked()),
        })
    }
}

impl Scene for LoadProportionalScrew {
    type Configuration = LoadProportionalConfiguration;
    type Constants = LoadProportionalConstants;
    type State = ();
    type Inputs = Inputs;
    type Outputs = Outputs;

    fn constants(configuration: &Self::Configuration) -> Result<Self::Constants, Error> {
        LoadProportionalConstants::new(configuration)
    }

    fn initial_state(_: &Self::Constants) {}

    fn take_over(_: &Self::Constants, (): &mut Self::State) -> Result<(), Error> {
        Ok(())
    }

    #[inline]
    fn step(constants: &Self::Constants, (): &mut Self::State, inputs: Inputs) -> Outputs {
        let CheckedInputs { inputs, faults } = constants.limits.check_inputs(inputs);
        let Some(Inputs {
            nut_speed,
            axial_load,
        }) = inputs
        else {
            return Outputs::safe(faults);
        };
        let reversal = constants.reversal.at(nut_speed);
        let ReversalState {
            factor, direction, ..
        } = reversal;
        let load_torque = constants.load_lever * axial_load;
        let loss = if direction * load_torque < 0.0 {
            constants.back_driving_loss
        } else {
            constants.driving_loss
        };
        let sliding = constants.coulomb_friction + loss * load_torque.abs();
        let viscous = constants.viscous_friction * nut_speed;
        Outputs::new(
            factor * sliding + viscous,
            sliding + direction * viscous,
            load_torque,
            &reversal,
            faults,
            constants.limits.friction_torque,
        )
    }
}
