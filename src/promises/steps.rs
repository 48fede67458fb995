//! Every `step()`, and every function that a step calls beside the scalar kernels.

use super::promise::Promise;

/// [`FrictionModel::step`](crate::FrictionModel::step) of a [`CagedBallScrew`](crate::CagedBallScrew).
pub const STEP_CAGED: Promise = Promise {
    function: "CagedBallScrew: step",
    domain: "diameters to 63 mm, friction 0.05 to 0.15, clearance -5 to 5 um, 5 to 300 N a ball, both signs",
    error: "friction torque, relative",
    largest: 1.2e-2,
    rms: 2.5e-3,
    mean: 8e-4,
    outside: "beyond a limit: the limit, flagged; balls in two contacts flagged; diameter 125 mm 2e-2",
    not_finite: "no torque, flagged",
    tiny: "no torque at standstill; without load that of the preload",
    cycles: 460,
    counted: &["step_caged"],
};

/// [`FrictionModel::step`](crate::FrictionModel::step) of a [`CagedBallScrew`](crate::CagedBallScrew) whose friction
/// coefficient or clearance has been set while running.
pub const STEP_CAGED_CHANGING: Promise = Promise {
    function: "CagedBallScrew: step, friction changing",
    outside: "beyond a limit: the limit, flagged; some ticks after a jump flagged",
    not_finite: "no torque, flagged; the ball stays as it is",
    cycles: 5900,
    counted: &["step_caged_changing"],
    ..STEP_CAGED
};

/// [`FrictionModel::step`](crate::FrictionModel::step) of a [`CagedBallScrew`](crate::CagedBallScrew)
/// [`WithMemory`](crate::scene::WithMemory): eight elements, one friction coefficient.
pub const STEP_CAGED_MEMORY: Promise = Promise {
    function: "WithMemory<CagedBallScrew>: step",
    outside: "beyond a limit: the limit, flagged; balls in two contacts flagged; old loads fade, flagged",
    not_finite: "the last sound inputs, friction within their limits, flagged",
    tiny: "no turn: friction stays; without load that of the preload",
    cycles: 860,
    counted: &["step_caged_memory"],
    ..STEP_CAGED
};

/// The same with a friction coefficient by speed and temperature.
pub const STEP_CAGED_LAW: Promise = Promise {
    function: "WithMemory<CagedBallScrew>: step, coefficient by a law",
    domain: "as without memory; friction coefficient 0.05 to 0.12 by speed and temperature",
    largest: 3.2e-2,
    rms: 6e-3,
    mean: 1e-3,
    cycles: 1200,
    counted: &["step_caged_law"],
    ..STEP_CAGED_MEMORY
};

/// [`FrictionModel::between`](crate::FrictionModel::between) of the same.
pub const BETWEEN: Promise = Promise {
    function: "WithMemory<CagedBallScrew>: between",
    cycles: 410,
    counted: &["between_caged"],
    ..STEP_CAGED_MEMORY
};

/// [`FrictionModel::set_friction`](crate::FrictionModel::set_friction) of 37 balls.
pub const SET_FRICTION: Promise = Promise {
    function: "UncagedBallScrew: set_friction",
    domain: "37 balls, friction 0.05 to 0.15",
    error: "none: balls take it over as their turn comes",
    largest: 0.0,
    rms: 0.0,
    mean: 0.0,
    outside: "an error that names the field; the model goes on as it was",
    not_finite: "an error",
    tiny: "an error below 1e-6",
    cycles: 200,
    counted: &["set_friction_37"],
};

/// [`FrictionModel::step`](crate::FrictionModel::step) of an [`UncagedBallScrew`](crate::UncagedBallScrew).
pub const STEP_UNCAGED: Promise = Promise {
    function: "UncagedBallScrew: step",
    domain: "screw of Lin 2019, Section 3.4.4, deviations of 2 to 3 deg; cycles for 37 balls",
    error: "friction torque over its mean",
    largest: 0.16,
    rms: 1.4e-2,
    mean: 1e-3,
    outside: "beyond a limit: the limit, flagged; balls in two contacts flagged, if for long until all have passed the return",
    not_finite: "no torque, flagged; balls stay where they are",
    tiny: "no torque at standstill; loads to 1e-3 N a ball as 1e-3 N",
    cycles: 16_500,
    counted: &["step_train_37", "step_train_37_pressing"],
};

