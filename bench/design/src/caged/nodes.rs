//! Friction coefficients of the nodes of a range, and by how much loads are shifted between them.
//!
//! A contact opens under a load that depends on the friction coefficient, and not as a power of it: below some coefficient it is open under every
//! load. Where nodes at equal ratios leave more than [`ENOUGH`] between them, they lie where the largest error between two of them is least.

use epas_friction::ball::folded::{log2_biased, shifted_part};
use rayon::prelude::*;

use super::{Exact, LARGEST_ERROR, NODES, SHIFT, SPARSE, loads};
use crate::curve::Sample;

/// Friction coefficients that are tried, at equal ratios: those of even nodes are among them.
const TRIED: usize = 4 * (NODES - 1) + 1;

/// Least distance of two nodes among them: a law refuses coefficients that are alike.
const CLOSEST: usize = 2;

/// Largest relative error between two even nodes with which they stay: that from which on a domain is refused.
const ENOUGH: f64 = LARGEST_ERROR;

/// Most octaves by which loads are shifted between two nodes that are placed, and shifts in an octave that are tried.
const REACH: i32 = 4;
const PER_OCTAVE: i32 = 10;

/// Nodes of a range, with what aligns them where that is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Nodes<const N: usize> {
    /// Friction coefficients, rising.
    pub frictions: [f32; N],
    /// Shift from each node to the next, octaves, of both branches; without it that with which the middle of two nodes is met best.
    pub shifts: Option<[[f64; 2]; N]>,
    /// Octaves above the largest load up to which a node is fitted.
    pub reach: f64,
}

impl<const N: usize> Nodes<N> {
    /// Nodes whose shifts are not known.
    pub const fn aligned_later(frictions: [f32; N]) -> Self {
        let reach = if N == 1 { 0.0 } else { SHIFT };
        Self {
            frictions,
            shifts: None,
            reach,
        }
    }
}

impl Nodes<NODES> {
    /// Nodes from the least to the largest friction coefficient.
    pub fn placed(
        exact: &Exact,
        [low, high]: [f32; 2],
        [least, most]: [f64; 2],
        from: f64,
    ) -> Self {
        let ratio = f64::from(high) / f64::from(low);
        let friction = |part: f64| (f64::from(low) * ratio.powf(part)) as f32;
        let even = std::array::from_fn(|node| friction(node as f64 / (NODES - 1) as f64));
        let even = Self::aligned_later(even);
        let loads: Vec<f64> = loads(least, most * f64::from(REACH).exp2())
            .into_iter()
            .step_by(SPARSE)
            .collect();
        let tried: Vec<f32> = (0..TRIED)
            .map(|tried| friction(tried as f64 / (TRIED - 1) as f64))
            .collect();
        let solved = [1.0, -1.0].map(|side| {
            tried
                .par_iter()
                .map(|&friction| exact.samples(friction, side, &loads, least).ok())
                .collect::<Option<Vec<_>>>()
        });
        // Where some coefficient has no answer, the certificate decides.
        let [Some(drive), Some(backdrive)] = solved else {
            return even;
        };
        let end = log2_biased((most + exact.lift_off) as f32).into();
        let tables = [drive, backdrive].map(|solved| Table { solved, from, end });
        Self::least_error(&tables, &tried).unwrap_or(even)
    }

    /// The nodes with the least largest error among those tried; `None` where even ones are enough.
    fn least_error(tables: &[Table; 2], tried: &[f32]) -> Option<Self> {
        let even = (0..NODES - 1).map(|node| {
            let errors = tables.iter().map(|table| table.error_of_even(node));
            errors.fold(0.0, f64::max)
        });
        if even.fold(0.0, f64::max) <= ENOUGH {
            return None;
        }
        let found: Vec<Vec<[Shifted; 2]>> = (0..TRIED)
            .into_par_iter()
            .map(|low| {
                let highs = low + 1..TRIED;
                highs
                    .map(|high| [0, 1].map(|branch| tables[branch].best(low, high)))
                    .collect()
            })
            .collect();
        let between = |low: usize, high: usize| found[low][high - low - 1];
        let error = |low: usize, high: usize| {
            if high < low + CLOSEST {
                return f64::INFINITY;
            }
            let [drive, backdrive] = between(low, high);
            drive.error.max(backdrive.error)
        };
        let places = path(error);
        let shifts = std::array::from_fn(|node| {
            places.get(node + 1).map_or([0.0; 2], |&high| {
                between(places[node], high).map(|found| found.shift)
            })
        });
        Some(Self {
            frictions: places.map(|place| tried[place]),
            shifts: Some(shifts),
            reach: REACH.into(),
        })
    }
}

