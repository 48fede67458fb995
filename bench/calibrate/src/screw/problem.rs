//! A screw on a rig as a separable least-squares problem.
//!
//! ```text
//! tau = inertia dw/dt + drag w + churning eta(T) w + rolling_drag D(w, F, T) + offset + gain lead/(2 pi) F
//!       + friction(angle, w, F, T; q) + (S/S_ref) sum_k (c_k cos k theta + s_k sin k theta)
//! ```
//!
//! Both sides pass through the same filter; so does every column, and the friction at every sample of the
//! trace. `S` is the sum of both flanks' loads, `D` the lubricant drag of the crate's default.

use std::f64::consts::TAU;
use std::sync::Arc;

use epas_design::CagedDesign;
use epas_friction::defaults;
use epas_friction::law::coefficient::{CoefficientLaw, CoefficientParameters, RollingDrag};

use super::exact::{Grid, Spacing};
use super::friction::{Course, Screw};
use super::quantities::{Factor, Linear, Nonlinear, Values};
use super::waves::{Waves, flank_sum};
use crate::fit::problem::{Evaluation, LinearParameter, Parameter, Separable};
use crate::signals::filter::ZeroPhase;
use crate::signals::{Motion, Rows};
use crate::trace::Trace;
use epas_page::failure::Failure;

