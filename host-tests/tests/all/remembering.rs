//! Mechanisms whose friction remembers, one of every scene, each with another sensor.

use core::f32::consts::TAU;

use epas_friction::defaults::COEFFICIENT;
use epas_friction::law::coefficient::{CoefficientLaw, OneCoefficient, TemperatureFade};
use epas_friction::law::memory::{
    LoadExactElements, ParallelElements, Part, ProportionalElements, SLIP_8, SPIN_4, SeatElement,
};
use epas_friction::law::motion::{
    CountSensor, CountSensorParameters, Deadband, SpeedOverTick, WrappedAngle,
    WrappedAngleParameters,
};
use epas_friction::scene::{Freshness, WithMemory, WithMemoryConfiguration, WithMemoryInputs};
use epas_friction::{LinearBearingConfiguration, LinearBearingTrain};

use epas_testkit::gears::{
    CagedConfiguration, CagedScrew, LINEAR_BALLS, SCREW_BALLS, UncagedConfiguration, UncagedScrew,
    caged, linear, uncaged,
};

/// Elements in slip alone.
pub type Slip = ProportionalElements<8>;
/// Elements in spin beside a seat.
pub type SpinAndSeat = ParallelElements<ProportionalElements<4>, SeatElement>;
/// A caged screw with memory, by the angle of the rotor.
pub type CagedByAngle = WithMemory<CagedScrew, Slip, WrappedAngle>;
/// A screw without cage with memory, by counts of an encoder.
pub type UncagedByCounts =
    WithMemory<UncagedScrew<SCREW_BALLS>, SpinAndSeat, Deadband<CountSensor>>;
/// A linear bearing with memory, by its speed.
pub type LinearBySpeed = WithMemory<
    LinearBearingTrain<LINEAR_BALLS>,
    LoadExactElements<8>,
    SpeedOverTick,
    OneCoefficient,
>;

/// Of the scenes, s.
pub const TICK: f32 = 1e-4;

/// Counts of a turn in [`uncaged_by_counts`].
pub const COUNTS: u32 = 16_384;

/// For which the friction coefficients are given, K.
pub const TEMPERATURE: f32 = 313.15;

/// Inputs as fresh as they can be, at a temperature, K.
pub fn at<I, R>(scene: I, reading: R, temperature: f32) -> WithMemoryInputs<I, R> {
    WithMemoryInputs {
        scene,
        reading,
        load_age: 0.0,
        temperature,
        temperature_age: 0.0,
    }
}

/// A scene with memory of these elements and this angle.
pub fn with_memory<C, E, A>(scene: C, elements: E, angle: A) -> WithMemoryConfiguration<C, E, A> {
    WithMemoryConfiguration {
        scene,
        elements,
        angle,
        reference_load: 1000.0,
        play: 2e-3,
        coefficient: CoefficientLaw::new(&COEFFICIENT).unwrap(),
        temperature: TemperatureFade::new(TEMPERATURE, 60.0, 60.0).unwrap(),
        freshness: Freshness::DEFAULT,
    }
}

/// A counter with so many counts in its period, each of a turn, rad.
pub fn counter(period: u32, turn_per_count: f32, largest_turn: f32) -> CountSensor {
    CountSensor::new(CountSensorParameters {
        period,
        turn_per_count,
        largest_turn,
    })
    .unwrap()
}

/// An angle that wraps at both ends of a period, rad.
pub fn wrapped(lowest: f32, period: f32, largest_turn: f32) -> WrappedAngle {
    WrappedAngle::new(WrappedAngleParameters {
        lowest,
        period,
        largest_turn,
    })
    .unwrap()
}

/// Elements in slip with a limit, which all slide from a turn on.
pub fn slip_by(limit: f32, breakaway_angle: f32) -> Slip {
    let part = Part {
        backbone: &SLIP_8.elements,
        share: 1.0,
        breakaway_angle,
    };
    ProportionalElements::new(limit, &[part]).unwrap()
}

/// The same, from a usual turn.
pub fn slip(limit: f32) -> Slip {
    slip_by(limit, 2e-3)
}

/// The configuration of [`CagedByAngle`].
pub fn caged_by_angle() -> WithMemoryConfiguration<CagedConfiguration, Slip, WrappedAngle> {
    with_memory(caged(), slip(0.05), wrapped(0.0, TAU, 1.0))
}

/// The configuration of [`UncagedByCounts`].
pub fn uncaged_by_counts()
-> WithMemoryConfiguration<UncagedConfiguration, SpinAndSeat, Deadband<CountSensor>> {
    let sensor = Deadband::new(counter(COUNTS, TAU / COUNTS as f32, 1.0), 2e-4).unwrap();
    let spin = ProportionalElements::new(
        0.02,
        &[Part {
            backbone: &SPIN_4.elements,
            share: 1.0,
            breakaway_angle: 1e-3,
        }],
    )
    .unwrap();
    let seat = SeatElement::new(0.03, 1e-3, 5e-3).unwrap();
    let elements = ParallelElements::new(spin, seat, 0.4).unwrap();
    with_memory(uncaged(), elements, sensor)
}

/// The configuration of [`LinearBySpeed`].
pub fn linear_by_speed() -> WithMemoryConfiguration<
    LinearBearingConfiguration,
    LoadExactElements<8>,
    SpeedOverTick,
    OneCoefficient,
> {
    let elements = LoadExactElements::new(20.0, 1e-4, 4.0).unwrap();
    let sensor = SpeedOverTick::new(TICK, 0.1).unwrap();
    let scene = linear();
    let one = WithMemoryConfiguration::new(scene, scene.friction, elements, sensor, 1000.0);
    WithMemoryConfiguration {
        play: 2e-3,
        ..one.unwrap()
    }
}
