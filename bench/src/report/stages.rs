//! What the report is at: a line for each stage on the error output, from the first moment on, with the time that is left.

use std::cell::Cell;
use std::time::Instant;

use epas_page::aside::say;

/// Stages whose shares of the time are known about.
pub struct Stages {
    shares: Vec<f64>,
    at: Cell<usize>,
    start: Instant,
}

impl Stages {
    /// None of them has begun. Each takes about so much of the time, in any unit.
    pub fn new(shares: Vec<f64>) -> Self {
        Self {
            shares,
            at: Cell::new(0),
            start: Instant::now(),
        }
    }

    /// The next one begins.
    pub fn next(&self, what: &str) {
        let at = self.at.replace(self.at.get() + 1);
        let left = self
            .left(at, self.start.elapsed().as_secs_f64())
            .map_or(String::new(), |left| format!(" (about {left:.0} s left)"));
        say(format_args!(
            "[{}/{}] {what}{left}",
            at + 1,
            self.shares.len()
        ));
    }

    /// Time that is left when so many stages have taken so long, s; unknown before the first one is done.
    fn left(&self, done: usize, elapsed: f64) -> Option<f64> {
        let (done, rest) = self.shares.split_at_checked(done)?;
        let done: f64 = done.iter().sum();
        (done > 0.0).then(|| elapsed * rest.iter().sum::<f64>() / done)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rest_takes_its_share() {
        let stages = Stages::new(vec![1.0, 3.0, 6.0]);
        assert_eq!(stages.left(0, 0.1), None);
        assert_eq!(stages.left(1, 2.0), Some(18.0));
        assert_eq!(stages.left(2, 8.0), Some(12.0));
        assert_eq!(stages.left(3, 20.0), Some(0.0));
        assert_eq!(stages.left(4, 20.0), None);
    }
}
