//! Manoeuvres of a steering gear or of a rig, from which the one that tells a parameter is chosen.

use std::f64::consts::TAU;
use std::fmt;

use crate::trace::Trace;
use epas_design::files::Design;

/// A manoeuvre; its [`Manoeuvre::words`] say how it is driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Manoeuvre {
    Weave,
    Parking,
    MicroReversals,
    LoadSteps,
    WarmUp,
    SpinDown,
    WholeTurns,
}

/// What the rig or the vehicle can do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reach {
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

impl Reach {
    /// A rack of 75 mm to each side, within the limits of a design.
    pub fn of(design: &Design) -> Self {
        let limits = &design.caged.limits;
        Self {
            angle: 0.075 / f64::from(design.screw().lead()) * TAU,
            speed: 45.0_f64.min(0.9 * f64::from(limits.nut_speed)),
            load: 2.8e3_f64.min(0.9 * f64::from(limits.axial_load)),
            temperature: [293.15, 333.15],
            travel: 2e-3,
        }
    }
}

impl fmt::Display for Reach {
    fn fmt(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [cold, warm] = self.temperature;
        write!(
            text,
            "+-{:.1} rad, {:.1} rad/s, +-{:.0} N, {cold:.0} to {warm:.0} K, with a pre-sliding travel of {:.1e} rad",
            self.angle, self.speed, self.load, self.travel
        )
    }
}

/// A triangle of height 1 and period 1 with rounded tips, zero at zero.
fn triangle(turns: f64) -> f64 {
    const ROUND: f64 = 0.995;
    (ROUND * (TAU * turns).sin()).asin() / ROUND.asin()
}

impl Manoeuvre {
    pub const ALL: [Self; 7] = [
        Self::Weave,
        Self::Parking,
        Self::MicroReversals,
        Self::LoadSteps,
        Self::WarmUp,
        Self::SpinDown,
        Self::WholeTurns,
    ];

    /// Name, how to drive it, and the parameters that it identifies: of `calibrate --wanted` for the built-in `lin-4.1` one of the two
    /// narrowest intervals is its; for spin-down and whole turns, what they still identify without a load and at one speed.
    pub const fn words(self) -> [&'static str; 3] {
        match self {
            Self::Weave => [
                "weave",
                "reversals of up to 0.6 rad at 0.2 to 1.5 Hz, the load follows the angle",
                "breakaway_angle gain",
            ],
            Self::Parking => [
                "parking",
                "fast sweeps from lock to lock under up to the largest load",
                "friction full_film_ratio half_share_speed preload drag offset direction_asymmetry",
            ],
            Self::MicroReversals => [
                "micro reversals",
                "reversals at rest by 0.5 to 4 times the pre-sliding travel, 0.8 times a second",
                "breakaway_angle backlash offset",
            ],
            Self::LoadSteps => [
                "load steps",
                "even turning to and fro, the load stepped through 0, half and all of both signs",
                "preload gain direction_asymmetry inertia",
            ],
            Self::WarmUp => [
                "warm-up",
                "one sweep again and again under half of the load while the screw warms up",
                "friction full_film_ratio half_share_speed viscosity_pole drag inertia",
            ],
            Self::SpinDown => [
                "spin-down",
                "the unloaded nut is let go at its largest speed and stops of itself",
                "drag",
            ],
            Self::WholeTurns => [
                "whole turns at constant load",
                "whole turns there and back at low speed under half of the load",
                "harmonics",
            ],
        }
    }

    /// Duration, s.
    pub const fn duration(self) -> f64 {
        match self {
            Self::WarmUp => 60.0,
            Self::SpinDown => 5.0,
            _ => 20.0,
        }
    }

    /// Its trace with a tick, s, without the effort.
    pub fn trace(self, step: f64, reach: &Reach) -> Trace {
        let rows = (self.duration() / step).round() as usize;
        let of = |at: &dyn Fn(f64) -> f64| (0..rows).map(|row| at(row as f64 * step)).collect();
        let [cold, warm] = reach.temperature;
        let rise = if self == Self::WarmUp {
            (warm - cold) / self.duration()
        } else {
            0.0
        };
        Trace {
            name: self.words()[0].into(),
            step,
            effort: vec![0.0; rows],
            position: of(&|time| self.position(time, reach)),
            load: Some(of(&|time| self.load(time, reach))),
            temperature: Some(of(&|time| cold + rise * time)),
            ..Trace::default()
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
                (angle / TAU).floor().max(1.0) * TAU * triangle(t / self.duration())
            }
        }
    }

    /// Axial load at a time, N.
    fn load(self, t: f64, reach: &Reach) -> f64 {
        let most = reach.load;
        let wave = |frequency: f64| (TAU * frequency * t).sin();
        match self {
            Self::Weave => most * (0.3 * wave(0.2) + 0.1 * wave(0.9)),
            Self::Parking => most * (0.8 * self.position(t, reach) / reach.angle + 0.2 * wave(0.3)),
            Self::MicroReversals => 0.3 * most * wave(0.11),
            Self::LoadSteps => {
                // 0 before, 1 behind, smooth over 0.1 s.
                let step = |at: f64| 0.5 * (1.0 + ((t - at) / 0.05).tanh());
                most * (0.5 * step(4.0) + 0.5 * step(7.0) - 1.5 * step(11.0) - 0.5 * step(14.0)
                    + step(17.0))
            }
            Self::WarmUp | Self::WholeTurns => 0.5 * most,
            Self::SpinDown => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn courses_keep_the_reach() {
        let reach = Reach {
            angle: 30.0,
            speed: 45.0,
            load: 2800.0,
            temperature: [293.0, 318.0],
            travel: 2e-3,
        };
        for manoeuvre in Manoeuvre::ALL {
            let trace = manoeuvre.trace(1e-3, &reach);
            let most = |list: &mut dyn Iterator<Item = f64>| list.map(f64::abs).fold(0.0, f64::max);
            let steps = trace
                .position
                .windows(2)
                .map(|pair| (pair[1] - pair[0]) / 1e-3);
            let speed = most(&mut steps.into_iter());
            assert!(speed <= 1.05 * reach.speed, "{manoeuvre:?} {speed}");
            let load = most(&mut trace.load.into_iter().flatten());
            assert!(load <= reach.load * 1.001, "{manoeuvre:?} {load}");
            let angle = most(&mut trace.position.into_iter());
            assert!(manoeuvre == Manoeuvre::SpinDown || angle <= reach.angle + 1e-9);
        }
    }
}
