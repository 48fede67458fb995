//! The ball of a linear bearing: Lin 2019, Section 3.3.

use epas_friction::ball::{AnalyticLinearBall, PUBLISHED_SLOPE, SpeedDeviation};
use epas_reference::friction::chain::solve_chain;
use epas_reference::friction::linear_ball::LinearBall;

use crate::report::context::Context;
use crate::report::draw::{centres, figure, map, table};
use crate::report::statistics::{Errors, evenly};
use crate::report::times::time;
use crate::study::{self, turned_ball};
use crate::timing;
use epas_page::document::{Block, Cell, Table};
use epas_page::failure::Failure;
use epas_page::plot::Axis;

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

/// The closed form of a ball in a linear bearing.
pub struct Closed(AnalyticLinearBall);

impl Closed {
    /// The ball of the case study.
    pub fn new() -> Result<Self, Failure> {
        let form = AnalyticLinearBall::new(&study::linear_ball(), PUBLISHED_SLOPE)?;
        Ok(Self(form))
    }

    fn ball(&self, ball: &LinearBall) -> SpeedDeviation {
        self.0.speed_deviation(
            &ball.contact_angles.map(|angle| angle as f32),
            &ball.contact_forces.map(|force| force as f32),
        )
    }

    /// Speed deviation.
    pub fn speed(&self, ball: &LinearBall) -> f64 {
        self.ball(ball).speed_deviation.into()
    }

    /// Error of the speed deviation against the least dissipation.
    fn error(&self, ball: &LinearBall) -> Result<f64, Failure> {
        Ok(self.speed(ball) - ball.solve(1.0)?.speed_deviation)
    }

    /// Force between two balls.
    fn force(&self, [rear, front]: &[LinearBall; 2]) -> f64 {
        self.ball(rear).contact_force(&self.ball(front)).into()
    }
}

/// Errors on a grid of side-force ratios and angle deviations.
struct Grid {
    /// Rows of one angle deviation, from the least up; in them the errors by side-force ratio.
    rows: Vec<Vec<f64>>,
    ratios: Vec<f64>,
}

/// Largest side-force ratio of a map.
const LARGEST_RATIO: f64 = 0.96;

impl Grid {
    fn new(closed: &Closed, cells: usize) -> Result<Self, Failure> {
        let ratios: Vec<f64> = centres((-LARGEST_RATIO, LARGEST_RATIO), cells).collect();
        let rows = centres((-LARGEST_TURN, LARGEST_TURN), cells)
            .map(|degrees| {
                ratios
                    .iter()
                    .map(|ratio| closed.error(&turned_ball(degrees, *ratio)))
                    .collect()
            })
            .collect::<Result<_, _>>()?;
        Ok(Self { rows, ratios })
    }

    /// Errors up to a side-force ratio.
    fn up_to(&self, ratio: f64) -> Errors {
        self.rows
            .iter()
            .flat_map(|row| row.iter().zip(&self.ratios))
            .filter(|(_, here)| here.abs() <= ratio)
            .map(|(error, _)| *error)
            .collect()
    }
}

/// Cells of a side of the map of a full report.
const CELLS: usize = 80;

/// Errors of the closed form up to a side-force ratio, on the map of a full report.
pub fn closed_form_errors(ratio: f64) -> Result<Errors, Failure> {
    Ok(Grid::new(&Closed::new()?, CELLS)?.up_to(ratio))
}

/// Tables and figures.
pub fn blocks(context: &Context) -> Result<Vec<Block>, Failure> {
    let closed = Closed::new()?;
    let grid = Grid::new(&closed, if context.quick { 24 } else { CELLS })?;
    let forces = forces(&closed, if context.quick { 12 } else { 40 });
    Ok(vec![
        Block::Table(published(&closed)?),
        Block::Table(summary(context, &grid)?),
        maps(&grid, forces),
    ])
}

