//! FMI 2.0: what the standard wants exported and this unit does not have. Each refuses with a text.

use std::ffi::c_char;

use super::fmi2::{Boolean, Component, Status, on};

fn absent(component: Component, name: &str) -> Status {
    on(component, |_, _| {
        Err(format!("{name} is called, which this unit does not have"))
    })
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetDirectionalDerivative(
    component: Component,
    _unknowns: *const u32,
    _unknown_count: usize,
    _knowns: *const u32,
    _known_count: usize,
    _seed: *const f64,
    _sensitivity: *mut f64,
) -> Status {
    absent(component, "fmi2GetDirectionalDerivative")
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi2SetRealInputDerivatives(
    component: Component,
    _references: *const u32,
    _count: usize,
    _orders: *const i32,
    _values: *const f64,
) -> Status {
    absent(component, "fmi2SetRealInputDerivatives")
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetRealOutputDerivatives(
    component: Component,
    _references: *const u32,
    _count: usize,
    _orders: *const i32,
    _values: *mut f64,
) -> Status {
    absent(component, "fmi2GetRealOutputDerivatives")
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi2CancelStep(component: Component) -> Status {
    absent(component, "fmi2CancelStep")
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetStatus(component: Component, _kind: i32, _value: *mut Status) -> Status {
    absent(component, "fmi2GetStatus")
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetIntegerStatus(
    component: Component,
    _kind: i32,
    _value: *mut i32,
) -> Status {
    absent(component, "fmi2GetIntegerStatus")
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetBooleanStatus(
    component: Component,
    _kind: i32,
    _value: *mut Boolean,
) -> Status {
    absent(component, "fmi2GetBooleanStatus")
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetStringStatus(
    component: Component,
    _kind: i32,
    _value: *mut *const c_char,
) -> Status {
    absent(component, "fmi2GetStringStatus")
}
