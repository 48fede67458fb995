//! Applications of the static model: Lin 2019, chapter 4.
//!
//! Where the text leaves a parameter out, it is an input here with a stated default, and what comes out is
//! to be compared with the text in kind.
//!
//! Each study computes its points on all cores and calls `tick` after each point; where that returns false,
//! the study ends with [`ReferenceError::Cancelled`].

pub mod lash;
pub mod scaling;
pub mod tie_rod;
pub mod waviness;

use epas_reference::error::ReferenceError;

/// Told of each point that is done; false ends the study.
pub type Tick<'a> = &'a (dyn Fn() -> bool + Sync);

/// For whoever waits without looking.
#[must_use]
pub fn quietly() -> bool {
    true
}

fn told(tick: Tick<'_>) -> Result<(), ReferenceError> {
    if tick() {
        Ok(())
    } else {
        Err(ReferenceError::Cancelled)
    }
}
