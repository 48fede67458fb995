//! Bearings: Figures 3.7, 3.14, 3.15 and 4.7 of Lin 2019.

use std::f64::consts::FRAC_PI_4;

use crate::published::balls::{analytic_force, linear_pair, symmetric_pair};
use crate::published::bearings::{DISPLACEMENTS, INNER_SPEED, table_3_1, table_3_2};
use crate::rotary_ball::RotaryConvention;
use crate::rotary_bearing::{TurningLoad, TurningPoint, variation};
use epas_reference::ReferenceError;
use epas_reference::friction::chain::solve_chain;
use epas_reference::friction::linear_ball::{LinearBall, analytic_ball_slip};

use super::Context;
use epas_bench::report::draw::{centres, chart, figure, map};
use epas_bench::report::statistics::evenly;
use epas_page::document::{Block, Section};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Mark, Panel, Series};

pub fn section(context: &Context) -> Result<Section, Failure> {
    Ok(Section {
        title: "Bearings",
        blocks: vec![
            Block::Text(
                "The float64 reference of Lin 2019 on bearings: one ball of a rotary bearing between two- and four-point contact, \
                 two balls of a linear bearing that touch, and two whole bearings under a load that turns."
                    .into(),
            ),
            figure_3_7(context.quick)?,
            figure_3_14(context.quick)?,
            figure_3_15(context.quick)?,
            turning_load(context.quick)?,
        ],
    })
}

fn figure_3_7(quick: bool) -> Result<Block, Failure> {
    let physical = table_3_1(RotaryConvention::Physical);
    // Sums of forces and torques, each by the dissertation's and by right conventions.
    let mut curves = [const { [const { Vec::new() }; 2] }; 2];
    for micrometres in evenly(0.0, 9.0, if quick { 20 } else { 90 }) {
        let displacement = 1e-6 * micrometres;
        let (forces, motion) = table_3_2(displacement)?;
        let contacts = physical.contacts_under_load(100.0, displacement)?;
        let right = physical.motion(&contacts, 0.1, INNER_SPEED)?;
        let found = [
            (forces, motion.friction_torque),
            (contacts.contact_forces, right.friction_torque),
        ];
        for (convention, (forces, torque)) in found.into_iter().enumerate() {
            curves[0][convention].push((micrometres, forces.iter().sum()));
            curves[1][convention].push((micrometres, 1e3 * torque));
        }
    }
    let panels = [
        ("sum of contact forces (N)", [280.989, 296.3948, 470.9402]),
        ("friction torque (N mm)", [2.4650, 12.8769, 33.7180]),
    ]
    .into_iter()
    .zip(curves)
    .map(|((label, printed), [ours, right])| {
        let places = DISPLACEMENTS.map(|displacement| 1e6 * displacement);
        let printed = places.into_iter().zip(printed).collect();
        let series = vec![
            Series::new("the dissertation's conventions", 0, Mark::Line, ours),
            Series::new("right curvatures, Coulomb friction", 1, Mark::Line, right),
            Series::new("Table 3.2, cases I to III", 6, Mark::Circles, printed),
        ];
        let x = Axis::linear("radial displacement of the inner ring (µm)").between(0.0, 9.0);
        chart("", x, Axis::linear(label), series)
    });
    Ok(figure(
        "lin_figure_3_7",
        "Lin 2019, Figure 3.7: sum of the contact forces and friction torque of one ball of a rotary bearing under 100 N. Forces grow \
         by two thirds, friction thirteen times, as two-point contact becomes four-point contact. The printed sum of case \
         III, 434.8 N, is not that of its printed forces, 470.9 N.",
        (2, 540, 380),
        panels.collect(),
    ))
}

type Pair = [LinearBall; 2];

fn over_pairs(
    title: &str,
    bands: (&str, &[f64]),
    quick: bool,
    value: impl Fn(f64, f64) -> Result<f64, ReferenceError>,
) -> Result<Panel, Failure> {
    let (turns, sides) = ((-3.0, 3.0), (-0.6, 0.6));
    let cells = if quick { 8 } else { 30 };
    let row = |side| {
        let places = centres(turns, cells);
        places
            .map(|degrees| value(degrees.to_radians(), side))
            .collect()
    };
    let values = centres(sides, cells).map(row).collect::<Result<_, _>>()?;
    let x = Axis::linear("contact angle deviation (deg)").between(turns.0, turns.1);
    let y = Axis::linear("side force ratio").between(sides.0, sides.1);
    Ok(map(title, (x, y), bands, values))
}

