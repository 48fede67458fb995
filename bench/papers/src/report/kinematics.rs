//! Contact kinematics: Figures 6 to 13 of Alberdi et al., traditional beside revised, and the table of
//! printed against computed numbers.

use crate::kinematics::figures::{self, ConstraintRow, FieldPoint, Formulation};
use crate::published::kinematics::records;
use epas_reference::kinematics::{ContactKinematics, Raceway, Revised};

use super::context::Context;
use epas_page::document::{Block, Cell, Figure, Section, Table};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Chart, Mark, Panel, Series};

/// The section.
pub fn section(context: &Context) -> Result<Section, Failure> {
    let steps = if context.quick { 24 } else { 120 };
    Ok(Section {
        title: "Contact kinematics",
        blocks: vec![
            Block::Text(
                "The revised kinematics of Alberdi et al. The traditional formula feeds the ball's rotation \
                 relative to the moving frame where the absolute one belongs; with the absolute rotation it \
                 equals the revised one to rounding. Slip is ball less raceway; the paper's case is its Table \
                 2 under 1500 N at 1000 rpm."
                    .into(),
            ),
            Block::Table(published()?),
            Block::Figure(figure_6(steps)?),
            Block::Figure(fields()?),
            Block::Figure(figure_9()?),
            Block::Figure(sweep(
                "kinematics_figure_10",
                "Alberdi et al., Figure 10: slip at the screw and the nut over the rolling radii of both.",
                "rolling radius (mm)",
                1e3,
                &figures::rolling_radius_sweep(steps)?,
            )),
            Block::Figure(sweep(
                "kinematics_figure_11",
                "Alberdi et al., Figure 11: slip at the screw and the nut over the yaw angle of the ball's axis. Side slip vanishes at -2.3 degrees at the nut and 3.1 degrees at the \
                 screw, never at both.",
                "yaw angle (deg)",
                180.0 / std::f64::consts::PI,
                &figures::yaw_sweep(steps)?,
            )),
            Block::Figure(sweep(
                "kinematics_figure_12",
                "Alberdi et al., Figure 12: slip at the screw and the nut over the pitch angle of the ball's axis.",
                "pitch angle (deg)",
                180.0 / std::f64::consts::PI,
                &figures::pitch_sweep(steps)?,
            )),
            Block::Figure(figure_13(if context.quick { 6 } else { 20 })),
        ],
    })
}

fn published() -> Result<Table, Failure> {
    let rows = records()?
        .into_iter()
        .map(|record| {
            let (name, reason) = (record.verdict.name(), record.verdict.reason());
            let verdict = if reason.is_empty() {
                name.to_owned()
            } else {
                format!("{name}: {reason}")
            };
            vec![
                Cell::from(record.quantity.as_str()),
                record.place.as_str().into(),
                record.unit.into(),
                Cell::Number(record.printed_value(), record.printed.clone()),
                Cell::fixed(record.computed, 4),
                verdict.into(),
            ]
        })
        .collect();
    Ok(Table {
        name: "kinematics_published",
        caption: "Printed numbers of Alberdi et al. and the computed ones".into(),
        columns: [
            "quantity", "place", "unit", "printed", "computed", "verdict",
        ]
        .map(String::from)
        .to_vec(),
        rows,
    })
}

fn figure_6(steps: usize) -> Result<Figure, Failure> {
    let rows = figures::helix_sweep(steps)?;
    let mut panels = Vec::new();
    type Quantity = fn(&figures::FormulationValues) -> f64;
    for (label, quantity) in [
        (
            "entrainment speed (m/s)",
            (|v| v.entrainment_speed) as Quantity,
        ),
        ("side slip (mm/s)", |v| 1e3 * v.side_slip),
        ("rolling slip (mm/s)", |v| 1e3 * v.rolling_slip),
        ("spin (rad/s)", |v| v.spin),
    ] {
        let mut series = Vec::new();
        for (contact, name) in ["screw", "nut"].into_iter().enumerate() {
            for (formulation, mark) in [("revised", Mark::Line), ("traditional", Mark::Dashed)] {
                let points = rows
                    .iter()
                    .map(|row| {
                        let values = if formulation == "revised" {
                            &row.revised
                        } else {
                            &row.traditional
                        };
                        (row.lead_angle.to_degrees(), quantity(&values[contact]))
                    })
                    .collect();
                series.push(Series::new(
                    &format!("{name}, {formulation}"),
                    contact,
                    mark,
                    points,
                ));
            }
        }
        panels.push(Panel::Chart(Chart {
            title: String::new(),
            x: Axis::linear("lead angle (deg)").between(0.0, 40.0),
            y: Axis::linear(label),
            series,
            notes: Vec::new(),
        }));
    }
    Ok(Figure {
        name: "kinematics_figure_6",
        caption: "Alberdi et al., Figure 6: revised and traditional formulation over the lead angle. The traditional one takes \
                  the ball's rotation relative to the moving frame, and its classic speeds: wrong for rolling \
                  slip and spin even without lead, where side slip vanishes in both."
            .into(),
        panels,
        columns: 2,
        size: (540, 380),
    })
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
                (
                    x + 0.7 * dx - side * 0.15 * dy,
                    y + 0.7 * dy + side * 0.15 * dx,
                )
            };
            let tip = (x + dx, y + dy);
            [(x, y), tip, GAP, barb(1.0), tip, barb(-1.0), GAP]
        })
        .collect()
}

