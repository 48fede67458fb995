//! How the effort of a trace goes with its motion, roughly: enough to see a wrong sign, a wrong unit or a shifted clock
//! before anything is fitted.
//!
//! While the motion is well above its slowest, `effort = inertia acceleration + drag speed + friction sign(speed) + offset`,
//! and with a load `+ gain load + share |load| sign(speed)`.

use nalgebra::{DMatrix, DVector, SVector};

use crate::signals::Motion;
use crate::trace::known::KnownEffort;
use crate::trace::rests::rests;
use crate::trace::{Coordinate, Trace};

/// Terms of the relation.
const TERMS: usize = 6;
/// Places of the terms that say something by their sign.
const INERTIA: usize = 0;
const DRAG: usize = 1;
const FRICTION: usize = 2;
const GAIN: usize = 4;
const SHARE: usize = 5;

/// Most samples that are looked at once, and for each shift of many.
const MOST: usize = 60_000;
const MOST_SHIFTED: usize = 6_000;
/// Fewest samples that say anything.
const FEWEST: usize = 10 * TERMS;
/// Samples of one and the same deviation, because it changes slowly: the deviations that count are fewer than the samples
/// by this.
const ALIKE: f64 = 50.0;
/// Share of the speed's root mean square above which the motion slides.
const SLIDING: f64 = 0.1;

/// The relation that fits best.
#[derive(Clone, Debug, PartialEq)]
pub struct Relation {
    /// Root mean square of what is left, over the effort's deviation from its mean.
    pub left: f64,
    /// Root mean square of what is left, N m or N.
    pub left_size: f64,
    /// Effort of a unit of load.
    pub gain: f64,
    /// The same over its standard deviation; 0 without a load.
    pub gain_certainty: f64,
    /// The same where the motion slides; `None` where too little of the trace does.
    pub sliding: Option<Sliding>,
}

/// The relation that fits best where the motion has gone beyond what is elastic since it turned round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sliding {
    /// Root mean square of what is left, over the effort's deviation from its mean.
    pub left: f64,
    /// Inertia over its standard deviation.
    pub inertia: f64,
    /// Power of the friction over its standard deviation.
    pub power: f64,
}

/// A shift of the effort's clock against another channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shift {
    /// By how many ticks the effort comes late.
    pub ticks: f64,
    /// Root mean square of what is left without a shift, over what is left with it.
    pub gain: f64,
    /// Ticks from that shift at which clearly more is left, on both sides; infinite where that is beyond those sought.
    pub seen: f64,
}

/// What is clearly more, of a root mean square.
const CLEARLY: f64 = 1.1;

/// What the shift is sought against.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Against {
    /// The motion: effort and load are moved together.
    Motion,
    /// The load: the motion stays.
    Load,
}

/// Way after a turning point on which elasticity stands in for friction, rad and m: it leads or lags a motion, as a wrong sign or a
/// shifted clock would. Five breakaway travels of usual screws (5 mrad of a nut, 50 um of a carriage).
const ELASTIC: [f64; 2] = [25e-3, 0.25e-3];

/// Whether a sample is beyond that way, for every one.
fn beyond_elasticity(trace: &Trace, motion: &Motion) -> Vec<bool> {
    let least = match trace.coordinate {
        Coordinate::Rotation => ELASTIC[0],
        Coordinate::Translation => ELASTIC[1],
    };
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut forwards = true;
    let positions = motion.position.iter().zip(&motion.speed);
    positions
        .map(|(position, speed)| {
            // Where it turned round, and how far it has come since.
            if forwards != (*speed >= 0.0) {
                forwards = !forwards;
                (low, high) = (f64::INFINITY, f64::NEG_INFINITY);
            }
            (low, high) = (low.min(*position), high.max(*position));
            high - low > least
        })
        .collect()
}

/// The samples where the trace moves, away from its ends, thinned out.
fn moving(trace: &Trace, motion: &Motion, margin: usize, most: usize) -> Vec<usize> {
    let samples = trace.len();
    let slow = SLIDING * root_mean_square(&motion.speed);
    let inner = margin..samples.saturating_sub(margin);
    let stride = inner.len() / most + 1;
    let rests = rests(trace);
    let mut rests = rests.iter().peekable();
    inner
        .step_by(stride)
        .filter(|sample| motion.speed.get(*sample).is_some_and(|w| w.abs() > slow))
        // Near a start or a stop the smoothed speed says otherwise.
        .filter(|sample| {
            while rests.next_if(|rest| rest.end <= *sample).is_some() {}
            rests.peek().is_none_or(|rest| *sample < rest.start)
        })
        .collect()
}

