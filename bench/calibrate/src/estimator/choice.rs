//! What a record tells, with the kernel's length and the way after a turn that tell it best.

use super::fit::{Block, Fit, dot, fit, quantile, rms};
use super::kernel::Kernel;
use super::record::Record;
use super::rows::Rows;
use super::terms::Term;
use crate::trace::channels::{median, moments};

/// Shortest and longest half-width of the kernel, s, its fewest samples, and the ratio of neighbours.
const LENGTHS: [f64; 2] = [6e-3, 0.14];
const FEWEST: usize = 4;
const RATIO: f64 = std::f64::consts::SQRT_2;

/// Ways after a turn that are left out, over the median stroke.
const WAYS: [f64; 6] = [0.0, 1.0 / 64.0, 1.0 / 32.0, 1.0 / 16.0, 0.125, 0.25];

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

const ROWS: usize = 3;

/// Distance from zero over the interval from which on a term beside the equation is there: the systematic share of an interval is known by one
/// comparison only.
const SURE: f64 = 1.5;

/// What is wanted beside what a record tells by itself.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wanted {
    pub more: Vec<Term>,
    /// A lag of the motion though its position was measured: the test of a shifted clock.
    pub lag: bool,
    /// Half-width of the kernel, s, and way after a turn, rad or m, in the place of a choice; with the same at twice the length in the
    /// intervals.
    pub kernel: Option<(f64, f64)>,
}

#[derive(Clone, Debug)]
pub struct Estimate {
    pub terms: Vec<Term>,
    pub values: Vec<f64>,
    /// Half of each 95 % interval.
    pub half_widths: Vec<f64>,
    pub fit: Fit,
    /// Half-width of the kernel, s.
    pub length: f64,
    /// Way after a turn that is left out, rad or m.
    pub settling: f64,
    /// Rows of each record; `None` for a run at one speed and a record without any.
    pub rows: Vec<Option<Rows>>,
}

impl Estimate {
    pub fn of(&self, term: Term) -> Option<(f64, f64)> {
        let place = self.terms.iter().position(|one| *one == term)?;
        Some((self.values[place], self.half_widths[place]))
    }

    /// A term that is half as far again as its interval from zero, with the interval of all that were tried.
    pub fn surely(&self, term: Term, tried: u32) -> Option<(f64, f64)> {
        let place = self.terms.iter().position(|one| *one == term)?;
        let [own, joint] = [1, tried].map(|count| quantile(self.fit.freedom[place], count));
        let told = self.of(term);
        told.filter(|(value, half)| value.abs() > SURE * half * joint / own)
    }
}

#[derive(Clone, Copy)]
struct Tried {
    length: f64,
    settling: f64,
    spare: f64,
    last: bool,
}

/// What records tell together: rows of each, or one row of a run at one speed. `None` where they tell nothing.
pub fn estimate(records: &[Record], wanted: &Wanted) -> Option<Estimate> {
    let speeds = records.iter().any(|record| record.speed_alone);
    with_spare(
        &Set::of(records),
        wanted,
        if speeds { SPARE[0] } else { 0.0 },
    )
}

