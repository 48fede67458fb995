//! A linear bearing whose balls press on each other.

use epas_friction::{Error, LinearInputs, LinearOutputs};
use epas_reference::promises;

use super::balls::{Built, bearing};
use super::beyond::Beyond;
use super::encoder::EncoderStep;
use super::manoeuvre::{Manoeuvre, linear_trace};
use super::memory::{self, Remembered};
use super::picture::{self, Form, Labels};
use super::reference::ReferenceModel;
use super::samples::LinearSample;
use super::scene::Scene;
use super::summary::{Course, Lines, Moment, Pressing, Words, regime_name};
use super::trace::{Sample, Trace};
use super::train::{Train, TrainRow};
use super::train_picture::{TrainPoint, draw};
use epas_design::files::train::LinearDesign;
use epas_page::failure::Failure;
use epas_traces::flags;

/// The scene.
pub struct Linear {
    /// Its design.
    pub design: LinearDesign,
    /// Whether friction remembers.
    pub memory: bool,
    /// Step of the encoder whose noise it does not follow.
    pub encoder: EncoderStep,
}

/// One sample with what the model says to it.
pub struct LinearRow {
    sample: LinearSample,
    /// What the scene puts out.
    pub train: TrainRow<LinearOutputs>,
}

/// What a linear bearing's quantities are called.
const WORDS: Words = Words {
    load: "normal load",
    speed: "speed",
    speed_unit: "m/s",
    friction: "force",
    unit: "N",
};

impl Linear {
    fn train(
        &self,
        trace: &Trace<LinearSample>,
        remembered: Option<&Remembered>,
    ) -> Result<Train<LinearSample, LinearOutputs>, Failure> {
        let build = |tick| self.model(tick, remembered);
        Train::new(trace, build).map_err(|failure| failure.of(self.name()))
    }

    /// The model for a tick, s.
    ///
    /// # Errors
    /// [`Error`] naming a field out of range.
    pub fn model(
        &self,
        tick: f32,
        remembered: Option<&Remembered>,
    ) -> Built<LinearInputs, LinearOutputs> {
        let mut configuration = self.design.configuration;
        configuration.tick = tick;
        let friction = configuration.friction;
        let whole = memory::whole(configuration, remembered, tick, friction)?;
        bearing(&whole)
    }
}

impl Linear {
    /// Elements at a normal load, N.
    ///
    /// # Errors
    /// [`Error`] naming a field out of range.
    pub fn remembered_at(&self, normal_load: f32) -> Result<Remembered, Error> {
        let configuration = &self.design.configuration;
        let loaded = configuration.loaded_length;
        let part = loaded / (loaded + configuration.return_length);
        let balls = f32::from(self.design.balls) * part;
        memory::of_bearing(configuration, balls, normal_load)
    }

    /// Elements at the trace's mean load, where friction remembers.
    fn remembered(&self, trace: &Trace<LinearSample>) -> Result<Option<Remembered>, Failure> {
        let mut remembered = self
            .memory
            .then(|| self.remembered_at(memory::mean_load(trace)))
            .transpose()
            .map_err(|error| Failure::Data(format!("{}: {error}", self.name())))?;
        if let Some(remembered) = &mut remembered {
            remembered.encoder_step = self.encoder.size();
            remembered.lines.add_some("encoder", self.encoder.told("m"));
        }
        Ok(remembered)
    }
}

impl Scene for Linear {
    type Sample = LinearSample;
    type Row = LinearRow;

    fn name(&self) -> &str {
        &self.design.name
    }

    fn manoeuvre(&self, manoeuvre: Manoeuvre) -> Result<Trace<LinearSample>, Failure> {
        linear_trace(manoeuvre)
    }

    fn set_encoder(&mut self, encoder: EncoderStep) {
        self.encoder = encoder;
    }

    fn rows(
        &self,
        trace: &Trace<LinearSample>,
        reference: Option<ReferenceModel>,
        done: &dyn Fn(),
    ) -> Result<(Vec<LinearRow>, Lines), Failure> {
        let remembered = self.remembered(trace)?;
        let mut train = self.train(trace, remembered.as_ref())?;
        if reference.is_some() {
            return Err(Failure::Data(
                "--reference follows ball screws; rows of balls in a linear bearing are compared by eval's \
                 linear_train"
                    .into(),
            ));
        }
        let rows = trace
            .samples
            .iter()
            .map(|&sample| {
                let row = LinearRow {
                    sample,
                    train: train.step(&sample),
                };
                done();
                row
            })
            .collect();
        let lines = remembered.map_or_else(Lines::default, |remembered| remembered.lines);
        Ok((rows, lines))
    }

