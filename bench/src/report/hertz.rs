//! The contact ellipse against exact elliptic integrals.

use epas_friction::HertzContact;
use epas_reference::ReferenceError;
use epas_reference::hertz::Hertz;

use super::Context;
use super::document::{Block, Cell, Figure, Section, Table};
use crate::failure::Failure;
use crate::plot::{Axis, Chart, Mark, Panel, Series, render};

const QUANTITIES: [&str; 5] = [
    "axis ratio",
    "semi-major axis",
    "semi-minor axis",
    "deflection",
    "pressure",
];

/// Relative errors at one ratio of the relative radii.
struct Point {
    ratio: f64,
    axis_ratio: f64,
    errors: [f64; 5],
}

fn point(ratio: f64) -> Result<Point, Failure> {
    const SMALL: f32 = 3e-3;
    const MODULUS: f32 = 113.932_29e9;
    const LOAD: f32 = 100.0;
    let small = f64::from(SMALL);
    // What the two have in common is what f32 can hold.
    let large = (small * ratio) as f32;
    let contact = HertzContact::checked(SMALL, large, MODULUS)
        .map_err(|error| Failure::Data(error.to_string()))?;
    let truth = Hertz::new(small, large.into(), MODULUS.into())
        .map_err(|error: ReferenceError| Failure::Data(error.to_string()))?;
    let (found, expected) = (contact.at(LOAD), truth.at(LOAD.into()));
    let error = |found: f32, expected: f64| (f64::from(found) / expected - 1.0).abs();
    Ok(Point {
        ratio,
        axis_ratio: truth.axis_ratio,
        errors: [
            error(contact.axis_ratio(), truth.axis_ratio),
            error(found.semi_major, expected.semi_major),
            error(found.semi_minor, expected.semi_minor),
            error(found.deflection, expected.deflection),
            error(found.max_pressure, expected.max_pressure),
        ],
    })
}

/// The section.
pub fn section(context: &Context) -> Result<Section, Failure> {
    let count = if context.quick { 200 } else { 1000 };
    let points = (0..=count)
        .map(|index| point(10f64.powf(4.9 * f64::from(index) / f64::from(count))))
        .collect::<Result<Vec<_>, _>>()?;
    let mut table = Table::new(
        "hertz-errors",
        "Errors of the contact ellipse in f32 against exact elliptic integrals in float64 (relative)",
        &["relative radii", "quantity", "largest", "rms"],
    );
    for (name, (low, high)) in [
        ("ratio 1 to 79 000", (0.0, f64::INFINITY)),
        ("ratio 5 to 30, ball screws", (5.0, 30.0)),
    ] {
        let inside: Vec<_> = points
            .iter()
            .filter(|point| (low..=high).contains(&point.ratio))
            .collect();
        for (index, quantity) in QUANTITIES.iter().enumerate() {
            let errors = inside.iter().map(|point| point.errors[index]);
            let largest = errors.clone().fold(0.0, f64::max);
            let square = errors.map(|error| error * error).sum::<f64>() / inside.len() as f64;
            table.rows.push(vec![
                Cell::text(name),
                Cell::text(*quantity),
                Cell::error(largest),
                Cell::error(square.sqrt()),
            ]);
        }
    }
    let ellipse = context.time("hertz_ellipse")?;
    let setup = context.time("hertz_setup")?;
    Ok(Section {
        id: "hertz",
        title: "Contact ellipse: errors over the ratio of the relative radii",
        blocks: vec![
            Block::text(format!(
                "Axis ratio, semi-axes, deflection and pressure of a Hertzian contact without elliptic \
                 integrals in the loop: the axis ratio is a rational function, the integrals are five \
                 steps of the arithmetic-geometric mean, once per design or contact angle. On this \
                 machine the constants take {:.0} ns (exact groove curvatures included), and the \
                 ellipse under a load {:.1} ns (latency).",
                setup.latency.median, ellipse.latency.median
            )),
            Block::Table(table),
            Block::Figure(figure(&points)?),
        ],
    })
}

fn figure(points: &[Point]) -> Result<Figure, Failure> {
    let series = QUANTITIES
        .iter()
        .enumerate()
        .map(|(index, quantity)| {
            let curve = points
                .iter()
                .map(|point| (point.ratio, point.errors[index].max(1e-9)))
                .collect();
            Series::new(quantity, index, Mark::Line, curve)
        })
        .collect();
    let chart = Chart {
        title: "Contact ellipse in f32 against exact elliptic integrals".into(),
        x: Axis::log("ratio of the relative radii"),
        y: Axis::log("relative error").between(1e-9, 1e-4),
        series,
        notes: Vec::new(),
    };
    let mut columns = vec!["ratio of the relative radii", "true axis ratio"];
    columns.extend(QUANTITIES);
    let mut data = Table::new(
        "hertz",
        "Relative error of the contact ellipse over the ratio of the relative radii. Errors below 1e-9 \
         are drawn there.",
        &columns,
    );
    for point in points {
        let mut cells = vec![Cell::raw(point.ratio), Cell::raw(point.axis_ratio)];
        cells.extend(point.errors.map(Cell::raw));
        data.rows.push(cells);
    }
    Ok(Figure {
        svg: render(&[Panel::Chart(chart)], 1, (900, 460))?,
        data,
    })
}
