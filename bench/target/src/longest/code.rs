//! The code of an image: functions by address, and single instructions of them.

use std::collections::BTreeMap;

use capstone::Capstone;
use capstone::arch::arm::{ArchExtraMode, ArchMode};
use capstone::arch::{BuildsCapstone, BuildsCapstoneExtraMode};
use object::read::elf::ElfFile32;
use object::{Endianness, Object, ObjectSection, ObjectSymbol, SectionKind, SymbolKind};

use super::flow::Flow;
use crate::cycles::Instruction;
use epas_page::failure::Failure;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Function {
    pub name: String,
    pub start: u32,
    pub end: u32,
}

/// An instruction as it stands in memory.
#[derive(Clone, Debug)]
pub struct Decoded {
    pub cost: Instruction,
    pub flow: Flow,
    pub text: String,
}

/// Code in memory.
pub struct Code {
    sections: Vec<(u32, Vec<u8>)>,
    functions: BTreeMap<u32, Function>,
    disassembler: Capstone,
}

impl Code {
    /// From the bytes of sections, each with its address, and functions.
    pub fn new(
        sections: Vec<(u32, Vec<u8>)>,
        functions: impl IntoIterator<Item = Function>,
    ) -> Result<Self, Failure> {
        let disassembler = Capstone::new()
            .arm()
            .mode(ArchMode::Thumb)
            .extra_mode([ArchExtraMode::MClass].into_iter())
            .build()
            .map_err(|error| Failure::Data(format!("no disassembler: {error}")))?;
        let functions = functions.into_iter();
        Ok(Self {
            sections,
            functions: functions
                .map(|function| (function.start, function))
                .collect(),
            disassembler,
        })
    }

    pub fn of(file: &ElfFile32<'_, Endianness>) -> Result<Self, Failure> {
        let mut sections = Vec::new();
        for section in file.sections() {
            if section.kind() == SectionKind::Text {
                let bytes = section
                    .data()
                    .map_err(|error| Failure::Data(format!("a section of code: {error}")))?;
                sections.push((section.address() as u32, bytes.to_vec()));
            }
        }
        let mut sizes: BTreeMap<u32, (String, u32)> = BTreeMap::new();
        for symbol in file.symbols() {
            if symbol.kind() == SymbolKind::Text
                && symbol.is_definition()
                && let Ok(name) = symbol.name()
            {
                let name = format!("{:#}", rustc_demangle::demangle(name));
                let start = symbol.address() as u32 & !1;
                let entry = sizes.entry(start).or_insert((name, 0));
                entry.1 = entry.1.max(symbol.size() as u32);
            }
        }
        let next: Vec<u32> = sizes.keys().skip(1).copied().chain([u32::MAX]).collect();
        let functions = sizes.into_iter().zip(next);
        let functions = functions.map(|((start, (name, size)), next)| Function {
            name,
            start,
            // Assembly may leave out its size.
            end: if size == 0 { next } else { start + size },
        });
        Self::new(sections, functions)
    }

    /// The function that begins at an address.
    pub fn function(&self, start: u32) -> Result<&Function, Failure> {
        self.functions
            .get(&start)
            .ok_or_else(|| Failure::Data(format!("no function begins at {start:#x}")))
    }

    pub fn bytes(&self, address: u32) -> Option<&[u8]> {
        self.sections.iter().find_map(|(start, bytes)| {
            let offset = address.checked_sub(*start)?;
            bytes.get(offset as usize..).filter(|rest| !rest.is_empty())
        })
    }

    /// The instruction at an address, whatever stands before it.
    pub fn instruction(&self, address: u32) -> Result<Decoded, Failure> {
        let nothing = || Failure::Data(format!("no instruction at {address:#x}"));
        let bytes = self.bytes(address).ok_or_else(nothing)?;
        let bytes = bytes.get(..4).unwrap_or(bytes);
        let found = self
            .disassembler
            .disasm_count(bytes, u64::from(address), 1)
            .map_err(|_| nothing())?;
        let instruction = found.iter().next().ok_or_else(nothing)?;
        let mnemonic = instruction.mnemonic().ok_or_else(nothing)?;
        let operands = instruction.op_str().unwrap_or_default();
        let size = instruction.bytes().len() as u32;
        Ok(Decoded {
            cost: Instruction::new(size, mnemonic, operands),
            flow: Flow::of(mnemonic, operands),
            text: format!("{mnemonic} {operands}"),
        })
    }
}
