//! Built-in manoeuvres, made up of rack travel and rack force.
//!
//! They are synthetic: shapes and magnitudes of what a rack-assist gear sees, the same for every
//! design, whose lead turns rack travel into nut speed.

use std::f64::consts::{PI, TAU};

use epas_friction::BallScrew;

/// A built-in manoeuvre.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Manoeuvre {
    /// Lock to lock at standstill.
    Parking,
    /// On-centre weave.
    Weave,
    /// A wheel strikes a kerb.
    Kerb,
    /// Two turns of the nut.
    Turns,
    /// A linear bearing's carriage, there and back.
    Stroke,
}

/// One moment of a manoeuvre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// Time, s.
    pub time: f64,
    /// Speed of the rack or carriage, m/s; of the nut, rad/s, where [`Manoeuvre::of_nut`] gives it.
    pub speed: f64,
    /// Force that resists positive travel, or presses the carriage on its rail, N.
    pub force: f64,
    /// Force across, N.
    pub side: f64,
}

/// Rack speed, m/s, and the forces of a [`Moment`].
struct Rack {
    speed: f64,
    force: f64,
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
    /// Every one, with its name and what it is.
    pub const ALL: [(Self, &'static str, &'static str); 5] = [
        (
            Self::Parking,
            "parking",
            "Lock to lock at standstill, rack force up to 14.5 kN at low speed; less for a screw that bears less",
        ),
        (
            Self::Weave,
            "weave",
            "On-centre weave at 0.2 Hz with small corrections: light loads, many reversals",
        ),
        (
            Self::Kerb,
            "kerb",
            "A wheel strikes a kerb: the rack is pushed back with 20 kN within 15 ms; less for a screw that bears less",
        ),
        (
            Self::Turns,
            "turns",
            "Two turns of the nut, one a second, under -1500 N: Lin 2019, Figures 3.24 and 3.25",
        ),
        (
            Self::Stroke,
            "stroke",
            "A linear bearing's carriage, 0.2 m there and back under 1 kN, loaded to one side and the other",
        ),
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        Self::ALL[self as usize].1
    }

    /// Whether its motion turns round.
    pub fn reverses(self) -> bool {
        self != Self::Turns
    }

    /// Duration, s, and samples per second.
    const fn duration(self) -> (f64, f64) {
        match self {
            Self::Parking => (12.0, 1e3),
            Self::Weave => (20.0, 1e3),
            Self::Kerb => (0.6, 10e3),
            Self::Turns | Self::Stroke => (2.0, 1e3),
        }
    }

    /// Its moments in rack or carriage travel.
    pub fn moments(self) -> Vec<Moment> {
        let (duration, rate) = self.duration();
        let mut rack = self.rack(1.0 / rate);
        (0..=(duration * rate).round() as u32)
            .map(|index| {
                let time = f64::from(index) / rate;
                let Rack { speed, force, side } = rack(time);
                Moment {
                    time,
                    speed,
                    force,
                    side,
                }
            })
            .collect()
    }

    /// Its moments for the nut of a screw, rad/s; none for the manoeuvre of a carriage, and for a screw without lead, which moves no rack.
    pub fn of_nut(self, design: &BallScrew) -> Option<Vec<Moment>> {
        let lead = f64::from(design.lead());
        let ratio = match self {
            Self::Stroke => return None,
            Self::Turns => 1.0,
            _ if lead > 0.0 => TAU / lead,
            _ => return None,
        };
        let mut moments = self.moments();
        for moment in &mut moments {
            moment.speed *= ratio;
        }
        Some(moments)
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

    fn trace(manoeuvre: Manoeuvre) -> Vec<Moment> {
        let design = BallScrew::new(DISSERTATION_DESIGNS[2].parameters).unwrap();
        manoeuvre.of_nut(&design).unwrap()
    }

    fn peak_load(trace: &[Moment]) -> f64 {
        trace
            .iter()
            .map(|sample| sample.force.abs())
            .fold(0.0, f64::max)
    }

    fn reversals(trace: &[Moment]) -> usize {
        trace
            .windows(2)
            .filter(|pair| matches!(pair, [one, other] if one.speed * other.speed < 0.0))
            .count()
    }

    #[test]
    fn all_are_in_order_and_of_their_kind() {
        let design = BallScrew::new(DISSERTATION_DESIGNS[2].parameters).unwrap();
        for (place, (manoeuvre, name, _)) in Manoeuvre::ALL.into_iter().enumerate() {
            assert_eq!(manoeuvre as usize, place);
            assert_eq!(manoeuvre.name(), name);
            let carriage = manoeuvre == Manoeuvre::Stroke;
            assert_eq!(manoeuvre.of_nut(&design).is_none(), carriage);
        }
    }

    #[test]
    fn parking_reaches_the_rated_force_at_low_speed() {
        let trace = trace(Manoeuvre::Parking);
        assert!((14.0e3..=14.5e3).contains(&peak_load(&trace)));
        // 39 mm/s of rack travel.
        let lead = 7e-3;
        for sample in &trace {
            assert!(sample.speed.abs() * lead / TAU < 0.04);
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
            .iter()
            .max_by(|one, other| one.force.total_cmp(&other.force))
            .unwrap();
        assert!(peak.force > 18e3 && peak.speed < 0.0, "{peak:?}");
    }
}
