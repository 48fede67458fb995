//! Profile likelihood: how the residual grows when one parameter is held elsewhere and all the others are fitted again.
//!
//! The likelihood is that of the rows that count as independent, scaled so that its curvature at the best value is the one of the
//! covariance (Chandler and Bate 2007). Where it is a parabola the covariance's interval is right; elsewhere the profile's is.

use nalgebra::DMatrix;

use crate::fit::problem::{Scale, Separable};
use crate::fit::separable::checks::FitError;
use crate::fit::separable::{Fit, FitSettings, Fixed, inner, outer, refit};
use crate::fit::uncertainty::{Interval, Uncertainty, inner_jacobian};

/// Most points to each side.
const POINTS: usize = 8;

/// Ends that differ from the covariance's by less than this part of the half width count as those of a parabola.
const PARABOLA: f64 = 0.2;

/// A parameter held at a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfilePoint {
    /// The value.
    pub value: f64,
    /// Twice the loss in log-likelihood against the best value; below zero where the fit had not found the best.
    pub loss: f64,
}

/// A parameter's profile.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// Name.
    pub name: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// Points, in the order of their values.
    pub points: Vec<ProfilePoint>,
    /// Loss at the ends of the interval.
    pub limit: f64,
    /// Low end of the 95 % interval; the low bound where the loss stays below the limit.
    pub low: f64,
    /// High end.
    pub high: f64,
    /// Whether the low and the high end are bounds (or the farthest point), where the loss is still below the limit.
    pub open: [bool; 2],
    /// Whether the covariance's interval is as good.
    pub parabolic: bool,
    /// Evaluations of the model.
    pub evaluations: usize,
}

/// What all points of a profile share.
struct Walk<'a> {
    problem: &'a dyn Separable,
    fit: &'a Fit,
    sure: &'a Uncertainty,
    settings: &'a FitSettings,
    index: usize,
    /// Cost of the fit, and twice the loss in log-likelihood for a relative change of it.
    cost: f64,
    rate: f64,
    limit: f64,
}

/// Profile of one parameter of a fit.
///
/// # Errors
///
/// A name that the fit does not have, and the errors of a fit.
pub fn profile(
    problem: &dyn Separable,
    fit: &Fit,
    sure: &Uncertainty,
    name: &str,
    settings: &FitSettings,
) -> Result<Profile, FitError> {
    let index = sure
        .intervals
        .iter()
        .position(|interval| interval.name == name);
    let index = index.ok_or_else(|| FitError::Unknown { name: name.into() })?;
    let interval = &sure.intervals[index];
    let cost: f64 = fit
        .residual
        .iter()
        .zip(&fit.weights)
        .map(|(r, w)| w * r * r)
        .sum();
    let limit = sure.quantile * sure.quantile;
    let walk = Walk {
        problem,
        fit,
        sure,
        settings,
        index,
        cost,
        rate: rate(problem, fit, sure, index, cost),
        limit,
    };
    let [mut points, above] = [walk.side(-1.0)?, walk.side(1.0)?];
    let best = ProfilePoint {
        value: interval.value,
        loss: 0.0,
    };
    let evaluations = points.1 + above.1;
    let (low, low_open) = walk.end(best, &points.0, interval.bounds[0]);
    let (high, high_open) = walk.end(best, &above.0, interval.bounds[1]);
    points.0.push(best);
    points.0.extend(above.0);
    points.0.sort_by(|a, b| a.value.total_cmp(&b.value));
    let near = |end: f64, side: f64| {
        let wanted = inner(interval.scale, interval.value) + side * interval.half_width;
        (inner(interval.scale, end) - wanted).abs() < PARABOLA * interval.half_width
    };
    let open = [low_open, high_open];
    let parabolic = !low_open && !high_open && near(low, -1.0) && near(high, 1.0);
    Ok(Profile {
        name: interval.name,
        unit: interval.unit,
        points: points.0,
        limit,
        low,
        high,
        open,
        parabolic,
        evaluations,
    })
}

/// Twice the loss in log-likelihood per relative change of cost, so that the curvature is that of the covariance: the cost of a held
/// parameter grows by the inverse of its entry in `(J' W J)^-1` times the square of its distance.
fn rate(problem: &dyn Separable, fit: &Fit, sure: &Uncertainty, index: usize, cost: f64) -> f64 {
    let mut weighted: DMatrix<f64> = inner_jacobian(problem, fit);
    for (mut row, weight) in weighted.row_iter_mut().zip(&fit.weights) {
        row *= weight.sqrt();
    }
    let growth = crate::fit::cramer_rao::inverse(&weighted.tr_mul(&weighted))
        .map(|inverse| 1.0 / inverse[(index, index)]);
    let wanted = 1.0 / sure.covariance[(index, index)];
    growth.map_or(sure.effective_rows, |growth| wanted * cost / growth)
}

