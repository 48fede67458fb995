//! A ball screw whose balls press on each other.

use std::f64::consts::TAU;

use epas_design::UncagedFold;
use epas_friction::Error;
use epas_reference::promises;

use super::beyond::Beyond;
use super::exact_screw::exact_screw;
use super::manoeuvre::{Manoeuvre, trace};
use super::memory::{self, MemorySettings, Remembered};
use super::picture::{Form, Labels, Moment};
use super::reference::{ReferenceModel, whole_screw};
use super::samples::ScrewSample;
use super::scene::{Column, OF_EVERY, OF_ROW, OF_SCREW, Row, Rows, Scene};
use super::screw::{self, ScrewSummary};
use super::summary::{Lines, Pressing};
use super::trace::{Sample, Temperature, Trace};
use super::train::{Train, draw, equal_step};
use crate::model::{self, Built};
use epas_design::files::Design;
use epas_design::files::train::UncagedDesign;
use epas_design::uncaged_scene::ScrewConfiguration;
use epas_design::{folds, uncaged_scene as uncaged};
use epas_page::failure::Failure;
use epas_page::progress::Working;

/// What is not known of a block that is folded for a run: measuring its errors takes twice as long as folding it.
const NOT_MEASURED: &str = "folded for these loads, its errors are not measured here; `design --scene uncaged` measures those of its own loads, and \
                            refuses more than 3 %";

/// The scene.
pub struct Uncaged {
    /// Its design.
    pub design: Design,
    /// Its balls.
    pub balls: UncagedDesign,
    /// Whether friction remembers.
    pub memory: Option<MemorySettings>,
}

/// Largest size of the load of a trace, N.
fn peak_load(trace: &Trace<ScrewSample>) -> f32 {
    let loads = trace.samples.iter().map(|sample| sample.load().abs());
    loads.fold(0.0, f64::max) as f32
}

impl Uncaged {
    fn train(
        &self,
        trace: &Trace<ScrewSample>,
        remembered: Option<&Remembered>,
    ) -> Result<Train, Failure> {
        // A trace that cannot be run is told before the screw is folded.
        equal_step(trace).map_err(|failure| failure.of(self.name()))?;
        let configuration = {
            let _working = Working::new("folding the screw");
            self.folded(peak_load(trace))?
        };
        let build = |tick| self.model(&configuration, tick, remembered);
        Train::new(trace, build).map_err(|failure| failure.of(self.name()))
    }

    /// Whether the errors of its block are known: of one that comes with the program.
    fn is_measured(&self, trace: &Trace<ScrewSample>) -> bool {
        self.fold(peak_load(trace))
            .is_ok_and(|fold| folds::is_stored(fold.digest()))
    }

    /// What is folded of it for axial loads up to one, N.
    fn fold(&self, axial_load: f32) -> Result<UncagedFold, Failure> {
        let friction = self.balls.gear.friction;
        uncaged::fold_for(&self.design, &self.balls, (friction, friction), axial_load)
            .map_err(Failure::Data)
    }

    /// What its model is made of, up to an axial load, N.
    pub fn folded(&self, axial_load: f32) -> Result<ScrewConfiguration, Failure> {
        let friction = self.balls.gear.friction;
        Ok(uncaged::configuration(
            &self.design,
            &self.balls,
            (friction, friction),
            axial_load,
        )?)
    }

    /// The model for a tick, s.
    pub fn model(
        &self,
        configuration: &ScrewConfiguration,
        tick: f32,
        remembered: Option<&Remembered>,
    ) -> Built {
        let configuration = ScrewConfiguration {
            tick,
            ..*configuration
        };
        model::uncaged(&configuration, remembered, self.balls.gear.friction)
    }
}

impl Uncaged {
    /// Elements at an axial load, N.
    pub fn remembered_at(&self, axial_load: f32) -> Result<Remembered, Error> {
        let gear = &self.balls.gear;
        memory::Screw {
            design: &gear.design,
            friction: gear.friction,
            clearance: gear.clearance,
            rolling_resistance: gear.rolling_resistance,
            loaded_balls: self.balls.loaded_balls(),
        }
        .remembered(axial_load)
    }

    fn settings(&self) -> Lines {
        let UncagedDesign {
            ref gear,
            ball_friction,
            ..
        } = self.balls;
        let mut settings = screw::settings(&self.design, gear.friction, gear.clearance);
        let mark = self.design.mark("ball_friction");
        settings.add("between balls", format!("{ball_friction}{mark}"));
        let [screw, nut] = self.balls.deviations().map(|angle| 1e3 * angle);
        let text = format!("screw {screw:.1} mrad, nut {nut:.1} mrad at most");
        settings.add("contact angle deviates", text);
        if self.memory.is_none() {
            let speed = screw::reversal_speed(&self.design, gear.reversal_speed);
            settings.add("reversal speed", speed);
        }
        settings
    }

