//! FMI 2.0, for co-simulation.

use std::ffi::{c_char, c_void};
use std::ptr;

use super::logger::{Logger, Logger2};
use super::pointers::{array, array_mut, folder, place, pointer, text};
use crate::instance::{Instance, Said, Wanted};
use crate::outcome::Outcome;
use crate::registry::{self, call};

/// `fmi2Component`, a handle.
pub type Component = *mut c_void;
/// `fmi2FMUstate`, a handle.
type State = *mut c_void;
/// `fmi2Status`
pub type Status = i32;
/// `fmi2Boolean`
pub type Boolean = i32;

const OK: Status = 0;
const WARNING: Status = 1;
const ERROR: Status = 3;

/// `fmi2CallbackFunctions`
#[repr(C)]
pub struct Callbacks {
    logger: Option<Logger2>,
    allocate: *const c_void,
    free: *const c_void,
    step_finished: *const c_void,
    environment: *mut c_void,
}

pub fn on(component: Component, action: impl FnOnce(&mut Instance, &mut Logger) -> Said) -> Status {
    match call(component.addr(), action) {
        Outcome::Fine => OK,
        Outcome::Warning => WARNING,
        Outcome::Refused => ERROR,
    }
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetTypesPlatform() -> *const c_char {
    c"default".as_ptr()
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetVersion() -> *const c_char {
    c"2.0".as_ptr()
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Instantiate(
    name: *const c_char,
    kind: i32,
    token: *const c_char,
    resources: *const c_char,
    callbacks: *const Callbacks,
    _visible: Boolean,
    logging: Boolean,
) -> Component {
    // SAFETY: as the module says.
    let (name, callbacks) = unsafe { (text(name, "instanceName"), callbacks.as_ref()) };
    // Without callbacks nobody could be told anything, but nothing here needs them.
    let (function, environment) = callbacks.map_or((None, ptr::null_mut()), |callbacks| {
        (callbacks.logger, callbacks.environment)
    });
    let shown = name.clone().unwrap_or_default();
    let logger = Logger::two(function, environment, &shown, logging != 0);
    let made = registry::insert(logger, || {
        name?;
        if kind != 1 {
            return Err(format!(
                "fmuType = {kind} is out of range; allowed: 1, co-simulation"
            ));
        }
        // SAFETY: as the module says.
        let (token, resources) = unsafe {
            (
                text(token, "fmuGUID")?,
                text(resources, "fmuResourceLocation")?,
            )
        };
        Instance::new(&folder(&resources)?, &token)
    });
    made.map_or(ptr::null_mut(), pointer)
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi2FreeInstance(component: Component) {
    registry::remove(component.addr());
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetDebugLogging(
    component: Component,
    logging: Boolean,
    count: usize,
    categories: *const *const c_char,
) -> Status {
    on(component, |_, logger| {
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
pub extern "C" fn fmi2SetupExperiment(
    component: Component,
    _tolerance_defined: Boolean,
    _tolerance: f64,
    start: f64,
    _stop_defined: Boolean,
    _stop: f64,
) -> Status {
    on(component, |instance, _| {
        instance.start_at("fmi2SetupExperiment", start)?;
        Ok(None)
    })
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi2EnterInitializationMode(component: Component) -> Status {
    on(component, |instance, _| {
        instance.enter_initialization("fmi2EnterInitializationMode")
    })
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi2ExitInitializationMode(component: Component) -> Status {
    on(component, |instance, _| {
        instance.exit_initialization("fmi2ExitInitializationMode")
    })
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi2Terminate(component: Component) -> Status {
    on(component, |instance, _| instance.terminate("fmi2Terminate"))
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi2Reset(component: Component) -> Status {
    on(component, |instance, _| {
        instance.reset();
        Ok(None)
    })
}

macro_rules! access {
    ($get:ident, $set:ident, $type:ty, $wanted:expr) => {
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $get(
            component: Component,
            references: *const u32,
            count: usize,
            values: *mut $type,
        ) -> Status {
            on(component, |instance, _| {
                // SAFETY: as the module says.
                let (references, values) = unsafe {
                    (
                        array(references, count, "vr")?,
                        array_mut(values, count, "value")?,
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
            component: Component,
            references: *const u32,
            count: usize,
            values: *const $type,
        ) -> Status {
            on(component, |instance, _| {
                // SAFETY: as the module says.
                let (references, values) = unsafe {
                    (
                        array(references, count, "vr")?,
                        array(values, count, "value")?,
                    )
                };
                for (reference, value) in references.iter().zip(values) {
                    instance.set(*reference, $wanted, f64::from(*value))?;
                }
                Ok(None)
            })
        }
    };
}

access!(fmi2GetReal, fmi2SetReal, f64, Wanted::Real);
access!(fmi2GetInteger, fmi2SetInteger, i32, Wanted::Integer);
access!(
    fmi2GetBoolean,
    fmi2SetBoolean,
    i32,
    Wanted::Other("Boolean")
);

unsafe fn no_text(component: Component, references: *const u32, count: usize) -> Status {
    on(component, |instance, _| {
        // SAFETY: as the module says.
        for reference in unsafe { array(references, count, "vr") }? {
            instance.get(*reference, Wanted::Other("String"))?;
        }
        Ok(None)
    })
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetString(
    component: Component,
    references: *const u32,
    count: usize,
    _values: *mut *const c_char,
) -> Status {
    // SAFETY: as the module says.
    unsafe { no_text(component, references, count) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetString(
    component: Component,
    references: *const u32,
    count: usize,
    _values: *const *const c_char,
) -> Status {
    // SAFETY: as the module says.
    unsafe { no_text(component, references, count) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetFMUstate(component: Component, state: *mut State) -> Status {
    on(component, |instance, _| {
        // SAFETY: as the module says.
        let state = unsafe { place(state, "FMUstate") }?;
        let known = instance.kept(state.addr()).is_ok();
        let handle = if known {
            state.addr()
        } else {
            registry::fresh()
        };
        instance.keep(handle)?;
        *state = pointer(handle);
        Ok(None)
    })
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi2SetFMUstate(component: Component, state: State) -> Status {
    on(component, |instance, _| {
        instance.restore(state.addr())?;
        Ok(None)
    })
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeFMUstate(component: Component, state: *mut State) -> Status {
    on(component, |instance, _| {
        if state.is_null() {
            return Ok(None);
        }
        // SAFETY: as the module says.
        let state = unsafe { place(state, "FMUstate") }?;
        if !state.is_null() {
            instance.forget(state.addr())?;
            *state = ptr::null_mut();
        }
        Ok(None)
    })
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializedFMUstateSize(
    component: Component,
    state: State,
    size: *mut usize,
) -> Status {
    on(component, |instance, _| {
        // SAFETY: as the module says.
        *unsafe { place(size, "size") }? = instance.kept(state.addr())?.len();
        Ok(None)
    })
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializeFMUstate(
    component: Component,
    state: State,
    bytes: *mut u8,
    size: usize,
) -> Status {
    on(component, |instance, _| {
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
pub unsafe extern "C" fn fmi2DeSerializeFMUstate(
    component: Component,
    bytes: *const u8,
    size: usize,
    state: *mut State,
) -> Status {
    on(component, |instance, _| {
        // SAFETY: as the module says.
        let (bytes, state) = unsafe {
            (
                array(bytes, size, "serializedState")?,
                place(state, "FMUstate")?,
            )
        };
        let handle = registry::fresh();
        instance.keep_bytes(handle, bytes)?;
        *state = pointer(handle);
        Ok(None)
    })
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi2DoStep(
    component: Component,
    point: f64,
    size: f64,
    _no_way_back: Boolean,
) -> Status {
    on(component, |instance, _| {
        instance.do_step("fmi2DoStep", point, size)
    })
}

/// `fmi2LastSuccessfulTime`
const LAST_TIME: i32 = 2;

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealStatus(
    component: Component,
    kind: i32,
    value: *mut f64,
) -> Status {
    on(component, |instance, _| {
        if kind != LAST_TIME {
            return Err(format!(
                "the kind of status {kind} is out of range; allowed: {LAST_TIME}, the last successful time"
            ));
        }
        // SAFETY: as the module says.
        *unsafe { place(value, "value") }? = instance.time();
        Ok(None)
    })
}
