//! The crate and its models against the float64 reference, the papers' tables and laws: one program, a module for each room.
//!
//! `cargo test -p epas-reference --test all scenes::caged` runs one part. A test whose name ends in `_whole` is the whole sweep of a test that by
//! default runs a sample; all of them run with `cargo test -p epas-reference --test all -- --ignored _whole`.

mod objects;
mod recorded;
mod refusals;

mod adaptation;
mod balls;
mod determinism;
mod formulas;
mod law;
mod reference;
mod remembering;
mod scenes;
mod stiffness;
mod stored_folds;
