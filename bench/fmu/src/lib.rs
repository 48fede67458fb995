//! The shared library of a co-simulation unit, for FMI 2.0 and 3.0.
//!
//! `instance` is a unit while a simulation has it: its phase, its values, its model. `registry` keeps instances by handles that are
//! numbers and no addresses, so that a handle that was freed, or never given, is told from one that lives. `boundary` is the one folder
//! with pointers: every exported function. What a unit computes stands in `epas_cli::fmu`, and is what `simulate` computes.

mod boundary;
mod flags;
mod instance;
mod kinds;
mod outcome;
mod registry;
mod state;

/// Tells the program that packs this library which one it is.
#[used]
static MARK: [u8; epas_cli::fmu::MARK.len()] = *epas_cli::fmu::MARK;
