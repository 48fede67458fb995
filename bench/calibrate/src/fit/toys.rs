//! Problems whose answer is known, for the tests of the fit.

use rand::{RngExt, SeedableRng};
use rand_distr::StandardNormal;
use rand_pcg::Pcg64;

use crate::fit::problem::{Evaluation, Model, Parameter};

pub fn positive(name: &'static str, start: f64, low: f64, high: f64) -> Parameter {
    Parameter::positive(name, "1", start, [low, high])
}

pub fn free(name: &'static str) -> Parameter {
    Parameter::linear(name, "1", f64::NEG_INFINITY)
}

/// Normal noise of deviation 1 with correlation `memory` between neighbours.
pub fn noise(seed: u64, rows: usize, memory: f64) -> Vec<f64> {
    let mut source = Pcg64::seed_from_u64(seed);
    let mut state: f64 = source.sample(StandardNormal);
    let fresh = (1.0 - memory * memory).sqrt();
    (0..rows)
        .map(|_| {
            let now = state;
            let next: f64 = source.sample(StandardNormal);
            state = memory * state + fresh * next;
            now
        })
        .collect()
}

/// Speeds, 1/s, of a Stribeck curve's test: two sines.
pub fn speeds(rows: usize) -> Vec<f64> {
    (0..rows)
        .map(|row| {
            let t = row as f64 * 0.01;
            4.0 * (0.9 * t).sin() + 1.5 * (2.3 * t + 0.4).sin()
        })
        .collect()
}

/// Stribeck's curve `sign(v) (c + (s - c) exp(-|v| / v_s)) + b v + offset` with smooth sign; nonlinear: s (fixed part: no linear
/// parameter), v_s; linear: c, b, offset.
pub fn stribeck(speeds: &[f64], q: &[f64]) -> Evaluation {
    let (peak, fall) = (q[0], q[1]);
    let sign = |v: &f64| (v / 0.05).tanh();
    let part = |v: &f64| (-v.abs() / fall).exp();
    Evaluation {
        fixed: speeds.iter().map(|v| peak * sign(v) * part(v)).collect(),
        columns: vec![
            speeds.iter().map(|v| sign(v) * (1.0 - part(v))).collect(),
            speeds.to_vec(),
            vec![1.0; speeds.len()],
        ],
    }
}

pub const STRIBECK: ([f64; 2], [f64; 3]) = ([3.0, 0.8], [2.0, 0.15, -0.1]);

pub fn stribeck_toy(noise: &[f64], size: f64) -> Model<'static> {
    let speeds = speeds(noise.len());
    let clean = stribeck(&speeds, &STRIBECK.0).sum(&STRIBECK.1);
    Model {
        nonlinear: vec![
            positive("static", 1.0, 0.1, 20.0),
            positive("stribeck_speed", 2.0, 0.02, 20.0),
        ],
        linear: vec![free("coulomb"), free("viscous"), free("offset")],
        target: clean
            .iter()
            .zip(noise)
            .map(|(value, noise)| value + size * noise)
            .collect(),
        evaluate: Box::new(move |q: &[f64]| stribeck(&speeds, q)),
    }
}
