//! Piecewise cubics through samples, continuous, with the least largest relative error that a number of parts allows.

use epas_friction::ball::folded::{LoadCurve, PARTS};
use nalgebra::{DMatrix, DVector};

use crate::Failure;

/// Rounds of weights that lead from least squares towards the least largest error (Lawson).
const LAWSON_ROUNDS: usize = 12;

/// Halvings of the logarithm of the tolerance, whose first range is [`TOLERANCES`].
const HALVINGS: usize = 18;
const TOLERANCES: (f64, f64) = (1e-6, 1.0);

/// A function's value at a place, with the weight of its relative error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Place: octaves of a load.
    pub at: f64,
    /// Value, above 0.
    pub value: f64,
    /// Weight of the relative error, above 0.
    pub weight: f64,
}

/// A cubic over a part of the samples.
#[derive(Clone, Copy, Debug)]
struct Cubic {
    start: f64,
    coefficients: [f64; 4],
}

impl Cubic {
    fn at(&self, place: f64) -> f64 {
        let along = place - self.start;
        let [a, b, c, d] = self.coefficients;
        a + along * (b + along * (c + along * d))
    }
}

/// The curve through samples at rising places, and its largest weighted relative error at them.
///
/// Parts are as long as a tolerance allows, from the lowest place upwards, each beginning with the value where the last one ends; the
/// tolerance is the least one with which [`PARTS`] are enough.
pub fn fitted(samples: &[Sample]) -> Result<(LoadCurve, f64), Failure> {
    let rising = samples.windows(2).all(|pair| pair[0].at < pair[1].at);
    let positive = samples.iter().all(|s| s.value > 0.0 && s.weight > 0.0);
    if samples.len() < 4 || !rising || !positive {
        return Err(Failure::Domain(
            "a curve needs four samples or more, at rising places and above zero".into(),
        ));
    }
    let (mut low, mut high) = (TOLERANCES.0.ln(), TOLERANCES.1.ln());
    let mut best = None;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if let Some(parts) = parts(samples, middle.exp()) {
            best = Some(parts);
            high = middle;
        } else {
            low = middle;
        }
    }
    let parts = best.ok_or_else(|| {
        Failure::Domain(format!(
            "{PARTS} parts do not follow the torque over the load"
        ))
    })?;
    let mut curve = LoadCurve {
        starts: [f32::MAX; PARTS],
        cubics: [[0.0; 4]; PARTS],
    };
    for (number, part) in parts.iter().enumerate() {
        curve.starts[number] = part.start as f32;
        curve.cubics[number] = part.coefficients.map(|coefficient| coefficient as f32);
    }
    let error = samples
        .iter()
        .map(|sample| {
            let part = parts.iter().rev().find(|part| part.start <= sample.at);
            let found = part.unwrap_or(&parts[0]).at(sample.at);
            (found / sample.value - 1.0).abs() * sample.weight
        })
        .fold(0.0, f64::max);
    Ok((curve, error))
}

/// Parts within a tolerance, at most [`PARTS`]; `None` where they are not enough.
fn parts(samples: &[Sample], tolerance: f64) -> Option<Vec<Cubic>> {
    let mut parts: Vec<Cubic> = Vec::new();
    let mut from = 0;
    while from + 1 < samples.len() {
        if parts.len() == PARTS {
            return None;
        }
        let start = parts.last().map(|part| part.at(samples[from].at));
        let of = |to: usize| cubic(&samples[from..=to], start);
        let last = samples.len() - 1;
        // The shortest part is followed exactly, as far as its start lets it.
        let (mut within, mut beyond) = (from + 1, last + 1);
        let mut found = of(within).0;
        if let (whole, error) = of(last)
            && error <= tolerance
        {
            (within, beyond, found) = (last, last + 1, whole);
        }
        while beyond - within > 1 {
            let middle = usize::midpoint(within, beyond);
            if middle > last {
                break;
            }
            let (tried, error) = of(middle);
            if error <= tolerance {
                (within, found) = (middle, tried);
            } else {
                beyond = middle;
            }
        }
        parts.push(found);
        from = within;
    }
    Some(parts)
}

