//! What a scene does with a trace. Each has its own samples, rows, columns and words; which one it is is
//! decided once, from the design.

use super::encoder::EncoderStep;
use super::manoeuvre::Manoeuvre;
use super::picture::Form;
use super::reference::ReferenceModel;
use super::summary::Lines;
use super::trace::{SceneSample, Temperature, Trace};
use epas_page::failure::Failure;

/// A scene with its design.
pub trait Scene {
    /// One moment of its traces.
    type Sample: SceneSample;
    /// One sample with what the models say to it.
    type Row;

    /// Name of the design, for headings and file names.
    fn name(&self) -> &str;

    /// A manoeuvre for this design.
    ///
    /// # Errors
    /// A manoeuvre of another mechanism.
    fn manoeuvre(&self, manoeuvre: Manoeuvre) -> Result<Trace<Self::Sample>, Failure>;

    /// A manoeuvre's trace within the loads that the design is made for, and how it was changed where it was.
    fn within(&self, trace: Trace<Self::Sample>) -> (Trace<Self::Sample>, Option<String>) {
        (trace, None)
    }

    /// Takes the encoder of the trace, whose noise friction that remembers does not follow.
    fn set_encoder(&mut self, encoder: EncoderStep);

    /// Refuses a design whose block is too far from the exact model, as `design` does.
    ///
    /// # Errors
    /// What cannot be folded, with the reason.
    fn check_errors(&self) -> Result<(), Failure> {
        Ok(())
    }

    /// Runs the in-loop model over a trace, with the float64 reference where one is wanted; `done` is called
    /// after each sample. Lines tell what of the reference was computed.
    ///
    /// # Errors
    /// A design or a trace that the models refuse.
    fn rows(
        &self,
        trace: &Trace<Self::Sample>,
        reference: Option<ReferenceModel>,
        done: &dyn Fn(),
    ) -> Result<(Vec<Self::Row>, Lines), Failure>;

    /// What a reference is, for the summary.
    fn reference_name(&self, _: ReferenceModel) -> String {
        String::new()
    }

    /// Whether temperatures of a trace change anything beside a reference or without one; the reason where they do not.
    ///
    /// # Errors
    /// The reason.
    fn follows_temperature(&self, _with_reference: bool) -> Result<(), &'static str> {
        Err("rows of balls have one friction coefficient; --scene caged follows it")
    }

    /// Takes up that the trace has a temperature, which is followed.
    fn follow_temperature(&mut self) {}

    /// The same as [`rows`](Self::rows) with a trace's temperatures, where it follows them.
    ///
    /// # Errors
    /// A design or a trace that the models refuse.
    fn rows_at(
        &self,
        trace: &Trace<Self::Sample>,
        _: &Temperature,
        reference: Option<ReferenceModel>,
        done: &dyn Fn(),
    ) -> Result<(Vec<Self::Row>, Lines), Failure> {
        self.rows(trace, reference, done)
    }

    /// Columns of the table: those of the trace, then the outputs.
    fn columns(with_reference: bool) -> Vec<&'static str>;

    /// A row of the table.
    fn record(row: &Self::Row) -> Vec<String>;

    /// What a run comes to.
    fn summary(&self, trace: &Trace<Self::Sample>, rows: &[Self::Row]) -> Lines;

    /// The run as a picture of some form.
    ///
    /// # Errors
    /// A picture that cannot be drawn.
    fn picture(
        &self,
        trace: &Trace<Self::Sample>,
        rows: &[Self::Row],
        form: Form,
    ) -> Result<String, Failure>;
}
