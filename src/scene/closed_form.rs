//! A ball screw whose balls do not touch, by the closed forms of the papers: from catalogue numbers alone, without a host.

mod configuration;
mod stored;
mod torque;

use super::caged_friction::CagedFriction;
use super::contract::{CheckedInputs, Inputs, Limits, Scene};
use super::outputs::Outputs;
use super::reversal::{Reversal, ReversalState};
use super::sliding::{Sliding, SlidingFriction};
use crate::error::{Error, Range, attempt, in_range};
use crate::law::coefficient::DirectionalCoefficient;
use crate::ranges;
pub use configuration::{ClosedFormScrewConfiguration, FrictionBranch};
use torque::ClosedForm;

/// A ball screw whose balls do not touch, by a paper's closed form: for comparison.
///
/// Torque is in proportion to the load; spin, a third contact and the size of the contacts are left out (see [`FrictionBranch`]). Over the built-in
/// designs, 5 to 300 N a ball, a rolling ball has 0.02 to 1.1 times the exact torque, a sliding one 0.6 to 14 times. Who has no host takes
/// [`built_in`](crate::scene::built_in) sizes for a [`CagedBallScrew`](crate::scene::CagedBallScrew): as exact as what a host folds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ClosedFormScrew;

/// Constants of a screw by a closed form.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ClosedFormScrewConstants {
    form: ClosedForm,
    reversal: Reversal,
    limits: Limits,
}

/// What a tick changes in a screw by a closed form: nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ClosedFormScrewState;

impl ClosedFormScrewConstants {
    /// Checks a configuration and folds its constants: at set-up, or in a constant when firmware is compiled.
    ///
    /// # Errors
    /// [`Error`] naming the field out of range.
    pub const fn new(configuration: &ClosedFormScrewConfiguration) -> Result<Self, Error> {
        let ClosedFormScrewConfiguration {
            rolling_tangent,
            loaded_balls,
            reversal_speed,
            limits,
            ..
        } = *configuration;
        attempt!(in_range("rolling_tangent", rolling_tangent, 0.0, 0.1));
        attempt!(in_range("loaded_balls", loaded_balls as f32, 1.0, 1e3));
        Ok(Self {
            reversal: attempt!(Reversal::new(reversal_speed, 1e-6, 1e3)),
            limits: attempt!(limits.checked()),
            form: attempt!(ClosedForm::new(configuration)),
        })
    }
}

impl Scene for ClosedFormScrew {
    type Configuration = ClosedFormScrewConfiguration;
    type Constants = ClosedFormScrewConstants;
    type State = ClosedFormScrewState;
    type Inputs = Inputs;
    type ValidInputs = Inputs;
    type Outputs = Outputs;

    fn constants(
        configuration: &ClosedFormScrewConfiguration,
    ) -> Result<ClosedFormScrewConstants, Error> {
        ClosedFormScrewConstants::new(configuration)
    }

    fn initial_state(_: &ClosedFormScrewConstants) -> ClosedFormScrewState {
        ClosedFormScrewState
    }

    fn take_over(_: &ClosedFormScrewConstants, _: &mut ClosedFormScrewState) -> Result<(), Error> {
        Ok(())
    }

    #[inline(always)]
    fn check_inputs(constants: &ClosedFormScrewConstants, inputs: Inputs) -> CheckedInputs<Inputs> {
        constants.limits.check_inputs(inputs)
    }

    #[inline(always)]
    fn outputs(
        constants: &ClosedFormScrewConstants,
        _: &mut ClosedFormScrewState,
        inputs: Inputs,
    ) -> Outputs {
        constants.form.outputs(&constants.reversal, inputs)
    }

    #[inline(always)]
    fn largest_friction(constants: &ClosedFormScrewConstants) -> f32 {
        constants.limits.friction_torque
    }
}

impl Sliding for ClosedFormScrew {
    const FRICTION: Range = ranges::FRICTION_OF_A_ROW;

    const COUNTS_PRELOAD: bool = true;

    type Friction = CagedFriction;

    #[inline(always)]
    fn sliding_friction(
        constants: &ClosedFormScrewConstants,
        _: &mut ClosedFormScrewState,
        inputs: Inputs,
        _: DirectionalCoefficient,
    ) -> CagedFriction {
        constants.form.both_ways(inputs.axial_load)
    }

    #[inline(always)]
    fn by_direction(sliding: &CagedFriction) -> SlidingFriction {
        sliding.by_direction()
    }

    #[inline(always)]
    fn outputs_at(
        constants: &ClosedFormScrewConstants,
        inputs: Inputs,
        sliding: &CagedFriction,
        reversal: ReversalState,
    ) -> Outputs {
        constants
            .form
            .outputs_at(inputs.axial_load, sliding, reversal)
    }

    #[inline(always)]
    fn limited_travel(_: &ClosedFormScrewConstants, turn: f32, measured: f32) -> (f32, f32) {
        (turn, measured)
    }
}
