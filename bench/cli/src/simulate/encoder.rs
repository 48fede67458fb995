//! The encoder of a trace: noise of one step at rest is no motion, and friction that remembers must not follow it.

use epas_friction::Error;
use epas_friction::law::motion::Deadband;

use super::trace::{SceneSample, Trace};

/// Turns in a row, forward and back, that are flicker.
const FLICKER: usize = 8;

/// Sizes of two turns within this of each other are the same step: numbers are printed with few digits.
const SAME: f64 = 1e-2;

/// Two angles within half a turn either way differ by this much from what they were before they were rounded to single precision, rad.
const ROUNDED: f32 = 2.0 * f32::EPSILON;

#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Origin {
    /// No step was asked for, and none is seen.
    #[default]
    None,
    Asked,
    Position,
    Speed,
}

/// Step of an encoder, of the motion that friction remembers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EncoderStep {
    /// Size, rad of the nut or m of the carriage; 0 without.
    step: f64,
    origin: Origin,
}

/// A step, rad (m).
pub fn step(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (0.0..=0.1).contains(&value) => Ok(value),
        _ => Err("a step of an encoder is 0 to 0.1 rad (m of a carriage)".into()),
    }
}

impl EncoderStep {
    /// The one that is asked for, else that of the flicker of the trace's position, or of its speed where it has no position.
    pub fn of<S: SceneSample>(asked: Option<f64>, trace: &Trace<S>) -> Self {
        if let Some(step) = asked {
            let origin = Origin::Asked;
            return Self { step, origin };
        }
        let pairs = trace.samples.iter().zip(trace.samples.iter().skip(1));
        let (step, origin) = if trace.has_position() {
            let turns = pairs.map(|(before, sample)| sample.position() - before.position());
            (flicker(turns), Origin::Position)
        } else {
            let turns =
                pairs.map(|(before, sample)| sample.speed() * (sample.time() - before.time()));
            (flicker(turns), Origin::Speed)
        };
        if step > 0.0 {
            Self { step, origin }
        } else {
            Self::default()
        }
    }

    /// The size, rad (m).
    pub const fn size(self) -> f32 {
        self.step as f32
    }

    /// What the summary says of it, in rad or m.
    pub fn told(self, unit: &str) -> Option<String> {
        let from = match self.origin {
            Origin::None => return None,
            Origin::Asked if self.step == 0.0 => {
                return Some("no dead band: noise of the motion moves friction".into());
            }
            Origin::Asked => "--encoder-step",
            Origin::Position => "the flicker of the trace's position at rest",
            Origin::Speed => "the flicker of the trace's speed at rest",
        };
        Some(format!(
            "dead band of {:.4} m{unit}, the encoder's step, by {from}: flicker moves no friction, a reversal is felt that much later",
            1e3 * self.step
        ))
    }
}

/// A sensor of an angle or a speed behind a dead band of its step and of a backlash, rad (m): plays in a row are one of the sum of their
/// widths.
pub fn behind<A: Copy>(angle: A, step: f32, backlash: f32) -> Result<Deadband<A>, Error> {
    let step = if step > 0.0 { step + ROUNDED } else { 0.0 };
    Deadband::new(angle, 0.5 * (step + backlash))
}

/// Size of the flicker in a row of turns, rad (m): one step forward and one back, many times in a row, each between two samples; 0 where there is
/// none. Motion does not do so: it takes more than a tick each way.
fn flicker(turns: impl Iterator<Item = f64>) -> f64 {
    let (mut pulses, mut last, mut step) = (0, 0.0_f64, 0.0_f64);
    for turn in turns.filter(|turn| *turn != 0.0) {
        if (last + turn).abs() < SAME * turn.abs() {
            pulses += 1;
            step = step.max(turn.abs());
        } else {
            (pulses, step) = (1, turn.abs());
        }
        if pulses == FLICKER {
            return step;
        }
        last = turn;
    }
    0.0
}

#[cfg(test)]
mod tests;
