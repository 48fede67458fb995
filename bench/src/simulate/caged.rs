//! A ball screw whose balls do not touch.

use epas_friction::{
    CagedBallScrew, CagedBallScrewConfiguration, Error, FrictionBranch, FrictionModel, Inputs,
    Outputs,
};

use super::caged_exact::ExactCaged;
use super::manoeuvre::Manoeuvre;
use super::memory;
use super::reference::{CagedReference, Friction, ReferenceModel};
use super::remembering::{Remembers, Use, remembering};
use super::samples::ScrewSample;
use super::scene::Scene;
use super::screw::{self, ScrewSummary};
use super::summary::Lines;
use super::trace::Trace;
use crate::designs::Design;
use crate::failure::Failure;
use crate::plot::{Axis, Chart, Mark, Panel, Series, render, thin};

/// The scene.
pub struct Caged {
    /// Its design.
    pub design: Design,
    /// Whether friction remembers.
    pub memory: bool,
}

/// What runs beside the scene.
enum Reference {
    Exact(ExactCaged),
    ClosedForm(CagedReference),
}

impl Reference {
    /// The exact ball of the contacts' friction, or a closed form: that of the configuration, or of rolling balls.
    fn new(
        model: ReferenceModel,
        configuration: &CagedBallScrewConfiguration,
        trace: &Trace<ScrewSample>,
    ) -> Result<Self, Failure> {
        Ok(match (configuration.branch, model) {
            (FrictionBranch::Contacts, ReferenceModel::Exact) => {
                Self::Exact(ExactCaged::new(configuration, trace)?)
            }
            _ => Self::ClosedForm(CagedReference::new(configuration)?),
        })
    }

    fn friction(&self, sample: &ScrewSample) -> Friction {
        match self {
            Self::Exact(scene) => scene.friction(sample),
            Self::ClosedForm(scene) => scene.friction(sample),
        }
    }
}

/// The model that runs, told inputs and the angle of the nut, rad, within half a turn either way.
type Model = Box<dyn FnMut(Inputs, f32) -> Outputs>;

/// Boxes a screw that remembers.
struct Boxed;

impl Use for Boxed {
    type Made = Model;

    fn with(self, mut screw: impl Remembers + 'static) -> Model {
        Box::new(move |inputs, angle| screw.step(inputs, angle))
    }
}

impl Caged {
    /// The model over a trace, and what of its memory the summary tells.
    fn model(&self, trace: &Trace<ScrewSample>) -> Result<(Model, Lines), Failure> {
        let refused = |error: Error| Failure::Data(format!("{}: {error}", self.design.name));
        if self.memory {
            let angle = memory::angle().map_err(refused)?;
            return remembering(&self.design, memory::mean_load(trace), angle, Boxed);
        }
        let model = FrictionModel::<CagedBallScrew>::new(&self.design.configuration);
        let mut model = model.map_err(refused)?;
        let plain = Box::new(move |inputs, _| model.step(inputs));
        Ok((plain, Lines::default()))
    }
}

/// An angle within half a turn either way, rad.
pub fn wrapped(angle: f64) -> f32 {
    let half = std::f64::consts::PI;
    ((angle + half).rem_euclid(2.0 * half) - half) as f32
}

/// One sample with what the models say to it.
pub struct CagedRow {
    sample: ScrewSample,
    /// What the scene puts out.
    pub outputs: Outputs,
    /// What the float64 reference says.
    pub reference: Option<Friction>,
}

impl Scene for Caged {
    type Sample = ScrewSample;
    type Row = CagedRow;

    fn name(&self) -> &str {
        &self.design.name
    }

    fn manoeuvre(&self, manoeuvre: Manoeuvre) -> Result<Trace<ScrewSample>, Failure> {
        manoeuvre.trace(self.design.screw())
    }

    fn rows(
        &self,
        trace: &Trace<ScrewSample>,
        reference: Option<ReferenceModel>,
        done: &dyn Fn(),
    ) -> Result<(Vec<CagedRow>, Lines), Failure> {
        let configuration = &self.design.configuration;
        let (mut model, lines) = self.model(trace)?;
        let reference = reference
            .map(|model| Reference::new(model, configuration, trace))
            .transpose()?;
        let mut angle = 0.0;
        let mut last = trace.samples.first().copied();
        let rows = trace
            .samples
            .iter()
            .map(|&sample| {
                if let Some(last) = last.replace(sample) {
                    angle += 0.5 * (last.nut_speed + sample.nut_speed) * (sample.time - last.time);
                }
                let inputs = Inputs {
                    nut_speed: sample.nut_speed as f32,
                    axial_load: sample.axial_load as f32,
                };
                let outputs = model(inputs, wrapped(angle));
                done();
                CagedRow {
                    sample,
                    outputs,
                    reference: reference.as_ref().map(|scene| scene.friction(&sample)),
                }
            })
            .collect();
        Ok((rows, lines))
    }

    fn columns(with_reference: bool) -> Vec<&'static str> {
        let mut columns = screw::columns();
        if with_reference {
            columns.extend(screw::REFERENCE_COLUMNS);
        }
        columns
    }

    fn record(row: &CagedRow) -> Vec<String> {
        let mut record = screw::record(&row.sample, &row.outputs);
        record.extend(row.reference.iter().flat_map(screw::reference_record));
        record
    }

    fn summary(&self, trace: &Trace<ScrewSample>, rows: &[CagedRow]) -> Lines {
        let mut summary = ScrewSummary::new(&self.design);
        for row in rows {
            summary.add(&row.sample, &row.outputs, row.reference.as_ref());
        }
        summary.lines(trace, &self.design, None)
    }

    /// Load, speed, friction torque and efficiency against time.
    fn picture(&self, trace: &Trace<ScrewSample>, rows: &[CagedRow]) -> Result<String, Failure> {
        let curve = |value: &dyn Fn(&CagedRow) -> f64| thin(rows, &|row| row.sample.time, value);
        let single =
            |value: &dyn Fn(&CagedRow) -> f64| vec![Series::new("", 0, Mark::Line, curve(value))];
        let with_reference = rows.first().is_some_and(|row| row.reference.is_some());
        let pair = |value: &dyn Fn(&CagedRow) -> f64, reference: fn(&Friction) -> f64| {
            let mut series = vec![Series::new("in the loop, f32", 0, Mark::Line, curve(value))];
            if with_reference {
                let exact = |row: &CagedRow| row.reference.as_ref().map_or(f64::NAN, reference);
                series.push(Series::new(
                    "reference, f64",
                    1,
                    Mark::Dashed,
                    curve(&exact),
                ));
            }
            series
        };
        let panels = [
            (
                format!("{} on {}", trace.name, self.name()),
                "axial load (N)",
                single(&|row| row.sample.axial_load),
            ),
            (
                String::new(),
                "nut speed (rad/s)",
                single(&|row| row.sample.nut_speed),
            ),
            (
                String::new(),
                "friction torque (N m)",
                pair(&|row| row.outputs.friction_torque.into(), |friction| {
                    friction.friction_torque
                }),
            ),
            (
                String::new(),
                "efficiency",
                pair(&|row| row.outputs.efficiency.into(), |friction| {
                    friction.efficiency
                }),
            ),
        ]
        .map(|(title, label, series)| {
            Panel::Chart(Chart {
                title,
                x: Axis::linear("time (s)"),
                y: Axis::linear(label),
                series,
                notes: Vec::new(),
            })
        });
        render(&panels, 1, (1000, 270))
    }
}
