//! Tables A1 and A2 and Figure 10 of Bertolino et al. 2023: errors over catalogue sizes.

use epas_friction::Groove;
use epas_reference::ReferenceError;
use epas_reference::published::{Row, computed_errors};

use super::Context;
use super::document::{Block, Cell, Figure, Section, Table};
use super::forms::{FORMS, Forms, GROOVES, printed, reference};
use crate::failure::Failure;
use crate::plot::{Axis, Chart, Mark, Panel, Series, render};

/// Half a unit of the last printed digit, percent; a computed value within it prints the same.
const PRINTED_ROUNDING: f64 = 0.005 + 1e-9;

/// A row with all that is said about it.
struct Compared {
    row: &'static Row,
    computed: [f64; 4],
    errors: [(f64, f64); 4],
}

fn compare(groove: Groove) -> Result<Vec<Compared>, Failure> {
    let failure = |error: ReferenceError| Failure::Data(error.to_string());
    printed(groove)
        .iter()
        .map(|row| {
            Ok(Compared {
                row,
                computed: computed_errors(row, reference(groove)).map_err(failure)?,
                errors: Forms::of_row(groove, row).table_errors(),
            })
        })
        .collect()
}

/// The section.
pub fn section(_: &Context) -> Result<Section, Failure> {
    let mut blocks = vec![Block::text(
        "Error of the first radius of curvature over contact angles of 1 to 70 degrees, in steps of \
         one, on the 31 catalogue sizes of Tables A1 and A2 of Bertolino et al. 2023; mean and \
         largest, in percent. Printed values stand beside those computed again in float64 against the \
         Weingarten map (conformity 0.528, nominal contact angle 45 degrees, pitch radius half the \
         nominal diameter); the fitted and the exact form are the f32 code of the crate, rounding \
         included. The row printed as 20 x 65 mm has a lead of 60 mm, as its printed lead angle shows; \
         the literature column of the screw's table was computed with the groove radius in the place \
         of the ball radius.",
    )];
    let mut agreeing = 0;
    let mut values = 0;
    let mut data = Vec::new();
    for (groove, name) in GROOVES {
        let compared = compare(groove)?;
        for Compared { row, computed, .. } in &compared {
            values += computed.len();
            agreeing += computed
                .iter()
                .zip(row.errors())
                .filter(|(computed, printed)| (*computed - printed).abs() <= PRINTED_ROUNDING)
                .count();
        }
        blocks.push(Block::Table(table(groove, name, &compared)));
        data.push((name, compared));
    }
    blocks.insert(
        1,
        Block::text(format!(
            "Of the {values} printed errors, {agreeing} of {values} are reproduced to the last \
             printed digit; {} differ.",
            values - agreeing
        )),
    );
    blocks.push(Block::Figure(figure(&data)?));
    Ok(Section {
        id: "curvature-sizes",
        title: "Groove curvature: errors on catalogue sizes (Tables A1, A2, Figure 10)",
        blocks,
    })
}

fn table(groove: Groove, name: &str, compared: &[Compared]) -> Table {
    let (id, number) = match groove {
        Groove::Screw => ("table-a1", "A1"),
        Groove::Nut => ("table-a2", "A2"),
    };
    let mut table = Table::new(
        id,
        format!(
            "Table {number}, {name}: errors of the first radius of curvature (%), mean/largest; \
             printed and computed again, then the fitted and the exact form in f32"
        ),
        &[
            "diameter (mm)",
            "lead (mm)",
            "ball (mm)",
            "lead angle (deg)",
            "literature mean, printed",
            "literature mean, computed",
            "literature max, printed",
            "literature max, computed",
            "circular mean, printed",
            "circular mean, computed",
            "circular max, printed",
            "circular max, computed",
            "fitted mean",
            "fitted max",
            "exact mean",
            "exact max",
        ],
    );
    for Compared {
        row,
        computed,
        errors,
    } in compared
    {
        let mut cells = vec![
            Cell::raw(row.nominal_diameter),
            Cell::raw(row.true_lead()),
            Cell::raw(row.ball_diameter),
            Cell::fixed(row.lead_angle, 2),
        ];
        for (printed, computed) in row.errors().into_iter().zip(computed) {
            cells.push(Cell::fixed(printed, 2));
            cells.push(Cell::fixed(*computed, 4));
        }
        for (mean, largest) in errors.iter().skip(2) {
            cells.push(Cell::error(100.0 * mean));
            cells.push(Cell::error(100.0 * largest));
        }
        table.rows.push(cells);
    }
    table
}

fn figure(data: &[(&str, Vec<Compared>)]) -> Result<Figure, Failure> {
    let marks = [Mark::Circles, Mark::Crosses, Mark::Triangles, Mark::Dots];
    let panels: Vec<_> = data
        .iter()
        .map(|(name, compared)| {
            let series = FORMS
                .iter()
                .zip(marks)
                .enumerate()
                .map(|(form, (title, mark))| {
                    let points = compared
                        .iter()
                        .map(|one| (one.row.lead_angle, 100.0 * one.errors[form].0))
                        .collect();
                    Series::new(title, form, mark, points)
                })
                .collect();
            Panel::Chart(Chart {
                title: format!("First radius of curvature, {name}: mean error"),
                x: Axis::linear("lead angle (deg)"),
                y: Axis::log("mean error (%)").between(1e-6, 1e2),
                series,
                notes: Vec::new(),
            })
        })
        .collect();
    let mut table = Table::new(
        "figure-10",
        "Figure 10 of Bertolino et al. 2023, with the new forms: error of the first radius of \
         curvature on 31 catalogue sizes against the lead angle, mean over contact angles of 1 to 70 \
         degrees. The f32 forms of the crate against the float64 Weingarten map.",
        &[
            "groove",
            "diameter (mm)",
            "lead (mm)",
            "ball (mm)",
            "lead angle (deg)",
            "literature mean (%)",
            "literature max (%)",
            "circular groove mean (%)",
            "circular groove max (%)",
            "fitted mean (%)",
            "fitted max (%)",
            "exact mean (%)",
            "exact max (%)",
        ],
    );
    for (name, compared) in data {
        for one in compared {
            let mut cells = vec![
                Cell::text(*name),
                Cell::raw(one.row.nominal_diameter),
                Cell::raw(one.row.true_lead()),
                Cell::raw(one.row.ball_diameter),
                Cell::raw(one.row.lead_angle),
            ];
            for (mean, largest) in one.errors {
                cells.push(Cell::raw(100.0 * mean));
                cells.push(Cell::raw(100.0 * largest));
            }
            table.rows.push(cells);
        }
    }
    Ok(Figure {
        svg: render(&panels, 2, (620, 460))?,
        data: table,
    })
}
