//! A row of balls as a program holds it: with memory or without, for one friction coefficient or a range.

mod bearing;
mod memory;
mod row;
mod screw;

use epas_friction::{Error, Refusal};

pub use bearing::bearing;
use memory::RememberingConfiguration;
pub use memory::{ELEMENTS, Elements, Remembering, Speed, TEMPERATURE, fresh};
pub use screw::screw;

/// Most balls of a row: one compiled model serves all numbers up to it.
pub const MOST_BALLS: u8 = 64;

/// The same as the capacity of a model.
pub const CAPACITY: usize = MOST_BALLS as usize;

/// The in-loop model of a scene.
pub trait Balls<Inputs, Outputs>: Send + Sync {
    /// One tick.
    fn step(&mut self, inputs: Inputs) -> Outputs;
    /// Balls that press on the one in front, one bit each.
    fn pressing(&self) -> u64;
    /// Back to the state before the first tick.
    fn reset(&mut self);
    /// Consecutive ticks with a fault.
    fn faulted_ticks(&self) -> u32;
    /// Sets the friction coefficient of ball and groove.
    ///
    /// # Errors
    /// [`Error`] naming it; the model goes on as it was.
    fn set_friction(&mut self, friction: f32) -> Result<(), Error>;
    /// Sets where the grooves' deviations are counted from: angle of the nut, rad, or place of the carriage, m. False where
    /// the scene does not take it.
    fn set_place(&mut self, place: f32) -> bool;
    /// Its state as a block.
    ///
    /// # Errors
    /// What the crate refuses.
    fn export(&self) -> Result<Vec<u8>, Refusal>;
    /// Takes the state of a block over, with the last reading of its sensor.
    ///
    /// # Errors
    /// What the crate refuses; the state is as it was.
    fn import(&mut self, block: &[u8]) -> Result<(), Refusal>;
    /// The same model in the same state.
    fn copied(&self) -> Box<dyn Balls<Inputs, Outputs>>;
}

/// A model as it is built.
pub type Built<Inputs, Outputs> = Result<Box<dyn Balls<Inputs, Outputs>>, Error>;

/// A scene's configuration, without memory or with it.
#[derive(Clone, Copy, Debug)]
pub enum Configuration<C> {
    /// Friction passes through a reversal with the speed.
    Plain(C),
    /// It has a memory.
    Remembering(RememberingConfiguration<C>),
}
