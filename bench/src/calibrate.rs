//! `calibrate`: from a measured trace to constants, with their uncertainty.
//!
//! | module | what |
//! |---|---|
//! | [`answer`] | what a calibration answers: parameters with intervals, what cannot be told, scores of models |
//! | [`trace`] | a measured trace on one sample clock, in SI units |
//! | [`columns`] | reads a trace from a CSV file |
//! | [`table`] | the file's numbers in SI units |
//! | [`units`] | what a column's name says |
//! | [`clock`] | one sample clock: tick, gaps, jitter |
//! | [`channels`] | angles without jumps, the step of a sensor |
//! | [`checks`] | whether a trace may be believed |
//! | [`finding`] | what a trace does not tell |
//! | [`filter`] | a low-pass filter without a shift in time |
//! | [`noise`] | noise of smoothed motion |
//! | [`signals`] | smoothed motion, and the rows of a regression |
//! | [`problem`] | what is fitted: parameters that enter linearly, and the few others |
//! | [`screw`] | a trace of a screw whose design is known |
//! | [`picture`] | what the page of a calibration draws, as plain data |
//! | `page` | the page of a calibration |
//! | `design_file` | the user's design file with the calibrated numbers |
//! | `constants` | the same as Rust constants for firmware |
//! | `folder` | every trace of a folder, and what they have in common |
//! | [`separable`] | the fit: linear parameters eliminated, Levenberg-Marquardt for the others, several starts |
//! | [`uncertainty`] | intervals, correlations, the direction that the rows do not see |
//! | [`autocorrelation`] | how far the rows of a residual repeat each other |
//! | [`laws`] | laws of friction of unit level over a motion |
//! | [`slide`] | a trace without a design as a separable problem |
//! | [`choice`] | models of friction on a trace without a design |
//! | [`part`] | a part of a problem's rows |
//! | [`cost`] | cost of a law on the reference core |

pub mod answer;
pub mod autocorrelation;
pub mod channels;
pub mod checks;
pub mod choice;
pub mod clock;
pub mod closed_loop;
pub mod columns;
#[cfg(test)]
mod columns_tests;
pub mod controller;
pub mod cost;
mod design_file;
pub mod filter;
pub mod finding;
pub mod laws;
pub mod noise;
pub mod part;
pub mod period;
pub mod picture;
pub mod problem;
pub mod screw;
pub mod separable;
mod shown;
pub mod signals;
pub mod slide;
pub mod table;
#[cfg(test)]
mod toys;
pub mod trace;
pub mod uncertainty;
pub mod units;
