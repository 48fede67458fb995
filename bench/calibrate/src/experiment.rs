//! Design of experiment: which manoeuvre tells a parameter.
//!
//! For each manoeuvre the caller makes the problem that its trace would give, with the expected trace as target. The Fisher
//! information at the start values and the noise then give the interval that a fit would find. Bounds count as a little information,
//! that of an even distribution between them, so that what a manoeuvre does not tell keeps the width of its bounds.
//!
//! | module | what |
//! |---|---|
//! | [`manoeuvre`] | manoeuvres to choose from |
//! | [`wanted`] | which of them tells a parameter of a screw |

pub mod manoeuvre;
pub mod wanted;

use nalgebra::DMatrix;

use crate::experiment::manoeuvre::Manoeuvre;
use crate::fit::cramer_rao::{information, inverse};
use crate::fit::problem::{Scale, Separable, inner, outer};
use crate::fit::search::slopes_at_start;
use epas_page::failure::Failure;

/// Half width of a normal 95 % interval in standard deviations.
const NORMAL: f64 = 1.959964;

/// How well a manoeuvre tells a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Ranked {
    /// The manoeuvre.
    pub manoeuvre: Manoeuvre,
    /// Value that was assumed.
    pub value: f64,
    /// Low end of the 95 % interval that its trace would give.
    pub low: f64,
    /// High end.
    pub high: f64,
    /// Half width in the inner coordinate (logarithm, or value).
    pub half_width: f64,
    /// The half width where all other parameters are known: far below the other one, another parameter hides this one.
    pub half_width_alone: f64,
    /// The parameter that hides this one most, and their correlation.
    pub hidden_by: Option<(&'static str, f64)>,
    /// The other manoeuvre that helps most, and the half width with both.
    pub companion: Option<(Manoeuvre, f64)>,
}

/// What one manoeuvre says.
struct Said {
    manoeuvre: Manoeuvre,
    names: Vec<&'static str>,
    scale: Scale,
    place: usize,
    value: f64,
    bounds: [f64; 2],
    /// Information of its rows, and of the bounds.
    rows: DMatrix<f64>,
    bounded: DMatrix<f64>,
}

/// Ranks manoeuvres by how well they tell the wanted parameter, the best first. `noise` is the autocovariance of a row's error at lags
/// 0, 1, ..., zero beyond; all problems have the same parameters.
///
/// # Errors
///
/// A problem without the wanted parameter, or that cannot be fitted, and noise that no process has.
pub fn rank(
    wanted: &str,
    manoeuvres: &[Manoeuvre],
    make: &dyn Fn(&Manoeuvre) -> Box<dyn Separable>,
    noise: &[f64],
) -> Result<Vec<Ranked>, Failure> {
    let said = manoeuvres
        .iter()
        .map(|manoeuvre| said(wanted, *manoeuvre, make(manoeuvre).as_ref(), noise))
        .collect::<Result<Vec<_>, _>>()?;
    let mut ranked: Vec<Ranked> = said.iter().map(|one| ranked(one, &said)).collect();
    ranked.sort_by(|a, b| a.half_width.total_cmp(&b.half_width));
    Ok(ranked)
}

fn said(
    wanted: &str,
    manoeuvre: Manoeuvre,
    problem: &dyn Separable,
    noise: &[f64],
) -> Result<Said, Failure> {
    let (jacobian, linear) = slopes_at_start(problem)?;
    let nonlinear = problem
        .nonlinear()
        .iter()
        .map(|p| (p.name, p.scale, [p.low, p.high], p.start));
    let others = problem
        .linear()
        .iter()
        .zip(linear)
        .map(|(p, value)| (p.name, Scale::Linear, [p.low, p.high], value));
    let all: Vec<_> = nonlinear.chain(others).collect();
    let place = all.iter().position(|(name, ..)| *name == wanted);
    let place = place.ok_or_else(|| Failure::Data(format!("no parameter is called {wanted}")))?;
    let rows = information(&jacobian, noise)
        .ok_or_else(|| Failure::Data("the information of the rows is not finite".into()))?;
    // Variance of an even distribution: the range's square over 12. A linear parameter without bounds gets a trifle of the rows' own.
    let least = |k: usize, scale: Scale, [low, high]: [f64; 2]| {
        let range = inner(scale, high) - inner(scale, low);
        if range.is_finite() {
            12.0 / (range * range)
        } else {
            1e-12 * rows[(k, k)]
        }
    };
    let bounded = all
        .iter()
        .enumerate()
        .map(|(k, (_, scale, bounds, _))| least(k, *scale, *bounds));
    let bounded = DMatrix::from_diagonal(&nalgebra::DVector::from_iterator(all.len(), bounded));
    let (_, scale, bounds, value) = all[place];
    Ok(Said {
        manoeuvre,
        names: all.iter().map(|(name, ..)| *name).collect(),
        scale,
        place,
        value,
        bounds,
        rows,
        bounded,
    })
}

/// Covariance, parameters without any information left out as if known; their place stays as zeros.
fn covariance(information: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let count = information.nrows();
    let told: Vec<usize> = (0..count).filter(|k| information[(*k, *k)] > 0.0).collect();
    let small = inverse(&DMatrix::from_fn(told.len(), told.len(), |i, j| {
        information[(told[i], told[j])]
    }))?;
    let mut whole = DMatrix::zeros(count, count);
    for (i, into) in told.iter().enumerate() {
        for (j, column) in told.iter().enumerate() {
            whole[(*into, *column)] = small[(i, j)];
        }
    }
    Some(whole)
}

fn half_width(information: &DMatrix<f64>, place: usize) -> f64 {
    match covariance(information) {
        Some(covariance) if covariance[(place, place)] > 0.0 => {
            NORMAL * covariance[(place, place)].sqrt()
        }
        _ => f64::INFINITY,
    }
}

fn ranked(one: &Said, all: &[Said]) -> Ranked {
    let own = &one.rows + &one.bounded;
    let (k, half_width_own) = (one.place, half_width(&own, one.place));
    let strongest = covariance(&own).and_then(|covariance| {
        let correlation =
            |j: usize| covariance[(j, k)] / (covariance[(j, j)] * covariance[(k, k)]).sqrt();
        let others = (0..one.names.len())
            .filter(|j| *j != k)
            .map(|j| (one.names[j], correlation(j)));
        others
            .filter(|(_, value)| value.is_finite())
            .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
    });
    let companions = all
        .iter()
        .filter(|other| other.manoeuvre != one.manoeuvre && other.names == one.names);
    let both = companions.map(|other| (other.manoeuvre, half_width(&(&own + &other.rows), k)));
    let end = |side: f64| {
        outer(
            one.scale,
            inner(one.scale, one.value) + side * half_width_own,
        )
        .clamp(one.bounds[0], one.bounds[1])
    };
    Ranked {
        manoeuvre: one.manoeuvre,
        value: one.value,
        low: end(-1.0),
        high: end(1.0),
        half_width: half_width_own,
        half_width_alone: NORMAL / own[(k, k)].sqrt(),
        hidden_by: strongest,
        companion: both.min_by(|a, b| a.1.total_cmp(&b.1)),
    }
}

#[cfg(test)]
mod tests;
