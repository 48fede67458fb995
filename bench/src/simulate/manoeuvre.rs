//! Built-in manoeuvres, made up of rack travel and rack force.
//!
//! They are synthetic: shapes and magnitudes of what a rack-assist gear sees, the same for every
//! design, whose lead turns rack travel into nut speed.

use std::f64::consts::{PI, TAU};

use epas_friction::BallScrew;

use super::samples::{LinearSample, ScrewSample};
use super::trace::{Sample, Trace};
use crate::failure::Failure;

/// A built-in manoeuvre.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Manoeuvre {
    /// Lock to lock at standstill, rack force up to 14.5 kN at low speed; less for a screw that bears less
    Parking,
    /// On-centre weave at 0.2 Hz with small corrections: light loads, many reversals
    Weave,
    /// A wheel strikes a kerb: the rack is pushed back with 20 kN within 15 ms; less for a screw that bears less
    Kerb,
    /// Two turns of the nut, one a second, under -1500 N: Lin 2019, Figures 3.24 and 3.25
    Turns,
    /// A linear bearing's carriage, 0.2 m there and back under 1 kN, loaded to one side and the other
    Stroke,
}

/// Rack speed, m/s, and the force that resists positive rack travel, N.
struct Rack {
    speed: f64,
    force: f64,
    /// Force across, N.
    side: f64,
}

/// Force of tyre scrub: it builds up with travel, saturates, and turns over with hysteresis (Dahl).
struct Scrub {
    /// Force at saturation, N.
    limit: f64,
    /// Travel over which it builds up, m.
    travel: f64,
    /// Force now, N.
    force: f64,
}

impl Scrub {
    fn new(limit: f64, travel: f64) -> Self {
        Self {
            limit,
            travel,
            force: 0.0,
        }
    }

    /// The exact solution of `dF/dx = (limit - F sgn(v)) / travel` over one step.
    fn step(&mut self, displacement: f64) -> f64 {
        let target = self.limit * displacement.signum();
        let decay = (-displacement.abs() / self.travel).exp();
        self.force = target + (self.force - target) * decay;
        self.force
    }
}

