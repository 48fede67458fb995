//! A unit: a scene with a design, its variables, and models of it.

use epas_friction::Error;
use serde::{Deserialize, Serialize};

use super::models;
use super::parameters::{Values, changed_bearing, changed_screw, of_bearing, of_screw};
use super::running::Running;
use super::scene::SceneName;
use super::variables::{Causality, Kind, TIME, Variable, inputs, outputs, parameter};
use crate::simulate::linear::Linear;
use crate::simulate::nut::Nut;
use epas_calibrate::outputs::firmware;
use epas_design::caged_scene::{keep_words, words};
use epas_design::files::train::{LinearDesign, no_row};
use epas_design::files::{self as designs, Design, DesignSource};
use epas_design::uncaged_scene as uncaged;
use epas_page::failure::Failure;

/// Mean size of the load, N, where a design does not say one.
const MEAN_LOAD: f32 = 1000.0;

/// Inertia at the nut, kg m², where a design does not say one.
const INERTIA: f64 = 4e-4;

/// Tick of a scene that has one, s, and how often it is halved where that is too long for the limits of a design.
const TICK: (f64, u32) = (1e-3, 16);

#[derive(Clone, Debug)]
enum Source {
    Screw(Box<Design>),
    Bearing(Box<LinearDesign>),
}

/// What of a unit stands in the resources of its file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stored {
    /// Scene.
    pub scene: SceneName,
    /// Name of the design.
    pub design: String,
    /// Balls in the circuit; 0 without a row of balls.
    pub balls: u8,
    /// Tick before another one is set, s; none for a scene without.
    pub tick: Option<f64>,
    /// Text of the design file; none for a built-in design.
    pub text: Option<String>,
    /// Words of the block that was folded from it; none for a scene or a design that has no block.
    pub block: Option<Vec<u32>>,
}

/// A scene with a design.
#[derive(Clone, Debug)]
pub struct Unit {
    /// What of it is stored.
    pub stored: Stored,
    /// Its variables; value references are places in the list.
    pub variables: Vec<Variable>,
    source: Source,
}

impl Unit {
    /// The unit of a design.
    pub fn new(scene: SceneName, design: &DesignSource) -> Result<Self, Failure> {
        let text = design.text()?;
        let source = if scene.is_linear() {
            Source::Bearing(Box::new(design.load_bearing_from(text.as_deref())?))
        } else {
            Source::Screw(Box::new(design.load_from(text.as_deref())?))
        };
        let failure = |message: String| {
            let failure = Failure::Data(message);
            match design.file() {
                Some(path) => failure.of(&path.display().to_string()),
                None => failure,
            }
        };
        let tick = longest_tick(scene, &source).map_err(failure)?;
        let block = block(scene, &source)?;
        Self::of(scene, source, (text, block), tick).map_err(failure)
    }

    /// The unit that is stored.
    pub fn restored(stored: &Stored) -> Result<Self, String> {
        let Stored {
            scene,
            design,
            text,
            ..
        } = stored;
        let source = match (scene.is_linear(), text) {
            (true, Some(text)) => Source::Bearing(Box::new(LinearDesign::parse(text, design)?)),
            (false, Some(text)) => Source::Screw(Box::new(designs::read(text, design)?)),
            (linear, None) => {
                let source: DesignSource = design.parse()?;
                let said = |failure: epas_design::Failure| failure.to_string();
                if linear {
                    Source::Bearing(Box::new(source.load_bearing().map_err(said)?))
                } else {
                    Source::Screw(Box::new(source.load().map_err(said)?))
                }
            }
        };
        if let Some(words) = &stored.block {
            // A model with the numbers that the unit starts with needs no fold.
            let kept = if scene.has_row() {
                uncaged::read(words).map(drop)
            } else {
                keep_words(words)
            };
            kept.map_err(|error| format!("the unit's block: {error}"))?;
        }
        let kept = (text.clone(), stored.block.clone());
        let unit = Self::of(*scene, source, kept, stored.tick)?;
        if unit.stored == *stored {
            Ok(unit)
        } else {
            Err("the unit's design is not the one that it was made of".into())
        }
    }

