//! Largest, rms and mean of errors.

/// Errors of one formula over a sweep.
#[derive(Clone, Copy, Debug, Default)]
pub struct Errors {
    count: f64,
    /// Largest magnitude.
    pub largest: f64,
    sum: f64,
    squares: f64,
}

impl Errors {
    /// Adds one error.
    pub fn add(&mut self, error: f64) {
        self.count += 1.0;
        // A NaN stays.
        if error.is_nan() || error.abs() > self.largest {
            self.largest = error.abs();
        }
        self.sum += error;
        self.squares += error * error;
    }

    /// How many were added.
    pub const fn count(&self) -> f64 {
        self.count
    }

    /// Mean: the bias.
    pub fn mean(&self) -> f64 {
        self.sum / self.count
    }

    /// Root mean square.
    pub fn rms(&self) -> f64 {
        (self.squares / self.count).sqrt()
    }
}

impl FromIterator<f64> for Errors {
    fn from_iter<T: IntoIterator<Item = f64>>(errors: T) -> Self {
        let mut total = Self::default();
        for error in errors {
            total.add(error);
        }
        total
    }
}

/// `count + 1` numbers evenly over `start` to `end`.
pub fn evenly(start: f64, end: f64, count: usize) -> impl Iterator<Item = f64> + Clone {
    (0..=count).map(move |step| start + (end - start) * step as f64 / count.max(1) as f64)
}
