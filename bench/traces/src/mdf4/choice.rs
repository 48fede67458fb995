//! The channels of the wanted quantities, and their units.

use super::file::{Channel, File};
use super::mapping::{Entry, Mapping};
use super::samples;
use super::table::Wanted;
use crate::units::{self, Quantity, Unit, cut, written};

#[derive(Clone, Copy, Debug)]
pub struct Chosen<'a> {
    pub quantity: Quantity,
    pub group: usize,
    pub channel: &'a Channel,
    pub unit: Unit,
}

/// Finds the channels of all wanted quantities that a file has.
pub fn choose<'a>(
    file: &'a File,
    mapping: Option<&Mapping>,
    wanted: &[Wanted],
) -> Result<Vec<Chosen<'a>>, String> {
    match mapping {
        Some(mapping) => mapped(file, mapping, wanted),
        None => by_name(file, wanted),
    }
}

/// All channels but the masters, with the number of their group.
fn channels(file: &File) -> impl Iterator<Item = (usize, &Channel)> {
    file.groups.iter().enumerate().flat_map(|(number, group)| {
        let own = group.channels.iter().filter(|channel| !channel.is_master());
        own.map(move |channel| (number, channel))
    })
}

fn mapped<'a>(
    file: &'a File,
    mapping: &Mapping,
    wanted: &[Wanted],
) -> Result<Vec<Chosen<'a>>, String> {
    let mut chosen = Vec::new();
    for entry in &mapping.entries {
        let Some(wanted) = wanted
            .iter()
            .find(|wanted| wanted.quantity == entry.quantity)
        else {
            continue;
        };
        let found: Vec<_> = channels(file)
            .filter(|(group, channel)| meant(file, entry, *group, channel))
            .collect();
        let (group, channel) =
            single(file, &entry.channel, &found)?.ok_or_else(|| absent(file, entry))?;
        let said = samples::unit(file, channel)?;
        let text = match (&entry.unit, said.is_empty()) {
            (None, _) => said,
            (Some(unit), true) => unit.clone(),
            (Some(unit), false)
                if written(entry.quantity, unit).ok() == written(entry.quantity, &said).ok() =>
            {
                said
            }
            (Some(unit), false) => {
                return Err(format!(
                    "channel {}: its unit is {:?} in the file and {unit:?} in the mapping",
                    cut(&channel.name),
                    cut(&said)
                ));
            }
        };
        let unit = accepted(wanted, channel, &text)?;
        chosen.push(Chosen {
            quantity: entry.quantity,
            group,
            channel,
            unit,
        });
    }
    Ok(chosen)
}

fn meant(file: &File, entry: &Entry, group: usize, channel: &Channel) -> bool {
    let Some(group) = file.groups.get(group) else {
        return false;
    };
    let source = entry.source.as_ref();
    channel.name == entry.channel
        && entry.group.as_ref().is_none_or(|name| *name == group.name)
        && source.is_none_or(|name| *name == channel.source || *name == group.source)
}

/// What there is where a channel is missing.
fn absent(file: &File, entry: &Entry) -> String {
    let alike: Vec<String> = channels(file)
        .filter(|(_, channel)| channel.name == entry.channel)
        .filter_map(|(group, _)| Some(file.groups.get(group)?.shown(group)))
        .take(8)
        .collect();
    if alike.is_empty() {
        return format!(
            "{}: there is no channel {:?}; {}",
            entry.column,
            cut(&entry.channel),
            found(file)
        );
    }
    format!(
        "{}: channel {:?} stands in the groups {}, none of them with the group and source that are asked for",
        entry.column,
        cut(&entry.channel),
        alike.join(", ")
    )
}

/// The channels of a file, the first few.
pub fn found(file: &File) -> String {
    const SHOWN: usize = 12;
    let mut names: Vec<String> = channels(file)
        .map(|(_, channel)| cut(&channel.name))
        .collect();
    let all = names.len();
    if all == 0 {
        return "the file has no channels".into();
    }
    names.truncate(SHOWN);
    let more = if all > SHOWN { ", ..." } else { "" };
    format!("the file's {all} channels are {}{more}", names.join(", "))
}

fn by_name<'a>(file: &'a File, wanted: &[Wanted]) -> Result<Vec<Chosen<'a>>, String> {
    let mut chosen = Vec::new();
    for wanted in wanted {
        let found: Vec<_> = channels(file)
            .filter(|(_, channel)| {
                let said = units::channel(&channel.name);
                matches!(said, Ok(Some((quantity, _))) if quantity == wanted.quantity)
            })
            .collect();
        let Some((group, channel)) = single(file, wanted.name, &found)? else {
            continue;
        };
        let text = samples::unit(file, channel)?;
        let named = units::channel(&channel.name)?
            .map(|(_, unit)| unit)
            .filter(|unit| !unit.name.is_empty());
        let unit = match (named, text.is_empty()) {
            (Some(named), true) => checked(wanted, channel, named)?,
            (Some(named), false) => {
                let unit = accepted(wanted, channel, &text)?;
                if unit != named {
                    return Err(format!(
                        "channel {}: its unit is {:?}, its name says {}",
                        cut(&channel.name),
                        cut(&text),
                        named.shown()
                    ));
                }
                unit
            }
            (None, _) => accepted(wanted, channel, &text)?,
        };
        chosen.push(Chosen {
            quantity: wanted.quantity,
            group,
            channel,
            unit,
        });
    }
    Ok(chosen)
}

/// The only one of the channels that were found.
fn single<'a>(
    file: &File,
    name: &str,
    found: &[(usize, &'a Channel)],
) -> Result<Option<(usize, &'a Channel)>, String> {
    if found.len() > 1 {
        let places: Vec<String> = found
            .iter()
            .filter_map(|(group, channel)| {
                let shown = file.groups.get(*group)?.shown(*group);
                Some(format!(
                    "{} in group {shown} (source {:?})",
                    cut(&channel.name),
                    cut(&channel.source)
                ))
            })
            .take(8)
            .collect();
        return Err(format!(
            "{name} is there {} times: {}; a file for --channels says which",
            found.len(),
            places.join(", ")
        ));
    }
    Ok(found.first().copied())
}

/// The unit that a text stands for, where the column accepts it.
fn accepted(wanted: &Wanted, channel: &Channel, text: &str) -> Result<Unit, String> {
    let shown = cut(&channel.name);
    if text.is_empty() {
        return Err(format!(
            "channel {shown}: the file says no unit; say it in a file for --channels: {} = {{ channel = {shown:?}, unit = \"...\" }}",
            wanted.name
        ));
    }
    let unit = written(wanted.quantity, text).map_err(|_| refused(wanted, channel, text))?;
    checked(wanted, channel, unit)
}

fn checked(wanted: &Wanted, channel: &Channel, unit: Unit) -> Result<Unit, String> {
    if wanted.refuses == Some(unit.dimension) {
        return Err(refused(wanted, channel, unit.shown()));
    }
    Ok(unit)
}

fn refused(wanted: &Wanted, channel: &Channel, text: &str) -> String {
    let accepted: Vec<_> = wanted
        .quantity
        .accepted()
        .filter(|unit| wanted.refuses != Some(unit.dimension))
        .map(Unit::shown)
        .collect();
    format!(
        "channel {} ({}): its unit {:?} is not accepted; accepted are {}",
        cut(&channel.name),
        wanted.name,
        cut(text),
        accepted.join(", ")
    )
}
