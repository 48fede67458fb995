//! The ball of a ball screw: closed forms and impedance iteration against the elastic model.

use epas_friction::LoadShare;
use epas_friction::ball::{GrooveFit, ScrewRow};
use epas_friction::refined::{ScrewBall, ScrewChain, ScrewContacts};
use epas_reference::friction::ball_screw_ball::ScrewMotion;
use epas_reference::friction::ball_screw_elastic::ScrewSupport;

use crate::document::{Block, Cell, Figure, Table};
use crate::failure::Failure;
use crate::plot::{Axis, Chart, Mark, Note, Panel, Series};
use crate::report::context::Context;
use crate::report::statistics::Errors;
use crate::report::times::time;
use crate::study;

/// Room of two balls that touch on an open track.
const OPEN: [f32; 2] = [0.0, f32::INFINITY];

/// Key of the time and name of each variant.
const VARIANTS: [(&str, &str); 4] = [
    ("screw_row_pair", "closed form of the control loop"),
    ("screw_closed_pair", "closed form of given contacts"),
    ("screw_warm_pair", "1 warm impedance step"),
    ("screw_cold_pair", "start, 3 impedance steps"),
];

/// Axial loads on each ball, N.
const LOADS: [f64; 3] = [10.0, 25.0, 50.0];

/// Which way a deviation changes the load of the third contact, with the name that the table has for it.
const SIGNS: [&str; 2] = ["favourable", "unfavourable"];

/// A pair: what the elastic model says, and what the variants say.
struct Case {
    load: f64,
    degrees: f64,
    /// Index into [`SIGNS`].
    sign: usize,
    exact: f64,
    forces: [f64; 4],
    /// Errors of the deviating ball's orbital speed, over the nut's.
    speeds: [f64; 4],
}

struct Models {
    row: ScrewRow,
    ball: ScrewBall,
}

/// Tables and figures.
pub fn blocks(context: &Context) -> Result<Vec<Block>, Failure> {
    let failure = |error: epas_friction::Error| Failure::Data(error.to_string());
    let design = study::ball_screw()?;
    let friction = study::FRICTION as f32;
    let models = Models {
        row: ScrewRow::new(&design, friction, GrooveFit::Zero).map_err(failure)?,
        ball: ScrewBall::new(&design, friction).map_err(failure)?,
    };
    let parts: u8 = if context.quick { 3 } else { 12 };
    let mut cases = Vec::new();
    for load in LOADS {
        for axial in [-load, load] {
            for part in 1..=parts {
                let turn = 3.0 * f64::from(part) / f64::from(parts);
                for degrees in [turn, -turn] {
                    cases.push(models.case(axial, degrees)?);
                }
            }
        }
    }
    Ok(vec![
        Block::Text(
            "Friction across the track closes a light third contact, which holds the ball. A deviation of the \
             screw's contact angles that loads it is favourable: speeds are then a matter of geometry. In the other \
             sense the force between two balls makes the third contact slide."
                .into(),
        ),
        Block::Table(table(context, &cases)?),
        Block::Figure(picture(context, &cases)?),
    ])
}

impl Models {
    /// Two balls, the one that is faster behind, one of them where the angles deviate.
    fn case(&self, axial_load: f64, degrees: f64) -> Result<Case, Failure> {
        let support = ScrewSupport::Load(2.0 * axial_load);
        // On its own the deviating ball is slower or faster.
        let [nominal, deviating] = {
            let apart = study::screw_pair([0.0, degrees])?.solve_apart(support)?;
            [0, 1].map(|ball| apart.balls[ball].clone())
        };
        let slower = deviating.orbital_speed < nominal.orbital_speed;
        let order = |pair: [f64; 2]| if slower { pair } else { [pair[1], pair[0]] };
        let pair = study::screw_pair(order([0.0, degrees]))?;
        let exact = pair.solve(support)?.contact_force;
        let apart = pair.solve_apart(support)?;

        let sign = usize::from(third_load(&deviating) < third_load(&nominal));
        let front = usize::from(slower);
        let truth = deviating.orbital_speed;
        let given = [0, 1].map(|ball| self.contacts(&apart.balls[ball]));
        let closed = given.map(|contacts| self.ball.closed_form(&contacts));
        let mut chain = ScrewChain::new(closed);
        self.ball.press_chain(&mut chain, &OPEN, 1.0);
        let mut forces = [0.0, chain.forces[0].into(), 0.0, 0.0];
        let of = |state: &epas_friction::refined::ScrewBallState| {
            f64::from(self.ball.orbital_speed(&state.motion)) - truth
        };
        let mut speeds = [0.0, of(&closed[front]), 0.0, 0.0];

        let tick = self.row.at(1.0, axial_load as f32);
        let row = order([0.0, degrees])
            .map(|degrees| tick.ball(degrees.to_radians() as f32, 0.0, &LoadShare::MEAN));
        let lead = row[0].speed_deviation - row[1].speed_deviation;
        let force = lead / (row[0].compliance + row[1].compliance);
        forces[0] = f64::from(if force > 0.0 { force } else { 0.0 });
        let speed = row[front].speed_deviation + tick.nominal_speed();
        speeds[0] = f64::from(speed) / study::TRACK.path_radius() - truth;

        // Warm: the steps of earlier ticks have settled the balls.
        let mut chain = ScrewChain::new(given.map(|contacts| self.ball.start(&contacts)));
        for step in 1..=24 {
            let friction = study::FRICTION as f32;
            self.ball
                .refine_chain(&given, &mut chain, &OPEN, 1.0, friction);
            match step {
                3 => forces[3] = chain.forces[0].into(),
                24 => forces[2] = chain.forces[0].into(),
                _ => {}
            }
        }
        let start = self.ball.start(&given[front]);
        for (place, steps) in [(3, 3), (2, 10)] {
            speeds[place] = of(&self.ball.refine(&given[front], &start, 0.0, steps));
        }
        Ok(Case {
            load: axial_load.abs(),
            degrees,
            sign,
            exact,
            forces,
            speeds,
        })
    }