    fn columns(_: bool) -> Vec<&'static str> {
        let mut columns = LinearSample::COLUMNS.to_vec();
        columns.extend([
            "friction_force",
            "regime",
            "faults",
            "fault_words",
            "travel",
            "groove_friction",
            "ball_friction",
            "contacts",
            "largest_contact_force",
        ]);
        columns
    }

    fn record(row: &LinearRow) -> Vec<String> {
        let TrainRow {
            outputs, motion, ..
        } = row.train;
        let mut record = row.sample.record();
        record.extend([
            outputs.friction_force.to_string(),
            regime_name(outputs.regime).into(),
            outputs.faults.bits().to_string(),
            flags::words(outputs.faults),
            motion.to_string(),
            outputs.groove_force.to_string(),
            outputs.ball_force.to_string(),
            outputs.contacts.to_string(),
            outputs.largest_contact_force.to_string(),
        ]);
        record
    }

    fn summary(&self, trace: &Trace<LinearSample>, rows: &[LinearRow]) -> Lines {
        // The carriage's motion is its travel.
        let mut course = Course::new(1.0);
        let mut pressing = Pressing::default();
        let mut beyond = Beyond::bearing();
        for LinearRow { sample, train } in rows {
            let outputs = train.outputs;
            beyond.add(sample.speed, sample.normal_load, outputs.faults);
            let travel = course.add(&Moment {
                time: sample.time,
                speed: sample.speed,
                load: sample.normal_load,
                friction: outputs.friction_force.into(),
                regime: outputs.regime,
                faults: outputs.faults,
            });
            pressing.add(
                outputs.ball_force,
                outputs.contacts,
                outputs.largest_contact_force,
                travel,
            );
        }
        let configuration = &self.design.configuration;
        let mut settings = Lines::default();
        for (name, value, key) in [
            ("friction coefficient", configuration.friction, "friction"),
            (
                "between balls",
                configuration.ball_friction,
                "ball_friction",
            ),
        ] {
            settings.add(name, format!("{value}{}", self.design.mark(key)));
        }
        let mut lines = course.peaks(trace, self.name(), settings, &WORDS);
        course.energy(&mut lines);
        pressing.lines(&mut lines, &WORDS);
        course.regimes(&mut lines, trace.samples.len());
        course.flags(&mut lines);
        beyond.lines(&mut lines);
        lines
    }

    fn picture(
        &self,
        trace: &Trace<LinearSample>,
        rows: &[LinearRow],
        form: Form,
    ) -> Result<String, Failure> {
        // Where the motion turns back, a place on the rail stands for more than one moment.
        let reverses = trace.reverses();
        let points: Vec<_> = rows
            .iter()
            .map(|row| {
                let outputs = row.train.outputs;
                let friction = f64::from(outputs.friction_force);
                TrainPoint {
                    moment: picture::Moment {
                        place: if reverses {
                            row.sample.time
                        } else {
                            1e3 * row.train.motion
                        },
                        load: row.sample.normal_load,
                        side: Some(row.sample.side_load),
                        speed: row.sample.speed,
                        motor: None,
                        friction,
                        parts: Some([outputs.groove_force, outputs.ball_force].map(f64::from)),
                        error: Some(
                            promises::of("step_linear").largest
                                * f64::from(outputs.groove_force).abs(),
                        ),
                        reference: None,
                        regime: outputs.regime,
                        flagged: outputs.faults.any(),
                    },
                    contacts: outputs.contacts,
                    largest_contact_force: outputs.largest_contact_force,
                    pressing: row.train.pressing,
                }
            })
            .collect();
        let labels = Labels {
            title: format!("{} on {}", trace.name, self.name()),
            place: if reverses { "time (s)" } else { "travel (mm)" },
            loads: ["normal load (N)", "side load (N)"],
            speed: "speed (m/s)",
            friction: ("friction force", "N"),
            parts: ["grooves", "ball to ball"],
            error: format!(
                "largest error promised of the grooves, {:.1} %",
                100.0 * promises::of("step_linear").largest
            ),
            reference: "",
        };
        draw(&labels, &points, form)
    }
}
