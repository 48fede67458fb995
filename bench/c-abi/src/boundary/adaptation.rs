//! The exported functions of the friction level that follows the vehicle.

use super::pointers::{bare, read, report, usable};
use crate::adaptation::{
    AdaptationConfiguration, AdaptationInputs, AdaptationOutputs, AdaptationPlace,
    PlacedAdaptation, adaptation, inputs as translated,
};
use crate::status::{EPAS_NOT_INITIALISED, EPAS_OK, Failure, refused};

/// The adaptation in a place, if there is one.
unsafe fn placed<'a>(place: *mut AdaptationPlace) -> Result<&'a mut PlacedAdaptation, u32> {
    usable(place)?;
    let place = place.cast::<PlacedAdaptation>();
    if unsafe { (&raw const (*place).mark).read() } == PlacedAdaptation::MARK {
        Ok(unsafe { &mut *place })
    } else {
        Err(EPAS_NOT_INITIALISED)
    }
}

/// Makes an adaptation in the place. Set-up only. Where it fails, every update is refused until it succeeds. `failure` may be
/// NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_adaptation_init(
    place: *mut AdaptationPlace,
    configuration: *const AdaptationConfiguration,
    failure: *mut Failure,
) -> u32 {
    let () = PlacedAdaptation::FITS;
    let outcome = usable(place).map_err(bare).and_then(|()| {
        let place = place.cast::<PlacedAdaptation>();
        // A place whose configuration is refused holds nothing.
        unsafe { (&raw mut (*place).mark).write(0) };
        usable(configuration).map_err(bare)?;
        let made = adaptation(unsafe { &*configuration })?;
        unsafe { (&raw mut (*place).adaptation).write(made) };
        unsafe { (&raw mut (*place).mark).write(PlacedAdaptation::MARK) };
        Ok(())
    });
    unsafe { report(outcome, failure) }
}

/// One tick, after the model's step: bounded time, finite outputs whatever the inputs are. Where the call is refused the outputs
/// are levels of 1 and `EPAS_FAULT_CALL`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_adaptation_update(
    place: *mut AdaptationPlace,
    inputs: *const AdaptationInputs,
    outputs: *mut AdaptationOutputs,
) -> u32 {
    if let Err(status) = usable(outputs) {
        return status;
    }
    let ready = unsafe { placed(place) }.and_then(|placed| Ok((placed, unsafe { read(inputs) }?)));
    let (answer, status) = match ready {
        Ok((placed, inputs)) => {
            let adapted = placed.adaptation.update(&translated(&inputs));
            (AdaptationOutputs::of(&adapted), EPAS_OK)
        }
        Err(status) => (AdaptationOutputs::REFUSED, status),
    };
    unsafe { outputs.write(answer) };
    status
}

/// Takes the present level for that of a sound mechanism, from which drift counts: once, at the end of the line.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_adaptation_commission(place: *mut AdaptationPlace) -> u32 {
    match unsafe { placed(place) } {
        Ok(placed) => {
            placed.adaptation.commission();
            EPAS_OK
        }
        Err(status) => status,
    }
}

/// Back to the state before the first tick; the commissioning is forgotten, too.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_adaptation_reset(place: *mut AdaptationPlace) -> u32 {
    match unsafe { placed(place) } {
        Ok(placed) => {
            placed.adaptation.reset();
            EPAS_OK
        }
        Err(status) => status,
    }
}

/// Writes the state as a block of `EPAS_ADAPTATION_STATE_BYTES` bytes; as `epas_caged_export`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_adaptation_export(
    place: *const AdaptationPlace,
    bytes: *mut u8,
    length: u32,
) -> u32 {
    if let Err(status) = usable(bytes) {
        return status;
    }
    // Only read.
    match unsafe { placed(place.cast_mut()) } {
        Ok(placed) => {
            let bytes = unsafe { core::slice::from_raw_parts_mut(bytes, length as usize) };
            placed
                .adaptation
                .export(bytes)
                .map_or_else(refused, |_| EPAS_OK)
        }
        Err(status) => status,
    }
}

/// Takes the state of a block over, of the same noise, deviations and forgetting; as `epas_caged_import`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_adaptation_import(
    place: *mut AdaptationPlace,
    bytes: *const u8,
    length: u32,
) -> u32 {
    if let Err(status) = usable(bytes) {
        return status;
    }
    match unsafe { placed(place) } {
        Ok(placed) => {
            let bytes = unsafe { core::slice::from_raw_parts(bytes, length as usize) };
            placed
                .adaptation
                .import(bytes)
                .map_or_else(refused, |()| EPAS_OK)
        }
        Err(status) => status,
    }
}
