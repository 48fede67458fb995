// Ball screw rack, calibrated by trace weave.
//
// For a crate that depends on `epas-friction`. Everything is checked when it is compiled: a number out of range
// stops the compiler.

use epas_friction::law::{coefficient, memory, motion};
use epas_friction::{Error, scene};

/// The value; a refused one stops the compiler here.
const fn sound<T: Copy>(checked: Result<T, Error>) -> T {
    match checked {
        Ok(value) => value,
        Err(_) => panic!("a calibrated number is out of range"),
    }
}

// Folded by epas-design; not to be edited.
// digest of the inputs: 55125a1cc60c915f
// pitch radius 0.016 m, lead 0.02 m, ball radius 0.003175 m, contact angle 0.7853982 rad, clearance -0.0000008696318 m, 40 balls
// holds for friction coefficients 0.058829404 to 0.1173 and axial loads of 5 to 300 N a ball, both signs
// certificate: caged_torque, relative error on 2048 states that were not fitted (seed 1): largest 2.68e-3, rms 4.51e-4, mean 8.5e-5; flagged 0.00 %
#[rustfmt::skip]
#[allow(clippy::unreadable_literal)]
const SCREW_BLOCK: [u32; 433] = [
    0x53415045, 0x00000001, 0x000001b1, 0x00000005, 0xc60c915f, 0x55125a1c,
    0x3deb851f, 0x3ca3d70a, 0x42200000, 0x40000000, 0x44fa0000, 0x47c35000,
    0x42c80000, 0x420562af, 0x43040fbf, 0x4307618a, 0x43050f31, 0x3d70f71a,
    0x43040fbf, 0x4304dd0a, 0x4304f210, 0x4305b8a8, 0x4306a7fe, 0x43082f30,
    0x43085794, 0x43086998, 0x3a650818, 0xba1a89c3, 0x39cb472a, 0x3857a82a,
    0x3a316abf, 0x395f37a4, 0xbb04fd66, 0x3cf6bf2c, 0x3a36c90a, 0x3a403e67,
    0xb899ef46, 0xb8e19201, 0x3a99969a, 0x39e82f77, 0xb9876dca, 0x37a37ad7,
    0x3ab459c2, 0xb8d0ff0f, 0xb9045e89, 0x380cae7e, 0x3a8970b6, 0xb9620259,
    0xb9b951e2, 0x3b2c77e5, 0x3a852f34, 0xb9997a61, 0xba38c234, 0x3d2a6918,
    0x3a83ed5e, 0x38b8ccf7, 0x3694c1df, 0xb711d529, 0x43040fbf, 0x4304e545,
    0x4304f43f, 0x4305bbe8, 0x43070516, 0x43086e1a, 0x430896c7, 0x4308a8eb,
    0x3a651116, 0xba192d39, 0x39cd6214, 0x383713d9, 0x3a3362cf, 0x3988db25,
    0xbbbb757c, 0x3e02e2cf, 0x3a38f724, 0x3a3b93a7, 0xb891cefb, 0xb8e0ebd8,
    0x3a996b04, 0x39e07c73, 0xb988d81d, 0x37cd9ce7, 0x3aafd8e3, 0xb93ef7cf,
    0xb8faab68, 0x3809d819, 0x3a76373b, 0xb99617e5, 0xb9dc8930, 0x3b39629d,
    0x3a6a7b7a, 0xb98ffcc3, 0xb9ca78cc, 0x3d01ad1c, 0x3a67d352, 0x38123ae1,
    0x37a11a70, 0xb8d74933, 0x3ea00000, 0x3e8ccccd, 0x3d8f2b60, 0x43040fbf,
    0x4304d50c, 0x4304edbe, 0x4305868d, 0x4306e447, 0x43087720, 0x4308a461,
    0x4308b68e, 0x3a64d599, 0xba1abe16, 0x39cb9823, 0x385e5cf5, 0x3a3066e1,
    0x392120cc, 0xba1b61dc, 0x3c6383e5, 0x3a361c0d, 0x3a4289e2, 0xb8a6c119,
    0xb78014d2, 0x3a90fa04, 0x3a218c4e, 0xb977b821, 0x35e7d594, 0x3ac61c90,
    0xb92afdf7, 0xb8f84624, 0x380fcdb4, 0x3a8f903e, 0xb97c02fe, 0xb9d43d9a,
    0x3b2e3d8b, 0x3a8a4303, 0xb98d4ef5, 0xbb491ed3, 0x3d7d66a1, 0x3a88a0c8,
    0x38cbe5ff, 0xb91636e9, 0x3a87f571, 0x43040fbf, 0x4304cd4b, 0x4304eb9a,
    0x4304f43f, 0x43058089, 0x430684c5, 0x43075909, 0x4307c095, 0x3a64f4e2,
    0xba1a23e2, 0x39d48611, 0x380a92a0, 0x3a309942, 0x38d2d752, 0xb9609732,
    0x3bd304ae, 0x3a35bbc0, 0x39fc0f30, 0x3c576f1e, 0xbe513d8a, 0x3a3bdb68,
    0x3a3fa526, 0xb8ed3a4a, 0x37923c63, 0x3a8e5cf6, 0x3a206c48, 0xb969bf9b,
    0xb7042ce5, 0x3ac09f9e, 0x3916e53d, 0xb9738622, 0x37fef8ca, 0x3abd9b24,
    0xb97e3450, 0xb952e58a, 0x39433b51, 0x3aae0e31, 0xb9aa25b3, 0xb8a10aab,
    0x381f1f16, 0x3e333333, 0x3ccccccd, 0x3daa20ce, 0x43040fbf, 0x4304c7a2,
    0x4304e75e, 0x4304efe5, 0x4305abcd, 0x4306d812, 0x43072228, 0x4308b68e,
    0x3a64c491, 0xba1bd958, 0x39d162c6, 0x38401039, 0x3a2f4987, 0x38a91a14,
    0x386763f3, 0x3badc026, 0x3a34c70d, 0x39b87290, 0x3cac865f, 0xbeaa8cbc,
    0x3a3abf6f, 0x3a46a9e8, 0xb8f7de7d, 0x38198a7b, 0x3a9fd5d8, 0x3a24e6d5,
    0xb95704de, 0xb7658260, 0x3ad8ac8d, 0x38cd2b0b, 0xb9092475, 0xb99f3961,
    0x3ad9fc05, 0xb9725181, 0xb8e8f405, 0x38152066, 0x3a982caf, 0xb9947b6c,
    0xb9f87bff, 0x3b9007d5, 0x43040fbf, 0x4304bcb5, 0x4304e331, 0x4304e97a,
    0x4305868d, 0x43063569, 0x4307a217, 0x4307c4f6, 0x3a64dd67, 0xba1a948c,
    0x39d8fe2e, 0x37dbe9ef, 0x3a301240, 0x37ba7364, 0x398d9f8d, 0x3b04d556,
    0x3a345a41, 0x39aa71ec, 0xbbdb2248, 0x3ede41d5, 0x3a37127e, 0x3a46308e,
    0xb9045707, 0x37c8f187, 0x3a92d5da, 0x3a295adf, 0xb9021968, 0xb899d4be,
    0x3ac205d3, 0x39ca960e, 0xb9839847, 0x378e95cd, 0x3acdd988, 0xb9647362,
    0x38eb2934, 0xbb6c9a98, 0x3ac90961, 0xb9b6886a, 0xb8accc5c, 0x37e7e2de,
    0x3db33333, 0x3ccccccd, 0x3dca29c6, 0x43040fbf, 0x4304b24d, 0x4304dd0a,
    0x4304e75e, 0x430595d5, 0x430631bd, 0x43075d4c, 0x43076e62, 0x3a64cb22,
    0xba1d799b, 0x39db2e00, 0x37ff38a9, 0x3a2f074f, 0xb797197c, 0x39abaf46,
    0x3adeea7a, 0x3a32b50c, 0x39936c81, 0xbafea37e, 0x3e28a681, 0x3a37aff0,
    0x3a4acfa1, 0xb8ca8fab, 0x361347b9, 0x3a9b29b7, 0x3a29fdd3, 0x37f9082a,
    0xb930ab93, 0x3acb618f, 0x3a05cc03, 0xb96c76f8, 0xb676fac1, 0x3af06ac0,
    0x3810c9c2, 0xbc0ee097, 0x3d89a794, 0x3aee3f22, 0xb9a7d003, 0xb8bdbcb0,
    0x380e9885, 0x43040fbf, 0x4304baf0, 0x4304df13, 0x4304e545, 0x4305b56c,
    0x43065e78, 0x4307c958, 0x4308263f, 0x3a64c42d, 0xba19ee48, 0x39d5c9db,
    0x38105a3f, 0x3a305450, 0x37d484df, 0x39540f4e, 0x3b45f358, 0x3a348ce0,
    0x39bb012f, 0xbbdf75ef, 0x3f07fbc4, 0x3a37bd5d, 0x3a4abd9a, 0xb8ff05ab,
    0x376e47ef, 0x3aa4c1b6, 0x3a232008, 0xb861a487, 0xb8ee2ac3, 0x3ad3413c,
    0x39dbfa7e, 0xb9805091, 0x37231db1, 0x3ae4624a, 0xb95bb476, 0xb91d2124,
    0xb8869449, 0x3ad76dcd, 0xb9e11bde, 0xb88a47ef, 0x37da0007, 0x3db33333,
    0x3c4ccccd, 0x3df03afb, 0x43040fbf, 0x4304aef2, 0x4304d903, 0x4304e120,
    0x4305e087, 0x4306660e, 0x4307a217, 0x7f7fffff, 0x3a64c8f3, 0xba1d9727,
    0x39d98997, 0x381f4b98, 0x3a2f3de6, 0xb7b966ea, 0x3989ca0e, 0x3b17ac8f,
    0x3a32d787, 0x39b1d004, 0xbbbac4a4, 0x3ea5a316, 0x3a36dbc1, 0x3a508e4c,
    0xb8e1f543, 0x3740a5f7, 0x3ab6e6d7, 0x3a259b08, 0x383ce832, 0xb950161d,
    0x3ae00187, 0x3a0b7e69, 0xb95bd420, 0xb74aafb0, 0x3b04a04a, 0xb9ce0777,
    0xb8be1d4d, 0x3823bac8, 0x00000000, 0x00000000, 0x00000000, 0x00000000,
    0x43040fbf, 0x4304aba6, 0x4304d706, 0x4304df13, 0x4305e75a, 0x43067558,
    0x4307b7d8, 0x43089fd8, 0x3a64d088, 0xba1a496f, 0x39da165e, 0x37f0abcb,
    0x3a30feb4, 0xb80dd963, 0x3990d047, 0x3af747e4, 0x3a33fa1e, 0x39a5512a,
    0xbbd4a88c, 0x3ea082bc, 0x3a377332, 0x3a509348, 0xb8fffcb8, 0x37315ff4,
    0x3ab7dbcf, 0x3a1a840d, 0x383d68cc, 0xb93f4561, 0x3ae07395, 0x39fe95da,
    0xb964ab0c, 0xb6d7a0b5, 0x3b00cad7, 0xb8b5587e, 0xb97152c3, 0x380f9686,
    0x3ae1e0dc, 0xba0307f3, 0xb97c82f4, 0x3a323b19, 0x00000000, 0x00000000,
    0x23fa83f8,
];