    fn of(
        scene: SceneName,
        source: Source,
        (text, block): (Option<String>, Option<Vec<u32>>),
        tick: Option<f64>,
    ) -> Result<Self, String> {
        let (design, balls) = match &source {
            Source::Screw(design) => (
                design.name.clone(),
                design.uncaged.as_ref().map(|train| train.balls),
            ),
            Source::Bearing(design) => (design.name.clone(), Some(design.balls)),
        };
        let balls = match (scene.has_row(), balls) {
            (false, _) => 0,
            (true, Some(balls)) => balls,
            (true, None) => return Err(no_row(&design)),
        };
        let mut variables = vec![TIME];
        variables.extend(inputs(scene));
        variables.extend(outputs(scene));
        variables.extend(match &source {
            Source::Screw(design) => of_screw(design, scene),
            Source::Bearing(design) => of_bearing(design),
        });
        variables.extend(beside(scene, &source, tick));
        Ok(Self {
            stored: Stored {
                scene,
                design,
                balls,
                tick,
                text,
                block,
            },
            variables,
            source,
        })
    }

    /// What tells this unit from others: its scene, version, design and variables.
    pub fn token(&self) -> String {
        let Stored { scene, design, .. } = &self.stored;
        let all = format!("{:?} {:?}", self.stored, self.variables);
        format!(
            "epas-friction {} {} {design} {:08x}",
            env!("CARGO_PKG_VERSION"),
            scene.name(),
            crc32fast::hash(all.as_bytes())
        )
    }

    /// Places of the variables of a causality.
    pub fn places(&self, causality: Causality) -> impl Iterator<Item = usize> {
        self.variables
            .iter()
            .enumerate()
            .filter(move |(_, variable)| variable.causality == causality)
            .map(|(place, _)| place)
    }

    /// Values before anything is set.
    pub fn starts(&self) -> Vec<f64> {
        self.variables
            .iter()
            .map(|variable| variable.start)
            .collect()
    }

    /// Its tick, s, where its scene has one.
    pub fn tick(&self, values: &[f64]) -> Option<f64> {
        self.stored
            .scene
            .has_tick()
            .then(|| self.values(values).of("tick"))
    }

    const fn values<'a>(&'a self, values: &'a [f64]) -> Values<'a> {
        Values {
            variables: self.variables.as_slice(),
            values,
        }
    }

    /// A model with the values of parameters.
    pub fn start(&self, values: &[f64]) -> Result<Box<dyn Running>, String> {
        let (scene, values) = (self.stored.scene, self.values(values));
        match &self.source {
            Source::Screw(design) => {
                let design = changed_screw(design, scene, &values)?;
                match scene {
                    SceneName::Caged => models::caged(&design),
                    SceneName::CagedWithMemory => models::caged_with_memory(&design, &values),
                    SceneName::Mechanism => models::mechanism(&design, &values),
                    _ => models::uncaged(&design, scene, &values),
                }
            }
            Source::Bearing(design) => {
                models::linear(changed_bearing(design, &values)?, scene, &values)
            }
        }
    }
}

fn block(scene: SceneName, source: &Source) -> Result<Option<Vec<u32>>, Failure> {
    match source {
        Source::Screw(design) if !scene.has_row() => {
            let own = (design.caged.friction, design.caged.friction);
            let coefficients = if scene.has_memory() {
                firmware::coefficients(design)?
            } else {
                own
            };
            Ok(words(design, coefficients).map_err(|failure| failure.of(&design.name))?)
        }
        Source::Screw(design) => {
            let row = models::row(design).map_err(Failure::Data)?;
            let words = uncaged::words(design, &row.balls);
            Ok(Some(words.map_err(|failure| failure.of(&design.name))?))
        }
        Source::Bearing(_) => Ok(None),
    }
}

