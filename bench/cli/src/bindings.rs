//! What bindings to other languages take of the program: designs, models of scenes, runs over traces, `eval` without its command line.

pub use crate::model::{Built, Model, TickInputs, TickOutputs, caged};
pub use crate::simulate::bindings::*;
pub use epas_calibrate::controller::Controller;
pub use epas_design::files::train::{LinearDesign, UncagedDesign};
pub use epas_design::files::{Design, DesignSource, built_in, read as read_design, text};
pub use epas_design::uncaged::Folded;
pub use epas_design::uncaged_scene::ScrewConfiguration;
pub use epas_eval::fit_range;
pub use epas_page::failure::Failure;

/// The answer of `eval` to one line, as one line without its end.
pub fn eval(line: &str) -> String {
    epas_eval::answer_line(line)
}
