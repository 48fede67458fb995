//! The exported functions of the scenes, each one line that calls the generic one.

use super::models::{change, export, faulted_ticks, import, init, placed, reset, step, swap};
use crate::caged::{Caged, CagedRange};
use crate::closed_form::ClosedForm;
use crate::linear::Linear;
use crate::screw::{Screw, ScrewRange};
use crate::status::{EPAS_OK, Failure};
use crate::types::{
    Block, CagedPlace, CagedRangePlace, ClosedFormConfiguration, ClosedFormPlace, Inputs,
    LinearConfiguration, LinearInputs, LinearOutputs, LinearPlace, Outputs, ScrewConfiguration,
    ScrewOutputs, ScrewPlace, ScrewRangeConfiguration, ScrewRangePlace,
};

/// Makes a caged ball screw in the place, of a block for one friction coefficient. Set-up only. Where it fails, every step is refused until
/// it succeeds. `failure` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_caged_init(
    place: *mut CagedPlace,
    block: *const Block,
    failure: *mut Failure,
) -> u32 {
    unsafe { init::<Caged<1>>(place, block, failure) }
}

/// One tick: bounded time, finite outputs whatever the inputs are. Where the call is refused the outputs are
/// no torque and `EPAS_FAULT_CALL`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_caged_step(
    place: *mut CagedPlace,
    inputs: *const Inputs,
    outputs: *mut Outputs,
) -> u32 {
    unsafe { step::<Caged<1>>(place, inputs, outputs) }
}

/// Back to the state before the first tick.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_caged_reset(place: *mut CagedPlace) -> u32 {
    unsafe { reset::<Caged<1>>(place) }
}

/// Consecutive ticks with a fault; 0 after a sound tick, and after one whose only flags are `EPAS_FAULT_BEYOND_MODEL` and
/// `EPAS_FAULT_FORCES_NOT_HELD`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_caged_faulted_ticks(
    place: *const CagedPlace,
    ticks: *mut u32,
) -> u32 {
    unsafe { faulted_ticks::<Caged<1>>(place, ticks) }
}

/// Goes on with another block: of a worn gear, another clearance, another lubricant. The friction coefficient is the block's. Where it is
/// refused the model goes on as it was. `failure` may be NULL. In the task of the step; the next step takes as long as any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_caged_swap(
    place: *mut CagedPlace,
    block: *const Block,
    failure: *mut Failure,
) -> u32 {
    unsafe { swap::<Caged<1>>(place, block, failure) }
}

/// Makes a caged ball screw in the place, of a block for a range of friction coefficients; as `epas_caged_init`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_caged_range_init(
    place: *mut CagedRangePlace,
    block: *const Block,
    failure: *mut Failure,
) -> u32 {
    unsafe { init::<CagedRange>(place, block, failure) }
}

/// One tick; as `epas_caged_step`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_caged_range_step(
    place: *mut CagedRangePlace,
    inputs: *const Inputs,
    outputs: *mut Outputs,
) -> u32 {
    unsafe { step::<CagedRange>(place, inputs, outputs) }
}

/// Back to the state before the first tick.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_caged_range_reset(place: *mut CagedRangePlace) -> u32 {
    unsafe { reset::<CagedRange>(place) }
}

/// Consecutive ticks with a fault; as `epas_caged_faulted_ticks`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_caged_range_faulted_ticks(
    place: *const CagedRangePlace,
    ticks: *mut u32,
) -> u32 {
    unsafe { faulted_ticks::<CagedRange>(place, ticks) }
}

/// Goes on with another block; as `epas_caged_swap`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_caged_range_swap(
    place: *mut CagedRangePlace,
    block: *const Block,
    failure: *mut Failure,
) -> u32 {
    unsafe { swap::<CagedRange>(place, block, failure) }
}

/// Sets the friction coefficient of ball and groove while the model runs, within the block's range; `epas_caged_range_reset` brings the
/// block's own back. The next step takes as long as any. Where it is refused the model goes on as it was. `failure` may be NULL. In
/// the task of the step.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_caged_range_set_friction(
    place: *mut CagedRangePlace,
    friction: f32,
    failure: *mut Failure,
) -> u32 {
    unsafe { change::<CagedRange>(place, |model| model.set_friction(friction), failure) }
}

/// Makes a ball screw by a closed form in the place; as `epas_caged_init`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_closed_form_init(
    place: *mut ClosedFormPlace,
    configuration: *const ClosedFormConfiguration,
    failure: *mut Failure,
) -> u32 {
    unsafe { init::<ClosedForm>(place, configuration, failure) }
}

/// One tick; as `epas_caged_step`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_closed_form_step(
    place: *mut ClosedFormPlace,
    inputs: *const Inputs,
    outputs: *mut Outputs,
) -> u32 {
    unsafe { step::<ClosedForm>(place, inputs, outputs) }
}

/// Back to the state before the first tick.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_closed_form_reset(place: *mut ClosedFormPlace) -> u32 {
    unsafe { reset::<ClosedForm>(place) }
}

