//! A screw on a rig as a separable least-squares problem over rows of the estimator.
//!
//! ```text
//! tau = inertia dw/dt + drag w + churning eta(T) w + rolling_drag D(w, F, T) + offset + gain lead/(2 pi) F
//!       + friction(angle, w, F, T; q) + (S/S_ref) sum_k (c_k cos k theta + s_k sin k theta)
//! ```
//!
//! Every term is summed by one kernel; derivatives of the motion go to the kernel. `S` is the sum of both flanks' loads, `D` the lubricant
//! drag of the crate's default. In rows of one direction friction is that of gross sliding of the exact ball; elsewhere the memory of the
//! crate is stepped along the trace.

use std::f64::consts::TAU;
use std::sync::Arc;

use epas_design::CagedDesign;
use epas_friction::defaults;
use epas_friction::law::coefficient::{CoefficientLaw, CoefficientParameters, RollingDrag};
use nalgebra::DMatrix;

use super::exact::Grid;
use super::friction::Course;
use super::quantities::{Factor, Kind, QUANTITIES, Quantity, Values};
use super::stages::{AT_TURNS, Prepared};
use crate::estimator::kernel::Kernel;
use crate::estimator::record::QUARTER;
use crate::estimator::rows::Rows;
use crate::fit::problem::{Evaluation, Parameter, Separable};
use epas_page::failure::Failure;

#[derive(Clone, Debug)]
pub struct Choice {
    pub nonlinear: Vec<(Parameter, &'static Quantity)>,
    pub linear: Vec<&'static Quantity>,
}

impl Choice {
    #[must_use]
    pub fn without(&self, name: &str) -> Self {
        let mut choice = self.clone();
        choice.nonlinear.retain(|(of, _)| of.name != name);
        choice.linear.retain(|of| of.name != name);
        choice
    }

    /// What rows of one direction tell, and what rows about the turns do.
    pub fn at_turns(mut self) -> [Self; 2] {
        let at_turn = |(of, _): &(Parameter, _)| AT_TURNS.contains(&of.name);
        let (turns, first) = self.nonlinear.into_iter().partition(at_turn);
        self.nonlinear = first;
        let turns = Self {
            nonlinear: turns,
            linear: Vec::new(),
        };
        [self, turns]
    }

    #[must_use]
    pub fn from(&self, values: &Values) -> Self {
        let mut choice = self.clone();
        for (parameter, of) in &mut choice.nonlinear {
            parameter.start = of.value(values).max(parameter.low).min(parameter.high);
        }
        choice
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Passage {
    /// It does not: every row has one direction, in which the balls slide.
    Sliding,
    Remembered,
}

/// Signals of a trace at every sample, smoothed as a kernel's rows need them.
struct Samples {
    position: Vec<f64>,
    /// Without angles where nothing is remembered.
    course: Course,
    /// 1 or -1 within the window of a row, else 0.
    direction: Vec<f64>,
    waves: [Vec<f64>; 4],
}

/// A linear quantity that is estimated or not zero.
struct Term {
    of: &'static Quantity,
    factor: Factor,
    estimated: bool,
    /// What it multiplies in every row; empty where that follows what is estimated.
    still: Vec<f64>,
}

#[derive(Clone, Copy)]
pub struct Known<'a> {
    pub values: &'a Values,
    pub choice: &'a Choice,
    pub grid: &'a Arc<Grid>,
}

impl<'a> Known<'a> {
    pub fn of(values: &'a Values, choice: &'a Choice, grid: &'a Arc<Grid>) -> Self {
        Self {
            values,
            choice,
            grid,
        }
    }

    pub fn with(self, values: &'a Values) -> Self {
        Self { values, ..self }
    }
}

pub struct ScrewProblem<'a> {
    prepared: &'a Prepared<'a>,
    rows: Rows,
    samples: Samples,
    passage: Passage,
    grid: Arc<Grid>,
    values: Values,
    nonlinear: Vec<&'static Quantity>,
    parameters: Vec<Parameter>,
    terms: Vec<Term>,
    linear: Vec<Parameter>,
    target: Vec<f64>,
}

impl<'a> ScrewProblem<'a> {
    pub fn new(prepared: &'a Prepared<'_>, rows: Rows, passage: Passage, at: Known<'_>) -> Self {
        let samples = Samples::of(prepared, &rows, passage);
        let choice = at.choice.from(at.values);
        let (parameters, nonlinear) = choice.nonlinear.into_iter().unzip();
        let mut problem = Self {
            prepared,
            samples,
            passage,
            grid: Arc::clone(at.grid),
            values: *at.values,
            nonlinear,
            parameters,
            terms: Vec::new(),
            linear: Vec::new(),
            target: rows.sums(0, &prepared.record.effort),
            rows,
        };
        problem.add_linear(at.values, &at.choice.linear);
        problem
    }