fn with_spare(set: &Set<'_>, wanted: &Wanted, spare: f64) -> Option<Estimate> {
    let tried = |length: f64, settling: f64, last: bool| Tried {
        length,
        settling,
        spare,
        last,
    };
    if let Some((length, settling)) = wanted.kernel {
        return at_kernel(set, wanted, tried(length, settling, true));
    }
    let (lengths, stroke) = (set.lengths(), set.stroke());
    let by_length = lengths.iter().enumerate().filter_map(|(k, length)| {
        let last = k + 1 == lengths.len();
        set.fitted(wanted, tried(*length, WAYS[FIRST_WAY] * stroke, last))
    });
    // A kernel of twice the length is two places further.
    let (mut best, of_length) = best(by_length.collect(), 2)?;
    let mut of_way = vec![0.0; best.values.len()];
    if stroke > 0.0 {
        let by_way = WAYS
            .iter()
            .filter_map(|way| set.fitted(wanted, tried(best.length, way * stroke, true)))
            .filter(|estimate| estimate.terms == best.terms);
        if let Some(found) = self::best(by_way.collect(), 1) {
            (best, of_way) = found;
        }
    }
    if spare > 0.0
        && let Some((lag, _)) = best.of(Term::Lag)
        && 3.0 * lag > 1.2 * spare
        && spare < SPARE[2]
    {
        return with_spare(set, wanted, (SPARE[1] * lag).min(SPARE[2]));
    }
    let apart = apart(set.records, wanted, &best);
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
fn at_kernel(set: &Set<'_>, wanted: &Wanted, tried: Tried) -> Option<Estimate> {
    let mut found = set.fitted(wanted, tried)?;
    let longer = Tried {
        length: 2.0 * tried.length,
        ..tried
    };
    let other = set.fitted(wanted, longer);
    if let Some(other) = other.filter(|other| other.terms == found.terms) {
        let values = found.values.iter().zip(&other.values);
        for (half, (value, other)) in found.half_widths.iter_mut().zip(values) {
            *half = half.hypot(2.0 * (value - other));
        }
    }
    Some(found)
}

/// Records, and which of them are runs at one speed, each one row: all that are, where there are several. One alone is told by its own rows.
struct Set<'a> {
    records: &'a [Record],
    runs: Vec<bool>,
}

impl<'a> Set<'a> {
    fn of(records: &'a [Record]) -> Self {
        let several = records.len() > 1;
        let run = |record: &Record| several && record.one_speed().is_some();
        Self {
            records,
            runs: records.iter().map(run).collect(),
        }
    }

    /// Half-widths of the kernel that are tried, s.
    fn lengths(&self) -> Vec<f64> {
        let ticks = self.records.iter().map(|record| record.tick);
        let shortest = LENGTHS[0].max(FEWEST as f64 * ticks.fold(0.0, f64::max));
        let longest = LENGTHS[1].max(4.0 * shortest);
        std::iter::successors(Some(shortest), |length| Some(length * RATIO))
            .take_while(|length| *length <= longest)
            .collect()
    }

    /// Median of the strokes between turns, rad or m; 0 where there are none.
    fn stroke(&self) -> f64 {
        let others = self
            .records
            .iter()
            .zip(&self.runs)
            .filter(|(_, run)| !**run);
        let rows = others.filter_map(|(record, _)| Rows::of(record, 8, 0.0, 0));
        median(rows.map(|rows| rows.stroke).collect())
    }

    fn rows(&self, tried: Tried) -> Vec<Option<Rows>> {
        let rows = |(record, run): (&Record, &bool)| {
            let samples = |time: f64| (time / record.tick).round() as usize;
            let half = samples(tried.length).max(FEWEST);
            let rows = (!run).then(|| Rows::of(record, half, tried.settling, samples(tried.spare)));
            rows.flatten().filter(|rows| rows.len() >= ROWS)
        };
        self.records.iter().zip(&self.runs).map(rows).collect()
    }

    /// Rows with these terms; a run counts as many as a kernel of this length would make of it.
    fn blocks(&self, rows: &[Option<Rows>], terms: &[Term], length: f64) -> Vec<Block> {
        let block = |((record, run), rows): ((&Record, &bool), &Option<Rows>)| match rows {
            Some(rows) => Some(Block::of(record, rows, terms)),
            None if *run => {
                let seconds = record.len() as f64 * record.tick;
                let weight = (ROWS as f64 * seconds / length).max(1.0);
                Block::of_run(record, terms, weight)
            }
            None => None,
        };
        let runs = self.records.iter().zip(&self.runs);
        runs.zip(rows).filter_map(block).collect()
    }

    fn fitted(&self, wanted: &Wanted, tried: Tried) -> Option<Estimate> {
        let rows = self.rows(tried);
        let terms = self.terms(&rows, wanted)?;
        let blocks = self.blocks(&rows, &terms, tried.length);
        let count: usize = blocks.iter().map(|block| block.target.len()).sum();
        let enough = if self.runs.contains(&true) {
            terms.len() + 1
        } else {
            ROWS * terms.len()
        };
        let groups = blocks.iter().map(|block| {
            let mut numbers = block.pieces.clone();
            numbers.dedup();
            numbers.len()
        });
        if count < enough || groups.sum::<usize>() <= terms.len() || terms.is_empty() {
            return None;
        }
        let late = terms.iter().position(|term| *term == Term::Lag);
        if let Some(place) = late.filter(|_| !tried.last)
            && noisy(self.records, &rows, &blocks, place)
        {
            return None;
        }
        let fit = fit(&blocks, &|coefficients| meaning(&terms, coefficients));
        let mut numbers = fit.values.iter().chain(&fit.half_widths);
        numbers.all(|x| x.is_finite()).then(|| Estimate {
            values: fit.values.clone(),
            half_widths: fit.half_widths.clone(),
            terms,
            fit,
            length: tried.length,
            settling: tried.settling,
            rows,
        })
    }

