//! Groove curvature: Tables A1 and A2, Figures 8 to 11 of Bertolino et al. 2023, and the new forms in
//! each.

use crate::published::{Row, TABLE_A1, TABLE_A2, computed_errors};
use epas_bench::timing;
use epas_friction::curvature::{
    CircularGrooveCurvature, FittedCurvature, GothicArch, LiteratureCurvature,
};
use epas_friction::geometry::{Groove, GrooveProfile, HelixPath};
use epas_friction::{BallScrew, CATALOGUE};
use epas_reference::curvature::{self as reference, Surface};

use super::context::Context;
use epas_bench::report::curvature::{FORMS, Forms, GROOVES, surface};
use epas_bench::report::statistics::{Errors, evenly};
use epas_bench::timing::Competition;
use epas_page::document::{Block, Cell, Figure, Section, Table};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Chart, ColourMap, Colours, Mark, Panel, Series};

/// Errors of the four forms on one size, contact angles 0 to 70 degrees, relative to the curvature.
fn size_errors(
    design: &BallScrew,
    (groove, same, _): (Groove, reference::Groove, &str),
    steps: usize,
) -> [Errors; 4] {
    let forms = Forms::of(design, groove);
    let surface = surface(design, groove, same);
    let mut errors = [Errors::default(); 4];
    for degrees in evenly(0.0, 70.0, steps) {
        let angle = degrees.to_radians() as f32;
        let exact = surface.principal(f64::from(angle)).kappa1;
        for (errors, computed) in errors.iter_mut().zip(forms.first(angle)) {
            errors.add(computed / exact - 1.0);
        }
    }
    errors
}

/// The section.
pub fn section(context: &Context) -> Result<Section, Failure> {
    let (screw, screw_matches) = published_table(
        "table_a1",
        &TABLE_A1,
        GROOVES[0],
        "Table A1, screw shaft: errors of the radius of curvature in percent, printed | computed",
    )?;
    let (nut, nut_matches) = published_table(
        "table_a2",
        &TABLE_A2,
        GROOVES[1],
        "Table A2, nut: errors of the radius of curvature in percent, printed | computed",
    )?;
    Ok(Section {
        title: "Groove curvature",
        blocks: vec![
            Block::Text(format!(
                "{} of 248 printed error values reproduce to their last digit, with conformity 0.528, \
                 nominal contact angle 45 degrees and contact angles 1, 2, ... 70 degrees; the row \
                 printed as 20 x 65 x 3.5 with its true lead of 60 mm, the literature column of Table \
                 A1 with the groove radius in the place of the ball radius (eq. (27) prints the \
                 latter). Beside them the largest errors of the fitted and the exact form in f32.",
                screw_matches + nut_matches
            )),
            Block::Table(screw),
            Block::Table(nut),
            Block::Figure(figure_8()),
            Block::Figure(figure_9()),
            Block::Text(
                "Figure 9's stated largest error of 2.38 % holds for contact angles up to 65 degrees; \
                 over the whole domain it is 5.0 %. Its means (0.84 and 0.77 %) reproduce with H = L = \
                 0.0629; L = 0.0505 is a misprint."
                    .into(),
            ),
            Block::Figure(figure_10(context.quick)?),
            Block::Figure(figure_11(context)?),
        ],
    })
}

fn published_table(
    name: &'static str,
    rows: &[Row],
    groove: (Groove, reference::Groove, &str),
    caption: &str,
) -> Result<(Table, usize), Failure> {
    let mut matches = 0;
    let mut table = Table {
        name,
        caption: caption.into(),
        columns: [
            "size (mm)",
            "lead angle (deg)",
            "literature mean",
            "literature max",
            "circular mean",
            "circular max",
            "fitted max",
            "exact f32 max",
        ]
        .map(String::from)
        .to_vec(),
        rows: Vec::new(),
    };
    for (row, size) in rows.iter().zip(CATALOGUE) {
        let computed =
            computed_errors(row, groove.1).map_err(|error| Failure::Data(error.to_string()))?;
        let degrees = row.surface(groove.1).lead_angle.to_degrees();
        let mut cells = vec![Cell::from(size.name), Cell::fixed(degrees, 2)];
        for (computed, printed) in computed.into_iter().zip(row.errors()) {
            let agrees = (computed - printed).abs() < 0.005_001;
            matches += usize::from(agrees);
            let mark = if agrees { "|" } else { "!" };
            cells.push(Cell::Number(
                computed,
                format!("{printed:.2} {mark} {computed:.3}"),
            ));
        }
        let design = size
            .design()
            .map_err(|error| Failure::Data(error.to_string()))?;
        let errors = size_errors(&design, groove, 70);
        cells.push(Cell::Number(
            100.0 * errors[2].largest,
            format!("{:.5}", 100.0 * errors[2].largest),
        ));
        cells.push(Cell::Number(
            100.0 * errors[3].largest,
            format!("{:.5}", 100.0 * errors[3].largest),
        ));
        table.rows.push(cells);
    }
    Ok((table, matches))
}

