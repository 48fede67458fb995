//! Scenes: what a mechanism needs and what it leaves out, decided at compile time.
//!
//! A scene is a type: firmware links the code and the state of its own scene and nothing else.
//! | | what it is | links |
//! |---|---|---|
//! | [`CagedBallScrew`] | balls that do not touch, by a law that was solved on a host | [`ball::folded`](crate::ball::folded) |
//! | [`ClosedFormScrew`] | a paper's closed form, without a host; [`built_in`] sizes of `CagedBallScrew` need none either | [`efficiency`](crate::efficiency) at set-up |
//! | [`LoadProportionalScrew`] | any drive by four numbers of a trace: losses of driving and back-driving in proportion to the load | nothing else |
//! | [`UncagedBallScrew`] | balls that press on each other, by a law that was solved on a host | [`ball::pressed`](crate::ball::pressed), [`train`](crate::train) |
//! | [`LinearBearingTrain`] | four-point linear bearing, balls that press on each other | [`ball`](crate::ball), [`train`](crate::train); [`contact`](crate::contact) and [`hertz`](crate::hertz) at set-up |
//! | [`WithMemory`] | any of them but `LoadProportionalScrew`, with friction that remembers | [`law`](crate::law) beside it |
//!
//! Below them are the [`Scene`] contract, faults, outputs, and the circuit that both trains share.

mod caged;
pub(crate) mod circuit;
mod closed_form;
mod contract;
pub(crate) mod linear;
mod load_proportional;
mod memory;
mod outputs;
mod sliding;
mod stored;
mod uncaged;
mod words;

pub use caged::{
    BUILT_IN_NODES, CagedBallScrew, CagedBallScrewConfiguration, CagedConstants, CagedState,
    built_in,
};
#[doc(hidden)]
pub use circuit::deviation::SINES;
pub use circuit::{CircuitState, DeviationMap, HIGHEST_ORDER, Harmonic, LARGEST_DEVIATION};
pub use closed_form::{
    ClosedFormScrew, ClosedFormScrewConfiguration, ClosedFormScrewConstants, FrictionBranch,
};
pub use contract::{
    ChangingFriction, CheckedInputs, Faults, Inputs, Limits, Motion, Regime, ReversalState, Scene,
    SceneOutputs,
};
pub use linear::{
    LinearBearingConfiguration, LinearBearingTrain, LinearConstants, LinearFriction, LinearInputs,
    LinearLimits, LinearState,
};
pub use load_proportional::{
    LoadProportionalConfiguration, LoadProportionalConstants, LoadProportionalScrew,
};
pub use memory::{
    CoefficientFor, Freshness, SceneMemory, WithMemory, WithMemoryConfiguration,
    WithMemoryConstants, WithMemoryInputs, WithMemoryState,
};
pub use outputs::{LinearOutputs, Outputs, UncagedOutputs};
pub use sliding::{CagedFriction, Sliding, SlidingFriction};
pub use stored::StoredScene;
pub use uncaged::{
    CatalogueBall, FoldedBall, UncagedBallScrew, UncagedBallScrewConfiguration, UncagedConstants,
    UncagedFriction, UncagedState,
};