/// Tables 3.4 and 3.5.
fn published(form: &Closed) -> Result<Table, Failure> {
    let pair = [turned_ball(2.0, -0.6), turned_ball(2.0, 0.6)];
    let exact = [pair[0].solve(1.0)?, pair[1].solve(1.0)?];
    let closed = [form.ball(&pair[0]), form.ball(&pair[1])];
    // The printed formula takes the forces of a diagonal as those of the top groove.
    let symmetric = pair.map(|ball| {
        let [_, _, right, left] = ball.contact_forces;
        form.ball(&LinearBall {
            contact_forces: [right, left, right, left],
            ..ball
        })
    });
    let mut rows = Vec::new();
    for (name, printed, formula, index) in [
        ("speed deviation of ball 1 (%)", 0.87, 0.75, 0),
        ("speed deviation of ball 2 (%)", -0.79, -0.75, 1),
    ] {
        rows.push(vec![
            Cell::from(name),
            Cell::fixed(printed, 2),
            Cell::fixed(100.0 * exact[index].speed_deviation, 4),
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
            formula.into(),
            Cell::fixed(symmetric[0].contact_force(&symmetric[1]).into(), 4),
            Cell::fixed(closed[0].contact_force(&closed[1]).into(), 4),
        ]);
    }
    Ok(table(
        "linear_ball_published",
        "Tables 3.4 and 3.5, case (a): two balls under a yaw moment, bottom groove turned by 2 degrees. \
                  The closed form with the loads as the text takes them, alike on a diagonal, and with all four",
        &[
            "quantity",
            "printed, numerical",
            "reference",
            "printed, formula",
            "closed form, f32",
            "with four loads",
        ],
        rows,
    ))
}

fn summary(context: &Context, grid: &Grid) -> Result<Table, Failure> {
    let times = timing::times(&context.competition, "ball_analytic")?;
    let rows = DOMAINS
        .into_iter()
        .map(|domain| {
            let errors = grid.up_to(domain);
            vec![
                Cell::from(format!("up to {domain}")),
                Cell::power(errors.largest),
                Cell::power(errors.rms()),
                Cell::power(errors.mean()),
                time(&times.latency, 1),
                time(&times.throughput, 1),
            ]
        })
        .collect();
    Ok(table(
        "linear_ball",
        format!(
            "Speed deviation of one ball by the closed form (3.43), in units of v/2 (full scale 0.025), against the least \
             dissipation; bottom groove turned by up to {LARGEST_TURN} degrees. Above a side-force ratio of 0.88 the ball \
             begins to change to two-point rolling, and its speed jumps"
        ),
        &[
            "side-force ratio",
            "largest error",
            "rms",
            "mean",
            "latency (ns)",
            "throughput (ns)",
        ],
        rows,
    ))
}

/// Errors of the speed of one ball, and of the force between two.
fn maps(grid: &Grid, forces: Vec<Vec<f64>>) -> Block {
    let speeds = grid
        .rows
        .iter()
        .map(|row| row.iter().map(|error| error.abs()).collect())
        .collect();
    let axes = || {
        let x = Axis::linear("side-force ratio").between(-LARGEST_RATIO, LARGEST_RATIO);
        let y = Axis::linear("angle deviation (deg)").between(-LARGEST_TURN, LARGEST_TURN);
        (x, y)
    };
    figure(
        "linear_ball_errors",
        "Errors of the closed form over side-force ratio and angle deviation. Left: speed deviation of one ball; \
                  the form leaves out that friction bends away from a straight line. Right: force between two balls (up \
                  to 10 N) whose side forces are opposite, with friction between the balls in the reference: rear ball \
                  at the ratio shown, front ball at its negative; half of the field is without contact. The bright edges \
                  are two-point rolling.",
        (2, 540, 400),
        vec![
            map(
                "speed of one ball, (3.43)",
                axes(),
                ("error (v/2)", &BANDS),
                speeds,
            ),
            map(
                "force between two balls, (3.51)",
                axes(),
                ("error (N)", &FORCE_BANDS),
                forces,
            ),
        ],
    )
}

/// Errors of the force between two balls with opposite side forces.
fn forces(closed: &Closed, cells: usize) -> Vec<Vec<f64>> {
    let half = |largest: f64| largest * (1.0 - 1.0 / cells as f64);
    evenly(-half(LARGEST_TURN), half(LARGEST_TURN), cells - 1)
        .map(|degrees| {
            evenly(-half(LARGEST_RATIO), half(LARGEST_RATIO), cells - 1)
                .map(|ratio| {
                    let pair = [turned_ball(degrees, ratio), turned_ball(degrees, -ratio)];
                    // Without a reference next to the switch to two-point rolling the cell stays empty.
                    let exact = solve_chain(&pair, study::FRICTION, 1.0)
                        .map_or(f64::NAN, |chain| chain.contact_forces[0]);
                    (closed.force(&pair) - exact).abs()
                })
                .collect()
        })
        .collect()
}
