//! Rows of balls whose friction remembers.

use epas_friction::law::coefficient::OneCoefficient;
use epas_friction::law::memory::ProportionalElements;
use epas_friction::law::motion::{Deadband, SpeedOverTick};
use epas_friction::scene::{WithMemory, WithMemoryConfiguration, WithMemoryInputs};

/// Elements of every row.
pub const ELEMENTS: usize = 8;

/// What they are.
pub type Elements = ProportionalElements<ELEMENTS>;

/// The speed of every tick, behind a dead band of an encoder's step.
pub type Speed = Deadband<SpeedOverTick>;

/// A scene with them, which follows it.
pub type Remembering<S> = WithMemory<S, Elements, Speed, OneCoefficient>;

/// What is set for it.
pub type RememberingConfiguration<C> = WithMemoryConfiguration<C, Elements, Speed, OneCoefficient>;

/// Temperature at which such a scene is stepped, K. The friction coefficient does not follow it.
pub const TEMPERATURE: f32 = 293.15;

/// Inputs of this moment, at one temperature.
pub const fn fresh<I, R>(scene: I, reading: R) -> WithMemoryInputs<I, R> {
    WithMemoryInputs {
        scene,
        reading,
        load_age: 0.0,
        temperature: TEMPERATURE,
        temperature_age: 0.0,
    }
}
