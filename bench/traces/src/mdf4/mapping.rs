//! Which channel is which column, where a file has other names: a TOML file.
//!
//! ```toml
//! nut_speed = "EPS_NutSpd"
//! axial_load = { channel = "RackForce", group = "XCP 1ms", source = "ECU", unit = "kN" }
//! ```

use std::path::Path;

use crate::units::{self, Quantity, cut, quantity};
use epas_page::failure::Failure;
use epas_page::files::read_text;

/// Largest mapping file, bytes.
const LARGEST: u64 = 1 << 20;

/// A column's channel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Name of the column.
    pub column: String,
    /// What it holds.
    pub quantity: Quantity,
    /// Name of the channel.
    pub channel: String,
    /// Name of its group, where several have the channel.
    pub group: Option<String>,
    /// Name of its source, or of its group's.
    pub source: Option<String>,
    /// Unit, where the file has none.
    pub unit: Option<String>,
}

/// Columns with their channels.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Mapping {
    /// In the order of the file.
    pub entries: Vec<Entry>,
}

impl Mapping {
    /// Reads a mapping file, or standard input.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        Self::of(&read_text(path, LARGEST)?)
            .map_err(|message| Failure::Data(format!("{}: {message}", path.display())))
    }

    /// Reads a mapping.
    pub fn of(text: &str) -> Result<Self, String> {
        let table: toml::Table = text
            .parse()
            .map_err(|error: toml::de::Error| error.to_string())?;
        let entries: Vec<Entry> = table
            .iter()
            .map(|(column, value)| entry(column, value))
            .collect::<Result<_, _>>()?;
        for (place, own) in entries.iter().enumerate() {
            let earlier = entries
                .iter()
                .take(place)
                .find(|other| other.quantity == own.quantity);
            if let Some(other) = earlier {
                return Err(format!(
                    "{} and {} are the same quantity",
                    other.column, own.column
                ));
            }
        }
        if entries.is_empty() {
            return Err(
                "it maps no column; one line is nut_speed = \"NAME OF THE CHANNEL\"".into(),
            );
        }
        Ok(Self { entries })
    }
}

fn entry(column: &str, value: &toml::Value) -> Result<Entry, String> {
    let known = || {
        units::names()
            .filter(|name| units::quantity(name) != Some(Quantity::Time))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let quantity = match quantity(column) {
        Some(Quantity::Time) => {
            return Err(
                "time is not mapped: it is the master channel of each channel's group".into(),
            );
        }
        Some(quantity) => quantity,
        None => {
            return Err(format!(
                "{} is no column; columns are {}",
                cut(column),
                known()
            ));
        }
    };
    let mut entry = Entry {
        column: column.into(),
        quantity,
        channel: String::new(),
        group: None,
        source: None,
        unit: None,
    };
    match value {
        toml::Value::String(channel) => entry.channel.clone_from(channel),
        toml::Value::Table(table) => {
            for (key, value) in table {
                let text = value
                    .as_str()
                    .ok_or_else(|| format!("{column}.{}: a text is expected", cut(key)))?;
                let text = text.to_string();
                match key.as_str() {
                    "channel" => entry.channel = text,
                    "group" => entry.group = Some(text),
                    "source" => entry.source = Some(text),
                    "unit" => entry.unit = Some(text),
                    _ => {
                        return Err(format!(
                            "{column}.{}: known are channel, group, source, unit",
                            cut(key)
                        ));
                    }
                }
            }
        }
        _ => {
            return Err(format!(
                "{column}: the name of a channel is expected, or {{ channel = ..., group = ... }}"
            ));
        }
    }
    if entry.channel.is_empty() {
        return Err(format!("{column}: the name of its channel is missing"));
    }
    Ok(entry)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mapping_names_channel_group_source_and_unit() {
        let text = "nut_speed = \"Spd\"\n[axial_load]\nchannel = \"F\"\ngroup = \"1ms\"\nsource = \"ECU\"\nunit = \"kN\"\n";
        let mapping = Mapping::of(text).unwrap();
        let load = mapping
            .entries
            .iter()
            .find(|entry| entry.column == "axial_load")
            .unwrap();
        assert_eq!(load.quantity, Quantity::Load);
        assert_eq!(
            [
                Some(&load.channel),
                load.group.as_ref(),
                load.source.as_ref(),
                load.unit.as_ref()
            ],
            ["F", "1ms", "ECU", "kN"]
                .map(String::from)
                .each_ref()
                .map(Some)
        );
        assert_eq!(mapping.entries.len(), 2);
    }

    #[test]
    fn every_fault_of_a_mapping_has_a_word() {
        for (text, word) in [
            ("nut_sped = \"a\"", "columns are position, motor_position"),
            ("time = \"t\"", "master channel"),
            ("nut_speed = 3", "name of a channel"),
            ("nut_speed = {}", "missing"),
            ("nut_speed = { channel = 3 }", "a text"),
            (
                "nut_speed = { channel = \"a\", raster = \"b\" }",
                "known are",
            ),
            ("axial_load = \"a\"\nrack_force = \"b\"", "same quantity"),
            ("", "maps no column"),
            ("nut_speed = ", "line 1"),
        ] {
            let message = Mapping::of(text).unwrap_err();
            assert!(message.contains(word), "{text}: {message}");
        }
    }
}
