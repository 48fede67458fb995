//! A design file with the calibrated numbers: the user's own text, in which only those are replaced or added.

use toml_edit::{
    Array, Document, DocumentMut, InlineTable, Item, RawString, Table, TableLike, Value,
};

use crate::answer::{Calibration, Estimate};
use crate::page::shown::{interval, one_line};
use crate::screw::friction::{ElementsKind, Screw};
use epas_design::files::{Design, read};

/// Keys of a screw that a trace may tell, at the top of a design file.
const KEYS: &str =
    "friction hysteresis_loss lubricant_drag rolling_tangent clearance preload reversal_speed";

/// Keys that say how the balls fit, of which a design has one.
const FITS: &str = "preload clearance axial_preload axial_play";

/// Keys of the table `[calibration]` that the friction follows from: those that were set stand there too, because the
/// estimated ones hold beside them.
const FRICTION_KEYS: &str = "full_film_ratio half_share_speed reference_temperature viscosity_pole \
                             direction_asymmetry breakaway_angle reference_load largest_load backlash";

/// Keys of the table for what is no friction of the screw: only where they were estimated.
const OTHER_KEYS: &str = "inertia drag churning rolling_drag offset gain";

/// Keys that a design file has together or not at all.
const TOGETHER: [&str; 2] = [
    "full_film_ratio half_share_speed",
    "breakaway_angle largest_load",
];

fn has(keys: &str, name: &str) -> bool {
    keys.split(' ').any(|key| key == name)
}

const MARK: &str = "calibrated: ";

#[derive(Debug)]
pub struct Written {
    pub text: String,
    pub design: Design,
    /// Estimated parameters that a design file has no key for.
    pub left_out: Vec<String>,
    /// Parameters that ended at a bound, or say nothing without one that did, and are not written.
    pub at_bound: Vec<String>,
}

/// The text of a design file with the estimated parameters in it, and beside each its interval and the trace's name.
///
/// Everything else stays as it was: other keys, their order, comments, blank lines. A second calibration replaces the
/// comments of the first one.
pub fn written(
    text: &str,
    (calibration, screw): (&Calibration, Option<&Screw>),
    trace: &str,
) -> Result<Written, String> {
    let mut document = parsed(text)?.into_mut();
    let trace = one_line(trace);
    let mut left_out = Vec::new();
    let circumstances = screw.map(|screw| {
        [
            Estimate::fixed("reference_temperature", "K", screw.reference_temperature),
            Estimate::fixed("reference_load", "N", screw.reference_load),
            Estimate::fixed("largest_load", "N", screw.largest_load),
        ]
    });
    // Elements in constant shares of the friction have no largest load.
    let needless = screw.is_some_and(|screw| screw.elements == ElementsKind::Proportional);
    let circumstances = circumstances.iter().flatten();
    let circumstances = circumstances.take(if needless { 2 } else { 3 });
    let all = calibration.parameters.iter().chain(circumstances);
    let (at_bound, told): (Vec<&Estimate>, Vec<&Estimate>) =
        all.partition(|estimate| ends_at_bound(calibration, &estimate.name));
    for estimate in &told {
        let name = estimate.name.as_str();
        if has(FRICTION_KEYS, name) || has(OTHER_KEYS, name) && !estimate.fixed {
            set(table(&mut document)?, estimate, &trace);
        } else if estimate.fixed {
            // The user's own number stays as it is written.
        } else if has(KEYS, name) {
            if has(FITS, name) {
                document = with_fit(&document, name)?;
            }
            set(document.as_table_mut(), estimate, &trace);
        } else if order(name).is_none() {
            left_out.push(estimate.name.clone());
        }
    }
    if let Some(screw) = screw.filter(|_| !ends_at_bound(calibration, "breakaway_angle")) {
        let name = match screw.elements {
            ElementsKind::Proportional => "proportional",
            ElementsKind::LoadExact => "load_exact",
            ElementsKind::Preloaded => "preloaded",
        };
        table(&mut document)?.insert("elements", toml_edit::value(name));
    }
    if let Some(list) = waves(&told, &trace) {
        table(&mut document)?.insert("harmonics", Item::Value(list.into()));
    }
    let text = document.to_string();
    let design = read(&text, &trace)?;
    let names = at_bound.iter().map(|estimate| estimate.name.clone());
    Ok(Written {
        text,
        design,
        left_out,
        at_bound: names.collect(),
    })
}

/// Whether a parameter ended at a bound, or one that it says nothing without.
fn ends_at_bound(calibration: &Calibration, name: &str) -> bool {
    let group = TOGETHER.iter().find(|group| has(group, name));
    let mut ended = calibration.parameters.iter().filter(|other| other.at_bound);
    ended.any(|other| other.name == name || group.is_some_and(|group| has(group, &other.name)))
}

