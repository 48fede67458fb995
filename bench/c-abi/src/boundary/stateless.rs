//! The exported functions that need no object: version, names, clearance, efficiency, curvature.

use core::ffi::c_char;

use super::pointers::{bare, report, usable};
use crate::one_shot;
use crate::requests::{
    Clearance, ClearanceRequest, Curvature, CurvatureRequest, Efficiency, EfficiencyRequest,
};
use crate::status::{Failure, field_name, status_name};
use crate::version::EPAS_ABI_VERSION;

/// Version of the library: the header's where it equals `EPAS_ABI_VERSION`.
#[unsafe(no_mangle)]
pub extern "C" fn epas_abi_version() -> u32 {
    EPAS_ABI_VERSION
}

/// Name of a field as it is written in C, for a diagnostic message; empty for no field. Never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn epas_field_name(field: u32) -> *const c_char {
    field_name(field).as_ptr()
}

/// Name of a status, for a diagnostic message. Never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn epas_status_name(status: u32) -> *const c_char {
    status_name(status).as_ptr()
}

/// How balls fit between the grooves, from a gap, a preload or an axial play. It checks the whole design at each
/// call; no state: safe from any context. `failure` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_clearance(
    request: *const ClearanceRequest,
    answer: *mut Clearance,
    failure: *mut Failure,
) -> u32 {
    unsafe { one_shot(request, answer, failure, one_shot::clearance) }
}

/// Efficiency of a ball screw in closed form. No state: safe from any context. `failure` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_efficiency(
    request: *const EfficiencyRequest,
    answer: *mut Efficiency,
    failure: *mut Failure,
) -> u32 {
    unsafe { one_shot(request, answer, failure, one_shot::efficiency) }
}

/// Principal curvatures of a groove. It checks the whole design at each call; no state: safe from any
/// context. `failure` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn epas_curvature(
    request: *const CurvatureRequest,
    answer: *mut Curvature,
    failure: *mut Failure,
) -> u32 {
    unsafe { one_shot(request, answer, failure, one_shot::curvature) }
}

/// Answers a request where both pointers are usable.
unsafe fn one_shot<Request, Answer>(
    request: *const Request,
    answer: *mut Answer,
    failure: *mut Failure,
    function: fn(&Request) -> Result<Answer, Failure>,
) -> u32 {
    let outcome = usable(answer).map_err(bare).and_then(|()| {
        usable(request).map_err(bare)?;
        let found = function(unsafe { &*request })?;
        unsafe { answer.write(found) };
        Ok(())
    });
    unsafe { report(outcome, failure) }
}
