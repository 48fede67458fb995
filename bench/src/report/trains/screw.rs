//! The ball of a ball screw: closed form against the elastic model.

use epas_friction::LoadShare;
use epas_friction::ball::{GrooveFit, ScrewRow};
use epas_reference::design::BallScrewDesign;
use epas_reference::friction::ball_screw_ball::{ScrewMotion, ScrewTrack};
use epas_reference::friction::ball_screw_elastic::ScrewSupport;

use crate::report::Context;
use crate::report::draw::{chart, figure, table};
use crate::report::statistics::Errors;
use crate::report::times::time;
use crate::study;
use crate::timing;
use epas_page::document::{Block, Cell, Table};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Mark, Series};

const LOADS: [f64; 3] = [10.0, 25.0, 50.0];

const SIGNS: [&str; 2] = ["favourable", "unfavourable"];

struct Case {
    load: f64,
    degrees: f64,
    sign: usize,
    exact: f64,
    force: f64,
    /// Error of the deviating ball's orbital speed, over the nut's.
    speed: f64,
}

pub fn blocks(context: &Context) -> Result<Vec<Block>, Failure> {
    let design = study::ball_screw()?;
    let row = ScrewRow::new(&design, study::FRICTION as f32, GrooveFit::Zero)?;
    let parts: u8 = if context.quick { 3 } else { 12 };
    let mut cases = Vec::new();
    for load in LOADS {
        for axial in [-load, load] {
            for part in 1..=parts {
                let turn = 3.0 * f64::from(part) / f64::from(parts);
                for degrees in [turn, -turn] {
                    cases.push(case(&row, axial, degrees)?);
                }
            }
        }
    }
    Ok(vec![
        Block::Text(
            "Friction across the track closes a light third contact, which holds the ball. A deviation of the \
             screw's contact angles that loads it is favourable: speeds are then a matter of geometry. In the other \
             sense the force between two balls makes the third contact slide, and the closed form, which takes it for \
             rolling, is too large."
                .into(),
        ),
        Block::Table(errors(context, &cases)?),
        picture(&cases),
    ])
}

/// Two balls, the one that is faster behind, one of them where the angles deviate.
fn case(row: &ScrewRow, axial_load: f64, degrees: f64) -> Result<Case, Failure> {
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

    let tick = row.at(1.0, axial_load as f32);
    let balls = order([0.0, degrees])
        .map(|degrees| tick.ball(degrees.to_radians() as f32, 0.0, &LoadShare::MEAN));
    let lead = balls[0].speed_deviation - balls[1].speed_deviation;
    let force = lead / (balls[0].compliance + balls[1].compliance);
    let speed = balls[usize::from(slower)].speed_deviation + tick.nominal_speed();
    Ok(Case {
        load: axial_load.abs(),
        degrees,
        sign: usize::from(third_load(&deviating) < third_load(&nominal)),
        exact,
        force: f64::from(if force > 0.0 { force } else { 0.0 }),
        speed: f64::from(speed) / ScrewTrack::from(&BallScrewDesign::LIN).path_radius()
            - deviating.orbital_speed,
    })
}

fn third_load(ball: &ScrewMotion) -> f64 {
    let mut loads: Vec<_> = ball.contacts.iter().map(|c| c.contact.load).collect();
    loads.sort_by(f64::total_cmp);
    loads.iter().rev().nth(2).copied().unwrap_or(0.0)
}

fn errors(context: &Context, cases: &[Case]) -> Result<Table, Failure> {
    let times = timing::times(&context.competition, "screw_row_pair")?;
    let mut rows = Vec::new();
    for (sign, name) in SIGNS.into_iter().enumerate() {
        for load in LOADS {
            let here = || {
                cases
                    .iter()
                    .filter(move |case| case.sign == sign && case.load == load)
            };
            let errors: Errors = here()
                .map(|case| 100.0 * (case.force / case.exact - 1.0))
                .collect();
            let speeds: Errors = here().map(|case| case.speed).collect();
            rows.push(vec![
                Cell::from(name),
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
    Ok(table(
        "screw_ball",
        "Closed form of a row: force between two balls of a ball screw (per cent) and orbital speed (over the \
                  nut's) against the elastic model, in which the force also moves the contacts; screw's contact angles \
                  turned by up to 3 degrees at one of them, friction 0.1. The time is that of both balls and the force",
        "deviation | load a ball (N) | largest force error (%) | rms | mean | \
         largest speed error | latency (ns) | throughput (ns)",
        rows,
    ))
}

fn picture(cases: &[Case]) -> Block {
    let forces = |force: fn(&Case) -> f64| {
        let mut points: Vec<_> = cases
            .iter()
            .filter(|case| case.load == 50.0)
            .map(|case| {
                let side = if case.sign == 0 { 1.0 } else { -1.0 };
                (side * case.degrees.abs(), force(case))
            })
            .collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        // Of the two directions of the load the first.
        points.dedup_by_key(|point| point.0);
        points
    };
    figure(
        "screw_pair_force",
        "Force between two balls of a ball screw at 50 N a ball; favourable deviations to the right, \
                  unfavourable ones to the left.",
        (1, 540, 460),
        vec![chart(
            "Force at 50 N a ball",
            Axis::linear("deviation (deg)").between(-3.2, 3.2),
            Axis::linear("force between the balls (N)"),
            vec![
                Series::new("elastic model", 0, Mark::Line, forces(|case| case.exact)),
                Series::new("closed form", 1, Mark::Circles, forces(|case| case.force)),
            ],
        )],
    )
}
