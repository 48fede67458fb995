//! What a scene does with a trace. Each has its own samples, rows, columns and words; which one it is is
//! decided once, from the design.

use super::manoeuvre::Manoeuvre;
use super::memory::MemorySettings;
use super::picture::{self, Form};
use super::reference::{Friction, ReferenceModel};
use super::summary::{Lines, regime_name};
use super::trace::{Sample, SceneSample, Temperature, Trace};
use crate::model::TickOutputs;
use epas_page::failure::Failure;
use epas_traces::flags;

/// One sample with what the models say to it.
#[derive(Clone, Copy, Debug)]
pub struct Row<S> {
    /// The moment of the trace.
    pub sample: S,
    /// Temperature of the tick, K.
    pub temperature: f32,
    /// Outputs of the scene.
    pub outputs: TickOutputs,
    /// Balls that press on the one in front, one bit each.
    pub pressing: u64,
    /// Motion since the first sample: angle of the nut, rad, or travel of the carriage, m.
    pub motion: f64,
    /// What the float64 reference says.
    pub reference: Option<Friction>,
}

/// Every sample of a run, and lines that tell of it.
pub type Rows<S> = Result<(Vec<Row<S>>, Lines), Failure>;

impl<S: Sample> Row<S> {
    /// What every scene shows of it in a picture, at a place along the horizontal axis.
    pub fn moment(&self, place: f64) -> picture::Moment {
        picture::Moment {
            place,
            load: self.sample.load(),
            side: None,
            speed: self.sample.speed(),
            motor: None,
            friction: self.outputs.friction.into(),
            parts: None,
            error: None,
            reference: self.reference.map(|friction| friction.friction_torque),
            regime: self.outputs.regime,
            flagged: self.outputs.faults.any(),
        }
    }
}

/// A column of outputs: its name, and its text by the outputs of a tick and the motion since the first sample.
pub type Column = (&'static str, fn(&TickOutputs, f64) -> String);

pub const OF_SCREW: [Column; 3] = [
    ("friction_torque", |outputs, _| outputs.friction.to_string()),
    ("load_torque", |outputs, _| outputs.load_torque.to_string()),
    ("efficiency", |outputs, _| outputs.efficiency.to_string()),
];

pub const OF_EVERY: [Column; 3] = [
    ("regime", |outputs, _| regime_name(outputs.regime).into()),
    ("faults", |outputs, _| outputs.faults.bits().to_string()),
    ("fault_words", |outputs, _| flags::words(outputs.faults)),
];

pub const OF_ROW: [Column; 4] = [
    ("groove_friction", |outputs, _| outputs.groove.to_string()),
    ("ball_friction", |outputs, _| outputs.ball.to_string()),
    ("contacts", |outputs, _| outputs.contacts.to_string()),
    ("largest_contact_force", |outputs, _| {
        outputs.largest_contact_force.to_string()
    }),
];

const REFERENCE: [&str; 2] = ["reference_friction_torque", "reference_efficiency"];

/// Columns of the table: those of the trace, the outputs, the reference.
pub fn columns<S: Scene>(with_reference: bool) -> Vec<&'static str> {
    let outputs = S::outputs().into_iter().map(|(name, _)| name);
    let mut columns: Vec<_> = S::Sample::COLUMNS.iter().copied().chain(outputs).collect();
    if with_reference {
        columns.extend(REFERENCE);
    }
    columns
}

pub fn record<S: Sample>(outputs: &[Column], row: &Row<S>) -> Vec<String> {
    let numbers = row.sample.numbers().into_iter().take(S::COLUMNS.len());
    let mut record: Vec<String> = numbers.map(|number| number.to_string()).collect();
    record.extend(
        outputs
            .iter()
            .map(|(_, text)| text(&row.outputs, row.motion)),
    );
    if let Some(friction) = row.reference {
        record
            .extend([friction.friction_torque, friction.efficiency].map(|value| value.to_string()));
    }
    record
}

/// A scene with its design.
pub trait Scene {
    /// One moment of its traces.
    type Sample: SceneSample;

    /// Name of the design, for headings and file names.
    fn name(&self) -> &str;

    /// A manoeuvre for this design.
    fn manoeuvre(&self, manoeuvre: Manoeuvre) -> Result<Trace<Self::Sample>, Failure>;

    /// A manoeuvre's trace within the loads that the design is made for, and how it was changed where it was.
    fn within(&self, trace: Trace<Self::Sample>) -> (Trace<Self::Sample>, Option<String>) {
        (trace, None)
    }

    /// Takes what friction that remembers follows, where it does.
    fn set_memory(&mut self, settings: MemorySettings);

    /// Refuses a design whose block is too far from the exact model, as `design` does.
    fn check_errors(&self) -> Result<(), Failure> {
        Ok(())
    }

    /// Runs the in-loop model over a trace, with its temperatures where it follows them and the float64 reference where one is wanted; `done` is
    /// called after each sample. Lines tell what of the reference was computed.
    fn rows(
        &self,
        trace: &Trace<Self::Sample>,
        temperature: &Temperature,
        reference: Option<ReferenceModel>,
        done: &dyn Fn(),
    ) -> Rows<Self::Sample>;

    /// What a reference is, for the summary.
    fn reference_name(&self, _: ReferenceModel) -> String {
        String::new()
    }

    /// Whether temperatures of a trace change anything beside a reference or without one; the reason where they do not.
    fn follows_temperature(&self, _with_reference: bool) -> Result<(), &'static str> {
        Err("rows of balls have one friction coefficient; --scene caged follows it")
    }

    /// Takes up that the trace has a temperature, which is followed.
    fn follow_temperature(&mut self) {}

    /// Columns of the table behind those of the trace.
    fn outputs() -> Vec<Column>;

    /// What a run comes to.
    fn summary(&self, trace: &Trace<Self::Sample>, rows: &[Row<Self::Sample>]) -> Lines;

    /// The run as a picture of some form.
    fn picture(
        &self,
        trace: &Trace<Self::Sample>,
        rows: &[Row<Self::Sample>],
        form: Form,
    ) -> Result<String, Failure>;
}
