//! What the engine calls in a plugin for the expression `design_figures`: version 0.1 of its interface, columns and their fields as
//! Arrow's C structures. A plugin takes what it is given, and what it returns is freed through a function that comes with it.

#![allow(unsafe_code)]

use std::cell::RefCell;
use std::ffi::{CString, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::slice;

use polars_arrow::ffi::{ArrowSchema, export_field_to_c};
use polars_core::error::{PolarsResult, to_compute_err};
use polars_core::prelude::{CompatLevel, Series};
use polars_ffi::version_0::{CallerContext, SeriesExport, export_series, import_series_buffer};
use serde_pickle::DeOptions;

thread_local! {
    /// Why this thread's last call has returned nothing.
    static LAST_ERROR: RefCell<CString> = RefCell::default();
}

/// What the engine takes for a panic.
const PANIC: &str = "PANIC";

/// What a call has found; keeps why there is nothing. A panic does not pass into the engine.
fn found<T>(call: impl FnOnce() -> PolarsResult<T>) -> Option<T> {
    let why = match catch_unwind(AssertUnwindSafe(call)) {
        Ok(Ok(found)) => return Some(found),
        Ok(Err(error)) => error.to_string().replace('\0', " "),
        Err(_) => PANIC.to_owned(),
    };
    LAST_ERROR.set(CString::new(why).unwrap_or_default());
    None
}

/// The interface's version: the larger number in the upper half.
#[unsafe(no_mangle)]
pub extern "C" fn _polars_plugin_get_version() -> u32 {
    let (major, minor) = polars_ffi::get_version();
    u32::from(major) << 16 | u32::from(minor)
}

/// Why this thread's last call has returned nothing; until its next call.
#[unsafe(no_mangle)]
pub extern "C" fn _polars_plugin_get_last_error_message() -> *const c_char {
    LAST_ERROR.with_borrow(|error| error.as_ptr())
}

/// The field of the answer; those of the inputs do not matter.
///
/// # Safety
/// `answer` is an empty structure of the engine's.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn _polars_plugin_field_design_figures(
    _fields: *const ArrowSchema,
    _count: usize,
    answer: *mut ArrowSchema,
    _settings: *const u8,
    _length: usize,
) {
    let field = found(|| {
        let field = crate::output().to_arrow(CompatLevel::newest());
        Ok(export_field_to_c(&field))
    });
    if let Some(field) = field {
        // SAFETY: the caller's promise; it is empty, so that nothing is lost.
        unsafe { answer.write(field) };
    }
}

/// The answer to columns, with settings as Python pickles them.
///
/// # Safety
/// There are `count` columns, which the engine gives away, and `length` bytes of settings; `answer` is an empty structure of the
/// engine's.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn _polars_plugin_design_figures(
    columns: *mut SeriesExport,
    count: usize,
    settings: *const u8,
    length: usize,
    answer: *mut SeriesExport,
    _context: *const CallerContext,
) {
    let series = found(|| {
        // SAFETY: the caller's promise.
        let (columns, settings) = unsafe {
            (
                import_series_buffer(columns, count)?,
                slice::from_raw_parts(settings, length),
            )
        };
        called(&columns, settings).map(|series| export_series(&series))
    });
    if let Some(series) = series {
        // SAFETY: the caller's promise; it is empty, so that nothing is lost.
        unsafe { answer.write(series) };
    }
}

fn called(columns: &[Series], settings: &[u8]) -> PolarsResult<Series> {
    let settings =
        serde_pickle::from_slice(settings, DeOptions::default()).map_err(to_compute_err)?;
    crate::design_figures(columns, &settings)
}
