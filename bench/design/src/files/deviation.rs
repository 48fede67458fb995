//! Deviations of a groove as a design file gives them: waves, samples at equal distances, or the chart of a measuring machine.

use std::f64::consts::TAU;
use std::path::Path;

use csv::{ReaderBuilder, StringRecord, Trim};
use epas_friction::{DeviationMap, Harmonic};
use nalgebra::{DMatrix, DVector};
use serde::Deserialize;
use toml::de::DeTable;

use super::tables::text_of;
use crate::Failure;

/// Samples of a [`DeviationMap`].
const SAMPLES: usize = 64;

/// Angles of a chart that are nearer to each other than this part of its period are one: printed angles are rounded.
const SAME: f64 = 1e-5;

/// Largest part of a period between two neighbouring samples: an eighth of it, so that angles read in a wrong unit are refused.
const LARGEST_GAP: f64 = 0.125;

/// Least number of samples at equal distances.
const LEAST: usize = (1.0 / LARGEST_GAP) as usize;

/// Keys of a table `[uncaged]` that may name a chart.
const KEYS: [&str; 2] = ["screw_deviation", "nut_deviation"];

/// A wave of a deviation map.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Wavelet {
    /// Waves in a period.
    pub order: u8,
    /// Amplitude of the cosine, rad.
    #[serde(default)]
    pub cosine: f32,
    /// Amplitude of the sine, rad.
    #[serde(default)]
    pub sine: f32,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(try_from = "toml::Value")]
pub enum Given {
    Waves(Vec<Wavelet>),
    /// Deviations at equal distances along the period, from its start, rad.
    Samples(Vec<f32>),
    Chart(String),
}

impl Given {
    /// Whether it is more than an empty list.
    pub const fn any(&self) -> bool {
        !matches!(self, Self::Waves(waves) if waves.is_empty())
    }

    /// The map over a period of `turns` turns.
    pub fn map(&self, field: &str, turns: u16) -> Result<&'static DeviationMap, String> {
        match self {
            Self::Waves(waves) => of_waves(field, turns, waves),
            Self::Samples(samples) if samples.len() < LEAST => Err(format!(
                "{field} is a list of {} numbers; deviations at equal distances are {LEAST} or more, and a wave is a table, such as {{ order = 2, sine = 0.01 }}",
                samples.len()
            )),
            Self::Samples(samples) => {
                let places = (0..samples.len()).map(|place| place as f64 / samples.len() as f64);
                let points = places.zip(samples.iter().map(|&sample| sample.into()));
                of_points(turns, points.collect()).map_err(|message| format!("{field}: {message}"))
            }
            Self::Chart(name) => Err(format!(
                "{field} = \"{name}\" is a chart, which is read beside a design file; a text alone gives its samples as a list"
            )),
        }
    }
}

/// A map of waves that lives as long as the program, which reads one design and ends: in firmware it lies in flash.
pub fn of_waves(
    field: &str,
    turns: u16,
    waves: &[Wavelet],
) -> Result<&'static DeviationMap, String> {
    let harmonics: Vec<_> = waves
        .iter()
        .map(|wave| Harmonic {
            order: wave.order,
            cosine: wave.cosine,
            sine: wave.sine,
        })
        .collect();
    let map = DeviationMap::from_harmonics(turns, &harmonics)
        .map_err(|error| format!("{field}: {error}"))?;
    Ok(Box::leak(Box::new(map)))
}

/// The map of points: places in parts of the period, rad.
fn of_points(turns: u16, points: Vec<(f64, f64)>) -> Result<&'static DeviationMap, String> {
    let samples = sampled(points)?;
    let map = DeviationMap::from_samples(turns, &samples).map_err(|error| error.to_string())?;
    Ok(Box::leak(Box::new(map)))
}

/// Samples of the map that is nearest to points joined by straight lines.
fn sampled(points: Vec<(f64, f64)>) -> Result<[f32; SAMPLES], String> {
    if let Some((place, value)) = points.iter().find(|(_, value)| !value.is_finite()) {
        return Err(format!(
            "the deviation at {place:.4} of the period is {value}"
        ));
    }
    let lines = Lines::through(points)?;
    Ok(lines.nearest())
}

/// Points joined by straight lines, periodic: places from 0 to below 1, rising.
struct Lines(Vec<(f64, f64)>);

