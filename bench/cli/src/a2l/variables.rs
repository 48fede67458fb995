//! Variables of an image by its debug information: addresses and types of the fields of structures.

use std::fmt::Display;

use addr2line::gimli::{
    self, AttributeValue, DebuggingInformationEntry, Dwarf, EndianSlice, LittleEndian, Operation,
    UnitOffset,
};
use object::read::elf::ElfFile32;
use object::{Endianness, Object, ObjectSection};

use epas_page::failure::Failure;

type Bytes<'a> = EndianSlice<'a, LittleEndian>;
type Unit<'a> = gimli::Unit<Bytes<'a>>;
type Entry<'a> = DebuggingInformationEntry<Bytes<'a>>;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Number {
    Float32,
    Unsigned32,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Its path from the variable on, without what only wraps it: `numbers.friction_boundary`.
    pub path: String,
    /// Its whole path, with the variable's name: what a debugger calls it.
    pub symbol: String,
    pub address: u32,
    pub number: Number,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Variable {
    pub address: u32,
    pub size: u32,
    pub fields: Vec<Field>,
}

/// The debug information of an image, with what stands in its flash.
pub struct Variables<'a> {
    file: ElfFile32<'a, Endianness>,
    dwarf: Dwarf<Bytes<'a>>,
    units: Vec<Unit<'a>>,
}

/// A type: with the linker's optimisation it often stands in another unit than what has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Kind {
    unit: usize,
    offset: UnitOffset,
}

fn broken(error: &dyn Display) -> Failure {
    Failure::Data(format!("the debug information is broken: {error}"))
}

impl<'a> Variables<'a> {
    /// Reads an image of a little-endian processor of 32 bits.
    pub fn read(image: &'a [u8]) -> Result<Self, Failure> {
        let file = ElfFile32::<Endianness>::parse(image)
            .map_err(|error| Failure::Data(format!("no ELF image of 32 bits: {error}")))?;
        if !file.is_little_endian() {
            return Err(Failure::Data("the image is big-endian".into()));
        }
        let dwarf = Dwarf::load(|id| -> Result<_, gimli::Error> {
            let data = file
                .section_by_name(id.name())
                .and_then(|section| section.data().ok())
                .unwrap_or_default();
            Ok(EndianSlice::new(data, LittleEndian))
        })
        .map_err(|error| broken(&error))?;
        let mut units = Vec::new();
        let mut headers = dwarf.units();
        while let Some(header) = headers.next().map_err(|error| broken(&error))? {
            units.push(dwarf.unit(header).map_err(|error| broken(&error))?);
        }
        Ok(Self { file, dwarf, units })
    }

    /// A word of the image as it is flashed.
    pub fn flashed(&self, address: u32) -> Option<u32> {
        self.file.sections().find_map(|section| {
            let word = section
                .data_range(u64::from(address), 4)
                .ok()
                .flatten()?
                .try_into()
                .ok()?;
            Some(u32::from_le_bytes(word))
        })
    }

    pub fn find(&self, name: &str) -> Result<Variable, Failure> {
        let found = self.search(name).map_err(|error| broken(&error))?;
        found.ok_or_else(|| {
            Failure::Data(format!(
                "no variable {name} in the debug information: an image of the friction task, built with debug = 2?"
            ))
        })
    }

    fn search(&self, name: &str) -> Result<Option<Variable>, gimli::Error> {
        for (index, unit) in self.units.iter().enumerate() {
            let mut entries = unit.entries();
            while let Some(entry) = entries.next_dfs()? {
                if entry.tag() == gimli::DW_TAG_variable
                    && self.name(unit, entry)?.as_deref() == Some(name)
                    && let Some(address) = address(unit, entry)?
                    && let Some(kind) = self.kind(index, entry)
                {
                    let mut fields = Vec::new();
                    let place = Place {
                        path: "",
                        symbol: name,
                        address,
                    };
                    let size = self.walk(kind, &place, &mut fields)?;
                    return Ok(Some(Variable {
                        address,
                        size,
                        fields,
                    }));
                }
            }
        }
        Ok(None)
    }

