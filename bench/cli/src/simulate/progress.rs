//! Progress of a run over a trace, whose steps are too short to look at a clock after each.

use std::cell::Cell;

use epas_page::progress;

pub struct Progress {
    progress: progress::Progress,
    done: Cell<u64>,
}

impl Progress {
    pub fn new(length: usize) -> Self {
        Self {
            progress: progress::Progress::new("samples", length),
            done: Cell::new(0),
        }
    }

    pub fn step(&self) {
        const STRIDE: u64 = 1 << 14;
        let done = self.done.get() + 1;
        self.done.set(done);
        if done.is_multiple_of(STRIDE) {
            self.progress.steps(STRIDE);
        }
    }
}
