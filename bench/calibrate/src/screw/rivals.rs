//! Other models of friction on a screw: laws of the literature times the load that both flanks share, and the exact ball without memory.
//!
//! Everything beside the friction is the same as in [`super::problem`]. The load's share has the preload as a parameter: with a large one
//! the friction does not follow the load at all, so that a law may choose.

use std::sync::Arc;

use super::exact::Grid;
use super::friction::{Course, Screw};
use super::problem::Beside;
use super::quantities::Values;
use super::waves::flank_sum;
use crate::fit::problem::{Evaluation, LinearParameter, Parameter, Scale, Separable};
use crate::laws::{Law, Scales};
use crate::signals::{Motion, Rows};
use crate::trace::Trace;
use epas_page::failure::Failure;

/// A law of the literature on a screw.
pub struct Rival<'a> {
    law: Law,
    scales: Scales,
    trace: &'a Trace,
    motion: &'a Motion,
    rows: &'a Rows,
    beside: &'a Beside,
    nonlinear: Vec<Parameter>,
    linear: Vec<LinearParameter>,
}

/// Friction of gross sliding without a load: what a law of unit level is multiplied by.
const LEVEL: LinearParameter = LinearParameter {
    name: "level",
    unit: "N m",
    low: 0.0,
    high: f64::INFINITY,
};

/// Preload of a flank in a law's load share over the largest load: least and most.
const PRELOADS: [f64; 2] = [1e-3, 10.0];

impl<'a> Rival<'a> {
    /// A law on a trace, with what stands beside the friction.
    pub fn new(
        law: Law,
        (trace, motion, rows): (&'a Trace, &'a Motion, &'a Rows),
        beside: &'a Beside,
        preload: f64,
        largest_load: f64,
    ) -> Self {
        let size = |list: &[f64]| {
            list.iter()
                .fold(0.0_f64, |most, value| most.max(value.abs()))
        };
        let ends = motion
            .position
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], place| {
                [low.min(*place), high.max(*place)]
            });
        let scales = Scales {
            speed: size(&motion.speed).max(f64::MIN_POSITIVE),
            travel: (ends[1] - ends[0]).max(f64::MIN_POSITIVE),
            resolution: trace.resolution,
            tick: trace.step,
        };
        let mut nonlinear = law.parameters(&scales, ["rad", "rad/s"]);
        if trace.load.is_some() && largest_load > 0.0 {
            let [low, high] = PRELOADS.map(|share| share * largest_load);
            nonlinear.push(Parameter {
                name: "axial_preload",
                unit: "N",
                start: preload.max(low).min(high),
                low,
                high,
                scale: Scale::Logarithmic,
            });
        }
        let mut linear = beside.linear.clone();
        linear.push(LEVEL);
        Self {
            law,
            scales,
            trace,
            motion,
            rows,
            beside,
            nonlinear,
            linear,
        }
    }

    /// Friction of unit level at every sample; no numbers where the law refuses its parameters.
    fn friction(&self, nonlinear: &[f64]) -> Vec<f64> {
        let Ok(friction) = self.law.friction(&self.scales, nonlinear) else {
            return vec![f64::NAN; self.trace.len()];
        };
        let friction = friction.along(&self.motion.position, &self.motion.speed, self.scales.tick);
        match (&self.trace.load, nonlinear.last()) {
            (Some(load), Some(&preload)) if self.has_preload() => friction
                .iter()
                .zip(load)
                .map(|(friction, load)| friction * flank_sum(preload, *load) / (2.0 * preload))
                .collect(),
            _ => friction,
        }
    }

    fn has_preload(&self) -> bool {
        self.nonlinear
            .last()
            .is_some_and(|last| last.name == "axial_preload")
    }
}

impl Separable for Rival<'_> {
    fn nonlinear(&self) -> &[Parameter] {
        &self.nonlinear
    }

    fn linear(&self) -> &[LinearParameter] {
        &self.linear
    }

    fn target(&self) -> &[f64] {
        &self.beside.target
    }

    fn row_step(&self) -> f64 {
        self.rows.row_step()
    }

    fn evaluate(&self, nonlinear: &[f64]) -> Evaluation {
        let mut columns = self.beside.columns.clone();
        columns.push(self.rows.of(&self.friction(nonlinear)));
        Evaluation {
            fixed: self.beside.fixed.clone(),
            columns,
        }
    }
}

/// The screw without memory: friction by the speed alone, with one coefficient.
pub struct WithoutMemory<'a> {
    screw: Screw,
    values: Values,
    grid: Arc<Grid>,
    course: &'a Course,
    rows: &'a Rows,
    beside: &'a Beside,
    nonlinear: Vec<Parameter>,
}

/// Speeds of a reversal, rad/s.
const REVERSAL_SPEEDS: [f64; 3] = [1e-3, 0.2, 50.0];

impl<'a> WithoutMemory<'a> {
    /// That of a screw, with the bounds of what is estimated of it.
    pub fn new(
        screw: Screw,
        values: Values,
        (estimated, grid): (&[Parameter], &Arc<Grid>),
        (course, rows, beside): (&'a Course, &'a Rows, &'a Beside),
    ) -> Self {
        let [low, start, high] = REVERSAL_SPEEDS;
        let of_screw = estimated
            .iter()
            .filter(|parameter| matches!(parameter.name, "friction" | "preload"));
        let mut nonlinear: Vec<Parameter> = of_screw.cloned().collect();
        nonlinear.push(Parameter {
            name: "reversal_speed",
            unit: "rad/s",
            start,
            low,
            high,
            scale: Scale::Logarithmic,
        });
        Self {
            screw,
            values,
            grid: Arc::clone(grid),
            course,
            rows,
            beside,
            nonlinear,
        }
    }

    fn friction(&self, nonlinear: &[f64]) -> Result<Vec<f64>, Failure> {
        let (mut reversal_speed, mut values) = (self.screw.caged.reversal_speed, self.values);
        for (parameter, value) in self.nonlinear.iter().zip(nonlinear) {
            match parameter.name {
                "friction" => values.friction = *value,
                "preload" => values.preload = *value,
                _ => reversal_speed = *value as f32,
            }
        }
        self.screw
            .friction_by_speed(&values, self.course, &self.grid, reversal_speed)
    }
}

impl Separable for WithoutMemory<'_> {
    fn nonlinear(&self) -> &[Parameter] {
        &self.nonlinear
    }

    fn linear(&self) -> &[LinearParameter] {
        &self.beside.linear
    }

    fn target(&self) -> &[f64] {
        &self.beside.target
    }

    fn row_step(&self) -> f64 {
        self.rows.row_step()
    }

    fn evaluate(&self, nonlinear: &[f64]) -> Evaluation {
        let friction = match self.friction(nonlinear) {
            Ok(friction) => self.rows.of(&friction),
            Err(_) => vec![f64::NAN; self.beside.target.len()],
        };
        let rows = friction.iter().zip(&self.beside.fixed);
        Evaluation {
            fixed: rows.map(|(friction, fixed)| friction + fixed).collect(),
            columns: self.beside.columns.clone(),
        }
    }
}
