//! Damped Newton minimisation of a convex function, and zeros of a function of one variable.

use nalgebra::{SMatrix, SVector};

/// Value, gradient and Hessian at a point.
pub struct Local<const N: usize> {
    /// Value.
    pub value: f64,
    /// Gradient.
    pub gradient: SVector<f64, N>,
    /// Hessian.
    pub hessian: SMatrix<f64, N, N>,
}

/// Where the minimisation ended.
#[derive(Clone, Copy)]
pub struct Minimum<const N: usize> {
    /// The best point found.
    pub point: SVector<f64, N>,
    /// Largest component of the gradient.
    pub residual: f64,
    /// Newton steps taken.
    pub iterations: usize,
}

const MAX_ITERATIONS: usize = 100;

/// Minimises a convex function from `start` until no component of the gradient exceeds `tolerance`.
///
/// A Newton step is taken when it lowers the value; when the value no longer changes above its rounding,
/// when it lowers the gradient. Otherwise the step is halved, and then the Hessian shifted. Ends after at most 100 steps, at the
/// best point found, which the caller judges by `residual`.
pub fn minimise<const N: usize>(
    start: SVector<f64, N>,
    tolerance: f64,
    f: impl Fn(&SVector<f64, N>) -> Local<N>,
) -> Minimum<N> {
    let mut point = start;
    let mut here = f(&point);
    let mut shift = 1e-14;
    let mut iterations = 0;
    while iterations < MAX_ITERATIONS && here.gradient.amax() > tolerance {
        iterations += 1;
        let mean_curvature = here.hessian.trace() / N as f64;
        if mean_curvature <= 0.0 || !mean_curvature.is_finite() {
            break;
        }
        let shifted = here.hessian + SMatrix::identity() * (shift * mean_curvature);
        let Some(factor) = shifted.cholesky() else {
            shift = (shift * 100.0).max(1e-14);
            if shift > 1e3 {
                break;
            }
            continue;
        };
        let step = -factor.solve(&here.gradient);
        let slope = here.gradient.dot(&step);
        // Terms of both signs may be a hundred times larger than their sum.
        let rounding = 1e-12 * here.value.abs().max(f64::MIN_POSITIVE);
        let mut fraction = 1.0;
        let mut accepted = None;
        while fraction > 1e-10 {
            let there = f(&(point + step * fraction));
            let falls = there.value <= here.value + 1e-4 * fraction * slope;
            let level = (there.value - here.value).abs() <= rounding;
            if falls && !level || level && there.gradient.norm() < here.gradient.norm() {
                accepted = Some(there);
                break;
            }
            fraction *= 0.5;
        }
        if let Some(there) = accepted {
            point += step * fraction;
            here = there;
            shift = (shift * 0.1).max(1e-14);
        } else {
            shift = (shift * 100.0).max(1e-12);
            if shift > 1e3 {
                break;
            }
        }
    }
    Minimum {
        point,
        residual: here.gradient.amax(),
        iterations,
    }
}

/// Stages of the smoothing at rest, each ten times finer: from 0.1 to 1e-8 of the spin scale, which is one. A finer one has no use:
/// the stiffness of a contact at rest, its friction limit over the rest speed, would amplify rounding above the tolerance.
pub const STAGES: usize = 8;

/// Minimises a power that has kinks at rest: smoothed with a spin at rest that falls tenfold from 0.1 to 1e-8, each stage from the
/// result of the last; once everything `moves` the power itself (`rest_spin = 0`) is minimised and the rest skipped.
///
/// Returns the minimum and the rest spin of the power it belongs to.
pub fn sharpen<const N: usize>(
    start: SVector<f64, N>,
    tolerance: f64,
    accept: f64,
    f: impl Fn(&SVector<f64, N>, f64) -> Local<N>,
    moves: impl Fn(&SVector<f64, N>, f64) -> bool,
) -> (Minimum<N>, f64) {
    let mut rest_spin = 0.1;
    let mut iterations = 0;
    let mut point = start;
    let mut stages = 1;
    loop {
        let mut stage = minimise(point, tolerance, |y| f(y, rest_spin));
        iterations += stage.iterations;
        stage.iterations = iterations;
        point = stage.point;
        if moves(&point, rest_spin) {
            let mut exact = minimise(point, tolerance, |y| f(y, 0.0));
            iterations += exact.iterations;
            exact.iterations = iterations;
            if exact.residual <= accept {
                return (exact, 0.0);
            }
        }
        if stages == STAGES {
            return (stage, rest_spin);
        }
        stages += 1;
        rest_spin *= 0.1;
    }
}

/// Zero of a continuous function between two places where it has different signs, to within tolerances of the place or of its
/// value: false position by Anderson and Bjorck, one value a step. `None` where the function has no value or no change of sign.
///
/// The function has been asked for its value at the answer last: what it keeps belongs to the answer, as with none of the roots crate's methods.
pub fn root_between(
    (mut low, mut high): (f64, f64),
    (of_place, of_value): (f64, f64),
    mut f: impl FnMut(f64) -> Option<f64>,
) -> Option<f64> {
    let mut at_low = f(low)?;
    if at_low == 0.0 {
        return Some(low);
    }
    let mut at_high = f(high)?;
    if at_high == 0.0 {
        return Some(high);
    }
    if !(at_low * at_high < 0.0) {
        return None;
    }
    for step in 0..200 {
        // Now and then a bisection, so that no shape of the function takes long.
        let place = if step % 8 == 7 {
            0.5 * (low + high)
        } else {
            (low * at_high - high * at_low) / (at_high - at_low)
        };
        let value = f(place)?;
        if value.abs() <= of_value || (high - low).abs() <= of_place {
            return Some(place);
        }
        if value * at_high < 0.0 {
            (low, at_low) = (high, at_high);
        } else {
            let share = 1.0 - value / at_high;
            at_low *= if share > 0.0 { share } else { 0.5 };
        }
        (high, at_high) = (place, value);
    }
    None
}
