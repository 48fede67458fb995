//! Balls that are about to lose what holds them: near two-point contact.

use epas_reference::friction::linear_ball::LinearBall;

use crate::report::draw::{chart, figure, table};
use crate::report::trains::Closed;
use crate::study::turned_ball;
use epas_page::document::{Block, Cell};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Mark, Panel, Series};

/// Deviations of the bottom groove, degrees: a side force to the right loads the diagonal whose angle grows,
/// or the other one.
const TURNS: [f64; 6] = [-3.0, -2.0, -1.0, 1.0, 2.0, 3.0];
const SIDES: (f64, f64) = (0.7, 0.998);
const STEPS: u32 = 150;
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

fn row(closed: &Closed, degrees: f64) -> Result<Vec<Cell>, Failure> {
    const NEAR: f64 = 0.01;
    let border = Border::of(degrees)?;
    let mut worst = [0.0_f64; 3];
    for step in 0..=STEPS {
        let side = SIDES.0 + (1.0 - SIDES.0) * f64::from(step) / f64::from(STEPS);
        let ball = turned_ball(degrees, side);
        let exact = ball.solve(1.0)?.speed_deviation;
        let part = if (side - border.side).abs() < NEAR {
            1
        } else {
            usize::from(side > border.side) * 2
        };
        worst[part] = worst[part].max((closed.speed(&ball) - exact).abs());
    }
    Ok([
        Cell::fixed(degrees, 0),
        Cell::fixed(border.side, 4),
        Cell::fixed(weakness(&turned_ball(degrees, border.side)), 4),
        Cell::power(border.before),
        Cell::power(border.after),
    ]
    .into_iter()
    .chain(worst.map(Cell::power))
    .collect())
}

fn panel(closed: &Closed, degrees: f64) -> Result<Panel, Failure> {
    let mut lines = [const { Vec::new() }; 2];
    for step in 0..=400_u32 {
        let ball = turned_ball(degrees, 0.999 * f64::from(step) / 400.0);
        let exact = ball.solve(1.0)?.speed_deviation;
        for (line, speed) in lines.iter_mut().zip([closed.speed(&ball), exact]) {
            line.push((weakness(&ball), speed));
        }
    }
    let [formula, exact] = lines;
    let title = format!("ball of a linear bearing, deviation {degrees} degrees");
    let x = Axis::log("load of the weaker diagonal over the stronger").between(1e-3, 1.0);
    let y = Axis::linear("speed deviation over v/2");
    let series = vec![
        Series::new("closed form (3.43)", 1, Mark::Line, formula),
        Series::new("reference", 6, Mark::Dashed, exact),
    ];
    Ok(chart(&title, x, y, series))
}

pub fn blocks() -> Result<Vec<Block>, Failure> {
    let closed = Closed::new()?;
    let rows = TURNS
        .iter()
        .map(|degrees| row(&closed, *degrees))
        .collect::<Result<_, _>>()?;
    Ok(vec![
        Block::Text(
            "Near two-point contact. Where one diagonal carries some per cent of the other, a ball in a linear \
             bearing stops spinning about the strong one, and its speed jumps: Coulomb friction has no state in \
             between. The border lies where the weaker diagonal carries 3/8 E (a/R_B)/sin 2 beta of the stronger \
             one. The closed form knows nothing of it and keeps the speed it has before, and its scene says so from the \
             tick on in which the loads allow it (`Faults::BEYOND_MODEL`)."
                .into(),
        ),
        Block::Table(table("two_point_linear", "Ball of a linear bearing (Lin 2019, Table 3.3): the border of two-point rolling, and largest \
                      errors of the speed deviation in closed form, over v/2, from a side-force ratio of 0.7 on: more \
                      than 0.01 before the border, about it, and after it", "deviation (deg) | side force at the border | \
                       weaker over stronger diagonal | speed deviation before | after | \
                       error before | about | after", rows)),
        figure("two_point_contact", "Speed of a ball in a linear bearing as one diagonal gets lighter.", (2, 560, 400), vec![panel(&closed, 2.0)?, panel(&closed, -2.0)?]),
    ])
}
