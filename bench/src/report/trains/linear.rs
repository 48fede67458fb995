//! The ball of a linear bearing: Lin 2019, Section 3.3.

use std::f64::consts::TAU;

use epas_friction::ball::{AnalyticLinearBall, PUBLISHED_SLOPE, SpeedDeviation};
use epas_friction::refined::{BallChain, BallState, FourPointBall, FourPointContacts};
use epas_reference::friction::chain::solve_chain;
use epas_reference::friction::linear_ball::LinearBall;

use crate::document::{Block, Cell, Figure, Table};
use crate::failure::Failure;
use crate::plot::{Axis, Chart, ColourMap, Colours, Mark, Note, Panel, Series};
use crate::report::context::Context;
use crate::report::statistics::{Errors, evenly};
use crate::report::times::{ratio, time};
use crate::study::{self, turned_ball};

/// Room of two balls that touch on an open track.
const OPEN: [f32; 2] = [0.0, f32::INFINITY];

/// Key of the time and name of each variant.
const VARIANTS: [(&str, &str); 5] = [
    ("ball_analytic", "closed form (3.43)"),
    ("ball_start", "four-force start"),
    ("ball_step_1", "start, 1 Newton step"),
    ("ball_step_2", "start, 2 Newton steps"),
    ("ball_step_3", "start, 3 Newton steps"),
];

/// Side-force ratios up to which errors are summed up; the ball changes to two-point rolling at 0.88 to
/// 0.98.
const DOMAINS: [f64; 4] = [0.5, 0.6, 0.8, 0.93];

/// Largest deviation of the contact angles, degrees.
const LARGEST_TURN: f64 = 3.0;

/// Bounds of the bands, in units of `v/2`.
const BANDS: [(f64, &str); 7] = [
    (1e-6, "1e-6"),
    (1e-5, "1e-5"),
    (1e-4, "1e-4"),
    (5e-4, "5e-4"),
    (2e-3, "2e-3"),
    (5e-3, "5e-3"),
    (2e-2, "2e-2"),
];

/// Bounds of the bands of the contact force, N.
const FORCE_BANDS: [(f64, &str); 6] = [
    (1e-3, "0.001"),
    (1e-2, "0.01"),
    (0.1, "0.1"),
    (0.3, "0.3"),
    (1.0, "1"),
    (3.0, "3"),
];

struct Models {
    analytic: AnalyticLinearBall,
    ball: FourPointBall,
}

impl Models {
    fn new() -> Result<Self, Failure> {
        let failure = |error: epas_friction::Error| Failure::Data(error.to_string());
        let parameters = study::linear_ball();
        Ok(Self {
            analytic: AnalyticLinearBall::new(&parameters, PUBLISHED_SLOPE).map_err(failure)?,
            ball: FourPointBall::linear(&parameters).map_err(failure)?,
        })
    }

    fn closed(&self, ball: &LinearBall) -> SpeedDeviation {
        self.analytic.speed_deviation(
            &ball.contact_angles.map(|angle| angle as f32),
            &ball.contact_forces.map(|force| force as f32),
        )
    }

    fn contacts(&self, ball: &LinearBall) -> FourPointContacts {
        self.ball.contacts(
            &ball.contact_angles.map(|angle| angle as f32),
            &ball.contact_forces.map(|force| force as f32),
        )
    }

    /// Errors of the speed deviation of all variants against the least dissipation.
    fn errors(&self, ball: &LinearBall) -> Result<[f64; 5], Failure> {
        let exact = ball.solve(1.0)?.speed_deviation;
        let contacts = self.contacts(ball);
        let start = self.ball.start(&contacts);
        let mut errors = [f64::from(self.closed(ball).speed_deviation) - exact; 5];
        for (steps, error) in (0..).zip(errors.iter_mut().skip(1)) {
            let state = self.ball.refine(&contacts, &start, 0.0, steps);
            *error = f64::from(state.speed_deviation) - exact;
        }
        Ok(errors)
    }

