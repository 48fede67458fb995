//! Models of a unit, of a design whose numbers have been changed.

use epas_design::uncaged::Folded;
use epas_friction::scene::{FoldedBall, UncagedBallScrewConfiguration};
use epas_friction::{Error, FrictionModel, LinearBearingTrain, UncagedBallScrew};

use super::parameters::Values;
use super::rows::Row;
use super::running::{ByAngle, Moving, Running};
use super::scene::SceneName;
use crate::simulate::balls::CAPACITY;
use crate::simulate::encoder::EncoderStep;
use crate::simulate::linear::Linear;
use crate::simulate::memory::{self, Remembered, Remembering};
use crate::simulate::nut::STEPS;
use crate::simulate::remembering::{Sensor, Use, remembering};
use crate::simulate::uncaged::Uncaged;
use epas_design::caged_scene::CagedScene;
use epas_design::files::Design;
use epas_design::files::train::{LinearDesign, UncagedDesign, no_row};

/// A screw whose balls do not touch.
///
/// # Errors
/// The parameter that is wrong, its value and what is allowed.
pub fn caged(design: &Design) -> Result<Box<dyn Running>, String> {
    design.check().map_err(said)?;
    let scene = CagedScene::of(design).map_err(|failure| failure.to_string())?;
    Ok(Box::new(scene.model().map_err(said)?))
}

/// The same with friction that remembers.
///
/// # Errors
/// The parameter that is wrong, its value and what is allowed.
pub fn caged_with_memory(design: &Design, values: &Values<'_>) -> Result<Box<dyn Running>, String> {
    let angle = memory::angle().map_err(said)?;
    with_memory(
        design,
        mean_load(values)?,
        (angle, encoder_step(values)?),
        ByAngle,
    )
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

/// A caged screw that remembers.
fn with_memory<A, U>(
    design: &Design,
    load: f32,
    sensor: (A, f32),
    then: U,
) -> Result<Box<dyn Running>, String>
where
    A: Sensor,
    U: Use<Made = Box<dyn Running>>,
{
    // A wrong number of the design is told under its own name, whatever a law or elements make of it.
    design.check().map_err(said)?;
    match remembering(design, load, sensor, then) {
        Ok((running, _)) => Ok(running),
        Err(failure) => Err(failure.message().into()),
    }
}

/// What turns with the nut.
///
/// # Errors
/// The parameter that is wrong, its value and what is allowed.
pub fn mechanism(design: &Design, values: &Values<'_>) -> Result<Box<dyn Running>, String> {
    let tick = checked_tick(values)?;
    let moving = Moving {
        told: [
            values.within("gain", -10.0, 10.0)?,
            values.within("drag", -1e3, 1e3)?,
            values.within("offset", -1e3, 1e3)?,
        ],
        inertia: values.within("inertia", 1e-9, 1e3)?,
        tick,
    };
    let speed = memory::speed((tick / STEPS as f64) as f32).map_err(said)?;
    // The nut's own motion has no noise.
    with_memory(design, mean_load(values)?, (speed, 0.0), moving)
}

/// A row of balls of a screw's design.
///
/// # Errors
/// Where it has none.
pub fn row(design: &Design) -> Result<Uncaged, String> {
    Ok(Uncaged {
        design: design.clone(),
        balls: design.uncaged.ok_or_else(|| no_row(&design.name))?,
        memory: true,
        encoder: EncoderStep::default(),
    })
}

/// A screw whose balls press on each other.
///
/// # Errors
/// The parameter that is wrong, its value and what is allowed.
pub fn uncaged(
    design: &Design,
    scene: SceneName,
    values: &Values<'_>,
) -> Result<Box<dyn Running>, String> {
    let row = row(design)?;
    row.balls.gear.checked().map_err(said)?;
    let remembered = if scene.has_memory() {
        let mut remembered = row.remembered_at(mean_load(values)?).map_err(said)?;
        remembered.encoder_step = encoder_step(values)?;
        Some(remembered)
    } else {
        None
    };
    let tick = checked_tick(values)? as f32;
    match row
        .folded(0.0)
        .map_err(|failure| failure.message().to_owned())?
        .folded
    {
        Folded::One(folded) => row_of(&row.balls, folded, remembered.as_ref(), tick),
        Folded::Range(folded) => row_of(&row.balls, folded, remembered.as_ref(), tick),
    }
}

/// The same by a law of its ball.
fn row_of<const K: usize>(
    balls: &UncagedDesign,
    folded: &'static FoldedBall<K>,
    remembered: Option<&Remembered>,
    tick: f32,
) -> Result<Box<dyn Running>, String> {
    let configuration = UncagedBallScrewConfiguration {
        folded,
        ball_friction: balls.ball_friction,
        balls: balls.balls.into(),
        turns: balls.turns,
        return_length: balls.return_length,
        screw_deviation: balls.screw_deviation,
        nut_deviation: balls.nut_deviation,
        load_shares: balls.load_shares,
        tick,
    };
    if let Some(remembered) = remembered {
        let speed = memory::rows_speed(tick, remembered.encoder_step).map_err(said)?;
        let model = memory::configuration(configuration, remembered, speed, balls.gear.friction)
            .and_then(|whole| {
                FrictionModel::<Remembering<UncagedBallScrew<CAPACITY, K>>>::new(&whole)
            })
            .map_err(said)?;
        Ok(Box::new(Row { model, motion: 0.0 }))
    } else {
        let model =
            FrictionModel::<UncagedBallScrew<CAPACITY, K>>::new(&configuration).map_err(said)?;
        Ok(Box::new(Row { model, motion: 0.0 }))
    }
}

/// A linear bearing.
///
/// # Errors
/// The parameter that is wrong, its value and what is allowed.
pub fn linear(
    design: LinearDesign,
    scene: SceneName,
    values: &Values<'_>,
) -> Result<Box<dyn Running>, String> {
    let mut configuration = design.configuration;
    configuration.tick = checked_tick(values)? as f32;
    if scene.has_memory() {
        let row = Linear {
            design,
            memory: true,
            encoder: EncoderStep::default(),
        };
        let remembered = row.remembered_at(mean_load(values)?).map_err(said)?;
        let friction = configuration.friction;
        let speed = memory::rows_speed(configuration.tick, encoder_step(values)?).map_err(said)?;
        let model = memory::configuration(configuration, &remembered, speed, friction)
            .and_then(|whole| {
                FrictionModel::<Remembering<LinearBearingTrain<CAPACITY>>>::new(&whole)
            })
            .map_err(said)?;
        Ok(Box::new(Row { model, motion: 0.0 }))
    } else {
        let model =
            FrictionModel::<LinearBearingTrain<CAPACITY>>::new(&configuration).map_err(said)?;
        Ok(Box::new(Row { model, motion: 0.0 }))
    }
}
