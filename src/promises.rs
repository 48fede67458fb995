//! What every step, and every function that firmware may call in its loop, promises: for the tests that hold
//! them to it, for the report, for the counts on the target, and for this page.
//!
//! Errors are against the exact model in f64, ceilings over the whole domain; cycles are modelled ones of
//! a Cortex-M4F with the own scalar kernels, ceilings as well: `bench`'s `target --gate` fails where a count is above.
//! Constants that nobody reads take no place in a firmware's image.
#![doc = include_str!("promises.md")]

mod adaptation;
mod direct;
mod footprints;
mod kernels;
mod law;
mod promise;
mod setting;
mod steps;

pub use adaptation::*;
pub use direct::*;
pub use footprints::{FOOTPRINTS, STEP_SPREAD};
pub use kernels::*;
pub use law::*;
pub use promise::{Footprint, Promise};
pub use setting::*;
pub use steps::*;

/// Promises of every `step()` and `between()`, and of every function that one of them calls.
pub const STEPS: [Promise; 27] = [
    STEP_CAGED,
    STEP_CAGED_CHANGING,
    STEP_CAGED_CLOSED,
    STEP_CAGED_MEMORY,
    STEP_CAGED_LAW,
    BETWEEN,
    STEP_UNCAGED,
    STEP_UNCAGED_MEMORY,
    BETWEEN_UNCAGED,
    STEP_LINEAR,
    STEP_LINEAR_MEMORY,
    BETWEEN_LINEAR,
    SQRT,
    CBRT_SQUARED,
    CBRT_AND_SQUARED,
    SCREW_RENEWAL,
    SCREW_START,
    MEMORY,
    MEMORY_LOAD_EXACT,
    MEMORY_PRELOADED,
    MEMORY_SEAT,
    MEMORY_TOGETHER,
    TURN_OF_COUNTS,
    TURN_OF_ANGLES,
    TURN_OF_SPEED,
    TURN_STEADY,
    PLAY,
];

/// Promises of functions that no step calls: firmware calls them by their names.
pub const DIRECT: [Promise; 33] = [
    SET_FRICTION,
    SET_CLEARANCE,
    SET_FRICTION_CAGED,
    SET_CLEARANCE_CAGED,
    CBRT,
    SIN_COS,
    LITERATURE_CURVATURE,
    CIRCULAR_CURVATURE,
    FITTED_CURVATURE,
    GOTHIC_ARCH,
    HERTZ,
    ROLLING_EFFICIENCY,
    EFFICIENCY,
    BACKDRIVE_EFFICIENCY,
    PRESENT_EFFICIENCY,
    KINEMATICS_UPDATE,
    KINEMATICS,
    SLIP_RATIOS,
    FRICTION_MAP,
    DISSIPATION,
    FRICTION_COEFFICIENT,
    FRICTION_COEFFICIENT_WARMING,
    ADAPTATION,
    STATE,
    DEVIATION_MAP,
    TRAIN,
    PRESS,
    SCREW_ROW,
    SCREW_BALL,
    ANALYTIC_BALL,
    ANALYTIC_PAIR,
    FOUR_POINT_BALL,
    BALL_CHAIN,
];

/// Every promise.
pub const ALL: [Promise; STEPS.len() + DIRECT.len()] = {
    let mut all = [SQRT; STEPS.len() + DIRECT.len()];
    let mut place = 0;
    while place < all.len() {
        all[place] = if place < STEPS.len() {
            STEPS[place]
        } else {
            DIRECT[place - STEPS.len()]
        };
        place += 1;
    }
    all
};

/// Ticks within which a scene flags what is wrong with its inputs.
pub const TICKS_TO_FLAG: u32 = 1;

/// Ticks after a failure until outputs are unflagged and right for the state. A train keeps where its balls
/// and the deviations' phase are, and goes on from there: behind by the travel of the missed ticks, until
/// `set_nut_angle` or `set_carriage_position` brings the phase back, or `reset` everything.
pub const TICKS_TO_RECOVER: u32 = 1;