/// The design of Figures 8 and 9 at a lead angle: `r_m` 8, `r_b` 1.5875, `H = L` 0.0629 mm.
fn figure_9_forms(
    lead_degrees: f64,
    (groove, same, _): (Groove, reference::Groove, &str),
) -> (Forms, Surface) {
    const PITCH_RADIUS: f32 = 8.0;
    const BALL_RADIUS: f32 = 1.5875;
    const OFFSET: f32 = 0.0629;
    let groove_radius = 2.0 * 0.528 * BALL_RADIUS;
    let lead_angle = lead_degrees.to_radians() as f32;
    let path = HelixPath::from_lead_angle(PITCH_RADIUS, lead_angle);
    let profile = GrooveProfile {
        groove_radius,
        offset_h: OFFSET,
        offset_l: OFFSET,
    };
    let exact = GothicArch::new(groove, &path, &profile);
    let forms = Forms {
        literature: LiteratureCurvature::new(groove, PITCH_RADIUS, BALL_RADIUS),
        circular: CircularGrooveCurvature::new(groove, &path, groove_radius),
        fitted: FittedCurvature::new(&exact, 82f32.to_radians()),
        exact,
    };
    let surface = Surface {
        groove: same,
        pitch_radius: f64::from(PITCH_RADIUS),
        lead_angle: f64::from(lead_angle),
        groove_radius: f64::from(groove_radius),
        offset_h: f64::from(OFFSET),
        offset_l: f64::from(OFFSET),
    };
    (forms, surface)
}

/// Maps over lead angle (upwards) and contact angle, 0 to 80 degrees.
fn map(
    title: String,
    quantity: &str,
    bounds: &[(f64, &str)],
    value: impl Fn(f64, f64) -> f64,
) -> Panel {
    const CELLS: usize = 80;
    let centre = |cell: usize| 80.0 * (cell as f64 + 0.5) / CELLS as f64;
    Panel::Map(ColourMap {
        title,
        x: Axis::linear("contact angle (deg)").between(0.0, 80.0),
        y: Axis::linear("lead angle (deg)").between(0.0, 80.0),
        quantity: quantity.into(),
        colours: Colours::of(bounds.iter().map(|(bound, _)| bound)),
        bounds: bounds
            .iter()
            .map(|(bound, text)| (*bound, (*text).to_owned()))
            .collect(),
        values: (0..CELLS)
            .map(|row| {
                (0..CELLS)
                    .map(|column| value(centre(row), centre(column)))
                    .collect()
            })
            .collect(),
    })
}

fn figure_8() -> Figure {
    let bounds = [
        (10.0, "10"),
        (20.0, "20"),
        (50.0, "50"),
        (100.0, "100"),
        (300.0, "300"),
        (1000.0, "1000"),
    ];
    let panels = GROOVES
        .iter()
        .map(|&groove| {
            map(
                format!("{}: first radius of curvature", groove.2),
                "|radius| (mm)",
                &bounds,
                |lead, contact| {
                    let (_, surface) = figure_9_forms(lead, groove);
                    1.0 / surface.principal(contact.to_radians()).kappa1.abs()
                },
            )
        })
        .collect();
    Figure {
        name: "curvature_figure_8",
        caption:
            "Bertolino et al. 2023, Figure 8: exact first radius of curvature over lead and contact angle, pitch radius \
                  8 mm, ball radius 1.5875 mm, H = L = 0.0629 mm."
                .into(),
        panels,
        columns: 2,
        size: (540, 400),
    }
}

fn figure_9() -> Figure {
    let bounds = [
        (1e-7, "1e-7"),
        (1e-6, "1e-6"),
        (1e-5, "1e-5"),
        (1e-4, "1e-4"),
        (1e-3, "0.1 %"),
        (1e-2, "1 %"),
        (0.1, "10 %"),
        (1.0, "100 %"),
    ];
    let mut panels = Vec::new();
    for (form, name) in FORMS.iter().enumerate() {
        for groove in GROOVES {
            panels.push(map(
                format!("{}: {name}", groove.2),
                "error",
                &bounds,
                |lead, contact| {
                    let (forms, surface) = figure_9_forms(lead, groove);
                    let angle = contact.to_radians() as f32;
                    let exact = surface.principal(f64::from(angle)).kappa1;
                    forms
                        .first(angle)
                        .get(form)
                        .map_or(f64::NAN, |computed| (exact / computed - 1.0).abs())
                },
            ));
        }
    }
    Figure {
        name: "curvature_figure_9",
        caption:
            "Bertolino et al. 2023, Figure 9 with the new forms: relative error of the first radius of curvature, for \
                  screw and nut; the fitted form is fitted for contact angles to 82 degrees."
                .into(),
        panels,
        columns: 2,
        size: (540, 360),
    }
}

