//! Pairs of balls over load, friction and clearance: the folded law against the exact pair.

use rayon::prelude::*;
use serde_json::{Value, json};

use crate::document::{Block, Cell, Figure, Table};
use crate::eval;
use crate::plot::{Axis, ColourMap, Colours, Panel};
use crate::report::statistics::Errors;

/// Deviation of one of the balls, degrees: it loads the third contact, or takes load from it.
const DEVIATIONS: [f64; 2] = [2.0, -2.0];

/// Force that is large enough to divide by, N: below it a force is left by nearly equal speeds.
const LEAST_FORCE: f64 = 0.02;

/// Axial load of a ball, N, as decimal logarithms.
const LOADS: (f64, f64) = (0.699, 2.4771);

/// What stands on the vertical axis.
#[derive(Clone, Copy)]
enum Over {
    Friction,
    Clearance,
}

impl Over {
    const ALL: [Self; 2] = [Self::Friction, Self::Clearance];

    fn axis(self) -> (&'static str, f64, f64) {
        match self {
            Self::Friction => ("friction coefficient", 0.03, 0.15),
            Self::Clearance => ("clearance (um)", -5.0, 20.0),
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Friction => "friction 0.03 to 0.15, no play",
            Self::Clearance => "clearance -5 to 20 um, friction 0.1",
        }
    }

    /// The pair of Table 3.6's screw with friction at a place of the axis.
    fn request(self, load: f64, place: f64, degrees: f64, reversed: bool) -> Value {
        let (friction, clearance) = match self {
            Self::Friction => (place, 0.0),
            Self::Clearance => (0.1, 1e-6 * place),
        };
        let ball = |degrees: f64| json!({"screw_deviation": degrees.to_radians(), "nut_deviation": 0.0, "axial_load": -load});
        let mut balls = vec![ball(0.0), ball(degrees)];
        if reversed {
            balls.reverse();
        }
        json!({
            "id": 0, "model": "ball_screw_pair", "pitch_radius": 16.5e-3, "lead": 20e-3, "ball_radius": 2.778e-3,
            "groove_radius": 3.254e-3, "contact_angle": std::f64::consts::FRAC_PI_4, "youngs_modulus": 2.1e11,
            "poisson_ratio": 0.28, "friction": friction, "clearance": clearance, "nut_speed": 1.0, "balls": balls,
        })
    }
}

/// One pair: relative errors of force and torque of the law, and of the closed form's force.
#[derive(Clone, Default)]
struct Found {
    force: Option<f64>,
    torque: Option<f64>,
    closed_form: Option<f64>,
    /// Whether a ball stands in two contacts only.
    two_points: bool,
    request: String,
}

impl Found {
    fn new(over: Over, load: f64, place: f64, degrees: f64) -> Self {
        // The faster ball is behind where they press.
        [degrees < 0.0, degrees > 0.0]
            .into_iter()
            .find_map(|reversed| Self::pressing(&over.request(load, place, degrees, reversed)))
            .unwrap_or_default()
    }

    /// None where the balls do not press in the exact model, or it has no answer.
    fn pressing(request: &Value) -> Option<Self> {
        let request = request.to_string();
        let (in_loop, reference) = eval::both(&request)?;
        let number = |of: &Value, place: &str| of.pointer(place).and_then(Value::as_f64);
        let exact = number(&reference, "/contact_force/0").filter(|force| *force > 0.0)?;
        let off = |place: &str, over: f64| Some(number(&in_loop, place)? / over - 1.0);
        let two_points = reference["loads"].as_array().is_some_and(|balls| {
            balls.iter().any(|loads| {
                (0..4)
                    .filter(|&contact| loads[contact].as_f64() > Some(0.0))
                    .count()
                    < 3
            })
        });
        let forceful = exact >= LEAST_FORCE;
        Some(Self {
            force: off("/contact_force/0", exact).filter(|_| forceful),
            torque: off("/groove_torque", number(&reference, "/groove_torque")?),
            closed_form: off("/closed_form/contact_force/0", exact).filter(|_| forceful),
            two_points,
            request,
        })
    }
}

