//! Balls that are about to lose what holds them: near two-point contact.

use std::f64::consts::FRAC_PI_4;

use epas_friction::ball::{AnalyticLinearBall, GrooveFit, PUBLISHED_SLOPE, RowContacts, ScrewRow};
use epas_friction::refined::{FourPointBall, ScrewBall};
use epas_friction::{BallScrew, LoadShare};
use epas_reference::friction::linear_ball::LinearBall;
use serde_json::Value;

use super::maps;
use crate::document::{Block, Cell, Figure, Table};
use crate::eval;
use crate::failure::Failure;
use crate::plot::{Axis, Chart, Mark, Panel, Series};
use crate::report::context::Context;
use crate::study::{self, turned_ball};

fn failure(error: epas_friction::Error) -> Failure {
    Failure::Data(error.to_string())
}

/// Deviations of the bottom groove, degrees: a side force to the right loads the diagonal whose angle grows,
/// or the other one.
const TURNS: [f64; 6] = [-3.0, -2.0, -1.0, 1.0, 2.0, 3.0];
/// Side-force ratios over which a border is looked for.
const SIDES: (f64, f64) = (0.7, 0.998);
const STEPS: u32 = 150;
/// How far from the border, in side-force ratios, the speeds before and after it are taken.
const BESIDE: f64 = 1e-3;

/// Where the speed of a ball in a linear bearing jumps.
struct Border {
    side: f64,
    before: f64,
    after: f64,
}

impl Border {
    fn of(degrees: f64) -> Result<Self, Failure> {
        let speed = |side: f64| -> Result<f64, Failure> {
            Ok(turned_ball(degrees, side).solve(1.0)?.speed_deviation)
        };
        let (low, high) = SIDES;
        let place = |step: u32| low + (high - low) * f64::from(step) / f64::from(STEPS);
        let mut found = Self {
            side: low,
            before: 0.0,
            after: 0.0,
        };
        let mut last = speed(low)?;
        for step in 1..=STEPS {
            let now = speed(place(step))?;
            if (now - last).abs() > (found.after - found.before).abs() {
                found = Self {
                    side: place(step),
                    before: last,
                    after: now,
                };
            }
            last = now;
        }
        let mut width = (high - low) / f64::from(STEPS);
        while width > 1e-6 {
            width *= 0.5;
            let middle = speed(found.side - width)?;
            if (middle - found.before).abs() < (middle - found.after).abs() {
                found.before = middle;
            } else {
                found.after = middle;
                found.side -= width;
            }
        }
        // At the jump itself all motions in between lose the same power.
        found.before = speed(found.side - BESIDE)?;
        found.after = speed(found.side + BESIDE)?;
        Ok(found)
    }
}

/// Load of the weaker diagonal over that of the stronger one.
fn weakness(ball: &LinearBall) -> f64 {
    let [bottom_left, bottom_right, top_right, top_left] = ball.contact_forces;
    let (up, down) = (bottom_left + top_right, bottom_right + top_left);
    up.min(down) / up.max(down)
}

/// Both forms of a ball in a linear bearing.
struct Linear {
    analytic: AnalyticLinearBall,
    ball: FourPointBall,
}

impl Linear {
    fn new() -> Result<Self, Failure> {
        let parameters = study::linear_ball();
        Ok(Self {
            analytic: AnalyticLinearBall::new(&parameters, PUBLISHED_SLOPE).map_err(failure)?,
            ball: FourPointBall::linear(&parameters).map_err(failure)?,
        })
    }

    /// Speed deviation in closed form, and refined.
    fn speeds(&self, ball: &LinearBall) -> [f64; 2] {
        let angles = ball.contact_angles.map(|angle| angle as f32);
        let forces = ball.contact_forces.map(|force| force as f32);
        let closed = self.analytic.speed_deviation(&angles, &forces);
        let refined = self.ball.solve(&self.ball.contacts(&angles, &forces));
        [closed.speed_deviation, refined.speed_deviation].map(f64::from)
    }

    /// Row of the table: border, jump, and largest errors before, about and after it.
    fn row(&self, degrees: f64) -> Result<Vec<Cell>, Failure> {
        /// About the border: within this of its side-force ratio.
        const NEAR: f64 = 0.01;
        let border = Border::of(degrees)?;
        let mut worst = [[0.0_f64; 3]; 2];
        for step in 0..=STEPS {
            let side = SIDES.0 + (1.0 - SIDES.0) * f64::from(step) / f64::from(STEPS);
            let ball = turned_ball(degrees, side);
            let exact = ball.solve(1.0)?.speed_deviation;
            let part = if (side - border.side).abs() < NEAR {
                1
            } else {
                usize::from(side > border.side) * 2
            };
            for (found, worst) in self.speeds(&ball).into_iter().zip(&mut worst) {
                worst[part] = worst[part].max((found - exact).abs());
            }
        }
        let [closed, refined] = worst;
        Ok([
            Cell::fixed(degrees, 0),
            Cell::fixed(border.side, 4),
            Cell::fixed(weakness(&turned_ball(degrees, border.side)), 4),
            Cell::power(border.before),
            Cell::power(border.after),
        ]
        .into_iter()
        .chain(closed.into_iter().chain(refined).map(Cell::power))
        .collect())
    }

