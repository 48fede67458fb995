//! A ball screw whose balls press on each other.

use epas_design::uncaged::Folded;
use epas_design::uncaged_scene::ScrewConfiguration;
use epas_friction::scene::{UncagedBallScrew, UncagedBallScrewConfiguration};
use epas_friction::{FrictionModel, Inputs, UncagedOutputs};

use super::memory::{Remembering, RememberingConfiguration};
use super::row::{Row, pressing};
use super::{Built, CAPACITY, Configuration};

/// A ball screw.
///
/// # Errors
/// [`epas_friction::Error`] naming a field out of range.
pub fn screw(configuration: &Configuration<ScrewConfiguration>) -> Built<Inputs, UncagedOutputs> {
    match configuration {
        Configuration::Plain(plain) => match plain.folded {
            Folded::One(folded) => of_plain(&plain.with(folded)),
            Folded::Range(folded) => of_plain(&plain.with(folded)),
        },
        Configuration::Remembering(whole) => match whole.scene.folded {
            Folded::One(folded) => of_remembering(&around(whole, whole.scene.with(folded))),
            Folded::Range(folded) => of_remembering(&around(whole, whole.scene.with(folded))),
        },
    }
}

fn of_plain<const NODES: usize>(
    configuration: &UncagedBallScrewConfiguration<NODES>,
) -> Built<Inputs, UncagedOutputs> {
    let model = FrictionModel::<UncagedBallScrew<CAPACITY, NODES>>::new(configuration)?;
    Ok(Box::new(model))
}

fn of_remembering<const NODES: usize>(
    configuration: &RememberingConfiguration<UncagedBallScrewConfiguration<NODES>>,
) -> Built<Inputs, UncagedOutputs> {
    let model =
        FrictionModel::<Remembering<UncagedBallScrew<CAPACITY, NODES>>>::new(configuration)?;
    Ok(Box::new(model))
}

/// The same memory around another scene.
fn around<A, B>(whole: &RememberingConfiguration<A>, scene: B) -> RememberingConfiguration<B> {
    let RememberingConfiguration {
        elements,
        angle,
        reference_load,
        play,
        coefficient,
        temperature,
        freshness,
        ..
    } = whole;
    RememberingConfiguration {
        scene,
        elements: *elements,
        angle: *angle,
        reference_load: *reference_load,
        play: *play,
        coefficient: *coefficient,
        temperature: *temperature,
        freshness: *freshness,
    }
}

impl<const N: usize, const K: usize> Row for UncagedBallScrew<N, K> {
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
