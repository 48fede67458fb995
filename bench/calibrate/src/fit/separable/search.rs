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

/// Rounds of starts.
const ROUNDS: usize = 2;

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

/// The best point from all starts under one set of weights. Where only one start has found it, and not the given one, as many starts
/// again are tried.
pub(super) fn search(
    model: &Model,
    count: usize,
    finished: usize,
    roots: &[f64],
) -> Result<Found, FitError> {
    let parameters = model.problem.nonlinear();
    let others = if parameters.is_empty() { 0 } else { count - 1 };
    let mut begins: Vec<Vec<f64>> =
        vec![parameters.iter().map(|parameter| parameter.start).collect()];
    let mut ends = vec![];
    let mut rounds = 1..=ROUNDS;
    loop {
        let last = rounds.next().is_none_or(|round| {
            let even = starts::fractions(round * others, parameters.len());
            let new = even
                .iter()
                .skip(begins.len() - 1)
                .map(|point| model.coordinates.at(point));
            begins.extend(new.collect::<Vec<_>>());
            round == ROUNDS
        });
        for begin in &begins[ends.len()..] {
            let point = first(model, begin, roots)?;
            // One start needs no coarse pass.
            ends.push(if others > 0 {
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
        let best = order[best];
        let verdict = verdict(model, roots, (best, &ends), &outcomes);
        if last || verdict != (Verdict::FoundOnce { given: false }) {
            let starts = starts_of(begins, &ends, outcomes);
            return Ok(Found {
                best: ends.swap_remove(best),
                starts,
                verdict,
            });
        }
    }
}

fn starts_of(begins: Vec<Vec<f64>>, ends: &[Point], outcomes: Vec<Outcome>) -> Vec<Start> {
    let start = |((start, end), outcome): ((Vec<f64>, &Point), Outcome)| Start {
        start,
        end: end.values.clone(),
        residual_rms: (end.cost / end.projection.residual.len() as f64).sqrt(),
        outcome,
    };
    begins
        .into_iter()
        .zip(ends)
        .zip(outcomes)
        .map(start)
        .collect()
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
    (best, ends): (usize, &[Point]),
    outcomes: &[Outcome],
) -> Verdict {
    let with = |wanted: Outcome| {
        ends.iter()
            .zip(outcomes)
            .filter(move |(_, outcome)| **outcome == wanted)
    };
    let agreed = with(Outcome::Best).count();
    if let Some((rival, _)) = with(Outcome::Rival).next() {
        let known = starts::neighbourhood(model, &ends[best], roots);
        let inner = model.coordinates.inner(&rival.values);
        Verdict::DependsOnStart {
            names: starts::differing(model.problem, &known, &inner),
        }
    } else if outcomes.len() == 1 {
        Verdict::Single
    } else if agreed > 1 {
        Verdict::Agreed(agreed)
    } else {
        Verdict::FoundOnce { given: best == 0 }
    }
}
