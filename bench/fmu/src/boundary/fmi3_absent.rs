//! FMI 3.0: what the standard wants exported and this unit does not have. Each refuses with a text.

use std::ffi::{c_char, c_void};
use std::ptr;

use super::fmi3::{Boolean, Handle, Status, on};
use super::logger::{Logger, Logger3};
use super::pointers::text;
use crate::registry;

macro_rules! absent {
    ($($name:ident($($argument:ident: $type:ty),*);)*) => {
        $(
            #[unsafe(no_mangle)]
            pub extern "C" fn $name(handle: Handle $(, $argument: $type)*) -> Status {
                on(handle, |_, _| {
                    Err(concat!(stringify!($name), " is called, which this unit does not have").into())
                })
            }
        )*
    };
}

absent! {
    fmi3GetInt8(_references: *const u32, _count: usize, _values: *mut i8, _value_count: usize);
    fmi3SetInt8(_references: *const u32, _count: usize, _values: *const i8, _value_count: usize);
    fmi3GetUInt8(_references: *const u32, _count: usize, _values: *mut u8, _value_count: usize);
    fmi3SetUInt8(_references: *const u32, _count: usize, _values: *const u8, _value_count: usize);
    fmi3GetInt16(_references: *const u32, _count: usize, _values: *mut i16, _value_count: usize);
    fmi3SetInt16(_references: *const u32, _count: usize, _values: *const i16, _value_count: usize);
    fmi3GetUInt16(_references: *const u32, _count: usize, _values: *mut u16, _value_count: usize);
    fmi3SetUInt16(_references: *const u32, _count: usize, _values: *const u16, _value_count: usize);
    fmi3GetUInt32(_references: *const u32, _count: usize, _values: *mut u32, _value_count: usize);
    fmi3SetUInt32(_references: *const u32, _count: usize, _values: *const u32, _value_count: usize);
    fmi3GetUInt64(_references: *const u32, _count: usize, _values: *mut u64, _value_count: usize);
    fmi3SetUInt64(_references: *const u32, _count: usize, _values: *const u64, _value_count: usize);
    fmi3GetBoolean(_references: *const u32, _count: usize, _values: *mut Boolean, _value_count: usize);
    fmi3SetBoolean(_references: *const u32, _count: usize, _values: *const Boolean, _value_count: usize);
    fmi3GetString(_references: *const u32, _count: usize, _values: *mut *const c_char, _value_count: usize);
    fmi3SetString(_references: *const u32, _count: usize, _values: *const *const c_char, _value_count: usize);
    fmi3GetBinary(_references: *const u32, _count: usize, _sizes: *mut usize, _values: *mut *const u8, _value_count: usize);
    fmi3SetBinary(_references: *const u32, _count: usize, _sizes: *const usize, _values: *const *const u8, _value_count: usize);
    fmi3GetClock(_references: *const u32, _count: usize, _values: *mut Boolean);
    fmi3SetClock(_references: *const u32, _count: usize, _values: *const Boolean);
    fmi3EnterEventMode();
    fmi3EnterStepMode();
    fmi3EnterConfigurationMode();
    fmi3ExitConfigurationMode();
    fmi3GetNumberOfVariableDependencies(_reference: u32, _count: *mut usize);
    fmi3GetVariableDependencies(_dependent: u32, _elements: *mut usize, _independents: *mut u32, _independent_elements: *mut usize, _kinds: *mut i32, _count: usize);
    fmi3GetDirectionalDerivative(_unknowns: *const u32, _unknown_count: usize, _knowns: *const u32, _known_count: usize, _seed: *const f64, _seed_count: usize, _sensitivity: *mut f64, _sensitivity_count: usize);
    fmi3GetAdjointDerivative(_unknowns: *const u32, _unknown_count: usize, _knowns: *const u32, _known_count: usize, _seed: *const f64, _seed_count: usize, _sensitivity: *mut f64, _sensitivity_count: usize);
    fmi3GetOutputDerivatives(_references: *const u32, _count: usize, _orders: *const i32, _values: *mut f64, _value_count: usize);
    fmi3GetIntervalDecimal(_references: *const u32, _count: usize, _intervals: *mut f64, _qualifiers: *mut i32);
    fmi3GetIntervalFraction(_references: *const u32, _count: usize, _counters: *mut u64, _resolutions: *mut u64, _qualifiers: *mut i32);
    fmi3GetShiftDecimal(_references: *const u32, _count: usize, _shifts: *mut f64);
    fmi3GetShiftFraction(_references: *const u32, _count: usize, _counters: *mut u64, _resolutions: *mut u64);
    fmi3SetIntervalDecimal(_references: *const u32, _count: usize, _intervals: *const f64);
    fmi3SetIntervalFraction(_references: *const u32, _count: usize, _counters: *const u64, _resolutions: *const u64);
    fmi3SetShiftDecimal(_references: *const u32, _count: usize, _shifts: *const f64);
    fmi3SetShiftFraction(_references: *const u32, _count: usize, _counters: *const u64, _resolutions: *const u64);
    fmi3EvaluateDiscreteStates();
    fmi3UpdateDiscreteStates(_update: *mut Boolean, _terminate: *mut Boolean, _nominals: *mut Boolean, _values: *mut Boolean, _event: *mut Boolean, _time: *mut f64);
    fmi3EnterContinuousTimeMode();
    fmi3CompletedIntegratorStep(_no_way_back: Boolean, _event: *mut Boolean, _terminate: *mut Boolean);
    fmi3SetTime(_time: f64);
    fmi3SetContinuousStates(_states: *const f64, _count: usize);
    fmi3GetContinuousStateDerivatives(_values: *mut f64, _count: usize);
    fmi3GetEventIndicators(_values: *mut f64, _count: usize);
    fmi3GetContinuousStates(_values: *mut f64, _count: usize);
    fmi3GetNominalsOfContinuousStates(_values: *mut f64, _count: usize);
    fmi3GetNumberOfEventIndicators(_count: *mut usize);
    fmi3GetNumberOfContinuousStates(_count: *mut usize);
    fmi3ActivateModelPartition(_clock: u32, _time: f64);
}

/// Says that a kind of unit is none of this file.
unsafe fn no_instance(
    name: *const c_char,
    environment: *mut c_void,
    log: Option<Logger3>,
    kind: &str,
) -> Handle {
    // SAFETY: as the module says.
    let name = unsafe { text(name, "instanceName") }.unwrap_or_default();
    let logger = Logger::three(log, environment, &name, false);
    registry::insert(logger, || {
        Err(format!("this unit is for co-simulation and not for {kind}"))
    });
    ptr::null_mut()
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateModelExchange(
    name: *const c_char,
    _token: *const c_char,
    _resources: *const c_char,
    _visible: Boolean,
    _logging: Boolean,
    environment: *mut c_void,
    log: Option<Logger3>,
) -> Handle {
    // SAFETY: as the module says.
    unsafe { no_instance(name, environment, log, "model exchange") }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateScheduledExecution(
    name: *const c_char,
    _token: *const c_char,
    _resources: *const c_char,
    _visible: Boolean,
    _logging: Boolean,
    environment: *mut c_void,
    log: Option<Logger3>,
    _update: *const c_void,
    _lock: *const c_void,
    _unlock: *const c_void,
) -> Handle {
    // SAFETY: as the module says.
    unsafe { no_instance(name, environment, log, "scheduled execution") }
}
