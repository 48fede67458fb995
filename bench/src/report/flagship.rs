//! The ball screw without cage of the dissertation, beside the exact one.

use std::time::Instant;

use crate::exact_ring::{Case, Comparison, exact, follow};

/// The screw of Table 3.6 with 37 balls.
pub struct Flagship {
    /// Scene and exact screw; nothing compared where the screw is not folded.
    pub comparison: Comparison,
    /// Why it is not folded.
    pub refused: Option<String>,
    /// Turns of the nut that were followed.
    pub turns: f64,
    /// Time of a state of the exact screw, s.
    pub exact_state: f64,
}

impl Flagship {
    /// Folds the screw and runs both.
    pub fn new(quick: bool) -> Self {
        let (turns, states) = if quick { (0.5, 180) } else { (2.0, 720) };
        let case = Case {
            turns,
            states,
            ..Case::LIN
        };
        let mut exact_state = f64::NAN;
        let followed = case.law().and_then(|_| {
            let start = Instant::now();
            let states = exact::<37>(&case)?;
            exact_state = start.elapsed().as_secs_f64() / states.len() as f64;
            follow::<37>(&case, &states)
        });
        let (comparison, refused) = match followed {
            Ok(comparison) => (comparison, None),
            Err(reason) => (Comparison::default(), Some(reason)),
        };
        Self {
            comparison,
            refused,
            turns,
            exact_state,
        }
    }
}
