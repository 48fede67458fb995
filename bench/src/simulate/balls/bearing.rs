//! A linear bearing whose balls press on each other.

use epas_friction::{
    FrictionModel, LinearBearingConfiguration, LinearBearingTrain, LinearInputs, LinearOutputs,
};

use crate::balls::{Built, Configuration};
use crate::memory::Remembering;
use crate::number::with_balls;
use crate::row::{Row, pressing};

/// A linear bearing with so many balls, 1 to 64.
///
/// # Errors
/// [`epas_friction::Error`] naming a field out of range.
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

impl<const N: usize> Row for LinearBearingTrain<N> {
    fn pressing(state: &Self::State) -> u64 {
        pressing(&state.circuit.train)
    }

    fn set_place(model: &mut FrictionModel<Self>, position: f32) -> bool {
        model.set_carriage_position(position);
        true
    }

    fn set_remembered_place(_: &mut FrictionModel<Remembering<Self>>, _: f32) -> bool {
        false
    }
}
