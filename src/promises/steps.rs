//! Every `step()` and `between()`, and the functions of a ball that a step calls.
//!
//! A step contains more than the functions that stand in the table: what is private and inlined has no cost of its own. The
//! entry of the step names it, and its cycles count it.

use super::promise::Promise;

/// [`FrictionModel::step`](crate::FrictionModel::step) of a [`ClosedFormScrew`](crate::ClosedFormScrew); errors are those of
/// computing the form.
pub const STEP_CLOSED_FORM: Promise = Promise {
    function: "ClosedFormScrew: step",
    domain: "31 catalogue sizes and 3 designs, both closed forms, friction 0.075, to 15 kN and 200 rad/s, both signs",
    error: "friction torque of the form, relative",
    largest: 4e-7,
    rms: 1.4e-7,
    mean: 3e-8,
    outside: "beyond a limit: the limit, flagged; a load that no torque drives: the largest torque, flagged",
    cycles: 260,
    counted: &["step_closed_form"],
    ..STEP_CAGED
};

/// [`FrictionModel::step`](crate::FrictionModel::step) of a [`CagedBallScrew`](crate::scene::CagedBallScrew) for one friction coefficient:
/// logarithm of the load, search among the law's parts, one cubic, and the passage through standstill with its square root. Errors are
/// those of blocks that `epas-design` folds; each has a certificate of its own.
pub const STEP_CAGED: Promise = Promise {
    function: "CagedBallScrew: step",
    domain: "diameters to 63 mm, friction 0.05 to 0.15, clearance -5 to 20 um, 5 to 300 N a ball, both signs",
    error: "friction torque, relative",
    largest: 6e-3,
    rms: 2e-4,
    mean: 1e-5,
    outside: "beyond a limit: the limit, flagged; loads above the block's with its end, flagged; diameter 125 mm with play 1.5e-2",
    not_finite: "no torque, flagged",
    tiny: "no torque at standstill; without load that of the preload",
    cycles: 320,
    counted: &["step_caged"],
};

/// The same for a range of friction coefficients, set between two nodes
/// ([`FrictionModel::set_friction`](crate::FrictionModel::set_friction)): the laws of both nodes.
pub const STEP_CAGED_RANGE: Promise = Promise {
    function: "CagedBallScrew: step, friction between nodes",
    domain: "as for one coefficient, friction 0.05 to 0.15 in one block; designs whose range is not held to 3 % are refused by the fold",
    largest: 3e-2,
    rms: 6e-3,
    mean: 1e-3,
    outside: "beyond a limit: the limit, flagged; loads and friction coefficients beyond the block's flagged",
    cycles: 430,
    counted: &["step_caged_range"],
    ..STEP_CAGED
};

/// [`FrictionModel::step`](crate::FrictionModel::step) of a [`CagedBallScrew`](crate::scene::CagedBallScrew)
/// [`WithMemory`](crate::scene::WithMemory): eight elements that turn with a speed, one friction coefficient. It is the law for both
/// directions, and what the table has of elements, sensor and play.
pub const STEP_CAGED_MEMORY: Promise = Promise {
    function: "WithMemory<CagedBallScrew>: step",
    error: "none of its own: in steady sliding that of the step without memory",
    largest: 0.0,
    rms: 0.0,
    mean: 0.0,
    outside: "beyond a limit: the limit, flagged; loads above the block's flagged; old loads fade, flagged",
    not_finite: "the last sound inputs, friction within their limits, flagged",
    tiny: "no turn: friction stays; without load that of the preload",
    cycles: 800,
    counted: &["step_caged_memory"],
    ..STEP_CAGED
};

/// The same with a friction coefficient by speed and temperature, at a new temperature in every tick: the laws of two nodes for both
/// directions.
pub const STEP_CAGED_LAW: Promise = Promise {
    function: "WithMemory<CagedBallScrew>: step, coefficient by a law",
    domain: "as without memory; friction coefficient 0.05 to 0.12 by speed and temperature",
    error: "none of its own: in steady sliding that of the step between nodes",
    cycles: 1270,
    counted: &["step_caged_law"],
    ..STEP_CAGED_MEMORY
};

/// [`FrictionModel::between`](crate::FrictionModel::between) of the same.
pub const BETWEEN_CAGED: Promise = Promise {
    function: "WithMemory<CagedBallScrew>: between",
    cycles: 410,
    counted: &["between_caged"],
    ..STEP_CAGED_MEMORY
};