impl Lines {
    fn through(mut points: Vec<(f64, f64)>) -> Result<Self, String> {
        for (place, _) in &mut points {
            *place = place.rem_euclid(1.0);
        }
        points.sort_by(|one, other| one.0.total_cmp(&other.0));
        let mut distinct: Vec<(f64, f64)> = Vec::with_capacity(points.len());
        // What closes the chart stands at the place of its first sample.
        let wraps = points
            .iter()
            .rev()
            .take_while(|(place, _)| 1.0 - place < SAME);
        let wraps = wraps.count();
        let (points, closing) = points.split_at(points.len() - wraps);
        let closing = closing.iter().map(|&(place, value)| (place - 1.0, value));
        let mut count = 0.0;
        for (place, value) in closing.chain(points.iter().copied()) {
            match distinct.last_mut() {
                Some((last, mean)) if place - *last < SAME => {
                    count += 1.0;
                    *mean += (value - *mean) / count;
                }
                _ => {
                    count = 1.0;
                    distinct.push((place.max(0.0), value));
                }
            }
        }
        let [(first, _), .., (last, _)] = distinct[..] else {
            return Err("there are fewer than two samples".into());
        };
        let gaps = distinct.windows(2).map(|pair| (pair[0].0, pair[1].0));
        let widest = gaps
            .chain([(last, first + 1.0)])
            .max_by(|one, other| (one.1 - one.0).total_cmp(&(other.1 - other.0)));
        match widest {
            Some((from, to)) if to - from > LARGEST_GAP + SAME => Err(format!(
                "there is no sample between {from:.4} and {to:.4} of the period; allowed: gaps to {LARGEST_GAP} of it"
            )),
            _ => Ok(Self(distinct)),
        }
    }

    /// The samples of the straight lines over [`SAMPLES`] equal parts of the period with the least square distance to these ones. Coefficients `c`
    /// of hat functions `h` obey `sum_j c_j <h_j, h_i> = <f, h_i>`, with 2/3 and 1/6 of a part as products of hats; where the lines bend
    /// at the samples alone they are these lines.
    fn nearest(&self) -> [f32; SAMPLES] {
        let mut right = DVector::zeros(SAMPLES);
        let mut points = self.0.clone();
        points.extend((0..SAMPLES).map(|node| {
            let place = node as f64 / SAMPLES as f64;
            (place, self.at(place))
        }));
        points.sort_by(|one, other| one.0.total_cmp(&other.0));
        points.push((1.0, points[0].1));
        for pair in points.windows(2) {
            let [(from, first), (to, last)] = pair else {
                continue;
            };
            let node = ((0.5 * (from + to) * SAMPLES as f64) as usize).min(SAMPLES - 1);
            let part = |place: f64| place * SAMPLES as f64 - node as f64;
            let (begin, end) = (part(*from), part(*to));
            // Simpson's rule, exact for the product of two lines.
            let weighed = |of: fn(f64) -> f64| {
                let middle = 0.5 * (first + last) * of(0.5 * (begin + end));
                (end - begin) / 6.0 * (first * of(begin) + 4.0 * middle + last * of(end))
            };
            right[node] += weighed(|part| 1.0 - part);
            right[(node + 1) % SAMPLES] += weighed(|part| part);
        }
        let products = DMatrix::from_fn(SAMPLES, SAMPLES, |row, column| {
            match (row + SAMPLES - column) % SAMPLES {
                0 => 2.0 / 3.0,
                1 | 63 => 1.0 / 6.0,
                _ => 0.0,
            }
        });
        // Diagonally dominant: it has one solution.
        let found = products.lu().solve(&right).unwrap_or(right);
        std::array::from_fn(|sample| found[sample] as f32)
    }

    /// The value at a place from 0 to 1.
    fn at(&self, place: f64) -> f64 {
        let points = &self.0;
        let next = points.partition_point(|(own, _)| *own <= place);
        let before = if next == 0 {
            let (own, value) = points[points.len() - 1];
            (own - 1.0, value)
        } else {
            points[next - 1]
        };
        let after = points.get(next).copied().unwrap_or_else(|| {
            let (own, value) = points[0];
            (own + 1.0, value)
        });
        before.1 + (after.1 - before.1) * (place - before.0) / (after.0 - before.0)
    }
}

/// The text of a design file with lists of [`SAMPLES`] samples in the place of charts' names.
pub fn with_charts(path: &Path, text: String) -> Result<String, Failure> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut text = text;
    for key in KEYS {
        let Some(Named { name, turns, span }) = named(&text, key) else {
            continue;
        };
        let file = folder.join(&name);
        let chart = text_of(&file)?;
        let samples = chart_points(&chart, turns)
            .and_then(sampled)
            .map_err(|message| Failure::Domain(format!("{}: {message}", file.display())))?;
        text.replace_range(span, &format!("{samples:?}"));
    }
    Ok(text)
}

struct Named {
    name: String,
    turns: u16,
    /// Where in the text its name stands.
    span: std::ops::Range<usize>,
}

