//! What a function is called with, as far as loops depend on it.

use super::arguments::{Argument, argument};
use super::bounds::{Count, balls_in};
use super::origin::Frame;
use super::steps::Steps;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Context {
    pub balls: Option<u32>,
    pub bytes: Option<u32>,
}

impl Context {
    /// Within these functions, from the outermost one inwards: the innermost one that names a number of balls counts.
    pub fn within(self, frames: &[Frame]) -> Self {
        let mut names = frames.iter().rev();
        let balls = names.find_map(|frame| balls_in(&frame.function));
        Self {
            balls: balls.or(self.balls),
            ..self
        }
    }

    /// A number; none where it depends on what is not known.
    pub fn count(self, count: Count) -> Option<f64> {
        let balls = self.balls.map(f64::from);
        match count {
            Count::Balls => balls,
            Count::BallsLessOne => Some(balls? - 1.0),
        }
    }

    /// Of a function with this name that is called by the instruction at an address, which stands within these functions.
    pub fn of_call(
        self,
        name: &str,
        steps: &Steps,
        call: u32,
        frames: &[Frame],
    ) -> Result<Self, String> {
        let bytes = match length_register(name) {
            None => None,
            Some(register) => match argument(steps, call, register) {
                Argument::Constant(bytes) => Some(bytes),
                Argument::Inherited => self.bytes,
                // A function of memory passes on no more than it was called with.
                Argument::Unknown if self.bytes.is_some() => self.bytes,
                Argument::Unknown => {
                    return Err(format!(
                        "{name} is called with a length that only the run knows at {call:#x}"
                    ));
                }
            },
        };
        Ok(Self { bytes, ..self }.within(frames))
    }
}

/// The register in which a function of memory is told how many bytes.
fn length_register(name: &str) -> Option<&'static str> {
    if name.starts_with("__aeabi_memclr") || name.starts_with("__aeabi_memset") {
        Some("r1")
    } else if ["memmove", "memcpy", "memset"]
        .iter()
        .any(|part| name.contains(part))
    {
        Some("r2")
    } else {
        None
    }
}
