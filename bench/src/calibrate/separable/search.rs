//! The best point of several starts: all go down coarsely, the best of them to the end, until the best is found twice.

use super::checks::{self, FitError};
use super::descent::{Effort, Neighbourhood, descend};
use super::model::{Model, Point};
use super::starts::{self, Outcome, Start, Verdict};

/// A coarse pass: enough to see which valley a start lies in.
const COARSE: Effort = Effort {
    tolerance: 1e-3,
    slopes: 4,
    points: 8,
    both: false,
};

/// A whole descent.
pub(super) const FINE: Effort = Effort {
    tolerance: 1e-8,
    slopes: 30,
    points: 60,
    both: true,
};

/// The point at a start, with the model's shape checked.
pub(super) fn first(model: &Model, start: &[f64], roots: &[f64]) -> Result<Point, FitError> {
    let outer = model.coordinates.start(start);
    let values = model.coordinates.values(&outer);
    let point = model.point(outer, values, roots);
    checks::check_shape(model.problem, &point.evaluation)?;
    Ok(point)
}

/// What the starts have found.
pub(super) struct Found {
    pub(super) best: Point,
    pub(super) starts: Vec<Start>,
    pub(super) verdict: Verdict,
}

/// The best point from all starts under one set of weights.
pub(super) fn search(
    model: &Model,
    count: usize,
    finished: usize,
    roots: &[f64],
) -> Result<Found, FitError> {
    let parameters = model.problem.nonlinear();
    let given: Vec<f64> = parameters.iter().map(|parameter| parameter.start).collect();
    let others = if parameters.is_empty() { 0 } else { count - 1 };
    let mut begins = vec![given];
    begins.extend(
        starts::fractions(others, parameters.len())
            .iter()
            .map(|point| model.coordinates.at(point)),
    );
    let mut ends = Vec::with_capacity(begins.len());
    for begin in &begins {
        let point = first(model, begin, roots)?;
        // One start needs no coarse pass.
        ends.push(if begins.len() > 1 {
            descend(model, point, roots, COARSE, None).0
        } else {
            point
        });
    }
    let mut order: Vec<usize> = (0..begins.len()).filter(|k| ends[*k].finite).collect();
    order.sort_by(|a, b| ends[*a].cost.total_cmp(&ends[*b].cost));
    if order.is_empty() {
        return Err(FitError::NoStart);
    }
    let (best, outcomes) = finish(model, finished, roots, &mut ends, &order);
    let best_point = ends[order[best]].clone();
    let verdict = verdict(model, roots, &best_point, &ends, &outcomes);
    let rows = roots.len() as f64;
    let starts = begins
        .into_iter()
        .zip(&ends)
        .zip(outcomes)
        .map(|((start, end), outcome)| Start {
            start,
            end: end.values.clone(),
            residual_rms: (end.cost / rows).sqrt(),
            outcome,
        })
        .collect();
    Ok(Found {
        best: best_point,
        starts,
        verdict,
    })
}

/// Finishes starts in the order of their coarse costs until the best is found twice, or all are done. Gives the place of the best in
/// the order, and the outcome of every start.
fn finish(
    model: &Model,
    finished: usize,
    roots: &[f64],
    ends: &mut [Point],
    order: &[usize],
) -> (usize, Vec<Outcome>) {
    let mut outcomes = vec![Outcome::Coarse; ends.len()];
    let mut best: Option<(usize, Neighbourhood)> = None;
    for (place, k) in order.iter().enumerate() {
        let known = best.as_ref().map(|(_, neighbourhood)| neighbourhood);
        let (end, reached) = descend(model, ends[*k].clone(), roots, FINE, known);
        ends[*k] = end;
        outcomes[*k] = Outcome::Best;
        let better = !reached && known.is_none_or(|known| ends[*k].cost < known.cost);
        if better {
            best = Some((place, starts::neighbourhood(model, &ends[*k], roots)));
            // What was finished before is judged by the new best.
            if let Some((_, known)) = &best {
                for earlier in &order[..place] {
                    outcomes[*earlier] = starts::outcome(model, known, &ends[*earlier]);
                }
            }
        } else if let (Some(known), false) = (known, reached) {
            outcomes[*k] = starts::outcome(model, known, &ends[*k]);
        }
        let twice = outcomes
            .iter()
            .filter(|outcome| **outcome == Outcome::Best)
            .count()
            > 1;
        if place + 1 >= finished && (twice || outcomes.contains(&Outcome::Rival)) {
            break;
        }
    }
    (best.map_or(0, |(place, _)| place), outcomes)
}

fn verdict(
    model: &Model,
    roots: &[f64],
    best: &Point,
    ends: &[Point],
    outcomes: &[Outcome],
) -> Verdict {
    let rivals: Vec<&Point> = ends
        .iter()
        .zip(outcomes)
        .filter(|(_, outcome)| **outcome == Outcome::Rival)
        .map(|(end, _)| end)
        .collect();
    let agreed = outcomes
        .iter()
        .filter(|outcome| **outcome == Outcome::Best)
        .count();
    if let Some(rival) = rivals.first() {
        let known = starts::neighbourhood(model, best, roots);
        let inner = model.coordinates.inner(&rival.values);
        Verdict::DependsOnStart {
            names: starts::differing(model.problem, &known, &inner),
        }
    } else if outcomes.len() == 1 {
        Verdict::Single
    } else if agreed > 1 {
        Verdict::Agreed(agreed)
    } else {
        Verdict::FoundOnce
    }
}