fn figure_10(quick: bool) -> Result<Figure, Failure> {
    let mut panels = Vec::new();
    for groove in GROOVES {
        let mut curves: [Vec<(f64, f64)>; 4] = Default::default();
        for (index, size) in CATALOGUE.iter().enumerate() {
            let design = size
                .design()
                .map_err(|error| Failure::Data(error.to_string()))?;
            let errors = size_errors(&design, groove, if quick { 70 } else { 700 });
            for (curve, errors) in curves.iter_mut().zip(errors) {
                curve.push((index as f64 + 1.0, errors.largest));
            }
        }
        let marks = [Mark::Crosses, Mark::Triangles, Mark::Circles, Mark::Circles];
        panels.push(Panel::Chart(Chart {
            title: groove.2.into(),
            x: Axis::linear("catalogue size, by lead angle").between(0.0, 32.0),
            y: Axis::log("largest relative error").between(1e-8, 10.0),
            series: curves
                .into_iter()
                .enumerate()
                .map(|(form, curve)| Series::new(FORMS[form], form, marks[form], curve))
                .collect(),
            notes: Vec::new(),
        }));
    }
    Ok(Figure {
        name: "curvature_figure_10",
        caption: "Bertolino et al. 2023, Figure 10 with the new forms: largest error of the first curvature over contact \
                  angles 0 to 70 degrees, for the 31 sizes in the order of Table A1."
            .into(),
        panels,
        columns: 2,
        size: (540, 400),
    })
}

/// Shares of the rounds over the time of a call, within `ends`.
fn histogram(entry: &Competition, colour: usize, name: &str, ends: (f64, f64)) -> Series {
    const BINS_A_DECADE: f64 = 40.0;
    let mut counts = std::collections::BTreeMap::new();
    let inside = |time: &&f64| (ends.0..ends.1).contains(*time);
    for time in entry.latency.rounds.iter().filter(inside) {
        *counts
            .entry((time.log10() * BINS_A_DECADE).floor() as i64)
            .or_insert(0_u32) += 1;
    }
    let total = entry.latency.rounds.len().max(1) as f64;
    let mut points = Vec::new();
    if let (Some(first), Some(last)) = (counts.keys().next(), counts.keys().last()) {
        for bin in first - 1..=last + 1 {
            let share = f64::from(counts.get(&bin).copied().unwrap_or(0)) / total;
            for edge in [bin, bin + 1] {
                points.push((10f64.powf(edge as f64 / BINS_A_DECADE), 100.0 * share));
            }
        }
    }
    Series::new(name, colour, Mark::ShadedBelow, points)
}

fn figure_11(context: &Context) -> Result<Figure, Failure> {
    let keys = [
        ("literature_angle", "literature, f32"),
        ("circular_groove_angle", "circular groove, f32"),
        ("fitted_angle", "fitted, f32"),
        ("exact_angle", "exact, f32"),
        ("weingarten_printed_f64", "Weingarten map as printed, f64"),
        ("appendix_b_f64", "Appendix B, f64"),
    ];
    let ends = (
        0.5 * timing::times(&context.competition, keys[0].0)?
            .latency
            .at_least_resolved(),
        4.0 * timing::times(&context.competition, keys[5].0)?
            .latency
            .at_least_resolved(),
    );
    let mut series = Vec::new();
    for (colour, (key, name)) in keys.into_iter().enumerate() {
        series.push(histogram(
            timing::times(&context.competition, key)?,
            colour,
            name,
            ends,
        ));
    }
    Ok(Figure {
        name: "curvature_figure_11",
        caption: "Bertolino et al. 2023, Figure 11: times of one call from the contact angle on this machine, each call \
                  waiting for the one before, over all rounds (rounds that the machine interrupted lie beyond \
                  the right edge)."
            .into(),
        panels: vec![Panel::Chart(Chart {
            title: String::new(),
            x: Axis::log("time of one call (ns)").between(ends.0, ends.1),
            y: Axis::linear("share of rounds (%)"),
            series,
            notes: Vec::new(),
        })],
        columns: 1,
        size: (1080, 380),
    })
}