    /// Force between two balls after the start and `steps` steps.
    fn pair_force(&self, pair: &[LinearBall; 2], ball_friction: f32, steps: usize) -> f64 {
        let contacts = [self.contacts(&pair[0]), self.contacts(&pair[1])];
        let mut chain = BallChain::<2>::new();
        chain.balls = contacts.map(|contacts| self.ball.start(&contacts));
        for _ in 0..steps {
            self.ball
                .refine_chain(&contacts, &mut chain, &OPEN, 1.0, ball_friction);
        }
        chain.forces[0].into()
    }
}

/// Errors of all variants on a grid of side-force ratios and angle deviations.
struct Grid {
    /// Rows of one angle deviation, from the least up; in them the errors by side-force ratio.
    rows: Vec<Vec<[f64; 5]>>,
    ratios: Vec<f64>,
}

/// Largest side-force ratio of a map.
const LARGEST_RATIO: f64 = 0.96;

impl Grid {
    fn new(models: &Models, cells: usize) -> Result<Self, Failure> {
        let centres = |largest: f64| {
            (0..cells)
                .map(move |cell| largest * ((2 * cell + 1) as f64 / cells as f64 - 1.0))
                .collect::<Vec<_>>()
        };
        let ratios = centres(LARGEST_RATIO);
        let rows = centres(LARGEST_TURN)
            .into_iter()
            .map(|degrees| {
                ratios
                    .iter()
                    .map(|ratio| models.errors(&turned_ball(degrees, *ratio)))
                    .collect()
            })
            .collect::<Result<_, _>>()?;
        Ok(Self { rows, ratios })
    }

    /// Errors of a variant up to a side-force ratio.
    fn up_to(&self, variant: usize, ratio: f64) -> Errors {
        self.rows
            .iter()
            .flat_map(|row| row.iter().zip(&self.ratios))
            .filter(|(_, here)| here.abs() <= ratio)
            .map(|(errors, _)| errors[variant])
            .collect()
    }
}

/// Tables and figures.
pub fn blocks(context: &Context) -> Result<Vec<Block>, Failure> {
    let models = Models::new()?;
    let grid = Grid::new(&models, if context.quick { 24 } else { 80 })?;
    let swing = swinging_load(&models)?;
    Ok(vec![
        Block::Table(published(&models)?),
        Block::Table(summary(context, &grid, &swing)?),
        Block::Figure(picture(context, &grid, &swing)?),
        Block::Figure(maps(&grid)),
        Block::Figure(forces(&models, if context.quick { 12 } else { 40 })),
    ])
}

/// Tables 3.4 and 3.5.
fn published(models: &Models) -> Result<Table, Failure> {
    let pair = [turned_ball(2.0, -0.6), turned_ball(2.0, 0.6)];
    let exact = [pair[0].solve(1.0)?, pair[1].solve(1.0)?];
    let closed = [models.closed(&pair[0]), models.closed(&pair[1])];
    // The printed formula takes the forces of a diagonal as those of the top groove.
    let symmetric = pair.map(|ball| {
        let [_, _, right, left] = ball.contact_forces;
        models.closed(&LinearBall {
            contact_forces: [right, left, right, left],
            ..ball
        })
    });
    let mut rows = Vec::new();
    for (name, printed, formula, index) in [
        ("speed deviation of ball 1 (%)", 0.87, 0.75, 0),
        ("speed deviation of ball 2 (%)", -0.79, -0.75, 1),
    ] {
        let contacts = models.contacts(&pair[index]);
        rows.push(vec![
            Cell::from(name),
            Cell::fixed(printed, 2),
            Cell::fixed(100.0 * exact[index].speed_deviation, 4),
            Cell::fixed(
                100.0 * f64::from(models.ball.solve(&contacts).speed_deviation),
                4,
            ),
            Cell::fixed(formula, 2),
            Cell::fixed(100.0 * f64::from(symmetric[index].speed_deviation), 4),
            Cell::fixed(100.0 * f64::from(closed[index].speed_deviation), 4),
        ]);
    }
    for (name, printed, formula, friction) in [
        ("force between the balls (N)", "4.01", "3.74", 0.0),
        (
            "the same with friction between them",
            "",
            "",
            study::FRICTION,
        ),
    ] {
        rows.push(vec![
            Cell::from(name),
            printed.into(),
            Cell::fixed(solve_chain(&pair, friction, 1.0)?.contact_forces[0], 4),
            Cell::fixed(models.pair_force(&pair, friction as f32, 5), 4),
            formula.into(),
            Cell::fixed(symmetric[0].contact_force(&symmetric[1]).into(), 4),
            Cell::fixed(closed[0].contact_force(&closed[1]).into(), 4),
        ]);
    }
    Ok(Table {
        name: "linear_ball_published",
        caption: "Tables 3.4 and 3.5, case (a): two balls under a yaw moment, bottom groove turned by 2 degrees. \
                  The closed form with the loads as the text takes them, alike on a diagonal, and with all four"
            .into(),
        columns: [
            "quantity",
            "printed, numerical",
            "reference",
            "refined, f32",
            "printed, formula",
            "closed form, f32",
            "with four loads",
        ]
        .map(String::from)
        .to_vec(),
        rows,
    })
}

