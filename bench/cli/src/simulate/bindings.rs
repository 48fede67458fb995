//! What bindings to other languages take of a simulation: traces, scenes with their models and rows.

pub use epas_design::uncaged::Folded;

pub use super::balls::{Balls, Built};
pub use super::caged::{Caged, CagedRow, wrapped};
pub use super::encoder::EncoderStep;
pub use super::linear::{Linear, LinearRow};
pub use super::manoeuvre::{Manoeuvre, trace};
pub use super::memory::{Remembered, angle};
pub use super::reference::{Friction, ReferenceModel};
pub use super::remembering::{Remembers, Use, coefficients, remembering};
pub use super::samples::{LinearSample, ScrewSample};
pub use super::scene::Scene;
pub use super::summary::{Lines, regime_name};
pub use super::trace::Trace;
pub use super::train::TrainRow;
pub use super::uncaged::{Uncaged, UncagedRow};
