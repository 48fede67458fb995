//! What is fitted: a sum of columns, each times a parameter, and a part that has none, over parameters that enter otherwise.

use std::ops::Range;

/// How a parameter is stepped and bounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// By its value.
    Linear,
    /// By its logarithm; it is positive.
    Logarithmic,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    pub name: &'static str,
    pub unit: &'static str,
    pub start: f64,
    pub low: f64,
    pub high: f64,
    pub scale: Scale,
}

impl Parameter {
    /// One that is positive, within two bounds.
    pub const fn positive(
        name: &'static str,
        unit: &'static str,
        start: f64,
        [low, high]: [f64; 2],
    ) -> Self {
        Self {
            name,
            unit,
            start,
            low,
            high,
            scale: Scale::Logarithmic,
        }
    }

    /// One that enters linearly: from a least value on, minus infinity where there is none.
    pub const fn linear(name: &'static str, unit: &'static str, low: f64) -> Self {
        Self {
            name,
            unit,
            start: 0.0,
            low,
            high: f64::INFINITY,
            scale: Scale::Linear,
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct Evaluation {
    /// What has no linear parameter.
    pub fixed: Vec<f64>,
    /// What each linear parameter multiplies.
    pub columns: Vec<Vec<f64>>,
}

impl Evaluation {
    pub fn sum(mut self, linear: &[f64]) -> Vec<f64> {
        for (column, value) in self.columns.iter().zip(linear) {
            for (sum, entry) in self.fixed.iter_mut().zip(column) {
                *sum += value * entry;
            }
        }
        self.fixed
    }
}

/// A least-squares problem whose linear parameters are eliminated: `target = fixed(q) + sum p_k column_k(q) + residual`.
pub trait Separable: Sync {
    fn nonlinear(&self) -> &[Parameter];

    fn linear(&self) -> &[Parameter];

    fn target(&self) -> &[f64];

    fn evaluate(&self, nonlinear: &[f64]) -> Evaluation;
}

pub type Evaluate<'a> = Box<dyn Fn(&[f64]) -> Evaluation + Sync + 'a>;

pub struct Model<'a> {
    pub nonlinear: Vec<Parameter>,
    pub linear: Vec<Parameter>,
    pub target: Vec<f64>,
    pub evaluate: Evaluate<'a>,
}

impl Separable for Model<'_> {
    fn nonlinear(&self) -> &[Parameter] {
        &self.nonlinear
    }

    fn linear(&self) -> &[Parameter] {
        &self.linear
    }

    fn target(&self) -> &[f64] {
        &self.target
    }

    fn evaluate(&self, nonlinear: &[f64]) -> Evaluation {
        (self.evaluate)(nonlinear)
    }
}

pub(crate) fn part(whole: &dyn Separable, rows: Range<usize>) -> Model<'_> {
    Model {
        nonlinear: whole.nonlinear().to_vec(),
        linear: whole.linear().to_vec(),
        target: whole.target()[rows.clone()].to_vec(),
        evaluate: Box::new(move |nonlinear| {
            let Evaluation { fixed, columns } = whole.evaluate(nonlinear);
            let cut = |all: &Vec<f64>| all[rows.clone()].to_vec();
            Evaluation {
                fixed: cut(&fixed),
                columns: columns.iter().map(cut).collect(),
            }
        }),
    }
}

pub(crate) fn residual(problem: &dyn Separable, nonlinear: &[f64], linear: &[f64]) -> Vec<f64> {
    let model = problem.evaluate(nonlinear).sum(linear).into_iter();
    let rows = problem.target().iter().zip(model);
    rows.map(|(target, model)| target - model).collect()
}

/// The inner coordinate of a value, in which a parameter is stepped.
pub fn inner(scale: Scale, value: f64) -> f64 {
    match scale {
        Scale::Linear => value,
        Scale::Logarithmic => value.ln(),
    }
}

/// The value at an inner coordinate.
pub fn outer(scale: Scale, coordinate: f64) -> f64 {
    match scale {
        Scale::Linear => coordinate,
        Scale::Logarithmic => coordinate.exp(),
    }
}
