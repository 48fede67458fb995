//! Bearings: Figures 3.7, 3.14, 3.15 and 4.7 of Lin 2019.

use crate::bearing_study::{TurningLoad, variation};
use crate::published::balls::{analytic_force, linear_pair, symmetric_pair};
use crate::published::bearings::{DISPLACEMENTS, table_3_1, table_3_2};
use crate::rotary_ball::RotaryConvention;
use crate::rotary_bearing::Tilt;
use epas_reference::ReferenceError;
use epas_reference::friction::chain::solve_chain;
use epas_reference::friction::linear_ball::{LinearBall, analytic_ball_slip};

use super::context::Context;
use epas_bench::report::statistics::evenly;
use epas_page::document::{Block, Figure, Section};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Chart, ColourMap, Colours, Mark, Panel, Series};

/// The section.
pub fn section(context: &Context) -> Result<Section, Failure> {
    let turning = turning_load(context.quick)?;
    Ok(Section {
        title: "Bearings",
        blocks: vec![
            Block::Text(
                "The float64 reference of Lin 2019 on bearings: one ball of a rotary bearing between two- and four-point contact, \
                 two balls of a linear bearing that touch, and two whole bearings under a load that turns."
                    .into(),
            ),
            Block::Figure(figure_3_7(context.quick)?),
            Block::Figure(figure_3_14(context.quick)?),
            Block::Figure(figure_3_15(context.quick)?),
            Block::Figure(turning),
        ],
    })
}

fn figure_3_7(quick: bool) -> Result<Figure, Failure> {
    let steps = if quick { 20 } else { 90 };
    let speed = 20.0 * std::f64::consts::PI;
    let physical = table_3_1(RotaryConvention::Physical);
    let [mut sums, mut right_sums, mut torques, mut right_torques] = [const { Vec::new() }; 4];
    for micrometres in evenly(0.0, 9.0, steps) {
        let displacement = 1e-6 * micrometres;
        let (forces, motion) = table_3_2(displacement)?;
        sums.push((micrometres, forces.iter().sum()));
        torques.push((micrometres, 1e3 * motion.friction_torque));
        let contacts = physical.contacts_under_load(100.0, displacement)?;
        let motion = physical.motion(&contacts, 0.1, speed)?;
        right_sums.push((micrometres, contacts.contact_forces.iter().sum()));
        right_torques.push((micrometres, 1e3 * motion.friction_torque));
    }
    let printed_sums = [280.989, 296.3948, 470.9402];
    let printed_torques = [2.4650, 12.8769, 33.7180];
    let places = |values: [f64; 3]| {
        DISPLACEMENTS
            .iter()
            .zip(values)
            .map(|(displacement, value)| (1e6 * displacement, value))
            .collect()
    };
    let panel = |label: &str, ours, right, printed| {
        Panel::Chart(Chart {
            title: String::new(),
            x: Axis::linear("radial displacement of the inner ring (µm)").between(0.0, 9.0),
            y: Axis::linear(label),
            series: vec![
                Series::new("the dissertation's conventions", 0, Mark::Line, ours),
                Series::new("right curvatures, Coulomb friction", 1, Mark::Line, right),
                Series::new("Table 3.2, cases I to III", 6, Mark::Circles, printed),
            ],
            notes: Vec::new(),
        })
    };
    Ok(Figure {
        name: "lin_figure_3_7",
        caption: "Lin 2019, Figure 3.7: sum of the contact forces and friction torque of one ball of a rotary bearing under 100 N. Forces grow \
                  by two thirds, friction thirteen times, as two-point contact becomes four-point contact. The printed sum of case \
                  III, 434.8 N, is not that of its printed forces, 470.9 N."
            .into(),
        panels: vec![
            panel("sum of contact forces (N)", sums, right_sums, places(printed_sums)),
            panel("friction torque (N mm)", torques, right_torques, places(printed_torques)),
        ],
        columns: 2,
        size: (540, 380),
    })
}

type Pair = [LinearBall; 2];

/// A map over contact angle deviation and side force ratio.
fn map(
    title: &str,
    quantity: &str,
    bounds: &[f64],
    cells: usize,
    value: impl Fn(f64, f64) -> Result<f64, ReferenceError>,
) -> Result<Panel, Failure> {
    let centre = |cell: usize, limit: f64| limit * (2.0 * (cell as f64 + 0.5) / cells as f64 - 1.0);
    let mut values = Vec::new();
    for row in 0..cells {
        let mut line = Vec::new();
        for column in 0..cells {
            line.push(value(centre(column, 3.0).to_radians(), centre(row, 0.6))?);
        }
        values.push(line);
    }
    Ok(Panel::Map(ColourMap {
        title: title.into(),
        x: Axis::linear("contact angle deviation (deg)").between(-3.0, 3.0),
        y: Axis::linear("side force ratio").between(-0.6, 0.6),
        quantity: quantity.into(),
        colours: Colours::of(bounds),
        bounds: bounds
            .iter()
            .map(|bound| (*bound, bound.to_string()))
            .collect(),
        values,
    }))
}

fn cells(quick: bool) -> usize {
    if quick { 8 } else { 30 }
}

