//! What the page of a calibration draws, as plain data.

use nalgebra::DMatrix;

use crate::estimator::record::Smoothed;
use crate::fit::uncertainty::correlation;
use crate::trace::{Coordinate, Trace};

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
    /// Correlations of the parameters' errors.
    pub correlations: Correlations,
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
    /// A fit with a row at each of these samples of a trace: what was measured there, and what the model leaves of it; names of its parameters with
    /// the covariance of their errors.
    pub fn of(
        trace: &Trace,
        samples: &[usize],
        (measured, residual): (Vec<f64>, &[f64]),
        (names, covariance): (Vec<String>, &DMatrix<f64>),
    ) -> Self {
        let motion = Smoothed::of(trace);
        let at = |signal: &[f64]| samples.iter().map(|sample| signal[*sample]).collect();
        let time = |sample: &usize| trace.start + trace.step * *sample as f64;
        let left = measured.iter().zip(residual);
        let correlation = correlation(covariance);
        let rows = correlation.row_iter();
        Self {
            name: trace.name.clone(),
            coordinate: trace.coordinate,
            time: samples.iter().map(time).collect(),
            model: left.map(|(measured, left)| measured - left).collect(),
            measured,
            position: at(&motion.position),
            speed: at(&motion.speed),
            load: trace.load.as_deref().map(at),
            temperature: trace.temperature.as_deref().map(at),
            correlations: Correlations {
                names,
                rows: rows.map(|row| row.iter().copied().collect()).collect(),
            },
        }
    }

    /// What the model does not explain, at every row: measured less model.
    pub fn residual(&self) -> Vec<f64> {
        let rows = self.measured.iter().zip(&self.model);
        rows.map(|(measured, model)| measured - model).collect()
    }
}
