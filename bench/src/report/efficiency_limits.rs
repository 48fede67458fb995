//! Figures 6 and 7 of Lin, Velinsky, Ravani 1994: the best contact angle, and where full sliding locks.

use epas_friction::{Drive, EfficiencyGeometry, optimum_contact_angle};
use epas_reference::efficiency::{
    locking_border_backdrive, locking_border_drive, optimum_backdrive, optimum_drive,
    optimum_efficiency,
};

use super::Context;
use super::document::{Block, Cell, Figure, Section, Table};
use crate::failure::Failure;
use crate::plot::{Axis, Chart, Mark, Panel, Series, render};

/// Friction coefficient of the paper's figures.
const FRICTION: f64 = 0.075;

/// Friction coefficients of the locking borders, the paper's first.
const FRICTIONS: [f64; 3] = [FRICTION, 0.15, 0.3];

/// The section.
pub fn section(_: &Context) -> Result<Section, Failure> {
    Ok(Section {
        id: "efficiency-limits",
        title: "Efficiency: best contact angle and self-locking (Figures 6, 7)",
        blocks: vec![
            Block::text(format!(
                "Full sliding loses least where the cosine of the lead angle times the sine of the \
                 contact angle is the sine of 45 degrees plus (driving) or less (back-driving) half the \
                 friction angle: equations (15) and (18) in closed form, which the paper solves \
                 numerically. The efficiency there is {:.4} for a friction of {FRICTION}, in either \
                 direction and for every lead angle up to the end of the curve; beyond it there is no \
                 optimum. The paper says: for all lead angles.",
                optimum_efficiency(FRICTION)
            )),
            Block::Figure(figure_6()?),
            Block::Figure(figure_7()?),
            Block::Table(lock_table()?),
        ],
    })
}

fn figure_6() -> Result<Figure, Failure> {
    let failure = |error: epas_friction::Error| Failure::Data(error.to_string());
    let degrees = |angle: Option<f64>| angle.map_or(f64::NAN, f64::to_degrees);
    let mut data = Table::new(
        "figure-06",
        "Figure 6 of Lin, Velinsky, Ravani 1994: contact angle of highest full-sliding efficiency over \
         the lead angle, friction 0.075; reference in float64 (lines) and the crate in f32 (points).",
        &[
            "lead angle (deg)",
            "driving (15) (deg)",
            "back-driving (18) (deg)",
            "driving, f32 (deg)",
            "back-driving, f32 (deg)",
        ],
    );
    let mut curves: [Vec<(f64, f64)>; 4] = Default::default();
    for index in 0..=500 {
        let lead_degrees = 0.1 * f64::from(index);
        let lead_angle = lead_degrees.to_radians();
        let in_loop = |drive| -> Result<f64, Failure> {
            let best = optimum_contact_angle(drive, lead_angle as f32, FRICTION as f32)
                .map_err(failure)?;
            Ok(degrees(best.contact_angle.map(f64::from)))
        };
        let values = [
            degrees(optimum_drive(lead_angle, FRICTION)),
            degrees(optimum_backdrive(lead_angle, FRICTION)),
            in_loop(Drive::Driving)?,
            in_loop(Drive::BackDriving)?,
        ];
        for (place, (curve, value)) in curves.iter_mut().zip(values).enumerate() {
            // Points would cover the lines.
            if place < 2 || index % 25 == 0 {
                curve.push((lead_degrees, value));
            }
        }
        let mut cells = vec![Cell::raw(lead_degrees)];
        cells.extend(values.map(Cell::raw));
        data.rows.push(cells);
    }
    let [drive, backdrive, drive_f32, backdrive_f32] = curves;
    let chart = Chart {
        title: "Contact angle of highest full-sliding efficiency, friction 0.075".into(),
        x: Axis::linear("lead angle (deg)").between(0.0, 50.0),
        y: Axis::linear("contact angle (deg)").between(40.0, 90.0),
        series: vec![
            Series::new("driving (15)", 0, Mark::Line, drive),
            Series::new("back-driving (18)", 1, Mark::Line, backdrive),
            Series::new("driving, f32", 0, Mark::Circles, drive_f32),
            Series::new("back-driving, f32", 1, Mark::Triangles, backdrive_f32),
        ],
        notes: Vec::new(),
    };
    Ok(Figure {
        svg: render(&[Panel::Chart(chart)], 1, (900, 460))?,
        data,
    })
}

