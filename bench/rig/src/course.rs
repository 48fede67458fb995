//! What the rig is driven through: motion, load and temperature over time.

use std::f64::consts::{FRAC_PI_2, TAU};

use rand::RngExt;
use rand_pcg::Pcg64;

use crate::parameters::ZERO_CELSIUS;
use crate::{Trace, Truth};
use epas_reference::error::{ReferenceError, within};

/// Stream of the generator of random numbers for the motion; sensors have the one beside it.
pub(crate) const STREAM: u128 = 0xa02_bdbf_7bb3_c0a7;

/// A kind of motion with its load.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Manoeuvre {
    /// Steering about the centre: 0.2 to 1.5 Hz, 0.6 rad rms, under a random rack load with a spring's part.
    Weave,
    /// Large strokes up to 43 rad/s under the same kind of load.
    Parking,
    /// Triangles that grow from 1 to 8 mrad on a slow wave of 50 mrad, under about a third of that load.
    Micro,
    /// Run up to 40 rad/s and left to run down, once in each direction, without a load.
    SpinDown,
    /// Short strokes at 2 rad/s while the load steps through eight values of both signs.
    LoadSteps,
    /// Whole turns at 3 rad/s, in both directions under 1.5 kN of both signs.
    Turns,
    /// Strokes up to 12 rad/s under 1.2 kN of both signs: what warms a screw up.
    Running,
}

use Manoeuvre::{LoadSteps, Micro, Parking, Running, SpinDown, Turns, Weave};

/// Manoeuvres one after the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    /// Each with its duration, s, 1 to 1e4.
    pub parts: Vec<(Manoeuvre, f64)>,
    /// Temperature at the start and at the end, K, between which it rises evenly.
    pub temperatures: [f64; 2],
    /// Time between two samples, s.
    pub tick: f64,
}

impl Course {
    fn of(parts: &[(Manoeuvre, f64)], warm: f64) -> Self {
        Self {
            parts: parts.into(),
            temperatures: [ZERO_CELSIUS + 20.0, ZERO_CELSIUS + warm],
            tick: 1e-3,
        }
    }

    /// What a vehicle gives: weave, parking and micro triangles, 20 s each, 20 to 45 degrees Celsius.
    #[must_use]
    pub fn vehicle() -> Self {
        Self::of(&[Weave, Parking, Micro].map(|part| (part, 20.0)), 45.0)
    }

    /// What a rig gives: spin-down without a load, load steps, whole turns, running warm, 15 s each, 20 to 60 degrees.
    #[must_use]
    pub fn rig() -> Self {
        let parts = [SpinDown, LoadSteps, Turns, Running];
        Self::of(&parts.map(|part| (part, 15.0)), 60.0)
    }

    /// Both, 60 s in all, 20 to 60 degrees.
    #[must_use]
    pub fn whole() -> Self {
        let vehicle = [(Weave, 10.0), (Parking, 10.0), (Micro, 12.0)];
        let rig = [
            (SpinDown, 6.0),
            (LoadSteps, 8.0),
            (Turns, 10.0),
            (Running, 4.0),
        ];
        Self::of(&[&vehicle[..], &rig].concat(), 60.0)
    }

    /// The same with every part's duration times `factor`.
    #[must_use]
    pub fn times(mut self, factor: f64) -> Self {
        for (_, duration) in &mut self.parts {
            *duration *= factor;
        }
        self
    }

    /// Time, motion, load and temperature, the same for the same seed on every machine.
    pub(crate) fn driven(&self, seed: u64) -> Result<Trace, ReferenceError> {
        within("tick", self.tick, 1e-5, 0.02)?;
        for temperature in self.temperatures {
            within("temperatures", temperature, 200.0, 500.0)?;
        }
        let mut random = Pcg64::new(seed.into(), STREAM);
        let mut trace = Trace::default();
        for &(manoeuvre, duration) in &self.parts {
            within("duration", duration, 1.0, 1e4)?;
            let part = Part {
                duration,
                tick: self.tick,
                ticks: (duration / self.tick).round() as usize,
                start: trace.truth.position.last().copied().unwrap_or(0.0),
            };
            part.drive(manoeuvre, &mut random, &mut trace.truth);
        }
        // Half of the power passes at 20 Hz.
        let width = 6.6e-3 / self.tick;
        trace.truth.position = smooth(&trace.truth.position, width);
        trace.truth.load = smooth(&trace.truth.load, width);
        let ticks = trace.truth.position.len();
        let last = ticks.max(2) - 1;
        let [start, end] = self.temperatures;
        let warm = |tick| start + (end - start) * tick as f64 / last as f64;
        trace.temperature = (0..ticks).map(warm).collect();
        trace.time = (0..ticks).map(|tick| tick as f64 * self.tick).collect();
        Ok(trace)
    }
}

/// One part of a course.
struct Part {
    duration: f64,
    tick: f64,
    ticks: usize,
    /// Angle at its beginning, rad.
    start: f64,
}

