//! Measured groove surfaces for the static load distribution (Lin 2019, after eq. (2.3)).

mod fitted;
pub mod spline;

pub use fitted::{Along, FittedSurface, MeasuredPoint};
