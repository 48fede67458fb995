//! What a command asks of a measurement file, and what it gets: columns in SI units on one raster.

use std::collections::BTreeMap;
use std::io::Read;

use super::choice::{Chosen, choose, found};
use super::file::{File, Group};
use super::mapping::Mapping;
use super::raster::{Track, align};
use super::samples::{self, Samples};
use crate::table::Table;
use crate::units::{Dimension, Quantity, Unit, cut, written};

/// A quantity that a command reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wanted {
    /// Its column's name.
    pub name: &'static str,
    /// What it is.
    pub quantity: Quantity,
    /// What it cannot be measured in.
    pub refuses: Option<Dimension>,
}

/// What a command asks for.
#[derive(Clone, Copy, Debug)]
pub struct Request<'a> {
    /// Which quantities.
    pub wanted: &'a [Wanted],
    /// Whose raster is taken: the first of these that the file has.
    pub master: &'a [Quantity],
    /// Which channels, where not by name.
    pub mapping: Option<&'a Mapping>,
    /// The motor's rated torque, N m: 100 % of a torque in percent.
    pub rated_torque: Option<f64>,
}

/// Times of the groups by their numbers, each with whether it is valid.
pub type Times = BTreeMap<usize, Samples>;

/// Most names of channels that are kept.
const MOST_IGNORED: usize = 50;

/// Reads a table, with the checks of a CSV file's.
pub fn read(mut input: impl Read, request: &Request<'_>) -> Result<Table, String> {
    let mut bytes = Vec::new();
    input
        .read_to_end(&mut bytes)
        .map_err(|error| error.to_string())?;
    of(bytes, request)?.whole(request.rated_torque)
}

/// Reads a table from the bytes of a file.
pub fn of(bytes: Vec<u8>, request: &Request<'_>) -> Result<Table, String> {
    let file = File::of(bytes)?;
    let chosen = choose(&file, request.mapping, request.wanted)?;
    let master = request
        .master
        .iter()
        .find_map(|quantity| chosen.iter().find(|own| own.quantity == *quantity))
        .ok_or_else(|| absent(&file, request))?;
    let (times, tracks) = tracks(&file, &chosen)?;
    let ignored = file.groups.iter().flat_map(|group| &group.channels);
    let ignored = ignored
        .filter(|channel| {
            !channel.is_master() && !chosen.iter().any(|own| std::ptr::eq(own.channel, *channel))
        })
        .take(MOST_IGNORED)
        .map(|channel| cut(&channel.name))
        .collect();
    let mut table = align(&times, &tracks, master.group)?;
    table.ignored = ignored;
    Ok(table)
}

fn absent(file: &File, request: &Request<'_>) -> String {
    let names: Vec<_> = request
        .wanted
        .iter()
        .filter(|wanted| request.master.contains(&wanted.quantity))
        .map(|wanted| wanted.name)
        .collect();
    format!(
        "channel {} is missing; {}; a file for --channels says which channel it is",
        names.join(" or "),
        found(file)
    )
}

/// Reads the chosen channels, group by group.
fn tracks(file: &File, chosen: &[Chosen<'_>]) -> Result<(Times, Vec<Track>), String> {
    let mut times = Times::new();
    let mut tracks = Vec::new();
    for (number, group) in file.groups.iter().enumerate() {
        let own: Vec<_> = chosen.iter().filter(|own| own.group == number).collect();
        if own.is_empty() {
            continue;
        }
        let shown = group.shown(number);
        let master = group
            .master()
            .ok_or_else(|| format!("group {shown} has no time: no master channel"))?;
        if !matches!(master.block.sync_type, 0 | 1) {
            return Err(format!(
                "group {shown} is sampled by angle, distance or index, not by time"
            ));
        }
        let channels: Vec<_> = std::iter::once(master)
            .chain(own.iter().map(|own| own.channel))
            .collect();
        let mut read = samples::read(file, group, &channels)?.into_iter();
        let unit = time_unit(file, group)?;
        let time = read.next().unwrap_or_default();
        times.insert(number, in_si(time, unit, "time")?);
        for (own, samples) in own.into_iter().zip(read) {
            tracks.push(Track {
                name: own.channel.name.clone(),
                quantity: own.quantity,
                unit: own.unit,
                group: number,
                samples: in_si(samples, own.unit, &own.channel.name)?,
            });
        }
    }
    for (number, samples) in &times {
        let shown = file.groups.get(*number).map(|group| group.shown(*number));
        rising(&samples.values)
            .map_err(|message| format!("group {}: {message}", shown.unwrap_or_default()))?;
    }
    Ok((times, tracks))
}

/// Unit of a group's time: seconds where the file is silent.
fn time_unit(file: &File, group: &Group) -> Result<Unit, String> {
    let master = group
        .master()
        .ok_or("the file is damaged: a group lost its time")?;
    let text = samples::unit(file, master)?;
    let text = if text.is_empty() {
        "s".to_string()
    } else {
        text
    };
    written(Quantity::Time, &text).map_err(|accepted| {
        format!(
            "channel {} (time): its unit {:?} is not accepted; accepted are {accepted}",
            cut(&master.name),
            cut(&text)
        )
    })
}

/// Values in SI units, those that are valid within the range of f32. What is NaN or infinite counts as invalid.
fn in_si(mut samples: Samples, unit: Unit, name: &str) -> Result<Samples, String> {
    let mut missing = Vec::new();
    for (sample, value) in samples.values.iter_mut().enumerate() {
        if samples.valid.get(sample) == Some(&false) {
            continue;
        }
        let shown = cut(name);
        if value.is_nan() {
            missing.push(sample);
            continue;
        }
        if !value.is_finite() {
            return Err(format!(
                "channel {shown}: sample {sample} = {value} is not finite"
            ));
        }
        if value.abs() > f64::from(f32::MAX) {
            return Err(format!(
                "channel {shown}: sample {sample} = {value} is beyond the range of float32"
            ));
        }
        *value = unit.si(*value);
    }
    if !missing.is_empty() && samples.valid.is_empty() {
        samples.valid.resize(samples.values.len(), true);
    }
    for sample in missing {
        if let Some(valid) = samples.valid.get_mut(sample) {
            *valid = false;
        }
    }
    Ok(samples)
}

/// Whether times never go back.
fn rising(times: &[f64]) -> Result<(), String> {
    let back = times
        .windows(2)
        .zip(1..)
        .find_map(|(pair, sample)| match pair {
            [before, after] if after < before => Some((sample, *before, *after)),
            _ => None,
        });
    match back {
        Some((sample, before, after)) => Err(format!(
            "sample {sample}: time goes back from {before} s to {after} s"
        )),
        None => Ok(()),
    }
}