fn beside(scene: SceneName, source: &Source, tick: Option<f64>) -> Vec<Variable> {
    let calibrated = match source {
        Source::Screw(design) => design.calibrated.as_ref(),
        Source::Bearing(_) => None,
    };
    let mut list = Vec::new();
    if scene.has_memory() {
        let load = calibrated.and_then(|found| found.reference_load);
        list.push(parameter(
            Kind::Float32,
            "mean_load",
            Some("N"),
            "mean size of the load, 0 to 1e7: elements of the memory are designed for it",
            load.unwrap_or(MEAN_LOAD).into(),
        ));
    }
    if scene.has_memory() && scene != SceneName::Mechanism {
        let (unit, about) = match source {
            Source::Screw(_) => (
                "rad",
                "step of the nut's encoder, 0 to 0.1: the memory follows the motion behind a dead band of it",
            ),
            Source::Bearing(_) => (
                "m",
                "step of the carriage's encoder, 0 to 0.1: the memory follows the motion behind a dead band of it",
            ),
        };
        list.push(parameter(
            Kind::Float32,
            "encoder_step",
            Some(unit),
            about,
            0.0,
        ));
    }
    if let Some(tick) = tick {
        list.push(parameter(
            Kind::Float64,
            "tick",
            Some("s"),
            "time between two steps of the model, 1e-6 to 1; a communication step is one or more of them",
            tick,
        ));
    }
    if scene == SceneName::Mechanism {
        let inertia = calibrated.and_then(|found| found.inertia);
        let [gain, drag, offset] = match source {
            Source::Screw(design) => told(design),
            Source::Bearing(_) => [1.0, 0.0, 0.0],
        };
        for (name, unit, about, start) in [
            (
                "inertia",
                Some("kg.m2"),
                "inertia of all that turns, about the nut's axis, 1e-9 to 1e3",
                inertia.map_or(INERTIA, f64::from),
            ),
            (
                "gain",
                None,
                "torque of the load over that of a screw without friction, -10 to 10",
                gain,
            ),
            (
                "drag",
                Some("N.m.s/rad"),
                "drag without a load over the speed, -1e3 to 1e3",
                drag,
            ),
            (
                "offset",
                Some("N.m"),
                "torque without motion or load, -1e3 to 1e3",
                offset,
            ),
        ] {
            list.push(parameter(Kind::Float64, name, unit, about, start));
        }
    }
    list
}

fn told(design: &Design) -> [f64; 3] {
    let nut = Nut::of(design, ());
    [nut.gain, nut.drag, nut.offset]
}

/// The longest tick that the limits of a design leave its balls, s; none for a scene without a tick.
fn longest_tick(scene: SceneName, source: &Source) -> Result<Option<f64>, String> {
    let (mut tick, halvings) = TICK;
    if !scene.has_row() {
        return Ok(scene.has_tick().then_some(tick));
    }
    // The number of ticks changes nothing of what is folded.
    let built: Box<dyn Fn(f64) -> Result<(), Error>> = match source {
        Source::Screw(design) => {
            let row = models::row(design)?;
            let configuration = row
                .folded(0.0)
                .map_err(|failure| failure.message().to_owned())?;
            Box::new(move |tick| row.model(&configuration, tick as f32, None).map(drop))
        }
        Source::Bearing(design) => {
            let design = (**design).clone();
            let row = Linear {
                design,
                memory: None,
            };
            Box::new(move |tick| row.model(tick as f32, None).map(drop))
        }
    };
    for _ in 0..halvings {
        match built(tick) {
            Err(error) if error.field() == "tick" => tick *= 0.5,
            Err(error) => return Err(error.to_string()),
            Ok(()) => break,
        }
    }
    Ok(Some(tick))
}