/// Table and figure.
pub fn blocks(quick: bool) -> Vec<Block> {
    let (columns, lines) = if quick { (8, 3) } else { (26, 20) };
    let mut panels = Vec::new();
    let mut rows = Vec::new();
    for over in Over::ALL {
        for degrees in DEVIATIONS {
            let (_, low, high) = over.axis();
            let grid: Vec<Vec<Found>> = (0..lines)
                .into_par_iter()
                .map(|line| {
                    let place = low + (high - low) * (f64::from(line) + 0.5) / f64::from(lines);
                    (0..columns)
                        .into_par_iter()
                        .map(|column| {
                            let share = (f64::from(column) + 0.5) / f64::from(columns);
                            let load = 10f64.powf(LOADS.0 + (LOADS.1 - LOADS.0) * share);
                            Found::new(over, load, place, degrees)
                        })
                        .collect()
                })
                .collect();
            for (quantity, value) in QUANTITIES {
                panels.push(panel(over, degrees, quantity, &grid, value));
            }
            for two_points in [false, true] {
                rows.extend(row(over, degrees, two_points, &grid));
            }
        }
    }
    vec![
        Block::Table(Table {
            name: "exact_pairs",
            caption: format!(
                "Two balls of Table 3.6's screw, SR and NL loaded with 5 to 300 N, the screw's contact angles of one turned: errors of the law that a step \
                 evaluates, folded over twice the deviation and 2.5 to 600 N, against the exact pair, per cent; forces from {LEAST_FORCE} N. Where both light \
                 contacts of a ball are open one of its grooves sticks. The last column reproduces the largest error of the force"
            ),
            columns: COLUMNS.map(String::from).to_vec(),
            rows,
        }),
        Block::Figure(Figure {
            name: "exact_pairs_maps",
            caption: "Errors of the folded law against the exact pair, per cent: force between the balls and torque of the grooves. A deviation of +2 \
                      degrees loads the third contact, one of -2 degrees takes load from it. Nothing is drawn where balls press with less than 0.02 N \
                      (force), or not at all."
                .into(),
            panels,
            columns: 2,
            size: (540, 400),
        }),
    ]
}

/// A quantity and its error.
type Quantity = (&'static str, fn(&Found) -> Option<f64>);

const QUANTITIES: [Quantity; 2] = [
    ("force", |found| found.force),
    ("torque", |found| found.torque),
];

/// Bounds of the bands, per cent, even about zero.
const BOUNDS: [(f64, &str); 10] = [
    (-10.0, "-10"),
    (-3.0, "-3"),
    (-1.0, "-1"),
    (-0.3, "-0.3"),
    (-0.1, "-0.1"),
    (0.1, "0.1"),
    (0.3, "0.3"),
    (1.0, "1"),
    (3.0, "3"),
    (10.0, "10"),
];

fn panel(
    over: Over,
    degrees: f64,
    quantity: &str,
    grid: &[Vec<Found>],
    value: fn(&Found) -> Option<f64>,
) -> Panel {
    let (label, low, high) = over.axis();
    Panel::Map(ColourMap {
        title: format!("{quantity}, deviation {degrees:+} degrees"),
        x: Axis::linear("log10 of the axial load of a ball (N)").between(LOADS.0, LOADS.1),
        y: Axis::linear(label).between(low, high),
        quantity: "error (%)".into(),
        colours: Colours::Diverging,
        bounds: BOUNDS
            .iter()
            .map(|(bound, text)| (*bound, (*text).to_owned()))
            .collect(),
        values: grid
            .iter()
            .map(|line| {
                line.iter()
                    .map(|found| 100.0 * value(found).unwrap_or(f64::NAN))
                    .collect()
            })
            .collect(),
    })
}

const COLUMNS: [&str; 13] = [
    "over",
    "deviation (deg)",
    "contacts",
    "pairs",
    "force: largest error (%)",
    "rms",
    "mean",
    "within 1 % (%)",
    "torque: largest error (%)",
    "rms",
    "mean",
    "closed form's force, rms (%)",
    "worst case",
];

/// The pairs of which a ball stands in two contacts only, or the others; none where there are none.
fn row(over: Over, degrees: f64, two_points: bool, grid: &[Vec<Found>]) -> Option<Vec<Cell>> {
    let found: Vec<&Found> = grid
        .iter()
        .flatten()
        .filter(|found| found.two_points == two_points && found.torque.is_some())
        .collect();
    let errors = |value: fn(&Found) -> Option<f64>| -> Errors {
        found
            .iter()
            .filter_map(|found| Some(100.0 * value(found)?))
            .collect()
    };
    let (force, torque) = (errors(|found| found.force), errors(|found| found.torque));
    let size = |found: &&&Found| found.force.map_or(0.0, f64::abs);
    let worst = found
        .iter()
        .max_by(|one, other| size(one).total_cmp(&size(other)))?;
    let forces: Vec<f64> = found.iter().filter_map(|found| found.force).collect();
    let close = forces.iter().filter(|error| error.abs() <= 0.01).count();
    Some(vec![
        over.name().into(),
        Cell::fixed(degrees, 0),
        if two_points { "two" } else { "three or four" }.into(),
        Cell::fixed(found.len() as f64, 0),
        Cell::fixed(force.largest, 3),
        Cell::fixed(force.rms(), 3),
        Cell::fixed(force.mean(), 3),
        Cell::fixed(100.0 * close as f64 / forces.len() as f64, 1),
        Cell::fixed(torque.largest, 3),
        Cell::fixed(torque.rms(), 3),
        Cell::fixed(torque.mean(), 3),
        Cell::fixed(errors(|found| found.closed_form).rms(), 1),
        worst.request.clone().into(),
    ])
}