    fn chart(&self, degrees: f64) -> Result<Panel, Failure> {
        let mut lines = [const { Vec::new() }; 3];
        for step in 0..=400_u32 {
            let ball = turned_ball(degrees, 0.999 * f64::from(step) / 400.0);
            let [closed, refined] = self.speeds(&ball);
            let exact = ball.solve(1.0)?.speed_deviation;
            for (line, speed) in lines.iter_mut().zip([closed, refined, exact]) {
                line.push((weakness(&ball), speed));
            }
        }
        let [closed, refined, exact] = lines;
        Ok(Panel::Chart(Chart {
            title: format!("ball of a linear bearing, deviation {degrees} degrees"),
            x: Axis::log("load of the weaker diagonal over the stronger").between(1e-3, 1.0),
            y: Axis::linear("speed deviation over v/2"),
            series: vec![
                Series::new("closed form (3.43)", 1, Mark::Line, closed),
                Series::new("refined", 0, Mark::Line, refined),
                Series::new("reference", 6, Mark::Dashed, exact),
            ],
            notes: Vec::new(),
        }))
    }
}

/// Load of a main contact of the ball of a ball screw, N.
const MAIN: f64 = 75.0;

/// What holds the ball of a ball screw, by the load of its third contact over the main ones.
const REGIMES: [(&str, f64, f64); 4] = [
    ("three contacts: the third one is pinned", 0.063, 1.0),
    ("three contacts: the third one slides", 1e-3, 0.063),
    ("about the change of the race that sticks", 1e-4, 1e-3),
    ("two contacts: one race sticks", 0.0, 1e-4),
];

struct ScrewPoint {
    third: f64,
    closed: f64,
    refined: f64,
    exact: Option<f64>,
}

/// The orbital speed over the nut's at one load of the third contact.
fn screw_point(ball: &ScrewBall, third: f64, degrees: f64) -> Option<ScrewPoint> {
    let (in_loop, reference) = eval::both(&maps::screw(MAIN, 10f64.powf(third), [degrees]))?;
    let number = |answer: &Value| answer.pointer("/orbital_speed/0").and_then(Value::as_f64);
    let turn = degrees.to_radians();
    let light = MAIN * 10f64.powf(third);
    let contacts = ball.contacts(
        &[-turn, turn, 0.0, 0.0].map(|deviation| (FRAC_PI_4 + deviation) as f32),
        &[light, MAIN, MAIN, 0.0].map(|force| force as f32),
    );
    Some(ScrewPoint {
        third,
        closed: ball
            .orbital_speed(&ball.closed_form(&contacts).motion)
            .into(),
        refined: number(&in_loop)?,
        exact: number(&reference),
    })
}

fn screw_points(ball: &ScrewBall, degrees: f64, quick: bool) -> Vec<ScrewPoint> {
    // Where the ball is all but held by two contacts the reference takes a second for each.
    let (far, fine) = if quick { (4_u32, 6) } else { (8, 48) };
    let light = (0..far).map(|step| -4.5 + 2.8 * f64::from(step) / f64::from(far));
    let heavy = (0..=fine).map(|step| -1.8 + 1.8 * f64::from(step) / f64::from(fine));
    light
        .chain(heavy)
        .filter_map(|third| screw_point(ball, third, degrees))
        .collect()
}

fn screw_chart(points: &[ScrewPoint], degrees: f64) -> Panel {
    let line = |speed: fn(&ScrewPoint) -> Option<f64>| {
        points
            .iter()
            .filter_map(|point| Some((10f64.powf(point.third), speed(point)?)))
            .collect()
    };
    Panel::Chart(Chart {
        title: format!("ball of a ball screw, deviation {degrees} degrees"),
        x: Axis::log("load of the third contact over the main ones"),
        y: Axis::linear("orbital speed over the nut's"),
        series: vec![
            Series::new(
                "closed form",
                1,
                Mark::Line,
                line(|point| Some(point.closed)),
            ),
            Series::new("refined", 0, Mark::Line, line(|point| Some(point.refined))),
            Series::new("reference", 6, Mark::Circles, line(|point| point.exact)),
        ],
        notes: Vec::new(),
    })
}

fn screw_rows(points: &[ScrewPoint]) -> Vec<Vec<Cell>> {
    REGIMES
        .iter()
        .map(|(name, low, high)| {
            let mut worst = [0.0_f64; 2];
            let mut count = 0_u32;
            for point in points {
                let third = 10f64.powf(point.third);
                if let (true, Some(exact)) = (third > *low && third <= *high, point.exact) {
                    count += 1;
                    worst[0] = worst[0].max((point.closed - exact).abs());
                    worst[1] = worst[1].max((point.refined - exact).abs());
                }
            }
            vec![
                (*name).into(),
                format!("{low} to {high}").into(),
                Cell::fixed(f64::from(count), 0),
                Cell::power(worst[0]),
                Cell::power(worst[1]),
            ]
        })
        .collect()
}