    /// The contacts that the elastic model finds for a ball on its own.
    fn contacts(&self, ball: &ScrewMotion) -> ScrewContacts {
        let (mut angles, mut loads) = ([0.0; 4], [0.0; 4]);
        for friction in &ball.contacts {
            let flank = friction.contact.groove as usize;
            angles[flank] = friction.contact.contact_angle as f32;
            loads[flank] = friction.contact.load as f32;
        }
        self.ball.contacts(&angles, &loads)
    }
}

/// Load of the lightest contact of three.
fn third_load(ball: &ScrewMotion) -> f64 {
    let mut loads: Vec<_> = ball.contacts.iter().map(|c| c.contact.load).collect();
    loads.sort_by(f64::total_cmp);
    loads.iter().rev().nth(2).copied().unwrap_or(0.0)
}

fn force_errors(cases: &[Case], variant: usize, sign: usize, load: f64) -> Errors {
    cases
        .iter()
        .filter(|case| case.sign == sign && case.load == load)
        .map(|case| 100.0 * (case.forces[variant] / case.exact - 1.0))
        .collect()
}

fn table(context: &Context, cases: &[Case]) -> Result<Table, Failure> {
    let mut rows = Vec::new();
    for (variant, (key, name)) in VARIANTS.into_iter().enumerate() {
        let times = context.times(key)?;
        for (sign, sign_name) in SIGNS.into_iter().enumerate() {
            for load in LOADS {
                let errors = force_errors(cases, variant, sign, load);
                let speeds: Errors = cases
                    .iter()
                    .filter(|case| case.sign == sign && case.load == load)
                    .map(|case| case.speeds[variant])
                    .collect();
                rows.push(vec![
                    Cell::from(name),
                    sign_name.into(),
                    Cell::fixed(load, 0),
                    Cell::fixed(errors.largest, 2),
                    Cell::fixed(errors.rms(), 2),
                    Cell::fixed(errors.mean(), 2),
                    Cell::power(speeds.largest),
                    time(&times.latency, 1),
                    time(&times.throughput, 1),
                ]);
            }
        }
    }
    Ok(Table {
        name: "screw_ball",
        caption: "Force between two balls of a ball screw (per cent) and orbital speed (over the nut's) against the \
                  elastic model, in which the force also moves the contacts; screw's contact angles turned by up to 3 \
                  degrees at one of them, friction 0.1. The time is that of both balls and the force"
            .into(),
        columns: [
            "model",
            "deviation",
            "load a ball (N)",
            "largest force error (%)",
            "rms",
            "mean",
            "largest speed error",
            "latency (ns)",
            "throughput (ns)",
        ]
        .map(String::from)
        .to_vec(),
        rows,
    })
}

fn picture(context: &Context, cases: &[Case]) -> Result<Figure, Failure> {
    let mut series = Vec::new();
    let mut notes = Vec::new();
    for (sign, sign_name) in SIGNS.into_iter().enumerate() {
        for (mark, load) in [Mark::Circles, Mark::Triangles]
            .into_iter()
            .zip([25.0, 50.0])
        {
            let mut points = Vec::new();
            for (variant, (key, name)) in VARIANTS.into_iter().enumerate() {
                let errors = force_errors(cases, variant, sign, load);
                let at = (
                    context.times(key)?.latency.at_least_resolved(),
                    errors.largest,
                );
                points.push(at);
                if sign == 1 && load == 50.0 {
                    notes.push(Note {
                        at,
                        text: name
                            .trim_start_matches("closed form of ")
                            .trim_start_matches("the ")
                            .replace("impedance ", ""),
                    });
                }
            }
            let name = format!("{sign_name}, {load} N a ball");
            series.push(Series::new(&name, sign, mark, points));
        }
    }
    let forces = |variant: Option<usize>| {
        let mut points: Vec<_> = cases
            .iter()
            .filter(|case| case.load == 50.0)
            .map(|case| {
                let force = variant.map_or(case.exact, |variant| case.forces[variant]);
                let side = if case.sign == 0 { 1.0 } else { -1.0 };
                (side * case.degrees.abs(), force)
            })
            .collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        // Of the two directions of the load the first.
        points.dedup_by_key(|point| point.0);
        points
    };
    let mut of_force = vec![Series::new("elastic model", 0, Mark::Line, forces(None))];
    for (colour, variant) in [(1, 0), (2, 1), (3, 3)] {
        of_force.push(Series::new(
            VARIANTS[variant].1,
            colour,
            Mark::Circles,
            forces(Some(variant)),
        ));
    }
    Ok(Figure {
        name: "screw_ball_error_against_time",
        caption: "Force between two balls of a ball screw. Left: largest error against the time of one call. Right: \
                  the force at 50 N a ball; favourable deviations to the right, unfavourable ones to the left, a load to the left."
            .into(),
        panels: vec![
            Panel::Chart(Chart {
                title: "Error against run time".into(),
                x: Axis::log("time of one call (ns)"),
                y: Axis::log("largest error of the force (%)"),
                series,
                notes,
            }),
            Panel::Chart(Chart {
                title: "Force at 50 N a ball".into(),
                x: Axis::linear("deviation (deg)").between(-3.2, 3.2),
                y: Axis::linear("force between the balls (N)"),
                series: of_force,
                notes: Vec::new(),
            }),
        ],
        columns: 2,
        size: (540, 460),
    })
}
