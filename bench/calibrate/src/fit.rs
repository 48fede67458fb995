//! Fits of what is not linear: parameters that enter linearly eliminated, the few others searched. It knows nothing of friction.
//!
//! | module | what |
//! |---|---|
//! | [`problem`] | what is fitted: parameters that enter linearly, and the few others |
//! | [`search`] | the fit: linear parameters eliminated, Levenberg-Marquardt for the others |
//! | [`uncertainty`] | intervals and covariance, how far rows repeat each other |

pub mod problem;
pub mod search;
#[cfg(test)]
mod tests;
#[cfg(test)]
pub(crate) mod toys;
pub(crate) mod uncertainty;