/// [`FrictionModel::step`](crate::FrictionModel::step) of an [`UncagedBallScrew`](crate::UncagedBallScrew): one
/// [`ElasticGrooves::renew`](crate::ball::elastic::ElasticGrooves::renew), for which the deviations of both grooves at one place are
/// looked up in integers; at a reversal or a jump of the load one
/// [`ElasticGrooves::start`](crate::ball::elastic::ElasticGrooves::start) in its place; speed and impedance of every ball, and the
/// forces between them (`Train::intake`, `Intake::press`).
///
/// A renewal that is cut short solves its equations twice, and hardly a counted step has one: cycles are 600 above the most
/// that was counted. Errors of other screws and loads stand in the report's table `whole_screws`.
pub const STEP_UNCAGED: Promise = Promise {
    function: "UncagedBallScrew: step",
    domain: "screw of Lin 2019, Section 3.4.4, without gap, friction 0.05 to 0.15, 1500 N on 37 balls that fill two turns, 1 turn/s, screw's deviations of 2 to 3 deg twice a turn; cycles for 37 balls",
    error: "friction torque over its mean",
    largest: 0.16,
    rms: 1.4e-2,
    mean: 1e-3,
    outside: "beyond a limit: the limit, flagged; balls in two contacts flagged, if for long until all have passed the return",
    not_finite: "no torque, flagged; balls stay where they are",
    tiny: "no torque at standstill; loads to 1e-3 N a ball as 1e-3 N",
    cycles: 14_100,
    counted: &["step_train_37", "step_train_37_pressing"],
};

/// [`FrictionModel::step`](crate::FrictionModel::step) of an [`UncagedBallScrew`](crate::UncagedBallScrew)
/// [`WithMemory`](crate::scene::WithMemory): eight elements that turn with an encoder's counts; one friction coefficient, or one by
/// speed and temperature.
pub const STEP_UNCAGED_MEMORY: Promise = Promise {
    function: "WithMemory<UncagedBallScrew>: step",
    domain: "as without memory, in steady sliding; one friction coefficient, or by a law; cycles for 37 balls",
    outside: "beyond a limit: the limit, flagged; balls in two contacts flagged, if for long until all have passed the return; old loads fade, flagged",
    not_finite: "the last sound inputs, friction within their limits, flagged",
    tiny: "no turn: friction stays; loads to 1e-3 N a ball as 1e-3 N",
    cycles: 14_600,
    counted: &[
        "step_train_37_memory",
        "step_train_37_memory_pressing",
        "step_train_37_law",
    ],
    ..STEP_UNCAGED
};

/// [`FrictionModel::between`](crate::FrictionModel::between) of the same.
pub const BETWEEN_UNCAGED: Promise = Promise {
    function: "WithMemory<UncagedBallScrew>: between",
    cycles: 450,
    counted: &["between_train_37"],
    ..STEP_UNCAGED_MEMORY
};

/// [`FrictionModel::step`](crate::FrictionModel::step) of a [`LinearBearingTrain`](crate::LinearBearingTrain): the closed form of a
/// nominal ball once (`AnalyticLinearBall::closed_form`), groove friction with the border of two-point rolling
/// (`GrooveFriction::at`), the deviations of both grooves at every loaded ball in integers, and the forces between balls
/// (`Train::intake`, `Intake::press`).
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

/// [`FrictionModel::step`](crate::FrictionModel::step) of a [`LinearBearingTrain`](crate::LinearBearingTrain)
/// [`WithMemory`](crate::scene::WithMemory): eight elements that move with a speed, one friction coefficient.
pub const STEP_LINEAR_MEMORY: Promise = Promise {
    function: "WithMemory<LinearBearingTrain>: step",
    outside: "beyond a limit: the limit, flagged; near two-point rolling the best estimate, flagged; old loads fade, flagged",
    not_finite: "the last sound inputs, friction within their limits, flagged",
    tiny: "no way: friction stays",
    cycles: 3800,
    counted: &["step_linear_memory"],
    ..STEP_LINEAR
};

/// [`FrictionModel::between`](crate::FrictionModel::between) of the same.
pub const BETWEEN_LINEAR: Promise = Promise {
    function: "WithMemory<LinearBearingTrain>: between",
    cycles: 380,
    counted: &["between_linear"],
    ..STEP_LINEAR_MEMORY
};

/// [`ElasticGrooves::renew`](crate::ball::elastic::ElasticGrooves::renew): one Newton step of a ball's place and motion; errors are
/// those of balls that have settled. It contains friction of up to four contacts (`LoopSlipMap::at`, with pairs of square roots), the
/// solution of seven equations, and inverse cube roots of the load.
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
    cycles: 5800,
    counted: &["ball_screw_renewal"],
};

/// [`ElasticGrooves::start`](crate::ball::elastic::ElasticGrooves::start): a ball's place and motion from nothing, at a start, a
/// reversal, or a jump of the load. Its motion is a nominal ball's, which deviations do not turn, and its place is not in balance
/// yet: it is what renewals begin with, and nothing is put out before them. Errors are those after the first renewal; after 60 they
/// are those of [`SCREW_RENEWAL`], and [`Faults::SETTLING`](crate::Faults::SETTLING) stands until friction rests.
pub const SCREW_START: Promise = Promise {
    function: "ElasticGrooves::start",
    error: "speed over the span of free speeds, after one renewal",
    largest: 2.1,
    rms: 0.42,
    mean: 0.12,
    outside: "always a place that is finite",
    cycles: 3100,
    counted: &["ball_screw_start"],
    ..SCREW_RENEWAL
};
