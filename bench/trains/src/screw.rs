//! A ball screw whose balls press on each other.

use epas_friction::{
    FrictionModel, Inputs, UncagedBallScrew, UncagedBallScrewConfiguration, UncagedOutputs,
};

use crate::balls::{Built, Configuration};
use crate::memory::Remembering;
use crate::number::with_balls;
use crate::row::{Row, pressing};

/// A ball screw with so many balls, 1 to 64.
///
/// # Errors
/// [`epas_friction::Error`] naming a field out of range.
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

impl<const N: usize> Row for UncagedBallScrew<N> {
    fn pressing(state: &Self::State) -> u64 {
        pressing(&state.circuit.train)
    }

    fn set_place(model: &mut FrictionModel<Self>, angle: f32) -> bool {
        model.set_nut_angle(angle);
        true
    }

    fn set_remembered_place(model: &mut FrictionModel<Remembering<Self>>, angle: f32) -> bool {
        model.set_nut_angle(angle);
        true
    }
}
