//! A caged ball screw, by a folded block, whose friction remembers: its structures in C, and what they are in the crate.

use epas_friction::Range;
use epas_friction::law::FrictionLevel;
use epas_friction::law::coefficient::{
    CoefficientLaw, CoefficientParameters, OilData, RollingDrag, TemperatureFade, Viscosity,
};
use epas_friction::law::memory::{Hysteresis, Part, ProportionalElements, SLIP_4, SPIN_4};
use epas_friction::law::motion::{CountSensor, CountSensorParameters, Deadband};
use epas_friction::scene::{
    CagedBallScrew, CagedBallScrewConfiguration, Freshness, WithMemory, WithMemoryConfiguration,
    WithMemoryInputs,
};

use crate::caged::{REFUSED, block, outputs};
use crate::scene::{CScene, InHeader, Pointers, Tables, screw_inputs};
use crate::status::{
    EPAS_FIELD_PLAY, EPAS_FIELD_REFERENCE_TORQUE, EPAS_FIELD_SLIP_ANGLE, EPAS_FIELD_SLIP_SHARE,
    EPAS_FIELD_SPIN_ANGLE, Failure,
};
use crate::tables::NoTable;
use crate::types::{
    Block, EPAS_MEMORY_STATE_BYTES, EPAS_MEMORY_WORDS, EPAS_RANGE_NODES, Inputs, Outputs,
};
use crate::version::mark;

/// An encoder that counts turns of the nut.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Encoder {
    /// Counts after which the counter starts again at 0: 2 to 4294967295; 0 for a counter of all 32 bits.
    pub period: u32,
    /// Turn of the nut for one count, rad, negative where the counter runs the other way; size 1e-9 to 1. A motor's
    /// encoder of 14 bits with a belt of ratio 2.5: `2 pi / 16384 / 2.5`.
    pub turn_per_count: f32,
    /// Most that the nut turns between two readings, rad: largest speed times the longest gap; at most half a period.
    pub largest_turn: f32,
    /// Half of the play behind which the model follows the counts, rad, 0 to 1e3: at least half the width of the
    /// encoder's noise, counts included. Noise within it turns nothing; after a reversal friction is late by twice that.
    pub play: f32,
}

/// A lubricant by its data sheet; of a grease its base oil.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Oil {
    /// Kinematic viscosity at 40 degrees Celsius, m^2/s; at least 1.5 times that at 100 degrees. 100 mm^2/s is 100e-6.
    pub kinematic_viscosity_40: f32,
    /// Kinematic viscosity at 100 degrees Celsius, m^2/s; 1e-7 to 1e-2.
    pub kinematic_viscosity_100: f32,
    /// Density at 15 degrees Celsius, kg/m^3, 500 to 2000.
    pub density: f32,
    /// Pour point, K, 150 to 313.15: the oil does not flow below it.
    pub pour_point: f32,
}

/// Friction coefficient by speed, temperature and direction; one number where `boundary` and `full_film` are the same and
/// both factors 1.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Coefficient {
    /// Coefficient at standstill, 1e-6 to 0.5: boundary lubrication.
    pub boundary: f32,
    /// Coefficient at high speed, 1e-6 to 0.5: a film carries.
    pub full_film: f32,
    /// Nut speed at which half of the difference is gone, at the reference temperature, rad/s, 1e-3 to 1e4.
    pub half_share_speed: f32,
    /// Temperature of that speed, K, to 500.
    pub reference_temperature: f32,
    /// Factor of both coefficients in the positive direction, 0.1 to 10.
    pub forward: f32,
    /// The same in the negative direction.
    pub backward: f32,
    /// Torque of churned lubricant over its viscosity and the nut speed, m^3, 0 to 1; 0 for none.
    pub churning: f32,
    /// Lubricant drag of the rolling contacts at 1 Pa s, 1 rad/s and 1 N, N m, 0 to 1e3: 0.0013 for the screw of a steering gear (29x7, 71
    /// balls); 0 for none. `calibrate` writes it, and the Rust crate computes it for a design (`RollingDrag::of`).
    pub drag_torque: f32,
    /// Inlet shear heating, by which that drag is smaller at 1 Pa s and 1 rad/s, 0 to 1e3: 0.0005 for that screw.
    pub drag_heating: f32,
    /// The lubricant.
    pub oil: Oil,
}

