//! Whole screws of Lin 2019: Figures 3.24 and 3.25 again, torque between balls over a turn of the nut, from the exact whole screw; and
//! what the papers' closed forms make of a ball.

mod closed_forms;

use std::f64::consts::TAU;

use crate::published::balls::{peak_and_release, whole_screw};
use epas_reference::friction::ball_screw_elastic::BallSlip;
use epas_reference::friction::whole_screw::WholeScrew;
use rayon::prelude::*;

use super::Context;
use epas_bench::exact_ring::{Case, Deviation, exact, follow};
use epas_bench::report::draw::{self, chart, figure, table};
use epas_page::document::{Block, Cell, Section};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Mark, Series};

/// Amplitudes of the screw's deviation, degrees: the text does not print that of Figure 3.23.
const AMPLITUDES: [f64; 4] = [2.0, 2.3, 2.5, 3.0];

const LOAD: f64 = -1500.0;

/// What Figure 3.25 prints: largest torque between balls over that of the grooves, per cent, its angle, and the angle
/// at which no balls press any more, degrees.
const PRINTED: [f64; 3] = [49.6, 126.0, 306.0];

/// Nut angle, rad, groove torque and ball torque, N m, of a model.
type Course = Vec<(f64, f64, f64)>;

struct Run {
    degrees: f64,
    courses: [Course; 3],
    flagged: usize,
    refused: Option<String>,
}

const SCENE: &str = "scene";

const MODELS: [&str; 3] = ["exact", SCENE, "closed form"];

impl Run {
    fn new(degrees: f64, states: usize) -> Result<Self, Failure> {
        let case = Case {
            load_per_ball: LOAD / 37.0,
            track: Some(2.0),
            loaded: 1.0,
            screw: Deviation::wave(degrees.to_radians(), 2),
            nut: Deviation::wave(0.0, 1),
            turns: 1.0,
            states,
            ..Case::LIN
        };
        let exact = exact::<37>(&case).map_err(Failure::Data)?;
        let (scene, refused) = match follow::<37>(&case, &exact) {
            Ok(found) => (found.course, None),
            Err(reason) => (Vec::new(), Some(reason)),
        };
        let flagged = scene.iter().filter(|moment| moment.flagged).count();
        let scene = scene.iter().map(|moment| {
            let [groove, ball] = moment.torques;
            (moment.nut_angle, groove, ball)
        });
        let exact = exact
            .iter()
            .map(|state| (state.nut_angle, state.groove_torque, state.ball_torque));
        let closed = WholeScrew {
            ball_slip: BallSlip::Orbiting,
            ..whole_screw(degrees.to_radians())?
        };
        let closed = closed
            .simulate(TAU, states, 2)?
            .iter()
            .map(|state| (state.nut_angle, state.groove_torque(), state.ball_torque))
            .collect();
        Ok(Self {
            degrees,
            courses: [exact.collect(), scene.collect(), closed],
            flagged,
            refused,
        })
    }
}

pub fn section(context: &Context) -> Result<Section, Failure> {
    let [table, picture] = blocks(context.quick)?;
    Ok(Section {
        title: "Ball screw without cage",
        blocks: vec![table, picture, closed_forms::picture(context.quick)?],
    })
}

fn blocks(quick: bool) -> Result<[Block; 2], Failure> {
    let (amplitudes, states) = if quick {
        (&AMPLITUDES[2..3], 180)
    } else {
        (&AMPLITUDES[..], 360)
    };
    let runs = amplitudes
        .par_iter()
        .map(|degrees| Run::new(*degrees, states))
        .collect::<Result<Vec<_>, _>>()?;
    let mut rows = vec![row("printed", "", PRINTED)];
    for run in &runs {
        let amplitude = run.degrees.to_string();
        for (model, course) in MODELS.into_iter().zip(&run.courses) {
            let of_scene = model == SCENE;
            rows.push(match &run.refused {
                Some(reason) if of_scene => draw::told(COLUMNS, [model, &amplitude], reason),
                _ => {
                    let mut row = row(model, &amplitude, peak_and_release(course.iter().copied()));
                    if of_scene {
                        row[FLAGGED] = Cell::fixed(run.flagged as f64, 0);
                    }
                    row
                }
            });
        }
    }
    let caption = format!(
        "Lin 2019, Figures 3.24 and 3.25, again: 37 balls, 1500 N on SR and NL, friction 0.1, two waves a turn on the screw, first turn of the nut, \
         {states} steps. The amplitude is not printed; the scene's law is folded for it. Deviations above 1 degree are more than a groove has: \
         the scene flags loads under which its law does not hold the forces"
    );
    Ok([
        Block::Table(table("lin_figure_3_25_exact", caption, COLUMNS, rows)),
        picture(&runs),
    ])
}

const COLUMNS: &str = "model | amplitude (deg) | largest ball torque over groove torque (%) | at (deg) | \
     no balls press from (deg) | states flagged | not folded";

const FLAGGED: usize = 5;

fn row(model: &str, amplitude: &str, values: [f64; 3]) -> Vec<Cell> {
    let [peak, at, release] = values;
    vec![
        model.into(),
        amplitude.into(),
        Cell::fixed(peak, 1),
        Cell::fixed(at, 0),
        Cell::fixed(release, 0),
        "".into(),
        "".into(),
    ]
}

fn picture(runs: &[Run]) -> Block {
    type Value = fn(&(f64, f64, f64)) -> f64;
    let panels = [
        (
            "Lin 2019, Figure 3.24",
            "groove torque (N m)",
            (|moment| moment.1) as Value,
        ),
        (
            "Lin 2019, Figure 3.25",
            "ball torque over groove torque (%)",
            |moment| 100.0 * moment.2 / moment.1,
        ),
    ]
    .map(|(title, label, value)| {
        let mut series = Vec::new();
        for (colour, run) in runs.iter().enumerate() {
            // Points of the scene stand apart, or they hide the line.
            let marks = [(Mark::Line, 1), (Mark::Circles, 12), (Mark::Dashed, 1)];
            let models = MODELS.into_iter().zip(&run.courses).zip(marks);
            for ((model, course), (mark, stride)) in models.filter(|((_, c), _)| !c.is_empty()) {
                let points = course
                    .iter()
                    .step_by(stride)
                    .map(|moment| (moment.0.to_degrees(), value(moment)));
                let name = format!("{model}, {} degrees", run.degrees);
                series.push(Series::new(&name, colour, mark, points.collect()));
            }
        }
        let x = Axis::linear("nut angle (deg)").between(0.0, 360.0);
        chart(title, x, Axis::linear(label), series)
    });
    figure(
        "lin_figures_3_24_3_25_exact",
        "Lin 2019, Figures 3.24 and 3.25, from the exact whole screw: torque of the grooves, and torque between balls over it.",
        (1, 1080, 460),
        panels.into(),
    )
}
