//! A measured trace, from the tables of [`epas_traces`].

pub mod columns;
pub mod free_load;
// Tables of cases, a line each.
#[cfg(test)]
#[rustfmt::skip]
mod tests;

use std::borrow::Cow;
use std::ops::Range;

pub use epas_traces::channels;
use epas_traces::marks::LeftOut;
use epas_traces::units::Part;

/// What position, speed and effort are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Coordinate {
    #[default]
    /// Angle of the nut, rad, and torque on it, N m.
    Rotation,
    /// Travel of the carriage, m, and force on it, N.
    Translation,
}

/// What a reader of a trace has repaired.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Repairs {
    /// Samples that were missing, and are interpolated now.
    pub missing: usize,
    /// Samples whose time was off by more than a tenth of a tick, and are interpolated at their tick now.
    pub jittered: usize,
    /// Samples that stood twice.
    pub repeated: usize,
    /// Samples of a clock that runs free, without an even tick: all of them are interpolated.
    pub free_running: usize,
    /// Samples that are not believed, by column.
    pub left_out: Vec<LeftOut>,
    /// What else was done, a sentence each.
    pub notes: Vec<String>,
}

/// Which columns the channels are from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Origins {
    /// The position, or the speed without one, and what it is of.
    pub motion: Option<(String, Part)>,
    /// The effort.
    pub effort: String,
    /// The load, or its torque.
    pub load: Option<String>,
    /// Whether a ratio of motor and nut was given.
    pub ratio_known: bool,
}

impl Origins {
    /// The columns between which a ratio is missing: the motor's motion beside a load, which acts at the nut, or the nut's motion beside an
    /// effort of the motor; `None` where one was given, or none is needed.
    pub fn without_ratio(&self) -> Option<[&str; 2]> {
        let (motion, part) = self.motion.as_ref().filter(|_| !self.ratio_known)?;
        match (part, &self.load) {
            (Part::Motor, Some(load)) => Some([motion, load]),
            (Part::Nut, _) => Some([motion, &self.effort]),
            _ => None,
        }
    }
}

/// A trace on one sample clock, in SI units. All lists are as long as `effort`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    /// Name, for headings: the file's without its ending.
    pub name: String,
    /// What position, speed and effort are.
    pub coordinate: Coordinate,
    /// Time of the first sample, s.
    pub start: f64,
    /// Tick, s.
    pub step: f64,
    /// Position, rad or m, without jumps of a turn; summed up from the speed where only that was measured.
    pub position: Vec<f64>,
    /// Step of the position's sensor, rad or m, found from the samples; 0 where there is none to be seen.
    pub resolution: f64,
    /// Whether position was not measured but summed up from the speed.
    pub position_summed: bool,
    /// Speed, where it was measured, rad/s or m/s.
    pub speed: Option<Vec<f64>>,
    /// Effort of the motor, N m or N, in the direction of positive motion.
    pub effort: Vec<f64>,
    /// Wanted position, rad or m.
    pub reference_position: Option<Vec<f64>>,
    /// Axial load, N, positive where it opposes the travel that a positive motion makes; its torque, N m, where `load_is_effort` beside a
    /// torque.
    pub load: Option<Vec<f64>>,
    /// Whether the load is in the effort's own unit, so that its gain is known to be 1.
    pub load_is_effort: bool,
    /// An effort beside the motor's that is known.
    pub known: Option<KnownEffort>,
    /// Temperature, K.
    pub temperature: Option<Vec<f64>>,
    /// Stretches in which some channel is not to be believed, in order and apart: dropouts, spikes, lost or clipped stretches, gaps. The
    /// values there are interpolated.
    pub left_out: Vec<Range<usize>>,
    /// Which columns the channels are from.
    pub origins: Origins,
    /// What was repaired.
    pub repairs: Repairs,
    /// Names of the file's columns that are none of these.
    pub ignored: Vec<String>,
}

impl Trace {
    /// Number of samples.
    pub fn len(&self) -> usize {
        self.effort.len()
    }

    /// Effort that acts on the mechanism, N m or N, in the direction of positive motion: the motor's, and what is known beside it.
    pub fn acting(&self) -> Cow<'_, [f64]> {
        match self.known.as_ref().and_then(KnownEffort::beside) {
            Some(known) => {
                let both = self.effort.iter().zip(known);
                Cow::Owned(both.map(|(effort, known)| effort + known).collect())
            }
            None => Cow::Borrowed(&self.effort),
        }
    }

    /// What the reader has repaired and left aside, a sentence each.
    pub fn told(&self) -> Vec<String> {
        let repairs = &self.repairs;
        let mut told = Vec::new();
        if repairs.missing + repairs.jittered + repairs.repeated > 0 {
            told.push(format!(
                "{} missing samples and {} beside their tick were interpolated, {} that stood twice were dropped",
                repairs.missing, repairs.jittered, repairs.repeated
            ));
        }
        if repairs.free_running > 0 {
            told.push(format!(
                "the samples have no even tick, as of a logger that runs free: all {} of them were interpolated at their own times to ticks of {:.4} ms",
                repairs.free_running,
                1e3 * self.step
            ));
        }
        told.extend(repairs.left_out.iter().map(LeftOut::told));
        told.extend(repairs.notes.iter().cloned());
        if !self.ignored.is_empty() {
            told.push(format!("columns left aside: {}", self.ignored.join(", ")));
        }
        told
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.effort.is_empty()
    }
}

/// An effort that is known and that the controller did not command: a pulse, a weight on a cord, another drive. It acts in the direction of positive
/// motion. Some recorders add it to the motor's effort, because it is made at the controller's output; others do not: whichever explains the motion
/// better.
#[derive(Clone, Debug, PartialEq)]
pub struct KnownEffort {
    /// At every sample, N m or N, in the direction of positive motion.
    pub values: Vec<f64>,
    /// Whether the motor's effort holds it already.
    pub in_effort: bool,
}

impl KnownEffort {
    /// What acts beside the motor's effort.
    pub fn beside(&self) -> Option<&[f64]> {
        (!self.in_effort).then_some(self.values.as_slice())
    }

    /// What the motor's effort holds beside the controller's.
    pub fn within(&self) -> Option<&[f64]> {
        self.in_effort.then_some(self.values.as_slice())
    }
}
