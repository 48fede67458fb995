//! What a record tells, with the kernel's length and the way after a turn that tell it best.

use super::fit::{Block, Fit, fit};
use super::record::Record;
use super::rows::Rows;
use super::terms::Term;
use crate::trace::channels::moments;

/// Shortest and longest half-width of the kernel, s, its fewest samples, and the ratio of neighbours.
const LENGTHS: [f64; 2] = [6e-3, 0.14];
const FEWEST: usize = 4;
const RATIO: f64 = std::f64::consts::SQRT_2;

/// Ways after a turn that are left out, over the median stroke.
const WAYS: [f64; 6] = [0.0, 1.0 / 64.0, 1.0 / 32.0, 1.0 / 16.0, 0.125, 0.25];

/// That with which the length is chosen.
const FIRST_WAY: usize = 3;

/// Root mean square of a column over the sensor's noise in it, from which on it is told.
const OVER_NOISE: f64 = 10.0;

/// Deviation of the speeds, or of a load's sizes, over their mean, below which they are one.
const ONE: f64 = 0.02;

/// Mean direction from which on a motion goes one way only.
const ONE_WAY: f64 = 0.98;

/// Share of the noise in what the rate of the acceleration says alone that is let pass, as squares.
const NOISY: f64 = 0.05;

/// Way, s, and in lags, that rows of a measured speed keep from a turn; the longest.
const SPARE: [f64; 3] = [0.03, 3.5, 0.25];

/// Rows a parameter needs.
const ROWS: usize = 3;

/// What is wanted beside what a record tells by itself.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wanted {
    /// Terms more.
    pub more: Vec<Term>,
    /// A lag of the motion though its position was measured: the test of a shifted clock.
    pub lag: bool,
    /// Half-width of the kernel, s, and way after a turn, rad or m, in the place of a choice; with the same at twice the length in the
    /// intervals.
    pub kernel: Option<(f64, f64)>,
}

/// What records tell.
#[derive(Clone, Debug)]
pub struct Estimate {
    /// Terms.
    pub terms: Vec<Term>,
    /// Their values.
    pub values: Vec<f64>,
    /// Half of each 95 % interval.
    pub half_widths: Vec<f64>,
    /// The fit with the kernel that was chosen.
    pub fit: Fit,
    /// Half-width of the kernel, s.
    pub length: f64,
    /// Way after a turn that is left out, rad or m.
    pub settling: f64,
    /// Rows of each record; `None` for a run at one speed and a record without any.
    pub rows: Vec<Option<Rows>>,
}

impl Estimate {
    /// Value and half-width of a term.
    pub fn of(&self, term: Term) -> Option<(f64, f64)> {
        let place = self.terms.iter().position(|one| *one == term)?;
        Some((self.values[place], self.half_widths[place]))
    }
}

/// Settings of one fit.
#[derive(Clone, Copy)]
struct Tried {
    length: f64,
    settling: f64,
    spare: f64,
    last: bool,
}

/// What records tell together: rows of each, or one row of a run at one speed. `None` where they tell nothing.
pub fn estimate(records: &[Record], wanted: &Wanted) -> Option<Estimate> {
    let spare = if records.iter().any(|record| record.speed_alone) {
        SPARE[0]
    } else {
        0.0
    };
    with_spare(records, wanted, spare)
}

fn with_spare(records: &[Record], wanted: &Wanted, spare: f64) -> Option<Estimate> {
    let runs = Runs::of(records);
    let stroke = runs.stroke(records);
    if let Some((length, settling)) = wanted.kernel {
        return at_kernel(records, &runs, wanted, [length, settling, spare]);
    }
    let lengths = lengths(records);
    let first = |index: usize| Tried {
        length: lengths[index],
        settling: WAYS[FIRST_WAY] * stroke,
        spare,
        last: index + 1 == lengths.len(),
    };
    let by_length: Vec<Estimate> = (0..lengths.len())
        .filter_map(|index| one(records, &runs, wanted, first(index)))
        .collect();
    // A kernel of twice the length is two places further.
    let (best, of_length) = best(by_length, 2)?;
    let tried = |way: f64| Tried {
        length: best.length,
        settling: way * stroke,
        spare,
        last: true,
    };
    let by_way: Vec<Estimate> = if stroke > 0.0 {
        WAYS.iter()
            .filter_map(|way| one(records, &runs, wanted, tried(*way)))
            .filter(|estimate| estimate.terms == best.terms)
            .collect()
    } else {
        Vec::new()
    };
    let (mut best, of_way) = self::best(by_way, 1).unwrap_or_else(|| {
        let none = vec![0.0; best.values.len()];
        (best, none)
    });
    if spare > 0.0
        && let Some((lag, _)) = best.of(Term::Lag)
        && 3.0 * lag > 1.2 * spare
        && spare < SPARE[2]
    {
        return with_spare(records, wanted, (SPARE[1] * lag).min(SPARE[2]));
    }
    let apart = apart(records, wanted, &best);
    for (k, half) in best.half_widths.iter_mut().enumerate() {
        *half = half.hypot(of_length[k]).hypot(of_way[k]).hypot(apart[k]);
    }
    Some(best)
}

