//! What every step, and every function that firmware may call in its loop, promises: for the tests that hold
//! them to it, for the report, for the counts on the target, and for this page.
//!
//! Errors are against the exact model in f64, ceilings over the whole domain. Cycles are modelled ones of
//! a Cortex-M4F with the own scalar kernels, the most over the inputs that `bench` counts, rounded up by at most a
//! twentieth, or by 20 where that is more: `target --gate` fails where a count is above. Where a worse input is known than
//! those, the promise names it and has its cycles. Constants that nobody reads take no place in a firmware's image.
//!
//! The table has what can be called, from firmware or from a program of its own that counts it. A step is inlined, and what
//! only a step calls is inlined into it: `LoadLaw::torque_over_load` (friction of a caged ball over its load), `Train::intake`, `Intake::press` and `Intake::press_rubbing`
//! (speeds of balls in, forces between them out), `BallLaw::numbers` and `BallNumbers::at` (a ball under a load, with its deviations), `LoadedZone::at` (deviations and load of a ball by its place),
//! `AnalyticLinearBall::closed_form` and `GrooveFriction::at` (ball and groove of a linear bearing), [`both`](crate::law::coefficient::CoefficientAtTemperature::both) (friction coefficient of both directions).
//! They have no place of their own in the image, and the compiler shares their work with what stands around them; counted
//! apart they would be other code. Their cycles and their errors are those of the step. Where a function with a name does the
//! same by the same formulas, it stands under [`PARTS`].
#![doc = include_str!("promises.md")]

mod adaptation;
mod direct;
mod footprints;
mod kernels;
mod law;
mod parts;
mod promise;
mod setting;
mod steps;

pub use adaptation::*;
pub use direct::*;
pub use footprints::{FOOTPRINTS, STEP_SPREAD};
pub use kernels::*;
pub use law::*;
pub use parts::*;
pub use promise::{Footprint, Promise};
pub use setting::*;
pub use steps::*;

/// Promises of every `step()` and `between()`, and of every function that one of them calls as it stands.
pub const STEPS: [Promise; 27] = [
    STEP_CLOSED_FORM,
    STEP_CAGED,
    STEP_CAGED_RANGE,
    STEP_CAGED_MEMORY,
    STEP_CAGED_LAW,
    BETWEEN_CAGED,
    STEP_UNCAGED,
    STEP_UNCAGED_RANGE,
    STEP_UNCAGED_SHARES,
    STEP_UNCAGED_MEMORY,
    BETWEEN_UNCAGED,
    STEP_LINEAR,
    STEP_LINEAR_MEMORY,
    BETWEEN_LINEAR,
    SQRT,
    CBRT_SQUARED,
    CBRT_AND_SQUARED,
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

/// Promises of functions of which a step runs the parts, or the same formulas in another form: each names what a step has of it.
pub const PARTS: [Promise; 6] = [
    FRICTION_COEFFICIENT,
    FRICTION_COEFFICIENT_WARMING,
    ANALYTIC_BALL,
    DEVIATION_MAP,
    TRAIN,
    PRESS,
];

/// Promises of functions that no step calls, nor parts of them: firmware calls them by their names.
pub const DIRECT: [Promise; 26] = [
    SET_FRICTION,
    START_UNCAGED,
    SET_FRICTION_CAGED,
    SWAP_CAGED,
    START_CAGED,
    START_CAGED_LAW,
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
    ROLLING_BACKDRIVE_EFFICIENCY,
    KINEMATICS_UPDATE,
    KINEMATICS,
    SLIP_RATIOS,
    FRICTION_MAP,
    ADAPTATION,
    STATE,
    SCREW_ROW,
    SCREW_BALL,
    ANALYTIC_PAIR,
];

/// Every promise.
pub const ALL: [Promise; STEPS.len() + PARTS.len() + DIRECT.len()] = {
    let mut all = [SQRT; STEPS.len() + PARTS.len() + DIRECT.len()];
    let mut place = 0;
    while place < all.len() {
        let beyond = place.saturating_sub(STEPS.len());
        all[place] = if place < STEPS.len() {
            STEPS[place]
        } else if beyond < PARTS.len() {
            PARTS[beyond]
        } else {
            DIRECT[beyond - PARTS.len()]
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