impl Part {
    fn drive(&self, manoeuvre: Manoeuvre, random: &mut Pcg64, driven: &mut Truth) {
        match manoeuvre {
            Weave => {
                let motion = self.waves(random, [0.2, 1.5], 0.6);
                self.steer(random, driven, 1.0, |tick| motion[tick]);
            }
            Parking => self.steer(random, driven, 1.0, |tick| {
                let time = self.time(tick);
                25.0 * (TAU * 0.25 * time).sin() + 6.0 * (TAU * 0.11 * time).sin()
            }),
            Micro => self.steer(random, driven, 0.35, |tick| {
                let time = self.time(tick);
                let amplitude = 1e-3 + 7e-3 * time / self.duration;
                amplitude * triangle(0.8 * time) + 0.05 * (TAU * 0.05 * time).sin()
            }),
            SpinDown => self.turn(driven, |share| {
                let (direction, share) = if share < 0.5 {
                    (1.0, 2.0 * share)
                } else {
                    (-1.0, 2.0 * share - 1.0)
                };
                let speed = if share < 0.15 {
                    share / 0.15
                } else {
                    (1.0 - share) / 0.85 * (-3.0 * (share - 0.15)).exp()
                };
                (direction * 40.0 * speed, 0.0)
            }),
            LoadSteps => {
                let loads = [0.0, 800.0, 1600.0, 3200.0, 0.0, -800.0, -1600.0, -3200.0];
                self.turn(driven, |share| {
                    let place = share * loads.len() as f64;
                    let load = loads[(place as usize).min(loads.len() - 1)];
                    // Forward and backward under every load.
                    (if place.fract() < 0.5 { 2.0 } else { -2.0 }, load)
                });
            }
            Turns => self.turn(driven, |share| {
                let quarter = (share * 4.0) as u8;
                let direction = if quarter.is_multiple_of(2) { 1.0 } else { -1.0 };
                (3.0 * direction, if quarter < 2 { 1500.0 } else { -1500.0 })
            }),
            Running => self.turn(driven, |share| {
                let time = share * self.duration;
                let load = 1200.0 * (TAU * 0.31 * time).sin().signum();
                (12.0 * (TAU * 0.5 * time).sin(), load)
            }),
        }
    }

    fn time(&self, tick: usize) -> f64 {
        tick as f64 * self.tick
    }

    /// Goes to and fro by a motion, at rest at both ends, under a random load with the part of a spring.
    fn steer(
        &self,
        random: &mut Pcg64,
        driven: &mut Truth,
        load_factor: f64,
        motion: impl Fn(usize) -> f64,
    ) {
        let slow = self.waves(random, [0.02, 0.5], 900.0);
        let fast = self.waves(random, [0.5, 8.0], 120.0);
        for tick in 0..self.ticks {
            let position = self.start + self.faded(tick) * motion(tick);
            let spring = 40.0 * position.clamp(-60.0, 60.0);
            driven.position.push(position);
            let load = load_factor * (slow[tick] + fast[tick] + spring);
            driven.load.push(load);
        }
    }

    /// Turns at a speed, under a load, both by the share of the duration.
    fn turn(&self, driven: &mut Truth, at: impl Fn(f64) -> (f64, f64)) {
        let mut position = self.start;
        for tick in 0..self.ticks {
            let (speed, load) = at(tick as f64 / self.ticks as f64);
            position += self.faded(tick) * speed * self.tick;
            driven.position.push(position);
            driven.load.push(load);
        }
    }

    /// 0 at both ends, 1 from a tenth of the duration on, two seconds at most.
    fn faded(&self, tick: usize) -> f64 {
        let end = self.time(tick.min(self.ticks - 1 - tick.min(self.ticks - 1)));
        let fading = (0.1 * self.duration).min(2.0);
        (FRAC_PI_2 * (end / fading).min(1.0)).sin().powi(2)
    }

    /// Random waves of a band, Hz, with an rms value.
    fn waves(&self, random: &mut Pcg64, [low, high]: [f64; 2], rms: f64) -> Vec<f64> {
        const WAVES: usize = 40;
        let amplitude = rms * (2.0 / WAVES as f64).sqrt();
        let wave = |number: usize| {
            let place: f64 = random.random_range(0.0..1.0);
            let frequency = low + (high - low) * (number as f64 + place) / WAVES as f64;
            [TAU * frequency, random.random_range(0.0..TAU)]
        };
        let waves: Vec<[f64; 2]> = (0..WAVES).map(wave).collect();
        let at = |tick| {
            let time = self.time(tick);
            let sines = waves
                .iter()
                .map(|[rate, phase]| (rate * time + phase).sin());
            amplitude * sines.sum::<f64>()
        };
        (0..self.ticks).map(at).collect()
    }
}

/// Triangle between -1 and 1 with the period 1, rising through zero at zero.
fn triangle(time: f64) -> f64 {
    2.0 / std::f64::consts::PI * (TAU * time).sin().asin()
}

/// Weighted means around every sample with the weights of a normal distribution, `width` samples wide; ends go on as they are.
fn smooth(values: &[f64], width: f64) -> Vec<f64> {
    let reach = (5.0 * width).ceil() as usize;
    let weights: Vec<f64> = (0..=2 * reach)
        .map(|place| (-0.5 * ((place as f64 - reach as f64) / width).powi(2)).exp())
        .collect();
    let whole: f64 = weights.iter().sum();
    let (Some(first), Some(last)) = (values.first(), values.last()) else {
        return Vec::new();
    };
    let padded = [&vec![*first; reach], values, &vec![*last; reach]].concat();
    let mean = |window: &[f64]| {
        let terms = window
            .iter()
            .zip(&weights)
            .map(|(value, weight)| value * weight);
        terms.sum::<f64>() / whole
    };
    padded.windows(weights.len()).map(mean).collect()
}
