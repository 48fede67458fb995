//! What the page of a calibration draws, as plain data.

use super::trace::Coordinate;

/// A fitted trace, row by row. All lists are as long as `time`.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Name of the trace, for headings.
    pub name: String,
    /// What position, speed and effort are.
    pub coordinate: Coordinate,
    /// Time, s, in equal steps.
    pub time: Vec<f64>,
    /// Effort of the motor as measured and filtered, N m or N.
    pub measured: Vec<f64>,
    /// What the model says to it, N m or N.
    pub model: Vec<f64>,
    /// Position, rad or m.
    pub position: Vec<f64>,
    /// Speed, rad/s or m/s.
    pub speed: Vec<f64>,
    /// Axial load, N, where it was measured.
    pub load: Option<Vec<f64>>,
    /// Temperature, K, where it was measured.
    pub temperature: Option<Vec<f64>>,
    /// Profile likelihoods.
    pub profiles: Vec<Profile>,
    /// Correlations of the parameters' errors.
    pub correlations: Correlations,
}

/// How much worse the trace is explained with a parameter held at other values, and all others fitted again.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// Name of the parameter.
    pub name: String,
    /// Its unit; empty where it has none.
    pub unit: String,
    /// Its fitted value.
    pub best: f64,
    /// Values, and the rise of minus twice the logarithm of the likelihood there.
    pub points: Vec<(f64, f64)>,
}

/// Correlations of the parameters' errors.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Correlations {
    /// Names of the parameters.
    pub names: Vec<String>,
    /// One row for each of them, as long as the names; -1 to 1.
    pub rows: Vec<Vec<f64>>,
}

impl Picture {
    /// What the model does not explain, at every row: measured less model.
    pub fn residual(&self) -> impl Iterator<Item = f64> + Clone + '_ {
        self.measured
            .iter()
            .zip(&self.model)
            .map(|(measured, model)| measured - model)
    }

    /// Time between rows, s; none where there are fewer than two.
    pub fn step(&self) -> Option<f64> {
        let (first, last) = (self.time.first()?, self.time.last()?);
        let steps = self.time.len() - 1;
        (steps > 0).then(|| (last - first) / steps as f64)
    }
}
