//! The command-line program of `epas-friction` for users.

use std::process::ExitCode;

/// A calibration makes and drops lists of half a megabyte by the thousand: the system's allocator gives each back to the system, which
/// takes a sixth of the time.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    epas_cli::run()
}
