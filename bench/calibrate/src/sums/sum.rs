//! A sum in two numbers.

use serde::{Deserialize, Serialize};

/// A sum and what its roundings have lost (Knuth's two-sum).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sum {
    value: f64,
    lost: f64,
}

impl Sum {
    /// Adds a number.
    pub fn add(&mut self, term: f64) {
        self.merge(Self {
            value: term,
            lost: 0.0,
        });
    }

    /// Adds another sum.
    pub fn merge(&mut self, other: Self) {
        let total = self.value + other.value;
        let part = total - self.value;
        let error = (self.value - (total - part)) + (other.value - part);
        let lost = error + (self.lost + other.lost);
        self.value = total + lost;
        self.lost = (total - self.value) + lost;
    }

    /// The sum as one number.
    pub fn total(&self) -> f64 {
        self.value
    }
}
