//! Writes a table as a measurement file: one group, its time as the master channel.

use std::io::{Seek, SeekFrom, Write};

use mdf4_rs::blocks::{DataType, FileHistoryBlock};
use mdf4_rs::writer::{MdfWrite, MdfWriter};
use mdf4_rs::{DecodedValue, Error};

use crate::flags::every_set;

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A number, as float64.
    Number,
    /// A count or a set of bits, as an unsigned integer of 32 bits.
    Count,
    /// One of these words, as its place with a conversion to text.
    Words(&'static [&'static str]),
    /// Names of flags, as their bits with a conversion to text.
    Flags,
}

/// A column of the table; the first is the time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Described {
    /// Name.
    pub name: &'static str,
    /// Unit; empty where it has none.
    pub unit: &'static str,
    /// What it is.
    pub comment: &'static str,
    /// What it holds.
    pub kind: Kind,
}

struct Backend<'a, W>(&'a mut W, u64);

impl<W: Write + Seek> MdfWrite for Backend<'_, W> {
    fn write_all(&mut self, bytes: &[u8]) -> Result<(), Error> {
        self.0.write_all(bytes)?;
        self.1 += bytes.len() as u64;
        Ok(())
    }

    fn seek(&mut self, place: u64) -> Result<u64, Error> {
        self.1 = self.0.seek(SeekFrom::Start(place))?;
        Ok(self.1)
    }

    fn position(&self) -> u64 {
        self.1
    }

    fn flush(&mut self) -> Result<(), Error> {
        Ok(self.0.flush()?)
    }
}

/// Writes a table whose rows are the texts of a CSV file: the same values, to the last bit.
pub fn write<W: Write + Seek>(
    target: &mut W,
    group: &str,
    columns: &[Described],
    rows: impl Iterator<Item = Vec<String>>,
) -> Result<(), String> {
    let said = |error: Error| error.to_string();
    let mut writer = MdfWriter::from_writer(Backend(target, 0));
    writer.init_mdf_file().map_err(said)?;
    history(&mut writer).map_err(said)?;
    let id = head(&mut writer, group, columns).map_err(said)?;
    writer.start_data_block_for_cg(&id, 0).map_err(said)?;
    let mut record = Vec::with_capacity(columns.len());
    for row in rows {
        record.clear();
        for (column, text) in columns.iter().zip(&row) {
            record.push(value(column, text)?);
        }
        writer.write_record(&id, &record).map_err(said)?;
    }
    writer.finish_data_block(&id).map_err(said)?;
    writer.finalize().map_err(said)
}

/// The history that the standard asks for: who wrote the file. No time, so that the same run makes the same bytes.
fn history<W: MdfWrite>(writer: &mut MdfWriter<W>) -> Result<(), Error> {
    let comment = "<FHcomment><TX>epas simulate</TX><tool_id>epas</tool_id>\
                   <tool_vendor>epas-friction</tool_vendor><tool_version>"
        .to_string()
        + env!("CARGO_PKG_VERSION")
        + "</tool_version></FHcomment>";
    let text = mdf4_rs::blocks::TextBlock::new(&comment);
    let mut bytes = text.to_bytes()?;
    // Metadata is a text block by another name.
    if let Some(name) = bytes.get_mut(..4) {
        name.copy_from_slice(b"##MD");
    }
    let place = writer.write_block(&bytes)?;
    let mut block = FileHistoryBlock::new(0);
    block.comment_addr = place;
    let bytes = block.to_bytes()?;
    writer.write_block_with_id(&bytes, "history")?;
    writer.update_block_link("hd_block", 32, "history")
}

fn head<W: MdfWrite>(
    writer: &mut MdfWriter<W>,
    group: &str,
    columns: &[Described],
) -> Result<String, Error> {
    let id = writer.add_channel_group(None, |_| {})?;
    writer.set_channel_group_name(&id, group)?;
    let mut last: Option<String> = None;
    for column in columns {
        let (form, bits) = match column.kind {
            Kind::Number => (DataType::FloatLE, 64),
            Kind::Count | Kind::Words(_) | Kind::Flags => (DataType::UnsignedIntegerLE, 32),
        };
        let channel = writer.add_channel(&id, last.as_deref(), |block| {
            block.name = Some(column.name.into());
            block.data_type = form;
            block.bit_count = bits;
        })?;
        if last.is_none() {
            writer.set_time_channel(&channel)?;
        }
        writer.set_channel_unit(&channel, column.unit)?;
        writer.set_channel_comment(&channel, column.comment)?;
        let words: Vec<(i64, &str)> = match column.kind {
            Kind::Words(words) => (0..).zip(words.iter().copied()).collect(),
            Kind::Flags => every_set()
                .iter()
                .map(|(bits, words)| (i64::from(*bits), words.as_str()))
                .collect(),
            Kind::Number | Kind::Count => Vec::new(),
        };
        if !words.is_empty() {
            writer.add_value_to_text_conversion(&words, "", Some(&channel))?;
        }
        last = Some(channel);
    }
    Ok(id)
}

/// A text as a value of its column.
fn value(column: &Described, text: &str) -> Result<DecodedValue, String> {
    let known = match column.kind {
        Kind::Number => text.parse().ok().map(DecodedValue::Float),
        Kind::Count => text
            .parse::<u32>()
            .ok()
            .map(|value| DecodedValue::UnsignedInteger(value.into())),
        Kind::Words(words) => {
            let place = words.iter().position(|word| *word == text);
            place.map(|place| DecodedValue::UnsignedInteger(place as u64))
        }
        Kind::Flags => {
            let set = every_set().iter().find(|(_, words)| words == text);
            set.map(|(bits, _)| DecodedValue::UnsignedInteger((*bits).into()))
        }
    };
    known.ok_or_else(|| {
        format!(
            "{} = {text:?} has no place in a measurement file",
            column.name
        )
    })
}
