//! Scenes without cage whose friction remembers, as they are counted: a gear like that of the library's `firmware.md`, whose encoder
//! counts behind a dead band of one count, and a linear bearing.

use epas_friction::defaults::COEFFICIENT;
use epas_friction::law::coefficient::{CoefficientLaw, OneCoefficient, TemperatureFade};
use epas_friction::law::memory::{Part, ProportionalElements, SLIP_8};
use epas_friction::law::motion::{CountSensor, CountSensorParameters, Deadband, SpeedOverTick};
use epas_friction::scene::{
    Freshness, UncagedBallScrew, UncagedBallScrewConfiguration, WithMemory,
    WithMemoryConfiguration, WithMemoryInputs,
};
use epas_friction::{
    Error, FrictionModel, Inputs, LinearBearingConfiguration, LinearBearingTrain, LinearInputs,
};

use crate::scenes::{BALLS, CARRIAGE, ROW, TICK, UNCAGED_RANGE, UNCAGED_SCREW};

/// Counts of the encoder in a turn of the nut.
pub const COUNTS: u32 = 1 << 14;

/// Turn of the nut for a count, rad.
const TURN_PER_COUNT: f32 = core::f32::consts::TAU / COUNTS as f32;

/// The encoder behind a dead band of one count: flicker at rest moves nothing.
pub type Encoder = Deadband<CountSensor>;

/// A ball screw with 37 balls, without cage, with an encoder and one friction coefficient.
pub type Gear =
    WithMemory<UncagedBallScrew<BALLS>, ProportionalElements<8>, Encoder, OneCoefficient>;

/// The same with a friction coefficient by speed and temperature.
pub type GearByLaw = WithMemory<UncagedBallScrew<BALLS, 3>, ProportionalElements<8>, Encoder>;

/// A linear bearing with one friction coefficient.
pub type Carriage =
    WithMemory<LinearBearingTrain<ROW>, ProportionalElements<8>, SpeedOverTick, OneCoefficient>;

/// Eight elements that slide under a limit, N m (N), and after an angle, rad (m).
fn elements(limit: f32, breakaway: f32) -> Result<ProportionalElements<8>, Error> {
    ProportionalElements::new(
        limit,
        &[Part {
            backbone: &SLIP_8.elements,
            share: 1.0,
            breakaway_angle: breakaway,
        }],
    )
}

/// The gear.
pub fn gear_configuration() -> Result<
    WithMemoryConfiguration<
        UncagedBallScrewConfiguration,
        ProportionalElements<8>,
        Encoder,
        OneCoefficient,
    >,
    Error,
> {
    let screw = UNCAGED_SCREW;
    let friction = screw.folded.friction;
    gear(screw, OneCoefficient::new(friction)?)
}

/// The gear with the friction coefficient that is the default.
pub fn gear_law_configuration() -> Result<
    WithMemoryConfiguration<UncagedBallScrewConfiguration<3>, ProportionalElements<8>, Encoder>,
    Error,
> {
    gear(UNCAGED_RANGE, CoefficientLaw::new(&COEFFICIENT)?)
}

fn gear<C: Copy, L: Copy>(
    scene: C,
    coefficient: L,
) -> Result<WithMemoryConfiguration<C, ProportionalElements<8>, Encoder, L>, Error> {
    Ok(WithMemoryConfiguration {
        scene,
        elements: elements(0.2, 2e-3)?,
        angle: Deadband::new(
            CountSensor::new(CountSensorParameters {
                period: COUNTS,
                turn_per_count: TURN_PER_COUNT,
                largest_turn: 0.5,
            })?,
            0.5 * TURN_PER_COUNT,
        )?,
        reference_load: 1_000.0,
        play: 2e-3,
        coefficient,
        temperature: TemperatureFade::DEFAULT,
        freshness: Freshness::DEFAULT,
    })
}

/// The carriage.
pub fn carriage_configuration() -> Result<
    WithMemoryConfiguration<
        LinearBearingConfiguration,
        ProportionalElements<8>,
        SpeedOverTick,
        OneCoefficient,
    >,
    Error,
> {
    let scene = CARRIAGE;
    Ok(WithMemoryConfiguration {
        scene,
        elements: elements(2.0, 2e-5)?,
        angle: SpeedOverTick::new(TICK, 0.1)?,
        reference_load: 1_500.0,
        play: 2e-5,
        coefficient: OneCoefficient::new(scene.friction)?,
        temperature: TemperatureFade::DEFAULT,
        freshness: Freshness::DEFAULT,
    })
}

/// Speed at which the gear turns before it is counted, rad/s, and for how many ticks.
const RUN_IN: (f32, u8) = (40.0, 200);

/// The encoder's count after that: 104 counts a tick.
pub const PRESSING_COUNT: u32 = 104 * RUN_IN.1 as u32 % COUNTS;

/// A gear that has turned with its load falling: most balls press on each other.
pub fn pressing(mut model: FrictionModel<Gear>) -> FrictionModel<Gear> {
    let (speed, ticks) = RUN_IN;
    let mut count = 0;
    for tick in 0..ticks {
        count = counted_on(count, speed, TICK);
        let _ = model.step(counted_inputs(
            speed,
            4_000.0 - 20.0 * f32::from(tick),
            count,
        ));
    }
    model
}

/// The encoder's count after a time, s, at a speed, rad/s; a speed that is NaN or infinite leaves it where it is.
#[must_use]
pub fn counted_on(count: u32, nut_speed: f32, time: f32) -> u32 {
    const PER_RADIAN: f32 = COUNTS as f32 / core::f32::consts::TAU;
    count.wrapping_add_signed((nut_speed * time * PER_RADIAN) as i32) % COUNTS
}

/// Speed and load of this tick at a usual temperature, with the encoder's count.
#[must_use]
pub const fn counted_inputs(
    nut_speed: f32,
    axial_load: f32,
    count: u32,
) -> WithMemoryInputs<Inputs, u32> {
    WithMemoryInputs {
        scene: Inputs {
            nut_speed,
            axial_load,
        },
        reading: count,
        load_age: 0.0,
        temperature: 313.15,
        temperature_age: 0.0,
    }
}

/// The same of a carriage, the speed as reading too.
#[must_use]
pub const fn carriage_inputs(speed: f32, load: f32) -> WithMemoryInputs<LinearInputs, f32> {
    WithMemoryInputs {
        scene: LinearInputs {
            speed,
            normal_load: load,
            side_load: 0.2 * load,
        },
        reading: speed,
        load_age: 0.0,
        temperature: 313.15,
        temperature_age: 0.0,
    }
}
