//! What the exported functions of every scene do to a model in its place.

use epas_friction::{Error, FrictionModel};

use super::pointers::{bare, read, report, usable};
use super::tables::tables;
use crate::scene::{CScene, Placed, constants, model};
use crate::status::{EPAS_NOT_INITIALISED, EPAS_OK, Failure, refused};

/// The crate's model of a scene.
pub(super) type Model<C> = FrictionModel<<C as CScene>::Scene>;

/// The model in a place, if it is this scene's.
pub(super) unsafe fn placed<'a, C: CScene>(
    place: *mut C::Place,
) -> Result<&'a mut Placed<C::Scene>, u32> {
    let () = C::FITS;
    usable(place)?;
    let place = place.cast::<Placed<C::Scene>>();
    if unsafe { (&raw const (*place).mark).read() } == C::MARK {
        Ok(unsafe { &mut *place })
    } else {
        Err(EPAS_NOT_INITIALISED)
    }
}

/// Sets a model up in a place; where that fails, the place holds none.
pub(super) unsafe fn init<C: CScene>(
    place: *mut C::Place,
    configuration: *const C::Configuration,
    failure: *mut Failure,
) -> u32 {
    let () = C::FITS;
    let outcome = usable(place).map_err(bare).and_then(|()| {
        let place = place.cast::<Placed<C::Scene>>();
        // A place whose configuration is refused holds no model.
        unsafe { (&raw mut (*place).mark).write(0) };
        usable(configuration).map_err(bare)?;
        let configuration = unsafe { &*configuration };
        let tables = unsafe { tables(&C::pointers(configuration)) }?;
        let model = model::<C>(configuration, tables)?;
        unsafe { (&raw mut (*place).model).write(model) };
        unsafe { (&raw mut (*place).mark).write(C::MARK) };
        Ok(())
    });
    unsafe { report(outcome, failure) }
}

/// One tick, or the refused outputs where there is no model or there are no inputs.
#[inline(always)]
pub(super) unsafe fn step<C: CScene>(
    place: *mut C::Place,
    inputs: *const C::Inputs,
    outputs: *mut C::Outputs,
) -> u32 {
    if let Err(status) = usable(outputs) {
        return status;
    }
    let ready = unsafe { placed::<C>(place) }
        .and_then(|placed| Ok((&mut placed.model, unsafe { read(inputs) }?)));
    let (answer, status) = match ready {
        Ok((model, inputs)) => (C::outputs(model.step(C::inputs(inputs))), EPAS_OK),
        Err(status) => (C::REFUSED, status),
    };
    unsafe { outputs.write(answer) };
    status
}

/// Changes a model while it runs; where the change is refused it goes on as it was.
pub(super) unsafe fn change<C: CScene>(
    place: *mut C::Place,
    how: impl FnOnce(&mut Model<C>) -> Result<(), Error>,
    failure: *mut Failure,
) -> u32 {
    let outcome = unsafe { placed::<C>(place) }
        .map_err(bare)
        .and_then(|placed| how(&mut placed.model).map_err(Failure::of));
    unsafe { report(outcome, failure) }
}

/// Goes on with the constants of another configuration; where it is refused the model goes on as it was.
pub(super) unsafe fn swap<C: CScene>(
    place: *mut C::Place,
    configuration: *const C::Configuration,
    failure: *mut Failure,
) -> u32 {
    let outcome = unsafe { placed::<C>(place) }
        .map_err(bare)
        .and_then(|placed| {
            usable(configuration).map_err(bare)?;
            let configuration = unsafe { &*configuration };
            let tables = unsafe { tables(&C::pointers(configuration)) }?;
            let constants = constants::<C>(configuration, tables)?;
            let swapped = placed.model.swap_constants(constants);
            swapped.map(drop).map_err(Failure::of)
        });
    unsafe { report(outcome, failure) }
}

/// The state before the first tick.
pub(super) unsafe fn reset<C: CScene>(place: *mut C::Place) -> u32 {
    match unsafe { placed::<C>(place) } {
        Ok(placed) => {
            placed.model.reset();
            EPAS_OK
        }
        Err(status) => status,
    }
}

/// The counter of ticks whose outputs were flagged.
pub(super) unsafe fn faulted_ticks<C: CScene>(place: *const C::Place, ticks: *mut u32) -> u32 {
    if let Err(status) = usable(ticks) {
        return status;
    }
    // Only read.
    match unsafe { placed::<C>(place.cast_mut()) } {
        Ok(placed) => {
            unsafe { ticks.write(placed.model.faulted_ticks()) };
            EPAS_OK
        }
        Err(status) => status,
    }
}

/// Writes the state as a block.
pub(super) unsafe fn export<C: CScene>(place: *const C::Place, bytes: *mut u8, length: u32) -> u32 {
    let () = C::STATE_FITS;
    if let Err(status) = usable(bytes) {
        return status;
    }
    // Only read.
    match unsafe { placed::<C>(place.cast_mut()) } {
        Ok(placed) => {
            let bytes = unsafe { core::slice::from_raw_parts_mut(bytes, length as usize) };
            placed.model.export(bytes).map_or_else(refused, |_| EPAS_OK)
        }
        Err(status) => status,
    }
}

/// Takes the state of a block over; where it is refused the model is as it was.
pub(super) unsafe fn import<C: CScene>(place: *mut C::Place, bytes: *const u8, length: u32) -> u32 {
    let () = C::STATE_FITS;
    if let Err(status) = usable(bytes) {
        return status;
    }
    match unsafe { placed::<C>(place) } {
        Ok(placed) => {
            let bytes = unsafe { core::slice::from_raw_parts(bytes, length as usize) };
            placed
                .model
                .import(whole(bytes))
                .map_or_else(refused, |()| EPAS_OK)
        }
        Err(status) => status,
    }
}

/// The block at the begin of a place for one of the most balls: as long as it says itself.
fn whole(bytes: &[u8]) -> &[u8] {
    const SHORTEST: usize = 20;
    let length = bytes.get(10..).and_then(<[u8]>::first_chunk);
    let length = length.map_or(0, |length| usize::from(u16::from_le_bytes(*length)));
    let block = bytes.get(..length).unwrap_or(bytes);
    if length < SHORTEST { bytes } else { block }
}
