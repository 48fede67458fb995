//! Contact kinematics: Figures 6 to 13 of Alberdi et al., traditional beside revised.

use crate::kinematics::figures::{self, Constraint, FieldPoint, Formulation, FormulationValues};
use epas_reference::kinematics::{ContactKinematics, Raceway, Revised};

use super::Context;
use epas_bench::report::draw::{chart, figure};
use epas_page::document::{Block, Section};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Mark, Panel, Series};

pub fn section(context: &Context) -> Result<Section, Failure> {
    let steps = if context.quick { 24 } else { 120 };
    let degrees = 180.0 / std::f64::consts::PI;
    Ok(Section {
        title: "Contact kinematics",
        blocks: vec![
            Block::Text(
                "The revised kinematics of Alberdi et al. The traditional formula feeds the ball's rotation \
                 relative to the moving frame where the absolute one belongs; with the absolute rotation it \
                 equals the revised one to rounding. Slip is ball less raceway; the paper's case is its Table \
                 2 under 1500 N at 1000 rpm. Its printed numbers stand in the table \"published\"."
                    .into(),
            ),
            figure_6(steps)?,
            fields()?,
            figure_9()?,
            sweep(
                "kinematics_figure_10",
                "Alberdi et al., Figure 10: slip at the screw and the nut over the rolling radii of both.",
                ("rolling radius (mm)", 1e3),
                (Constraint::RollingRadius, steps),
            )?,
            sweep(
                "kinematics_figure_11",
                "Alberdi et al., Figure 11: slip at the screw and the nut over the yaw angle of the ball's axis. Side slip vanishes at -2.3 degrees at the nut and 3.1 degrees at the \
                 screw, never at both.",
                ("yaw angle (deg)", degrees),
                (Constraint::Yaw, steps),
            )?,
            sweep(
                "kinematics_figure_12",
                "Alberdi et al., Figure 12: slip at the screw and the nut over the pitch angle of the ball's axis.",
                ("pitch angle (deg)", degrees),
                (Constraint::Pitch, steps),
            )?,
            figure_13(if context.quick { 6 } else { 20 }),
        ],
    })
}

fn figure_6(steps: usize) -> Result<Block, Failure> {
    type Quantity = fn(&FormulationValues) -> f64;
    let rows = figures::helix_sweep(steps)?;
    let panels = [
        (
            "entrainment speed (m/s)",
            (|v| v.entrainment_speed) as Quantity,
        ),
        ("side slip (mm/s)", |v| 1e3 * v.side_slip),
        ("rolling slip (mm/s)", |v| 1e3 * v.rolling_slip),
        ("spin (rad/s)", |v| v.spin),
    ]
    .map(|(label, quantity)| {
        let mut series = Vec::new();
        for (contact, name) in ["screw", "nut"].into_iter().enumerate() {
            for (formulation, mark) in [("revised", Mark::Line), ("traditional", Mark::Dashed)] {
                let points = rows.iter().map(|row| {
                    let values = match mark {
                        Mark::Line => &row.revised,
                        _ => &row.traditional,
                    };
                    (row.lead_angle.to_degrees(), quantity(&values[contact]))
                });
                let name = format!("{name}, {formulation}");
                series.push(Series::new(&name, contact, mark, points.collect()));
            }
        }
        let x = Axis::linear("lead angle (deg)").between(0.0, 40.0);
        chart("", x, Axis::linear(label), series)
    });
    Ok(figure(
        "kinematics_figure_6",
        "Alberdi et al., Figure 6: revised and traditional formulation over the lead angle. The traditional one takes \
         the ball's rotation relative to the moving frame, and its classic speeds: wrong for rolling \
         slip and spin even without lead, where side slip vanishes in both.",
        (2, 540, 380),
        panels.into(),
    ))
}

/// Arrows of a field: a shaft and two barbs each, cut from one another by a gap.
fn arrows(points: &[FieldPoint], scale: f64) -> Vec<(f64, f64)> {
    const GAP: (f64, f64) = (f64::NAN, f64::NAN);
    points
        .iter()
        .flat_map(|point| {
            let (x, y) = (1e3 * point.x, 1e3 * point.y);
            let (dx, dy) = (scale * point.slip_x, scale * point.slip_y);
            let barb = |side: f64| {
                let side = 0.15 * side;
                (x + 0.7 * dx - side * dy, y + 0.7 * dy + side * dx)
            };
            let tip = (x + dx, y + dy);
            [(x, y), tip, GAP, barb(1.0), tip, barb(-1.0), GAP]
        })
        .collect()
}

