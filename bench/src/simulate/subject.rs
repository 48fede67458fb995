//! What a trace runs through: a scene with its design.

use epas_friction::{CagedBallScrew, FrictionModel, Inputs, Outputs};

use super::manoeuvre::Manoeuvre;
use super::trace::{self, Sample, Trace};
use super::train::{Train, TrainRow};
use crate::designs::train::{LINEAR, LinearDesign, UncagedDesign};
use crate::designs::{Design, DesignSource};
use crate::failure::Failure;

/// A scene of the in-loop model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Scene {
    /// A ball screw whose balls do not touch
    Caged,
    /// A ball screw whose balls press on each other
    Uncaged,
    /// A linear bearing whose balls press on each other
    Linear,
}

/// A scene with its design.
#[derive(Clone, Debug)]
pub enum Subject {
    /// A ball screw whose balls do not touch.
    Caged(Design),
    /// A ball screw whose balls press on each other.
    Uncaged(Design, UncagedDesign),
    /// A linear bearing whose balls press on each other.
    Linear(LinearDesign),
}

/// The in-loop model of a subject.
pub enum Model {
    /// Balls do not touch.
    Caged(FrictionModel<CagedBallScrew>),
    /// Balls press on each other.
    Train(Train),
}

impl Subject {
    /// Scene and design that are asked for, or that the manoeuvre is made for.
    pub fn new(
        scene: Option<Scene>,
        source: Option<&DesignSource>,
        manoeuvre: Option<Manoeuvre>,
    ) -> Result<Self, Failure> {
        let scene = scene.unwrap_or(match (source, manoeuvre) {
            (Some(DesignSource::LinearBearing), _) | (_, Some(Manoeuvre::Stroke)) => Scene::Linear,
            (_, Some(Manoeuvre::Turns)) => Scene::Uncaged,
            _ => Scene::Caged,
        });
        let screw = |default: &str| match source {
            Some(source) => source.load(),
            None => default
                .parse::<DesignSource>()
                .map_err(Failure::Data)?
                .load(),
        };
        match scene {
            Scene::Caged => Ok(Self::Caged(screw("lin-4.1")?)),
            Scene::Uncaged => {
                let design = screw("lin-3.6")?;
                let Some(uncaged) = design.uncaged else {
                    return Err(Failure::Data(format!(
                        "{} says nothing of its balls: a design file does in a table [uncaged], and of the \
                         built-in designs lin-3.6",
                        design.name
                    )));
                };
                Ok(Self::Uncaged(design, uncaged))
            }
            Scene::Linear => match source {
                None | Some(DesignSource::LinearBearing) => {
                    Ok(Self::Linear(LinearDesign::built_in()?))
                }
                Some(DesignSource::File(path)) => Ok(Self::Linear(LinearDesign::read(path)?)),
                Some(DesignSource::BuiltIn { name, .. }) => Err(Failure::Data(format!(
                    "{name} is a ball screw; the built-in linear bearing is {LINEAR}"
                ))),
            },
        }
    }

    /// Name, for headings and file names.
    pub fn name(&self) -> &str {
        match self {
            Self::Caged(design) | Self::Uncaged(design, _) => &design.name,
            Self::Linear(design) => &design.name,
        }
    }

    /// The ball screw, where it is one.
    pub const fn screw(&self) -> Option<&Design> {
        match self {
            Self::Caged(design) | Self::Uncaged(design, _) => Some(design),
            Self::Linear(_) => None,
        }
    }

    /// Columns of its traces.
    pub const fn columns(&self) -> &'static [&'static str] {
        match self {
            Self::Linear(_) => trace::LINEAR,
            _ => trace::SCREW,
        }
    }

    /// A manoeuvre for this design.
    pub fn trace(&self, manoeuvre: Manoeuvre) -> Result<Trace, Failure> {
        match self {
            Self::Caged(design) | Self::Uncaged(design, _) => manoeuvre.trace(design.screw()),
            Self::Linear(_) => manoeuvre.linear_trace(),
        }
    }

    /// The in-loop model for a trace.
    pub fn model(&self, trace: &Trace) -> Result<Model, Failure> {
        let named = |failure| match failure {
            Failure::Data(message) => Failure::Data(format!("{}: {message}", self.name())),
            other => other,
        };
        match self {
            Self::Caged(design) => FrictionModel::new(&design.configuration)
                .map(Model::Caged)
                .map_err(|error| named(Failure::Data(error.to_string()))),
            Self::Uncaged(_, design) => Train::of_screw(design, trace)
                .map(Model::Train)
                .map_err(named),
            Self::Linear(design) => Train::of_bearing(design, trace)
                .map(Model::Train)
                .map_err(named),
        }
    }
}

impl Model {
    /// What the model says to a sample.
    pub fn step(&mut self, sample: &Sample) -> (Outputs, Option<TrainRow>) {
        match self {
            Self::Caged(model) => {
                let outputs = model.step(Inputs {
                    nut_speed: sample.nut_speed as f32,
                    axial_load: sample.axial_load as f32,
                });
                (outputs, None)
            }
            Self::Train(train) => {
                let row = train.step(sample);
                (row.outputs.common, Some(row))
            }
        }
    }
}
