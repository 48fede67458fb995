//! A simulated vehicle of four seconds: a nut that turns to and fro, a rack force that passes its limit, sensors that drop out.

use epas_friction::Outputs;

use super::gear::{BELT_RATIO, NO_READING};
use super::slow::Message;
use super::{FAST_TICK, RATIO};

/// What happens from a time on, ms, and until when.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// Nothing.
    Sound,
    /// A kerb: the rack force passes the limit of 20 kN and comes back.
    BeyondLimit,
    /// No rack force for 160 ms.
    NoLoad,
    /// No angle for 5 ms, which is shorter than a torque is held.
    ShortGap,
    /// No angle for 400 ms, after which no torque is left.
    LongGap,
    /// The last temperature is nearly a minute old, and none comes after it.
    NoTemperature,
    /// A rack force that is NaN or infinite, no angle for a millisecond.
    Broken,
}

/// The events with the time of their end, ms, and a name.
pub const EVENTS: [(u32, Event, &str); 9] = [
    (1000, Event::Sound, "sensors sound, nut to and fro"),
    (1500, Event::BeyondLimit, "load to 23 kN, limit 20 kN"),
    (1700, Event::Sound, "sound"),
    (2100, Event::NoLoad, "no load for 160 ms"),
    (2300, Event::ShortGap, "no angle for 5 ms"),
    (2900, Event::LongGap, "no angle for 400 ms"),
    (3300, Event::NoTemperature, "temperature older than 60 s"),
    (3500, Event::Broken, "one load, one angle broken"),
    (4000, Event::Sound, "sound, nut to and fro"),
];

/// Ticks of the friction task until the end.
pub const STEPS: u32 = 4000;

/// The event of a time, ms: its place in [`EVENTS`].
#[must_use]
pub fn event(time: u32) -> usize {
    EVENTS
        .iter()
        .position(|&(end, ..)| time < end)
        .unwrap_or(EVENTS.len() - 1)
}

/// Nut speed, rad/s, over the time, ms.
const NUT_SPEED: [(u32, f32); 9] = [
    (0, 0.0),
    (200, 25.0),
    (500, -25.0),
    (800, 12.0),
    (2900, 15.0),
    (3000, 15.0),
    (3250, -15.0),
    (3500, -15.0),
    (4000, 15.0),
];

/// Axial load, N, over the time, ms.
const AXIAL_LOAD: [(u32, f32); 7] = [
    (0, 500.0),
    (300, 8_000.0),
    (700, -6_000.0),
    (1000, 9_000.0),
    (1200, 23_000.0),
    (1300, 23_000.0),
    (1500, 9_000.0),
];

/// A line through points, constant after the last.
fn line(points: &[(u32, f32)], time: f32) -> f32 {
    let mut value = 0.0;
    for (&(start, from), &(end, to)) in points.iter().zip(points.iter().skip(1)) {
        let part = (time - start as f32) / (end - start) as f32;
        if part >= 0.0 {
            value = from + (to - from) * if part < 1.0 { part } else { 1.0 };
        }
    }
    value
}

/// The motor with its encoder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Motor {
    /// Angle in units of 2^-32 turns.
    angle: u32,
}

impl Motor {
    /// Where it starts.
    pub const START: Self = Self { angle: 0 };

    /// Turns on by a tick of the current loop; the encoder's counts, or none.
    pub fn counts(&mut self, tick: u32) -> u32 {
        let time = tick as f32 / RATIO as f32;
        let speed = BELT_RATIO * line(&NUT_SPEED, time);
        let turns = speed * (FAST_TICK / core::f32::consts::TAU);
        self.angle = self
            .angle
            .wrapping_add_signed((turns * 4_294_967_296.0) as i32);
        let lost = matches!(tick / RATIO, 2150..2155 | 2350..2750 | 3400);
        if lost { NO_READING } else { self.angle >> 18 }
    }
}

/// A rack force every 2 ms.
#[must_use]
pub fn load(time: u32) -> Option<Message> {
    let sent = time.is_multiple_of(2) && !(1750..1910).contains(&time);
    sent.then(|| Message {
        value: if time == 3350 {
            f32::NAN
        } else {
            line(&AXIAL_LOAD, time as f32)
        },
        age: 1e-3,
    })
}

/// A temperature every 100 ms.
#[must_use]
pub fn temperature(time: u32) -> Option<Message> {
    let last = time == 2900;
    let sent = time.is_multiple_of(100) && (last || !(2900..3200).contains(&time));
    sent.then_some(Message {
        value: 303.15,
        age: if last { 59.9 } else { 0.05 },
    })
}

/// Friction of the gear over that of its model.
pub const TRUE_LEVEL: f32 = 1.15;

/// Torque that the motor had to add to overcome friction, N m; the model's is at a level.
#[must_use]
pub fn observed(outputs: &Outputs, level: f32) -> f32 {
    outputs.friction_torque * (TRUE_LEVEL / level)
}
