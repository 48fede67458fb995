//! Manoeuvres of a steering gear or of a rig, from which the one that tells a parameter is chosen.

use std::f64::consts::TAU;

/// A manoeuvre.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Manoeuvre {
    /// On-centre weave: slow and small reversals under a load that follows the angle.
    Weave,
    /// Parking: fast sweeps from lock to lock under high load.
    Parking,
    /// Micro reversals: triangles of the size of the pre-sliding travel at rest, about a slowly wandering centre.
    MicroReversals,
    /// Load steps while the nut turns evenly to and fro.
    LoadSteps,
    /// Warm-up: the same sweep again and again while the temperature rises.
    WarmUp,
    /// Spin-down: the nut is let go at its largest speed without load and stops of itself.
    SpinDown,
    /// Whole turns at constant load and one slow speed, there and back.
    WholeTurns,
}

/// What the rig or the vehicle can do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// Largest angle from the middle, rad; above 0.
    pub angle: f64,
    /// Largest speed, rad/s; above 0.
    pub speed: f64,
    /// Largest axial load, N; 0 or above.
    pub load: f64,
    /// Temperature at the start and after warm-up, K.
    pub temperature: [f64; 2],
    /// Pre-sliding travel that is expected, rad; above 0.
    pub travel: f64,
}

/// A manoeuvre's course, sampled. All lists are as long as each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    /// Tick, s.
    pub step: f64,
    /// Angle, rad.
    pub position: Vec<f64>,
    /// Speed, rad/s.
    pub speed: Vec<f64>,
    /// Acceleration, rad/s^2.
    pub acceleration: Vec<f64>,
    /// Axial load, N.
    pub load: Vec<f64>,
    /// Temperature, K.
    pub temperature: Vec<f64>,
}

/// A triangle of height 1 and period 1 with rounded tips, zero at zero.
fn triangle(turns: f64) -> f64 {
    const ROUND: f64 = 0.995;
    (ROUND * (TAU * turns).sin()).asin() / ROUND.asin()
}

/// -1 before, 1 behind, smooth over 0.1 s.
fn step_up(time: f64) -> f64 {
    (time / 0.05).tanh()
}

