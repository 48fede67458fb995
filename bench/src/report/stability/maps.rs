//! Errors over whole domains: every map is made of requests of `eval`.

use std::f64::consts::FRAC_PI_4;
use std::fmt::Write as _;

use epas_reference::promises;
use serde_json::Value;

use crate::report::statistics::Errors;
use crate::study::turned_ball;
use epas_page::document::Cell;
use epas_page::plot::{Axis, ColourMap, Colours, Panel};

/// One formula over two of its inputs.
pub struct Map {
    /// Title of its panel, with what the error is of.
    title: &'static str,
    /// Heading and ends of the horizontal axis.
    x: (&'static str, f64, f64),
    /// Heading and ends of the vertical axis.
    y: (&'static str, f64, f64),
    /// The request at a point.
    request: fn(f64, f64) -> String,
    /// Where the value stands in `in_loop` and in `reference`, as JSON pointers.
    value: (&'static str, &'static str),
    /// Number of the reference that the error is divided by; none for an absolute error.
    over: Option<&'static str>,
    /// Flag of the reference under which the quantity does not count.
    unless: Option<&'static str>,
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
    request: |_, _| String::new(),
    value: ("", ""),
    over: None,
    unless: None,
    promise: None,
    fineness: 1.0,
};

/// A number as f32 holds it, so that the reference computes from the same.
fn exact(number: f64) -> String {
    f64::from(number as f32).to_string()
}

/// A request of `model` with the fields in the order given.
fn request(model: &str, fields: &[(&str, f64)]) -> String {
    let mut line = format!("{{\"id\":0,\"model\":\"{model}\"");
    for (name, value) in fields {
        let _ = write!(line, ",\"{name}\":{}", exact(*value));
    }
    line.push('}');
    line
}

/// A groove of 3.6 mm across on a pitch radius of 10 mm, all lengths times `scale`.
fn groove(side: &str, contact_degrees: f64, lead_degrees: f64, scale: f64) -> String {
    let line = request(
        "groove_curvature",
        &[
            ("pitch_radius", 0.01 * scale),
            ("lead_angle", lead_degrees.to_radians()),
            ("contact_angle", contact_degrees.to_radians()),
            ("groove_radius", 0.0018 * scale),
            ("offset_h", 5e-5 * scale),
            ("offset_l", 5e-5 * scale),
        ],
    );
    line.replacen(",\"pitch", &format!(",\"groove\":\"{side}\",\"pitch"), 1)
}

/// A screw's groove around a ball, met at 45 degrees.
fn hugging(conformity: f64, ball_ratio: f64) -> String {
    let (pitch_radius, ball_radius) = (0.01, 0.01 * ball_ratio);
    let groove_radius = 2.0 * conformity * ball_radius;
    let offset = (groove_radius - ball_radius) * std::f64::consts::FRAC_1_SQRT_2;
    let line = request(
        "groove_curvature",
        &[
            ("pitch_radius", pitch_radius),
            ("lead_angle", 0.2),
            ("contact_angle", FRAC_PI_4),
            ("groove_radius", groove_radius),
            ("offset_h", offset),
            ("offset_l", offset),
        ],
    );
    line.replacen(",\"pitch", ",\"groove\":\"screw\",\"pitch", 1)
}

fn efficiency(friction: f64, lead_degrees: f64, contact_degrees: f64, ball_ratio: f64) -> String {
    request(
        "efficiency",
        &[
            ("lead_angle", lead_degrees.to_radians()),
            ("contact_angle", contact_degrees.to_radians()),
            ("friction", friction),
            ("ball_ratio", ball_ratio),
        ],
    )
}

fn ellipse(ratio: f64, load: f64, radius: f64, modulus: f64) -> String {
    request(
        "hertz",
        &[
            ("relative_radius_1", radius),
            ("relative_radius_2", radius * ratio),
            ("load", load),
            ("contact_modulus", modulus),
        ],
    )
}

fn kinematics(lead_degrees: f64, contact_degrees: f64, pitch_degrees: f64, speed: f64) -> String {
    let radius = 0.00397;
    request(
        "contact_kinematics",
        &[
            ("ball_diameter", 2.0 * radius),
            ("pitch_radius", 0.01925),
            ("lead_angle", lead_degrees.to_radians()),
            ("groove_radius_screw", 0.0042),
            ("groove_radius_nut", 0.0042),
            ("contact_angle_screw", contact_degrees.to_radians()),
            ("contact_angle_nut", contact_degrees.to_radians()),
            ("pitch_angle", pitch_degrees.to_radians()),
            ("yaw_angle", 0.0),
            ("rolling_radius_screw", 0.998 * radius),
            ("rolling_radius_nut", 0.998 * radius),
            ("speed", speed),
            ("semi_major_screw", 2e-4),
            ("semi_minor_screw", 4e-5),
            ("semi_major_nut", 2e-4),
            ("semi_minor_nut", 4e-5),
        ],
    )
}

fn list(numbers: impl IntoIterator<Item = f64>) -> String {
    let numbers: Vec<_> = numbers.into_iter().map(exact).collect();
    format!("[{}]", numbers.join(","))
}

/// Balls of Lin 2019, Table 3.3, with the bottom groove turned, under side forces.
fn linear(balls: impl IntoIterator<Item = (f64, f64)>) -> String {
    let head = request(
        "linear_train",
        &[
            ("ball_radius", 0.005),
            ("conformity", 0.56),
            ("nominal_contact_angle", FRAC_PI_4),
            ("youngs_modulus", 2.1e11),
            ("poisson_ratio", 0.3),
            ("friction", 0.1),
            ("speed", 0.5),
        ],
    );
    let balls: Vec<_> = balls
        .into_iter()
        .map(|(degrees, side)| {
            let ball = turned_ball(degrees, side);
            format!(
                "{{\"contact_angles\":{},\"contact_forces\":{}}}",
                list(ball.contact_angles),
                list(ball.contact_forces)
            )
        })
        .collect();
    format!(
        "{},\"balls\":[{}]}}",
        head.trim_end_matches('}'),
        balls.join(",")
    )
}

fn power(exponent: f64) -> f64 {
    10f64.powf(exponent)
}

/// Every map.
pub const MAPS: [Map; 18] = [
    Map {
        title: "first curvature of the nut, over the second",
        x: ("contact angle (deg)", 0.0, 90.0),
        y: ("lead angle (deg)", 0.0, 90.0),
        request: |contact, lead| groove("nut", contact, lead, 1.0),
        value: ("/kappa1", "/kappa1"),
        over: Some("/kappa2"),
        promise: Some("gothic_arch"),
        ..PLAIN
    },
    Map {
        title: "first curvature of the screw, over the second",
        x: ("contact angle (deg)", 0.0, 90.0),
        y: ("lead angle (deg)", 0.0, 90.0),
        request: |contact, lead| groove("screw", contact, lead, 1.0),
        value: ("/kappa1", "/kappa1"),
        over: Some("/kappa2"),
        promise: Some("gothic_arch"),
        ..PLAIN
    },
    Map {
        title: "fitted curvature of the nut, over the second",
        x: ("contact angle (deg)", 0.0, 90.0),
        y: ("lead angle (deg)", 0.0, 90.0),
        request: |contact, lead| groove("nut", contact, lead, 1.0),
        value: ("/fitted", "/kappa1"),
        over: Some("/kappa2"),
        promise: Some("fitted_curvature"),
        ..PLAIN
    },
    Map {
        title: "first curvature of the screw until it folds",
        x: ("conformity", 0.5, 1.0),
        y: ("ball ratio", 0.0, 1.0),
        request: hugging,
        value: ("/kappa1", "/kappa1"),
        over: Some("/kappa1"),
        promise: Some("gothic_arch"),
        ..PLAIN
    },
    Map {
        title: "first curvature of the nut, nm to km",
        x: ("log10 of all lengths over 10 mm", -7.0, 5.0),
        y: ("contact angle (deg)", 0.0, 90.0),
        request: |scale, contact| groove("nut", contact, 10.0, power(scale)),
        value: ("/kappa1", "/kappa1"),
        over: Some("/kappa2"),
        promise: Some("gothic_arch"),
        ..PLAIN
    },
    Map {
        title: "sliding efficiency, absolute, up to the lock",
        x: ("friction", 0.0, 1.0),
        y: ("lead angle (deg)", 0.0, 85.0),
        request: |friction, lead| efficiency(friction, lead, 45.0, 0.2),
        value: ("/sliding_drive", "/sliding_drive"),
        unless: Some("/locked_drive"),
        promise: Some("efficiency"),
        ..PLAIN
    },
    Map {
        title: "back-driving efficiency, absolute, from the lock",
        x: ("friction", 0.0, 1.0),
        y: ("lead angle (deg)", 0.0, 85.0),
        request: |friction, lead| efficiency(friction, lead, 45.0, 0.2),
        value: ("/sliding_backdrive", "/sliding_backdrive"),
        unless: Some("/locked_backdrive"),
        promise: Some("efficiency"),
        ..PLAIN
    },
    Map {
        title: "loss 1 - efficiency, relative, up to the lock",
        x: ("log10 of the friction", -7.0, 0.0),
        y: ("lead angle (deg)", 0.0, 85.0),
        request: |friction, lead| efficiency(power(friction), lead, 45.0, 0.2),
        value: ("/loss_drive", "/loss_drive"),
        over: Some("/loss_drive"),
        unless: Some("/locked_drive"),
        ..PLAIN
    },
    Map {
        title: "rolling efficiency, absolute, where driving does not lock",
        x: ("contact angle (deg)", 0.0, 90.0),
        y: ("ball ratio", 0.0, 1.0),
        request: |contact, ratio| efficiency(0.1, 10.0, contact, ratio),
        value: ("/rolling_screw", "/rolling_screw"),
        unless: Some("/locked_drive"),
        promise: Some("efficiency"),
        ..PLAIN
    },
    Map {
        title: "efficiency with the dynamic correction, absolute",
        x: ("speed (rad/s)", 0.0, 500.0),
        y: ("log10 of the load of a ball (N)", 0.0, 6.0),
        request: |speed, load| {
            request(
                "steady_state",
                &[
                    ("lead_angle", 0.2),
                    ("contact_angle", FRAC_PI_4),
                    ("friction", 0.1),
                    ("ball_radius", 0.003),
                    ("pitch_radius", 0.015),
                    ("speed", speed),
                    ("axial_load", power(load)),
                ],
            )
        },
        value: ("/efficiency", "/efficiency"),
        ..PLAIN
    },
    Map {
        title: "rolling slip over the entrainment speed",
        x: ("lead angle (deg)", -68.0, 68.0),
        y: ("contact angle (deg)", -90.0, 90.0),
        request: |lead, contact| kinematics(lead, contact, 40.0, 100.0),
        value: ("/screw/rolling_slip", "/screw/rolling_slip"),
        over: Some("/screw/entrainment_speed"),
        promise: Some("kinematics"),
        ..PLAIN
    },
    Map {
        // Subnormal numbers have fewer digits, down to one.
        title: "orbital speed, relative, smallest normal speeds to 1e6",
        x: ("log10 of the speed (rad/s)", -36.0, 6.0),
        y: ("pitch angle (deg)", -90.0, 90.0),
        request: |speed, pitch| kinematics(10.0, 45.0, pitch, power(speed)),
        value: ("/orbital_speed", "/orbital_speed"),
        over: Some("/orbital_speed"),
        ..PLAIN
    },
    Map {
        title: "semi-major axis, relative",
        x: ("log10 of the ratio of the radii", 0.0, 4.99),
        y: ("log10 of the load (N)", -3.0, 6.0),
        request: |ratio, load| ellipse(power(ratio), power(load), 2.5e-3, 1.139e11),
        value: ("/semi_major", "/semi_major"),
        over: Some("/semi_major"),
        promise: Some("hertz"),
        ..PLAIN
    },
    Map {
        title: "largest pressure, relative, nm to km",
        x: ("log10 of the radius (m)", -9.0, 3.0),
        y: ("log10 of the contact modulus (Pa)", 5.0, 14.0),
        request: |radius, modulus| ellipse(8.0, 100.0, power(radius), power(modulus)),
        value: ("/max_pressure", "/max_pressure"),
        over: Some("/max_pressure"),
        promise: Some("hertz"),
        ..PLAIN
    },
    Map {
        title: "friction force over mu F",
        x: ("axis ratio", 0.05, 1.0),
        y: ("log10 of the offset c/a", -2.0, 2.0),
        request: |ratio, offset| {
            request(
                "friction_map",
                &[("axis_ratio", ratio), ("offset", power(offset))],
            )
        },
        value: ("/force", "/force"),
        promise: Some("friction_map"),
        ..PLAIN
    },
    Map {
        title: "moment of slender contacts over mu F a",
        x: ("log10 of the axis ratio", -2.0, 0.0),
        y: ("log10 of the offset c/a", -9.0, 9.0),
        request: |ratio, offset| {
            request(
                "friction_map",
                &[("axis_ratio", power(ratio)), ("offset", power(offset))],
            )
        },
        value: ("/moment", "/moment"),
        ..PLAIN
    },
    Map {
        title: "speed of a linear ball, closed form, over v/2",
        x: ("side force over normal force", -1.0, 1.0),
        y: ("deviation (deg)", -3.0, 3.0),
        request: |side, degrees| linear([(degrees, side)]),
        value: ("/analytic/speed_deviation/0", "/speed_deviation/0"),
        promise: Some("analytic_ball"),
        ..PLAIN
    },
    Map {
        title: "force between the rear two of a row of linear balls, relative",
        x: ("balls", 2.0, 64.0),
        y: ("deviation (deg)", 0.5, 3.0),
        request: |balls, degrees| {
            let balls = balls.round() as u32;
            // Side forces that rise from rear to front: every ball presses on the next.
            linear((0..balls).map(|ball| {
                let place = f64::from(ball) / f64::from(balls - 1);
                (degrees, 0.6 * (2.0 * place - 1.0))
            }))
        },
        value: ("/scene/contact_force/0", "/contact_force/0"),
        over: Some("/contact_force/0"),
        fineness: 0.25,
        ..PLAIN
    },
];

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
pub const COLUMNS: [&str; 10] = [
    "quantity",
    "inputs",
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

/// What became of one request.
enum Outcome {
    /// Error of the in-loop value.
    Error(f64),
    /// Refused, or the quantity does not exist.
    Nothing,
    /// The reference has a number, the crate none.
    NoValue,
}

impl Map {
    fn outcome(&self, request: &str) -> Outcome {
        let Some((in_loop, reference)) = epas_eval::both(request) else {
            return Outcome::Nothing;
        };
        let flagged = |flag: &str| reference.pointer(flag).and_then(Value::as_bool) == Some(true);
        let number = |pointer: &str| reference.pointer(pointer).and_then(Value::as_f64);
        let Some(truth) = number(self.value.1) else {
            return Outcome::Nothing;
        };
        if self.unless.is_some_and(flagged) {
            return Outcome::Nothing;
        }
        let Some(found) = in_loop.pointer(self.value.0).and_then(Value::as_f64) else {
            return Outcome::NoValue;
        };
        let scale = match self.over {
            None => 1.0,
            Some(pointer) => match number(pointer) {
                Some(scale) if scale != 0.0 => scale,
                _ => return Outcome::Nothing,
            },
        };
        Outcome::Error((found - truth) / scale)
    }

    /// The map over its domain.
    pub fn draw(&self, cells: usize) -> Drawn {
        let cells = (cells as f64 * self.fineness).ceil() as usize;
        let place = |(_, low, high): (&str, f64, f64), index: usize| {
            low + (high - low) * (index as f64 + 0.5) / cells as f64
        };
        let mut errors = Errors::default();
        let (mut inputs, mut missing) = (0_u32, 0_u32);
        let mut worst = (0.0, String::new());
        let values = (0..cells)
            .map(|row| {
                (0..cells)
                    .map(|column| {
                        let request = (self.request)(place(self.x, column), place(self.y, row));
                        match self.outcome(&request) {
                            Outcome::Error(error) => {
                                inputs += 1;
                                errors.add(error);
                                if error.abs() >= worst.0 {
                                    worst = (error.abs(), request);
                                }
                                error.abs()
                            }
                            Outcome::Nothing => f64::NAN,
                            Outcome::NoValue => {
                                missing += 1;
                                f64::NAN
                            }
                        }
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
            colours: Colours::Sequential,
            bounds: BOUNDS
                .iter()
                .map(|(bound, text)| (*bound, (*text).to_owned()))
                .collect(),
            values,
        });
        let (in_loop, reference) = self.value;
        let row = vec![
            if missing == 0 {
                self.title.into()
            } else {
                format!("{} ({missing} without a value in the loop)", self.title).into()
            },
            Cell::fixed(f64::from(inputs), 0),
            Cell::power(errors.largest),
            Cell::power(errors.rms()),
            Cell::power(errors.mean()),
            promised(
                self.promise.map(|name| promises::of(name).largest),
                errors.largest,
            ),
            in_loop.into(),
            reference.into(),
            self.over.unwrap_or("").into(),
            Cell::Code(worst.1),
        ];
        Drawn {
            panel,
            row,
            requests: (cells * cells) as u64,
            largest: errors.largest,
        }
    }
}
