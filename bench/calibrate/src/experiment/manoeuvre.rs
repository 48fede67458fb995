//! Manoeuvres of a steering gear or of a rig, from which the one that tells a parameter is chosen.

use std::f64::consts::TAU;
use std::fmt;

use crate::trace::Trace;
use epas_design::files::Design;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Manoeuvre {
    pub name: &'static str,
    pub how: &'static str,
    /// The parameters that it identifies: of `calibrate --wanted` for the built-in `lin-4.1` one of the two narrowest intervals is its; for
    /// spin-down and whole turns, what they still identify without a load and at one speed.
    pub identifies: &'static str,
    /// Duration, s.
    pub duration: f64,
    /// Angle, rad, and axial load, N, at a time.
    motion: fn(f64, &Reach) -> (f64, f64),
}

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

fn wave(frequency: f64, t: f64) -> f64 {
    (TAU * frequency * t).sin()
}

/// A sweep over nearly all of the way, with the largest speed.
fn sweep(t: f64, reach: &Reach) -> f64 {
    let frequency = (reach.speed / (TAU * reach.angle)).min(0.5);
    reach.angle * (0.8 * wave(frequency, t) + 0.2 * wave(0.44 * frequency, t))
}

pub(crate) const MANOEUVRES: [Manoeuvre; 7] = [
    Manoeuvre {
        name: "weave",
        how: "reversals of up to 0.6 rad at 0.2 to 1.5 Hz, the load follows the angle",
        identifies: "breakaway_angle gain",
        duration: 20.0,
        motion: |t, reach| {
            let size = 0.6f64.min(0.5 * reach.angle);
            let angle = 0.6 * wave(0.2, t) + 0.3 * wave(0.7, t) + 0.1 * wave(1.5, t);
            let load = 0.3 * wave(0.2, t) + 0.1 * wave(0.9, t);
            (size * angle, reach.load * load)
        },
    },
    Manoeuvre {
        name: "parking",
        how: "fast sweeps from lock to lock under up to the largest load",
        identifies: "friction full_film_ratio half_share_speed preload drag offset direction_asymmetry",
        duration: 20.0,
        motion: |t, reach| {
            let angle = sweep(t, reach);
            let load = 0.8 * angle / reach.angle + 0.2 * wave(0.3, t);
            (angle, reach.load * load)
        },
    },
    Manoeuvre {
        name: "micro reversals",
        how: "reversals at rest by 0.5 to 4 times the pre-sliding travel, 0.8 times a second",
        identifies: "breakaway_angle backlash offset",
        duration: 20.0,
        motion: |t, reach| {
            let angle = (0.5 + 3.5 * t / 20.0) * triangle(0.8 * t) + 20.0 * wave(0.05, t);
            (reach.travel * angle, 0.3 * reach.load * wave(0.11, t))
        },
    },
    Manoeuvre {
        name: "load steps",
        how: "even turning to and fro, the load stepped through 0, half and all of both signs",
        identifies: "preload gain direction_asymmetry inertia",
        duration: 20.0,
        motion: |t, reach| {
            let frequency = (0.2 * reach.speed / (4.0 * reach.angle)).max(0.1);
            let size = (0.2 * reach.speed / (4.0 * frequency)).min(reach.angle);
            // 0 before, 1 behind, smooth over 0.1 s.
            let step = |at: f64| 0.5 * (1.0 + ((t - at) / 0.05).tanh());
            let load = 0.5 * step(4.0) + 0.5 * step(7.0) - 1.5 * step(11.0) - 0.5 * step(14.0)
                + step(17.0);
            (size * triangle(frequency * t), reach.load * load)
        },
    },
    Manoeuvre {
        name: WARM_UP,
        how: "one sweep again and again under half of the load while the screw warms up",
        identifies: "friction full_film_ratio half_share_speed viscosity_pole drag inertia",
        duration: 60.0,
        motion: |t, reach| (sweep(t, reach), 0.5 * reach.load),
    },
    Manoeuvre {
        name: "spin-down",
        how: "the unloaded nut is let go at its largest speed and stops of itself",
        identifies: "drag",
        duration: 5.0,
        // Speed falls as (1 - t/T)^2 until the nut stands.
        motion: |t, reach| {
            let part = (1.0 - t / 5.0).max(0.0);
            (reach.speed * 5.0 / 3.0 * (1.0 - part.powi(3)), 0.0)
        },
    },
    Manoeuvre {
        name: "whole turns at constant load",
        how: "whole turns there and back at low speed under half of the load",
        identifies: "harmonics",
        duration: 20.0,
        motion: |t, reach| {
            let turns = (reach.angle / TAU).floor().max(1.0);
            (turns * TAU * triangle(t / 20.0), 0.5 * reach.load)
        },
    },
];

const WARM_UP: &str = "warm-up";

impl Manoeuvre {
    pub fn trace(&self, step: f64, reach: &Reach) -> Trace {
        let rows = (self.duration / step).round() as usize;
        let time = |row: usize| row as f64 * step;
        let [cold, warm] = reach.temperature;
        let rise = if self.name == WARM_UP {
            (warm - cold) / self.duration
        } else {
            0.0
        };
        let moved = (0..rows).map(|row| (self.motion)(time(row), reach));
        let (position, load) = moved.unzip();
        Trace {
            name: self.name.into(),
            step,
            effort: vec![0.0; rows],
            position,
            load: Some(load),
            temperature: Some((0..rows).map(|row| cold + rise * time(row)).collect()),
            ..Trace::default()
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
        for manoeuvre in MANOEUVRES {
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
            assert!(manoeuvre.name == "spin-down" || angle <= reach.angle + 1e-9);
        }
    }
}