/// Root of the mean square.
pub fn root_mean_square(signal: &[f64]) -> f64 {
    let sum: f64 = signal.iter().map(|x| x * x).sum();
    (sum / signal.len().max(1) as f64).sqrt()
}

/// Sums of products of the relation's terms and the effort.
struct Sums {
    terms: DMatrix<f64>,
    effort: SVector<f64, TERMS>,
    square: f64,
    mean: f64,
    count: f64,
    /// What each of the motion's friction terms does with the speed, on average.
    powers: SVector<f64, TERMS>,
}

/// Sums over some samples; the effort and the load are taken so many samples later.
fn sums(trace: &Trace, motion: &Motion, samples: &[usize], later: [isize; 2]) -> Option<Sums> {
    let known = trace.known.as_ref().and_then(KnownEffort::beside);
    let mut made = Sums {
        terms: DMatrix::zeros(TERMS, TERMS),
        effort: SVector::zeros(),
        square: 0.0,
        mean: 0.0,
        count: samples.len() as f64,
        powers: SVector::zeros(),
    };
    let mut products = [[0.0; TERMS]; TERMS];
    for sample in samples {
        let [effort_at, load_at] = later.map(|ticks| sample.checked_add_signed(ticks));
        let mut effort = *trace.effort.get(effort_at?)?;
        if let Some(known) = known {
            effort += known.get(*sample)?;
        }
        let load = match &trace.load {
            Some(load) => *load.get(load_at?)?,
            None => 0.0,
        };
        let speed = *motion.speed.get(*sample)?;
        let direction = 1.0_f64.copysign(speed);
        let terms = [
            *motion.acceleration.get(*sample)?,
            speed,
            direction,
            1.0,
            load,
            load.abs() * direction,
        ];
        for (place, (row, term)) in products.iter_mut().zip(terms).enumerate() {
            for (product, other) in row.iter_mut().zip(terms).skip(place) {
                *product += term * other;
            }
        }
        made.effort += SVector::from(terms) * effort;
        made.square += effort * effort;
        made.mean += effort;
        for place in [DRAG, FRICTION, SHARE] {
            made.powers[place] += terms[place] * speed;
        }
    }
    made.terms = DMatrix::from_fn(TERMS, TERMS, |row, column| {
        products[row.min(column)][row.max(column)]
    });
    made.powers /= made.count;
    Some(made)
}

/// The best values of the terms, what is left (sum of squares), and the inverse of the terms' products.
fn solve(sums: &Sums) -> Option<(DVector<f64>, f64, DMatrix<f64>)> {
    /// Directions that are this much weaker than the strongest are not told by the trace.
    const WEAKEST: f64 = 1e-9;
    let scale = DVector::from_fn(TERMS, |term, _| {
        let size = sums.terms[(term, term)].sqrt();
        if size > 0.0 { 1.0 / size } else { 0.0 }
    });
    let scaled = DMatrix::from_fn(TERMS, TERMS, |row, column| {
        sums.terms[(row, column)] * scale[row] * scale[column]
    });
    let inverse = scaled.pseudo_inverse(WEAKEST).ok()?;
    let inverse = DMatrix::from_fn(TERMS, TERMS, |row, column| {
        inverse[(row, column)] * scale[row] * scale[column]
    });
    let effort = DVector::from_column_slice(sums.effort.as_slice());
    let best = &inverse * &effort;
    let left = sums.square - best.dot(&effort);
    // Rounding of the difference of two sums.
    Some((best, left.max(1e-14 * sums.square), inverse))
}

/// The relation of effort and motion; `None` where too little of the trace moves.
pub fn relation(trace: &Trace, motion: &Motion) -> Option<Relation> {
    let mut samples = moving(trace, motion, motion.edge, MOST);
    let all = Solved::of(trace, motion, &samples)?;
    let beyond = beyond_elasticity(trace, motion);
    samples.retain(|sample| beyond.get(*sample) == Some(&true));
    let only = |term: usize| DVector::from_fn(TERMS, |row, _| f64::from(u8::from(row == term)));
    Some(Relation {
        left: all.left_over(),
        left_size: (all.left / all.sums.count).sqrt(),
        gain: all.best[GAIN],
        gain_certainty: all.certainty(&only(GAIN)),
        sliding: Solved::of(trace, motion, &samples).map(|sliding| Sliding {
            left: sliding.left_over(),
            inertia: sliding.certainty(&only(INERTIA)),
            power: sliding.certainty(&DVector::from_column_slice(sliding.sums.powers.as_slice())),
        }),
    })
}

