//! A ball screw whose balls do not touch.

use epas_design::{CagedDesign, CagedFold};
use epas_friction::{Error, FrictionBranch, RollingResistance};
use epas_reference::promises::{self, Promise};

use super::beyond::Beyond;
use super::caged_exact::ExactCaged;
use super::lawful::Lawful;
use super::manoeuvre::{Manoeuvre, trace};
use super::memory::{self, MemorySettings};
use super::picture::{self, Form, Labels, Moment};
use super::reference::{CagedReference, Friction, ReferenceModel};
use super::remembering::{Remembering, remembering};
use super::samples::ScrewSample;
use super::scene::{Column, OF_EVERY, OF_SCREW, Row, Rows, Scene};
use super::screw::{self, ScrewSummary};
use super::summary::Lines;
use super::trace::{SceneSample, Temperature, Trace};
use crate::model::{self, TEMPERATURE, TickInputs, TickOutputs};
use epas_calibrate::outputs::firmware;
use epas_design::caged_scene::{self as caged, CagedScene};
use epas_design::files::Design;
use epas_page::failure::Failure;
use epas_page::progress::Progress;

/// Largest load of a ball for which errors of the friction are promised, N.
const LARGEST_BALL_LOAD: f64 = 300.0;

/// The scene.
pub struct Caged {
    /// Its design.
    pub design: Design,
    /// How friction remembers, where it does.
    pub memory: Option<MemorySettings>,
    /// Whether friction follows the trace's temperature.
    pub temperature: bool,
}

enum Reference {
    Exact(ExactCaged),
    ClosedForm(CagedReference),
}

impl Reference {
    /// The exact ball, whatever the design's friction follows, or a closed form: that of the design, or of rolling balls.
    fn new(
        model: ReferenceModel,
        design: &Design,
        trace: &Trace<ScrewSample>,
    ) -> Result<Self, Failure> {
        Ok(match model {
            ReferenceModel::Exact => Self::Exact(ExactCaged::new(&design.caged, trace)?),
            ReferenceModel::ClosedForm => {
                let branch = design.branch.unwrap_or(FrictionBranch::Rolling);
                Self::ClosedForm(CagedReference::new(&design.in_closed_form(branch))?)
            }
        })
    }

    fn friction(&self, sample: &ScrewSample) -> Friction {
        match self {
            Self::Exact(scene) => scene.friction(sample),
            Self::ClosedForm(scene) => scene.friction(sample),
        }
    }
}

type Step = Box<dyn FnMut(&TickInputs) -> TickOutputs>;

impl Caged {
    fn model(&self, trace: &Trace<ScrewSample>) -> Result<(Step, Lines), Failure> {
        let refused = |error: Error| Failure::Data(format!("{}: {error}", self.design.name));
        if let Some(settings) = self.memory {
            let angle = memory::angle().map_err(refused)?;
            let sensor = (angle, settings.encoder.size());
            let loads = trace.samples.iter().map(|sample| sample.axial_load);
            let load = settings.load(loads.clone());
            let Remembering {
                mut model,
                mut lines,
                proportional_at,
            } = remembering(&self.design, load, sensor)?;
            if trace.has_position() {
                lines.add("angle", "the trace's nut_position");
            }
            lines.add_some("encoder", settings.encoder.told("rad"));
            let far = settings.far(&self.design, loads, proportional_at)?;
            lines.add_some(memory::FAR, far);
            return Ok((Box::new(move |inputs| model.step(inputs)), lines));
        }
        let law = firmware::law(&self.design)?.filter(|_| self.temperature);
        let plain: Step = if let Some(law) = &law {
            let mut model = Lawful::new(&self.design, law)?;
            Box::new(move |inputs| model.step(inputs))
        } else {
            let mut model = model::caged(&CagedScene::of(&self.design)?).map_err(refused)?;
            Box::new(move |inputs| model.step(inputs))
        };
        let mut lines = Lines::default();
        lines.add_some("closed form", self.design.branch.map(range_of));
        let calibrated = self.design.calibrated.as_ref();
        let left =
            calibrated.map_or_else(Vec::new, |calibrated| calibrated.remembered(law.is_none()));
        if !left.is_empty() {
            let text = format!("without --memory left out: {}", left.join(", "));
            lines.add("calibration", text);
        }
        Ok((plain, lines))
    }

