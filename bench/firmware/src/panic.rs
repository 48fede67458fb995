//! A panic that does not link.

#![allow(unsafe_code)]

use core::panic::PanicInfo;

/// Calls a function that is not defined: the program links only where no path leads to a panic.
#[cfg(not(feature = "halt"))]
#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    unsafe extern "C" {
        safe fn a_panic_path_is_left() -> !;
    }
    a_panic_path_is_left()
}

/// Ends the program as failed.
#[cfg(feature = "halt")]
#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    crate::board::finish(false)
}