fn figure_7() -> Result<Figure, Failure> {
    let mut data = Table::new(
        "figure-07",
        "Figure 7 of Lin, Velinsky, Ravani 1994: where full sliding locks. (a) driving locks below the \
         border, eq. (16); (b) back-driving above it, eq. (19), and only where the lead angle is smaller \
         than the friction angle.",
        &[
            "direction",
            "friction",
            "lead angle (deg)",
            "contact angle of the border (deg)",
        ],
    );
    let mut panel = |title: &str,
                     name: &str,
                     ends: (f64, f64),
                     contact: (f64, f64),
                     mark: Mark,
                     border: fn(f64, f64) -> Option<f64>| {
        let series = FRICTIONS
            .iter()
            .enumerate()
            .map(|(colour, &friction)| {
                let points: Vec<_> = (0..=400)
                    .filter_map(|index| {
                        let lead_degrees = ends.0 + (ends.1 - ends.0) * f64::from(index) / 400.0;
                        let angle = border(lead_degrees.to_radians(), friction)?;
                        Some((lead_degrees, angle.to_degrees()))
                    })
                    .collect();
                for &(lead_degrees, angle) in &points {
                    data.rows.push(vec![
                        Cell::text(name),
                        Cell::raw(friction),
                        Cell::raw(lead_degrees),
                        Cell::raw(angle),
                    ]);
                }
                let mut outline = points;
                // Beyond the end of its border driving locks at every contact angle.
                if mark == Mark::ShadedBelow
                    && let Some(&(last, _)) = outline.last()
                    && last < ends.1
                {
                    outline.extend([(last, contact.1), (ends.1, contact.1)]);
                }
                Series::new(&format!("friction {friction}"), colour, mark, outline)
            })
            .collect();
        Panel::Chart(Chart {
            title: title.into(),
            x: Axis::linear("lead angle (deg)").between(ends.0, ends.1),
            y: Axis::linear("contact angle (deg)").between(contact.0, contact.1),
            series,
            notes: Vec::new(),
        })
    };
    let panels = [
        panel(
            "(a) Driving locks in the shaded region",
            "driving",
            (0.0, 80.0),
            (0.0, 90.0),
            Mark::ShadedBelow,
            locking_border_drive,
        ),
        panel(
            "(b) Back-driving locks in the shaded region",
            "back-driving",
            (0.0, 20.0),
            (70.0, 90.0),
            Mark::ShadedAbove,
            locking_border_backdrive,
        ),
    ];
    Ok(Figure {
        svg: render(&panels, 2, (620, 460))?,
        data,
    })
}

/// The crate's lock states over a grid, against the borders.
fn lock_table() -> Result<Table, Failure> {
    let failure = |error: epas_friction::Error| Failure::Data(error.to_string());
    let mut table = Table::new(
        "locking",
        "Lock states of the crate in f32 against the borders of Figure 7, on a grid of half degrees \
         (lead angle 0.25 to 79.75, contact angle 0.25 to 89.75 degrees)",
        &[
            "friction",
            "grid points",
            "driving locks",
            "back-driving locks",
            "disagreements",
        ],
    );
    for friction in FRICTIONS {
        let (mut points, mut drive, mut backdrive, mut wrong) = (0_u32, 0_u32, 0_u32, 0_u32);
        for lead in 0..160 {
            let lead_angle = (0.25 + 0.5 * f64::from(lead)).to_radians();
            for contact in 0..180 {
                let contact_angle = (0.25 + 0.5 * f64::from(contact)).to_radians();
                let geometry =
                    EfficiencyGeometry::new(lead_angle as f32, contact_angle as f32, 0.18)
                        .map_err(failure)?;
                let driving = geometry.locks(Drive::Driving, friction as f32);
                let back_driving = geometry.locks(Drive::BackDriving, friction as f32);
                // No border: driving always locks, back-driving never.
                let below = locking_border_drive(lead_angle, friction)
                    .is_none_or(|border| contact_angle <= border);
                let above = locking_border_backdrive(lead_angle, friction)
                    .is_some_and(|border| contact_angle >= border);
                points += 1;
                drive += u32::from(driving);
                backdrive += u32::from(back_driving);
                wrong += u32::from(driving != below) + u32::from(back_driving != above);
            }
        }
        table.rows.push(
            [
                friction,
                points.into(),
                drive.into(),
                backdrive.into(),
                wrong.into(),
            ]
            .map(Cell::raw)
            .into(),
        );
    }
    Ok(table)
}
