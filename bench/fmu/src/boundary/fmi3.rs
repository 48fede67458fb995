//! FMI 3.0, for co-simulation: what this unit has.

use std::ffi::{c_char, c_void};
use std::ptr;

use super::logger::{Logger, Logger3};
use super::pointers::{array, array_mut, folder, place, pointer, text};
use crate::instance::{Instance, Said, Wanted};
use crate::outcome::Outcome;
use crate::registry::{self, call};

/// `fmi3Instance`, a handle.
pub type Handle = *mut c_void;
/// `fmi3FMUState`, a handle.
pub type State = *mut c_void;
/// `fmi3Status`
pub type Status = i32;
/// `fmi3Boolean`; a byte, because no value of it is then undefined.
pub type Boolean = u8;

const OK: Status = 0;
const WARNING: Status = 1;
const ERROR: Status = 3;

pub fn on(handle: Handle, action: impl FnOnce(&mut Instance, &mut Logger) -> Said) -> Status {
    match call(handle.addr(), action) {
        Outcome::Fine => OK,
        Outcome::Warning => WARNING,
        Outcome::Refused => ERROR,
    }
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi3GetVersion() -> *const c_char {
    c"3.0".as_ptr()
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateCoSimulation(
    name: *const c_char,
    token: *const c_char,
    resources: *const c_char,
    _visible: Boolean,
    logging: Boolean,
    event_mode: Boolean,
    _early_return: Boolean,
    _intermediate: *const u32,
    intermediate_count: usize,
    environment: *mut c_void,
    log: Option<Logger3>,
    _update: *const c_void,
) -> Handle {
    // SAFETY: as the module says.
    let name = unsafe { text(name, "instanceName") };
    let shown = name.clone().unwrap_or_default();
    let logger = Logger::three(log, environment, &shown, logging != 0);
    let made = registry::insert(logger, || {
        name?;
        if event_mode != 0 {
            return Err("eventModeUsed is true: this unit has no event mode".into());
        }
        if intermediate_count != 0 {
            return Err(format!(
                "nRequiredIntermediateVariables = {intermediate_count} is out of range; allowed: 0"
            ));
        }
        // SAFETY: as the module says.
        let (token, resources) = unsafe {
            (
                text(token, "instantiationToken")?,
                text(resources, "resourcePath")?,
            )
        };
        Instance::new(&folder(&resources)?, &token)
    });
    made.map_or(ptr::null_mut(), pointer)
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi3FreeInstance(handle: Handle) {
    registry::remove(handle.addr());
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetDebugLogging(
    handle: Handle,
    logging: Boolean,
    count: usize,
    categories: *const *const c_char,
) -> Status {
    on(handle, |_, logger| {
        // SAFETY: as the module says.
        let names = unsafe { array(categories, count, "categories") }?
            .iter()
            .map(|name| unsafe { text(*name, "categories") })
            .collect::<Result<Vec<_>, _>>()?;
        logger.want(logging != 0, &names)?;
        Ok(None)
    })
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi3EnterInitializationMode(
    handle: Handle,
    _tolerance_defined: Boolean,
    _tolerance: f64,
    start: f64,
    _stop_defined: Boolean,
    _stop: f64,
) -> Status {
    on(handle, |instance, _| {
        instance.start_at("fmi3EnterInitializationMode", start)?;
        instance.enter_initialization("fmi3EnterInitializationMode")
    })
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi3ExitInitializationMode(handle: Handle) -> Status {
    on(handle, |instance, _| {
        instance.exit_initialization("fmi3ExitInitializationMode")
    })
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi3Terminate(handle: Handle) -> Status {
    on(handle, |instance, _| instance.terminate("fmi3Terminate"))
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi3Reset(handle: Handle) -> Status {
    on(handle, |instance, _| {
        instance.reset();
        Ok(None)
    })
}

fn refuse_lengths(references: usize, values: usize) -> Result<(), String> {
    if references == values {
        Ok(())
    } else {
        Err(format!(
            "nValues = {values} is out of range; allowed: {references}, one for each value reference"
        ))
    }
}

macro_rules! access {
    ($get:ident, $set:ident, $type:ty, $wanted:expr) => {
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $get(
            handle: Handle,
            references: *const u32,
            count: usize,
            values: *mut $type,
            value_count: usize,
        ) -> Status {
            on(handle, |instance, _| {
                refuse_lengths(count, value_count)?;
                // SAFETY: as the module says.
                let (references, values) = unsafe {
                    (
                        array(references, count, "valueReferences")?,
                        array_mut(values, count, "values")?,
                    )
                };
                for (reference, value) in references.iter().zip(values) {
                    *value = instance.get(*reference, $wanted)? as $type;
                }
                Ok(None)
            })
        }

        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $set(
            handle: Handle,
            references: *const u32,
            count: usize,
            values: *const $type,
            value_count: usize,
        ) -> Status {
            on(handle, |instance, _| {
                refuse_lengths(count, value_count)?;
                // SAFETY: as the module says.
                let (references, values) = unsafe {
                    (
                        array(references, count, "valueReferences")?,
                        array(values, count, "values")?,
                    )
                };
                for (reference, value) in references.iter().zip(values) {
                    instance.set(*reference, $wanted, *value as f64)?;
                }
                Ok(None)
            })
        }
    };
}

access!(fmi3GetFloat64, fmi3SetFloat64, f64, Wanted::Float64);
access!(fmi3GetFloat32, fmi3SetFloat32, f32, Wanted::Float32);
access!(fmi3GetInt32, fmi3SetInt32, i32, Wanted::Int32);
access!(fmi3GetInt64, fmi3SetInt64, i64, Wanted::Int64);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetFMUState(handle: Handle, state: *mut State) -> Status {
    on(handle, |instance, _| {
        // SAFETY: as the module says.
        let state = unsafe { place(state, "FMUState") }?;
        let known = instance.kept(state.addr()).is_ok();
        let kept = if known {
            state.addr()
        } else {
            registry::fresh()
        };
        instance.keep(kept)?;
        *state = pointer(kept);
        Ok(None)
    })
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi3SetFMUState(handle: Handle, state: State) -> Status {
    on(handle, |instance, _| {
        instance.restore(state.addr())?;
        Ok(None)
    })
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeFMUState(handle: Handle, state: *mut State) -> Status {
    on(handle, |instance, _| {
        if state.is_null() {
            return Ok(None);
        }
        // SAFETY: as the module says.
        let state = unsafe { place(state, "FMUState") }?;
        if !state.is_null() {
            instance.forget(state.addr())?;
            *state = ptr::null_mut();
        }
        Ok(None)
    })
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SerializedFMUStateSize(
    handle: Handle,
    state: State,
    size: *mut usize,
) -> Status {
    on(handle, |instance, _| {
        // SAFETY: as the module says.
        *unsafe { place(size, "size") }? = instance.kept(state.addr())?.len();
        Ok(None)
    })
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SerializeFMUState(
    handle: Handle,
    state: State,
    bytes: *mut u8,
    size: usize,
) -> Status {
    on(handle, |instance, _| {
        let kept = instance.kept(state.addr())?;
        // SAFETY: as the module says.
        let bytes = unsafe { array_mut(bytes, size, "serializedState") }?;
        let bytes = bytes.get_mut(..kept.len()).ok_or_else(|| {
            format!(
                "size = {size} is out of range; allowed: {} or more",
                kept.len()
            )
        })?;
        bytes.copy_from_slice(kept);
        Ok(None)
    })
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3DeserializeFMUState(
    handle: Handle,
    bytes: *const u8,
    size: usize,
    state: *mut State,
) -> Status {
    on(handle, |instance, _| {
        // SAFETY: as the module says.
        let (bytes, state) = unsafe {
            (
                array(bytes, size, "serializedState")?,
                place(state, "FMUState")?,
            )
        };
        let kept = registry::fresh();
        instance.keep_bytes(kept, bytes)?;
        *state = pointer(kept);
        Ok(None)
    })
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3DoStep(
    handle: Handle,
    point: f64,
    size: f64,
    _no_way_back: Boolean,
    event: *mut Boolean,
    terminate: *mut Boolean,
    early: *mut Boolean,
    last: *mut f64,
) -> Status {
    on(handle, |instance, _| {
        // SAFETY: as the module says.
        let (event, terminate, early, last) = unsafe {
            (
                place(event, "eventHandlingNeeded")?,
                place(terminate, "terminateSimulation")?,
                place(early, "earlyReturn")?,
                place(last, "lastSuccessfulTime")?,
            )
        };
        (*event, *terminate, *early) = (0, 0, 0);
        *last = instance.time();
        let said = instance.do_step("fmi3DoStep", point, size)?;
        *last = instance.time();
        Ok(said)
    })
}
