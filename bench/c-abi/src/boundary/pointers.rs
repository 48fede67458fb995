//! What is checked of every pointer, and how a function says what was wrong.

use crate::status::{EPAS_FIELD_NONE, EPAS_MISALIGNED, EPAS_NULL_POINTER, Failure};

/// A pointer's status.
pub(super) fn usable<T>(pointer: *const T) -> Result<(), u32> {
    if pointer.is_null() {
        Err(EPAS_NULL_POINTER)
    } else if pointer.is_aligned() {
        Ok(())
    } else {
        Err(EPAS_MISALIGNED)
    }
}

/// What a pointer points to.
pub(super) unsafe fn read<T: Copy>(pointer: *const T) -> Result<T, u32> {
    usable(pointer)?;
    Ok(unsafe { pointer.read() })
}

/// A status that concerns no field.
pub(super) const fn bare(status: u32) -> Failure {
    Failure::pointer(status, EPAS_FIELD_NONE)
}

/// Ends a function that says what was wrong, to the caller and in `failure`, if there is one.
pub(super) unsafe fn report(outcome: Result<(), Failure>, failure: *mut Failure) -> u32 {
    let found = match outcome {
        Ok(()) => Failure::NONE,
        Err(found) => found,
    };
    if usable(failure).is_ok() {
        unsafe { failure.write(found) };
    }
    found.status
}