/// What channels that are sampled up to half a tick apart move each number by: an effort that is later by a time `D` is less by
/// `D (J x''' + b x'' + tau')`, which the columns explain in part. `D` is half a tick, or what the records themselves tell of it where that is
/// less. An effort that a controller holds for a tick acts half a tick later than it is written down.
fn apart(records: &[Record], wanted: &Wanted, best: &Estimate) -> Vec<f64> {
    let none = vec![0.0; best.values.len()];
    let (Some((inertia, _)), None) = (best.of(Term::Inertia), best.of(Term::Lag)) else {
        return none;
    };
    let drag = best.of(Term::Viscous).map_or(0.0, |(drag, _)| drag);
    let changed = |record: &Record, rows: &Rows| {
        let mut block = Block::of(record, rows, &best.terms);
        let motion = |k: usize| rows.sums(record.order(k), &record.motion);
        let of_motion = motion(3).into_iter().zip(motion(2));
        block.target = of_motion
            .map(|(jerk, acceleration)| inertia * jerk + drag * acceleration)
            .collect();
        if let Some(load) = record.load.as_deref().filter(|_| record.load_is_effort) {
            for (target, rate) in block.target.iter_mut().zip(rows.sums(1, load)) {
                *target += rate;
            }
        }
        block
    };
    let pairs = records.iter().zip(&best.rows);
    let blocks: Vec<Block> = pairs
        .filter_map(|(record, rows)| Some(changed(record, rows.as_ref()?)))
        .collect();
    if blocks.is_empty() {
        return none;
    }
    let late = Wanted {
        lag: true,
        kernel: Some((best.length, best.settling)),
        ..wanted.clone()
    };
    let told = estimate(records, &late).and_then(|late| late.of(Term::Lag));
    let told = told.map_or(f64::INFINITY, |(lag, half)| lag.abs() + half);
    let tick = records.iter().map(|record| record.tick).fold(0.0, f64::max);
    let shift = told.min(0.5 * tick);
    let slopes = fit(&blocks, &<[f64]>::to_vec).values;
    slopes.iter().map(|slope| (shift * slope).abs()).collect()
}

/// The fit with one kernel, and twice what one of twice the length says otherwise in its intervals.
fn at_kernel(
    records: &[Record],
    runs: &Runs,
    wanted: &Wanted,
    [length, settling, spare]: [f64; 3],
) -> Option<Estimate> {
    let tried = |length: f64| Tried {
        length,
        settling,
        spare,
        last: true,
    };
    let mut found = one(records, runs, wanted, tried(length))?;
    if let Some(other) = one(records, runs, wanted, tried(2.0 * length))
        && other.terms == found.terms
    {
        let values = found.values.iter().zip(&other.values);
        for (half, (value, other)) in found.half_widths.iter_mut().zip(values) {
            *half = half.hypot(2.0 * (value - other));
        }
    }
    Some(found)
}

/// Half-widths of the kernel that are tried, s.
fn lengths(records: &[Record]) -> Vec<f64> {
    let tick = records.iter().map(|record| record.tick).fold(0.0, f64::max);
    let shortest = LENGTHS[0].max(FEWEST as f64 * tick);
    let longest = LENGTHS[1].max(4.0 * shortest);
    std::iter::successors(Some(shortest), |length| Some(length * RATIO))
        .take_while(|length| *length <= longest)
        .collect()
}

/// Which records are runs at one speed, each one row.
struct Runs(Vec<bool>);

impl Runs {
    /// All that are, where there are several records: one alone is told by its own rows.
    fn of(records: &[Record]) -> Self {
        let several = records.len() > 1;
        let runs = records.iter();
        Self(
            runs.map(|record| several && record.one_speed().is_some())
                .collect(),
        )
    }

    /// Median of the strokes between turns of the others, rad or m; 0 where there are none.
    fn stroke(&self, records: &[Record]) -> f64 {
        let others = records.iter().zip(&self.0).filter(|(_, run)| !**run);
        let mut strokes: Vec<f64> = others
            .filter_map(|(record, _)| Rows::of(record, 8, 0.0, 0))
            .map(|rows| rows.stroke)
            .collect();
        strokes.sort_by(f64::total_cmp);
        strokes.get(strokes.len() / 2).copied().unwrap_or(0.0)
    }
}

