//! The exported functions of the ball screw whose friction remembers.

use super::models::{change, export, faulted_ticks, import, init, placed, reset, step, swap};
use super::pointers::{bare, read, report, usable};
use crate::memory::{
    Coefficient, Memory, MemoryConfiguration, MemoryInputs, MemoryPlace, coefficient, level,
};
use crate::scene::CScene;
use crate::status::{EPAS_OK, Failure, refused};
use crate::types::Outputs;

/// Makes a caged ball screw whose friction remembers in the place; as `epas_caged_init`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_memory_init(
    place: *mut MemoryPlace,
    configuration: *const MemoryConfiguration,
    failure: *mut Failure,
) -> u32 {
    unsafe { init::<Memory>(place, configuration, failure) }
}

/// One tick, every millisecond or so; as `epas_caged_step`. NaN as speed or load: the last values are used. Where
/// the count is not valid friction keeps its last value. Both are flagged.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_memory_step(
    place: *mut MemoryPlace,
    inputs: *const MemoryInputs,
    outputs: *mut Outputs,
) -> u32 {
    unsafe { step::<Memory>(place, inputs, outputs) }
}

/// Friction between two steps, after a new count: for a current loop that runs faster than the step. Loads and the friction
/// coefficient stay as the last step found them; before the first one there is no friction.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_memory_between(
    place: *mut MemoryPlace,
    count: u32,
    outputs: *mut Outputs,
) -> u32 {
    if let Err(status) = usable(outputs) {
        return status;
    }
    let (answer, status) = match unsafe { placed::<Memory>(place) } {
        Ok(placed) => (Memory::outputs(placed.model.between(count)), EPAS_OK),
        Err(status) => (Memory::REFUSED, status),
    };
    unsafe { outputs.write(answer) };
    status
}

/// Sets the law of the friction coefficient, from the next step on; `epas_memory_reset` brings the configuration's back. Where
/// it is refused the model goes on as it was. `failure` may be NULL. In the task of the step.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_memory_set_coefficient(
    place: *mut MemoryPlace,
    law: *const Coefficient,
    failure: *mut Failure,
) -> u32 {
    let outcome = unsafe { placed::<Memory>(place) }
        .and_then(|placed| Ok((placed, unsafe { read(law) }?)))
        .map_err(bare)
        .and_then(|(placed, law)| {
            let law = coefficient(&law)?;
            placed.model.set_coefficient(law).map_err(Failure::of)
        });
    unsafe { report(outcome, failure) }
}

/// Sets how large friction is beside that of the configuration in each direction, 0.1 to 10, from the next step or count on:
/// what an `epas_adaptation_t` has found goes in here, and into the inputs of its next update. `epas_memory_reset` brings 1 back.
/// Where it is refused the model goes on as it was. `failure` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_memory_set_level(
    place: *mut MemoryPlace,
    forward: f32,
    backward: f32,
    failure: *mut Failure,
) -> u32 {
    unsafe {
        change::<Memory>(
            place,
            |model| model.set_level(level(forward, backward)),
            failure,
        )
    }
}

/// Lubricant drag in the friction torque of the last step, N m, which no level scales: for the inputs of an `epas_adaptation_t`. 0 before the
/// first step. In the task of the step.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_memory_drag_torque(
    place: *const MemoryPlace,
    torque: *mut f32,
) -> u32 {
    if let Err(status) = usable(torque) {
        return status;
    }
    // Only read.
    match unsafe { placed::<Memory>(place.cast_mut()) } {
        Ok(placed) => {
            unsafe { torque.write(placed.model.drag_torque()) };
            EPAS_OK
        }
        Err(status) => status,
    }
}

/// Goes on with another block and what is set beside it; as `epas_caged_swap`. The memory stays.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_memory_swap(
    place: *mut MemoryPlace,
    configuration: *const MemoryConfiguration,
    failure: *mut Failure,
) -> u32 {
    unsafe { swap::<Memory>(place, configuration, failure) }
}

/// Back to the state before the first tick.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_memory_reset(place: *mut MemoryPlace) -> u32 {
    unsafe { reset::<Memory>(place) }
}

/// Consecutive ticks with a fault; as `epas_caged_faulted_ticks`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_memory_faulted_ticks(
    place: *const MemoryPlace,
    ticks: *mut u32,
) -> u32 {
    unsafe { faulted_ticks::<Memory>(place, ticks) }
}

/// Writes the state as a block of `EPAS_MEMORY_STATE_BYTES` bytes; as `epas_caged_export`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_memory_export(
    place: *const MemoryPlace,
    bytes: *mut u8,
    length: u32,
) -> u32 {
    unsafe { export::<Memory>(place, bytes, length) }
}

/// Takes the state of a block over; as `epas_caged_import`. The turn since the block was written is unknown: the first count
/// begins anew.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_memory_import(
    place: *mut MemoryPlace,
    bytes: *const u8,
    length: u32,
) -> u32 {
    unsafe { import::<Memory>(place, bytes, length) }
}

/// The same with the last count: the turn of the next one spans the time without power. Right only for an encoder that is
/// absolute over all that the nut may have turned by.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_memory_import_with_count(
    place: *mut MemoryPlace,
    bytes: *const u8,
    length: u32,
) -> u32 {
    if let Err(status) = usable(bytes) {
        return status;
    }
    match unsafe { placed::<Memory>(place) } {
        Ok(placed) => {
            let block = unsafe { core::slice::from_raw_parts(bytes, length as usize) };
            placed
                .model
                .import_with_reading(block)
                .map_or_else(refused, |()| EPAS_OK)
        }
        Err(status) => status,
    }
}
