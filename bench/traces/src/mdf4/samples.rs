//! The values of a channel, and which of them are invalid.

use mdf4_rs::DecodedValue;
use mdf4_rs::blocks::{BlockParse, ChannelBlock, ConversionBlock, ConversionType, DataType};
use mdf4_rs::parsing::decoder::{check_value_validity, decode_channel_value};

use super::blocks::{one, text};
use super::file::{Channel, File, Group};
use super::records;

/// Flags of a channel: all of its samples are invalid, or a bit of the record says which.
const ALL_INVALID: u32 = 1;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Samples {
    /// Values, in the unit of the file.
    pub values: Vec<f64>,
    /// Whether each is valid; empty where all are.
    pub valid: Vec<bool>,
}

impl Samples {
    pub fn invalid(&self) -> usize {
        self.valid.iter().filter(|valid| !**valid).count()
    }

    fn add(&mut self, value: f64, valid: bool) {
        if !valid && self.valid.is_empty() {
            self.valid.resize(self.values.len(), true);
        }
        if !valid || !self.valid.is_empty() {
            self.valid.push(valid);
        }
        self.values.push(value);
    }
}

/// What makes a value of a record's bytes.
struct Reader {
    block: ChannelBlock,
    /// Whether the value is the number of the record.
    counted: bool,
    samples: Samples,
}

/// Reads channels of one group, in the order of their numbers.
pub fn read(file: &File, group: &Group, channels: &[&Channel]) -> Result<Vec<Samples>, String> {
    let mut readers = channels
        .iter()
        .map(|channel| reader(file, group, channel).map_err(|message| of(channel, &message)))
        .collect::<Result<Vec<_>, _>>()?;
    let data = file
        .data
        .get(group.data)
        .ok_or("the file is damaged: a group without data")?;
    let id_size = data.id_size;
    let mut record_number = 0u64;
    let mut fault = None;
    records::visit(&file.bytes, data, group, &mut |record| {
        for reader in &mut readers {
            match reader.value(record, id_size, record_number) {
                Some(value) => {
                    let valid =
                        check_value_validity(record, id_size, group.data_bytes, &reader.block);
                    reader.samples.add(value, valid);
                }
                None => fault = Some(record_number),
            }
        }
        record_number += 1;
    })?;
    match fault {
        Some(record) => Err(format!(
            "sample {record} of group {:?} cannot be read",
            group.name
        )),
        None => Ok(readers.into_iter().map(|reader| reader.samples).collect()),
    }
}

fn of(channel: &Channel, message: &str) -> String {
    format!("channel {}: {message}", crate::units::cut(&channel.name))
}

impl Reader {
    fn value(&self, record: &[u8], id_size: usize, number: u64) -> Option<f64> {
        let raw = if self.counted {
            DecodedValue::UnsignedInteger(number)
        } else {
            decode_channel_value(record, id_size, &self.block)?
        };
        let value = match &self.block.conversion {
            // What a conversion refers to was refused before: it needs none of the file.
            Some(conversion) => conversion.apply_decoded(raw, &[]).ok()?,
            None => raw,
        };
        match value {
            DecodedValue::UnsignedInteger(value) => Some(value as f64),
            DecodedValue::SignedInteger(value) => Some(value as f64),
            DecodedValue::Float(value) => Some(value),
            _ => None,
        }
    }
}

/// Checks once what would go wrong with every record.
fn reader(file: &File, group: &Group, channel: &Channel) -> Result<Reader, String> {
    let mut block = channel.block.clone();
    let counted = match block.channel_type {
        0 | 2 => false,
        3 | 6 => true,
        1 => return Err("it holds texts or bytes, no numbers".into()),
        _ => {
            return Err(
                "it holds no plain numbers (synchronisation, or of changing length)".into(),
            );
        }
    };
    if block.component_addr != 0 {
        return Err("it is an array or a structure; name one of its elements".into());
    }
    if block.flags & ALL_INVALID != 0 {
        return Err("all of its samples are marked invalid".into());
    }
    if !counted {
        layout(&block, group)?;
    }
    block.conversion = conversion(&file.bytes, block.conversion_addr)?;
    Ok(Reader {
        block,
        counted,
        samples: Samples::default(),
    })
}

/// Whether the bits of a value lie in a record, in a form that is read.
fn layout(block: &ChannelBlock, group: &Group) -> Result<(), String> {
    let (offset, bits) = (u32::from(block.bit_offset), block.bit_count);
    match block.data_type {
        DataType::UnsignedIntegerLE
        | DataType::UnsignedIntegerBE
        | DataType::SignedIntegerLE
        | DataType::SignedIntegerBE => {
            // The crate gathers a value's bytes in 64 bits.
            if bits == 0 || offset > 7 || offset + bits > 64 {
                return Err(format!(
                    "an integer of {bits} bits from bit {offset} on is not read: at most 64 together"
                ));
            }
        }
        DataType::FloatLE | DataType::FloatBE => {
            if !matches!(bits, 32 | 64) || offset != 0 {
                return Err(format!(
                    "a float of {bits} bits from bit {offset} on is not read: it has 32 or 64, from bit 0 on"
                ));
            }
        }
        _ => return Err("it holds texts or bytes, no numbers".into()),
    }
    let end = u64::from(block.byte_offset) + u64::from((offset + bits).div_ceil(8));
    if end > u64::from(group.data_bytes) {
        return Err(format!(
            "the file is damaged: the value ends at byte {end} of a record of {}",
            group.data_bytes
        ));
    }
    Ok(())
}

/// The conversion to physical values: a formula of numbers alone.
fn conversion(file: &[u8], address: u64) -> Result<Option<ConversionBlock>, String> {
    if address == 0 {
        return Ok(None);
    }
    let block = one(file, address, "##CC")?;
    // The crate looks at four links and eight bytes behind the links without asking.
    let links = super::blocks::links(block).count().max(4);
    if block.len() < super::blocks::HEADER + 8 * links + 8 {
        return Err(format!(
            "the file is damaged: a conversion at byte {address} is cut off"
        ));
    }
    let found = ConversionBlock::from_bytes(block).map_err(|error| error.to_string())?;
    let values = found.values.len();
    let enough = match found.conversion_type {
        ConversionType::Identity => return Ok(None),
        ConversionType::Linear => values >= 2,
        // With a denominator that changes the crate leaves some values as they are.
        ConversionType::Rational => matches!(found.values[..], [_, _, _, d, e, f, ..] if d == 0.0 && e == 0.0 && f.abs() > 1e-9),
        ConversionType::TableLookupInterp | ConversionType::TableLookupNoInterp => {
            values >= 2 && values.is_multiple_of(2)
        }
        ConversionType::RangeLookup => values >= 4 && values % 3 == 1,
        ConversionType::Algebraic => return Err("its values follow from a formula in text, which is not read; convert it to a linear one".into()),
        _ => return Err("its values stand for texts".into()),
    };
    if !enough || found.values.iter().any(|value| !value.is_finite()) {
        return Err("its conversion to physical values has no meaning that is read".into());
    }
    Ok(Some(found))
}

/// Unit of a channel: its own, else that of its conversion; empty where there is none.
pub fn unit(file: &File, channel: &Channel) -> Result<String, String> {
    let own = text(&file.bytes, channel.block.unit_addr)?;
    if !own.is_empty() || channel.block.conversion_addr == 0 {
        return Ok(own);
    }
    let block = one(&file.bytes, channel.block.conversion_addr, "##CC")?;
    text(&file.bytes, super::blocks::links(block).nth(1).unwrap_or(0))
}
