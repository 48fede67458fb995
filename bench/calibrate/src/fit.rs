//! The estimator: rows in, parameters with their uncertainty out. It knows nothing of friction.
//!
//! | module | what |
//! |---|---|
//! | [`problem`] | what is fitted: parameters that enter linearly, and the few others |
//! | [`separable`] | the fit: linear parameters eliminated, Levenberg-Marquardt for the others, several starts |
//! | [`part`] | a part of a problem's rows |
//! | [`uncertainty`] | intervals, correlations, the direction that the rows do not see |
//! | [`profile`] | how the residual grows when a parameter is held elsewhere |
//! | [`cramer_rao`] | the least covariance that any estimator can have |
//! | [`telling`] | what the rows cannot tell, in sentences |

pub mod cramer_rao;
pub mod part;
pub mod problem;
pub mod search;
pub mod separable;
#[cfg(test)]
pub(crate) mod toys;
pub mod uncertainty;
