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
//! | [`separable`] | the fit: linear parameters eliminated, Levenberg-Marquardt for the others, several starts |
//! | [`uncertainty`] | intervals, correlations, the direction that the rows do not see |
//! | [`autocorrelation`] | how far the rows of a residual repeat each other |
//! | [`picture`] | what the page of a calibration draws, as plain data |
//! | [`spectrum`], [`shown`] | power spectral density; numbers as they are shown |
//! | [`page`] | the page of a calibration |
//! | [`design_file`] | the user's design file with the calibrated numbers |
//! | [`firmware`] | what firmware takes of a calibrated design, as plain numbers |
//! | [`outputs`] | what a calibration writes, and where |
//! | [`constants`] | the same as Rust constants for firmware |
//! | `folder` | every trace of a folder, and what they have in common |

pub mod answer;
pub mod autocorrelation;
pub mod channels;
pub mod checks;
pub mod clock;
pub mod columns;
#[cfg(test)]
mod columns_tests;
pub mod constants;
pub mod design_file;
pub mod filter;
pub mod finding;
pub mod firmware;
pub mod noise;
pub mod outputs;
pub mod page;
pub mod picture;
pub mod problem;
pub mod separable;
pub mod shown;
pub mod signals;
pub mod spectrum;
pub mod table;
#[cfg(test)]
mod toys;
pub mod trace;
pub mod uncertainty;
pub mod units;
