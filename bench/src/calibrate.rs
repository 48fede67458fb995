//! `calibrate`: from a measured trace to constants, with their uncertainty.
//!
//! | module | what |
//! |---|---|
//! | [`trace`] | a measured trace on one sample clock, in SI units |
//! | [`signals`] | smoothed motion, and the rows of a regression |
//! | [`problem`] | what is fitted: parameters that enter linearly, and the few others |
//! | [`separable`] | the fit: linear parameters eliminated, Levenberg-Marquardt for the others, several starts |
//! | [`uncertainty`] | intervals, correlations, the direction that the rows do not see |
//! | [`autocorrelation`] | how far the rows of a residual repeat each other |

pub mod autocorrelation;
pub mod problem;
pub mod separable;
pub mod signals;
#[cfg(test)]
mod toys;
pub mod trace;
pub mod uncertainty;