    /// The terms that records tell: those whose columns stand over the sensor's noise and differ from one another.
    fn terms(&self, rows: &[Option<Rows>], wanted: &Wanted) -> Option<Vec<Term>> {
        use Term::{
            BackDriving, Coulomb, Driving, Gain, Inertia, Lag, Loss, Offset, OneSpeed, Viscous,
        };
        let basic = [Inertia, Viscous, Coulomb, Driving, BackDriving];
        let blocks = self.blocks(rows, &basic, f64::INFINITY);
        if blocks.is_empty() {
            return None;
        }
        let column = |place: usize| -> Vec<f64> {
            let of = blocks.iter().flat_map(|block| &block.columns[place]);
            of.copied().collect()
        };
        let told = |place: usize| {
            let noise = blocks.iter().map(|block| block.noise[(place, place)]);
            let noise = (noise.sum::<f64>() / blocks.len() as f64).sqrt();
            rms(&column(place)) > (OVER_NOISE * noise).max(1e-12)
        };
        let mut terms = Vec::new();
        let (mean, spread) = moments(column(1).into_iter().map(f64::abs));
        let one_speed = spread < ONE * mean || !told(1);
        if !one_speed {
            terms.extend(told(0).then_some(Inertia));
            terms.push(Viscous);
        }
        let (mean, _) = moments(column(2).into_iter());
        terms.extend((mean.abs() < ONE_WAY).then_some(Offset));
        terms.push(if one_speed { OneSpeed } else { Coulomb });
        if self.records.iter().all(|record| record.load.is_some()) {
            let [driving, back_driving] = [column(3), column(4)];
            let sizes = driving.iter().zip(&back_driving);
            let (mean, spread) = moments(sizes.map(|(one, other)| one.abs() + other.abs()));
            let changes = spread >= ONE * mean && mean > 0.0;
            let own = self.records.iter().all(|record| record.load_is_effort);
            let there = |column: &[f64]| own && changes && rms(column) > ONE * mean;
            terms.extend(there(&driving).then_some(Driving));
            terms.extend(there(&back_driving).then_some(BackDriving));
            terms.extend((!own).then_some(Gain));
            terms.extend((!own && changes).then_some(Loss));
        }
        terms.extend(&wanted.more);
        let late = wanted.lag || self.records.iter().any(|record| record.speed_alone);
        let late = late && terms.contains(&Inertia) && terms.contains(&Viscous);
        terms.extend(late.then_some(Lag));
        Some(terms)
    }
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

/// Whether the rate of the acceleration, the column at `place`, is more noise than motion: what a kernel longer by a square root of two says
/// otherwise, over what it says beyond the other columns.
fn noisy(records: &[Record], rows: &[Option<Rows>], blocks: &[Block], place: usize) -> bool {
    let mut noise = 0.0;
    for (record, rows) in records.iter().zip(rows) {
        let Some(rows) = rows else { continue };
        let longer = Kernel::new((RATIO * rows.kernel.half() as f64) as usize, record.tick);
        for centre in &rows.centres {
            let at = |kernel: &Kernel| kernel.at(record.order(3), &record.motion, *centre);
            noise += (at(&rows.kernel) - at(&longer)).powi(2);
        }
    }
    let alone: Vec<Block> = blocks
        .iter()
        .map(|block| {
            let mut block = block.clone();
            block.target = block.columns.remove(place);
            block.noise = nalgebra::DMatrix::zeros(0, 0);
            block
        })
        .collect();
    let own = fit(&alone, &<[f64]>::to_vec).residual;
    noise > NOISY * dot(&own, &own)
}
