//! `determinism` of the program `all` alone: it compiles in seconds, which `cargo mutants` does for every fault.

#[path = "all/determinism.rs"]
mod determinism;
#[path = "all/remembering.rs"]
mod remembering;