/// One fit, without the systematic share.
fn one(records: &[Record], runs: &Runs, wanted: &Wanted, tried: Tried) -> Option<Estimate> {
    let samples = |time: f64, record: &Record| (time / record.tick).round() as usize;
    let rows: Vec<Option<Rows>> = records
        .iter()
        .zip(&runs.0)
        .map(|(record, run)| {
            let half = samples(tried.length, record).max(FEWEST);
            let spare = samples(tried.spare, record);
            let rows = (!run).then(|| Rows::of(record, half, tried.settling, spare));
            rows.flatten().filter(|rows| rows.len() >= ROWS)
        })
        .collect();
    let terms = terms(records, runs, &rows, wanted)?;
    let blocks: Vec<Block> = records
        .iter()
        .zip(runs.0.iter().zip(&rows))
        .filter_map(|(record, (run, rows))| match rows {
            Some(rows) => Some(Block::of(record, rows, &terms)),
            // As many rows as a kernel would make of it.
            None if *run => {
                let seconds = record.len() as f64 * record.tick;
                Block::of_run(
                    record,
                    &terms,
                    (ROWS as f64 * seconds / tried.length).max(1.0),
                )
            }
            None => None,
        })
        .collect();
    let count: usize = blocks.iter().map(|block| block.target.len()).sum();
    let enough = if runs.0.contains(&true) {
        terms.len() + 1
    } else {
        ROWS * terms.len()
    };
    let mut groups: usize = 0;
    for block in &blocks {
        let mut numbers = block.pieces.clone();
        numbers.dedup();
        groups += numbers.len();
    }
    if count < enough || groups <= terms.len() || terms.is_empty() {
        return None;
    }
    if !tried.last && terms.contains(&Term::Lag) && noisy(records, &rows, &blocks, &terms) {
        return None;
    }
    let fit = fit(&blocks, &|coefficients| meaning(&terms, coefficients));
    if !fit
        .values
        .iter()
        .chain(&fit.half_widths)
        .all(|x| x.is_finite())
    {
        return None;
    }
    Some(Estimate {
        values: fit.values.clone(),
        half_widths: fit.half_widths.clone(),
        terms,
        fit,
        length: tried.length,
        settling: tried.settling,
        rows,
    })
}

/// Inertia and lag from the coefficients `J + b D` and `J D` of `(J s + b)(1 + D s)`: the smaller root.
fn meaning(terms: &[Term], coefficients: &[f64]) -> Vec<f64> {
    let mut values = coefficients.to_vec();
    let place = |term: Term| terms.iter().position(|one| *one == term);
    if let (Some(inertia), Some(viscous), Some(lag)) =
        (place(Term::Inertia), place(Term::Viscous), place(Term::Lag))
    {
        let [both, drag, product] = [inertia, viscous, lag].map(|place| coefficients[place]);
        // b D^2 - (J + b D) D + J D = 0, as a series of D = product/(both - b D).
        let mut delay = product / both;
        for _ in 0..20 {
            delay = product / (both - drag * delay);
        }
        values[inertia] = both - drag * delay;
        values[lag] = delay;
    }
    values
}

/// The fit with the smallest product of its intervals, joined with twice what the one `step` places further says otherwise; and that share.
fn best(mut tried: Vec<Estimate>, step: usize) -> Option<(Estimate, Vec<f64>)> {
    let most = tried.iter().map(|one| one.terms.len()).max()?;
    tried.retain(|one| one.terms.len() == most);
    let shares: Vec<Vec<f64>> = (0..tried.len())
        .map(|index| {
            let other = tried.get(index + step);
            let other = other.unwrap_or(&tried[index.saturating_sub(step)]);
            let pairs = tried[index].values.iter().zip(&other.values);
            pairs
                .map(|(one, other)| 2.0 * (one - other).abs())
                .collect()
        })
        .collect();
    let score = |index: usize| -> f64 {
        let halves = tried[index].half_widths.iter().zip(&shares[index]);
        halves
            .map(|(half, share)| half.hypot(*share).max(f64::MIN_POSITIVE).ln())
            .sum()
    };
    let index = (0..tried.len()).min_by(|one, other| score(*one).total_cmp(&score(*other)))?;
    let share = shares.into_iter().nth(index)?;
    Some((tried.swap_remove(index), share))
}

/// Root mean square over all rows.
fn size(columns: &[Vec<f64>]) -> f64 {
    let count: usize = columns.iter().map(Vec::len).sum();
    let squares: f64 = columns.iter().flatten().map(|x| x * x).sum();
    (squares / count.max(1) as f64).sqrt()
}

