//! Measurement files of ASAM MDF 4 (`.mf4`): their channels in SI units on one raster, and files that hold what a table would.
//!
//! The structures of the blocks, the numbers of a record and the conversions are those of the crate `mdf4-rs`. It slices a file
//! without looking at its size, takes counts as they stand, drops a record that goes over the end of a data block, and knows no
//! data group of several channel groups; so it is given blocks that were measured before, and the way through the data is ours.

pub(crate) mod blocks;
pub(crate) mod chain;
pub(crate) mod choice;
pub(crate) mod file;
pub mod mapping;
pub(crate) mod raster;
pub(crate) mod records;
pub(crate) mod samples;
pub(crate) mod table;
#[cfg(test)]
mod tests;
pub mod write;

pub use mapping::Mapping;
pub use table::{Request, Wanted, read};

use std::path::Path;

/// Whether a path names a measurement file by its ending.
pub fn named(path: &Path) -> bool {
    path.extension()
        .is_some_and(|ending| ending.eq_ignore_ascii_case("mf4"))
}

/// Whether bytes start as a measurement file does, of whatever version.
pub fn starts(bytes: &[u8]) -> bool {
    bytes.starts_with(b"MDF     ") || bytes.starts_with(b"UnFinMF ")
}
