//! A ball screw whose balls press on each other.

use epas_design::uncaged::Folded;
use epas_friction::scene::{FoldedBall, UncagedBallScrew, UncagedBallScrewConfiguration};
use epas_friction::{DeviationMap, FrictionModel, Inputs, LoadShares, UncagedOutputs};

use super::memory::{Remembering, RememberingConfiguration};
use super::row::{Row, pressing};
use super::{Built, CAPACITY, Configuration};

/// What is set for a screw beside what a host has folded of its ball: see [`UncagedBallScrewConfiguration`].
#[derive(Clone, Copy, Debug)]
pub struct ScrewConfiguration {
    /// What a host has folded.
    pub folded: Folded,
    /// Friction coefficient of ball and ball.
    pub ball_friction: f32,
    /// Balls in the circuit, 1 to 64.
    pub balls: u16,
    /// Turns of the loaded track.
    pub turns: f32,
    /// Length of the return, m.
    pub return_length: f32,
    /// Deviation along the screw's groove.
    pub screw_deviation: &'static DeviationMap,
    /// Deviation along the nut's groove.
    pub nut_deviation: &'static DeviationMap,
    /// Loads of the balls over their mean.
    pub load_shares: LoadShares,
    /// Time between two ticks, s.
    pub tick: f32,
}

impl ScrewConfiguration {
    /// The scene's configuration, with one of the blocks.
    pub(crate) const fn with<const N: usize>(
        &self,
        folded: &'static FoldedBall<N>,
    ) -> UncagedBallScrewConfiguration<N> {
        UncagedBallScrewConfiguration {
            folded,
            ball_friction: self.ball_friction,
            balls: self.balls,
            turns: self.turns,
            return_length: self.return_length,
            screw_deviation: self.screw_deviation,
            nut_deviation: self.nut_deviation,
            load_shares: self.load_shares,
            tick: self.tick,
        }
    }
}

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
