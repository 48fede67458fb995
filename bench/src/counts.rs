//! What functions and scenes cost on a Cortex-M4F, as `epas-target` counted it: stored beside the code, compared in CI with a new count.

mod budgets;
mod figures;

pub use budgets::{Budget, budgets, require};
pub use figures::{Figures, FunctionFigures, SceneFigures};

use epas_page::failure::Failure;

const STORED: &str = include_str!("../target.json");

/// The stored figures.
pub fn stored() -> Result<Figures, Failure> {
    serde_json::from_str(STORED)
        .map_err(|error| Failure::Data(format!("bench/target.json: {error}")))
}
