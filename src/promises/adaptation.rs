//! What follows the vehicle, and what goes on across ignition.

use super::promise::Promise;

/// [`Adaptation::update`](crate::adaptation::Adaptation::update).
pub const ADAPTATION: Promise = Promise {
    function: "Adaptation::update",
    domain: "a minute of weave, parking and micro-motion, level 1 to 1.35 to 0.8, 2 s to forget, every 10 ms, noise 10 mN m",
    error: "friction level",
    largest: 0.25,
    rms: 6.5e-2,
    mean: 4e-2,
    outside: "at rest, weak, saturated or with any flag of the step: nothing changes, and it says why; levels stay within their bounds",
    not_finite: "nothing changes, flagged",
    tiny: "no speed, no friction of the model: nothing changes, flagged",
    cycles: 600,
    counted: &["adaptation_update"],
};

/// [`FrictionModel::export`](crate::FrictionModel::export) and [`FrictionModel::import`](crate::FrictionModel::import),
/// and those of [`Adaptation`](crate::adaptation::Adaptation): around ignition, not counted.
pub const STATE: Promise = Promise {
    function: "export, then import",
    domain: "every state that a model or an adaptation leaves",
    error: "none: the state is there again, to the bit",
    largest: 0.0,
    rms: 0.0,
    mean: 0.0,
    outside: "a block that is foreign, old, damaged or too short: refused with the reason, the state as it was",
    not_finite: "a block with such a number is refused",
    tiny: "numbers like any other",
    cycles: 0,
    counted: &[],
};