impl Walk<'_> {
    fn interval(&self) -> &Interval {
        &self.sure.intervals[self.index]
    }

    /// The loss where the parameter is held at an inner coordinate, and the evaluations it took. The others start where the covariance
    /// expects them.
    fn loss(&self, coordinate: f64) -> Result<(ProfilePoint, usize), FitError> {
        let interval = self.interval();
        let value = outer(interval.scale, coordinate).clamp(interval.bounds[0], interval.bounds[1]);
        let away = coordinate - inner(interval.scale, interval.value);
        let expected = |(k, other): (usize, &Interval)| {
            let slope = self.sure.covariance[(k, self.index)]
                / self.sure.covariance[(self.index, self.index)];
            let moved = outer(other.scale, inner(other.scale, other.value) + slope * away);
            if moved.is_finite() {
                moved.clamp(other.bounds[0], other.bounds[1])
            } else {
                other.value
            }
        };
        let nonlinear = self.fit.nonlinear.len();
        let start: Vec<f64> = self
            .sure
            .intervals
            .iter()
            .enumerate()
            .take(nonlinear)
            .filter(|(k, _)| *k != self.index)
            .map(expected)
            .collect();
        let part = Fixed::new(self.problem, &[(interval.name, value)])?;
        let held = refit(&part, &start, &self.fit.weights, self.settings)?;
        let cost: f64 = held
            .residual
            .iter()
            .zip(&held.weights)
            .map(|(r, w)| w * r * r)
            .sum();
        let loss = self.rate * (cost / self.cost.max(f64::MIN_POSITIVE)).ln();
        Ok((ProfilePoint { value, loss }, held.evaluations))
    }

    /// Points to one side, outwards, until the loss is beyond the limit or a bound is reached; then one where it should cross it.
    fn side(&self, side: f64) -> Result<(Vec<ProfilePoint>, usize), FitError> {
        let interval = self.interval();
        let here = inner(interval.scale, interval.value);
        let bound = inner(interval.scale, interval.bounds[usize::from(side > 0.0)]);
        let room = (bound - here) * side;
        let mut points: Vec<ProfilePoint> = vec![];
        let mut evaluations = 0;
        let mut distance = 0.5 * interval.half_width;
        while points.len() < POINTS && room > 0.0 {
            distance = distance.min(room);
            let (point, count) = self.loss(here + side * distance)?;
            evaluations += count;
            points.push(point);
            if point.loss >= self.limit || distance >= room {
                break;
            }
            // The root of the loss grows about as the distance does.
            distance *=
                (1.1 * (self.limit / point.loss.max(1e-3 * self.limit)).sqrt()).clamp(1.3, 2.0);
        }
        if points.last().is_some_and(|last| last.loss >= self.limit) {
            let best = ProfilePoint {
                value: interval.value,
                loss: 0.0,
            };
            let (crossing, _) = self.end(best, &points, interval.bounds[usize::from(side > 0.0)]);
            let (point, count) = self.loss(inner(interval.scale, crossing))?;
            evaluations += count;
            points.push(point);
            points.sort_by(|a, b| {
                (a.value - interval.value)
                    .abs()
                    .total_cmp(&(b.value - interval.value).abs())
            });
        }
        Ok((points, evaluations))
    }

    /// Where the loss crosses the limit, by a straight line through its root between two points; or the last point, and that it is open.
    fn end(&self, best: ProfilePoint, points: &[ProfilePoint], bound: f64) -> (f64, bool) {
        let scale: Scale = self.interval().scale;
        let limit = self.limit.sqrt();
        let mut before = best;
        for point in points {
            let (a, b) = (before.loss.max(0.0).sqrt(), point.loss.max(0.0).sqrt());
            if b >= limit {
                let part = ((limit - a) / (b - a)).clamp(0.0, 1.0);
                let (from, to) = (inner(scale, before.value), inner(scale, point.value));
                return (outer(scale, from + part * (to - from)), false);
            }
            before = *point;
        }
        (points.last().map_or(bound, |last| last.value), true)
    }
}

#[cfg(test)]
mod tests;
