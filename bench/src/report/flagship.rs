//! The ball screw without cage of the dissertation, beside the exact one.

use std::time::Instant;

use crate::exact_ring::{Case, Comparison, compare};
use crate::failure::Failure;

/// The screw of Table 3.6 with 37 balls.
pub struct Flagship {
    /// Scene and exact screw.
    pub comparison: Comparison,
    /// Turns of the nut that were followed.
    pub turns: f64,
    /// Time of a state of the exact screw, s.
    pub exact_state: f64,
}

impl Flagship {
    /// Runs both.
    pub fn new(quick: bool) -> Result<Self, Failure> {
        let (turns, states) = if quick { (0.5, 180) } else { (2.0, 720) };
        let start = Instant::now();
        let comparison = compare::<37>(&Case {
            turns,
            states,
            ..Case::LIN
        })
        .map_err(Failure::Data)?;
        Ok(Self {
            exact_state: start.elapsed().as_secs_f64() / states as f64,
            comparison,
            turns,
        })
    }
}