/// The screw without memory: for a `static` that stands in flash.
pub const SCREW: scene::CagedConstants<5> =
    sound(scene::CagedConstants::from_block(&SCREW_BLOCK));

/// Friction coefficient by speed, temperature and direction.
pub const COEFFICIENT: coefficient::CoefficientLaw = sound(coefficient::CoefficientLaw::new(&coefficient::CoefficientParameters {
    boundary: 0.115,
    full_film: 0.060030002,
    half_share_speed: 6.0,
    reference_temperature: 303.15,
    viscosity: sound(coefficient::Viscosity::through((303.15, 0.1), (363.15, 0.008323944), 150.0)),
    forward: 1.02,
    backward: 0.98,
    churning: 0.0,
    drag: coefficient::RollingDrag { torque: 0.0, heating: 0.0 },
}));

/// Friction after a reversal: 0.13413055 N m of sliding after 0.002 rad.
pub const ELEMENTS: memory::ProportionalElements<8> = sound(memory::ProportionalElements::new(
    0.13413055,
    &[memory::Part {
        backbone: &memory::SLIP_8.elements,
        share: 1.0,
        breakaway_angle: 0.002,
    }],
));

/// The screw with memory, for a sensor of the nut's angle and the sensor's step, rad of the nut: for a `static` that stands in flash.
/// Flicker within the step moves nothing; after a reversal friction starts once the sensor has gone back by the step.
///
/// ```text
/// static GEAR: scene::WithMemoryConstants<scene::CagedConstants<5>, memory::ProportionalElements<8>, motion::Deadband<CountSensor>, coefficient::CoefficientLaw> =
///     with_memory(SENSOR, TURN_PER_COUNT);
/// ```
pub const fn with_memory<A: Copy>(
    angle: A,
    step: f32,
) -> scene::WithMemoryConstants<scene::CagedConstants<5>, memory::ProportionalElements<8>, motion::Deadband<A>, coefficient::CoefficientLaw> {
    sound(scene::WithMemoryConstants::new(
        SCREW,
        &scene::WithMemoryConfiguration {
            scene: (),
            elements: ELEMENTS,
            angle: sound(motion::Deadband::new(angle, 0.5 * step)),
            reference_load: 1333.8547,
            play: 0.0019728222,
            coefficient: COEFFICIENT,
            temperature: sound(coefficient::TemperatureFade::new(303.15, 60.0, 60.0)),
            freshness: scene::Freshness::DEFAULT,
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
