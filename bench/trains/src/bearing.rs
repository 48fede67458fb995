//! A linear bearing whose balls press on each other.

use epas_friction::law::coefficient::OneCoefficient;
use epas_friction::{
    Error, FrictionModel, LinearBearingConfiguration, LinearBearingTrain, LinearInputs,
    LinearOutputs,
};

use crate::memory::{Remembering, fresh};
use crate::number::with_balls;
use crate::{Balls, Built, Configuration, pressing};

/// A linear bearing with so many balls, 1 to 64.
///
/// # Errors
/// [`Error`] naming a field out of range.
pub fn bearing(
    balls: u8,
    configuration: &Configuration<LinearBearingConfiguration>,
) -> Built<LinearInputs, LinearOutputs> {
    match configuration {
        Configuration::Plain(plain) => with_balls!(plain, LinearBearingTrain, balls, plain),
        Configuration::Remembering(whole) => {
            with_balls!(remembering, LinearBearingTrain, balls, whole)
        }
    }
}

impl<const N: usize> Balls<LinearInputs, LinearOutputs> for FrictionModel<LinearBearingTrain<N>> {
    fn step(&mut self, inputs: LinearInputs) -> LinearOutputs {
        Self::step(self, inputs)
    }

    fn pressing(&self) -> u64 {
        pressing(&self.state().circuit.train)
    }

    fn reset(&mut self) {
        Self::reset(self);
    }

    fn faulted_ticks(&self) -> u32 {
        Self::faulted_ticks(self)
    }

    fn set_friction(&mut self, friction: f32) -> Result<(), Error> {
        Self::set_friction(self, friction)
    }

    fn set_place(&mut self, position: f32) -> bool {
        self.set_carriage_position(position);
        true
    }

    fn copied(&self) -> Box<dyn Balls<LinearInputs, LinearOutputs>> {
        Box::new(*self)
    }
}

impl<const N: usize> Balls<LinearInputs, LinearOutputs>
    for FrictionModel<Remembering<LinearBearingTrain<N>>>
{
    fn step(&mut self, inputs: LinearInputs) -> LinearOutputs {
        Self::step(self, fresh(inputs, inputs.speed))
    }

    fn pressing(&self) -> u64 {
        pressing(&self.state().scene.circuit.train)
    }

    fn reset(&mut self) {
        Self::reset(self);
    }

    fn faulted_ticks(&self) -> u32 {
        Self::faulted_ticks(self)
    }

    fn set_friction(&mut self, friction: f32) -> Result<(), Error> {
        self.set_coefficient(OneCoefficient::new(friction)?)
    }

    fn set_place(&mut self, _: f32) -> bool {
        false
    }

    fn copied(&self) -> Box<dyn Balls<LinearInputs, LinearOutputs>> {
        Box::new(*self)
    }
}