/// The cubic of about the least largest weighted relative error through samples, with its value at the first one where that is given; and
/// that error.
fn cubic(samples: &[Sample], start: Option<f64>) -> (Cubic, f64) {
    let origin = samples[0].at;
    let width = samples[samples.len() - 1].at - origin;
    let fixed = usize::from(start.is_some());
    let given = start.unwrap_or(0.0);
    let powers = (4 - fixed).min(samples.len() - fixed);
    let row = |sample: &Sample, column: usize| {
        ((sample.at - origin) / width).powi((column + fixed) as i32) * sample.weight / sample.value
    };
    let matrix = DMatrix::from_fn(samples.len(), powers, |i, j| row(&samples[i], j));
    let wanted = DVector::from_fn(samples.len(), |i, _| {
        let sample = &samples[i];
        (sample.value - given) * sample.weight / sample.value
    });
    let mut weights = DVector::from_element(samples.len(), 1.0);
    let mut best = (DVector::zeros(powers), f64::INFINITY);
    for _ in 0..LAWSON_ROUNDS {
        let weighted = DMatrix::from_fn(samples.len(), powers, |i, j| weights[i] * matrix[(i, j)]);
        let normal = weighted.transpose() * &weighted;
        let right = weighted.transpose() * wanted.component_mul(&weights);
        let Some(factor) = normal.cholesky() else {
            break;
        };
        let solution = factor.solve(&right);
        let errors = (&matrix * &solution - &wanted).abs();
        let largest = errors.max();
        if largest < best.1 {
            best = (solution, largest);
        }
        if largest <= 1e-12 {
            break;
        }
        weights.zip_apply(&errors, |weight, error| {
            *weight *= (0.3 + error / largest).sqrt();
        });
    }
    let (solution, error) = best;
    let mut coefficients = [0.0; 4];
    coefficients[0] = given;
    for (column, value) in solution.iter().enumerate() {
        let power = column + fixed;
        coefficients[power] = value / width.powi(power as i32);
    }
    (
        Cubic {
            start: origin,
            coefficients,
        },
        error,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(of: impl Fn(f64) -> f64) -> Vec<Sample> {
        (0..=400)
            .map(|step| {
                let at = 120.0 + 0.02 * f64::from(step);
                Sample {
                    at,
                    value: of(at),
                    weight: 1.0,
                }
            })
            .collect()
    }

    fn found(curve: &LoadCurve, at: f64) -> f64 {
        let part = curve
            .starts
            .iter()
            .rposition(|&start| f64::from(start) <= at)
            .unwrap();
        let along = at - f64::from(curve.starts[part]);
        let [a, b, c, d] = curve.cubics[part].map(f64::from);
        a + along * (b + along * (c + along * d))
    }

    /// A cubic is one part, exact to the rounding of its coefficients.
    #[test]
    fn a_cubic_is_itself() {
        let cubic = |x: f64| {
            2.0 + 0.1 * (x - 120.0) - 0.01 * (x - 120.0).powi(2) + 1e-3 * (x - 120.0).powi(3)
        };
        let (curve, error) = fitted(&samples(cubic)).unwrap();
        assert!(error < 1e-5, "{error}");
        // 8 octaves: rounding of the coefficients, 2^-24 of terms of at most 2 + 0.8 + 0.64 + 0.51.
        for sample in samples(cubic) {
            assert!((found(&curve, sample.at) / sample.value - 1.0).abs() < 1.2e-5);
        }
    }

    /// Kinks, where parts are placed freely, cost little; the curve has no steps.
    #[test]
    fn kinks_are_followed_without_steps() {
        let kinked = |x: f64| 1.0 + (x - 121.3).abs() + 0.5 * (x - 124.71).abs();
        let (curve, error) = fitted(&samples(kinked)).unwrap();
        assert!(error < 5e-3, "{error}");
        let used = curve
            .starts
            .iter()
            .filter(|&&start| start < f32::MAX)
            .count();
        assert!(used > 2);
        for number in 1..used {
            let border = f64::from(curve.starts[number]);
            let step = found(&curve, border) - found(&curve, border - 1e-4);
            // A slope of 1.5 over 1e-4, and roundings.
            assert!(step.abs() < 4e-4, "{number}: {step}");
        }
    }

    #[test]
    fn what_is_no_curve_is_refused() {
        let good = samples(|x| x);
        assert!(fitted(&good[..3]).is_err());
        let mut bad = good.clone();
        bad.swap(3, 4);
        assert!(fitted(&bad).is_err());
        let mut bad = good;
        bad[7].value = 0.0;
        assert!(fitted(&bad).is_err());
    }
}