/// Largest error of [`ScrewRow`]'s speed with play, over the nut's, for deviations of both grooves of up to so
/// many degrees; and where.
fn play(design: &BallScrew, largest: f64) -> Result<(f64, f64, f64), Failure> {
    let friction = study::FRICTION as f32;
    let row = ScrewRow::new(design, friction, GrooveFit::Play).map_err(failure)?;
    let ball = ScrewBall::new(design, friction).map_err(failure)?;
    let path = design.pitch_radius() / design.cos_lead_angle();
    let mut worst = (0.0, 0.0, 0.0);
    for screw_step in -8..=8_i8 {
        for nut_step in -8..=8_i8 {
            let degrees = [screw_step, nut_step].map(|step| largest * f64::from(step) / 8.0);
            let [screw, nut] = degrees.map(|degrees| degrees.to_radians() as f32);
            for load in [-50.0, 50.0] {
                let tick = row.at(1.0, load);
                let speed =
                    tick.nominal_speed() + tick.ball(screw, nut, &LoadShare::MEAN).speed_deviation;
                let RowContacts { angles, forces } = row.contacts(1.0, load, screw, nut);
                let sticking = ball.closed_form(&ball.contacts(&angles, &forces));
                let error = f64::from(speed / path - ball.orbital_speed(&sticking.motion));
                if error.abs() > worst.0 {
                    worst = (error.abs(), degrees[0], degrees[1]);
                }
            }
        }
    }
    Ok(worst)
}

fn columns(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

/// Text, tables and the figure.
pub fn blocks(context: &Context) -> Result<Vec<Block>, Failure> {
    let linear = Linear::new()?;
    let design = study::ball_screw()?;
    let ball = ScrewBall::new(&design, study::FRICTION as f32).map_err(failure)?;
    let signs: &[f64] = if context.quick { &[2.0] } else { &[2.0, -2.0] };
    let mut panels = vec![linear.chart(2.0)?, linear.chart(-2.0)?];
    let mut points = Vec::new();
    for &degrees in signs {
        let found = screw_points(&ball, degrees, context.quick);
        panels.push(screw_chart(&found, degrees));
        points.extend(found);
    }
    let linear_rows = TURNS
        .iter()
        .map(|degrees| linear.row(*degrees))
        .collect::<Result<_, _>>()?;
    let mut play_rows = Vec::new();
    for largest in [1.0, 3.0, 5.0] {
        let (error, screw, nut) = play(&design, largest)?;
        play_rows.push(vec![
            Cell::fixed(largest, 0),
            Cell::power(error),
            Cell::fixed(screw, 2),
            Cell::fixed(nut, 2),
        ]);
    }
    Ok(vec![
        Block::Text(
            "Near two-point contact. Where one diagonal carries some per cent of the other, a ball in a linear \
             bearing stops spinning about the strong one, and its speed jumps: Coulomb friction has no state in \
             between. The border lies where the weaker diagonal carries 3/8 E (a/R_B)/sin 2 beta of the stronger \
             one. The closed form knows nothing of it and keeps the speed it has before, and its scene says so from the \
             tick on in which the loads allow it (`Faults::BEYOND_MODEL`); the refined ball \
             follows within some ticks. In a ball screw a third contact that gets lighter begins to slide along \
             the track, which is smooth, and at some 2e-4 of the load the race changes on which the ball sticks, \
             which is a jump again."
                .into(),
        ),
        Block::Table(Table {
            name: "two_point_linear",
            caption: "Ball of a linear bearing (Lin 2019, Table 3.3): the border of two-point rolling, and largest \
                      errors of the speed deviation, over v/2, from a side-force ratio of 0.7 on: more than 0.01 \
                      before the border, about it, and after it"
                .into(),
            columns: columns(&[
                "deviation (deg)",
                "side force at the border",
                "weaker over stronger diagonal",
                "speed deviation before",
                "after",
                "closed form: before",
                "about",
                "after",
                "refined: before",
                "about",
                "after",
            ]),
            rows: linear_rows,
        }),
        Block::Table(Table {
            name: "two_point_screw",
            caption: "Ball of a ball screw (Lin 2019, Table 3.6), two contacts of 75 N and a third one: largest \
                      errors of the orbital speed over the nut's, deviations of 2 degrees"
                .into(),
            columns: columns(&[
                "what holds the ball",
                "load of the third contact over the main ones",
                "inputs",
                "closed form",
                "refined",
            ]),
            rows: screw_rows(&points),
        }),
        Block::Table(Table {
            name: "two_point_play",
            caption: "Grooves with play: error of the row's mean two-point speed, over the nut's, against a ball \
                      that sticks to one race; deviations of both grooves up to so many degrees, and where it is \
                      largest"
                .into(),
            columns: columns(&["deviations (deg)", "largest error", "screw (deg)", "nut (deg)"]),
            rows: play_rows,
        }),
        Block::Figure(Figure {
            name: "two_point_contact",
            caption: "Speed of a ball as what holds it beside two contacts gets lighter.".into(),
            panels,
            columns: 2,
            size: (560, 400),
        }),
    ])
}
