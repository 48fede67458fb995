//! Worst case by construction: the longest path through a function with all that it calls, from the image alone.
//!
//! | step | file |
//! |---|---|
//! | instructions that can be reached, and what may follow each | `code`, `flow`, `steps` |
//! | blocks, edges and their cycles, by the model that counts use | `graph` |
//! | natural loops | `loops` |
//! | what bounds them: one table, by functions of the debug information | `bounds`, `origin` |
//! | limits on the counts of edges, for loops and over several of them | `limits`, `context`, `arguments` |
//! | the largest sum of cycles under these limits | `paths`, `worst` |
//!
//! No count over any inputs exceeds the result, as long as the table is right; a run holds every counted call to each of the
//! table's limits. The path need not be one that inputs can take: what one branch says of a later one is not known here.

mod arguments;
mod bounds;
mod code;
mod context;
mod flow;
mod graph;
mod limits;
mod loops;
mod origin;
mod paths;
mod steps;
#[cfg(test)]
mod tests;
mod worst;

use std::fs;
use std::path::Path;

use object::Endianness;
use object::read::elf::ElfFile32;

use super::watch::Watch;
use code::Code;
use context::Context;
use epas_page::failure::Failure;
use origin::Origins;
use worst::Worst;

pub struct Longest {
    /// Cycles from its first instruction to its return, or why they are not known.
    pub cycles: Result<u32, String>,
    pub watch: Watch,
}

/// The longest paths of the functions at these addresses of an image.
pub fn longest(path: &Path, addresses: &[u32]) -> Result<Vec<Longest>, Failure> {
    let bytes = fs::read(path).map_err(|error| Failure::file("read", path, &error))?;
    let file = ElfFile32::<Endianness>::parse(&*bytes)
        .map_err(|error| Failure::file("read", path, &error))?;
    let code = Code::of(&file)?;
    let origins = Origins::new(&file, path)?;
    let mut worst = Worst::new(&code, &origins);
    let found = addresses.iter().map(|&address| {
        let cycles = worst.cycles(address, Context::default());
        Longest {
            cycles: cycles.and_then(|cycles| {
                u32::try_from(cycles).map_err(|_| format!("{cycles} cycles are too many"))
            }),
            watch: worst.watch(address, Context::default()),
        }
    });
    Ok(found.collect())
}
