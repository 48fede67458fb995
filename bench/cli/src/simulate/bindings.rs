//! What bindings to other languages take of a simulation.

pub use super::caged::{Caged, wrapped};
pub use super::encoder::EncoderStep;
pub use super::linear::Linear;
pub use super::manoeuvre::{Manoeuvre, trace};
pub use super::memory::{MemorySettings, angle};
pub use super::reference::{Friction, ReferenceModel};
pub use super::remembering::{Remembering, remembering};
pub use super::samples::{LinearSample, ScrewSample};
pub use super::scene::{Row, Scene};
pub use super::trace::{Temperature, Trace};
pub use super::uncaged::Uncaged;
pub use epas_calibrate::outputs::firmware::coefficients;