/// Consecutive ticks with a fault; as `epas_caged_faulted_ticks`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_closed_form_faulted_ticks(
    place: *const ClosedFormPlace,
    ticks: *mut u32,
) -> u32 {
    unsafe { faulted_ticks::<ClosedForm>(place, ticks) }
}

/// Goes on with other numbers; as `epas_caged_swap`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_closed_form_swap(
    place: *mut ClosedFormPlace,
    configuration: *const ClosedFormConfiguration,
    failure: *mut Failure,
) -> u32 {
    unsafe { swap::<ClosedForm>(place, configuration, failure) }
}

/// Makes a ball screw in the place, of a folded ball for one friction coefficient. Set-up only. Where it fails,
/// every step is refused until it succeeds. `failure` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_screw_init(
    place: *mut ScrewPlace,
    configuration: *const ScrewConfiguration,
    failure: *mut Failure,
) -> u32 {
    unsafe { init::<Screw<1>>(place, configuration, failure) }
}

/// One tick; as `epas_caged_step`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_screw_step(
    place: *mut ScrewPlace,
    inputs: *const Inputs,
    outputs: *mut ScrewOutputs,
) -> u32 {
    unsafe { step::<Screw<1>>(place, inputs, outputs) }
}

/// Sets the angle of the nut against the screw, rad, from which the screw's deviations are counted: once after
/// start-up, and again whenever an absolute sensor has it; between, the model integrates the speed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_screw_set_nut_angle(place: *mut ScrewPlace, angle: f32) -> u32 {
    match unsafe { placed::<Screw<1>>(place) } {
        Ok(placed) => {
            placed.model.set_nut_angle(angle);
            EPAS_OK
        }
        Err(status) => status,
    }
}

/// Back to the state before the first tick.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_screw_reset(place: *mut ScrewPlace) -> u32 {
    unsafe { reset::<Screw<1>>(place) }
}

/// Consecutive ticks with a fault; as `epas_caged_faulted_ticks`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_screw_faulted_ticks(
    place: *const ScrewPlace,
    ticks: *mut u32,
) -> u32 {
    unsafe { faulted_ticks::<Screw<1>>(place, ticks) }
}

/// Goes on with another configuration, above all another folded ball: of a worn gear, another clearance, another lubricant. Balls stay where
/// they are, and the friction coefficient is that of the new folded ball; the old one is not read any more. Where it is refused the model goes
/// on as it was. `failure` may be NULL. In the task of the step; the next step takes as long as any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_screw_swap(
    place: *mut ScrewPlace,
    configuration: *const ScrewConfiguration,
    failure: *mut Failure,
) -> u32 {
    unsafe { swap::<Screw<1>>(place, configuration, failure) }
}

/// Makes a ball screw in the place, with a friction coefficient that changes; as `epas_screw_init`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_screw_range_init(
    place: *mut ScrewRangePlace,
    configuration: *const ScrewRangeConfiguration,
    failure: *mut Failure,
) -> u32 {
    unsafe { init::<ScrewRange>(place, configuration, failure) }
}

/// One tick; as `epas_caged_step`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_screw_range_step(
    place: *mut ScrewRangePlace,
    inputs: *const Inputs,
    outputs: *mut ScrewOutputs,
) -> u32 {
    unsafe { step::<ScrewRange>(place, inputs, outputs) }
}

/// Sets the angle of the nut against the screw, rad; as `epas_screw_set_nut_angle`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_screw_range_set_nut_angle(
    place: *mut ScrewRangePlace,
    angle: f32,
) -> u32 {
    match unsafe { placed::<ScrewRange>(place) } {
        Ok(placed) => {
            placed.model.set_nut_angle(angle);
            EPAS_OK
        }
        Err(status) => status,
    }
}

/// Back to the state before the first tick.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_screw_range_reset(place: *mut ScrewRangePlace) -> u32 {
    unsafe { reset::<ScrewRange>(place) }
}

/// Consecutive ticks with a fault; as `epas_caged_faulted_ticks`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_screw_range_faulted_ticks(
    place: *const ScrewRangePlace,
    ticks: *mut u32,
) -> u32 {
    unsafe { faulted_ticks::<ScrewRange>(place, ticks) }
}

/// Goes on with another configuration; as `epas_screw_swap`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_screw_range_swap(
    place: *mut ScrewRangePlace,
    configuration: *const ScrewRangeConfiguration,
    failure: *mut Failure,
) -> u32 {
    unsafe { swap::<ScrewRange>(place, configuration, failure) }
}

/// Sets the friction coefficient of ball and groove while the model runs, within the folded range; as `epas_caged_range_set_friction`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_screw_range_set_friction(
    place: *mut ScrewRangePlace,
    friction: f32,
    failure: *mut Failure,
) -> u32 {
    unsafe { change::<ScrewRange>(place, |model| model.set_friction(friction), failure) }
}

/// Makes a linear bearing in the place. Set-up only. Where it fails, every step is
/// refused until it succeeds. `failure` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_linear_init(
    place: *mut LinearPlace,
    configuration: *const LinearConfiguration,
    failure: *mut Failure,
) -> u32 {
    unsafe { init::<Linear>(place, configuration, failure) }
}