impl Manoeuvre {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Weave,
        Self::Parking,
        Self::MicroReversals,
        Self::LoadSteps,
        Self::WarmUp,
        Self::SpinDown,
        Self::WholeTurns,
    ];

    /// Name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Weave => "weave",
            Self::Parking => "parking",
            Self::MicroReversals => "micro reversals",
            Self::LoadSteps => "load steps",
            Self::WarmUp => "warm-up",
            Self::SpinDown => "spin-down",
            Self::WholeTurns => "whole turns at constant load",
        }
    }

    /// How to drive it, as a sentence.
    pub fn instruction(self, reach: &Reach) -> String {
        let Reach {
            angle,
            speed,
            load,
            temperature: [cold, warm],
            travel,
        } = *reach;
        match self {
            Self::Weave => format!(
                "turn the nut by +-{:.2} rad at 0.2 to 1.5 Hz with the load following it",
                0.6f64.min(angle)
            ),
            Self::Parking => format!(
                "sweep to +-{angle:.1} rad at up to {speed:.1} rad/s under up to {load:.0} N"
            ),
            Self::MicroReversals => format!(
                "reverse at rest by {:.1e} to {:.1e} rad, 0.8 times a second",
                0.5 * travel,
                4.0 * travel
            ),
            Self::LoadSteps => format!(
                "turn evenly to and fro and step the load through 0, +-{:.0} N and +-{load:.0} N",
                0.5 * load
            ),
            Self::WarmUp => {
                format!("repeat one sweep while the screw warms from {cold:.0} K to {warm:.0} K")
            }
            Self::SpinDown => {
                format!("let the unloaded nut go at {speed:.1} rad/s and record until it stands")
            }
            Self::WholeTurns => format!(
                "turn evenly there and back over whole turns at a constant {:.0} N",
                0.5 * load
            ),
        }
    }

    /// How to drive it, in a few words.
    pub fn how(self) -> &'static str {
        match self {
            Self::Weave => "small slow reversals, 0.2 to 1.5 Hz, the load follows the angle",
            Self::Parking => "fast sweeps from lock to lock under high load",
            Self::MicroReversals => "reversals at rest, of the size of the pre-sliding travel",
            Self::LoadSteps => "even turning to and fro, the load stepped through 0 and both signs",
            Self::WarmUp => "one sweep again and again while the screw warms up",
            Self::SpinDown => "the unloaded nut is let go at speed and stops of itself",
            Self::WholeTurns => "whole turns at constant load and low speed, there and back",
        }
    }

    /// Parameters that it identifies: of `calibrate --wanted` for the built-in `lin-4.1` one of the two narrowest intervals is its; for
    /// spin-down and whole turns, what they still identify without a load and at one speed.
    pub fn identifies(self) -> &'static [&'static str] {
        match self {
            Self::Weave => &["breakaway_angle", "gain"],
            Self::Parking => &[
                "friction",
                "full_film_ratio",
                "half_share_speed",
                "preload",
                "drag",
                "offset",
                "direction_asymmetry",
            ],
            Self::MicroReversals => &["breakaway_angle", "backlash", "offset"],
            Self::LoadSteps => &["preload", "gain", "direction_asymmetry", "inertia"],
            Self::WarmUp => &[
                "friction",
                "full_film_ratio",
                "half_share_speed",
                "viscosity_pole",
                "drag",
                "inertia",
            ],
            Self::SpinDown => &["drag"],
            Self::WholeTurns => &["harmonics"],
        }
    }

    /// Duration, s.
    pub fn duration(self) -> f64 {
        match self {
            Self::WarmUp => 60.0,
            Self::SpinDown => 5.0,
            _ => 20.0,
        }
    }

    /// The course, sampled.
    pub fn course(self, step: f64, reach: &Reach) -> Course {
        let rows = (self.duration() / step).round() as usize;
        let time = |row: usize| row as f64 * step;
        // Differences over a tenth of a tick: exact to (tick / 10)^2 of the third derivative.
        let h = 0.1 * step;
        let place = |t: f64| self.position(t, reach);
        let temperature = |t: f64| {
            let [cold, warm] = reach.temperature;
            if self == Self::WarmUp {
                cold + (warm - cold) * t / self.duration()
            } else {
                cold
            }
        };
        Course {
            step,
            position: (0..rows).map(|row| place(time(row))).collect(),
            speed: (0..rows)
                .map(|row| (place(time(row) + h) - place(time(row) - h)) / (2.0 * h))
                .collect(),
            acceleration: (0..rows)
                .map(|row| {
                    (place(time(row) + h) - 2.0 * place(time(row)) + place(time(row) - h)) / (h * h)
                })
                .collect(),
            load: (0..rows).map(|row| self.load(time(row), reach)).collect(),
            temperature: (0..rows).map(|row| temperature(time(row))).collect(),
        }
    }

    /// Angle at a time, rad.
    fn position(self, t: f64, reach: &Reach) -> f64 {
        let Reach {
            angle,
            speed,
            travel,
            ..
        } = *reach;
        // A sweep of this amplitude and frequency has the largest speed `size 2 pi f`.
        let sweep = |size: f64, frequency: f64| size * (TAU * frequency * t).sin();
        match self {
            Self::Weave => {
                let size = 0.6f64.min(0.5 * angle);
                sweep(0.6 * size, 0.2) + sweep(0.3 * size, 0.7) + sweep(0.1 * size, 1.5)
            }
            Self::Parking | Self::WarmUp => {
                let frequency = (speed / (TAU * angle)).min(0.5);
                sweep(0.8 * angle, frequency) + sweep(0.2 * angle, 0.44 * frequency)
            }
            Self::MicroReversals => {
                (0.5 + 3.5 * t / self.duration()) * travel * triangle(0.8 * t)
                    + sweep(20.0 * travel, 0.05)
            }
            Self::LoadSteps => {
                let frequency = (0.2 * speed / (4.0 * angle)).max(0.1);
                (0.2 * speed / (4.0 * frequency)).min(angle) * triangle(frequency * t)
            }
            // Speed falls as (1 - t/T)^2 until the nut stands.
            Self::SpinDown => {
                let part = (1.0 - t / self.duration()).max(0.0);
                speed * self.duration() / 3.0 * (1.0 - part.powi(3))
            }
            Self::WholeTurns => {
                let turns = (angle / TAU).floor().max(1.0);
                turns * TAU * triangle(t / self.duration())
            }
        }
    }

    /// Axial load at a time, N.
    fn load(self, t: f64, reach: &Reach) -> f64 {
        let most = reach.load;
        match self {
            Self::Weave => 0.3 * most * (TAU * 0.2 * t).sin() + 0.1 * most * (TAU * 0.9 * t).sin(),
            Self::Parking => {
                0.8 * most * (self.position(t, reach) / reach.angle)
                    + 0.2 * most * (TAU * 0.3 * t).sin()
            }
            Self::MicroReversals => 0.3 * most * (TAU * 0.11 * t).sin(),
            Self::LoadSteps => {
                let step = |at: f64| 0.5 * (1.0 + step_up(t - at));
                most * (0.5 * step(4.0) + 0.5 * step(7.0) - 1.5 * step(11.0) - 0.5 * step(14.0)
                    + step(17.0))
            }
            Self::WarmUp | Self::WholeTurns => 0.5 * most,
            Self::SpinDown => 0.0,
        }
    }
}
