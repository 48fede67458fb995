//! What both rows of balls have in common as models.

use epas_friction::law::coefficient::OneCoefficient;
use epas_friction::scene::{ChangingFriction, Motion, Sliding, StoredScene};
use epas_friction::stored::Stored;
use epas_friction::train::Train;
use epas_friction::{Error, FrictionModel, Refusal};

use super::Balls;
use super::memory::{Remembering, fresh};

/// A scene with a row of balls.
pub trait Row:
    StoredScene
    + Sliding<Constants: Copy, Inputs: Stored, Friction: Stored + Default>
    + ChangingFriction
    + Copy
{
    /// Balls that press on the one in front, one bit each.
    fn pressing(state: &Self::State) -> u64;

    /// As [`Balls::set_place`].
    fn set_place(model: &mut FrictionModel<Self>, place: f32) -> bool;

    /// The same of a model that remembers.
    fn set_remembered_place(model: &mut FrictionModel<Remembering<Self>>, place: f32) -> bool;
}

/// Balls of a train that press on the one in front, one bit each.
pub fn pressing<const N: usize>(train: &Train<N>) -> u64 {
    train
        .contacts()
        .iter()
        .fold(0, |bits, contact| bits | 1 << contact.ball)
}

fn exported<S: StoredScene>(model: &FrictionModel<S>) -> Result<Vec<u8>, Refusal> {
    let mut block = vec![0; FrictionModel::<S>::STATE_BYTES];
    let length = model.export(&mut block)?;
    block.truncate(length);
    Ok(block)
}

impl<S: Row> Balls<S::Inputs, S::Outputs> for FrictionModel<S>
where
    Self: Copy + Send + Sync + 'static,
{
    fn step(&mut self, inputs: S::Inputs) -> S::Outputs {
        Self::step(self, inputs)
    }

    fn pressing(&self) -> u64 {
        S::pressing(self.state())
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

    fn set_place(&mut self, place: f32) -> bool {
        S::set_place(self, place)
    }

    fn export(&self) -> Result<Vec<u8>, Refusal> {
        exported(self)
    }

    fn import(&mut self, block: &[u8]) -> Result<(), Refusal> {
        Self::import(self, block)
    }

    fn copied(&self) -> Box<dyn Balls<S::Inputs, S::Outputs>> {
        Box::new(*self)
    }
}

impl<S: Row> Balls<S::Inputs, S::Outputs> for FrictionModel<Remembering<S>>
where
    Self: Copy + Send + Sync + 'static,
{
    fn step(&mut self, inputs: S::Inputs) -> S::Outputs {
        Self::step(self, fresh(inputs, inputs.speed()))
    }

    fn pressing(&self) -> u64 {
        S::pressing(&self.state().scene)
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

    fn set_place(&mut self, place: f32) -> bool {
        S::set_remembered_place(self, place)
    }

    fn export(&self) -> Result<Vec<u8>, Refusal> {
        exported(self)
    }

    fn import(&mut self, block: &[u8]) -> Result<(), Refusal> {
        self.import_with_reading(block)
    }

    fn copied(&self) -> Box<dyn Balls<S::Inputs, S::Outputs>> {
        Box::new(*self)
    }
}
