//! The ball of a linear bearing: Lin 2019, Section 3.3.

use epas_friction::ball::{AnalyticLinearBall, PUBLISHED_SLOPE, SpeedDeviation};
use epas_reference::friction::chain::solve_chain;
use epas_reference::friction::linear_ball::LinearBall;

use crate::report::Context;
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
const BANDS: [f64; 7] = [1e-6, 1e-5, 1e-4, 5e-4, 2e-3, 5e-3, 2e-2];

/// Bounds of the bands of the contact force, N.
const FORCE_BANDS: [f64; 6] = [1e-3, 1e-2, 0.1, 0.3, 1.0, 3.0];

pub struct Closed(AnalyticLinearBall);

impl Closed {
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

    pub fn speed(&self, ball: &LinearBall) -> f64 {
        self.ball(ball).speed_deviation.into()
    }

    /// Error of the speed deviation against the least dissipation.
    fn error(&self, ball: &LinearBall) -> Result<f64, Failure> {
        Ok(self.speed(ball) - ball.solve(1.0)?.speed_deviation)
    }

    fn force(&self, [rear, front]: &[LinearBall; 2]) -> f64 {
        self.ball(rear).contact_force(&self.ball(front)).into()
    }
}

struct Grid {
    /// Rows of one angle deviation, from the least up; in them the errors by side-force ratio.
    rows: Vec<Vec<f64>>,
    ratios: Vec<f64>,
}

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

    fn up_to(&self, ratio: f64) -> Errors {
        self.rows
            .iter()
            .flat_map(|row| row.iter().zip(&self.ratios))
            .filter(|(_, here)| here.abs() <= ratio)
            .map(|(error, _)| *error)
            .collect()
    }
}

const CELLS: usize = 80;

pub fn closed_form_errors(ratio: f64) -> Result<Errors, Failure> {
    Ok(Grid::new(&Closed::new()?, CELLS)?.up_to(ratio))
}

pub fn blocks(context: &Context) -> Result<Vec<Block>, Failure> {
    let closed = Closed::new()?;
    let grid = Grid::new(&closed, if context.quick { 24 } else { CELLS })?;
    let forces = forces(&closed, if context.quick { 12 } else { 40 });
    Ok(vec![
        Block::Table(summary(context, &grid)?),
        maps(&grid, forces),
    ])
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
        "side-force ratio | largest error | rms | mean | latency (ns) | throughput (ns)",
        rows,
    ))
}

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
