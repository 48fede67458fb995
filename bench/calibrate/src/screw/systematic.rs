//! What an interval must hold beside the residual: errors of the sensors in what the model is told, and the model's own.
//!
//! Steps of the encoder and noise of the load move the friction of the model, not the measured torque. They are errors of regressors: they
//! shift parameters, and correlate over long times where the nut hardly moves, so that the residual alone does not show them. And a turn
//! that is smoothed is a turn that is late. The trace's own motion and load, less smooth than the fit's, are counted, disturbed and smoothed
//! again, a few times; what the model then says else goes through the fit's own slopes. Its mean is taken off the parameters, its spread
//! widens their intervals. Of a sensor that is too coarse for the breakaway the mean is as uncertain as it is large: the motion that is
//! counted again was counted before.
//!
//! The scene's friction is that of the exact ball within some parts in a thousand, differently at every speed and load. Blocks of
//! speed and load, each off by itself, widen the intervals too. These errors are the same in every trace of a screw: a mean over many
//! traces does not take them out, and so they stand apart from the covariance (`Interval::model_error`). So is what the fit assumes of a
//! lubricant that nobody has told: the standard deviation of the assumption goes through the fit's slopes as well.

use nalgebra::{DMatrix, DVector};
use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;

use super::problem::ScrewProblem;
use super::quantities::{NONLINEAR, Nonlinear, Values, assumed_deviation};
use crate::fit::problem::Scale;
use crate::fit::separable::{Fit, inner_slope};
use crate::fit::uncertainty::{Uncertainty, correlation, deviations};
use crate::signals::filter::ZeroPhase;
use crate::signals::{Motion, SmoothingSettings};
use crate::trace::Trace;
use epas_page::failure::Failure;

/// Times that sensors are imitated.
const TIMES: usize = 8;

/// Cut-off of the motion that is imitated over the cut-off of the fit's. Its turns are nearly as steep as they were, and so it shows what the
/// fit's smoothing does to them: at 1 the inertia of a rig with steep reversals stays 1.7 % too large, at 1.5 it is 0.9 %. At 2 and 3 the
/// encoder's noise turns the friction round more often than the nut does: the half-share speed of a vehicle's course falls from 3 to 4 %
/// off.
const SHARPER: f64 = 1.5;

/// Error of the scene's full friction over itself: measured against the exact ball, some ten loads and coefficients of a preloaded
/// screw, rms 0.0016, largest 0.0043.
const MODEL: f64 = 2e-3;

/// Error of the breakaway angle over itself for eight elements in the place of a curve: the reference's sixty elements on two courses were
/// found 1.0 % too small and 0.9 % too large.
const ELEMENTS: f64 = 7e-3;

/// Step of a difference over an assumed quantity, in its standard deviations.
const STEP: f64 = 1.0 / 3.0;

/// Parts of the speeds, and of the loads, in which that error is one.
const SPEEDS: usize = 5;
const LOADS: usize = 4;

/// Errors of a fit's parameters that its residual does not show; nonlinear before linear, each in its own unit.
#[derive(Clone, Debug, PartialEq)]
struct Systematic {
    /// What the sensors make of the parameters on average.
    shift: DVector<f64>,
    /// Covariance of what they make of them in one trace.
    sensors: DMatrix<f64>,
    /// Standard deviation by the model's errors, the same in every trace.
    model: DVector<f64>,
}

/// What a change of the model's rows makes of the parameters.
struct Slopes {
    weighted: DMatrix<f64>,
    inverse: DMatrix<f64>,
    scales: Vec<f64>,
    weights: Vec<f64>,
}

impl Slopes {
    fn of(fit: &Fit) -> Option<Self> {
        let mut weighted = fit.jacobian.clone();
        for (mut row, weight) in weighted.row_iter_mut().zip(&fit.weights) {
            row *= weight.sqrt();
        }
        let scales: Vec<f64> = weighted
            .column_iter()
            .map(|column| column.norm().max(f64::MIN_POSITIVE))
            .collect();
        for (mut column, scale) in weighted.column_iter_mut().zip(&scales) {
            column /= *scale;
        }
        let inverse = (weighted.tr_mul(&weighted)).try_inverse()?;
        Some(Self {
            weighted,
            inverse,
            scales,
            weights: fit.weights.clone(),
        })
    }

