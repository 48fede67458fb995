//! A linear bearing whose balls press on each other.

use epas_friction::Error;
use epas_reference::promises;

use super::beyond::Beyond;
use super::manoeuvre::{Manoeuvre, linear_trace};
use super::memory::{self, MemorySettings, Remembered};
use super::picture::{Form, Labels, Moment};
use super::reference::ReferenceModel;
use super::samples::LinearSample;
use super::scene::{Column, OF_EVERY, OF_ROW, Row, Rows, Scene};
use super::summary::{Course, Lines, Pressing, Words};
use super::trace::{Temperature, Trace};
use super::train::{Train, draw};
use crate::model::{self, Built};
use epas_design::files::train::LinearDesign;
use epas_page::failure::Failure;

/// The scene.
pub struct Linear {
    /// Its design.
    pub design: LinearDesign,
    /// Whether friction remembers.
    pub memory: Option<MemorySettings>,
}

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
    ) -> Result<Train, Failure> {
        let build = |tick| self.model(tick, remembered);
        Train::new(trace, build).map_err(|failure| failure.of(self.name()))
    }

    /// The model for a tick, s.
    pub fn model(&self, tick: f32, remembered: Option<&Remembered>) -> Built {
        let mut configuration = self.design.configuration;
        configuration.tick = tick;
        model::linear(configuration, remembered)
    }
}

impl Linear {
    /// Elements at a normal load, N.
    pub fn remembered_at(&self, normal_load: f32) -> Result<Remembered, Error> {
        let configuration = &self.design.configuration;
        let loaded = configuration.loaded_length;
        let part = loaded / (loaded + configuration.return_length);
        let balls = f32::from(self.design.balls) * part;
        memory::of_bearing(configuration, balls, normal_load)
    }

    fn remembered(&self, trace: &Trace<LinearSample>) -> Result<Option<Remembered>, Failure> {
        let Some(settings) = self.memory else {
            return Ok(None);
        };
        let remembered = settings.over(trace, "m", |load| self.remembered_at(load));
        remembered
            .map(Some)
            .map_err(|failure| failure.of(self.name()))
    }
}

impl Scene for Linear {
    type Sample = LinearSample;

    fn name(&self) -> &str {
        &self.design.name
    }

    fn manoeuvre(&self, manoeuvre: Manoeuvre) -> Result<Trace<LinearSample>, Failure> {
        linear_trace(manoeuvre)
    }

    fn set_memory(&mut self, settings: MemorySettings) {
        self.memory = self.memory.map(|_| settings);
    }

    fn rows(
        &self,
        trace: &Trace<LinearSample>,
        _: &Temperature,
        reference: Option<ReferenceModel>,
        done: &dyn Fn(),
    ) -> Rows<LinearSample> {
        let remembered = self.remembered(trace)?;
        let mut train = self.train(trace, remembered.as_ref())?;
        if reference.is_some() {
            return Err(Failure::Data(
                "--reference follows ball screws; rows of balls in a linear bearing are compared by eval's \
                 linear_train"
                    .into(),
            ));
        }
        let rows = train.rows(trace, &[], done);
        let lines = remembered.map_or_else(Lines::default, |remembered| remembered.lines);
        Ok((rows, lines))
    }

    fn outputs() -> Vec<Column> {
        const FRICTION: Column = ("friction_force", |outputs, _| outputs.friction.to_string());
        const TRAVEL: Column = ("travel", |_, motion| motion.to_string());
        let common = [FRICTION].into_iter().chain(OF_EVERY);
        common.chain([TRAVEL]).chain(OF_ROW).collect()
    }

    fn summary(&self, trace: &Trace<LinearSample>, rows: &[Row<LinearSample>]) -> Lines {
        // The carriage's motion is its travel.
        let mut course = Course::new(1.0);
        let mut pressing = Pressing::default();
        let mut beyond = Beyond::bearing();
        for Row {
            sample, outputs, ..
        } in rows
        {
            beyond.add(sample.speed, sample.normal_load, outputs.faults);
            let travel = course.add(sample, outputs);
            pressing.add(outputs, travel);
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
        rows: &[Row<LinearSample>],
        form: Form,
    ) -> Result<String, Failure> {
        // Where the motion turns back, a place on the rail stands for more than one moment.
        let reverses = trace.reverses();
        let error = promises::of("step_linear").largest;
        let moments: Vec<_> = rows
            .iter()
            .map(|row| {
                let place = if reverses {
                    row.sample.time
                } else {
                    1e3 * row.motion
                };
                let parts = [row.outputs.groove, row.outputs.ball].map(f64::from);
                Moment {
                    side: Some(row.sample.side_load),
                    parts: Some(parts),
                    error: Some(error * parts[0].abs()),
                    ..row.moment(place)
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
                100.0 * error
            ),
            reference: "",
        };
        draw(&labels, &moments, rows, form)
    }
}