/// The terms that records tell: those whose columns stand over the sensor's noise and differ from one another.
fn terms(
    records: &[Record],
    runs: &Runs,
    rows: &[Option<Rows>],
    wanted: &Wanted,
) -> Option<Vec<Term>> {
    let basic = [
        Term::Inertia,
        Term::Viscous,
        Term::Coulomb,
        Term::Driving,
        Term::BackDriving,
    ];
    let blocks: Vec<Block> = records
        .iter()
        .zip(runs.0.iter().zip(rows))
        .filter_map(|(record, (run, rows))| match rows {
            Some(rows) => Some(Block::of(record, rows, &basic)),
            None if *run => Block::of_run(record, &basic, 1.0),
            None => None,
        })
        .collect();
    if blocks.is_empty() {
        return None;
    }
    let column = |place: usize| -> Vec<Vec<f64>> {
        blocks
            .iter()
            .map(|block| block.columns[place].clone())
            .collect()
    };
    let noise = |place: usize| -> f64 {
        let of = blocks.iter().map(|block| block.noise[(place, place)]);
        (of.sum::<f64>() / blocks.len() as f64).sqrt()
    };
    let told = |place: usize| size(&column(place)) > (OVER_NOISE * noise(place)).max(1e-12);
    let mut terms = Vec::new();
    let speeds = column(1);
    let (mean, spread) = moments(speeds.iter().flatten().map(|speed| speed.abs()));
    let one_speed = spread < ONE * mean || !told(1);
    if !one_speed {
        if told(0) {
            terms.push(Term::Inertia);
        }
        terms.push(Term::Viscous);
    }
    let directions = column(2);
    let (mean, _) = moments(directions.iter().flatten().copied());
    if mean.abs() < ONE_WAY {
        terms.push(Term::Offset);
    }
    terms.push(if one_speed {
        Term::OneSpeed
    } else {
        Term::Coulomb
    });
    if records.iter().all(|record| record.load.is_some()) {
        let sizes = column(3).into_iter().zip(column(4));
        let sizes: Vec<f64> = sizes
            .flat_map(|(one, other)| {
                let both = one.into_iter().zip(other);
                both.map(|(one, other)| one.abs() + other.abs())
                    .collect::<Vec<_>>()
            })
            .collect();
        let (mean, spread) = moments(sizes.iter().copied());
        let changes = spread >= ONE * mean && mean > 0.0;
        let own = records.iter().all(|record| record.load_is_effort);
        let quadrant = |place: usize| size(&column(place)) > ONE * mean;
        if own && changes {
            let quadrants = [
                (Term::Driving, quadrant(3)),
                (Term::BackDriving, quadrant(4)),
            ];
            terms.extend(
                quadrants
                    .iter()
                    .filter(|(_, there)| *there)
                    .map(|(term, _)| *term),
            );
        } else if !own {
            terms.push(Term::Gain);
            if changes {
                terms.push(Term::Loss);
            }
        }
    }
    terms.extend(&wanted.more);
    let late = wanted.lag || records.iter().any(|record| record.speed_alone);
    if late && terms.contains(&Term::Inertia) && terms.contains(&Term::Viscous) {
        terms.push(Term::Lag);
    }
    Some(terms)
}

/// Whether the rate of the acceleration is more noise than motion: what a kernel longer by a square root of two says otherwise, over what it
/// says beyond the other columns.
fn noisy(records: &[Record], rows: &[Option<Rows>], blocks: &[Block], terms: &[Term]) -> bool {
    let Some(place) = terms.iter().position(|term| *term == Term::Lag) else {
        return false;
    };
    let placed = records.iter().zip(rows).filter_map(|(record, rows)| {
        let rows = rows.as_ref()?;
        let half = (RATIO * rows.kernel.half() as f64) as usize;
        let kernel = super::kernel::Kernel::new(half, record.tick);
        let order = record.order(3);
        let sums = |kernel: &super::kernel::Kernel| -> Vec<f64> {
            let at = |centre: &usize| kernel.at(order, &record.motion, *centre);
            rows.centres.iter().map(at).collect()
        };
        Some((sums(&rows.kernel), sums(&kernel)))
    });
    let noise: f64 = placed
        .flat_map(|(one, other)| one.into_iter().zip(other))
        .map(|(one, other)| (one - other).powi(2))
        .sum();
    let alone: Vec<Block> = blocks
        .iter()
        .map(|block| {
            let mut block = block.clone();
            block.target = block.columns.remove(place);
            block.noise = nalgebra::DMatrix::zeros(0, 0);
            block
        })
        .collect();
    let own = fit(&alone, &<[f64]>::to_vec);
    let own: f64 = own.residual.iter().map(|r| r * r).sum();
    noise > NOISY * own
}
