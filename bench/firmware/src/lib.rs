#![no_std]
//! What the firmware runs: every function that belongs into a control loop, with inputs spread over its
//! domain, and the results that a host found for them.
//!
//! The host's program (`epas-target`) uses the same library: it writes the stored cases, and knows
//! by name what it counts. Its designs are within all ranges: no set-up of theirs fails.

#![allow(clippy::missing_errors_doc)]

pub mod cases;
pub mod check;
pub mod contexts;
pub mod control_loop;
pub mod counted;
pub mod devices;
pub mod friction_task;
#[rustfmt::skip]
#[allow(
    missing_docs,
    clippy::wildcard_imports,
    reason = "as the README prints it"
)]
pub mod from_page;
pub mod gears;
pub mod inputs;
pub mod numbers;
pub mod peers;
pub mod remembering;
pub mod scenes;
pub mod spread;
pub mod subjects;

// Cortex-M has no atomic operations of 64 bits, Cortex-R has.
#[cfg(all(target_arch = "arm", not(target_has_atomic = "64")))]
pub mod board;
#[cfg(all(target_arch = "arm", target_has_atomic = "64"))]
#[path = "board_cortex_r.rs"]
pub mod board;
#[cfg(target_arch = "arm")]
mod panic;
