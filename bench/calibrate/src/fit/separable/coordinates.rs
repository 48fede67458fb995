//! Coordinates in which nonlinear parameters are stepped: without bounds outside, bounded inside.
//!
//! A parameter `q` has an inner coordinate `y` (its logarithm, or itself), in which its information is nearly constant, and an outer
//! one `u`, `y = low + (high - low) (1 + sin(u - 2)) / 2` (as in MINUIT), in which every step stays within the bounds. The shift of 2
//! keeps `u` away from zero, since Levenberg-Marquardt measures its first step and its last one relative to the coordinates.

use crate::fit::problem::{Parameter, Scale};

/// Shift of the outer coordinate.
const SHIFT: f64 = 2.0;

/// A start on a bound has no slope in the outer coordinate; it is moved in by this part of the range.
const INSIDE: f64 = 0.01;

/// Within this part of the range, a parameter counts as at its bound.
const AT_BOUND: f64 = 1e-3;

/// Coordinates of one parameter.
#[derive(Clone, Copy, Debug)]
struct Axis {
    scale: Scale,
    low: f64,
    high: f64,
    /// Bounds of the inner coordinate.
    inner_low: f64,
    inner_high: f64,
    /// A size of the inner coordinate, that a difference is relative to.
    size: f64,
}

/// Coordinates of all nonlinear parameters.
#[derive(Clone, Debug)]
pub(super) struct Coordinates(Vec<Axis>);

/// The inner coordinate of a value.
pub(crate) fn inner(scale: Scale, value: f64) -> f64 {
    match scale {
        Scale::Linear => value,
        Scale::Logarithmic => value.ln(),
    }
}

/// The value at an inner coordinate.
pub(crate) fn outer(scale: Scale, coordinate: f64) -> f64 {
    match scale {
        Scale::Linear => coordinate,
        Scale::Logarithmic => coordinate.exp(),
    }
}

/// Slope of the inner coordinate over the value.
pub(crate) fn inner_slope(scale: Scale, value: f64) -> f64 {
    match scale {
        Scale::Linear => 1.0,
        Scale::Logarithmic => 1.0 / value,
    }
}

impl Axis {
    fn new(parameter: &Parameter) -> Self {
        let Parameter {
            start,
            low,
            high,
            scale,
            ..
        } = *parameter;
        let (inner_low, inner_high) = (inner(scale, low), inner(scale, high));
        let size = match scale {
            Scale::Logarithmic => 1.0,
            Scale::Linear => start.abs().max(0.01 * (high - low)),
        };
        Self {
            scale,
            low,
            high,
            inner_low,
            inner_high,
            size,
        }
    }

    fn range(&self) -> f64 {
        self.inner_high - self.inner_low
    }

    fn fraction(&self, value: f64) -> f64 {
        (inner(self.scale, value) - self.inner_low) / self.range()
    }

    fn value(&self, coordinate: f64) -> f64 {
        outer(self.scale, coordinate).clamp(self.low, self.high)
    }
}

impl Coordinates {
    pub(super) fn new(parameters: &[Parameter]) -> Self {
        Self(parameters.iter().map(Axis::new).collect())
    }

    /// Outer coordinates of values, moved a little inside where they are at a bound.
    pub(super) fn start(&self, values: &[f64]) -> Vec<f64> {
        let free = |(axis, value): (&Axis, &f64)| {
            SHIFT + (2.0 * axis.fraction(*value).clamp(INSIDE, 1.0 - INSIDE) - 1.0).asin()
        };
        self.0.iter().zip(values).map(free).collect()
    }

    /// Values at outer coordinates.
    pub(super) fn values(&self, outer: &[f64]) -> Vec<f64> {
        let value = |(axis, u): (&Axis, &f64)| {
            axis.value(axis.inner_low + axis.range() * 0.5 * (1.0 + (u - SHIFT).sin()))
        };
        self.0.iter().zip(outer).map(value).collect()
    }

    /// Slope of the inner coordinates over the outer ones.
    pub(super) fn slopes(&self, outer: &[f64]) -> Vec<f64> {
        self.0
            .iter()
            .zip(outer)
            .map(|(axis, u)| 0.5 * axis.range() * (u - SHIFT).cos())
            .collect()
    }

    /// Inner coordinates of values.
    pub(super) fn inner(&self, values: &[f64]) -> Vec<f64> {
        self.0
            .iter()
            .zip(values)
            .map(|(axis, value)| inner(axis.scale, *value))
            .collect()
    }

    /// Values at these fractions of the ranges of the inner coordinates.
    pub(super) fn at(&self, fractions: &[f64]) -> Vec<f64> {
        let value = |(axis, part): (&Axis, &f64)| axis.value(axis.inner_low + axis.range() * part);
        self.0.iter().zip(fractions).map(value).collect()
    }

    /// Values on both sides of a parameter's own at a relative distance `step`, kept within the bounds, and the distance between them
    /// in the inner coordinate. One side only (the one with room) where `both` is false; the other is the value itself.
    pub(super) fn beside(
        &self,
        values: &[f64],
        index: usize,
        step: f64,
        both: bool,
    ) -> ([f64; 2], f64) {
        let (axis, value) = (&self.0[index], values[index]);
        let y = inner(axis.scale, value);
        let h = step
            * axis.size.max(if axis.scale == Scale::Linear {
                y.abs()
            } else {
                0.0
            });
        let room = y + h <= axis.inner_high;
        let above = if both || room {
            (y + h).min(axis.inner_high)
        } else {
            y
        };
        let below = if both || !room {
            (y - h).max(axis.inner_low)
        } else {
            y
        };
        ([axis.value(below), axis.value(above)], above - below)
    }

    /// Which values are at a bound: -1 at the low one, 1 at the high one, else 0.
    pub(super) fn at_bound(&self, values: &[f64]) -> Vec<i8> {
        let side = |(axis, value): (&Axis, &f64)| match axis.fraction(*value) {
            part if part < AT_BOUND => -1,
            part if part > 1.0 - AT_BOUND => 1,
            _ => 0,
        };
        self.0.iter().zip(values).map(side).collect()
    }
}