    fn add_linear(&mut self, values: &Values, estimated: &[&'static Quantity]) {
        for of in &QUANTITIES {
            let Kind::Linear(factor, low) = of.kind else {
                continue;
            };
            let is_estimated = estimated.iter().any(|linear| linear.name == of.name);
            if is_estimated {
                self.linear.push(Parameter::linear(of.name, of.unit, low));
            }
            if is_estimated || of.value(values) != 0.0 {
                let still = if self.moves(factor) {
                    Vec::new()
                } else {
                    self.column(factor, values)
                };
                self.terms.push(Term {
                    of,
                    factor,
                    estimated: is_estimated,
                    still,
                });
            }
        }
    }

    fn moves(&self, factor: Factor) -> bool {
        let free = |name: &str| self.nonlinear.iter().any(|of| of.name == name);
        match factor {
            Factor::Viscosity => free("viscosity_pole"),
            Factor::RollingDrag => free("viscosity_pole") || free("preload"),
            Factor::Wave(_) => free("preload"),
            _ => false,
        }
    }

    pub const fn rows(&self) -> &Rows {
        &self.rows
    }

    /// What a law of friction is told at every sample: position, speed, and load, all smoothed by the kernel.
    pub fn signals(&self) -> (&[f64], &[f64], Option<&[f64]>) {
        let samples = &self.samples;
        let Course { speed, load, .. } = &samples.course;
        (&samples.position, speed, load.as_deref())
    }

    /// Covariance of the sensor's noise in the slopes of a row: in the columns of acceleration and speed.
    pub fn noise(&self) -> DMatrix<f64> {
        let free = self.terms.iter().filter(|term| term.estimated);
        let linear = free.map(|term| match term.factor {
            Factor::Acceleration => Some(2),
            Factor::Speed => Some(1),
            _ => None,
        });
        let nonlinear = self.parameters.iter().map(|_| None);
        let derivatives: Vec<_> = nonlinear.chain(linear).collect();
        self.rows.noise(&self.prepared.record, &derivatives)
    }

    /// Rows in blocks of about as many each: by the size of the speed, and in each of these by the size of the load.
    pub fn blocks(&self, speeds: usize, loads: usize) -> Vec<Vec<usize>> {
        let part = |of: &[f64], mut rows: Vec<usize>, count: usize| -> Vec<Vec<usize>> {
            let size = |row: &usize| of[self.rows.centres[*row]].abs();
            rows.sort_by(|one, other| size(one).total_cmp(&size(other)));
            let length = rows.len().div_ceil(count).max(1);
            rows.chunks(length).map(<[usize]>::to_vec).collect()
        };
        let by_speed = part(
            &self.samples.course.speed,
            (0..self.rows.len()).collect(),
            speeds,
        );
        match &self.samples.course.load {
            Some(load) => {
                let by_load = by_speed.into_iter().map(|rows| part(load, rows, loads));
                by_load.flatten().collect()
            }
            None => by_speed,
        }
    }

    pub fn values(&self, nonlinear: &[f64], linear: &[f64]) -> Values {
        let mut values = self.values;
        let parameters = self.nonlinear.iter().zip(&self.parameters);
        for ((of, Parameter { low, high, .. }), value) in parameters.zip(nonlinear) {
            // What is NaN or infinite becomes the low bound.
            *(of.of)(&mut values) = value.max(*low).min(*high);
        }
        let free = self.terms.iter().filter(|term| term.estimated);
        for (term, value) in free.zip(linear) {
            *(term.of.of)(&mut values) = *value;
        }
        values
    }

    pub fn coordinates(&self, values: &Values) -> (Vec<f64>, Vec<f64>) {
        let free = self.terms.iter().filter(|term| term.estimated);
        (
            self.nonlinear.iter().map(|of| of.value(values)).collect(),
            free.map(|term| term.of.value(values)).collect(),
        )
    }

    /// Friction in every row, N m; no numbers where the exact ball refuses the values.
    pub fn friction(&self, values: &Values) -> Vec<f64> {
        let course = &self.samples.course;
        let friction = match self.passage {
            Passage::Remembered => self.prepared.screw.friction(values, course, &self.grid),
            Passage::Sliding => self.sliding(values),
        };
        let friction = friction.unwrap_or_else(|_| vec![f64::NAN; self.prepared.record.len()]);
        self.rows.sums(0, &friction)
    }

    /// Friction of gross sliding at every sample within a row, in the row's direction.
    fn sliding(&self, values: &Values) -> Result<Vec<f64>, Failure> {
        let law = self.prepared.screw.law(values, &self.grid)?;
        let coefficient = CoefficientLaw::new(&self.prepared.screw.coefficient(values))?;
        let Samples {
            course, direction, ..
        } = &self.samples;
        let at = |(sample, direction): (usize, &f64)| {
            if *direction == 0.0 {
                return 0.0;
            }
            let now = coefficient.at_temperature(course.temperature[sample] as f32);
            let both = now.both(course.speed[sample] as f32);
            let own = both.of(*direction as f32).0;
            let load = course.load.as_ref().map_or(0.0, |load| load[sample]);
            direction * law.sliding(load, *direction, own.into())
        };
        Ok(direction.iter().enumerate().map(at).collect())
    }

    pub fn model(&self, values: &Values) -> Vec<f64> {
        let evaluation = self.evaluation(self.friction(values), values);
        evaluation.sum(&self.coordinates(values).1)
    }

    pub fn beside(&self, values: &Values) -> Evaluation {
        self.evaluation(vec![0.0; self.target.len()], values)
    }

    /// With what has no parameter, to which a quantity that is not estimated is added.
    fn evaluation(&self, mut fixed: Vec<f64>, values: &Values) -> Evaluation {
        let mut columns = Vec::new();
        let mut flanks = None;
        for term in &self.terms {
            let column = match term.factor {
                _ if !term.still.is_empty() => term.still.clone(),
                Factor::Wave(place) => {
                    self.wave(place, flanks.get_or_insert_with(|| self.flanks(values)))
                }
                factor => self.column(factor, values),
            };
            if term.estimated {
                columns.push(column);
            } else {
                let value = term.of.value(values);
                for (sum, entry) in fixed.iter_mut().zip(&column) {
                    *sum += value * entry;
                }
            }
        }
        Evaluation { fixed, columns }
    }

    fn column(&self, factor: Factor, values: &Values) -> Vec<f64> {
        let (rows, record) = (&self.rows, &self.prepared.record);
        let motion = |derivative| rows.sums(record.order(derivative), &record.motion);
        let signal = match factor {
            Factor::Acceleration => return motion(2),
            Factor::Speed => return motion(1),
            Factor::One => return vec![1.0; rows.len()],
            Factor::Load => match &self.prepared.trace.load {
                Some(load) => {
                    let reduced_lead = f64::from(self.prepared.screw.caged.design.lead()) / TAU;
                    load.iter().map(|load| reduced_lead * load).collect()
                }
                None => return vec![0.0; rows.len()],
            },
            Factor::Viscosity => self.viscous(values),
            Factor::RollingDrag => self.dragged(values),
            Factor::Wave(place) => return self.wave(place, &self.flanks(values)),
        };
        rows.sums(0, &signal)
    }

    /// Sum of both flanks' loads over that at the reference load, at every sample; none where no load is measured.
    fn flanks(&self, values: &Values) -> Vec<f64> {
        let screw = &self.prepared.screw;
        let preload = screw.axial_preload(values);
        let reference = flank_sum(preload, screw.reference_load).max(f64::MIN_POSITIVE);
        let load = self.samples.course.load.iter().flatten();
        load.map(|load| flank_sum(preload, *load) / reference)
            .collect()
    }

    fn wave(&self, place: usize, flanks: &[f64]) -> Vec<f64> {
        let wave = &self.samples.waves[place];
        if flanks.is_empty() {
            return self.rows.sums(0, wave);
        }
        let samples = wave.iter().zip(flanks);
        let signal: Vec<f64> = samples.map(|(wave, flanks)| wave * flanks).collect();
        self.rows.sums(0, &signal)
    }

    /// Viscosity times speed at every sample, Pa.
    fn viscous(&self, values: &Values) -> Vec<f64> {
        let viscosity = self.prepared.screw.viscosity(values);
        let at = |temperature: f64| {
            let oil = viscosity.as_ref();
            oil.map_or(0.0, |oil| f64::from(oil.at(temperature as f32)))
        };
        let Course {
            speed, temperature, ..
        } = &self.samples.course;
        let samples = speed.iter().zip(temperature);
        samples
            .map(|(speed, temperature)| speed * at(*temperature))
            .collect()
    }

    /// Lubricant drag of the rolling contacts at every sample, N m; none where the crate refuses the values.
    fn dragged(&self, values: &Values) -> Vec<f64> {
        let CagedDesign {
            design,
            loaded_balls,
            ..
        } = &self.prepared.screw.caged;
        let law = RollingDrag::of(design, *loaded_balls, defaults::FLOODING).and_then(|drag| {
            CoefficientLaw::new(&CoefficientParameters {
                drag,
                ..self.prepared.screw.coefficient(values)
            })
        });
        let Ok(law) = law else {
            return vec![0.0; self.prepared.record.len()];
        };
        let lift_off = 8_f64.sqrt() * self.prepared.screw.axial_preload(values);
        let Course {
            speed,
            load,
            temperature,
            ..
        } = &self.samples.course;
        let at = |(sample, speed): (usize, &f64)| {
            let load = load.as_ref().map_or(0.0, |load| load[sample].abs());
            let now = law.at_temperature(temperature[sample] as f32);
            f64::from(now.drag_torque(*speed as f32, load as f32, lift_off as f32))
        };
        speed.iter().enumerate().map(at).collect()
    }
}

impl Samples {
    fn of(prepared: &Prepared<'_>, rows: &Rows, passage: Passage) -> Self {
        let (trace, record) = (prepared.trace, &prepared.record);
        let kernel = &rows.kernel;
        // Noise of a load would cut what elements hold before they slide; under sliding it is the sign that must not flicker.
        let load_kernel = match passage {
            Passage::Sliding => Kernel::new((kernel.half() / QUARTER).max(3), record.tick),
            Passage::Remembered => kernel.clone(),
        };
        let mut direction = vec![0.0; record.len()];
        for (centre, own) in rows.centres.iter().zip(&rows.directions) {
            let window = centre.saturating_sub(kernel.half())..=centre + kernel.half();
            if let Some(window) = direction.get_mut(window) {
                window.fill(*own);
            }
        }
        let angles = record.places();
        let wave = |of: fn(f64) -> f64, order: f64| -> Vec<f64> {
            angles.iter().map(|angle| of(order * angle)).collect()
        };
        Self {
            position: kernel.along(0, angles),
            course: Course {
                angle: match passage {
                    Passage::Sliding => Vec::new(),
                    Passage::Remembered => path(prepared, kernel),
                },
                speed: kernel.along(record.order(1), &record.motion),
                load: trace.load.as_ref().map(|load| load_kernel.along(0, load)),
                temperature: match &trace.temperature {
                    Some(temperature) => temperature.clone(),
                    None => vec![prepared.screw.reference_temperature; record.len()],
                },
            },
            direction,
            waves: [
                wave(f64::cos, 1.0),
                wave(f64::sin, 1.0),
                wave(f64::cos, 2.0),
                wave(f64::sin, 2.0),
            ],
        }
    }
}

/// Positions that a memory follows: a counted one on straight lines between the instants at which its count changes, with each turn at the
/// middle of its outermost count; one with noise smoothed by the kernel.
fn path(prepared: &Prepared<'_>, kernel: &Kernel) -> Vec<f64> {
    let (trace, record) = (prepared.trace, &prepared.record);
    let position = &trace.position;
    if trace.position_summed || trace.resolution == 0.0 {
        return kernel.along(0, position);
    }
    let mut path = record.motion.clone();
    let mut last: Option<(usize, f64)> = None;
    for (sample, pair) in position.windows(2).enumerate() {
        let step = pair[1] - pair[0];
        if step == 0.0 {
            continue;
        }
        if let Some((before, moved)) = last
            && moved * step < 0.0
        {
            let half = 0.5 * (sample - before) as f64;
            let middle = 0.5 * (before + sample + 1) as f64;
            for (k, place) in path
                .iter_mut()
                .enumerate()
                .take(sample + 1)
                .skip(before + 1)
            {
                *place += 0.5 * moved * (1.0 - (k as f64 - middle).abs() / half);
            }
        }
        last = Some((sample, step));
    }
    path
}

/// Sum of the axial forces of two flanks that share one Hertzian deflection, N, under a load: the series
/// `P (2 + y^2/12 + ...)` with `y = F/P`, whose last coefficient makes it meet the load where one flank is lost, at
/// `y = 2 sqrt(2)`. Largest error 0.84 %, of a wave of a few per cent of the friction.
pub fn flank_sum(preload: f64, load: f64) -> f64 {
    let load = load.abs();
    if load < 8.0_f64.sqrt() * preload {
        let square = (load / preload).powi(2);
        let quartic = ((12.0 * (8.0_f64.sqrt() - 2.0)) / 8.0 - 1.0) / 8.0;
        preload * (2.0 + square / 12.0 * (1.0 + quartic * square))
    } else {
        load
    }
}

impl Separable for ScrewProblem<'_> {
    fn nonlinear(&self) -> &[Parameter] {
        &self.parameters
    }

    fn linear(&self) -> &[Parameter] {
        &self.linear
    }

    fn target(&self) -> &[f64] {
        &self.target
    }

    fn evaluate(&self, nonlinear: &[f64]) -> Evaluation {
        let values = self.values(nonlinear, &[]);
        self.evaluation(self.friction(&values), &values)
    }
}