/// A slip field over the contact ellipse at the screw, arrows to one scale.
fn field_panel(title: &str, revised: &Revised, field: &[FieldPoint]) -> Panel {
    let contact = revised.input().contact(Raceway::Screw);
    let outline = (0..=120).map(|step| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(step) / 120.0).sin_cos();
        (
            1e3 * contact.semi_minor * cos,
            1e3 * contact.semi_major * sin,
        )
    });
    let arrows = arrows(field, 0.1 / 0.06);
    let series = vec![
        Series::new("contact ellipse", 6, Mark::Line, outline.collect()),
        Series::new("slip, 0.1 mm for 60 mm/s", 0, Mark::Line, arrows),
    ];
    let x = Axis::linear("along rolling (mm)").between(-0.5, 0.5);
    let y = Axis::linear("across rolling (mm)").between(-0.75, 0.65);
    chart(title, x, y, series)
}

fn figure_9() -> Result<Block, Failure> {
    let revised = figures::case_one(10f64.to_radians())?;
    let same = figures::same_slide_to_roll(4)?;
    let panels = [
        ("as it is", &same.reference),
        ("with the slide angle, without spin", &same.without_spin),
        ("the ratio alone", &same.rolling_only),
    ]
    .map(|(title, field)| field_panel(title, &revised, field));
    let caption = format!(
        "Alberdi et al., Figure 9: three slip fields with the same slide-to-roll ratio of {:.2} %: the ratio alone \
         tells neither the direction of slip nor the spin.",
        100.0 * same.slide_to_roll
    );
    Ok(figure(
        "kinematics_figure_9",
        caption,
        (3, 380, 460),
        panels.into(),
    ))
}

fn fields() -> Result<Block, Failure> {
    let bearing = figures::case_one(1e-9)?;
    let screw = figures::case_one(10f64.to_radians())?;
    let panels = [
        (
            "lead angle 0: a ball bearing",
            &bearing,
            Formulation::Revised,
        ),
        (
            "lead angle 10 degrees, revised",
            &screw,
            Formulation::Revised,
        ),
        (
            "lead angle 10 degrees, traditional",
            &screw,
            Formulation::Traditional,
        ),
    ]
    .map(|(title, revised, formulation)| {
        let field = figures::slip_field(revised, formulation, Raceway::Screw, 4);
        field_panel(title, revised, &field)
    });
    Ok(figure(
        "kinematics_figures_7_8",
        "Alberdi et al., Figures 7 and 8: slip over the contact ellipse at the screw. In a bearing there is spin; a \
         lead adds side slip, which the traditional formula makes three times too large.",
        (3, 380, 460),
        panels.into(),
    ))
}

fn sweep(
    name: &'static str,
    caption: &str,
    (label, scale): (&str, f64),
    (constraint, steps): (Constraint, usize),
) -> Result<Block, Failure> {
    type Quantity = fn(&ContactKinematics) -> f64;
    let rows = constraint.sweep(steps)?;
    let panels = [
        ("side slip (mm/s)", (|c| 1e3 * c.side_slip) as Quantity),
        ("rolling slip (mm/s)", |c| 1e3 * c.rolling_slip),
        ("spin (rad/s)", |c| c.spin),
        ("slide-to-roll ratio (%)", |c| 100.0 * c.slide_to_roll),
    ]
    .map(|(quantity, value)| {
        let curve = |(colour, name): (usize, &str)| {
            let points = rows
                .iter()
                .map(|(at, contacts)| (scale * at, value(&contacts[colour])));
            Series::new(name, colour, Mark::Line, points.collect())
        };
        let series = ["screw", "nut"].into_iter().enumerate().map(curve);
        let (x, y) = (Axis::linear(label), Axis::linear(quantity));
        chart("", x, y, series.collect())
    });
    Ok(figure(name, caption, (2, 540, 320), panels.into()))
}

fn figure_13(steps: usize) -> Block {
    let panels = [1000.0, 3500.0].map(|rpm| {
        let rows = figures::load_sweep(rpm * std::f64::consts::TAU / 60.0, steps);
        let series = figures::METHODS.iter().enumerate().map(|(method, name)| {
            let points = rows
                .iter()
                .map(|(load, angles)| (*load, angles[method].to_degrees()));
            Series::new(name, method, Mark::Line, points.collect())
        });
        let (x, y) = (
            Axis::linear("axial load (N)"),
            Axis::linear("pitch angle (deg)"),
        );
        chart(&format!("{rpm} rpm"), x, y, series.collect())
    });
    figure(
        "kinematics_figure_13",
        "Alberdi et al., Figure 13: pitch angle by each method over the axial load. ITE is not specified in the paper; \
         the angle of balanced spin power stands beside the others in its place.",
        (2, 540, 420),
        panels.into(),
    )
}