impl Manoeuvre {
    fn name(self) -> &'static str {
        match self {
            Self::Parking => "parking",
            Self::Weave => "weave",
            Self::Kerb => "kerb",
            Self::Turns => "turns",
            Self::Stroke => "stroke",
        }
    }

    /// Whether its motion turns round.
    pub fn reverses(self) -> bool {
        self != Self::Turns
    }

    /// Duration, s, and samples per second.
    fn duration(self) -> (f64, f64) {
        match self {
            Self::Parking => (12.0, 1e3),
            Self::Weave => (20.0, 1e3),
            Self::Kerb => (0.6, 10e3),
            Self::Turns | Self::Stroke => (2.0, 1e3),
        }
    }

    /// The trace of a linear bearing.
    ///
    /// # Errors
    /// A manoeuvre of another mechanism.
    pub fn linear_trace(self) -> Result<Trace<LinearSample>, Failure> {
        if self != Self::Stroke {
            return Err(Failure::Data(format!(
                "{} is a manoeuvre of a ball screw; the one of a linear bearing is stroke",
                self.name()
            )));
        }
        Ok(
            self.samples(|time, Rack { speed, force, side }| LinearSample {
                time,
                speed,
                normal_load: force,
                side_load: side,
            }),
        )
    }

    /// The trace for one design.
    ///
    /// # Errors
    /// A manoeuvre of another mechanism.
    pub fn trace(self, design: &BallScrew) -> Result<Trace<ScrewSample>, Failure> {
        match self {
            Self::Stroke => {
                return Err(Failure::Data(
                    "stroke is the manoeuvre of a linear bearing".into(),
                ));
            }
            Self::Turns => return Ok(self.screw_samples(1.0)),
            _ => {}
        }
        let lead = f64::from(design.lead());
        if lead <= 0.0 {
            return Err(Failure::Data(
                "a manoeuvre is rack travel, and a design without lead makes none".into(),
            ));
        }
        Ok(self.screw_samples(TAU / lead))
    }

    /// With so many rad/s of the nut for a rack speed of one.
    fn screw_samples(self, speed_ratio: f64) -> Trace<ScrewSample> {
        self.samples(|time, Rack { speed, force, .. }| ScrewSample {
            time,
            nut_speed: speed * speed_ratio,
            axial_load: force,
        })
    }

    fn samples<S: Sample>(self, sample: impl Fn(f64, Rack) -> S) -> Trace<S> {
        let (duration, rate) = self.duration();
        let mut rack = self.rack(1.0 / rate);
        let samples = (0..=(duration * rate).round() as u32)
            .map(|index| {
                let time = f64::from(index) / rate;
                sample(time, rack(time))
            })
            .collect();
        Trace {
            name: self.name().into(),
            samples,
        }
    }

    /// Rack speed and force as functions of time, called once for every step.
    fn rack(self, step: f64) -> Box<dyn FnMut(f64) -> Rack> {
        match self {
            Self::Parking => {
                // 75 mm to either side, once there and back: at most 39 mm/s.
                const TRAVEL: f64 = 0.075;
                let rate = TAU / 12.0;
                let mut scrub = Scrub::new(12e3, 8e-3);
                Box::new(move |time| {
                    let speed = TRAVEL * rate * (rate * time).cos();
                    // Steering lifts the car: another 2.5 kN at full lock.
                    let lift = 2.5e3 * (rate * time).sin();
                    Rack {
                        speed,
                        force: scrub.step(speed * step) + lift,
                        side: 0.0,
                    }
                })
            }
            Self::Weave => {
                let (slow, fast) = (TAU * 0.2, TAU * 2.3);
                let mut scrub = Scrub::new(120.0, 0.3e-3);
                Box::new(move |time| {
                    let travel = 3e-3 * (slow * time).sin() + 0.4e-3 * (fast * time).sin();
                    let speed =
                        3e-3 * slow * (slow * time).cos() + 0.4e-3 * fast * (fast * time).cos();
                    Rack {
                        speed,
                        // Self-alignment holds the wheels straight.
                        force: scrub.step(speed * step) + 2.2e5 * travel,
                        side: 0.0,
                    }
                })
            }
            Self::Kerb => Box::new(|time| {
                const STRIKE: f64 = 0.2;
                const PULSE: f64 = 0.015;
                let since = time - STRIKE;
                if since < 0.0 {
                    return Rack {
                        speed: 0.02,
                        force: 2e3,
                        side: 0.0,
                    };
                }
                let pulse = if since < PULSE {
                    18e3 * (PI * since / PULSE).sin()
                } else {
                    0.0
                };
                // The struck wheel swings back at 18 Hz and comes to rest; the driver lets go.
                let ring = (-since / 0.06).exp();
                let swing = (TAU * 18.0 * since).sin();
                Rack {
                    speed: 0.02 * ring - 0.35 * ring * swing,
                    force: 2e3 * ring + pulse - 3e3 * ring * (TAU * 18.0 * since + PI).sin() * 0.4,
                    side: 0.0,
                }
            }),
            Self::Turns => Box::new(|_| Rack {
                speed: TAU,
                force: -1500.0,
                side: 0.0,
            }),
            Self::Stroke => Box::new(|time| Rack {
                speed: 0.1 * PI * (PI * time).sin(),
                force: 1e3,
                side: 600.0 * (TAU * time).sin(),
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use epas_friction::DISSERTATION_DESIGNS;

    fn trace(manoeuvre: Manoeuvre) -> Trace<ScrewSample> {
        let design = BallScrew::new(DISSERTATION_DESIGNS[2].parameters).unwrap();
        manoeuvre.trace(&design).unwrap()
    }

    fn peak_load(trace: &Trace<ScrewSample>) -> f64 {
        trace
            .samples
            .iter()
            .map(|sample| sample.axial_load.abs())
            .fold(0.0, f64::max)
    }

    fn reversals(trace: &Trace<ScrewSample>) -> usize {
        trace
            .samples
            .windows(2)
            .filter(|pair| matches!(pair, [one, other] if one.nut_speed * other.nut_speed < 0.0))
            .count()
    }

    #[test]
    fn parking_reaches_the_rated_force_at_low_speed() {
        let trace = trace(Manoeuvre::Parking);
        assert!((14.0e3..=14.5e3).contains(&peak_load(&trace)));
        // 39 mm/s of rack travel.
        let lead = 7e-3;
        for sample in &trace.samples {
            assert!(sample.nut_speed.abs() * lead / TAU < 0.04);
        }
    }

    #[test]
    fn weave_is_light_and_reverses_often() {
        let trace = trace(Manoeuvre::Weave);
        assert!(peak_load(&trace) < 1e3);
        assert!(reversals(&trace) > 40, "{}", reversals(&trace));
    }

    #[test]
    fn kerb_pushes_the_rack_back() {
        let trace = trace(Manoeuvre::Kerb);
        let peak = trace
            .samples
            .iter()
            .max_by(|one, other| one.axial_load.total_cmp(&other.axial_load))
            .unwrap();
        assert!(peak.axial_load > 18e3 && peak.nut_speed < 0.0, "{peak:?}");
    }
}
