//! Groups and channels of a measurement file.

use std::collections::HashSet;

use mdf4_rs::blocks::{BlockParse, ChannelBlock, ChannelGroupBlock, DataGroupBlock, HeaderBlock};

use super::blocks::{links, one, parsed, text};

/// Most channels and groups of a file.
const MOST: usize = 200_000;

#[derive(Debug)]
pub struct File {
    /// All bytes.
    pub bytes: Vec<u8>,
    pub groups: Vec<Group>,
    pub data: Vec<DataGroup>,
}

/// Records of one or several channel groups.
#[derive(Clone, Debug)]
pub struct DataGroup {
    /// Where the data start; 0 where there are none.
    pub address: u64,
    /// Bytes of the number in front of each record.
    pub id_size: usize,
    /// What the records of each group are.
    pub records: Vec<Record>,
}

#[allow(clippy::struct_field_names, reason = "the standard's name")]
#[derive(Clone, Copy, Debug)]
pub struct Record {
    pub record_id: u64,
    /// Whether records say their length themselves.
    pub variable: bool,
    pub data_bytes: u32,
    pub invalid_bytes: u32,
}

#[derive(Clone, Debug)]
pub struct Group {
    pub name: String,
    /// Name of its source; may be empty.
    pub source: String,
    pub data: usize,
    pub record_id: u64,
    pub cycles: u64,
    pub data_bytes: u32,
    pub channels: Vec<Channel>,
}

#[derive(Clone, Debug)]
pub struct Channel {
    /// Name, without what a recorder has added behind a backslash.
    pub name: String,
    /// Name of its source; may be empty.
    pub source: String,
    /// How its values stand in a record.
    pub block: ChannelBlock,
}

impl Group {
    pub fn master(&self) -> Option<&Channel> {
        self.channels.iter().find(|channel| channel.is_master())
    }

    pub fn shown(&self, index: usize) -> String {
        if self.name.is_empty() {
            format!("number {index}")
        } else {
            format!("{:?}", crate::units::cut(&self.name))
        }
    }
}

impl Channel {
    /// Whether other channels are sampled at its values.
    pub fn is_master(&self) -> bool {
        matches!(self.block.channel_type, 2 | 3)
    }
}

impl File {
    pub fn of(bytes: Vec<u8>) -> Result<Self, String> {
        identify(&bytes)?;
        let header: HeaderBlock = {
            let block = one(&bytes, 64, "##HD")?;
            HeaderBlock::from_bytes(block).map_err(|error| error.to_string())?
        };
        let mut file = Self {
            bytes: Vec::new(),
            groups: Vec::new(),
            data: Vec::new(),
        };
        let mut seen = Seen::default();
        let mut next = header.first_dg_addr;
        while next != 0 {
            seen.add(next)?;
            next = file.data_group(&bytes, next, &mut seen)?;
        }
        file.bytes = bytes;
        Ok(file)
    }

    /// Adds a data group with its channel groups; the address of the next.
    fn data_group(&mut self, bytes: &[u8], address: u64, seen: &mut Seen) -> Result<u64, String> {
        let block: DataGroupBlock = parsed(bytes, address)?;
        let id_size = usize::from(block.record_id_size);
        if id_size > 8 {
            return Err(format!(
                "the file is damaged: {id_size} bytes of a record's number"
            ));
        }
        let mut records = Vec::new();
        let mut next = block.first_cg_addr;
        while next != 0 {
            seen.add(next)?;
            let group: ChannelGroupBlock = parsed(bytes, next)?;
            records.push(Record {
                record_id: group.record_id,
                variable: group.flags & 1 != 0,
                data_bytes: group.record_size,
                invalid_bytes: group.invalidation_size,
            });
            self.groups.push(Group {
                name: text(bytes, group.acq_name_addr)?,
                source: source(bytes, group.acq_source_addr)?,
                data: self.data.len(),
                record_id: group.record_id,
                cycles: group.cycle_count,
                data_bytes: group.record_size,
                channels: channels(bytes, group.first_ch_addr, seen)?,
            });
            next = group.next_cg_addr;
        }
        self.data.push(DataGroup {
            address: block.data_block_addr,
            id_size,
            records,
        });
        Ok(block.next_dg_addr)
    }
}

/// Blocks of lists that were read: none may come twice.
#[derive(Default)]
struct Seen(HashSet<u64>);

impl Seen {
    fn add(&mut self, address: u64) -> Result<(), String> {
        if !self.0.insert(address) {
            return Err(format!(
                "the file is damaged: its lists go in a circle at byte {address}"
            ));
        }
        if self.0.len() > MOST {
            return Err(format!("the file has more than {MOST} channels and groups"));
        }
        Ok(())
    }
}

/// Whether this is a measurement file of version 4 that was closed.
fn identify(bytes: &[u8]) -> Result<(), String> {
    let name = bytes.get(..8).unwrap_or(bytes);
    match name {
        b"MDF     " => {}
        b"UnFinMF " => {
            return Err("the recorder has not closed this file (UnFinMF): its counts are open; finalize it first, as asammdf does on opening and saving".into());
        }
        _ => {
            let shown = String::from_utf8_lossy(name).into_owned();
            return Err(format!(
                "no measurement file: it starts with {shown:?} where MDF 4 has \"MDF     \""
            ));
        }
    }
    let version = String::from_utf8_lossy(bytes.get(8..16).unwrap_or_default()).into_owned();
    if version.starts_with("4.") {
        return Ok(());
    }
    let version = version.trim_matches([' ', '\0']).to_string();
    Err(format!(
        "a measurement file of version {version:?}; read is MDF 4: save it as such"
    ))
}

fn channels(bytes: &[u8], first: u64, seen: &mut Seen) -> Result<Vec<Channel>, String> {
    let mut channels = Vec::new();
    let mut next = first;
    while next != 0 {
        seen.add(next)?;
        let block: ChannelBlock = parsed(bytes, next)?;
        next = block.next_ch_addr;
        let name = text(bytes, block.name_addr)?;
        channels.push(Channel {
            name: name.split('\\').next().unwrap_or_default().to_string(),
            source: source(bytes, block.source_addr)?,
            block,
        });
    }
    Ok(channels)
}

fn source(bytes: &[u8], address: u64) -> Result<String, String> {
    if address == 0 {
        return Ok(String::new());
    }
    let name = links(one(bytes, address, "##SI")?).next().unwrap_or(0);
    text(bytes, name)
}
