//! Scenes without cage whose friction remembers, as they are counted: a gear like that of the library's `firmware.md`, whose encoder
//! counts behind a dead band of one count, and a linear bearing.

use epas_friction::defaults::COEFFICIENT;
use epas_friction::law::coefficient::{CoefficientLaw, OneCoefficient};
use epas_friction::law::memory::{ProportionalElements, SLIP_8};
use epas_friction::law::motion::{CountSensor, CountSensorParameters, Deadband, SpeedOverTick};
use epas_friction::scene::{
    UncagedBallScrew, UncagedBallScrewConfiguration, WithMemory, WithMemoryConfiguration,
    WithMemoryInputs,
};
use epas_friction::{
    Error, FrictionModel, Inputs, LinearBearingConfiguration, LinearBearingTrain, LinearInputs,
};

use crate::scenes::{
    BALLS, CARRIAGE, ROW, TICK, UNCAGED_RANGE, UNCAGED_SCREW, elements, remembered_of, with_memory,
};

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

/// A memory of eight elements.
type Memory<C, A, L = CoefficientLaw> = WithMemoryConfiguration<C, ProportionalElements<8>, A, L>;

/// The gear.
pub fn gear_configuration()
-> Result<Memory<UncagedBallScrewConfiguration, Encoder, OneCoefficient>, Error> {
    let friction = UNCAGED_SCREW.folded.friction;
    with_memory(UNCAGED_SCREW, encoder()?, OneCoefficient::new(friction)?)
}

/// The gear with the friction coefficient that is the default.
pub fn gear_law_configuration() -> Result<Memory<UncagedBallScrewConfiguration<3>, Encoder>, Error>
{
    with_memory(
        UNCAGED_RANGE,
        encoder()?,
        CoefficientLaw::new(&COEFFICIENT)?,
    )
}

fn encoder() -> Result<Encoder, Error> {
    let counts = CountSensor::new(CountSensorParameters {
        period: COUNTS,
        turn_per_count: TURN_PER_COUNT,
        largest_turn: 0.5,
    })?;
    Deadband::new(counts, 0.5 * TURN_PER_COUNT)
}

/// The carriage.
pub fn carriage_configuration()
-> Result<Memory<LinearBearingConfiguration, SpeedOverTick, OneCoefficient>, Error> {
    let sensor = SpeedOverTick::new(TICK, 0.1)?;
    Ok(WithMemoryConfiguration {
        elements: elements(&SLIP_8.elements, 2.0, 2e-5)?,
        reference_load: 1_500.0,
        play: 2e-5,
        ..with_memory(CARRIAGE, sensor, OneCoefficient::new(CARRIAGE.friction)?)?
    })
}

/// Speed at which the gear turns before it is counted, rad/s, and for how many ticks.
const RUN_IN: (f32, u8) = (40.0, 200);

/// The encoder's count after that: 104 counts a tick.
pub const PRESSING_COUNT: u32 = 104 * RUN_IN.1 as u32 % COUNTS;

/// Ticks before the gear is counted: its load falls.
pub fn falling() -> impl Iterator<Item = Inputs> {
    let (nut_speed, ticks) = RUN_IN;
    (0..ticks).map(move |tick| Inputs {
        nut_speed,
        axial_load: 4_000.0 - 20.0 * f32::from(tick),
    })
}

/// A gear that has turned with its load falling: most balls press on each other.
pub fn pressing(mut model: FrictionModel<Gear>) -> FrictionModel<Gear> {
    let mut count = 0;
    for inputs in falling() {
        count = counted_on(count, inputs.nut_speed, TICK);
        let _ = model.step(remembered_of(inputs, count));
    }
    model
}

/// The encoder's count after a time, s, at a speed, rad/s; a speed that is NaN or infinite leaves it where it is.
#[must_use]
pub fn counted_on(count: u32, nut_speed: f32, time: f32) -> u32 {
    const PER_RADIAN: f32 = COUNTS as f32 / core::f32::consts::TAU;
    count.wrapping_add_signed((nut_speed * time * PER_RADIAN) as i32) % COUNTS
}

/// Speed and load of this tick, with the encoder's count.
#[must_use]
pub const fn counted_inputs(
    nut_speed: f32,
    axial_load: f32,
    count: u32,
) -> WithMemoryInputs<Inputs, u32> {
    let scene = Inputs {
        nut_speed,
        axial_load,
    };
    remembered_of(scene, count)
}

/// Speed and load of a carriage at this tick, the speed as reading too.
#[must_use]
pub const fn carriage_inputs(speed: f32, load: f32) -> WithMemoryInputs<LinearInputs, f32> {
    let scene = LinearInputs {
        speed,
        normal_load: load,
        side_load: 0.2 * load,
    };
    remembered_of(scene, speed)
}
