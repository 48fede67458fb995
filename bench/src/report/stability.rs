//! Errors over whole domains to their edges, with the request that reproduces each worst case.

use epas_friction::promises::{self, Promise};
use serde_json::Value;

use super::Context;
use super::document::{Block, Cell, Figure, Section, Table};
use super::statistics::Errors;
use crate::eval;
use crate::failure::Failure;
use crate::plot::{Axis, ColourMap, Panel};

/// One formula over two of its inputs.
struct Map {
    /// Title of its panel, with what the error is of.
    title: &'static str,
    /// Heading and ends of the horizontal axis.
    x: (&'static str, f64, f64),
    /// Heading and ends of the vertical axis.
    y: (&'static str, f64, f64),
    /// The request at a point.
    request: fn(f64, f64) -> String,
    /// Error of an answer against the reference; none where the quantity does not exist.
    error: fn(&Value, &Value) -> Option<f64>,
    /// What is promised on the promise's own domain, a part of the map.
    promise: &'static Promise,
}

/// A number as f32 holds it, so that the reference computes from the same.
fn exact(number: f64) -> String {
    f64::from(number as f32).to_string()
}

fn difference(in_loop: &Value, reference: &Value, field: &str) -> Option<(f64, f64)> {
    let truth = reference[field].as_f64()?;
    Some((in_loop[field].as_f64()? - truth, truth))
}

const MAPS: [Map; 4] = [
    Map {
        title: "first curvature of the nut, over the second",
        x: ("contact angle (deg)", 0.0, 90.0),
        y: ("lead angle (deg)", 0.0, 90.0),
        request: |contact, lead| {
            format!(
                "{{\"id\":0,\"model\":\"groove_curvature\",\"groove\":\"nut\",\"pitch_radius\":{},\
                 \"lead_angle\":{},\"contact_angle\":{},\"groove_radius\":{},\"offset_h\":{},\"offset_l\":{}}}",
                exact(0.01),
                exact(lead.to_radians()),
                exact(contact.to_radians()),
                exact(0.0018),
                exact(5e-5),
                exact(5e-5),
            )
        },
        error: |in_loop, reference| {
            let (error, _) = difference(in_loop, reference, "kappa1")?;
            Some(error / reference["kappa2"].as_f64()?)
        },
        promise: &promises::GOTHIC_ARCH,
    },
    Map {
        title: "sliding efficiency, absolute, up to the lock",
        x: ("friction", 0.0, 1.0),
        y: ("lead angle (deg)", 0.0, 85.0),
        request: |friction, lead| {
            format!(
                "{{\"id\":0,\"model\":\"efficiency\",\"lead_angle\":{},\"contact_angle\":{},\"friction\":{},\
                 \"ball_ratio\":{}}}",
                exact(lead.to_radians()),
                exact(std::f64::consts::FRAC_PI_4),
                exact(friction),
                exact(0.2),
            )
        },
        error: |in_loop, reference| {
            if reference["locked_drive"].as_bool()? {
                None
            } else {
                difference(in_loop, reference, "sliding_drive").map(|(error, _)| error)
            }
        },
        promise: &promises::EFFICIENCY,
    },
    Map {
        title: "semi-major axis, relative",
        x: ("log10 of the ratio of the radii", 0.0, 4.99),
        y: ("log10 of the load (N)", -3.0, 6.0),
        request: |ratio, load| {
            format!(
                "{{\"id\":0,\"model\":\"hertz\",\"relative_radius_1\":{},\"relative_radius_2\":{},\"load\":{},\
                 \"contact_modulus\":{}}}",
                exact(2.5e-3),
                exact(2.5e-3 * 10f64.powf(ratio)),
                exact(10f64.powf(load)),
                exact(1.139e11),
            )
        },
        error: |in_loop, reference| {
            let (error, truth) = difference(in_loop, reference, "semi_major")?;
            Some(error / truth)
        },
        promise: &promises::HERTZ,
    },
    Map {
        title: "friction force over mu F",
        x: ("axis ratio", 0.05, 1.0),
        y: ("log10 of the offset c/a", -2.0, 2.0),
        request: |ratio, offset| {
            format!(
                "{{\"id\":0,\"model\":\"friction_map\",\"axis_ratio\":{},\"offset\":{}}}",
                exact(ratio),
                exact(10f64.powf(offset)),
            )
        },
        error: |in_loop, reference| difference(in_loop, reference, "force").map(|(error, _)| error),
        promise: &promises::FRICTION_MAP,
    },
];

/// Bounds of the bands: every half decade.
const BOUNDS: [(f64, &str); 10] = [
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
];

impl Map {
    /// The panel and the row of the table.
    fn draw(&self, cells: usize) -> (Panel, Vec<Cell>) {
        let place = |(_, low, high): (&str, f64, f64), index: usize| {
            low + (high - low) * (index as f64 + 0.5) / cells as f64
        };
        let mut errors = Errors::default();
        let mut worst = (0.0, String::new());
        let values = (0..cells)
            .map(|row| {
                (0..cells)
                    .map(|column| {
                        let request = (self.request)(place(self.x, column), place(self.y, row));
                        let error = eval::both(&request)
                            .and_then(|(in_loop, reference)| (self.error)(&in_loop, &reference));
                        let Some(error) = error else {
                            return f64::NAN;
                        };
                        errors.add(error);
                        if error.abs() > worst.0 {
                            worst = (error.abs(), request);
                        }
                        error.abs()
                    })
                    .collect()
            })
            .collect();
        let (x, x_low, x_high) = self.x;
        let (y, y_low, y_high) = self.y;
        let panel = Panel::Map(ColourMap {
            title: self.title.into(),
            x: Axis::linear(x).between(x_low, x_high),
            y: Axis::linear(y).between(y_low, y_high),
            quantity: "error".into(),
            bounds: BOUNDS
                .iter()
                .map(|(bound, text)| (*bound, (*text).to_owned()))
                .collect(),
            values,
        });
        let row = vec![
            self.title.into(),
            Cell::power(errors.largest),
            Cell::power(errors.rms()),
            Cell::power(errors.mean()),
            Cell::power(self.promise.largest),
            worst.1.into(),
        ];
        (panel, row)
    }
}

/// The table of promises.
fn table_of_promises() -> Table {
    Table {
        name: "promises",
        caption: "What the functions of the loop promise; cycles of a Cortex-M4F, ceilings".into(),
        columns: [
            "function",
            "domain",
            "error",
            "largest",
            "rms",
            "mean",
            "outside",
            "NaN, infinities",
            "cycles",
        ]
        .map(String::from)
        .to_vec(),
        rows: promises::ALL
            .iter()
            .map(|promise| {
                vec![
                    promise.function.into(),
                    promise.domain.into(),
                    promise.error.into(),
                    Cell::power(promise.largest),
                    Cell::power(promise.rms),
                    Cell::power(promise.mean),
                    promise.outside.into(),
                    promise.not_finite.into(),
                    Cell::fixed(f64::from(promise.cycles), 0),
                ]
            })
            .collect(),
    }
}

/// The section.
// As every section.
#[allow(clippy::unnecessary_wraps)]
pub fn section(context: &Context) -> Result<Section, Failure> {
    let cells = if context.quick { 24 } else { 60 };
    let (panels, rows) = MAPS.iter().map(|map| map.draw(cells)).unzip();
    Ok(Section {
        title: "Stability",
        blocks: vec![
            Block::Text(
                "Errors over whole domains, to their edges: what is promised holds on the domain that the \
                 promise names. The last column is a line for `epas-bench eval` that reproduces the worst case."
                    .into(),
            ),
            Block::Table(Table {
                name: "stability",
                caption: "Worst cases over the maps below".into(),
                columns: ["quantity", "largest", "rms", "mean", "promised", "worst case"]
                    .map(String::from)
                    .to_vec(),
                rows,
            }),
            Block::Figure(Figure {
                name: "stability_maps",
                caption: "Errors of the formulas in f32 against the reference, from the same numbers; nothing is \
                          drawn where a request is refused or the quantity does not exist."
                    .into(),
                panels,
                columns: 2,
                size: (540, 420),
            }),
            Block::Table(table_of_promises()),
        ],
    })
}