/// One tick; as `epas_caged_step`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_linear_step(
    place: *mut LinearPlace,
    inputs: *const LinearInputs,
    outputs: *mut LinearOutputs,
) -> u32 {
    unsafe { step::<Linear>(place, inputs, outputs) }
}

/// Sets the carriage's place along the rail, m, from which the rail's deviations are counted: once after start-up, and
/// again whenever an absolute sensor has it; between, the model integrates the speed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_linear_set_carriage_position(
    place: *mut LinearPlace,
    position: f32,
) -> u32 {
    match unsafe { placed::<Linear>(place) } {
        Ok(placed) => {
            placed.model.set_carriage_position(position);
            EPAS_OK
        }
        Err(status) => status,
    }
}

/// Back to the state before the first tick.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_linear_reset(place: *mut LinearPlace) -> u32 {
    unsafe { reset::<Linear>(place) }
}

/// Consecutive ticks with a fault; as `epas_caged_faulted_ticks`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_linear_faulted_ticks(
    place: *const LinearPlace,
    ticks: *mut u32,
) -> u32 {
    unsafe { faulted_ticks::<Linear>(place, ticks) }
}

/// Sets the friction coefficient of ball and groove, 1e-6 to 1; as `epas_caged_range_set_friction`. Friction and all forces between
/// balls follow it in proportion, from the next tick on, which takes no longer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_linear_set_friction(
    place: *mut LinearPlace,
    friction: f32,
    failure: *mut Failure,
) -> u32 {
    unsafe { change::<Linear>(place, |model| model.set_friction(friction), failure) }
}

/// Writes the state as a block of `EPAS_CAGED_STATE_BYTES` bytes to the begin of `bytes`, which are `length` long: for the next
/// ignition. Outside the interrupt.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_caged_export(
    place: *const CagedPlace,
    bytes: *mut u8,
    length: u32,
) -> u32 {
    unsafe { export::<Caged<1>>(place, bytes, length) }
}

/// Takes the state of a block over, of the same lead: before the first step. What follows the block in `bytes` is not read. A block that is
/// foreign, old or damaged is refused, and the model is as it was. Outside the interrupt.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_caged_import(
    place: *mut CagedPlace,
    bytes: *const u8,
    length: u32,
) -> u32 {
    unsafe { import::<Caged<1>>(place, bytes, length) }
}

/// Writes the state as a block of `EPAS_CAGED_RANGE_STATE_BYTES` bytes; as `epas_caged_export`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_caged_range_export(
    place: *const CagedRangePlace,
    bytes: *mut u8,
    length: u32,
) -> u32 {
    unsafe { export::<CagedRange>(place, bytes, length) }
}

/// Takes the state of a block over; as `epas_caged_import`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_caged_range_import(
    place: *mut CagedRangePlace,
    bytes: *const u8,
    length: u32,
) -> u32 {
    unsafe { import::<CagedRange>(place, bytes, length) }
}

/// Writes the state as a block of `EPAS_CLOSED_FORM_STATE_BYTES` bytes; as `epas_caged_export`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_closed_form_export(
    place: *const ClosedFormPlace,
    bytes: *mut u8,
    length: u32,
) -> u32 {
    unsafe { export::<ClosedForm>(place, bytes, length) }
}

/// Takes the state of a block over; as `epas_caged_import`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_closed_form_import(
    place: *mut ClosedFormPlace,
    bytes: *const u8,
    length: u32,
) -> u32 {
    unsafe { import::<ClosedForm>(place, bytes, length) }
}

/// Writes the state as a block of `EPAS_SCREW_STATE_BYTES` bytes; as `epas_caged_export`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_screw_export(
    place: *const ScrewPlace,
    bytes: *mut u8,
    length: u32,
) -> u32 {
    unsafe { export::<Screw<1>>(place, bytes, length) }
}

/// Takes the state of a block over; as `epas_caged_import`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_screw_import(
    place: *mut ScrewPlace,
    bytes: *const u8,
    length: u32,
) -> u32 {
    unsafe { import::<Screw<1>>(place, bytes, length) }
}

/// Writes the state as a block of `EPAS_SCREW_RANGE_STATE_BYTES` bytes; as `epas_caged_export`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_screw_range_export(
    place: *const ScrewRangePlace,
    bytes: *mut u8,
    length: u32,
) -> u32 {
    unsafe { export::<ScrewRange>(place, bytes, length) }
}

/// Takes the state of a block over; as `epas_caged_import`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_screw_range_import(
    place: *mut ScrewRangePlace,
    bytes: *const u8,
    length: u32,
) -> u32 {
    unsafe { import::<ScrewRange>(place, bytes, length) }
}

/// Writes the state as a block of `EPAS_LINEAR_STATE_BYTES` bytes; as `epas_caged_export`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_linear_export(
    place: *const LinearPlace,
    bytes: *mut u8,
    length: u32,
) -> u32 {
    unsafe { export::<Linear>(place, bytes, length) }
}

/// Takes the state of a block over; as `epas_caged_import`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_linear_import(
    place: *mut LinearPlace,
    bytes: *const u8,
    length: u32,
) -> u32 {
    unsafe { import::<Linear>(place, bytes, length) }
}
