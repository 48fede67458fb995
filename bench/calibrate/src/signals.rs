//! Smoothed motion, and the rows of a regression.
//!
//! The position is smoothed without a shift in time and differentiated once and twice. A speed that was measured beside
//! the position is not mixed in: a drive's speed is most often a difference of the same encoder, filtered and so late,
//! and says nothing more; it serves to find wrong units and shifted clocks ([`crate::checks`]). Where only the speed was
//! measured, it is what is smoothed and differentiated.
//!
//! A regression's rows are the signals of every sample, filtered all alike (a parallel filter, which leaves the relation
//! between them as it is) and thinned out.
//!
//! | module | what |
//! |---|---|
//! | [`filter`] | a low-pass filter without a shift in time |
//! | [`noise`] | noise of smoothed motion |
//! | [`autocorrelation`] | how far the rows of a residual repeat each other |
//! | [`spectrum`] | power spectral density |

pub mod autocorrelation;
pub mod filter;
pub mod noise;
pub mod spectrum;
#[cfg(test)]
mod tests;

use std::ops::Range;
use std::sync::Arc;

use epas_page::failure::Failure;

use crate::signals::filter::ZeroPhase;
use crate::signals::noise::{derivative, of_derivatives};
use crate::trace::Trace;
use crate::trace::rests::rests;

/// Cut-off of the position's filter where the sampling is fast enough, Hz.
const CUTOFF: f64 = 40.0;
/// Order of the position's filter: the least with which the noise of the acceleration has a bound is 3.
const ORDER: usize = 4;
/// Cut-off of the rows' filter where the sampling is fast enough, Hz.
const ROW_CUTOFF: f64 = 25.0;
/// Order of the rows' filter.
const ROW_ORDER: usize = 3;
/// Highest default cut-off over the sampling rate.
const SHARE: f64 = 0.125;
/// Rows in a period of the cut-off's frequency: between them hardly anything is left (gain 1/65 at their Nyquist
/// frequency with the third order).
const ROWS_A_PERIOD: f64 = 4.0;

/// How the position is smoothed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmoothingSettings {
    /// Cut-off, Hz; `None` for 40 Hz, or an eighth of the sampling rate where that is less.
    pub cutoff: Option<f64>,
    /// Order of the filter that runs forwards and backwards.
    pub order: usize,
}

impl Default for SmoothingSettings {
    fn default() -> Self {
        Self {
            cutoff: None,
            order: ORDER,
        }
    }
}

impl SmoothingSettings {
    /// The filter of samples every `step` seconds.
    ///
    /// # Errors
    /// A sampling rate that is too low for the cut-off, or an order out of range.
    pub fn filter(&self, step: f64) -> Result<ZeroPhase, Failure> {
        let cutoff = self.cutoff.unwrap_or_else(|| default_cutoff(step, CUTOFF));
        ZeroPhase::new(step, cutoff, self.order)
            .map_err(|message| Failure::Data(format!("smoothing: {message}")))
    }
}

/// The wanted cut-off, or what the sampling rate allows by default.
fn default_cutoff(step: f64, wanted: f64) -> f64 {
    let highest = SHARE / step;
    if highest < wanted { highest } else { wanted }
}

/// Motion of a trace, smoothed without a shift in time, at every sample.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Position, rad or m.
    pub position: Vec<f64>,
    /// Speed, rad/s or m/s.
    pub speed: Vec<f64>,
    /// Acceleration, rad/s^2 or m/s^2.
    pub acceleration: Vec<f64>,
    /// Standard deviation of the noise of speed and of acceleration.
    pub noise: [f64; 2],
    /// Samples at each end that what lies beyond the end reaches.
    pub edge: usize,
    /// Cut-off of its filter, Hz.
    pub cutoff: f64,
}

impl Motion {
    /// The motion of a trace.
    ///
    /// # Errors
    /// A sampling rate that is too low for the cut-off; a trace that is too short.
    pub fn of(trace: &Trace, settings: &SmoothingSettings) -> Result<Self, Failure> {
        let filter = settings.filter(trace.step)?;
        let edge = (filter.settling() / trace.step).ceil() as usize;
        let fewest = filter.shortest().max(4 * edge);
        if trace.len() < fewest {
            return Err(Failure::Data(format!(
                "{} samples are too few for a filter of {:.4} Hz: at least {fewest}",
                trace.len(),
                filter.cutoff()
            )));
        }
        let mut motion = Self {
            position: Vec::new(),
            speed: Vec::new(),
            acceleration: Vec::new(),
            noise: [0.0; 2],
            edge,
            cutoff: filter.cutoff(),
        }
        .again(trace, &filter);
        let (measured, smooth, orders) = match measured_speed(trace) {
            Some(speed) => (speed, &motion.speed, [0, 1]),
            None => (trace.position.as_slice(), &motion.position, [1, 2]),
        };
        motion.noise = of_derivatives(measured, smooth, trace.step, &filter, orders);
        Ok(motion)
    }

    /// The motion of a trace that is as long and as noisy, by the same filter.
    #[must_use]
    pub fn again(&self, trace: &Trace, filter: &ZeroPhase) -> Self {
        let position = filter.apply(&trace.position);
        let speed = match measured_speed(trace) {
            Some(measured) => filter.apply(measured),
            None => derivative(&position, trace.step),
        };
        Self {
            acceleration: derivative(&speed, trace.step),
            position,
            speed,
            noise: self.noise,
            edge: self.edge,
            cutoff: filter.cutoff(),
        }
    }
}