    fn follow(
        &self,
        trace: &Trace<ScrewSample>,
        temperature: impl Fn(usize) -> Option<f32>,
        reference: Option<ReferenceModel>,
        done: &dyn Fn(),
    ) -> Rows<ScrewSample> {
        let (mut model, mut lines) = self.model(trace)?;
        let reference = reference
            .map(|model| Reference::new(model, &self.design, trace))
            .transpose()?;
        if let Some(Reference::Exact(exact)) = &reference {
            lines.append(exact.told(&trace.samples));
        }
        let measured = trace.has_position();
        let mut angle = 0.0;
        let mut last = trace.samples.first().copied();
        let rows = trace
            .samples
            .iter()
            .enumerate()
            .map(|(index, &sample)| {
                if let Some(last) = last.replace(sample) {
                    angle += 0.5 * (last.nut_speed + sample.nut_speed) * (sample.time - last.time);
                }
                if measured {
                    angle = sample.nut_position;
                }
                let temperature = temperature(index).unwrap_or(TEMPERATURE);
                let outputs = model(&TickInputs {
                    reading: wrapped(angle),
                    temperature,
                    ..sample.inputs()
                });
                done();
                Row {
                    sample,
                    temperature,
                    outputs,
                    pressing: 0,
                    motion: angle,
                    reference: reference.as_ref().map(|scene| scene.friction(&sample)),
                }
            })
            .collect();
        Ok((rows, lines))
    }
}

/// Refuses a design whose block is too far from the exact ball, as `design` does.
pub fn check_errors(design: &Design, by_law: bool) -> Result<(), Failure> {
    fold(design, by_law)?.map_or(Ok(()), |fold| {
        let progress = Progress::of_fold();
        let checked = caged::check_errors(&fold, &|share| progress.share(share));
        Ok(checked.map_err(|failure| failure.of(&design.name))?)
    })
}

/// What is folded of a design for a run, for all coefficients of its law where friction follows one; nothing of a closed form.
pub fn fold(design: &Design, by_law: bool) -> Result<Option<CagedFold>, Failure> {
    if design.branch.is_some() {
        return Ok(None);
    }
    let own = (design.caged.friction, design.caged.friction);
    let asked = if by_law {
        firmware::coefficients(design)?
    } else {
        own
    };
    let fold = caged::fold_for(design, asked).map_err(Failure::Data);
    fold.map(Some).map_err(|failure| failure.of(&design.name))
}

fn range_of(branch: FrictionBranch) -> String {
    let range = match branch {
        FrictionBranch::Rolling => "0.02 to 1.1",
        FrictionBranch::Sliding => "0.6 to 14",
    };
    format!(
        "{range} times the exact torque over the built-in designs; --reference compares it, and without branch in the design file the exact ball is folded"
    )
}

/// An angle within half a turn either way, rad.
pub fn wrapped(angle: f64) -> f32 {
    let half = std::f64::consts::PI;
    ((angle + half).rem_euclid(2.0 * half) - half) as f32
}

impl Scene for Caged {
    type Sample = ScrewSample;

    fn name(&self) -> &str {
        &self.design.name
    }

    fn manoeuvre(&self, manoeuvre: Manoeuvre) -> Result<Trace<ScrewSample>, Failure> {
        trace(manoeuvre, self.design.screw())
    }

    fn within(&self, trace: Trace<ScrewSample>) -> (Trace<ScrewSample>, Option<String>) {
        let balls = f32::from(self.design.caged.loaded_balls);
        // What cannot be folded is told by the run.
        let fold = fold(&self.design, false).ok().flatten();
        let block = fold.map(|fold| fold.axial_load[1] * balls);
        screw::within(trace, &self.design, balls, block)
    }

    fn set_memory(&mut self, settings: MemorySettings) {
        self.memory = self.memory.map(|_| settings);
    }

    fn check_errors(&self) -> Result<(), Failure> {
        let checked = check_errors(&self.design, self.memory.is_some() || self.temperature);
        if !self.design.by_default_law {
            return checked;
        }
        checked.map_err(|failure| {
            Failure::Data(format!(
                "{}; the trace's temperature moves the friction coefficient: friction_law = \"constant\" in the design file switches that off",
                failure.message()
            ))
        })
    }

    fn reference_name(&self, model: ReferenceModel) -> String {
        let form = match (self.design.branch, model) {
            (None, ReferenceModel::Exact) => "one ball in elastic balance",
            (Some(_), ReferenceModel::Exact) => {
                "one ball in elastic balance, another model than the design's closed form"
            }
            (None, ReferenceModel::ClosedForm) => {
                "a rolling ball in closed form, another model than the design's friction of contacts"
            }
            (Some(FrictionBranch::Sliding), _) => "the design's closed form, a sliding ball",
            (Some(_), _) => "the design's closed form, a rolling ball",
        };
        let without = match (self.memory.is_some(), &self.design.calibrated) {
            (false, _) => "",
            (true, None) => ", without memory",
            (true, Some(_)) => ", without memory and calibration",
        };
        format!("{form}{without}")
    }