/// Errors of one warm step a tick while the side-force ratio swings by 0.8 in 100 ticks.
fn swinging_load(models: &Models) -> Result<Errors, Failure> {
    let ball = |tick: usize| turned_ball(2.0, 0.8 * (TAU * tick as f64 / 100.0).sin());
    let mut state: BallState = models.ball.solve(&models.contacts(&ball(0)));
    (1..=200)
        .map(|tick| {
            let ball = ball(tick);
            state = models.ball.step(&models.contacts(&ball), &state, 0.0);
            Ok(f64::from(state.speed_deviation) - ball.solve(1.0)?.speed_deviation)
        })
        .collect()
}

fn summary(context: &Context, grid: &Grid, swing: &Errors) -> Result<Table, Failure> {
    let mut rows = Vec::new();
    let unit = &context.times("ball_analytic")?.latency;
    let mut row = |key: &str, name: &str, domain: String, errors: &Errors| {
        let times = context.times(key)?;
        rows.push(vec![
            Cell::from(name),
            domain.into(),
            Cell::power(errors.largest),
            Cell::power(errors.rms()),
            Cell::power(errors.mean()),
            time(&times.latency, 1),
            ratio(times.latency.over(unit), 2),
            time(&times.throughput, 1),
        ]);
        Ok::<(), Failure>(())
    };
    for (variant, (key, name)) in VARIANTS.into_iter().enumerate() {
        for domain in DOMAINS {
            row(
                key,
                name,
                format!("up to {domain}"),
                &grid.up_to(variant, domain),
            )?;
        }
    }
    row(
        "ball_warm_step",
        "1 warm step a tick",
        "swings by 0.8 in 100 ticks".into(),
        swing,
    )?;
    Ok(Table {
        name: "linear_ball",
        caption: format!(
            "Speed deviation of one ball, in units of v/2 (full scale 0.025), against the least dissipation; \
             bottom groove turned by up to {LARGEST_TURN} degrees, times with the contacts' set-up"
        ),
        columns: [
            "formula",
            "side-force ratio",
            "largest error",
            "rms",
            "mean",
            "latency (ns)",
            "to (3.43)",
            "throughput (ns)",
        ]
        .map(String::from)
        .to_vec(),
        rows,
    })
}

fn picture(context: &Context, grid: &Grid, swing: &Errors) -> Result<Figure, Failure> {
    let mut series = Vec::new();
    let mut notes = Vec::new();
    for (colour, domain) in DOMAINS.into_iter().enumerate() {
        let mut points = Vec::new();
        for (variant, (key, name)) in VARIANTS.into_iter().enumerate() {
            let at = (
                context.times(key)?.latency.at_least_resolved(),
                grid.up_to(variant, domain).largest,
            );
            points.push(at);
            if colour + 1 == DOMAINS.len() {
                notes.push(Note {
                    at,
                    text: name.into(),
                });
            }
        }
        let name = format!("side-force ratio up to {domain}");
        series.push(Series::new("", colour, Mark::Circles, points.clone()));
        series.push(Series::new(&name, colour, Mark::Line, points));
    }
    series.push(Series::new(
        "1 warm step a tick, ratio swings by 0.8",
        DOMAINS.len(),
        Mark::Triangles,
        vec![(
            context.times("ball_warm_step")?.latency.at_least_resolved(),
            swing.largest,
        )],
    ));
    Ok(Figure {
        name: "linear_ball_error_against_time",
        caption: "Speed deviation of one ball in a linear bearing: largest error against the time of one call. \
                  Above a side-force ratio of 0.88 the ball begins to change to two-point rolling, and its speed \
                  jumps: there every formula is wrong by up to the jump."
            .into(),
        panels: vec![Panel::Chart(Chart {
            title: "One ball: error against run time".into(),
            x: Axis::log("time of one call (ns)").between(10.0, 1000.0),
            y: Axis::log("largest error of the speed deviation (v/2)").between(1e-7, 0.1),
            series,
            notes,
        })],
        columns: 1,
        size: (1080, 560),
    })
}

