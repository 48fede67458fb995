//! Errors over whole domains: every point of a map is a request of `eval`.

mod every;
mod requests;
mod sample;

use crate::report::draw;
use epas_eval::BadField;
use epas_page::document::Cell;
use epas_page::failure::Failure;
use epas_page::plot::{self, Panel};
use epas_reference::promises;
use rayon::prelude::*;

pub use every::MAPS;
use sample::{Answers, Sample, Tally};

type Axis = (&'static str, f64, f64);

pub struct Map {
    title: &'static str,
    x: Axis,
    y: Axis,
    at: fn(f64, f64) -> Result<Answers, BadField>,
    /// Where the numbers stand in `in_loop` and in `reference` of the answer to the point's line, and in `reference` the one that the error is
    /// over: JSON pointers, an empty one for an absolute error.
    places: [&'static str; 3],
    /// Where in `reference` it says that the quantity does not count; empty where it always does.
    unless: &'static str,
    /// Entry of what is promised on the promise's own domain, a part of the map; empty without.
    promise: &'static str,
    /// Cells of a side over those of the others: where the reference takes long.
    fineness: f64,
}

const fn map(
    title: &'static str,
    x: Axis,
    y: Axis,
    at: fn(f64, f64) -> Result<Answers, BadField>,
    places: [&'static str; 3],
    promise: &'static str,
) -> Map {
    Map {
        title,
        x,
        y,
        at,
        places,
        unless: "",
        promise,
        fineness: 1.0,
    }
}

/// Bounds of the bands: every half decade where errors of f32 lie.
const BOUNDS: [f64; 12] = [
    1e-9, 1e-8, 3e-8, 1e-7, 3e-7, 1e-6, 3e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1,
];

pub const COLUMNS: &str = "quantity | inputs | refused | without an exact value | without a value in the loop | \
     largest | rms | mean | promised | in_loop | reference | error over | worst case";

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

pub struct Drawn {
    pub panel: Panel,
    pub row: Vec<Cell>,
    pub requests: u64,
    pub largest: f64,
}

impl Map {
    /// The map without the points where `reference` says so.
    const fn unless(mut self, place: &'static str) -> Self {
        self.unless = place;
        self
    }

    const fn coarse(mut self) -> Self {
        self.fineness = 0.25;
        self
    }

    fn errors(&self, cells: usize) -> Result<(Tally, Vec<Vec<f64>>), Failure> {
        let place = |(_, low, high): Axis, index: usize| {
            low + (high - low) * (index as f64 + 0.5) / cells as f64
        };
        let point = |row: usize, column: usize| match (self.at)(
            place(self.x, column),
            place(self.y, row),
        ) {
            Ok(answers) => answers.sample(self.places, self.unless).map(Ok),
            Err(refused) => Ok(Err(refused)),
        };
        let lines: Vec<Vec<_>> = (0..cells)
            .into_par_iter()
            .map(|row| (0..cells).map(|column| point(row, column)).collect())
            .collect::<Result<_, Failure>>()
            .map_err(|failure| failure.of(self.title))?;
        let mut tally = Tally::default();
        let mut sizes = |line: Vec<Result<Sample, BadField>>| {
            line.into_iter()
                .map(|point| tally.add(point).unwrap_or(f64::NAN))
                .collect()
        };
        let sizes = lines.into_iter().map(&mut sizes).collect();
        if tally.compared == 0 {
            let nothing =
                Failure::Data("there is no point at which both sides have a number".into());
            return Err(nothing.of(self.title));
        }
        Ok((tally, sizes))
    }

    pub fn draw(&self, cells: usize) -> Result<Drawn, Failure> {
        let cells = (cells as f64 * self.fineness).ceil() as usize;
        let (tally, values) = self.errors(cells)?;
        let (x, x_low, x_high) = self.x;
        let (y, y_low, y_high) = self.y;
        let panel = draw::map(
            self.title,
            (
                plot::Axis::linear(x).between(x_low, x_high),
                plot::Axis::linear(y).between(y_low, y_high),
            ),
            ("error", &BOUNDS),
            values,
        );
        let largest = tally.errors.largest;
        Ok(Drawn {
            panel,
            row: self.row(tally),
            requests: (cells * cells) as u64,
            largest,
        })
    }

    fn row(&self, tally: Tally) -> Vec<Cell> {
        let count = |points: u32| Cell::fixed(f64::from(points), 0);
        let errors = tally.errors;
        let name = Some(self.promise).filter(|name| !name.is_empty());
        let promise = name.map(|name| promises::of(name).largest);
        let [in_loop, reference, over] = self.places;
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
            over.into(),
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
            let (tally, _) = map.errors(cells).unwrap();
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
            let [found, exact, over] = map.places;
            assert_eq!(number("in_loop", found), numbers.found, "{}", sample.line);
            assert_eq!(number("reference", exact), numbers.exact, "{}", sample.line);
            let scale = if over.is_empty() {
                Some(1.0)
            } else {
                number("reference", over)
            };
            assert_eq!(scale, numbers.scale, "{}", sample.line);
        }
    }
}
