//! What is set while a model runs.

use super::promise::Promise;

/// [`FrictionModel::set_friction`](crate::FrictionModel::set_friction) of an [`UncagedBallScrew`](crate::UncagedBallScrew): the place
/// between two nodes.
pub const SET_FRICTION: Promise = Promise {
    function: "UncagedBallScrew: set_friction",
    domain: "friction coefficients of the block",
    error: "none of its own: the step's",
    largest: 0.0,
    rms: 0.0,
    mean: 0.0,
    outside: "an error that names the field; the model goes on as it was",
    not_finite: "an error",
    tiny: "an error below the block's least",
    cycles: 120,
    counted: &["set_friction_37"],
};

/// [`FrictionModel::of`](crate::FrictionModel::of) of an [`UncagedBallScrew`](crate::UncagedBallScrew) whose constants stand in flash: its
/// balls at equal distances.
pub const START_UNCAGED: Promise = Promise {
    function: "UncagedBallScrew: of",
    domain: "constants of any block; cycles for 37 balls",
    outside: "no constants that have been checked are refused",
    not_finite: "no constants hold such",
    tiny: "no matter",
    cycles: 5_000,
    counted: &["start_37"],
    ..SET_FRICTION
};

/// [`FrictionModel::set_friction`](crate::FrictionModel::set_friction) of a [`CagedBallScrew`](crate::scene::CagedBallScrew): the place
/// between two nodes.
pub const SET_FRICTION_CAGED: Promise = Promise {
    function: "CagedBallScrew: set_friction",
    cycles: 120,
    counted: &["set_friction_caged"],
    ..SET_FRICTION
};

/// [`FrictionModel::swap_constants`](crate::FrictionModel::swap_constants) of a [`CagedBallScrew`](crate::scene::CagedBallScrew) whose
/// constants stand in flash: two references.
pub const SWAP_CAGED: Promise = Promise {
    function: "CagedBallScrew: swap_constants",
    domain: "constants of any block",
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
