//! Every exported function, and the only module with pointers.
//!
//! A pointer is checked for NULL and alignment; an object that the library has to have initialised carries
//! a mark that is checked. What cannot be checked is the caller's: that a pointer points to an object of its
//! type, that nobody else uses the object during the call, and that tables (deviations, load shares, folded balls) stay where and as
//! they are for as long as a model that was given them: a model holds `'static` references to them. The place of a model may be moved
//! or copied, for nothing points into it.

#![allow(unsafe_code)]
// What the caller owes stands in the module's documentation, for all functions alike.
#![allow(clippy::missing_safety_doc)]

mod adaptation;
mod memory;
mod models;
mod pointers;
mod scenes;
mod stateless;
mod tables;

pub use adaptation::*;
pub use memory::*;
pub use scenes::*;
pub use stateless::*;
pub use tables::*;

/// A panic has nowhere to go. The function that it calls exists nowhere, so that whatever links this library
/// has proved that no panic can be reached.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    unsafe extern "C" {
        fn epas_friction_has_a_panic_path() -> !;
    }
    unsafe { epas_friction_has_a_panic_path() }
}