    /// Parameters that fit to these rows.
    fn fitted(&self, rows: &[f64]) -> DVector<f64> {
        let rows = rows.iter().zip(&self.weights);
        let rows: Vec<f64> = rows.map(|(row, weight)| row * weight.sqrt()).collect();
        let mut found = &self.inverse * self.weighted.tr_mul(&DVector::from_vec(rows));
        for (value, scale) in found.iter_mut().zip(&self.scales) {
            *value /= scale;
        }
        found
    }
}

/// How sure a fit is with what its residual does not show: the sensors' mean shift is off its values, their spread is in its covariance,
/// and the model's own errors are in its intervals.
///
/// # Errors
/// Smoothing that the trace does not allow.
pub fn widened(
    problem: &ScrewProblem<'_>,
    fit: &Fit,
    values: &Values,
    settings: &SmoothingSettings,
    set: &[(String, f64)],
    coarse: bool,
    mut sure: Uncertainty,
) -> Result<Uncertainty, Failure> {
    let known = |name: &str| {
        let estimated = sure.intervals.iter().any(|interval| interval.name == name);
        estimated || set.iter().any(|(set, _)| set == name)
    };
    let assumed = NONLINEAR.iter().filter(|of| !known(of.name));
    let assumed: Vec<_> = assumed
        .filter_map(|of| Some((of, assumed_deviation(of.name)?)))
        .collect();
    let Some(systematic) = systematic(problem, fit, values, (settings, coarse), &assumed)? else {
        return Ok(sure);
    };
    for (place, interval) in sure.intervals.iter_mut().enumerate() {
        let shifted = interval.value - systematic.shift[place];
        let shifted = shifted.clamp(interval.bounds[0], interval.bounds[1]);
        if interval.scale == Scale::Linear || shifted > 0.0 {
            interval.value = shifted;
        }
    }
    let each = sure.intervals.iter();
    let slopes: Vec<f64> = each
        .map(|interval| inner_slope(interval.scale, interval.value))
        .collect();
    let scale = DMatrix::from_diagonal(&DVector::from_vec(slopes));
    sure.covariance += &scale * systematic.sensors * &scale;
    sure.correlation = correlation(&sure.covariance);
    let own = deviations(&sure.covariance);
    for (place, interval) in sure.intervals.iter_mut().enumerate() {
        interval.model_error = systematic.model[place] * scale[(place, place)];
        if interval.name == "breakaway_angle" {
            // Its inner coordinate is the logarithm.
            interval.model_error = interval.model_error.hypot(ELEMENTS);
        }
        interval.spread(own[place].hypot(interval.model_error), sure.quantile);
    }
    Ok(sure)
}

/// Errors of a fit of a problem at its values. `None` where its slopes cannot be inverted.
fn systematic(
    problem: &ScrewProblem<'_>,
    fit: &Fit,
    values: &Values,
    (settings, coarse): (&SmoothingSettings, bool),
    assumed: &[(&Nonlinear, f64)],
) -> Result<Option<Systematic>, Failure> {
    let Some(slopes) = Slopes::of(fit) else {
        return Ok(None);
    };
    let (shift, mut sensors) = sensors(problem, &slopes, values, settings)?;
    if coarse {
        sensors += &shift * shift.transpose();
    }
    let mut variance = DVector::zeros(fit.jacobian.ncols());
    for rows in friction_by_blocks(problem, values, SPEEDS, LOADS) {
        let off: Vec<f64> = rows.iter().map(|row| MODEL * row).collect();
        variance += slopes.fitted(&off).map(|value| value * value);
    }
    for (quantity, deviation) in assumed {
        let off = rows_of_assumption(problem, values, quantity, *deviation);
        if off.iter().all(|row| row.is_finite()) {
            variance += slopes.fitted(&off).map(|value| value * value);
        }
    }
    Ok(Some(Systematic {
        shift,
        sensors,
        model: variance.map(f64::sqrt),
    }))
}

/// Rows by which the model is off where a quantity is off what is assumed of it by its standard deviation.
fn rows_of_assumption(
    problem: &ScrewProblem<'_>,
    values: &Values,
    quantity: &Nonlinear,
    deviation: f64,
) -> Vec<f64> {
    let at = |side: f64| {
        let mut values = *values;
        *(quantity.of)(&mut values) += side * STEP * deviation;
        problem.model(&values)
    };
    let rows = at(1.0).into_iter().zip(at(-1.0));
    rows.map(|(above, below)| (above - below) / (2.0 * STEP))
        .collect()
}

