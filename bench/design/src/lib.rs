//! Solves a ball screw once, on a host, and folds what depends on its drawing alone into constants for the control interrupt.
//!
//! ```text
//! design, clearance, friction coefficient -> exact ball (epas-reference, float64) -> curves over the load -> block + certificate
//! ```
//!
//! [`CagedFold`] takes a [`CagedDesign`] and gives a [`Folded`] block: the constants of an
//! [`epas_friction::scene::CagedBallScrew`], and the error of every torque that it outputs, against the exact solver, on states that were not
//! fitted. The same inputs give the same bits.
//!
//! In a `build.rs`, where `gear()` is the design; the firmware then has `include!(concat!(env!("OUT_DIR"), "/gear.rs"));`:
//!
//! ```no_run
//! # use epas_design::{CagedDesign, CagedFold, Failure};
//! # fn gear() -> CagedDesign { unimplemented!() }
//! fn main() -> Result<(), Failure> {
//!     CagedFold::of(gear()).folded()?.write_rust("GEAR", &std::env::var("OUT_DIR").unwrap())
//! }
//! ```
//!
//! The folder `example` of this package is one that does so. Cargo compiles build scripts without optimisation unless
//! `[profile.dev.build-override] opt-level = 3` (and the same for `release`) says otherwise: the fold then takes a hundred times as long.
//!
//! | module | what |
//! |---|---|
//! | [`caged`] | from a design to the law of a ball over its load |
//! | [`curve`] | piecewise cubics of least largest error |
//! | [`certificate`] | errors of a folded block on states that were not fitted |
//! | [`output`] | a block as Rust, C, TOML and bytes |
//! | [`c99`] | a caged block as C99, with its step and its memory |
//! | [`drawing`] | a design of the crate as one of the reference |
//! | [`breakaway`] | initial stiffness and breakaway angle from a design: parts for the elements of a memory |
//! | [`efficiency`] | contact angle of least loss, design procedure, inertia of the balls |
//! | [`gears`] | the gear of the project's own firmware |
//! | [`manoeuvre`] | rack travel and rack force of parking, weave, kerb |
//! | [`files`] | design files and built-in designs |
//! | [`built_in`] | the built-in designs as blocks that come with the crate |
//! | [`folds`] | blocks that need no fold: those of the built-in designs, and those of this run |
//! | [`caged_scene`], [`uncaged_scene`] | a design as a scene that runs on this machine |

// A failure is a sentence, whose causes the sentence names.
#![allow(clippy::missing_errors_doc)]

pub mod breakaway;
pub mod built_in;
pub mod c99;
pub mod caged;
pub mod caged_scene;
pub mod certificate;
pub mod curve;
mod digest;
pub mod drawing;
pub mod efficiency;
mod failure;
pub mod files;
pub mod folds;
pub mod gears;
pub mod manoeuvre;
pub mod output;
pub mod uncaged;
pub mod uncaged_scene;

pub use caged::{CagedDesign, CagedFold, Folded};
pub use certificate::{Certificate, Figure};
pub use failure::Failure;
pub use uncaged::{FoldedUncaged, UncagedDesign, UncagedFold};
