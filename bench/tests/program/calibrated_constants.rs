// Ball screw rack, calibrated by trace weave.
//
// For a crate that depends on `epas-friction`. Everything is checked and folded when it is compiled: a number out
// of range stops the compiler.

use epas_friction::law::coefficient::{
    CoefficientLaw, CoefficientParameters, TemperatureFade, Viscosity,
};
use epas_friction::law::memory::{Part, ProportionalElements, SLIP_8};
use epas_friction::scene::{Freshness, WithMemoryConfiguration, WithMemoryConstants};
use epas_friction::{
    BallScrew, BallScrewParameters, CagedBallScrewConfiguration, CagedConstants, Clearance, Error,
    FrictionBranch, GrooveSize, Limits, Material, RollingResistance,
};

/// The value; a refused one stops the compiler here.
const fn sound<T: Copy>(checked: Result<T, Error>) -> T {
    match checked {
        Ok(value) => value,
        Err(_) => panic!("a calibrated number is out of range"),
    }
}

/// Dimensions, m and rad, and materials.
#[allow(clippy::approx_constant)] // an angle as the design file has it
pub const DESIGN: BallScrew = sound(BallScrew::new(BallScrewParameters {
    pitch_radius: 0.016,
    lead: 0.02,
    ball_radius: 0.003175,
    screw_groove: GrooveSize::Conformity(0.528),
    nut_groove: GrooveSize::Conformity(0.528),
    contact_angle: 0.7853982,
    ball_material: Material {
        youngs_modulus: 210000000000.0,
        poisson_ratio: 0.28,
        density: 7800.0,
    },
    groove_material: Material {
        youngs_modulus: 210000000000.0,
        poisson_ratio: 0.28,
        density: 7800.0,
    },
}));

/// The screw without memory.
pub const SCREW: CagedBallScrewConfiguration = CagedBallScrewConfiguration {
    design: DESIGN,
    friction: 0.115,
    rolling_resistance: RollingResistance {
        hysteresis_loss: 0.01,
        lubricant_drag: 0.0,
    },
    rolling_tangent: 0.0,
    branch: FrictionBranch::Contacts,
    clearance: sound(Clearance::new(-8.696318e-7)),
    loaded_balls: 40,
    reversal_speed: 2.0,
    limits: Limits {
        nut_speed: 2000.0,
        axial_load: 100000.0,
        friction_torque: 100.0,
    },
};

/// Its constants: for a `static` that stands in flash.
pub const SCREW_CONSTANTS: CagedConstants = sound(CagedConstants::new(&SCREW));

/// Friction coefficient by speed, temperature and direction.
pub const COEFFICIENT: CoefficientLaw = sound(CoefficientLaw::new(&CoefficientParameters {
    boundary: 0.115,
    full_film: 0.060030002,
    half_share_speed: 6.0,
    reference_temperature: 303.15,
    viscosity: sound(Viscosity::through((303.15, 0.1), (363.15, 0.008323944), 150.0)),
    forward: 1.02,
    backward: 0.98,
    churning: 0.0,
}));

/// Friction after a reversal: 0.13402054 N m of sliding after 0.002 rad.
pub const ELEMENTS: ProportionalElements<8> = sound(ProportionalElements::new(
    0.13402054,
    &[Part {
        backbone: &SLIP_8.elements,
        share: 1.0,
        breakaway_angle: 0.002,
    }],
));

/// The screw with memory, for a sensor of the nut's angle: for a `static` that stands in flash.
///
/// ```text
/// static GEAR: WithMemoryConstants<CagedConstants, ProportionalElements<8>, CountSensor, CoefficientLaw> = with_memory(SENSOR);
/// ```
pub const fn with_memory<A: Copy>(
    angle: A,
) -> WithMemoryConstants<CagedConstants, ProportionalElements<8>, A, CoefficientLaw> {
    sound(WithMemoryConstants::new(
        SCREW_CONSTANTS,
        &WithMemoryConfiguration {
            scene: SCREW,
            elements: ELEMENTS,
            angle,
            reference_load: 1333.8602,
            play: 0.0019728222,
            coefficient: COEFFICIENT,
            temperature: sound(TemperatureFade::new(303.15, 60.0, 60.0)),
            freshness: Freshness::DEFAULT,
        },
    ))
}

/// Inertia of all that turns, about the nut's axis, kg m².
pub const INERTIA: f32 = 0.0004;

/// Drag without a load over the speed, N m s/rad.
pub const DRAG: f32 = 0.0003;

/// Torque that the motor's channel shows without any, N m.
pub const OFFSET: f32 = 0.006;

/// Torque of the load over that of a screw without friction.
pub const GAIN: f32 = 1.012;

/// Waves of the torque over a turn: order, amplitudes with cosine and sine of the angle, N m.
pub const HARMONICS: [(u8, f32, f32); 2] = [
    (1, 0.0015, -0.001),
    (2, 0.0, 0.0008),
];
