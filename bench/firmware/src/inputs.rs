//! Inputs of the functions under test, spread over their domains.

use epas_friction::math;

use crate::scenes::BALLS;
use crate::spread::Spread;

/// Cases of each function that are stored and compared.
pub const CASES: u32 = 128;

/// Cases of each function that are counted: the first ones, the specials from [`SPECIAL`] on included.
pub const COUNTED: u32 = 64;

/// From this case on inputs are special values: zeros, limits, not numbers.
pub const SPECIAL: u32 = 48;

/// From this case on come the inputs of a broken sensor. They are checked and not counted: the way that
/// leads to the safe output is short, and would stand for the least cost of a step.
const BROKEN: u32 = COUNTED;

/// Cosine and sine of a contact angle from 0 to 80 degrees.
pub fn contact_angle(spread: &mut Spread) -> [f32; 2] {
    let (sin, cos) = math::sin_cos(spread.between(0.0, 1.4));
    [cos, sin]
}

/// Any positive number: every magnitude, zero, and the smallest.
pub fn positive(spread: &mut Spread) -> [f32; 1] {
    let number = spread.magnitude(1e-30, 1e30);
    [spread
        .special(&[0.0, 1e-40, f32::MIN_POSITIVE, f32::MAX, 1.0], SPECIAL)
        .unwrap_or(number)]
}

/// Angles within two turns, and the multiples of a quarter turn.
pub fn angle(spread: &mut Spread) -> [f32; 1] {
    use core::f32::consts::{FRAC_PI_2, PI, TAU};
    let angle = spread.between(-TAU, TAU);
    [spread
        .special(&[0.0, FRAC_PI_2, PI, -PI, 1e-20], SPECIAL)
        .unwrap_or(angle)]
}

/// Angles and forces of a ball in four-point contact under a side force of up to 0.9 of the preload.
pub fn four_contacts(spread: &mut Spread) -> [f32; 8] {
    let side = spread.between(-0.9, 0.9);
    let load = spread.between(20.0, 200.0);
    let (strong, weak) = (load * (1.0 + side), load * (1.0 - side));
    let mut near = || core::f32::consts::FRAC_PI_4 + spread.between(-0.05, 0.05);
    [near(), near(), near(), near(), strong, weak, strong, weak]
}

/// Two balls in one list of inputs.
pub fn pair(rear: [f32; 8], front: [f32; 8]) -> [f32; 16] {
    let mut both = [0.0; 16];
    for (place, value) in both.iter_mut().zip(rear.into_iter().chain(front)) {
        *place = value;
    }
    both
}

/// An axial load and a nut speed, with the inputs of a broken sensor.
pub fn tick(spread: &mut Spread) -> [f32; 2] {
    let speed = spread.between(-60.0, 60.0);
    let load = spread.between(-12_000.0, 12_000.0);
    let extreme = [0.0, 1e9, -0.0, -1e9];
    let broken = [f32::NAN, f32::INFINITY, -f32::INFINITY];
    let pick = |extreme_from, broken_from, sound| {
        spread
            .special(&extreme, extreme_from)
            .or(spread.special(&broken, broken_from))
            .unwrap_or(sound)
    };
    [
        pick(SPECIAL, BROKEN, speed),
        pick(SPECIAL + 2, BROKEN + 2, load),
    ]
}

/// A turn and the limits of sliding either way, of friction that slides fully after 2 mrad under 0.04 N m.
pub fn memory(spread: &mut Spread) -> [f32; 3] {
    let turn = spread.between(-4e-3, 4e-3);
    let (forward, backward) = (spread.between(0.0, 0.08), spread.between(0.0, 0.08));
    let extreme = [0.0, 1e9, -1e9, f32::NAN];
    [
        spread.special(&extreme, SPECIAL).unwrap_or(turn),
        forward,
        backward,
    ]
}

/// True level, friction of the model, nut speed and load torque of a screw that slides; at rest and of broken sensors in cases that are
/// checked and not counted.
pub fn adaptation(spread: &mut Spread) -> [f32; 4] {
    let level = spread.between(0.5, 2.0);
    let speed = spread.between(0.3, 60.0);
    let (friction, load) = (spread.between(0.01, 0.1), spread.between(-3.0, 3.0));
    let way = if spread.index().is_multiple_of(2) {
        1.0
    } else {
        -1.0
    };
    let broken = [f32::NAN, 0.0, f32::INFINITY, 1e-4];
    let speed = spread.special(&broken, BROKEN).unwrap_or(speed);
    let level = spread
        .special(&[f32::NAN, 50.0], BROKEN + 6)
        .unwrap_or(level);
    [level, way * friction, way * speed, load]
}

/// Free speeds of a train as a triangular wave: its amplitude, the waves in the train and where it starts;
/// every fourth case a ramp on which all balls run into each other or away from each other.
pub fn train(spread: &mut Spread) -> [f32; 3] {
    let amplitude = spread.between(-0.05, 0.05);
    let waves = spread.between(0.5, 12.0);
    let start = spread.between(0.0, 1.0);
    if spread.index() % 4 == 3 {
        [amplitude, 0.25, 0.0]
    } else {
        [amplitude, waves, start]
    }
}

/// The free speeds of such a train.
pub fn wave([amplitude, waves, start]: [f32; 3]) -> [f32; BALLS] {
    core::array::from_fn(|ball| {
        let phase = start + waves * (ball as f32 * (1.0 / BALLS as f32));
        let fraction = phase - phase as i32 as f32;
        let triangle = if fraction < 0.5 {
            fraction
        } else {
            1.0 - fraction
        };
        amplitude * (4.0 * triangle - 1.0)
    })
}

/// Impedances of loaded balls, which differ with their loads.
pub fn impedances() -> [f32; BALLS] {
    core::array::from_fn(|ball| 1e3 + 20.0 * (ball % 7) as f32)
}
