//! What every section works with.

use epas_bench::counts::Figures;
use epas_bench::timing::Competition;
use epas_page::failure::Failure;

/// What every section works with.
pub struct Context {
    /// Whether coarser sweeps are enough.
    pub quick: bool,
    /// Times on this machine.
    pub competition: Vec<Competition>,
    /// Stored counts on the target.
    pub counts: Figures,
}

impl Context {
    /// The times of a function by its key.
    pub fn times(&self, key: &str) -> Result<&Competition, Failure> {
        self.competition
            .iter()
            .find(|entry| entry.key == key)
            .ok_or_else(|| Failure::Data(format!("nothing was timed as {key}")))
    }
}
