//! Smoothed motion, and the rows of a regression.
//!
//! The position is smoothed without a shift in time and differentiated once and twice. A speed that was measured beside
//! the position is not mixed in: a drive's speed is most often a difference of the same encoder, filtered and so late,
//! and says nothing more; it serves to find wrong units and shifted clocks ([`super::checks`]). Where only the speed was
//! measured, it is what is smoothed and differentiated.
//!
//! A regression's rows are the signals of every sample, filtered all alike (a parallel filter, which leaves the relation
//! between them as it is) and thinned out.

use crate::failure::Failure;

use super::filter::ZeroPhase;
use super::noise::{derivative, of_derivatives};
use super::trace::Trace;

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
        let position = filter.apply(&trace.position);
        let (speed, noise) = match &trace.speed {
            Some(measured) if trace.position_summed => {
                let speed = filter.apply(measured);
                let noise = of_derivatives(measured, &speed, trace.step, &filter, [0, 1]);
                (speed, noise)
            }
            _ => (
                derivative(&position, trace.step),
                of_derivatives(&trace.position, &position, trace.step, &filter, [1, 2]),
            ),
        };
        let acceleration = derivative(&speed, trace.step);
        Ok(Self {
            position,
            speed,
            acceleration,
            noise,
            edge,
        })
    }
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
        })
    }

    /// The rows of a signal: filtered, every few samples, without the edges. None where the signal is too short.
    pub fn of(&self, signal: &[f64]) -> Vec<f64> {
        let filtered = self.filter.apply(signal);
        self.samples(signal.len())
            .filter_map(|sample| filtered.get(sample).copied())
            .collect()
    }

    /// The samples that become rows, of so many.
    pub fn samples(&self, samples: usize) -> impl Iterator<Item = usize> + use<> {
        (self.edge..samples.saturating_sub(self.edge)).step_by(self.every)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calibrate::trace::{Coordinate, Repairs};
    use std::f64::consts::TAU;

    const STEP: f64 = 1e-3;

    /// Two sines: position, speed and acceleration.
    fn exact(time: f64) -> [f64; 3] {
        [(3.0, TAU * 0.4), (0.05, TAU * 5.0)]
            .into_iter()
            .map(|(size, frequency)| {
                let (sine, cosine) = (frequency * time).sin_cos();
                [
                    size * sine,
                    size * frequency * cosine,
                    -size * frequency * frequency * sine,
                ]
            })
            .fold([0.0; 3], |sum, add| [0, 1, 2].map(|k| sum[k] + add[k]))
    }

    fn trace(samples: usize, resolution: f64) -> Trace {
        let position = (0..samples)
            .map(|k| exact(STEP * k as f64)[0])
            .map(|x| {
                if resolution > 0.0 {
                    (x / resolution).round() * resolution
                } else {
                    x
                }
            })
            .collect();
        Trace {
            name: "sines".into(),
            coordinate: Coordinate::Rotation,
            start: 0.0,
            step: STEP,
            position,
            resolution,
            position_summed: false,
            speed: None,
            effort: vec![0.0; samples],
            reference_position: None,
            load: None,
            temperature: None,
            repairs: Repairs::default(),
            ignored: Vec::new(),
        }
    }

    fn errors(motion: &Motion) -> [f64; 2] {
        let inner = motion.edge..motion.position.len() - motion.edge;
        let squares = inner.clone().fold([0.0; 2], |sum, k| {
            let [_, speed, acceleration] = exact(STEP * k as f64);
            [
                sum[0] + (motion.speed[k] - speed).powi(2),
                sum[1] + (motion.acceleration[k] - acceleration).powi(2),
            ]
        });
        squares.map(|sum| (sum / inner.len() as f64).sqrt())
    }

    #[test]
    fn motion_of_a_fine_sensor_is_exact() {
        let motion = Motion::of(&trace(20_000, 0.0), &SmoothingSettings::default()).unwrap();
        let [speed, acceleration] = errors(&motion);
        // The 5 Hz sine, of amplitudes 1.57 rad/s and 49 rad/s^2: the filter takes (5/40)^8 = 6e-8 of it, a central
        // difference (TAU 5 STEP)^2 / 6 = 1.6e-4, two of them twice that.
        assert!(speed < 1.6e-4 * 1.6, "{speed}");
        assert!(acceleration < 3.3e-4 * 50.0, "{acceleration}");
    }

    #[test]
    fn noise_of_a_sensor_that_rounds_is_what_it_says() {
        for counts in [2000.0, 16384.0 * 2.5] {
            let motion =
                Motion::of(&trace(60_000, TAU / counts), &SmoothingSettings::default()).unwrap();
            let fine =
                errors(&Motion::of(&trace(60_000, 0.0), &SmoothingSettings::default()).unwrap());
            for ((error, fine), noise) in errors(&motion).into_iter().zip(fine).zip(motion.noise) {
                let error = (error * error - fine * fine).sqrt();
                // Both are means over a minute of a noise that repeats with the motion: measured ratios within 2 %.
                assert!(
                    (error / noise - 1.0).abs() < 0.1,
                    "{counts}: {error} {noise}"
                );
            }
        }
    }

    #[test]
    fn noise_of_a_noisy_sensor_is_what_it_says() {
        use rand::SeedableRng;
        use rand_distr::{Distribution, Normal};
        let mut random = rand_pcg::Pcg64::seed_from_u64(5);
        let normal = Normal::new(0.0, 1e-3).unwrap();
        let mut noisy = trace(60_000, 0.0);
        for position in &mut noisy.position {
            *position += normal.sample(&mut random);
        }
        let motion = Motion::of(&noisy, &SmoothingSettings::default()).unwrap();
        for (error, noise) in errors(&motion).into_iter().zip(motion.noise) {
            // A minute holds 60 s x 2 x 40 Hz = 4800 independent values: 1 % of the deviation.
            assert!((error / noise - 1.0).abs() < 0.04, "{error} {noise}");
        }
    }

    #[test]
    fn a_summed_position_gives_way_to_the_speed() {
        let mut summed = trace(20_000, 0.0);
        summed.position_summed = true;
        summed.speed = Some((0..20_000).map(|k| exact(STEP * f64::from(k))[1]).collect());
        let motion = Motion::of(&summed, &SmoothingSettings::default()).unwrap();
        let [speed, acceleration] = errors(&motion);
        // The filter's 6e-8 of the small sine's speed, and at the edges what is left of the mirror: a thousandth of the
        // slope of 50 rad/s^2 over the settling time, over 20 s.
        assert!(speed < 1e-6, "{speed}");
        assert!(acceleration < 1.7e-4 * 50.0, "{acceleration}");
    }

    #[test]
    fn defaults_follow_the_sampling_rate() {
        for (step, smoothing, rows, every) in [
            (1e-3, 40.0, 25.0, 10),
            (1e-4, 40.0, 25.0, 100),
            (5e-3, 25.0, 25.0, 2),
            (1e-2, 12.5, 12.5, 2),
            (1e-3 / 1.5, 40.0, 25.0, 15),
        ] {
            let filter = SmoothingSettings::default().filter(step).unwrap();
            assert!((filter.cutoff() - smoothing).abs() < 1e-9);
            let made = Rows::new(step, &RowSettings::default()).unwrap();
            assert!((made.filter().cutoff() - rows).abs() < 1e-9);
            assert!(
                (made.row_step() / step - f64::from(every)).abs() < 1e-9,
                "{step}"
            );
        }
    }

    #[test]
    fn rows_are_filtered_samples() {
        let rows = Rows::new(STEP, &RowSettings::default()).unwrap();
        let signal: Vec<f64> = (0..5000).map(|k| exact(STEP * f64::from(k))[0]).collect();
        let made = rows.of(&signal);
        assert_eq!(made.len(), rows.count(signal.len()));
        for (row, sample) in made.iter().zip(rows.samples(signal.len())) {
            // (5/25)^6 of the small sine, and what is left of the edges' mirror: 1e-3 of a slope over the settling.
            assert!((row - signal[sample]).abs() < 6.4e-5 * 0.05 + 1e-5);
        }
        assert!(rows.of(&signal[..20]).is_empty());
        assert!(rows.of(&signal[..300]).is_empty());
        assert_eq!(rows.count(20), 0);
    }

    #[test]
    fn rates_that_are_too_low_and_bad_settings_are_refused() {
        let word = |failure: Failure| match failure {
            Failure::Data(message) => message,
            other => format!("{other:?}"),
        };
        let wanted = SmoothingSettings {
            cutoff: Some(400.0),
            order: 4,
        };
        let message = word(Motion::of(&trace(9000, 0.0), &wanted).unwrap_err());
        assert!(message.contains("sampling rate of 1000"), "{message}");
        let short = Motion::of(&trace(100, 0.0), &SmoothingSettings::default());
        assert!(word(short.unwrap_err()).contains("too few"));
        for (settings, expected) in [
            (
                RowSettings {
                    cutoff: Some(300.0),
                    ..RowSettings::default()
                },
                "too low",
            ),
            (
                RowSettings {
                    every: Some(0),
                    ..RowSettings::default()
                },
                "every 0th",
            ),
            (
                RowSettings {
                    every: Some(21),
                    ..RowSettings::default()
                },
                "at most every 20th",
            ),
            (
                RowSettings {
                    edge: Some(-1.0),
                    ..RowSettings::default()
                },
                "edge",
            ),
            (
                RowSettings {
                    order: 20,
                    ..RowSettings::default()
                },
                "order",
            ),
        ] {
            let message = word(Rows::new(STEP, &settings).unwrap_err());
            assert!(message.contains(expected), "{message}");
        }
    }
}
