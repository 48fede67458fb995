//! What the report is at: a line for each stage on the error output, from the first moment on.

use std::cell::Cell;

use epas_page::aside::say;

/// Stages of some number.
pub struct Stages {
    count: usize,
    at: Cell<usize>,
}

impl Stages {
    /// None of `count` has begun.
    pub const fn new(count: usize) -> Self {
        Self {
            count,
            at: Cell::new(0),
        }
    }

    /// The next one begins.
    pub fn next(&self, what: &str) {
        self.at.set(self.at.get() + 1);
        say(format_args!("[{}/{}] {what}", self.at.get(), self.count));
    }
}
