//! `epas-friction` from C: a static library without allocator, panic or global state.
//!
//! `types`, `requests`, `tables`, `status` and `version` are what the header shows; `adaptation` and `memory` show and translate
//! what follows the vehicle and the screw that remembers; `caged`, `closed_form`, `screw`, `linear` and `one_shot` translate between them and the crate; `boundary` is the one folder with pointers: every
//! exported function.
//!
//! # A further scene
//!
//! 1. `types.rs`: its configuration, outputs and the place for its state.
//! 2. A file like `caged.rs`: `impl InHeader`, which says what of it the header has, and `impl CScene`, which translates configuration, inputs
//!    and outputs.
//! 3. `boundary/scenes.rs`: its exported functions, each one line that calls the generic one.
//!
//! `cargo run -p epas-c-check -- --write` then writes the header.

#![no_std]

mod adaptation;
mod boundary;
mod caged;
mod closed_form;
mod design;
mod linear;
mod memory;
mod one_shot;
mod requests;
mod scene;
mod screw;
mod status;
mod tables;
mod types;
mod version;

pub use adaptation::*;
pub use boundary::*;
pub use memory::*;
pub use requests::*;
pub use status::*;
pub use tables::*;
pub use types::*;
pub use version::*;