/// Shift by the sensors and its covariance, from imitations; none where an imitation is not finite.
fn sensors(
    problem: &ScrewProblem<'_>,
    slopes: &Slopes,
    values: &Values,
    settings: &SmoothingSettings,
) -> Result<(DVector<f64>, DMatrix<f64>), Failure> {
    let (trace, motion) = problem.measured();
    let smoothing = settings.filter(trace.step)?;
    let sharper = ZeroPhase::new(trace.step, SHARPER * smoothing.cutoff(), smoothing.order());
    // Where the sampling does not allow it, as smooth as the fit's.
    let sharper = sharper.unwrap_or_else(|_| smoothing.clone());
    let motion = &motion.again(trace, &sharper);
    let still = problem.model_of(trace, motion, &smoothing, values);
    let count = slopes.scales.len();
    let mut random = Pcg64Mcg::seed_from_u64(1);
    let noise = load_noise(trace, &smoothing);
    let mut all = Vec::new();
    for _ in 0..TIMES {
        let seen = imitated(trace, motion, noise, &mut random);
        let seen_motion = motion.again(&seen, &smoothing);
        let told = problem.model_of(&seen, &seen_motion, &smoothing, values);
        let change: Vec<f64> = still.iter().zip(&told).map(|(a, b)| a - b).collect();
        if change.iter().any(|row| !row.is_finite()) {
            return Ok((DVector::zeros(count), DMatrix::zeros(count, count)));
        }
        all.push(slopes.fitted(&change));
    }
    let times = TIMES as f64;
    let shift = all.iter().sum::<DVector<f64>>() / times;
    let squares = all.iter().map(|one| {
        let off = one - &shift;
        &off * off.transpose()
    });
    // The mean is known to a part of the spread itself.
    let covariance = squares.sum::<DMatrix<f64>>() * ((1.0 + 1.0 / times) / (times - 1.0));
    Ok((shift, covariance))
}

/// Standard deviation of what the filter takes from the load, N.
fn load_noise(trace: &Trace, smoothing: &ZeroPhase) -> f64 {
    let Some(load) = &trace.load else { return 0.0 };
    let smooth = smoothing.apply(load);
    let mut sizes: Vec<f64> = load
        .iter()
        .zip(&smooth)
        .map(|(raw, smooth)| (raw - smooth).abs())
        .collect();
    sizes.sort_by(f64::total_cmp);
    // By the median, which jolts do not move.
    1.4826 * sizes.get(sizes.len() / 2).copied().unwrap_or(0.0)
}

/// A motion and the load of a trace, counted and disturbed again.
fn imitated(trace: &Trace, motion: &Motion, noise: f64, random: &mut Pcg64Mcg) -> Trace {
    let step = trace.resolution;
    let phase: f64 = random.random();
    let counted = |place: &f64| {
        if step > 0.0 {
            ((place / step + phase).round() - phase) * step
        } else {
            *place
        }
    };
    let mut normal = || -> f64 { StandardNormal.sample(random) };
    Trace {
        position: motion.position.iter().map(counted).collect(),
        load: trace
            .load
            .as_ref()
            .map(|load| load.iter().map(|load| load + noise * normal()).collect()),
        ..trace.clone()
    }
}

/// Rows of the friction in blocks of about as many samples each: by the size of the speed, and in each of these by the size of the load.
fn friction_by_blocks(
    problem: &ScrewProblem<'_>,
    values: &Values,
    speeds: usize,
    loads: usize,
) -> Vec<Vec<f64>> {
    let friction = problem.friction(values);
    let (trace, motion) = problem.measured();
    let part = |sizes: Vec<f64>, count: usize| -> Vec<usize> {
        let mut order: Vec<usize> = (0..sizes.len()).collect();
        order.sort_by(|one, other| sizes[*one].total_cmp(&sizes[*other]));
        let mut parts = vec![0; sizes.len()];
        for (rank, sample) in order.iter().enumerate() {
            parts[*sample] = rank * count / sizes.len();
        }
        parts
    };
    let speed = part(
        motion.speed.iter().map(|speed| speed.abs()).collect(),
        speeds,
    );
    let load = match &trace.load {
        Some(load) => part(load.iter().map(|load| load.abs()).collect(), loads),
        None => vec![0; friction.len()],
    };
    let block = |index: usize| {
        let moments = friction.iter().zip(speed.iter().zip(&load));
        let masked = moments.map(|(friction, (speed, load))| {
            if speed * loads + load == index {
                *friction
            } else {
                0.0
            }
        });
        problem.rows().of(&masked.collect::<Vec<f64>>())
    };
    (0..speeds * loads).map(block).collect()
}
