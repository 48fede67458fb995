//! A ball screw whose balls press on each other.

use epas_friction::law::coefficient::OneCoefficient;
use epas_friction::{
    Error, FrictionModel, Inputs, UncagedBallScrew, UncagedBallScrewConfiguration, UncagedOutputs,
};

use crate::memory::{Remembering, fresh};
use crate::number::with_balls;
use crate::{Balls, Built, Configuration, pressing};

/// A ball screw with so many balls, 1 to 64.
///
/// # Errors
/// [`Error`] naming a field out of range.
pub fn screw(
    balls: u8,
    configuration: &Configuration<UncagedBallScrewConfiguration>,
) -> Built<Inputs, UncagedOutputs> {
    match configuration {
        Configuration::Plain(plain) => with_balls!(plain, UncagedBallScrew, balls, plain),
        Configuration::Remembering(whole) => {
            with_balls!(remembering, UncagedBallScrew, balls, whole)
        }
    }
}

impl<const N: usize> Balls<Inputs, UncagedOutputs> for FrictionModel<UncagedBallScrew<N>> {
    fn step(&mut self, inputs: Inputs) -> UncagedOutputs {
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

    fn set_place(&mut self, angle: f32) -> bool {
        self.set_nut_angle(angle);
        true
    }

    fn copied(&self) -> Box<dyn Balls<Inputs, UncagedOutputs>> {
        Box::new(*self)
    }
}

impl<const N: usize> Balls<Inputs, UncagedOutputs>
    for FrictionModel<Remembering<UncagedBallScrew<N>>>
{
    fn step(&mut self, inputs: Inputs) -> UncagedOutputs {
        Self::step(self, fresh(inputs, inputs.nut_speed))
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

    fn set_place(&mut self, angle: f32) -> bool {
        self.set_nut_angle(angle);
        true
    }

    fn copied(&self) -> Box<dyn Balls<Inputs, UncagedOutputs>> {
        Box::new(*self)
    }
}