fn map(title: &str, quantity: &str, bounds: &[(f64, &str)], values: Vec<Vec<f64>>) -> Panel {
    Panel::Map(ColourMap {
        title: title.into(),
        x: Axis::linear("side-force ratio").between(-LARGEST_RATIO, LARGEST_RATIO),
        y: Axis::linear("angle deviation (deg)").between(-LARGEST_TURN, LARGEST_TURN),
        quantity: quantity.into(),
        colours: Colours::of(bounds.iter().map(|(bound, _)| bound)),
        bounds: bounds
            .iter()
            .map(|(bound, text)| (*bound, (*text).to_owned()))
            .collect(),
        values,
    })
}

fn maps(grid: &Grid) -> Figure {
    let panels = VARIANTS
        .iter()
        .enumerate()
        .map(|(variant, (_, name))| {
            let values = grid
                .rows
                .iter()
                .map(|row| row.iter().map(|errors| errors[variant].abs()).collect())
                .collect();
            map(name, "error (v/2)", &BANDS, values)
        })
        .collect();
    Figure {
        name: "linear_ball_errors",
        caption: "Error of the speed deviation over side-force ratio and angle deviation. The closed form and the \
                  start leave out that friction bends away from a straight line; every Newton step gains one to \
                  two orders of magnitude. The bright edges are two-point rolling."
            .into(),
        panels,
        columns: 3,
        size: (360, 330),
    }
}

/// Force between two balls with opposite side forces.
fn forces(models: &Models, cells: usize) -> Figure {
    type Force<'a> = Box<dyn Fn(&[LinearBall; 2]) -> f64 + 'a>;
    let steps = |steps: usize| -> Force<'_> {
        Box::new(move |pair| models.pair_force(pair, study::FRICTION as f32, steps))
    };
    let variants: [(&str, Force<'_>); 3] = [
        (
            "closed form (3.51)",
            Box::new(|pair| {
                models
                    .closed(&pair[0])
                    .contact_force(&models.closed(&pair[1]))
                    .into()
            }),
        ),
        ("start, 1 Newton step", steps(1)),
        ("start, 3 Newton steps", steps(3)),
    ];
    let half = |largest: f64| largest * (1.0 - 1.0 / cells as f64);
    let mut values = vec![Vec::new(); variants.len()];
    for degrees in evenly(-half(LARGEST_TURN), half(LARGEST_TURN), cells - 1) {
        let mut rows = vec![Vec::new(); variants.len()];
        for ratio in evenly(-half(LARGEST_RATIO), half(LARGEST_RATIO), cells - 1) {
            let pair = [turned_ball(degrees, ratio), turned_ball(degrees, -ratio)];
            // Without a reference next to the switch to two-point rolling the cell stays empty.
            let exact = solve_chain(&pair, study::FRICTION, 1.0)
                .map_or(f64::NAN, |chain| chain.contact_forces[0]);
            for (row, (_, force)) in rows.iter_mut().zip(&variants) {
                row.push((force(&pair) - exact).abs());
            }
        }
        for (values, row) in values.iter_mut().zip(rows) {
            values.push(row);
        }
    }
    let panels = variants
        .iter()
        .zip(values)
        .map(|((name, _), values)| map(name, "error (N)", &FORCE_BANDS, values))
        .collect();
    Figure {
        name: "linear_pair_errors",
        caption: "Error of the force between two balls (up to 10 N) whose side forces are opposite, with friction \
                  between the balls: rear ball at the ratio shown, front ball at its negative. Half of the field is \
                  without contact. Next to two-point rolling steps do not settle, because friction between the \
                  balls lags one step behind."
            .into(),
        panels,
        columns: 3,
        size: (360, 330),
    }
}
