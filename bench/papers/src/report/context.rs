//! What every section works with.

use epas_bench::counts::Figures;
use epas_bench::timing::Competition;

/// What every section works with.
pub struct Context {
    /// Whether coarser sweeps are enough.
    pub quick: bool,
    /// Times on this machine.
    pub competition: Vec<Competition>,
    /// Stored counts on the target.
    pub counts: Figures,
}
