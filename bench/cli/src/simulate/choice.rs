//! Which scene a run has: asked for, or what the design or the manoeuvre is made for.

use super::caged::Caged;
use super::linear::Linear;
use super::manoeuvre::Manoeuvre;
use super::memory::MemorySettings;
use super::uncaged::Uncaged;
use epas_design::files::DesignSource;
use epas_design::files::train::{LinearDesign, no_row};
use epas_page::failure::Failure;

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum SceneName {
    /// A ball screw whose balls do not touch
    Caged,
    /// A ball screw whose balls press on each other
    Uncaged,
    /// A linear bearing whose balls press on each other
    Linear,
}

pub enum Chosen {
    Caged(Box<Caged>),
    Uncaged(Box<Uncaged>),
    Linear(Box<Linear>),
}

/// Scene and design that are asked for, or that the manoeuvre is made for.
pub fn choose(
    scene: Option<SceneName>,
    source: Option<&DesignSource>,
    manoeuvre: Option<Manoeuvre>,
    memory: bool,
) -> Result<Chosen, Failure> {
    let scene = scene.unwrap_or(match (source, manoeuvre) {
        (Some(DesignSource::LinearBearing), _) | (_, Some(Manoeuvre::Stroke)) => SceneName::Linear,
        (_, Some(Manoeuvre::Turns)) => SceneName::Uncaged,
        _ => SceneName::Caged,
    });
    let memory = memory.then(MemorySettings::default);
    let screw = |default: &str| match source {
        Some(source) => source.load(),
        None => default
            .parse::<DesignSource>()
            .map_err(epas_design::Failure::Domain)?
            .load(),
    };
    match scene {
        SceneName::Caged => Ok(Chosen::Caged(Box::new(Caged {
            design: screw("lin-4.1")?,
            memory,
            temperature: false,
        }))),
        SceneName::Uncaged => {
            let design = screw("lin-3.6")?;
            let Some(balls) = design.uncaged else {
                return Err(Failure::Data(no_row(&design.name)));
            };
            Ok(Chosen::Uncaged(Box::new(Uncaged {
                design,
                balls,
                memory,
            })))
        }
        SceneName::Linear => {
            let design = source.map_or_else(LinearDesign::built_in, DesignSource::load_bearing)?;
            Ok(Chosen::Linear(Box::new(Linear { design, memory })))
        }
    }
}
