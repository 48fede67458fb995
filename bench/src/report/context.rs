//! What every section of the report works with.

use super::accuracy::Accuracy;
use super::flagship::Flagship;
use crate::counts::Figures;
use crate::timing::Competition;

/// What every section works with.
pub struct Context {
    /// Whether coarser sweeps are enough.
    pub quick: bool,
    /// Times on this machine.
    pub competition: Vec<Competition>,
    /// Stored counts on the target.
    pub counts: Figures,
    /// The ball screw without cage beside the exact one.
    pub flagship: Flagship,
    /// Errors that README and the page of accuracy print: of this run, or stored ones of a quick look.
    pub accuracy: Vec<Accuracy>,
}
