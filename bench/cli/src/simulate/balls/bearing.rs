//! A linear bearing whose balls press on each other.

use epas_friction::{
    FrictionModel, LinearBearingConfiguration, LinearBearingTrain, LinearInputs, LinearOutputs,
};

use super::memory::Remembering;
use super::row::{Row, pressing};
use super::{Built, CAPACITY, Configuration};

/// A linear bearing.
///
/// # Errors
/// [`epas_friction::Error`] naming a field out of range.
pub fn bearing(
    configuration: &Configuration<LinearBearingConfiguration>,
) -> Built<LinearInputs, LinearOutputs> {
    match configuration {
        Configuration::Plain(plain) => Ok(Box::new(
            FrictionModel::<LinearBearingTrain<CAPACITY>>::new(plain)?,
        )),
        Configuration::Remembering(whole) => Ok(Box::new(FrictionModel::<
            Remembering<LinearBearingTrain<CAPACITY>>,
        >::new(whole)?)),
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
