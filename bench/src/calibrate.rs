//! `calibrate`: from a measured trace to constants, with their uncertainty.
//!
//! | module | what |
//! |---|---|
//! | [`answer`] | what a calibration answers: parameters with intervals, what cannot be told, scores of models |
//! | [`trace`] | a measured trace on one sample clock, in SI units |
//! | [`signals`] | smoothed motion, and the rows of a regression |
//! | [`problem`] | what is fitted: parameters that enter linearly, and the few others |
//! | [`picture`] | what the page of a calibration draws, as plain data |
//! | `page` | the page of a calibration |
//! | `design_file` | the user's design file with the calibrated numbers |
//! | `constants` | the same as Rust constants for firmware |
//! | `folder` | every trace of a folder, and what they have in common |

pub mod answer;
mod design_file;
pub mod picture;
pub mod problem;
mod shown;
pub mod signals;
pub mod trace;
