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

/// [`FrictionModel::step`](crate::FrictionModel::step) of an [`UncagedBallScrew`](crate::UncagedBallScrew) whose balls all carry the same
/// load: the numbers of a ball at this load once ([`BallLaw::numbers`](crate::ball::pressed::BallLaw::numbers)), for every ball the deviations
/// of both grooves in integers and three polynomials of them ([`BallNumbers::at`](crate::ball::pressed::BallNumbers::at)), and the forces
/// between the balls (`Train::intake`, `Intake::press_rubbing`).
pub const STEP_UNCAGED: Promise = Promise {
    function: "UncagedBallScrew: step",
    domain: "lin-3.6, deviations to 1 and 0.5 deg, friction between balls 0 and 0.1, 10 to 300 N a ball, ticks of 1 ms in which no balls meet; cycles for 37 balls",
    error: "friction torque, relative",
    largest: 2e-2,
    rms: 4e-3,
    mean: 1.2e-3,
    outside: "beyond a limit: the limit, flagged; loads above the block's, and those under which it holds no forces, flagged",
    not_finite: "no torque, flagged; balls stay where they are",
    tiny: "no torque at standstill; without load that of the preload",
    cycles: 9_000,
    counted: &["step_train_37", "step_train_37_pressing"],
};

/// The same where a friction coefficient lies between two nodes: the numbers of both.
pub const STEP_UNCAGED_RANGE: Promise = Promise {
    function: "UncagedBallScrew: step, between two nodes",
    domain: "as with one coefficient, 0.075 to 0.15; cycles for 37 balls",
    largest: 2.5e-2,
    rms: 7e-3,
    mean: 2e-3,
    cycles: 9_500,
    counted: &["step_train_37_range"],
    ..STEP_UNCAGED
};

/// The same with a load of its own for each ball: its place among the knots too.
pub const STEP_UNCAGED_SHARES: Promise = Promise {
    function: "UncagedBallScrew: step, own loads",
    domain: "as with even loads, shares 0.7 to 1.4; cycles for 37 balls",
    largest: 7e-2,
    rms: 1e-2,
    mean: 3e-3,
    cycles: 18_000,
    counted: &["step_train_37_shares"],
    ..STEP_UNCAGED
};

/// [`FrictionModel::step`](crate::FrictionModel::step) of an [`UncagedBallScrew`](crate::UncagedBallScrew)
/// [`WithMemory`](crate::scene::WithMemory): eight elements that turn with an encoder's counts; one friction coefficient, or one by
/// speed and temperature.
pub const STEP_UNCAGED_MEMORY: Promise = Promise {
    function: "WithMemory<UncagedBallScrew>: step",
    domain: "as without memory, in steady sliding; one friction coefficient, or by a law; cycles for 37 balls",
    largest: 5e-3,
    rms: 2e-3,
    mean: 1.2e-3,
    outside: "beyond a limit: the limit, flagged; loads above the block's, and those under which it holds no forces, flagged; old loads fade, flagged",
    not_finite: "the last sound inputs, friction within their limits, flagged",
    tiny: "no turn: friction stays; without load that of the preload",
    cycles: 10_000,
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
