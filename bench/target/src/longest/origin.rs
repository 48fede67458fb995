//! Where code comes from: the functions that were inlined, by the debug information.

use std::path::Path;

use addr2line::gimli;
use object::read::elf::ElfFile32;
use object::{Endianness, Object, ObjectSection};

use epas_page::failure::Failure;

type Reader<'data> = gimli::EndianSlice<'data, gimli::LittleEndian>;

/// A function that was inlined, or the one that all was inlined into.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Frame {
    pub function: String,
    /// Where its code is called: line and column of the call in the frame around it; none of the outermost one.
    pub called: Option<(u32, u32)>,
}

pub struct Origins<'data> {
    context: addr2line::Context<Reader<'data>>,
}

impl<'data> Origins<'data> {
    pub fn new(
        file: &ElfFile32<'data, Endianness, &'data [u8]>,
        path: &Path,
    ) -> Result<Self, Failure> {
        let dwarf = gimli::Dwarf::load(|id| -> Result<_, gimli::Error> {
            let data = file
                .section_by_name(id.name())
                .and_then(|section| section.data().ok())
                .unwrap_or_default();
            Ok(gimli::EndianSlice::new(data, gimli::LittleEndian))
        });
        let context = dwarf.and_then(addr2line::Context::from_dwarf);
        let context = context.map_err(|error| Failure::file("read", path, &error))?;
        Ok(Self { context })
    }

    /// The functions in which an instruction stands, from the outermost one inwards.
    pub fn frames(&self, address: u32) -> Vec<Frame> {
        let mut met: Vec<(String, Option<(u32, u32)>)> = Vec::new();
        let Ok(mut found) = self
            .context
            .find_frames(u64::from(address))
            .skip_all_loads()
        else {
            return Vec::new();
        };
        while let Ok(Some(frame)) = found.next() {
            let name = frame.function.and_then(|function| {
                let name = function.raw_name().ok()?.into_owned();
                Some(format!("{:#}", rustc_demangle::demangle(&name)))
            });
            let line = frame
                .location
                .map(|place| (place.line.unwrap_or(0), place.column.unwrap_or(0)));
            met.push((name.unwrap_or_default(), line));
        }
        // The line of a frame is where the one within it is called.
        let names = met.into_iter().rev();
        let mut called = None;
        names
            .map(|(function, line)| Frame {
                function,
                called: std::mem::replace(&mut called, line),
            })
            .collect()
    }

    /// The functions that all these instructions have in common, from the outermost one inwards.
    pub fn common(&self, addresses: impl IntoIterator<Item = u32>) -> Vec<Frame> {
        let mut addresses = addresses.into_iter();
        let mut common = addresses
            .next()
            .map_or_else(Vec::new, |address| self.frames(address));
        for address in addresses {
            let frames = self.frames(address);
            let same = common.iter().zip(&frames).take_while(|(a, b)| a == b);
            let same = same.count();
            common.truncate(same);
        }
        common
    }
}
