//! Both stages of a fit: rows of one direction, then rows about the turns.
//!
//! Values and intervals come from the estimator on the linearised problem: its columns are the slopes at the fit, so that the noise of the
//! motion's sensor is out of the normal equations and the jackknife runs over stretches and pieces of them. To a half-width `h` of the
//! jackknife comes what a kernel of twice the length and twice the way after a turn say otherwise:
//! `sqrt(h^2 + (2 |q(L) - q(2L)|)^2 + (2 |q(m) - q(2m)|)^2)`.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::friction::Screw;
use super::problem::{Choice, Known, Passage, ScrewProblem};
use super::quantities::{QUANTITIES, Values, assumed_deviation};
use crate::estimator::fit::{Block, Fit, fit as least_squares, solver};
use crate::estimator::kernel::Kernel;
use crate::estimator::record::{QUARTER, Record};
use crate::estimator::rows::Rows;
use crate::fit::problem::{Scale, Separable, inner};
use crate::fit::search::{Found, fit, fit_roughly, slopes};
use crate::fit::uncertainty::{Interval, QUANTILE, intervals};
use crate::trace::Trace;
use crate::trace::channels::median;
use epas_page::failure::Failure;

const LEAST_HALF: usize = 4;

/// Way after a turn over the breakaway angle: friction that was full the other way is full again after twice the angle, and under the
/// largest load later than under the reference load.
const WAY: f64 = 4.0;

/// A longer way after a turn is taken where it is longer by this.
const LONGER: f64 = 1.5;

/// Residual, in robust deviations, from which on a row is left out, and the share of the rows that may be.
const OUTLIER: f64 = 6.0;
const OUTLIERS: f64 = 0.02;

/// Factors of the first guess of the speed law from which a fit starts.
const STARTS: [f64; 3] = [1.0, 0.2, 5.0];

/// Factors of the breakaway angle's first guess from the best of which a fit over turns starts.
const BREAKAWAYS: [f64; 6] = [0.1, 0.3, 1.0, 3.0, 10.0, 30.0];

/// Error of the scene's full friction over itself: measured against the exact ball, some ten loads and coefficients of a preloaded
/// screw, rms 0.0016, largest 0.0043; and the blocks of speed and of load in which it is one.
const MODEL: f64 = 2e-3;
const SPEEDS: usize = 5;
const LOADS: usize = 4;
/// Error of the breakaway angle over itself for eight elements in the place of a curve: the reference's sixty elements on two courses were
/// found 1.0 % too small and 0.9 % too large.
const ELEMENTS: f64 = 7e-3;
/// Step of a difference over an assumed quantity, in its standard deviations.
const ASSUMED_STEP: f64 = 1.0 / 3.0;

/// Fewest turns that tell what comes before sliding.
const FEWEST_TURNS: usize = 8;

/// Most rows over everything that moves, on which models are compared.
const ROWS: usize = 12_000;

const BREAKAWAY: &str = "breakaway_angle";

pub const AT_TURNS: [&str; 2] = [BREAKAWAY, "backlash"];

pub struct Prepared<'a> {
    pub trace: &'a Trace,
    pub record: Record,
    pub screw: Screw,
}

/// A kernel's half-width, samples, and the way after a turn, rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    pub half: usize,
    pub way: f64,
}

pub struct Linearised {
    /// Slopes by the inner coordinates, nonlinear quantities first.
    pub columns: Vec<Vec<f64>>,
    pub fit: Fit,
}

pub struct Sliding {
    pub values: Values,
    pub intervals: Vec<Interval>,
    /// Covariance of their inner coordinates, without the model's errors.
    pub covariance: DMatrix<f64>,
    /// Largest over smallest singular value of the slopes, each column scaled to 1, and the direction of the smallest.
    pub condition: (f64, Vec<f64>),
    pub residual_rms: f64,
}

impl<'a> Prepared<'a> {
    pub fn new(trace: &'a Trace, left_out: &[Range<usize>], screw: Screw) -> Self {
        Self {
            trace,
            record: Record::of(trace, left_out),
            screw,
        }
    }