/// Sums over some samples, with the best values of the terms.
struct Solved {
    sums: Sums,
    best: DVector<f64>,
    left: f64,
    inverse: DMatrix<f64>,
}

impl Solved {
    /// `None` for too few samples.
    fn of(trace: &Trace, motion: &Motion, samples: &[usize]) -> Option<Self> {
        if samples.len() < FEWEST {
            return None;
        }
        let sums = sums(trace, motion, samples, [0, 0])?;
        let (best, left, inverse) = solve(&sums)?;
        Some(Self {
            sums,
            best,
            left,
            inverse,
        })
    }

    /// A sum of terms over its standard deviation.
    fn certainty(&self, direction: &DVector<f64>) -> f64 {
        let variance = self.left / self.sums.count * ALIKE;
        let deviation = (direction.dot(&(&self.inverse * direction)) * variance).sqrt();
        let value = direction.dot(&self.best);
        if deviation > 0.0 {
            value / deviation
        } else {
            0.0
        }
    }

    /// Root mean square of what is left, over the effort's deviation from its mean.
    fn left_over(&self) -> f64 {
        let Sums {
            square,
            mean,
            count,
            ..
        } = self.sums;
        let spread = square - mean * mean / count;
        (self.left / spread.max(f64::MIN_POSITIVE)).sqrt()
    }
}

/// The shift of the effort that leaves least, within so many ticks; `None` where too little of the trace slides.
pub fn shift(trace: &Trace, motion: &Motion, against: Against, most: usize) -> Option<Shift> {
    let beyond = beyond_elasticity(trace, motion);
    let mut samples = moving(trace, motion, motion.edge + most, MOST_SHIFTED);
    samples.retain(|sample| beyond.get(*sample) == Some(&true));
    if samples.len() < FEWEST {
        return None;
    }
    let left = |ticks: isize| {
        let later = match against {
            Against::Motion => [ticks, ticks],
            Against::Load => [0, -ticks],
        };
        solve(&sums(trace, motion, &samples, later)?).map(|(_, left, _)| left)
    };
    let most = most as isize;
    let all: Vec<(isize, f64)> = (-most..=most)
        .filter_map(|ticks| Some((ticks, left(ticks)?)))
        .collect();
    let (ticks, least) = *all.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
    let clearly = |(_, left): &&(isize, f64)| *left > CLEARLY * CLEARLY * least;
    let before = all.iter().filter(|x| x.0 < ticks).rfind(clearly);
    let after = all.iter().filter(|x| x.0 > ticks).find(clearly);
    let seen = match (before, after) {
        (Some(before), Some(after)) => (ticks - before.0).max(after.0 - ticks) as f64,
        _ => f64::INFINITY,
    };
    Some(Shift {
        ticks: ticks as f64,
        gain: (left(0)? / least).sqrt(),
        seen,
    })
}

/// What a measured speed is of the position's derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedRelation {
    /// Measured speed over the derivative.
    pub factor: f64,
    /// Correlation of the two.
    pub correlation: f64,
    /// By how many ticks the measured speed comes late.
    pub ticks: f64,
}

/// Compares a measured speed with the derivative of the position, shifted by at most so many ticks.
pub fn speeds(measured: &[f64], motion: &Motion, most: usize) -> Option<SpeedRelation> {
    let samples = measured.len();
    let margin = motion.edge + most;
    let inner = margin..samples.saturating_sub(margin);
    let stride = inner.len() / MOST_SHIFTED + 1;
    let most = most as isize;
    (-most..=most)
        .filter_map(|ticks| {
            let (mut own, mut other, mut both) = (0.0, 0.0, 0.0);
            for sample in inner.clone().step_by(stride) {
                let speed = *motion.speed.get(sample)?;
                let measured = *measured.get(sample.checked_add_signed(ticks)?)?;
                own += speed * speed;
                other += measured * measured;
                both += speed * measured;
            }
            let correlation = both / (own * other).sqrt();
            correlation.is_finite().then_some(SpeedRelation {
                factor: both / own,
                correlation,
                ticks: ticks as f64,
            })
        })
        .max_by(|a, b| a.correlation.abs().total_cmp(&b.correlation.abs()))
}
