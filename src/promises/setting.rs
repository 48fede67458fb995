//! What is set while a model runs.

use super::promise::Promise;

/// [`FrictionModel::set_friction`](crate::FrictionModel::set_friction) of 37 balls.
pub const SET_FRICTION: Promise = Promise {
    function: "UncagedBallScrew: set_friction",
    domain: "37 balls, friction 0.05 to 0.15",
    error: "none of its own: the step's once balls have settled, which take it over as their turn comes",
    largest: 0.0,
    rms: 0.0,
    mean: 0.0,
    outside: "an error that names the field; the model goes on as it was",
    not_finite: "an error",
    tiny: "an error below 1e-6",
    cycles: 85,
    counted: &["set_friction_37"],
};

/// [`FrictionModel::set_clearance`](crate::FrictionModel::set_clearance) of a ball screw without cage; the number of balls does not
/// matter.
pub const SET_CLEARANCE: Promise = Promise {
    function: "UncagedBallScrew: set_clearance",
    domain: "clearance -5 to 5 um",
    tiny: "zeros and subnormals are clearances",
    cycles: 155,
    counted: &["set_clearance_uncaged"],
    ..SET_FRICTION
};

/// [`FrictionModel::set_friction`](crate::FrictionModel::set_friction) of a [`CagedBallScrew`](crate::scene::CagedBallScrew): the place
/// between two nodes.
pub const SET_FRICTION_CAGED: Promise = Promise {
    function: "CagedBallScrew: set_friction",
    domain: "friction coefficients of the block",
    error: "none of its own: the step's",
    tiny: "an error below the block's least",
    cycles: 120,
    counted: &["set_friction_caged"],
    ..SET_FRICTION
};

/// [`FrictionModel::swap_constants`](crate::FrictionModel::swap_constants) of a [`CagedBallScrew`](crate::scene::CagedBallScrew) whose
/// constants stand in flash: two references.
pub const SWAP_CAGED: Promise = Promise {
    function: "CagedBallScrew: swap_constants",
    domain: "constants of any block",
    error: "none of its own: the step's",
    outside: "no constants that have been checked are refused",
    not_finite: "no constants hold such",
    tiny: "no matter",
    cycles: 25,
    counted: &["swap_caged"],
    ..SET_FRICTION
};

/// [`FrictionModel::of`](crate::FrictionModel::of) of a [`CagedBallScrew`](crate::scene::CagedBallScrew) whose constants stand in flash.
pub const START_CAGED: Promise = Promise {
    function: "CagedBallScrew: of",
    cycles: 25,
    counted: &["start_caged"],
    ..SWAP_CAGED
};

/// The same with a memory, and a friction coefficient by speed and temperature.
pub const START_CAGED_LAW: Promise = Promise {
    function: "WithMemory<CagedBallScrew>: of",
    cycles: 290,
    counted: &["start_caged_law"],
    ..SWAP_CAGED
};