/// Places from the first to the last between which the largest error is least.
fn path(error: impl Fn(usize, usize) -> f64) -> [usize; NODES] {
    let mut least = vec![[(f64::INFINITY, 0); TRIED]; NODES];
    least[0][0] = (0.0, 0);
    for node in 1..NODES {
        for high in node..TRIED {
            least[node][high] = (0..high)
                .map(|low| (least[node - 1][low].0.max(error(low, high)), low))
                .min_by(|one, other| one.0.total_cmp(&other.0))
                .unwrap_or((f64::INFINITY, 0));
        }
    }
    let mut places = [TRIED - 1; NODES];
    for node in (1..NODES).rev() {
        places[node - 1] = least[node][places[node]].1;
    }
    places
}

#[derive(Clone, Copy, Debug)]
struct Shifted {
    shift: f64,
    error: f64,
}

struct Table {
    solved: Vec<Vec<Sample>>,
    /// Octaves from which on loads are shifted, and those of the largest load.
    from: f64,
    end: f64,
}

impl Table {
    /// The shift with the least largest error at the coefficients between two.
    fn best(&self, low: usize, high: usize) -> Shifted {
        let most = REACH * PER_OCTAVE;
        (-most..=most)
            .map(|step| f64::from(step) / f64::from(PER_OCTAVE))
            .map(|shift| Shifted {
                shift,
                error: self.error(low, high, shift),
            })
            .min_by(|one, other| {
                let by_error = one.error.total_cmp(&other.error);
                by_error.then(one.shift.abs().total_cmp(&other.shift.abs()))
            })
            .unwrap_or(Shifted {
                shift: 0.0,
                error: f64::INFINITY,
            })
    }

    /// Largest relative error between an even node and the next, as they are aligned.
    fn error_of_even(&self, node: usize) -> f64 {
        let step = (TRIED - 1) / (NODES - 1);
        let [low, middle, high] =
            [2 * node, 2 * node + 1, 2 * node + 2].map(|halves| halves * step / 2);
        let [below, between, above] = [low, middle, high].map(|place| &self.solved[place][..]);
        self.error(low, high, aligned(below, between, above, self.from))
    }

    /// Largest relative error of the blend of two nodes at the coefficients between them.
    fn error(&self, low: usize, high: usize, shift: f64) -> f64 {
        let mut largest = 0.0_f64;
        for between in low + 1..high {
            let share = (between - low) as f64 / (high - low) as f64;
            let held = |sample: &&Sample| sample.weight == 1.0 && sample.at <= self.end;
            for sample in self.solved[between].iter().filter(held) {
                let ends = [&self.solved[low][..], &self.solved[high]];
                let blended = blended(ends, sample.at, share, shift, self.from);
                largest = largest.max((blended / sample.value - 1.0).abs());
            }
        }
        largest
    }
}

/// What a step computes from two nodes, a share of the way from the lower one to the higher.
fn blended([low, high]: [&[Sample]; 2], place: f64, share: f64, shift: f64, from: f64) -> f64 {
    let shift = shift * f64::from(shifted_part((place - from) as f32));
    let low = at(low, place - share * shift);
    low + share * (at(high, place + (1.0 - share) * shift) - low)
}

fn at(samples: &[Sample], place: f64) -> f64 {
    let above = samples.partition_point(|sample| sample.at < place);
    let [below, above] =
        [above.saturating_sub(1), above.min(samples.len() - 1)].map(|number| samples[number]);
    if above.at > below.at {
        let share = ((place - below.at) / (above.at - below.at)).clamp(0.0, 1.0);
        below.value + share * (above.value - below.value)
    } else {
        below.value
    }
}

/// The shift in octaves with which the middle of two nodes is best met by the nodes moved towards each other by half of it.
pub(super) fn aligned(low: &[Sample], middle: &[Sample], high: &[Sample], from: f64) -> f64 {
    let error = |shift: f64| -> f64 {
        middle
            .iter()
            .filter(|sample| sample.weight == 1.0)
            .map(|sample| {
                let half = 0.5 * shift * f64::from(shifted_part((sample.at - from) as f32));
                let blended = 0.5 * (at(low, sample.at - half) + at(high, sample.at + half));
                (blended / sample.value - 1.0).powi(2)
            })
            .sum()
    };
    let steps = 240;
    (-steps..=steps)
        .map(|step| 2.0 * SHIFT * f64::from(step) / f64::from(steps))
        .min_by(|a, b| error(*a).total_cmp(&error(*b)))
        .unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The largest error between two nodes is that of the widest gap: five nodes over sixteen gaps of equal error are even.
    #[test]
    fn nodes_are_even_where_errors_are() {
        assert_eq!(path(|low, high| (high - low) as f64), [0, 4, 8, 12, 16]);
    }

    /// Gaps are narrow where errors are large.
    #[test]
    fn nodes_lie_where_errors_are() {
        let place = |at: usize| (at as f64).powi(2);
        let places = path(|low, high| place(high) - place(low));
        assert_eq!((places[0], places[NODES - 1]), (0, TRIED - 1));
        assert!(places[1] >= 7, "{places:?}");
    }
}