fn figure_3_14(quick: bool) -> Result<Block, Failure> {
    let bounds = [-2.0, -1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5, 2.0];
    let bands = ("difference (%)", &bounds[..]);
    let exact = over_pairs("exact", bands, quick, |theta, rho| {
        let [rear, front] = linear_pair(theta, rho)?;
        Ok(100.0 * (rear.solve(0.01)?.speed_deviation - front.solve(0.01)?.speed_deviation))
    })?;
    let closed = over_pairs("closed form", bands, quick, |theta, rho| {
        let pair = symmetric_pair(theta, rho)?;
        let [rear, front] = pair.map(|ball| ball.analytic_speed_deviation(FRAC_PI_4));
        Ok(100.0 * (rear - front))
    })?;
    Ok(figure(
        "lin_figure_3_14",
        "Lin 2019, Figure 3.14: difference of the speed deviations of two balls in a linear bearing over contact angle deviation and \
         side force ratio, by the exact model and by the closed form (3.54).",
        (2, 540, 420),
        vec![exact, closed],
    ))
}

fn figure_3_15(quick: bool) -> Result<Block, Failure> {
    let bounds = [0.5, 2.0, 4.0, 6.0, 8.0, 10.0];
    let forces = ("force (N)", &bounds[..]);
    let bounds = [101.0, 110.0, 125.0, 150.0, 175.0, 185.0];
    let losses = ("loss (%)", &bounds[..]);
    let baseline = |pair: &Pair| -> Result<f64, ReferenceError> {
        Ok(pair[0].solve(0.01)?.power_loss + pair[1].solve(0.01)?.power_loss)
    };
    let slip = analytic_ball_slip(FRAC_PI_4, 0.01);
    let panels = vec![
        over_pairs("exact", forces, quick, |theta, rho| {
            Ok(solve_chain(&linear_pair(theta, rho)?, 0.1, 0.01)?.contact_forces[0])
        })?,
        over_pairs("closed form", forces, quick, |theta, rho| {
            Ok(analytic_force(&symmetric_pair(theta, rho)?))
        })?,
        over_pairs("exact", losses, quick, |theta, rho| {
            let pair = linear_pair(theta, rho)?;
            let chain = solve_chain(&pair, 0.1, 0.01)?;
            Ok(100.0 * (1.0 + chain.ball_loss / baseline(&pair)?))
        })?,
        over_pairs("closed form", losses, quick, |theta, rho| {
            let pair = symmetric_pair(theta, rho)?;
            let loss = 0.1 * analytic_force(&pair) * slip;
            Ok(100.0 * (1.0 + loss / baseline(&pair)?))
        })?,
    ];
    Ok(figure(
        "lin_figure_3_15",
        "Lin 2019, Figure 3.15: force between the balls of Figure 3.14 and friction loss, of that without their contact. In the \
         corner the loss is 185 %: the printed increase of \"185.2 %\" is the total.",
        (2, 540, 420),
        panels,
    ))
}

fn turning_load(quick: bool) -> Result<Block, Failure> {
    let mut series = Vec::new();
    for (colour, (name, undersize, tilts)) in [
        ("no play", 0.0, false),
        ("40 µm undersize", 40e-6, false),
        ("120 µm undersize", 120e-6, false),
        ("no play, free to tilt", 0.0, true),
    ]
    .into_iter()
    .enumerate()
    {
        let study = TurningLoad { undersize, tilts };
        let points = study.sweep(if quick { 9 } else { 36 })?;
        let [four, double] = variation(&points);
        let mut curve = |name: &str, mark, value: fn(&TurningPoint) -> f64| {
            let points = points
                .iter()
                .map(|point| (point.angle.to_degrees(), value(point)));
            series.push(Series::new(name, colour, mark, points.collect()));
        };
        let name = format!("four-point, {name}: {four:.1} times");
        curve(&name, Mark::Line, |point| point.four_point);
        let name = format!("double row: {double:.1}");
        curve(&name, Mark::Dashed, |point| point.double_row);
    }
    let x = Axis::linear("angle of the load from the axis (deg)").between(0.0, 90.0);
    let panel = chart("", x, Axis::linear("friction torque (N m)"), series);
    Ok(figure(
        "lin_figure_4_7",
        "Lin 2019, Figure 4.7: friction torque of a four-point and of a double-row angular contact bearing under 3000 N that turn from \
         axial to radial (Table 4.2); in the legend the largest over the least. Undersize, tilt and friction (here 0.1) are not printed; in kind the result is the \
         printed one: the four-point bearing varies several times over (printed: 5.69), the double-row one hardly.",
        (1, 1080, 460),
        vec![panel],
    ))
}
