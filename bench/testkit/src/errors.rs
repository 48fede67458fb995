//! Errors of a sweep: the largest with its case, root mean square, and mean.

use std::fmt::{Display, Formatter, Result};

use epas_reference::promises::Promise;

use super::measured;

/// Errors, added one by one.
#[derive(Clone, Debug, Default)]
pub struct Errors {
    /// What errs.
    pub name: String,
    /// How many were added.
    pub count: f64,
    /// The largest size.
    pub largest: f64,
    /// The case of the largest.
    pub worst: String,
    sum: f64,
    squares: f64,
}

impl Errors {
    /// No errors of this name so far.
    pub fn of(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            ..Self::default()
        }
    }

    /// Adds an error.
    pub fn add(&mut self, error: f64) {
        self.add_at(error, "");
    }

    /// The case is written down only where the error is the largest.
    pub fn add_at(&mut self, error: f64, case: impl Display) {
        self.add_case(error, || case.to_string());
    }

    /// The same, of a case that is made where it is needed.
    ///
    /// # Panics
    /// Where the error is not a finite number.
    pub fn add_case(&mut self, error: f64, case: impl FnOnce() -> String) {
        assert!(
            error.is_finite(),
            "{}: an error of {error} at {}",
            self.name,
            case()
        );
        if error.abs() > self.largest {
            self.largest = error.abs();
            self.worst = case();
        }
        self.squares += error * error;
        self.sum += error;
        self.count += 1.0;
    }

    /// Adds largest, root mean square and mean error of so many cases.
    pub fn add_figures(&mut self, figures: [f64; 3], count: f64, worst: impl FnOnce() -> String) {
        let [largest, rms, mean] = figures;
        if largest > self.largest {
            self.largest = largest;
            self.worst = worst();
        }
        self.squares += rms * rms * count;
        self.sum += mean * count;
        self.count += count;
    }

    /// Adds what another thread found.
    pub fn join(&mut self, other: &Self) {
        if other.largest > self.largest {
            self.largest = other.largest;
            self.worst.clone_from(&other.worst);
        }
        self.squares += other.squares;
        self.sum += other.sum;
        self.count += other.count;
    }

    /// Root mean square of the errors.
    pub fn rms(&self) -> f64 {
        (self.squares / self.count).sqrt()
    }

    /// Mean of the errors.
    pub fn mean(&self) -> f64 {
        self.sum / self.count
    }

    /// Prints the errors; asserts that largest, rms and mean are at most these.
    pub fn assert(&self, largest: f64, rms: f64, mean: f64) {
        println!("{self}");
        assert!(
            self.largest <= largest && self.rms() <= rms && self.mean().abs() <= mean,
            "{self}; accepted are {largest:.1e}, {rms:.1e}, {mean:.1e}"
        );
    }

    /// Within what the table of promises says.
    pub fn assert_promised(&self, promise: &Promise) {
        print!("{}: ", promise.function);
        self.assert(promise.largest, promise.rms, promise.mean);
    }

    /// Within the row of this name in the table of measured bounds.
    pub fn assert_measured(&self) {
        let [largest, rms, mean] = measured::of(&self.name).accepted();
        self.assert(largest, rms, mean);
    }
}

impl Display for Errors {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> Result {
        write!(
            formatter,
            "{}{}largest {:.1e}, rms {:.1e}, mean {:+.1e} of {}",
            self.name,
            if self.name.is_empty() { "" } else { ": " },
            self.largest,
            self.rms(),
            self.mean(),
            self.count
        )?;
        if self.worst.is_empty() {
            return Ok(());
        }
        write!(formatter, "; worst {}", self.worst)
    }
}