    fn follows_temperature(&self, with_reference: bool) -> Result<(), &'static str> {
        if with_reference && self.memory.is_none() {
            return Err("the reference has one friction coefficient, and the model beside it too");
        }
        self.design.follows_temperature()
    }

    fn follow_temperature(&mut self) {
        self.temperature = true;
        self.design.by_default_law = self.design.calibrated.is_none();
    }

    fn rows(
        &self,
        trace: &Trace<ScrewSample>,
        temperature: &Temperature,
        reference: Option<ReferenceModel>,
        done: &dyn Fn(),
    ) -> Rows<ScrewSample> {
        self.follow(trace, |sample| temperature.at(sample), reference, done)
    }

    fn outputs() -> Vec<Column> {
        OF_SCREW.into_iter().chain(OF_EVERY).collect()
    }

    fn summary(&self, trace: &Trace<ScrewSample>, rows: &[Row<ScrewSample>]) -> Lines {
        // What has run was folded: nothing is refused here.
        let fold = fold(&self.design, self.memory.is_some() || self.temperature)
            .ok()
            .flatten();
        let beyond = fold.map(|fold| Beyond::caged(&self.design, &fold));
        let mut summary = ScrewSummary::new(&self.design, beyond);
        for row in rows {
            summary.add(row);
        }
        let CagedDesign {
            friction,
            clearance,
            loaded_balls,
            reversal_speed,
            ..
        } = self.design.caged;
        let mut settings = screw::settings(&self.design, friction, clearance);
        if self.memory.is_none() {
            let speed = screw::reversal_speed(&self.design, reversal_speed);
            settings.add("reversal speed", speed);
        }
        let balls = self.design.mark("loaded_balls");
        if !balls.is_empty() {
            settings.add(
                "loaded balls",
                format!("{loaded_balls}{balls}, of 2.5 turns"),
            );
        }
        summary.lines(trace, &self.design, settings, None)
    }

    fn picture(
        &self,
        trace: &Trace<ScrewSample>,
        rows: &[Row<ScrewSample>],
        form: Form,
    ) -> Result<String, Failure> {
        let labels = self.labels(trace);
        let moments = self.moments(trace, rows)?;
        form.draw(&labels.title, &picture::panels(&labels, &moments, form))
    }
}

impl Caged {
    fn promise(&self) -> Option<&'static Promise> {
        let by_law = self.temperature || self.memory.is_some() && self.design.calibrated.is_some();
        match self.design.branch {
            None if by_law => Some(promises::of("step_caged_range")),
            None => Some(promises::of("step_caged")),
            Some(_) => None,
        }
    }

    fn labels(&self, trace: &Trace<ScrewSample>) -> Labels {
        let error = self.promise().map_or(0.0, |promise| promise.largest);
        Labels {
            title: format!("{} on {}", trace.name, self.design.name),
            place: "time (s)",
            loads: ["axial load (N)", ""],
            speed: "nut speed (rad/s)",
            friction: ("friction torque", "N m"),
            parts: ["slip and spin", "rolling resistance"],
            error: format!("largest error promised, {:.1} %", 100.0 * error),
            reference: if self.memory.is_some() {
                "reference without memory"
            } else {
                "reference"
            },
        }
    }

    /// Every sample for the picture. Slip and spin are the friction without rolling resistance.
    pub fn moments(
        &self,
        trace: &Trace<ScrewSample>,
        rows: &[Row<ScrewSample>],
    ) -> Result<Vec<Moment>, Failure> {
        let caged = &self.design.caged;
        let resists = caged.rolling_resistance != RollingResistance::NONE;
        let slips = (resists && self.design.branch.is_none())
            .then(|| {
                let mut design = self.design.clone();
                design.caged.rolling_resistance = RollingResistance::NONE;
                let slipping = Self {
                    design,
                    memory: self.memory,
                    temperature: self.temperature,
                };
                let at = |sample: usize| rows.get(sample).map(|row| row.temperature);
                slipping.follow(trace, at, None, &|| ())
            })
            .transpose()?;
        let promise = self.promise();
        let largest_load = LARGEST_BALL_LOAD * f64::from(caged.loaded_balls);
        let moment = |(index, row): (usize, &Row<ScrewSample>)| {
            let friction = f64::from(row.outputs.friction);
            let load = row.sample.axial_load;
            let slip = slips.as_ref().and_then(|(rows, _)| rows.get(index));
            Moment {
                motor: Some(f64::from(row.outputs.load_torque) + friction),
                parts: slip.map(|slip| {
                    let slip = f64::from(slip.outputs.friction);
                    [slip, friction - slip]
                }),
                error: promise
                    .filter(|_| load.abs() <= largest_load)
                    .map(|promise| promise.largest * friction.abs()),
                ..row.moment(row.sample.time)
            }
        };
        Ok(rows.iter().enumerate().map(moment).collect())
    }
}
