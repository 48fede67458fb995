//! The estimator of a drive: inertia, viscous and Coulomb friction, losses of a load, by one linear least squares.
//!
//! ```text
//! effort - tau = J a + b w + offset + s (T_C + driving_loss |tau|   where s tau > 0
//!                                            + back_driving_loss |tau| where s tau < 0)
//! ```
//!
//! Every term is multiplied by one compact kernel `phi` of half-width `L` and summed (a weak form): derivatives of the motion go to the
//! kernel, `sum phi a = sum phi'' x`, so that effort and motion pass the same filter and nothing is differentiated. A row counts where its
//! whole window lies in a stretch of one direction, as the sensor tells it, beyond a way `m` after the turn: the direction `s` is a constant
//! of the row. `L` and `m` are those with the narrowest intervals. An interval is the jackknife over stretches and pieces of them, joined with
//! twice what a kernel of twice the length and twice the way say otherwise.

pub(crate) mod choice;
pub(crate) mod fit;
pub mod kernel;
pub mod record;
pub mod rows;
pub(crate) mod stretches;
pub(crate) mod terms;
pub(crate) mod words;

#[cfg(test)]
pub(crate) mod drives;
#[cfg(test)]
mod tests;