fn parsed(text: &str) -> Result<Document<String>, String> {
    Document::parse(text.to_owned()).map_err(|error| error.to_string())
}

/// A document in which `name` is the key that says how the balls fit: the one that it has is a comment below it, among the comments that speak
/// of it.
fn with_fit(document: &DocumentMut, name: &str) -> Result<DocumentMut, String> {
    let parsed = parsed(&document.to_string())?;
    let root = parsed.as_table();
    let mut others = FITS.split(' ').filter(|other| *other != name);
    let place = others.find_map(|other| Some(root.key(other)?.span()?.start));
    match place {
        Some(place) if !root.contains_key(name) => {
            let (above, below) = parsed.raw().split_at(place);
            // Its number follows.
            let text = format!("{above}{name} = 0\n# {below}");
            Ok(self::parsed(&text)?.into_mut())
        }
        _ => Ok(document.clone()),
    }
}

/// The table `[calibration]`, made where there is none: below the comments that end the file.
fn table(document: &mut DocumentMut) -> Result<&mut dyn TableLike, String> {
    if !document.contains_key("calibration") {
        let above = document.trailing().as_str().unwrap_or_default().to_owned();
        document.set_trailing("");
        let mut table = Table::new();
        table.decor_mut().set_prefix(format!("{above}\n"));
        document.insert("calibration", Item::Table(table));
    }
    document
        .get_mut("calibration")
        .and_then(Item::as_table_like_mut)
        .ok_or_else(|| "calibration is no table".into())
}

/// Puts a number in its place, with what is known of it as a comment behind it; that of the user stays before that.
fn set(table: &mut dyn TableLike, estimate: &Estimate, trace: &str) {
    let users = table
        .get(&estimate.name)
        .and_then(Item::as_value)
        .and_then(|value| value.decor().suffix())
        .and_then(RawString::as_str)
        .map_or("", users_comment)
        .to_owned();
    let before = match users.as_str() {
        "" => " # ".to_owned(),
        users => format!(" {users}; "),
    };
    let known = if estimate.fixed {
        "set, not estimated".into()
    } else {
        interval(estimate.low, estimate.high) + " (95 %)"
    };
    let mut value = number(estimate.value);
    value.decor_mut().set_prefix(" ");
    value
        .decor_mut()
        .set_suffix(format!("{before}{MARK}{known}, from {trace}"));
    if let Some(place) = table.get_mut(&estimate.name) {
        *place = Item::Value(value);
    } else {
        table.insert(&estimate.name, Item::Value(value));
    }
}

/// A comment without what this program had added to it.
fn users_comment(suffix: &str) -> &str {
    let end = suffix.find(MARK).unwrap_or(suffix.len());
    let own = suffix[..end].trim().trim_end_matches(';').trim_end();
    if own == "#" { "" } else { own }
}

/// A number to the last digit of what a design holds.
fn number(value: f64) -> Value {
    // The shortest digits that are this f32 again.
    let short = format!("{:?}", value as f32);
    short.parse().unwrap_or_else(|_| Value::from(value))
}

const PARTS: [&str; 2] = ["cosine", "sine"];

/// Waves in a turn, of a parameter that is a part of one.
fn order(name: &str) -> Option<u8> {
    let (part, order) = name.split_once('_')?;
    order.parse().ok().filter(|_| PARTS.contains(&part))
}

fn waves(told: &[&Estimate], trace: &str) -> Option<Array> {
    let estimated = told.iter().filter(|estimate| !estimate.fixed);
    let mut orders: Vec<u8> = estimated
        .clone()
        .filter_map(|own| order(&own.name))
        .collect();
    let mut known = [false; 256];
    orders.retain(|order| !std::mem::replace(&mut known[usize::from(*order)], true));
    let mut list = Array::new();
    let mut before = String::from("\n    ");
    for order in orders {
        let mut wave = InlineTable::new();
        wave.insert("order", i64::from(order).into());
        let mut notes = Vec::new();
        for name in PARTS {
            let own = format!("{name}_{order}");
            if let Some(part) = estimated.clone().find(|part| part.name == own) {
                wave.insert(name, number(part.value));
                notes.push(format!("{name} {}", interval(part.low, part.high)));
            }
        }
        let mut wave = Value::InlineTable(wave);
        wave.decor_mut().set_prefix(before);
        list.push_formatted(wave);
        before = format!(" # {MARK}{} (95 %), from {trace}\n    ", notes.join(", "));
    }
    list.set_trailing_comma(true);
    list.set_trailing(before.trim_end_matches(' '));
    (!list.is_empty()).then_some(list)
}

#[cfg(test)]
mod tests;