/// What the engineer sets for a caged ball screw whose friction remembers.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct MemoryConfiguration {
    /// The screw: a block for a range of friction coefficients, which holds those of the law. Its own coefficient and
    /// its reversal speed have no meaning here.
    pub block: Block,
    /// The nut's angle.
    pub encoder: Encoder,
    /// The friction coefficient in the loop.
    pub coefficient: Coefficient,
    /// Friction of gross sliding for which the two breakaway angles hold, N m, 1e-9 to 1e9. This number and the next three follow from the
    /// design: `epas simulate --memory` prints them, at the mean load of its trace.
    pub reference_torque: f32,
    /// Share of slip across the ball path in the friction, 1e-6 to 0.999999; the rest is spin of the contacts.
    pub slip_share: f32,
    /// Turn of the nut after a reversal within which slip builds up, rad, 1e-9 to 1e3, of the design or as measured.
    pub slip_angle: f32,
    /// The same of spin, rad, 1e-9 to 1e3.
    pub spin_angle: f32,
    /// Age up to which a load counts as it is, s, 0 to 1e3.
    pub load_hold: f32,
    /// Time after that in which it fades to none, s, 1e-6 to 1e3.
    pub load_fade: f32,
    /// Temperature that stands in for one that is too old, K, 150 to 500.
    pub fallback_temperature: f32,
    /// Age up to which a temperature counts as it is, s, 0 to 86400.
    pub temperature_hold: f32,
    /// Time after that in which it gives way to the fallback, s, 1e-3 to 86400.
    pub temperature_fade: f32,
}

/// What the control interrupt knows at a tick of a screw whose friction remembers.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct MemoryInputs {
    /// Angular speed of the nut relative to the screw, rad/s: the friction coefficient follows it.
    pub nut_speed: f32,
    /// Axial force of the load, N; as in `epas_inputs_t`.
    pub axial_load: f32,
    /// The encoder's count: the memory follows it. `period` or more is no reading.
    pub count: u32,
    /// Time since the load was found, s.
    pub load_age: f32,
    /// Temperature of the screw, K, 150 to 500.
    pub temperature: f32,
    /// Time since the temperature was found, s.
    pub temperature_age: f32,
}

/// Place for the constants and the state of a caged ball screw whose friction remembers; as `epas_caged_t`.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct MemoryPlace {
    /// Not for the caller. Its type gives the place its alignment.
    pub words: [u64; EPAS_MEMORY_WORDS],
}

/// Sticking and slipping elements.
type Elements = ProportionalElements<8>;

/// Breakaway angles, rad.
const BREAKAWAY_ANGLE: Range = Range::new(1e-9, 1e3);

/// Shares of slip: each of the two parts has one.
const SLIP_SHARE: Range = Range::new(1e-6, 1.0 - 1e-6);

/// `epas_memory_t`
pub(crate) struct Memory;

impl InHeader for Memory {
    type Place = MemoryPlace;
    type Configuration = MemoryConfiguration;

    const MARK: u32 = mark(5);
    const STATE_BYTES: u32 = EPAS_MEMORY_STATE_BYTES;
}

impl CScene for Memory {
    type Scene = WithMemory<
        CagedBallScrew<EPAS_RANGE_NODES>,
        Elements,
        Deadband<CountSensor>,
        CoefficientLaw,
    >;
    type Folded = NoTable;
    type Inputs = MemoryInputs;
    type Outputs = Outputs;

    const REFUSED: Outputs = REFUSED;

    fn pointers(configuration: &MemoryConfiguration) -> Pointers {
        Pointers {
            block: configuration.block,
            ..Pointers::NONE
        }
    }