    /// Rows of one direction, where they are enough for what is estimated.
    fn rows(&self, window: Window, choice: &Choice) -> Option<Rows> {
        let longest = self.record.len() / 4;
        let rows = (window.half < longest)
            .then(|| Rows::of(&self.record, window.half, window.way, 0))
            .flatten()?;
        let enough = 3 * (choice.nonlinear.len() + choice.linear.len());
        (rows.len() > enough).then_some(rows)
    }

    fn sliding(&self, window: Window, at: Known<'_>) -> Option<ScrewProblem<'_>> {
        let rows = self.rows(window, at.choice)?;
        Some(ScrewProblem::new(self, rows, Passage::Sliding, at))
    }

    /// The estimator's kernel, and its way after a turn where the breakaway angle asks for no longer one; a shorter way where strokes are short.
    pub fn window(
        &self,
        (length, settling): (f64, f64),
        breakaway: f64,
        choice: &Choice,
    ) -> Result<Window, Failure> {
        let windows = [1.0, 0.5, 0.25].map(|share| Window {
            half: ((length / self.record.tick).round() as usize).max(LEAST_HALF),
            way: settling.max(share * WAY * breakaway),
        });
        let mut windows = windows.into_iter();
        let found = windows.find(|window| self.rows(*window, choice).is_some());
        found.ok_or_else(|| {
            Failure::Data(
                "the motion turns round before the balls slide: too few rows lie in one direction; measure longer strokes".into(),
            )
        })
    }

    /// The first fit: from several places of the speed law; and the samples of rows that are no part of it.
    fn first_fit(
        &self,
        window: Window,
        at: Known<'_>,
        starts: &[f64],
    ) -> Result<(Values, Vec<Range<usize>>), Failure> {
        let mut best: Option<(Found, Values, Rows)> = None;
        let speed = at.choice.nonlinear.iter();
        let speed = speed.filter(|(of, _)| of.name == "half_share_speed");
        let starts = &starts[..if speed.count() > 0 { starts.len() } else { 1 }];
        for factor in starts {
            let mut values = best.as_ref().map_or(*at.values, |(_, values, _)| *values);
            values.half_share_speed = factor * at.values.half_share_speed;
            let problem = self.sliding(window, at.with(&values));
            let problem = problem.ok_or_else(few)?;
            let found = fit_roughly(&problem)?;
            let better = |best: &(Found, Values, Rows)| found.cost() < best.0.cost();
            if best.as_ref().is_none_or(better) {
                let values = problem.values(&found.nonlinear, &found.linear);
                best = Some((found, values, problem.rows().clone()));
            }
        }
        let (found, values, rows) = best.ok_or_else(few)?;
        let sizes = found.residual.iter().map(|left| left.abs());
        let limit = OUTLIER * 1.4826 * median(sizes.collect());
        let beyond = rows.centres.iter().zip(&found.residual);
        let beyond: Vec<Range<usize>> = beyond
            .filter(|(_, left)| left.abs() > limit)
            .map(|(centre, _)| centre - window.half..centre + window.half + 1)
            .collect();
        let exceptions = (beyond.len() as f64) < OUTLIERS * rows.len() as f64;
        Ok((values, if exceptions { beyond } else { Vec::new() }))
    }

    pub fn slid(
        &self,
        window: Window,
        at: Known<'_>,
        set: &[(String, f64)],
    ) -> Result<Sliding, Failure> {
        let problem = self.sliding(window, at).ok_or_else(few)?;
        let found = fit(&problem)?;
        let values = problem.values(&found.nonlinear, &found.linear);
        let at = at.with(&values);
        if at.choice.nonlinear.is_empty() && at.choice.linear.is_empty() {
            return Ok(Sliding {
                values,
                intervals: Vec::new(),
                covariance: DMatrix::zeros(0, 0),
                condition: (1.0, Vec::new()),
                residual_rms: found.residual_rms(),
            });
        }
        let other = |window: Window| {
            let problem = self.sliding(window, at)?;
            Some(linearised(&problem, &values)?.fit.values)
        };
        let here = linearised(&problem, &values).ok_or_else(few)?;
        let longer = other(Window {
            half: 2 * window.half,
            ..window
        });
        let farther = other(Window {
            way: 2.0 * window.way,
            ..window
        });
        let model = model_errors(&problem, &here, at, set);
        let mut intervals = intervals(&problem, &found);
        let mut covariance = here.fit.covariance.clone();
        let deviation = |k: usize| here.fit.covariance[(k, k)].max(f64::MIN_POSITIVE).sqrt();
        for (k, interval) in intervals.iter_mut().enumerate() {
            let away = |other: &Option<Vec<f64>>| {
                other
                    .as_ref()
                    .map_or(0.0, |other| 2.0 * (other[k] - here.fit.values[k]))
            };
            let half = here.fit.half_widths[k];
            let half = half.hypot(away(&longer)).hypot(away(&farther));
            interval.settle(here.fit.values[k], half / QUANTILE, model[k]);
            let wider = half / QUANTILE / deviation(k);
            covariance.row_mut(k).scale_mut(wider);
            covariance.column_mut(k).scale_mut(wider);
        }
        Ok(Sliding {
            values: settled(&problem, &intervals),
            intervals,
            covariance,
            condition: condition(&here.columns),
            residual_rms: here.fit.residual_rms,
        })
    }

    /// Rows over turns alone, or over everything that moves.
    pub fn rows_over_turns(&self, window: Window, everywhere: bool) -> Rows {
        let (half, record) = (window.half, &self.record);
        let (turn, near) = self.turns(window);
        let mut rows = Rows::none(Kernel::new(half, record.tick));
        let most = if everywhere { ROWS } else { usize::MAX };
        let hop = (half / 3).max(record.len() / most).max(1);
        for centre in (half..record.len().saturating_sub(half)).step_by(hop) {
            let (first, last) = (centre - half, centre + half);
            let turns = near[last + 1] > near[first];
            if (turns || everywhere) && record.sound(first, last) {
                rows.centres.push(centre);
                rows.directions.push(0.0);
                rows.stretches.push(turn[centre]);
                rows.pieces.push(turn[centre]);
            }
        }
        rows
    }

    /// Number of the last turn at every sample; and how many samples before each are within the way of their turn.
    fn turns(&self, window: Window) -> (Vec<usize>, Vec<u32>) {
        let record = &self.record;
        let (mut turn, mut close) = (vec![0; record.len()], vec![false; record.len()]);
        let mut before: Option<(usize, f64)> = None;
        let mut number = 0;
        // Turns of a motion that may stand in between.
        for stretch in record.stretches(QUARTER * record.len()) {
            let (end, last) = before.unwrap_or((stretch.first, f64::NAN));
            let turned = last != stretch.turn;
            if turned {
                number += 1;
            }
            for sample in end..=stretch.last {
                turn[sample] = number;
                let way = (record.path[sample] - stretch.turn).abs();
                close[sample] = way < window.way || turned && sample < stretch.first;
            }
            before = Some((stretch.last + 1, stretch.turn));
        }
        let mut sum = 0;
        let near = std::iter::once(0).chain(close.into_iter().map(|close| {
            sum += u32::from(close);
            sum
        }));
        (turn, near.collect())
    }

    pub fn remembered(&self, rows: Rows, at: Known<'_>) -> ScrewProblem<'_> {
        ScrewProblem::new(self, rows, Passage::Remembered, at)
    }

    /// The way after a turn that the breakaway angle asks for, as a fit on a coarse grid finds it; its values, and the samples of rows that are no
    /// part of it. Rows just after a turn stand out where the way is too short.
    pub fn settled(
        &self,
        kernel: (f64, f64),
        start: Known<'_>,
        at_turns: &Choice,
    ) -> Result<(Window, Values, Vec<Range<usize>>), Failure> {
        let first = start.choice;
        let breakaway = start.values.breakaway_angle.max(self.trace.resolution);
        let mut window = self.window(kernel, breakaway, first)?;
        let (mut values, mut outliers) = self.first_fit(window, start, &STARTS)?;
        while !at_turns.nonlinear.is_empty()
            && let Some(rows) = self.rows_of_turns(window)
        {
            let turns = Known {
                choice: at_turns,
                ..start.with(&values)
            };
            let (problem, found) = self.turn_fit(rows, turns, fit_roughly)?;
            let told = intervals(&problem, &found);
            let told = told.iter().find(|of| of.name == BREAKAWAY && !of.at_bound);
            let longer = self.window(kernel, told.map_or(0.0, |of| of.value), first)?;
            if longer.way <= LONGER * window.way {
                break;
            }
            window = longer;
            (values, outliers) = self.first_fit(window, start.with(&values), &STARTS[..1])?;
        }
        Ok((window, values, outliers))
    }

    /// Rows over turns, where these are enough to tell what comes before sliding.
    fn rows_of_turns(&self, window: Window) -> Option<Rows> {
        let rows = self.rows_over_turns(window, false);
        let mut turns = rows.stretches.clone();
        turns.dedup();
        (turns.len() >= FEWEST_TURNS).then_some(rows)
    }

    /// A fit over turns, from the breakaway angle near the first guess that leaves least.
    fn turn_fit(
        &self,
        rows: Rows,
        at: Known<'_>,
        fit: fn(&dyn Separable) -> Result<Found, Failure>,
    ) -> Result<(ScrewProblem<'_>, Found), Failure> {
        let problem = self.remembered(rows.clone(), at);
        let tried = |factor: f64| {
            let mut values = *at.values;
            values.breakaway_angle *= factor;
            let values = problem.values(&problem.coordinates(&values).0, &[]);
            let rows = problem.model(&values).into_iter().zip(problem.target());
            let cost: f64 = rows.map(|(model, target)| (model - target).powi(2)).sum();
            (cost, values)
        };
        let starts = BREAKAWAYS.into_iter().map(tried);
        let best = starts.min_by(|one, other| one.0.total_cmp(&other.0));
        let start = best.map_or(*at.values, |(_, start)| start);
        let problem = self.remembered(rows, at.with(&start));
        let found = fit(&problem)?;
        Ok((problem, found))
    }

    /// The second stage: what comes before sliding, its intervals, and how they follow the first stage. `None` where there are too few turns.
    pub fn turned(
        &self,
        window: Window,
        sliding: &Sliding,
        at_turns: &Choice,
        at: Known<'_>,
    ) -> Result<Option<Vec<Interval>>, Failure> {
        let over = |half: usize| self.rows_of_turns(Window { half, ..window });
        let Some(rows) = over(window.half) else {
            return Ok(None);
        };
        let turns = Known {
            choice: at_turns,
            ..at
        };
        let (problem, found) = self.turn_fit(rows.clone(), turns, fit)?;
        let values = problem.values(&found.nonlinear, &found.linear);
        let Some(here) = linearised(&problem, &values) else {
            return Ok(None);
        };
        let longer = over(2 * window.half).and_then(|rows| {
            let problem = self.remembered(rows, turns.with(&values));
            Some(linearised(&problem, &values)?.fit.values)
        });
        // What an error of the first stage makes of the second.
        let whole = self.remembered(rows, at.with(&values));
        let (nonlinear, linear) = whole.coordinates(&values);
        let others = slopes(&whole, &nonlinear, &linear);
        let pull = solver(&here.columns).filter(|_| !others.is_empty());
        let pull = pull.map(|solver| {
            let moved: Vec<DVector<f64>> = others.iter().map(|rows| solver(rows)).collect();
            DMatrix::from_columns(&moved)
        });
        let followed = pull.map(|pull| &pull * &sliding.covariance * pull.transpose());
        let mut intervals = intervals(&problem, &found);
        for (k, interval) in intervals.iter_mut().enumerate() {
            let away = longer
                .as_ref()
                .map_or(0.0, |other| 2.0 * (other[k] - here.fit.values[k]));
            let own = here.fit.half_widths[k].hypot(away) / QUANTILE;
            let followed = followed
                .as_ref()
                .map_or(0.0, |all| all[(k, k)].max(0.0).sqrt());
            let model = if interval.scale == Scale::Logarithmic {
                ELEMENTS
            } else {
                0.0
            };
            interval.settle(here.fit.values[k], own.hypot(followed), model);
        }
        Ok(Some(intervals))
    }
}

pub fn few() -> Failure {
    Failure::Data("too few rows of one direction for what is estimated: measure longer, or with longer strokes".into())
}

/// A problem linearised at values. `None` where a slope is NaN or infinite.
pub fn linearised(problem: &ScrewProblem<'_>, values: &Values) -> Option<Linearised> {
    let (nonlinear, linear) = problem.coordinates(values);
    let columns = slopes(problem, &nonlinear, &linear);
    if columns.is_empty() || columns.iter().flatten().any(|slope| !slope.is_finite()) {
        return None;
    }
    let scales = problem.nonlinear().iter().zip(&nonlinear);
    let places = scales
        .map(|(of, value)| inner(of.scale, *value))
        .chain(linear);
    let mut target: Vec<f64> = problem.target().to_vec();
    for (target, model) in target.iter_mut().zip(problem.model(values)) {
        *target -= model;
    }
    for (column, place) in columns.iter().zip(places) {
        for (target, slope) in target.iter_mut().zip(column) {
            *target += place * slope;
        }
    }
    let rows = problem.rows();
    let block = Block {
        columns: columns.clone(),
        target,
        noise: problem.noise(),
        stretches: rows.stretches.clone(),
        pieces: rows.pieces.clone(),
    };
    let fit = least_squares(&[block], &|coefficients| coefficients.to_vec());
    Some(Linearised { columns, fit })
}

/// Condition of the slopes, each scaled to 1, and the direction that they see least.
fn condition(columns: &[Vec<f64>]) -> (f64, Vec<f64>) {
    let columns: Vec<DVector<f64>> = columns
        .iter()
        .map(|column| {
            let column = DVector::from_column_slice(column);
            let size = column.norm().max(f64::MIN_POSITIVE);
            column / size
        })
        .collect();
    if columns.is_empty() {
        return (1.0, Vec::new());
    }
    let scaled = DMatrix::from_columns(&columns);
    let parts = scaled.tr_mul(&scaled).symmetric_eigen();
    let (place, least) = parts.eigenvalues.argmin();
    let condition = (parts.eigenvalues.max() / least.max(f64::EPSILON)).sqrt();
    (
        condition,
        parts.eigenvectors.column(place).iter().copied().collect(),
    )
}

/// Standard deviations of the parameters by the model's own errors: those of the friction in blocks of speed and load, and those of what is
/// assumed and neither estimated nor set.
fn model_errors(
    problem: &ScrewProblem<'_>,
    here: &Linearised,
    at: Known<'_>,
    set: &[(String, f64)],
) -> Vec<f64> {
    let values = at.values;
    let count = here.columns.len();
    let Some(solver) = solver(&here.columns) else {
        return vec![0.0; count];
    };
    let mut variance = DVector::zeros(count);
    let mut add = |rows: &[f64]| variance += solver(rows).map(|value| value * value);
    let friction = problem.friction(values);
    for block in problem.blocks(SPEEDS, LOADS) {
        let mut off = vec![0.0; friction.len()];
        for row in block {
            off[row] = MODEL * friction[row];
        }
        add(&off);
    }
    let known = |name: &str| {
        at.choice.nonlinear.iter().any(|(of, _)| of.name == name)
            || set.iter().any(|(set, _)| set == name)
    };
    for of in QUANTITIES.iter().filter(|of| !known(of.name)) {
        let Some(deviation) = assumed_deviation(of.name) else {
            continue;
        };
        let beside = |side: f64| {
            let value = of.value(values) + side * ASSUMED_STEP * deviation;
            problem.model(&of.with(value, values))
        };
        let rows = beside(1.0).into_iter().zip(beside(-1.0));
        let off: Vec<f64> = rows
            .map(|(above, below)| (above - below) / (2.0 * ASSUMED_STEP))
            .collect();
        if off.iter().all(|row| row.is_finite()) {
            add(&off);
        }
    }
    variance.iter().map(|variance| variance.sqrt()).collect()
}

fn settled(problem: &ScrewProblem<'_>, intervals: &[Interval]) -> Values {
    let values: Vec<f64> = intervals.iter().map(|interval| interval.value).collect();
    let (nonlinear, linear) = values.split_at(problem.nonlinear().len());
    problem.values(nonlinear, linear)
}
