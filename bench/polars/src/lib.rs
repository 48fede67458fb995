//! Studies of ball-screw designs as a Polars expression: a row of numbers of a design in, a row of figures out.
//!
//! Figures are those of [`epas_rows::design_study`]; nothing is computed here. A row follows from its own numbers alone, so that
//! any partition of a table, on threads or machines, has the same answer to the bit.

mod plugin;

use epas_rows::design_study::{Design, Duty, Figures, figures};
use polars_core::error::{PolarsResult, polars_bail};
use polars_core::prelude::{
    DataType, Field, Float32Chunked, IntoSeries, NewChunkedArray, Series, StringChunked,
    StructChunked, UInt32Chunked,
};
use pyo3::prelude::pymodule;
use serde::Deserialize;

/// Loads and settings of all rows, in SI units.
#[derive(Deserialize)]
struct Settings {
    axial_load: f64,
    turns: f64,
    friction: f64,
    ball_friction: f64,
    deviation: f64,
}

impl Settings {
    fn duty(&self) -> Duty {
        Duty {
            axial_load: self.axial_load as f32,
            turns: self.turns as f32,
            friction: self.friction as f32,
            ball_friction: self.ball_friction as f32,
            deviation: self.deviation as f32,
        }
    }
}

/// Columns of a design, in the order of the expression's inputs.
const INPUTS: [&str; 6] = [
    "pitch_radius",
    "lead",
    "ball_radius",
    "conformity",
    "contact_angle",
    "preload",
];

/// Fields of the figures, and why a row has none.
fn output() -> Field {
    let number = |name: &str| Field::new(name.into(), DataType::Float32);
    Field::new(
        "figures".into(),
        DataType::Struct(vec![
            Field::new("loaded_balls".into(), DataType::UInt32),
            number("friction_torque"),
            number("efficiency"),
            number("max_pressure"),
            number("contact_force"),
            Field::new("refused".into(), DataType::String),
        ]),
    )
}

/// A column as `f32`, as long as the longest; a literal stands for every row.
fn column(input: &Series, name: &str, rows: usize) -> PolarsResult<Float32Chunked> {
    if !input.dtype().is_primitive_numeric() {
        polars_bail!(InvalidOperation: "column {name} holds {}, and numbers are wanted", input.dtype());
    }
    let numbers = input.cast(&DataType::Float32)?;
    match numbers.len() {
        length if length == rows => numbers.f32().cloned(),
        1 => numbers.new_from_index(0, rows).f32().cloned(),
        length => polars_bail!(ShapeMismatch: "column {name} has {length} rows of {rows}"),
    }
}

/// Figures of each design; a row with a missing or refused number has none, and says why.
fn design_figures(inputs: &[Series], settings: &Settings) -> PolarsResult<Series> {
    if inputs.len() != INPUTS.len() {
        polars_bail!(InvalidOperation: "designs have the columns {}", INPUTS.join(", "));
    }
    let rows = if inputs.iter().any(|input| input.is_empty()) {
        0
    } else {
        inputs.iter().map(|input| input.len()).max().unwrap_or(0)
    };
    let columns = inputs
        .iter()
        .zip(INPUTS)
        .map(|(input, name)| column(input, name, rows))
        .collect::<PolarsResult<Vec<_>>>()?;
    let duty = settings.duty();
    let found: Vec<_> = (0..rows)
        .map(|row| {
            let number = |at: usize| {
                columns[at]
                    .get(row)
                    .ok_or_else(|| format!("{} is missing", INPUTS[at]))
            };
            let design = Design {
                pitch_radius: number(0)?,
                lead: number(1)?,
                ball_radius: number(2)?,
                conformity: number(3)?,
                contact_angle: number(4)?,
                preload: number(5)?,
            };
            figures(&design, &duty).map_err(|error| error.to_string())
        })
        .collect();
    answer(&found)
}

fn answer(found: &[Result<Figures, String>]) -> PolarsResult<Series> {
    let numbers = |name: &str, of: fn(&Figures) -> f32| -> Series {
        let values = found.iter().map(|row| row.as_ref().ok().map(of));
        // A force that is no number does not exist.
        let known = values.map(|value| value.filter(|value| value.is_finite()));
        Float32Chunked::from_iter_options(name.into(), known).into_series()
    };
    let balls = found.iter().map(|row| {
        row.as_ref()
            .ok()
            .map(|figures| u32::from(figures.loaded_balls))
    });
    let refused = found
        .iter()
        .map(|row| row.as_ref().err().map(String::as_str));
    let fields = [
        UInt32Chunked::from_iter_options("loaded_balls".into(), balls).into_series(),
        numbers("friction_torque", |row| row.friction_torque),
        numbers("efficiency", |row| row.efficiency),
        numbers("max_pressure", |row| row.max_pressure),
        numbers("contact_force", |row| row.contact_force),
        StringChunked::from_iter_options("refused".into(), refused).into_series(),
    ];
    Ok(StructChunked::from_series("figures".into(), found.len(), fields.iter())?.into_series())
}

/// The library of the Python package; the engine finds the expression in it by its name.
#[pymodule]
mod _polars {}