    fn remembered(&self, trace: &Trace<ScrewSample>) -> Result<Option<Remembered>, Failure> {
        let Some(settings) = self.memory else {
            return Ok(None);
        };
        let remembered = settings.over(trace, "rad", |load| self.remembered_at(load));
        let mut remembered = remembered.map_err(|failure| failure.of(self.name()))?;
        if self.design.calibrated.is_some() {
            let text = "left out: what a trace has told is that of the scene caged";
            remembered.lines.add("calibration", text);
        }
        Ok(Some(remembered))
    }
}

impl Scene for Uncaged {
    type Sample = ScrewSample;

    fn name(&self) -> &str {
        &self.design.name
    }

    fn manoeuvre(&self, manoeuvre: Manoeuvre) -> Result<Trace<ScrewSample>, Failure> {
        trace(manoeuvre, self.design.screw())
    }

    fn within(&self, trace: Trace<ScrewSample>) -> (Trace<ScrewSample>, Option<String>) {
        let balls = 1.0 / self.balls.ball_load(1.0);
        // Without a table the block follows the trace.
        let block = self
            .fold(0.0)
            .ok()
            .filter(|_| self.design.fold.says_axial_load());
        let block = block.map(|fold| fold.axial_load[1] * balls);
        screw::within(trace, &self.design, balls, block)
    }

    fn set_memory(&mut self, settings: MemorySettings) {
        self.memory = self.memory.map(|_| settings);
    }

    fn rows(
        &self,
        trace: &Trace<ScrewSample>,
        _: &Temperature,
        reference: Option<ReferenceModel>,
        done: &dyn Fn(),
    ) -> Rows<ScrewSample> {
        let remembered = self.remembered(trace)?;
        let measured = self.is_measured(trace);
        let mut train = self.train(trace, remembered.as_ref())?;
        let (reference, mut lines) = match reference {
            None => Default::default(),
            Some(ReferenceModel::Exact) => exact_screw(&self.balls, trace)?,
            Some(ReferenceModel::ClosedForm) => {
                let mut lines = Lines::default();
                lines.add("reference", "closed form, at every sample");
                (whole_screw(&self.balls, trace)?, lines)
            }
        };
        let rows = train.rows(trace, &reference, done);
        if !measured {
            lines.add("block", NOT_MEASURED);
        }
        lines.add("tick", train.told());
        if let Some(remembered) = remembered {
            lines.append(remembered.lines);
        }
        Ok((rows, lines))
    }

    fn reference_name(&self, model: ReferenceModel) -> String {
        let form = match model {
            ReferenceModel::Exact => "the exact whole screw",
            ReferenceModel::ClosedForm => "the closed form of each ball, which is not exact",
        };
        let without = if self.memory.is_some() {
            ", without memory"
        } else {
            ""
        };
        format!("{form}{without}")
    }

    fn outputs() -> Vec<Column> {
        const ANGLE: Column = ("nut_angle", |_, motion| motion.to_string());
        let screw = OF_SCREW.into_iter().chain(OF_EVERY);
        screw.chain([ANGLE]).chain(OF_ROW).collect()
    }

    fn summary(&self, trace: &Trace<ScrewSample>, rows: &[Row<ScrewSample>]) -> Lines {
        // What has run was folded: nothing is refused here.
        let fold = self.fold(peak_load(trace));
        let beyond = fold.map(|fold| Beyond::uncaged(&self.balls, &fold)).ok();
        let mut summary = ScrewSummary::new(&self.design, beyond);
        let mut pressing = Pressing::default();
        for row in rows {
            let rotation = summary.add(row);
            pressing.add(&row.outputs, rotation);
        }
        summary.lines(trace, &self.design, self.settings(), Some(&pressing))
    }

    fn picture(
        &self,
        trace: &Trace<ScrewSample>,
        rows: &[Row<ScrewSample>],
        form: Form,
    ) -> Result<String, Failure> {
        // Where the motion turns back, an angle stands for more than one moment.
        let reverses = trace.reverses();
        let reduced_lead = f64::from(self.design.screw().lead()) / TAU;
        let moments: Vec<_> = rows
            .iter()
            .map(|row| {
                let outputs = row.outputs;
                let friction = f64::from(outputs.friction);
                let place = if reverses {
                    row.sample.time
                } else {
                    row.motion.to_degrees()
                };
                Moment {
                    motor: Some(row.sample.axial_load * reduced_lead + friction),
                    parts: Some([outputs.groove, outputs.ball].map(f64::from)),
                    error: Some(promises::of("step_uncaged").rms * friction.abs()),
                    ..row.moment(place)
                }
            })
            .collect();
        draw(&self.labels(trace), &moments, rows, form)
    }
}

impl Uncaged {
    fn labels(&self, trace: &Trace<ScrewSample>) -> Labels {
        Labels {
            title: format!("{} on {}", trace.name, self.name()),
            place: if trace.reverses() {
                "time (s)"
            } else {
                "nut angle (degrees)"
            },
            loads: ["axial load (N)", ""],
            speed: "nut speed (rad/s)",
            friction: ("friction torque", "N m"),
            parts: ["grooves", "ball to ball"],
            error: format!(
                "rms error promised, {:.1} %",
                100.0 * promises::of("step_uncaged").rms
            ),
            reference: "reference",
        }
    }
}
