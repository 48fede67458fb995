//! Measured and catalogue figures of real ball screws beside what the exact model computes: [`records`], and the studies behind them.
//!
//! No figure comes with all that the model needs: geometry, lubricant or seals are missing somewhere. So figures are bands, assumptions are
//! stated, and each row says which parameter would have to be what to meet its figure. Nothing is fitted but where a row says so.

pub mod catalogue;
pub mod cold;
mod figure;
mod rows;
mod rules;
pub mod studies;

use rayon::prelude::*;

use epas_page::failure::Failure;
pub use figure::{Measured, Standing, Usual};

/// All figures, computed in parallel. `step` is called after each of the [`COUNT`].
pub fn records(usual: &Usual, step: &(dyn Fn() + Sync)) -> Result<Vec<Measured>, Failure> {
    rows::ROWS
        .par_iter()
        .map(|(name, row)| {
            let found = row(usual)?;
            step();
            Measured::of(name, &found)
        })
        .collect()
}

pub const COUNT: usize = rows::ROWS.len();
