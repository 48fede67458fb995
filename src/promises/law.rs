//! Friction that remembers, and the turn that it follows.

use super::promise::Promise;

/// [`follow`](crate::law::Elements::follow) of
/// [`ProportionalElements`](crate::law::memory::ProportionalElements).
pub const MEMORY: Promise = Promise {
    function: "ProportionalElements: follow",
    domain: "turns of 1e-6 to 10 breakaway angles, limits to 4 times the reference, four to eight elements of a table; cycles for 8",
    error: "friction over the reference limit, against the same elements in f64",
    largest: 2e-6,
    rms: 2e-7,
    mean: 2e-8,
    outside: "any turn: within the limits, which are not negative",
    not_finite: "a turn that is none, or of 2^20 rad or more, is no turn; limits are numbers, and if not, nothing stays for the next tick",
    tiny: "no limit: no friction; no turn: what is remembered, within the limits",
    cycles: 190,
    counted: &["memory_8"],
};

/// [`LoadExactElements`](crate::law::memory::LoadExactElements): the same with its cube root.
pub const MEMORY_LOAD_EXACT: Promise = Promise {
    function: "LoadExactElements: follow",
    domain: "turns of 1e-6 to 10 breakaway angles, limits and loads to 4 times the reference, eight elements",
    largest: 4e-6,
    outside: "any turn: within the limits, which are not negative; loads beyond the largest nearly in proportion",
    tiny: "no limit, no load: no friction; no turn: what is remembered, within the limits",
    cycles: 390,
    counted: &["memory_load_exact_8"],
    ..MEMORY
};

/// [`PreloadedElements`](crate::law::memory::PreloadedElements) of these, under the load that both flanks share; errors against
/// the same elements in f64 under the exact sum of both flanks.
pub const MEMORY_PRELOADED: Promise = Promise {
    function: "PreloadedElements<LoadExactElements>: follow",
    domain: "turns of 1e-6 to 10 breakaway angles, limits to 4 times the reference, loads of 1 to 4 times that without an axial load, eight elements; cycles for ten",
    error: "friction over the reference limit, against the same elements in f64 under the exact load of both flanks",
    largest: 1e-2,
    rms: 1e-3,
    mean: 1e-4,
    tiny: "no limit: no friction; no turn: what is remembered, within the limits",
    cycles: 480,
    counted: &["memory_preloaded_10"],
    ..MEMORY_LOAD_EXACT
};

/// [`SeatElement`](crate::law::memory::SeatElement).
pub const MEMORY_SEAT: Promise = Promise {
    function: "SeatElement: follow",
    domain: "turns to 2.5 breakaway angles, limits to 3 times the reference",
    error: "friction over the reference limit, by the same turns in f64",
    largest: 2e-6,
    rms: 2e-7,
    mean: 2e-8,
    cycles: 180,
    counted: &["memory_seat"],
    ..MEMORY
};

/// [`Together`](crate::law::memory::Together): both kinds, side by side.
pub const MEMORY_TOGETHER: Promise = Promise {
    function: "Together: follow",
    domain: "turns of 1e-6 to 10 breakaway angles, limits to 3 times the reference, elements of a table beside others or a seat; cycles for four beside six",
    error: "friction over the reference limit, against the same elements in f64, from the same place of a seat",
    cycles: 250,
    counted: &["memory_together_10"],
    ..MEMORY
};

/// [`CountSensor`](crate::law::motion::CountSensor): the turn between two counts.
pub const TURN_OF_COUNTS: Promise = Promise {
    function: "CountSensor: turn",
    domain: "every count and period",
    error: "turn, relative",
    largest: 6e-8,
    rms: 4e-8,
    mean: 2e-8,
    outside: "a count beyond the period: no reading, and it says so; beyond the largest turn: that, and it says so",
    not_finite: "counts are integers",
    tiny: "no count: no turn",
    cycles: 70,
    counted: &["turn_of_counts"],
};

/// [`WrappedAngle`](crate::law::motion::WrappedAngle): the turn between two angles.
pub const TURN_OF_ANGLES: Promise = Promise {
    function: "WrappedAngle: turn",
    domain: "angles of one period",
    error: "turn over the period",
    largest: 6e-8,
    rms: 2e-8,
    mean: 2e-9,
    outside: "an angle beyond the period: no reading, and it says so; beyond the largest turn: that, and it says so",
    not_finite: "no reading, and it says so",
    tiny: "no difference: no turn",
    cycles: 70,
    counted: &["turn_of_angles"],
};

/// [`SpeedOverTick`](crate::law::motion::SpeedOverTick): the turn of a tick from a speed.
pub const TURN_OF_SPEED: Promise = Promise {
    function: "SpeedOverTick: turn",
    domain: "every speed and tick, up to the largest turn",
    error: "turn, relative",
    largest: 6e-8,
    rms: 3e-8,
    mean: 1e-9,
    outside: "beyond the largest turn: that, and it says so",
    not_finite: "NaN: no reading, and it says so; infinity: the largest turn, and it says so",
    tiny: "no speed: no turn",
    cycles: 30,
    counted: &["turn_of_speed"],
};

/// [`Steady`](crate::law::motion::Steady) around a [`CountSensor`](crate::law::motion::CountSensor): the turn between two counts
/// behind a play.
pub const TURN_STEADY: Promise = Promise {
    function: "Steady<CountSensor>: turn",
    domain: "turns to twice the play, from the same place in f64",
    error: "turn over the play",
    outside: "a count beyond the period: no reading, and it says so; beyond the largest turn: that less what the play takes, and it says so",
    not_finite: "counts are integers",
    tiny: "no count: no turn",
    cycles: 100,
    counted: &["turn_steady"],
    ..PLAY
};

/// [`Play::follow`](crate::law::motion::Play::follow).
pub const PLAY: Promise = Promise {
    function: "Play::follow",
    domain: "turns to twice the play",
    error: "turn over the play",
    largest: 2.4e-7,
    rms: 6e-8,
    mean: 2e-9,
    outside: "any turn: less what the play takes",
    not_finite: "a turn that is NaN is none, an infinite one moves as far",
    tiny: "no width: every turn",
    cycles: 40,
    counted: &["play"],
};
