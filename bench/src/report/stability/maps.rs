//! Errors over whole domains: every point of a map is a request of `eval`.

mod every;
mod requests;
mod sample;

use epas_eval::BadField;
use epas_page::document::Cell;
use epas_page::plot::{Axis, ColourMap, Colours, Panel};
use epas_reference::promises;
use rayon::prelude::*;

pub use every::MAPS;
use sample::{Sample, Tally};

/// One formula over two of its inputs.
pub struct Map {
    /// Title of its panel, with what the error is of.
    title: &'static str,
    /// Heading and ends of the horizontal axis.
    x: (&'static str, f64, f64),
    /// Heading and ends of the vertical axis.
    y: (&'static str, f64, f64),
    /// What crate and reference say at a point.
    at: fn(f64, f64) -> Result<Sample, BadField>,
    /// Where the numbers stand in `in_loop` and in `reference` of the answer to the point's line, as JSON pointers.
    value: (&'static str, &'static str),
    /// Where the number of the reference stands that the error is divided by; none for an absolute error.
    over: Option<&'static str>,
    /// Entry of what is promised on the promise's own domain, a part of the map.
    promise: Option<&'static str>,
    /// Cells of a side over those of the others: where the reference takes long.
    fineness: f64,
}

/// What [`Map`]s have in common.
const PLAIN: Map = Map {
    title: "",
    x: ("", 0.0, 1.0),
    y: ("", 0.0, 1.0),
    at: |x, y| {
        sample::ask(&requests::friction(x, y), |f, r| {
            sample::Numbers::of(f.force, r.force)
        })
    },
    value: ("", ""),
    over: None,
    promise: None,
    fineness: 1.0,
};

/// Bounds of the bands: every half decade where errors of f32 lie.
const BOUNDS: [(f64, &str); 12] = [
    (1e-9, "1e-9"),
    (1e-8, "1e-8"),
    (3e-8, "3e-8"),
    (1e-7, "1e-7"),
    (3e-7, "3e-7"),
    (1e-6, "1e-6"),
    (3e-6, "3e-6"),
    (1e-5, "1e-5"),
    (1e-4, "1e-4"),
    (1e-3, "1e-3"),
    (1e-2, "1e-2"),
    (0.1, "0.1"),
];

/// Headings of the rows that [`Map::draw`] makes.
pub const COLUMNS: [&str; 13] = [
    "quantity",
    "inputs",
    "refused",
    "without an exact value",
    "without a value in the loop",
    "largest",
    "rms",
    "mean",
    "promised",
    "in_loop",
    "reference",
    "error over",
    "worst case",
];

/// What is promised, and where, if it is less than the largest error found.
fn promised(promise: Option<f64>, found: f64) -> Cell {
    let Some(promise) = promise else {
        return "".into();
    };
    let cell = Cell::power(promise);
    if found > promise {
        format!("{} on its domain, a part of the map", cell.shown()).into()
    } else {
        cell
    }
}

/// A map, drawn.
pub struct Drawn {
    pub panel: Panel,
    /// Row under [`COLUMNS`].
    pub row: Vec<Cell>,
    pub requests: u64,
    pub largest: f64,
}

impl Map {
    /// What became of the points, and the sizes of their errors, line by line.
    fn errors(&self, cells: usize) -> (Tally, Vec<Vec<f64>>) {
        let place = |(_, low, high): (&str, f64, f64), index: usize| {
            low + (high - low) * (index as f64 + 0.5) / cells as f64
        };
        let lines: Vec<Vec<_>> = (0..cells)
            .into_par_iter()
            .map(|row| {
                (0..cells)
                    .map(|column| (self.at)(place(self.x, column), place(self.y, row)))
                    .collect()
            })
            .collect();
        let mut tally = Tally::default();
        let mut sizes = |line: Vec<_>| {
            line.into_iter()
                .map(|point| tally.add(point).unwrap_or(f64::NAN))
                .collect()
        };
        let sizes = lines.into_iter().map(&mut sizes).collect();
        (tally, sizes)
    }

    /// The map over its domain.
    pub fn draw(&self, cells: usize) -> Drawn {
        let cells = (cells as f64 * self.fineness).ceil() as usize;
        let (tally, values) = self.errors(cells);
        let (x, x_low, x_high) = self.x;
        let (y, y_low, y_high) = self.y;
        let panel = Panel::Map(ColourMap {
            title: self.title.into(),
            x: Axis::linear(x).between(x_low, x_high),
            y: Axis::linear(y).between(y_low, y_high),
            quantity: "error".into(),
            colours: Colours::Sequential,
            bounds: BOUNDS
                .iter()
                .map(|(bound, text)| (*bound, (*text).to_owned()))
                .collect(),
            values,
        });
        let largest = tally.errors.largest;
        Drawn {
            panel,
            row: self.row(tally),
            requests: (cells * cells) as u64,
            largest,
        }
    }

    fn row(&self, tally: Tally) -> Vec<Cell> {
        let count = |points: u32| Cell::fixed(f64::from(points), 0);
        let errors = tally.errors;
        let promise = self.promise.map(|name| promises::of(name).largest);
        let (in_loop, reference) = self.value;
        let worst = tally.worst.map(|(_, sample)| sample.line);
        vec![
            self.title.into(),
            count(tally.compared),
            count(tally.refused),
            count(tally.not_exact),
            count(tally.not_found),
            Cell::power(errors.largest),
            Cell::power(errors.rms()),
            Cell::power(errors.mean()),
            promised(promise, errors.largest),
            in_loop.into(),
            reference.into(),
            self.over.unwrap_or("").into(),
            worst.map_or_else(|| "".into(), Cell::Code),
        ]
    }
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use super::*;

    /// `eval` answers the line of a map's worst case with the numbers that the map compares, where the row says they stand.
    #[test]
    fn worst_cases_are_reproduced() {
        for map in &MAPS {
            let cells = (8.0 * map.fineness) as usize;
            let (tally, _) = map.errors(cells);
            let points = [
                tally.compared,
                tally.refused,
                tally.not_exact,
                tally.not_found,
            ];
            assert_eq!(points.iter().sum::<u32>() as usize, cells * cells);
            let (_, sample) = tally.worst.unwrap();
            let answer: Value =
                serde_json::from_str(&epas_eval::answer_line(&sample.line)).unwrap();
            let number = |side: &str, place: &str| answer[side].pointer(place)?.as_f64();
            let numbers = sample.numbers;
            let (found, exact) = map.value;
            assert_eq!(number("in_loop", found), numbers.found, "{}", sample.line);
            assert_eq!(number("reference", exact), numbers.exact, "{}", sample.line);
            let scale = map
                .over
                .map_or(Some(1.0), |place| number("reference", place));
            assert_eq!(scale, numbers.scale, "{}", sample.line);
        }
    }
}
