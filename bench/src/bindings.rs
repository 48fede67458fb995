//! What bindings to other languages take of the program: designs, scenes over traces, `eval` without its command line.

pub use crate::controller::Controller;
pub use crate::designs::train::{LinearDesign, UncagedDesign};
pub use crate::designs::{Design, DesignSource, built_in, read as read_design, text};
pub use crate::eval::fit_range;
pub use crate::failure::Failure;
pub use crate::simulate::bindings::{
    Balls, Built, Caged, CagedRow, Folded, Friction, Linear, LinearRow, LinearSample, Lines,
    Manoeuvre, ReferenceModel, Remembered, Remembers, Scene, ScrewConfiguration, ScrewSample,
    Trace, TrainRow, Uncaged, UncagedRow, Use, angle, coefficients, regime_name, remembering,
    wrapped,
};

/// The answer of `eval` to one line, as one line without its end.
pub fn eval(line: &str) -> String {
    crate::eval::answer_line(line)
}