fn figure_3_14(quick: bool) -> Result<Figure, Failure> {
    let bounds = [-2.0, -1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5, 2.0];
    let difference = |pair: &Pair| -> Result<f64, ReferenceError> {
        let [rear, front] = pair;
        Ok(100.0 * (rear.solve(0.01)?.speed_deviation - front.solve(0.01)?.speed_deviation))
    };
    let closed = |pair: &Pair| {
        let [rear, front] = pair
            .each_ref()
            .map(|ball| ball.analytic_speed_deviation(std::f64::consts::FRAC_PI_4));
        100.0 * (rear - front)
    };
    Ok(Figure {
        name: "lin_figure_3_14",
        caption: "Lin 2019, Figure 3.14: difference of the speed deviations of two balls in a linear bearing over contact angle deviation and \
                  side force ratio, by the exact model and by the closed form (3.54)."
            .into(),
        panels: vec![
            map("exact", "difference (%)", &bounds, cells(quick), |theta, rho| {
                difference(&linear_pair(theta, rho)?)
            })?,
            map("closed form", "difference (%)", &bounds, cells(quick), |theta, rho| {
                Ok(closed(&symmetric_pair(theta, rho)?))
            })?,
        ],
        columns: 2,
        size: (540, 420),
    })
}

fn figure_3_15(quick: bool) -> Result<Figure, Failure> {
    let forces = [0.5, 2.0, 4.0, 6.0, 8.0, 10.0];
    let losses = [101.0, 110.0, 125.0, 150.0, 175.0, 185.0];
    let baseline = |pair: &Pair| -> Result<f64, ReferenceError> {
        Ok(pair[0].solve(0.01)?.power_loss + pair[1].solve(0.01)?.power_loss)
    };
    let slip = analytic_ball_slip(std::f64::consts::FRAC_PI_4, 0.01);
    Ok(Figure {
        name: "lin_figure_3_15",
        caption: "Lin 2019, Figure 3.15: force between the balls of Figure 3.14 and friction loss, of that without their contact. In the \
                  corner the loss is 185 %: the printed increase of \"185.2 %\" is the total."
            .into(),
        panels: vec![
            map("exact", "force (N)", &forces, cells(quick), |theta, rho| {
                Ok(solve_chain(&linear_pair(theta, rho)?, 0.1, 0.01)?.contact_forces[0])
            })?,
            map("closed form", "force (N)", &forces, cells(quick), |theta, rho| {
                Ok(analytic_force(&symmetric_pair(theta, rho)?))
            })?,
            map("exact", "loss (%)", &losses, cells(quick), |theta, rho| {
                let pair = linear_pair(theta, rho)?;
                let chain = solve_chain(&pair, 0.1, 0.01)?;
                Ok(100.0 * (1.0 + chain.ball_loss / baseline(&pair)?))
            })?,
            map("closed form", "loss (%)", &losses, cells(quick), |theta, rho| {
                let pair = symmetric_pair(theta, rho)?;
                let loss = 0.1 * analytic_force(&pair) * slip;
                Ok(100.0 * (1.0 + loss / baseline(&pair)?))
            })?,
        ],
        columns: 2,
        size: (540, 420),
    })
}

fn turning_load(quick: bool) -> Result<Figure, Failure> {
    let steps = if quick { 9 } else { 36 };
    let mut series = Vec::new();
    for (colour, (name, undersize, tilt)) in [
        ("no play", 0.0, Tilt::Held),
        ("40 µm undersize", 40e-6, Tilt::Held),
        ("120 µm undersize", 120e-6, Tilt::Held),
        ("no play, free to tilt", 0.0, Tilt::Free),
    ]
    .into_iter()
    .enumerate()
    {
        let study = TurningLoad {
            undersize,
            tilt,
            ..TurningLoad::default()
        };
        let points = study.sweep(steps)?;
        let [four, double] = variation(&points);
        let curve = |value: fn(&crate::bearing_study::TurningPoint) -> f64| {
            points
                .iter()
                .map(|point| (point.angle.to_degrees(), value(point)))
                .collect::<Vec<_>>()
        };
        series.push(Series::new(
            &format!("four-point, {name}: {four:.1} times"),
            colour,
            Mark::Line,
            curve(|point| point.four_point),
        ));
        series.push(Series::new(
            &format!("double row: {double:.1}"),
            colour,
            Mark::Dashed,
            curve(|point| point.double_row),
        ));
    }
    Ok(Figure {
        name: "lin_figure_4_7",
        caption: "Lin 2019, Figure 4.7: friction torque of a four-point and of a double-row angular contact bearing under 3000 N that turn from \
                  axial to radial (Table 4.2); in the legend the largest over the least. Undersize, tilt and friction (here 0.1) are not printed; in kind the result is the \
                  printed one: the four-point bearing varies several times over (printed: 5.69), the double-row one hardly."
            .into(),
        panels: vec![Panel::Chart(Chart {
            title: String::new(),
            x: Axis::linear("angle of the load from the axis (deg)").between(0.0, 90.0),
            y: Axis::linear("friction torque (N m)"),
            series,
            notes: Vec::new(),
        })],
        columns: 1,
        size: (1080, 460),
    })
}