    fn configure(
        configuration: &MemoryConfiguration,
        tables: Tables,
    ) -> Result<
        WithMemoryConfiguration<
            CagedBallScrewConfiguration<EPAS_RANGE_NODES>,
            Elements,
            Deadband<CountSensor>,
            CoefficientLaw,
        >,
        Failure,
    > {
        let scene = block(&tables)?;
        let elements = elements(configuration)?;
        Ok(WithMemoryConfiguration {
            scene,
            elements,
            angle: encoder(&configuration.encoder)?,
            // Elements in proportion to friction do not read it.
            reference_load: 1.0,
            play: elements.breakaway(),
            coefficient: coefficient(&configuration.coefficient)?,
            temperature: TemperatureFade::new(
                configuration.fallback_temperature,
                configuration.temperature_hold,
                configuration.temperature_fade,
            )
            .map_err(Failure::of)?,
            freshness: Freshness {
                load_hold: configuration.load_hold,
                load_fade: configuration.load_fade,
            },
        })
    }

    #[inline]
    fn inputs(inputs: MemoryInputs) -> WithMemoryInputs<epas_friction::Inputs, u32> {
        WithMemoryInputs {
            scene: screw_inputs(Inputs {
                nut_speed: inputs.nut_speed,
                axial_load: inputs.axial_load,
            }),
            reading: inputs.count,
            load_age: inputs.load_age,
            temperature: inputs.temperature,
            temperature_age: inputs.temperature_age,
        }
    }

    #[inline]
    fn outputs(found: epas_friction::Outputs) -> Outputs {
        outputs(found)
    }
}

/// Elements of slip and spin.
fn elements(configuration: &MemoryConfiguration) -> Result<Elements, Failure> {
    let MemoryConfiguration {
        reference_torque,
        slip_share,
        slip_angle,
        spin_angle,
        ..
    } = *configuration;
    for (angle, field) in [
        (slip_angle, EPAS_FIELD_SLIP_ANGLE),
        (spin_angle, EPAS_FIELD_SPIN_ANGLE),
    ] {
        if let Err(error) = BREAKAWAY_ANGLE.checked("", angle) {
            return Err(Failure::at(error, field));
        }
    }
    if let Err(error) = SLIP_SHARE.checked("", slip_share) {
        return Err(Failure::at(error, EPAS_FIELD_SLIP_SHARE));
    }
    let slip = Part {
        backbone: &SLIP_4.elements,
        share: slip_share,
        breakaway_angle: slip_angle,
    };
    let spin = Part {
        backbone: &SPIN_4.elements,
        share: 1.0 - slip_share,
        breakaway_angle: spin_angle,
    };
    ProportionalElements::new(reference_torque, &[slip, spin])
        .map_err(|error| Failure::at(error, EPAS_FIELD_REFERENCE_TORQUE))
}

fn encoder(encoder: &Encoder) -> Result<Deadband<CountSensor>, Failure> {
    let counts = CountSensor::new(CountSensorParameters {
        period: encoder.period,
        turn_per_count: encoder.turn_per_count,
        largest_turn: encoder.largest_turn,
    })
    .map_err(Failure::of)?;
    Deadband::new(counts, encoder.play).map_err(|error| Failure::at(error, EPAS_FIELD_PLAY))
}

/// The law of a friction coefficient.
pub(crate) fn coefficient(coefficient: &Coefficient) -> Result<CoefficientLaw, Failure> {
    let oil = &coefficient.oil;
    let viscosity = Viscosity::of_oil(&OilData {
        kinematic_viscosity_40: oil.kinematic_viscosity_40,
        kinematic_viscosity_100: oil.kinematic_viscosity_100,
        density: oil.density,
        pour_point: oil.pour_point,
    })
    .map_err(Failure::of)?;
    CoefficientLaw::new(&CoefficientParameters {
        boundary: coefficient.boundary,
        full_film: coefficient.full_film,
        half_share_speed: coefficient.half_share_speed,
        reference_temperature: coefficient.reference_temperature,
        viscosity,
        forward: coefficient.forward,
        backward: coefficient.backward,
        churning: coefficient.churning,
        drag: RollingDrag {
            torque: coefficient.drag_torque,
            heating: coefficient.drag_heating,
        },
    })
    .map_err(Failure::of)
}

/// A friction level.
pub(crate) const fn level(forward: f32, backward: f32) -> FrictionLevel {
    FrictionLevel { forward, backward }
}