    fn kind(&self, unit: usize, entry: &Entry<'a>) -> Option<Kind> {
        match entry.attr_value(gimli::DW_AT_type)? {
            AttributeValue::UnitRef(offset) => Some(Kind { unit, offset }),
            AttributeValue::DebugInfoRef(offset) => {
                self.units.iter().enumerate().find_map(|(unit, other)| {
                    let offset = offset.to_unit_offset(&other.header)?;
                    Some(Kind { unit, offset })
                })
            }
            _ => None,
        }
    }

    fn name(&self, unit: &Unit<'a>, entry: &Entry<'a>) -> Result<Option<String>, gimli::Error> {
        let Some(value) = entry.attr_value(gimli::DW_AT_name) else {
            return Ok(None);
        };
        let name = self.dwarf.attr_string(unit, value)?;
        Ok(Some(name.to_string_lossy().into_owned()))
    }

    fn walk(
        &self,
        kind: Kind,
        place: &Place<'_>,
        fields: &mut Vec<Field>,
    ) -> Result<u32, gimli::Error> {
        let unit = self
            .units
            .get(kind.unit)
            .ok_or(gimli::Error::NoEntryAtGivenOffset(0))?;
        let mut tree = unit.entries_tree(Some(kind.offset))?;
        let root = tree.root()?;
        let entry = root.entry();
        let size = entry
            .attr_value(gimli::DW_AT_byte_size)
            .and_then(|size| size.udata_value())
            .and_then(|size| u32::try_from(size).ok())
            .unwrap_or(0);
        if entry.tag() == gimli::DW_TAG_base_type {
            if let Some(number) = number(entry, size) {
                fields.push(Field {
                    path: place.path.to_owned(),
                    symbol: place.symbol.to_owned(),
                    address: place.address,
                    number,
                });
            }
            return Ok(size);
        }
        let mut members = Vec::new();
        // Debug information of a type that has itself is broken; what is missing then is named by whoever looks for it.
        if place.symbol.split('.').count() > DEEPEST {
            return Ok(size);
        }
        let mut children = root.children();
        while let Some(child) = children.next()? {
            let entry = child.entry();
            if entry.tag() == gimli::DW_TAG_member
                && let Some(kind) = self.kind(kind.unit, entry)
                && let Some(name) = self.name(unit, entry)?
                && let Some(offset) = entry
                    .attr_value(gimli::DW_AT_data_member_location)
                    .and_then(|offset| offset.udata_value())
                    .and_then(|offset| u32::try_from(offset).ok())
            {
                members.push((offset, name, kind));
            }
        }
        // The compiler lists them in an order of its own.
        members.sort();
        // A structure of one field around another type only wraps it, as a cell does.
        let wraps = members.len() == 1;
        for (offset, name, kind) in members {
            let path = match place.path {
                path if wraps => path.to_owned(),
                "" => name.clone(),
                path => format!("{path}.{name}"),
            };
            let place = Place {
                path: &path,
                symbol: &format!("{}.{name}", place.symbol),
                address: place.address.wrapping_add(offset),
            };
            self.walk(kind, &place, fields)?;
        }
        Ok(size)
    }
}

const DEEPEST: usize = 16;

struct Place<'a> {
    path: &'a str,
    symbol: &'a str,
    address: u32,
}

/// The address of a variable that stands at one address: on its own, or so many bytes behind others with which the compiler has merged it.
fn address<'a>(unit: &Unit<'a>, entry: &Entry<'a>) -> Result<Option<u32>, gimli::Error> {
    let Some(AttributeValue::Exprloc(expression)) = entry.attr_value(gimli::DW_AT_location) else {
        return Ok(None);
    };
    let mut operations = expression.operations(unit.encoding());
    let Some(Operation::Address { mut address }) = operations.next()? else {
        return Ok(None);
    };
    while let Some(operation) = operations.next()? {
        let Operation::PlusConstant { value } = operation else {
            return Ok(None);
        };
        address = address.wrapping_add(value);
    }
    Ok(u32::try_from(address).ok())
}

fn number(entry: &Entry<'_>, size: u32) -> Option<Number> {
    let Some(AttributeValue::Encoding(encoding)) = entry.attr_value(gimli::DW_AT_encoding) else {
        return None;
    };
    match (encoding, size) {
        (gimli::DW_ATE_float, 4) => Some(Number::Float32),
        (gimli::DW_ATE_unsigned, 4) => Some(Number::Unsigned32),
        _ => None,
    }
}