/// [`FrictionModel::step`](crate::FrictionModel::step) of a [`LinearBearingTrain`](crate::LinearBearingTrain).
pub const STEP_LINEAR: Promise = Promise {
    function: "LinearBearingTrain: step",
    domain: "bearing of Lin 2019, Table 3.3, side loads to 0.5 of the normal load, straight grooves; cycles for 24 balls",
    error: "groove friction force, relative",
    largest: 2.2e-3,
    rms: 1.7e-3,
    mean: 1.3e-3,
    outside: "beyond a limit: the limit, flagged; near two-point rolling the best estimate, flagged",
    not_finite: "no force, flagged; balls stay where they are",
    tiny: "no force at standstill",
    cycles: 3300,
    counted: &["step_linear"],
};

/// [`DeviationMap::at`](crate::DeviationMap::at), which a step calls twice for each loaded ball, in integers.
pub const DEVIATION_MAP: Promise = Promise {
    function: "DeviationMap::at",
    domain: "one wave in a period",
    error: "over its amplitude",
    largest: 1.3e-3,
    rms: 6.5e-4,
    mean: 1e-5,
    outside: "every phase is inside; 5e-3 for two waves, 0.08 for eight",
    not_finite: "phases are integers",
    tiny: "no deviation: 0",
    cycles: 21,
    counted: &["deviation_map"],
};

/// [`AnalyticLinearBall::speed_deviation`](crate::ball::AnalyticLinearBall::speed_deviation).
pub const ANALYTIC_BALL: Promise = Promise {
    function: "AnalyticLinearBall::speed_deviation",
    domain: "side-force ratios to 0.8, contact angles within 3 deg of each other",
    error: "speed deviation over v/2",
    largest: 1.5e-2,
    rms: 2e-3,
    mean: 1e-3,
    outside: "from a ratio of 0.88 on it misses two-point rolling, which its scene flags",
    not_finite: "angles: deviation 0; forces: no load",
    tiny: "no load: the compliance of 3e-14 N",
    cycles: 122,
    counted: &["linear_ball_speed"],
};

/// [`ElasticGrooves::renew`](crate::ball::elastic::ElasticGrooves::renew): one Newton step of a ball's place and motion; errors are
/// those of balls that have settled.
pub const SCREW_RENEWAL: Promise = Promise {
    function: "ElasticGrooves::renew",
    domain: "balls of catalogue screws in three or four contacts, 5 to 300 N, friction 0.05 to 0.15, clearance within 5 um, deviations to 3 deg",
    error: "speed over the span of free speeds",
    largest: 7e-2,
    rms: 6e-3,
    mean: 4e-4,
    outside: "two contacts: 0.25, and it says so; a lost ball stays as it was, and it says so",
    not_finite: "a lost ball",
    tiny: "loads to 1e-3 N",
    cycles: 6300,
    counted: &["ball_screw_renewal"],
};

/// [`Train::step`](crate::train::Train::step): forces between balls and their positions, as every step of a train finds them.
pub const TRAIN: Promise = Promise {
    function: "Train::step",
    domain: "rows of touching balls; cycles for 37 balls",
    cycles: 4500,
    counted: &["train_37"],
    ..PRESS
};

/// [`Press::solve`](crate::train::Press::solve).
pub const PRESS: Promise = Promise {
    function: "Press::solve",
    domain: "2 to 64 balls, impedances that differ by up to 1e6; cycles for 37 balls",
    error: "force over the largest force",
    largest: 2e-6,
    rms: 4e-7,
    mean: 1e-7,
    outside: "1e-5 for impedances up to 1e12; free speeds beyond 1 or impedances beyond 1e-9 to 1e9: no forces, and it says so",
    not_finite: "free speeds and impedances as outside; rooms that are NaN: no contact",
    tiny: "rooms up to 0: contact",
    cycles: 7100,
    counted: &["press_37"],
};