/// The speed, where it was measured and the position was not.
fn measured_speed(trace: &Trace) -> Option<&[f64]> {
    let speed = trace.speed.as_deref();
    speed.filter(|_| trace.position_summed)
}

/// How signals become rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RowSettings {
    /// Cut-off, Hz; `None` for 25 Hz, or an eighth of the sampling rate where that is less.
    pub cutoff: Option<f64>,
    /// Order of the filter that runs forwards and backwards.
    pub order: usize,
    /// Every which sample becomes a row; `None` for four rows in a period of the cut-off.
    pub every: Option<usize>,
    /// Time that is cut off at each end, s; `None` for what the filters of rows and motion need by default.
    pub edge: Option<f64>,
}

impl Default for RowSettings {
    fn default() -> Self {
        Self {
            cutoff: None,
            order: ROW_ORDER,
            every: None,
            edge: None,
        }
    }
}

/// The filter that turns a signal of every sample into rows.
#[derive(Clone, Debug)]
pub struct Rows {
    filter: ZeroPhase,
    step: f64,
    every: usize,
    edge: usize,
    /// For every sample, whether the trace moves there, and whether most of what a row there holds is motion; nothing where it never
    /// rests.
    moves: Option<Arc<[Vec<bool>; 2]>>,
}

impl Rows {
    /// Rows of samples every `step` seconds.
    ///
    /// # Errors
    /// A sampling rate that is too low for the cut-off or for the rows; settings out of range.
    pub fn new(step: f64, settings: &RowSettings) -> Result<Self, Failure> {
        let refused = |message: String| Failure::Data(format!("rows: {message}"));
        let cutoff = settings
            .cutoff
            .unwrap_or_else(|| default_cutoff(step, ROW_CUTOFF));
        let filter = ZeroPhase::new(step, cutoff, settings.order).map_err(refused)?;
        let fitting = 1.0 / (ROWS_A_PERIOD * cutoff * step);
        let every = settings.every.unwrap_or(((fitting + 1e-6) as usize).max(1));
        // Two rows in a period of the cut-off's frequency are the least that tell it.
        let most = (2.0 * fitting + 1e-6) as usize;
        if !(1..=most.max(1)).contains(&every) {
            return Err(refused(format!(
                "every {every}th sample is no choice for a cut-off of {cutoff} Hz: at most every {}th",
                most.max(1)
            )));
        }
        let edge = match settings.edge {
            Some(edge) => edge,
            None => filter.settling() + SmoothingSettings::default().filter(step)?.settling(),
        };
        // An hour is longer than any filter here needs.
        if !(0.0..=3600.0).contains(&edge) {
            return Err(refused(format!("edge = {edge} s must be within 0..=3600")));
        }
        Ok(Self {
            filter,
            step,
            every,
            edge: (edge / step).ceil() as usize,
            moves: None,
        })
    }

    /// Rows of a trace, without what stands still in it.
    ///
    /// # Errors
    /// Those of [`Self::new`].
    pub fn of_trace(trace: &Trace, settings: &RowSettings) -> Result<Self, Failure> {
        Ok(Self::new(trace.step, settings)?.without(&rests(trace), trace.len()))
    }

    /// The same rows without some stretches of so many samples. The relation of effort and motion holds sample by sample: with these
    /// samples set to zero on both sides before the filter, it holds in every row, also where a row sees a start or a stop.
    #[must_use]
    pub fn without(mut self, stretches: &[Range<usize>], samples: usize) -> Self {
        if stretches.is_empty() {
            return self;
        }
        let mut moves = vec![true; samples];
        for stretch in stretches {
            if let Some(rest) = moves.get_mut(stretch.clone()) {
                rest.fill(false);
            }
        }
        let weights: Vec<f64> = moves
            .iter()
            .map(|moves| f64::from(u8::from(*moves)))
            .collect();
        let filtered = self.filter.apply(&weights);
        let rows = filtered.iter().map(|weight| *weight > 0.5).collect();
        self.moves = Some(Arc::new([moves, rows]));
        self
    }

    /// The rows of a signal: filtered, every few samples, without the edges and rests. None where the signal is too short.
    pub fn of(&self, signal: &[f64]) -> Vec<f64> {
        let filtered = match &self.moves {
            Some(moves) if moves[0].len() == signal.len() => {
                let moving = signal.iter().zip(&moves[0]);
                let signal: Vec<f64> = moving
                    .map(|(value, moves)| if *moves { *value } else { 0.0 })
                    .collect();
                self.filter.apply(&signal)
            }
            _ => self.filter.apply(signal),
        };
        self.samples(signal.len())
            .filter_map(|sample| filtered.get(sample).copied())
            .collect()
    }

    /// The samples that become rows, of so many.
    pub fn samples(&self, samples: usize) -> impl Iterator<Item = usize> + use<> {
        let moves = self.moves.clone();
        (self.edge..samples.saturating_sub(self.edge))
            .step_by(self.every)
            .filter(move |sample| {
                let moves = moves.as_ref().and_then(|moves| moves[1].get(*sample));
                moves.is_none_or(|moves| *moves)
            })
    }

    /// Number of rows of so many samples.
    pub fn count(&self, samples: usize) -> usize {
        if samples < self.filter.shortest() {
            return 0;
        }
        self.samples(samples).count()
    }

    /// Time between rows, s.
    pub fn row_step(&self) -> f64 {
        self.step * self.every as f64
    }

    /// The filter.
    pub fn filter(&self) -> &ZeroPhase {
        &self.filter
    }
}