fn named(text: &str, key: &str) -> Option<Named> {
    let file = DeTable::parse(text).ok()?;
    let table = file.get_ref().get("uncaged")?.get_ref().as_table()?;
    let value = table.get(key)?;
    let turns = match table.get("deviation_turns") {
        None => 1,
        Some(turns) => turns.get_ref().as_integer()?.as_str().parse().ok()?,
    };
    Some(Named {
        name: value.get_ref().as_str()?.into(),
        turns,
        span: value.span(),
    })
}

/// Places in parts of the period, and deviations, rad, of a chart: CSV with a column `angle` and a column `deviation`, in rad, or `angle_deg` and
/// `deviation_deg`.
fn chart_points(text: &str, turns: u16) -> Result<Vec<(f64, f64)>, String> {
    let heading = text.lines().next().unwrap_or_default();
    let delimiter = [b';', b'\t']
        .into_iter()
        .find(|mark| heading.as_bytes().contains(mark))
        .unwrap_or(b',');
    let mut reader = ReaderBuilder::new()
        .delimiter(delimiter)
        .trim(Trim::All)
        .from_reader(text.trim_start_matches('\u{feff}').as_bytes());
    let headings = reader.headers().map_err(|error| error.to_string())?;
    let columns = [column(headings, "angle")?, column(headings, "deviation")?];
    let mut points = Vec::new();
    for (row, record) in reader.records().enumerate() {
        let record = record.map_err(|error| error.to_string())?;
        let mut numbers = [0.0; 2];
        for (number, (place, unit)) in numbers.iter_mut().zip(columns) {
            let given = record.get(place).unwrap_or_default();
            // Where a comma does not separate columns it may stand for a decimal point.
            let value: f64 = given
                .replace(',', ".")
                .parse()
                .map_err(|_| format!("row {}: {given:?} is not a number", row + 1))?;
            if !value.is_finite() {
                return Err(format!("row {}: {given} is not finite", row + 1));
            }
            *number = unit * value;
        }
        points.push((numbers[0], numbers[1]));
    }
    let angles = || points.iter().map(|(angle, _)| *angle);
    let range = angles().fold(f64::MIN, f64::max) - angles().fold(f64::MAX, f64::min);
    let period = TAU * f64::from(turns);
    if range > period * (1.0 + SAME) {
        return Err(format!(
            "angles range over {range:.4} rad, more than the period of {turns} turns; are they degrees (heading angle_deg), or is deviation_turns missing?"
        ));
    }
    for (angle, _) in &mut points {
        *angle /= period;
    }
    Ok(points)
}

/// Place and unit, rad, of the column of a quantity.
fn column(headings: &StringRecord, quantity: &str) -> Result<(usize, f64), String> {
    let degrees = format!("{quantity}_deg");
    let found: Vec<_> = headings
        .iter()
        .enumerate()
        .filter_map(|(place, heading)| match heading {
            _ if heading == quantity => Some((place, 1.0)),
            _ if heading == degrees => Some((place, TAU / 360.0)),
            _ => None,
        })
        .collect();
    match found[..] {
        [one] => Ok(one),
        [] => Err(format!(
            "there is no column {quantity} (rad) or {degrees} (degrees) in the heading"
        )),
        _ => Err(format!("{quantity} has more than one column")),
    }
}

impl TryFrom<toml::Value> for Given {
    type Error = String;

    fn try_from(value: toml::Value) -> Result<Self, String> {
        let wrong = |value: &toml::Value, wanted: &str| {
            Err(format!(
                "invalid type: {}, expected {wanted}",
                value.type_str()
            ))
        };
        let entries = match value {
            toml::Value::String(name) => return Ok(Self::Chart(name)),
            toml::Value::Array(entries) => entries,
            other => {
                return wrong(
                    &other,
                    "a list of waves or of deviations at equal distances, or the name of a chart in quotes, such as \"screw.csv\"",
                );
            }
        };
        let (mut waves, mut samples) = (Vec::new(), Vec::new());
        for entry in entries {
            match entry {
                toml::Value::Table(_) => {
                    let wave = entry.try_into();
                    waves.push(wave.map_err(|error| error.to_string())?);
                }
                toml::Value::Float(number) => samples.push(number as f32),
                toml::Value::Integer(number) => samples.push(number as f32),
                other => {
                    return wrong(
                        &other,
                        "waves, such as { order = 2, sine = 0.01 }, or numbers at equal distances, rad",
                    );
                }
            }
        }
        match (waves.is_empty(), samples.is_empty()) {
            (true, false) => Ok(Self::Samples(samples)),
            (_, true) => Ok(Self::Waves(waves)),
            _ => Err("a list is one of waves, or one of deviations at equal distances".into()),
        }
    }
}

#[cfg(test)]
mod tests;
