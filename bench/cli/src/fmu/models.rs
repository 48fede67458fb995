//! Models of a unit, of a design whose numbers have been changed.

use epas_friction::Error;

use super::parameters::Values;
use super::running::{ByAngle, Caged, Motion, Row, Running};
use super::scene::SceneName;
use crate::model::{self, Model, Sensor, TEMPERATURE};
use crate::simulate::linear::Linear;
use crate::simulate::memory::{self, MemorySettings, Remembered};
use crate::simulate::nut::{Nut, STEPS};
use crate::simulate::remembering::remembering;
use crate::simulate::uncaged::Uncaged;
use epas_calibrate::mechanism::Mechanism;
use epas_design::caged_scene::CagedScene;
use epas_design::files::Design;
use epas_design::files::train::{LinearDesign, no_row};

pub fn caged(design: &Design) -> Result<Box<dyn Running>, String> {
    design.check().map_err(said)?;
    let scene = CagedScene::of(design).map_err(|failure| failure.to_string())?;
    Ok(Box::new(Caged(model::caged(&scene).map_err(said)?)))
}

pub fn caged_with_memory(design: &Design, values: &Values<'_>) -> Result<Box<dyn Running>, String> {
    let angle = memory::angle().map_err(said)?;
    let sensor = (angle, encoder_step(values)?);
    let model = with_memory(design, mean_load(values)?, sensor)?;
    Ok(Box::new(ByAngle::new(model)))
}

fn said(error: Error) -> String {
    error.to_string()
}

fn mean_load(values: &Values<'_>) -> Result<f32, String> {
    values.within("mean_load", 0.0, 1e7).map(|load| load as f32)
}

/// Step of the encoder, rad (m).
fn encoder_step(values: &Values<'_>) -> Result<f32, String> {
    values
        .within("encoder_step", 0.0, 0.1)
        .map(|step| step as f32)
}

/// The tick of a scene that has one, s.
fn checked_tick(values: &Values<'_>) -> Result<f64, String> {
    values.within("tick", 1e-6, 1.0)
}

fn with_memory(
    design: &Design,
    load: f32,
    sensor: (impl Sensor, f32),
) -> Result<Box<dyn Model>, String> {
    // A wrong number of the design is told under its own name, whatever a law or elements make of it.
    design.check().map_err(said)?;
    match remembering(design, load, sensor) {
        Ok(remembering) => Ok(remembering.model),
        Err(failure) => Err(failure.message().into()),
    }
}

pub fn mechanism(design: &Design, values: &Values<'_>) -> Result<Box<dyn Running>, String> {
    let tick = checked_tick(values)?;
    let [gain, drag, offset] = [
        values.within("gain", -10.0, 10.0)?,
        values.within("drag", -1e3, 1e3)?,
        values.within("offset", -1e3, 1e3)?,
    ];
    let inertia = values.within("inertia", 1e-9, 1e3)?;
    let speed = memory::speed((tick / STEPS as f64) as f32).map_err(said)?;
    // The nut's own motion has no noise.
    let model = with_memory(design, mean_load(values)?, (speed, 0.0))?;
    let resistance = Nut {
        model,
        gain,
        drag,
        offset,
        axial_load: 0.0,
        temperature: TEMPERATURE,
        outputs: None,
    };
    let mechanism = Mechanism {
        inertia,
        position: 0.0,
        speed: 0.0,
        resistance,
    };
    Ok(Box::new(Motion { mechanism, tick }))
}

pub fn row(design: &Design) -> Result<Uncaged, String> {
    Ok(Uncaged {
        design: design.clone(),
        balls: design.uncaged.ok_or_else(|| no_row(&design.name))?,
        memory: Some(MemorySettings::default()),
    })
}

pub fn uncaged(
    design: &Design,
    scene: SceneName,
    values: &Values<'_>,
) -> Result<Box<dyn Running>, String> {
    let row = row(design)?;
    row.balls.gear.checked().map_err(said)?;
    let remembered = remembered(scene, values, |load| row.remembered_at(load))?;
    let tick = checked_tick(values)? as f32;
    let configuration = row.folded(0.0);
    let configuration = configuration.map_err(|failure| failure.message().to_owned())?;
    let model = row.model(&configuration, tick, remembered.as_ref());
    Ok(Box::new(Row {
        model: model.map_err(said)?,
        linear: false,
        motion: 0.0,
    }))
}

fn remembered(
    scene: SceneName,
    values: &Values<'_>,
    at: impl FnOnce(f32) -> Result<Remembered, Error>,
) -> Result<Option<Remembered>, String> {
    if !scene.has_memory() {
        return Ok(None);
    }
    let mut remembered = at(mean_load(values)?).map_err(said)?;
    remembered.encoder_step = encoder_step(values)?;
    Ok(Some(remembered))
}

pub fn linear(
    design: LinearDesign,
    scene: SceneName,
    values: &Values<'_>,
) -> Result<Box<dyn Running>, String> {
    let tick = checked_tick(values)? as f32;
    let row = Linear {
        design,
        memory: Some(MemorySettings::default()),
    };
    let remembered = remembered(scene, values, |load| row.remembered_at(load))?;
    let model = row.model(tick, remembered.as_ref());
    Ok(Box::new(Row {
        model: model.map_err(said)?,
        linear: true,
        motion: 0.0,
    }))
}
