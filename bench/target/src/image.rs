//! What stands in an image: its size, its functions, who calls whom.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use addr2line::gimli;
use object::read::elf::ElfFile32;
use object::{
    Endianness, Object, ObjectSection, ObjectSymbol, RelocationTarget, SectionFlags, SectionKind,
    SymbolKind, elf,
};

use epas_page::failure::Failure;

/// Where the memory begins that is not flash.
const RAM: u64 = 0x2000_0000;

#[derive(Debug, Default)]
pub struct Image {
    /// Bytes of flash: vectors, code, constants, and what variables begin with.
    pub flash: u64,
    /// Bytes of memory that variables take; the stack not counted.
    pub ram: u64,
    /// Functions by address, without the bit that says Thumb.
    functions: BTreeMap<u64, Function>,
}

#[derive(Debug, Default)]
struct Function {
    names: Vec<String>,
    size: u64,
    calls: BTreeSet<u64>,
}

impl Image {
    pub fn read(path: &Path) -> Result<Self, Failure> {
        let bytes = fs::read(path).map_err(|error| Failure::file("read", path, &error))?;
        let file = ElfFile32::<Endianness>::parse(&*bytes)
            .map_err(|error| Failure::file("read", path, &error))?;
        let mut image = Self::default();
        for section in file.sections() {
            let SectionFlags::Elf { sh_flags, .. } = section.flags() else {
                continue;
            };
            if !sh_flags.contains(elf::SHF_ALLOC) {
                continue;
            }
            let empty = matches!(
                section.kind(),
                SectionKind::UninitializedData | SectionKind::UninitializedTls
            );
            if !empty {
                image.flash += section.size();
            }
            if section.address() >= RAM {
                image.ram += section.size();
            }
        }
        for symbol in file.symbols() {
            if symbol.kind() == SymbolKind::Text
                && symbol.is_definition()
                && let Ok(name) = symbol.name()
            {
                let function = image.functions.entry(symbol.address() & !1).or_default();
                function.names.push(name.to_owned());
                function.size = function.size.max(symbol.size());
            }
        }
        // With the relocations that the linker kept, every call and every address taken is known.
        let code = file
            .sections()
            .filter(|section| section.kind() == SectionKind::Text);
        for section in code {
            for (offset, relocation) in section.relocations() {
                let RelocationTarget::Symbol(index) = relocation.target() else {
                    continue;
                };
                let Ok(symbol) = file.symbol_by_index(index) else {
                    continue;
                };
                let target = symbol.address() & !1;
                if image.functions.contains_key(&target)
                    && let Some((_, function)) = image.functions.range_mut(..=offset).next_back()
                {
                    function.calls.insert(target);
                }
            }
        }
        Ok(image)
    }

    pub fn address(&self, name: &str) -> Option<u32> {
        self.functions
            .iter()
            .find(|(_, function)| function.names.iter().any(|own| own == name))
            .and_then(|(&address, _)| u32::try_from(address).ok())
    }

    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.functions
            .values()
            .flat_map(|function| &function.names)
            .map(String::as_str)
    }
}

/// Parts of names that no image may hold.
const UNWANTED: [&str; 6] = [
    "__rust_alloc",
    "__rustc_alloc",
    "alloc::",
    "core::fmt",
    "core::panicking",
    "a_panic_path_is_left",
];

impl Image {
    /// Functions of an allocator, of formatting or of panics.
    pub fn unwanted(&self) -> Vec<String> {
        self.names()
            .map(|name| format!("{:#}", rustc_demangle::demangle(name)))
            .filter(|name| UNWANTED.iter().any(|part| name.contains(part)))
            .collect()
    }

    /// Functions that can call themselves, directly or through others.
    pub fn recursive(&self) -> Vec<String> {
        // Addresses are taken off the graph for as long as one is left that calls nothing that is in it.
        let mut left: BTreeMap<u64, BTreeSet<u64>> = self
            .functions
            .iter()
            .map(|(&address, function)| (address, function.calls.clone()))
            .collect();
        loop {
            let leaves: Vec<u64> = left
                .iter()
                .filter(|(_, calls)| calls.iter().all(|call| !left.contains_key(call)))
                .map(|(&address, _)| address)
                .collect();
            if leaves.is_empty() {
                break;
            }
            for leaf in leaves {
                left.remove(&leaf);
            }
        }
        left.keys()
            .filter(|&&start| reaches_itself(&left, start))
            .filter_map(|address| self.functions.get(address)?.names.first())
            .map(|name| format!("{:#}", rustc_demangle::demangle(name)))
            .collect()
    }
}

fn reaches_itself(graph: &BTreeMap<u64, BTreeSet<u64>>, start: u64) -> bool {
    let mut seen = BTreeSet::new();
    let mut open = vec![start];
    while let Some(address) = open.pop() {
        for &call in graph.get(&address).into_iter().flatten() {
            if call == start {
                return true;
            }
            if seen.insert(call) {
                open.push(call);
            }
        }
    }
    false
}

/// Every function that has code in an image, inlined ones included, by its debug information.
pub fn code(path: &Path) -> Result<BTreeSet<String>, Failure> {
    let failure = |error: &dyn std::fmt::Display| Failure::file("read", path, &error);
    let bytes = fs::read(path).map_err(|error| failure(&error))?;
    let file = ElfFile32::<Endianness>::parse(&*bytes).map_err(|error| failure(&error))?;
    let dwarf = gimli::Dwarf::load(|id| -> Result<_, gimli::Error> {
        let data = file
            .section_by_name(id.name())
            .and_then(|section| section.data().ok())
            .unwrap_or_default();
        Ok(gimli::EndianSlice::new(data, gimli::LittleEndian))
    })
    .map_err(|error| failure(&error))?;
    let context = addr2line::Context::from_dwarf(dwarf).map_err(|error| failure(&error))?;
    let mut names = BTreeSet::new();
    for section in file.sections() {
        if section.kind() != SectionKind::Text {
            continue;
        }
        // Instructions are at least two bytes long.
        for address in (section.address()..section.address() + section.size()).step_by(2) {
            let mut frames = context
                .find_frames(address)
                .skip_all_loads()
                .map_err(|error| failure(&error))?;
            while let Some(frame) = frames.next().map_err(|error| failure(&error))? {
                if let Some(function) = frame.function
                    && let Ok(name) = function.raw_name()
                {
                    names.insert(format!("{:#}", rustc_demangle::demangle(&name)));
                }
            }
        }
    }
    Ok(names)
}
