//! The gear: its scene with a memory, and the scene's constants from the calibration.

use epas_friction::defaults;
use epas_friction::law::FrictionLevel;
use epas_friction::law::coefficient::{CoefficientLaw, CoefficientParameters, TemperatureFade};
use epas_friction::law::compensation::CompensationMargin;
use epas_friction::law::memory::{LoadExactElements, PreloadedElements};
use epas_friction::law::motion::{CountSensor, CountSensorParameters, Deadband};
use epas_friction::scene::{
    CagedBallScrew, CagedConstants, Freshness, WithMemory, WithMemoryConfiguration,
    WithMemoryConstants, WithMemoryInputs,
};
use epas_friction::{
    BallScrew, DISSERTATION_DESIGNS, Error, FrictionModel, Inputs, Limits, NamedDesign,
};

use super::page::Calibration;
use crate::gears::GEAR_29X7_RANGE;

/// Elements of a preloaded screw under any load.
pub type Elements = PreloadedElements<LoadExactElements<8>>;

/// The encoder behind a play as wide as its noise.
pub type Encoder = Deadband<CountSensor>;

/// A caged ball screw whose friction remembers, with a friction coefficient by speed and temperature between the nodes of its block.
pub type Scene = WithMemory<CagedBallScrew<5>, Elements, Encoder, CoefficientLaw>;

/// Its constants.
pub type Constants = WithMemoryConstants<CagedConstants<5>, Elements, Encoder, CoefficientLaw>;

/// Its model.
pub type Gear = FrictionModel<Scene>;

/// What the scene wants to know at a tick.
pub type GearInputs = WithMemoryInputs<Inputs, u32>;

/// The gear's design: a rack-assist screw, 29 mm pitch circle, lead 7 mm; with the default clearance.
pub const DESIGN: NamedDesign = DISSERTATION_DESIGNS[2];

/// Counts in a turn of the encoder, which sits on the motor: 14 bits.
pub const COUNTS: u32 = 1 << 14;

/// Turns of the motor in one of the nut: the belt.
pub const BELT_RATIO: f32 = 2.5;

/// Turn of the nut for a count, rad.
pub const TURN_PER_COUNT: f32 = core::f32::consts::TAU / (COUNTS as f32) / BELT_RATIO;

/// A reading that is none.
pub const NO_READING: u32 = u32::MAX;

/// Friction without an axial load, N m, with the default clearance and a friction coefficient of 0.12; the elements have
/// their breakaway angle at it.
const REFERENCE_FRICTION: f32 = 0.14;

/// The encoder as it is, without the play: half a turn of the motor between two readings at most.
pub const fn counter() -> Result<CountSensor, Error> {
    CountSensor::new(CountSensorParameters {
        period: COUNTS,
        turn_per_count: TURN_PER_COUNT,
        largest_turn: 0.5 * COUNTS as f32 * TURN_PER_COUNT,
    })
}

/// The gear's constants from a calibration.
///
/// # Errors
/// [`Error`] naming what the model does not take, `share` where the compensation would hum.
#[inline(never)]
pub fn constants(calibration: &Calibration) -> Result<Constants, Error> {
    margin(calibration).checked_share(calibration.share)?;
    let design = BallScrew::new(DESIGN.parameters)?;
    // Without an axial load the elements are told the load of both flanks, 2 sqrt(2) times the preload.
    let preload = defaults::CLEARANCE.axial_preload(&design, DESIGN.loaded_balls);
    let reference_load = 2.0 * core::f32::consts::SQRT_2 * preload;
    let scene = GEAR_29X7_RANGE.with_limits(Limits {
        nut_speed: calibration.largest_nut_speed,
        axial_load: calibration.largest_axial_load,
        friction_torque: calibration.largest_friction_torque,
    })?;
    let configuration = WithMemoryConfiguration {
        scene: (),
        elements: PreloadedElements::new(LoadExactElements::new(
            REFERENCE_FRICTION,
            calibration.breakaway_angle,
            calibration.largest_axial_load / reference_load,
        )?),
        angle: Deadband::new(counter()?, calibration.angle_play)?,
        reference_load,
        play: calibration.breakaway_angle,
        coefficient: CoefficientLaw::new(&CoefficientParameters {
            boundary: calibration.friction_boundary,
            full_film: calibration.friction_full_film,
            half_share_speed: calibration.half_share_speed,
            forward: calibration.friction_forward,
            backward: calibration.friction_backward,
            churning: calibration.churning,
            ..defaults::COEFFICIENT
        })?,
        temperature: TemperatureFade::new(
            calibration.temperature_fallback,
            calibration.temperature_hold,
            calibration.temperature_fade,
        )?,
        freshness: Freshness {
            load_hold: calibration.load_hold,
            load_fade: calibration.load_fade,
        },
    };
    WithMemoryConstants::new(scene, &configuration)
}

/// How far the model's friction may be from the true one; the encoder's noise is a count.
const fn margin(calibration: &Calibration) -> CompensationMargin {
    CompensationMargin {
        breakaway_angle: calibration.breakaway_angle,
        largest_breakaway_angle: calibration.breakaway_angle,
        friction_ratio: 1.0,
        play: calibration.angle_play - 0.5 * TURN_PER_COUNT,
    }
}

/// A level within what the calibration allows.
#[must_use]
pub fn bounded(level: FrictionLevel, calibration: &Calibration) -> FrictionLevel {
    let within = |level: f32| {
        if level > calibration.largest_level {
            calibration.largest_level
        } else if level > calibration.least_level {
            level
        } else {
            calibration.least_level
        }
    };
    FrictionLevel {
        forward: within(level.forward),
        backward: within(level.backward),
    }
}
