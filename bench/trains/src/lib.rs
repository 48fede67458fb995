//! Scenes with a row of balls, for any number of balls: in the crate that number is a constant, in a program it comes from a design file.

mod balls;
mod bearing;
mod memory;
mod number;
mod row;
mod screw;

pub use balls::{Balls, Built, Configuration};
pub use bearing::bearing;
pub use memory::{ELEMENTS, Elements, Remembering, RememberingConfiguration, TEMPERATURE, fresh};
pub use number::MOST_BALLS;
pub use screw::{Folded, NODES, ScrewConfiguration, screw};
