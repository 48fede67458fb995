//! Fits of what is not linear: parameters that enter linearly eliminated, the few others searched. It knows nothing of friction.

pub mod problem;
pub mod search;
#[cfg(test)]
mod tests;
#[cfg(test)]
pub(crate) mod toys;
pub(crate) mod uncertainty;