/// A trace of a screw, with what is estimated and what is not.
pub struct ScrewProblem<'a> {
    screw: Screw,
    trace: &'a Trace,
    motion: &'a Motion,
    rows: &'a Rows,
    course: Course,
    /// What is not estimated stays at these; what is starts here.
    values: Values,
    nonlinear: Vec<(Parameter, &'static Nonlinear)>,
    parameters: Vec<Parameter>,
    linear: Vec<(&'static Linear, Column)>,
    linear_parameters: Vec<LinearParameter>,
    /// Linear quantities that are not estimated and not zero.
    set: Vec<(&'static Linear, Column)>,
    target: Vec<f64>,
    waves: Waves,
    /// The exact ball.
    grid: Arc<Grid>,
    /// The exact ball with the spacing of the search, which came before.
    search: Arc<Grid>,
}

/// What a linear quantity multiplies.
enum Column {
    /// The same whatever the nonlinear quantities are.
    Still(Vec<f64>),
    /// To be found anew.
    Moving,
}

/// What stands beside the friction: target, columns and their sum where they are set, at the start values.
#[derive(Clone, Debug, PartialEq)]
pub struct Beside {
    /// What was measured.
    pub target: Vec<f64>,
    /// What is set.
    pub fixed: Vec<f64>,
    /// What is estimated.
    pub linear: Vec<LinearParameter>,
    /// What it multiplies.
    pub columns: Vec<Vec<f64>>,
}

/// What is estimated.
#[derive(Clone, Debug)]
pub struct Choice {
    /// Nonlinear quantities, with start and bounds.
    pub nonlinear: Vec<(Parameter, &'static Nonlinear)>,
    /// Linear ones.
    pub linear: Vec<&'static Linear>,
}

impl<'a> ScrewProblem<'a> {
    /// Filters what can be filtered once.
    ///
    /// # Errors
    /// A start, or a trace, that is refused.
    pub fn new(
        screw: Screw,
        (trace, motion, rows): (&'a Trace, &'a Motion, &'a Rows),
        smoothing: &ZeroPhase,
        values: Values,
        choice: Choice,
        spacing: Spacing,
    ) -> Result<Self, Failure> {
        let course = Course::of(trace, motion, Some(smoothing), screw.reference_temperature);
        let grid = screw.grid(&values, spacing)?;
        let mut problem = Self {
            screw,
            trace,
            motion,
            rows,
            course,
            values,
            parameters: choice.nonlinear.iter().map(|(p, _)| p.clone()).collect(),
            nonlinear: choice.nonlinear,
            linear: Vec::new(),
            linear_parameters: choice.linear.iter().map(|of| of.parameter()).collect(),
            set: Vec::new(),
            target: rows.of(&trace.acting()),
            waves: Waves::default(),
            search: Arc::clone(&grid),
            grid,
        };
        let free = |name: &str| problem.nonlinear.iter().any(|(p, _)| p.name == name);
        let moves = |factor: Factor| match factor {
            Factor::Viscosity => free("viscosity_pole"),
            Factor::RollingDrag => free("viscosity_pole") || free("preload"),
            Factor::Cosine(_) | Factor::Sine(_) => free("preload"),
            _ => false,
        };
        let column = |of: &'static Linear| {
            let column = if moves(of.factor) {
                Column::Moving
            } else {
                Column::Still(problem.column(of.factor, &values))
            };
            (of, column)
        };
        let linear = choice.linear.iter().map(|of| column(of)).collect();
        let others = super::quantities::LINEAR.iter();
        let set = others
            .filter(|of| of.value(&values) != 0.0)
            .filter(|of| !choice.linear.iter().any(|chosen| chosen.name == of.name))
            .map(column)
            .collect();
        (problem.linear, problem.set) = (linear, set);
        problem
            .screw
            .friction(&values, &problem.course, &problem.grid)?;
        Ok(problem)
    }

    /// The screw.
    pub const fn screw(&self) -> &Screw {
        &self.screw
    }

    /// All values with these of what is estimated.
    pub fn values(&self, nonlinear: &[f64], linear: &[f64]) -> Values {
        let mut values = self.values;
        for ((parameter, of), value) in self.nonlinear.iter().zip(nonlinear) {
            // What is no number becomes the low bound.
            *(of.of)(&mut values) = value.max(parameter.low).min(parameter.high);
        }
        for ((of, _), value) in self.linear.iter().zip(linear) {
            *(of.of)(&mut values) = *value;
        }
        values
    }

    /// Friction at every sample, N m; no numbers where the exact ball refuses the values.
    pub fn friction(&self, values: &Values) -> Vec<f64> {
        let friction = self.screw.friction(values, &self.course, &self.grid);
        friction.unwrap_or_else(|_| vec![f64::NAN; self.trace.len()])
    }

    /// The same problem from a start near its answer, on a fine grid whose middle is the preload there.
    ///
    /// # Errors
    /// Values that are refused.
    pub fn refined(mut self, values: &Values) -> Result<Self, Failure> {
        self.grid = self.screw.grid(values, Spacing::FINE)?;
        let known = self.parameters.iter_mut().zip(&self.nonlinear);
        for (parameter, (_, of)) in known {
            parameter.start = of.value(values).max(parameter.low).min(parameter.high);
        }
        Ok(self)
    }

    /// The exact ball with the spacing of the search: for models that err by more than it does.
    pub const fn search_grid(&self) -> &Arc<Grid> {
        &self.search
    }

    /// What the model is told at every sample.
    pub const fn course(&self) -> &Course {
        &self.course
    }

    /// What stands beside the friction, for other models of it.
    pub fn beside(&self, values: &Values) -> Beside {
        let mut fixed = vec![0.0; self.target.len()];
        self.add_set(&mut fixed, values);
        Beside {
            target: self.target.clone(),
            fixed,
            linear: self.linear_parameters.clone(),
            columns: self
                .linear
                .iter()
                .map(|of| self.rows_of(of, values))
                .collect(),
        }
    }

    fn rows_of(&self, (of, column): &(&'static Linear, Column), values: &Values) -> Vec<f64> {
        match column {
            Column::Still(rows) => rows.clone(),
            Column::Moving => match of.factor {
                Factor::Cosine(_) | Factor::Sine(_) => {
                    let preload = self.screw.axial_preload(values);
                    self.waves
                        .rows(of.factor, preload, || self.column(of.factor, values))
                }
                _ => self.column(of.factor, values),
            },
        }
    }

    /// Adds what is not estimated and not zero.
    fn add_set(&self, sum: &mut [f64], values: &Values) {
        for set in &self.set {
            let factor = set.0.value(values);
            for (sum, value) in sum.iter_mut().zip(self.rows_of(set, values)) {
                *sum += factor * value;
            }
        }
    }

    /// Rows of what a factor is at every sample.
    fn column(&self, factor: Factor, values: &Values) -> Vec<f64> {
        self.rows.of(&self.signal(factor, values))
    }

    /// What a factor is at every sample.
    fn signal(&self, factor: Factor, values: &Values) -> Vec<f64> {
        let Motion {
            position,
            speed,
            acceleration,
            ..
        } = self.motion;
        let waves = |wave: fn(f64) -> f64, order: u8| {
            let angles = position.iter().map(|angle| f64::from(order) * angle);
            let waves = self.waves.wave(factor, || angles.map(wave).collect());
            let sums = waves.iter().zip(self.flank_sums(values));
            sums.map(|(wave, sum)| wave * sum).collect()
        };
        match factor {
            Factor::Acceleration => acceleration.clone(),
            Factor::Speed => speed.clone(),
            Factor::Viscosity => self.viscous(values),
            Factor::RollingDrag => self.dragged(values),
            Factor::One => vec![1.0; position.len()],
            Factor::Load => {
                let reduced_lead = f64::from(self.screw.caged.design.lead()) / TAU;
                match &self.trace.load {
                    Some(load) => load.iter().map(|load| reduced_lead * load).collect(),
                    None => vec![0.0; position.len()],
                }
            }
            Factor::Cosine(order) => waves(f64::cos, order),
            Factor::Sine(order) => waves(f64::sin, order),
        }
    }

    /// The trace and its motion.
    pub const fn measured(&self) -> (&Trace, &Motion) {
        (self.trace, self.motion)
    }

    /// Rows of the whole model.
    pub fn model(&self, values: &Values) -> Vec<f64> {
        self.whole(self.friction(values), values)
    }

    /// The same as if another motion and load had been measured.
    pub fn model_of(
        &self,
        trace: &Trace,
        motion: &Motion,
        smoothing: &ZeroPhase,
        values: &Values,
    ) -> Vec<f64> {
        let other = ScrewProblem {
            screw: self.screw,
            // Noise of the load in the load's own torque is in the residual already.
            trace: self.trace,
            motion,
            rows: self.rows,
            course: Course::of(
                trace,
                motion,
                Some(smoothing),
                self.screw.reference_temperature,
            ),
            values: *values,
            nonlinear: Vec::new(),
            parameters: Vec::new(),
            linear: Vec::new(),
            linear_parameters: Vec::new(),
            set: Vec::new(),
            target: Vec::new(),
            waves: Waves::default(),
            grid: Arc::clone(&self.grid),
            search: Arc::clone(&self.search),
        };
        other.whole(other.friction(values), values)
    }

    fn whole(&self, mut sum: Vec<f64>, values: &Values) -> Vec<f64> {
        for of in &super::quantities::LINEAR {
            let value = of.value(values);
            if value != 0.0 {
                for (sum, signal) in sum.iter_mut().zip(self.signal(of.factor, values)) {
                    *sum += value * signal;
                }
            }
        }
        self.rows.of(&sum)
    }

    /// What turns signals into rows.
    pub const fn rows(&self) -> &Rows {
        self.rows
    }

    /// Viscosity times speed at every sample, Pa.
    fn viscous(&self, values: &Values) -> Vec<f64> {
        let viscosity = self.screw.viscosity(values);
        let temperatures = self.trace.temperature.iter().flatten().copied();
        let temperatures = temperatures.chain(std::iter::repeat(self.screw.reference_temperature));
        let at =
            |temperature: f64| viscosity.map_or(0.0, |oil| f64::from(oil.at(temperature as f32)));
        let speeds = self.motion.speed.iter().zip(temperatures);
        speeds
            .map(|(speed, temperature)| speed * at(temperature))
            .collect()
    }

    /// Lubricant drag of the rolling contacts at every sample, N m; none where the crate refuses the values.
    fn dragged(&self, values: &Values) -> Vec<f64> {
        let CagedDesign {
            design,
            loaded_balls,
            ..
        } = &self.screw.caged;
        let law = RollingDrag::of(design, *loaded_balls, defaults::FLOODING).and_then(|drag| {
            CoefficientLaw::new(&CoefficientParameters {
                drag,
                ..self.screw.coefficient(values)
            })
        });
        let Ok(law) = law else {
            return vec![0.0; self.motion.speed.len()];
        };
        let lift_off = 8_f64.sqrt() * self.screw.axial_preload(values);
        let sample = |(index, speed): (usize, &f64)| {
            let at = |channel: &Option<Vec<f64>>, without: f64| {
                let value = channel.as_ref().and_then(|channel| channel.get(index));
                value.map_or(without, |value| *value)
            };
            let load = at(&self.trace.load, 0.0).abs();
            let temperature = at(&self.trace.temperature, self.screw.reference_temperature);
            let now = law.at_temperature(temperature as f32);
            f64::from(now.drag_torque(*speed as f32, load as f32, lift_off as f32))
        };
        self.motion.speed.iter().enumerate().map(sample).collect()
    }

    /// Sum of both flanks' loads over that at the reference load, at every sample.
    fn flank_sums(&self, values: &Values) -> Vec<f64> {
        let preload = self.screw.axial_preload(values);
        let reference = flank_sum(preload, self.screw.reference_load).max(f64::MIN_POSITIVE);
        match &self.trace.load {
            Some(load) => load
                .iter()
                .map(|load| flank_sum(preload, *load) / reference)
                .collect(),
            None => vec![1.0; self.trace.len()],
        }
    }
}

impl Linear {
    fn parameter(&self) -> LinearParameter {
        let (low, high) = self.bounds;
        LinearParameter {
            name: self.name,
            unit: self.unit,
            low,
            high,
        }
    }
}

impl Separable for ScrewProblem<'_> {
    fn nonlinear(&self) -> &[Parameter] {
        &self.parameters
    }

    fn linear(&self) -> &[LinearParameter] {
        &self.linear_parameters
    }

    fn target(&self) -> &[f64] {
        &self.target
    }

    fn row_step(&self) -> f64 {
        self.rows.row_step()
    }

    fn evaluate(&self, nonlinear: &[f64]) -> Evaluation {
        let values = self.values(nonlinear, &[]);
        let mut fixed = self.rows.of(&self.friction(&values));
        self.add_set(&mut fixed, &values);
        Evaluation {
            fixed,
            columns: self
                .linear
                .iter()
                .map(|of| self.rows_of(of, &values))
                .collect(),
        }
    }
}