/// A slip field over the contact ellipse at the screw.
fn field_panel(title: &str, revised: &Revised, field: &[FieldPoint]) -> Panel {
    let contact = revised.input().contact(Raceway::Screw);
    let outline = (0..=120)
        .map(|step| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(step) / 120.0).sin_cos();
            (
                1e3 * contact.semi_minor * cos,
                1e3 * contact.semi_major * sin,
            )
        })
        .collect();
    Panel::Chart(Chart {
        title: title.into(),
        x: Axis::linear("along rolling (mm)").between(-0.5, 0.5),
        y: Axis::linear("across rolling (mm)").between(-0.75, 0.65),
        series: vec![
            Series::new("contact ellipse", 6, Mark::Line, outline),
            Series::new(
                "slip, 0.1 mm for 60 mm/s",
                0,
                Mark::Line,
                arrows(field, 0.1 / 0.06),
            ),
        ],
        notes: Vec::new(),
    })
}

/// Figure 9: three fields with one slide-to-roll ratio.
fn figure_9() -> Result<Figure, Failure> {
    let revised = figures::case_one(10f64.to_radians())?;
    let same = figures::same_slide_to_roll(4)?;
    Ok(Figure {
        name: "kinematics_figure_9",
        caption: format!(
            "Alberdi et al., Figure 9: three slip fields with the same slide-to-roll ratio of {:.2} %: the ratio alone \
             tells neither the direction of slip nor the spin.",
            100.0 * same.slide_to_roll
        ),
        panels: vec![
            field_panel("as it is", &revised, &same.reference),
            field_panel(
                "with the slide angle, without spin",
                &revised,
                &same.without_spin,
            ),
            field_panel("the ratio alone", &revised, &same.rolling_only),
        ],
        columns: 3,
        size: (380, 460),
    })
}

/// Figures 7 and 8: slip over the contact ellipse of the screw, arrows to one scale.
fn fields() -> Result<Figure, Failure> {
    let bearing = figures::case_one(1e-9)?;
    let screw = figures::case_one(10f64.to_radians())?;
    let cases = [
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
    ];
    let panels = cases
        .into_iter()
        .map(|(title, revised, formulation)| {
            let field = figures::slip_field(revised, formulation, Raceway::Screw, 4);
            field_panel(title, revised, &field)
        })
        .collect();
    Ok(Figure {
        name: "kinematics_figures_7_8",
        caption: "Alberdi et al., Figures 7 and 8: slip over the contact ellipse at the screw. In a bearing there is spin; a \
                  lead adds side slip, which the traditional formula makes three times too large."
            .into(),
        panels,
        columns: 3,
        size: (380, 460),
    })
}

fn sweep(
    name: &'static str,
    caption: &str,
    label: &str,
    scale: f64,
    rows: &[ConstraintRow],
) -> Figure {
    type Quantity = fn(&ContactKinematics) -> f64;
    let panels = [
        ("side slip (mm/s)", (|c| 1e3 * c.side_slip) as Quantity),
        ("rolling slip (mm/s)", |c| 1e3 * c.rolling_slip),
        ("spin (rad/s)", |c| c.spin),
        ("slide-to-roll ratio (%)", |c| 100.0 * c.slide_to_roll),
    ]
    .map(|(quantity, value)| {
        let curve = |contact: fn(&ConstraintRow) -> &ContactKinematics| {
            rows.iter()
                .map(|row| (scale * row.value, value(contact(row))))
                .collect()
        };
        Panel::Chart(Chart {
            title: String::new(),
            x: Axis::linear(label),
            y: Axis::linear(quantity),
            series: vec![
                Series::new("screw", 0, Mark::Line, curve(|row| &row.screw)),
                Series::new("nut", 1, Mark::Line, curve(|row| &row.nut)),
            ],
            notes: Vec::new(),
        })
    });
    Figure {
        name,
        caption: caption.into(),
        panels: panels.into(),
        columns: 2,
        size: (540, 320),
    }
}

fn figure_13(steps: usize) -> Figure {
    let mut panels = Vec::new();
    for rpm in [1000.0, 3500.0] {
        let rows = figures::load_sweep(rpm * std::f64::consts::TAU / 60.0, steps);
        type Method = fn(&figures::PitchAngles) -> f64;
        let methods: [(&str, Method); 7] = [
            ("CONST", |p| p.constant),
            ("IRC", |p| p.inner_raceway_control),
            ("ORC", |p| p.outer_raceway_control),
            ("GEO", |p| p.mean),
            ("DAL (unverified)", |p| p.d_alembert),
            ("balanced spin power", |p| p.balanced_spin),
            ("least power", |p| p.least_power),
        ];
        panels.push(Panel::Chart(Chart {
            title: format!("{rpm} rpm"),
            x: Axis::linear("axial load (N)"),
            y: Axis::linear("pitch angle (deg)"),
            series: methods
                .iter()
                .enumerate()
                .map(|(colour, (name, method))| {
                    let points = rows
                        .iter()
                        .map(|row| (row.axial_load, method(&row.pitch).to_degrees()))
                        .collect();
                    Series::new(name, colour, Mark::Line, points)
                })
                .collect(),
            notes: Vec::new(),
        }));
    }
    Figure {
        name: "kinematics_figure_13",
        caption: "Alberdi et al., Figure 13: pitch angle by each method over the axial load. ITE is not specified in the paper; \
                  the angle of balanced spin power stands beside the others in its place."
            .into(),
        panels,
        columns: 2,
        size: (540, 420),
    }
}
