//! A progress bar that appears only when the work takes longer than a second.

use std::cell::Cell;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// How far the work has come.
pub struct Progress {
    bar: ProgressBar,
    start: Instant,
    done: Cell<u64>,
}

impl Progress {
    /// Work of so many steps, none of them done.
    pub fn new(length: usize) -> Self {
        let bar = ProgressBar::with_draw_target(Some(length as u64), ProgressDrawTarget::hidden());
        if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent} % {eta} left") {
            bar.set_style(style);
        }
        Self {
            bar,
            start: Instant::now(),
            done: Cell::new(0),
        }
    }

    /// One step more is done.
    pub fn step(&self) {
        const STRIDE: u64 = 1 << 14;
        let done = self.done.get() + 1;
        self.done.set(done);
        if !done.is_multiple_of(STRIDE) {
            return;
        }
        if self.bar.is_hidden() && self.start.elapsed() > Duration::from_secs(1) {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        self.bar.set_position(done);
    }

    /// Takes the bar off the screen.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }
}
