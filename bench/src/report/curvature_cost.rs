//! Figure 11 of Bertolino et al. 2023 and error against run time.

use epas_reference::published::TABLE_A1;

use super::Context;
use super::document::{Block, Cell, Figure, Section, Table};
use super::forms::{FORMS, Forms, GROOVES, printed, reference};
use crate::failure::Failure;
use crate::plot::{Axis, Chart, Mark, Note, Panel, Series, render};
use crate::timing::{Competition, Measure};

/// Largest errors over the 31 sizes, both grooves, contact angles of 1 to 70 degrees.
struct Errors {
    forms: [f64; 4],
    /// Weingarten map as printed, against the one in the Frenet frame.
    weingarten: f64,
    /// Appendix B, corrected.
    appendix_b: f64,
}

fn errors() -> Errors {
    let mut errors = Errors {
        forms: [0.0; 4],
        weingarten: 0.0,
        appendix_b: 0.0,
    };
    for (groove, _) in GROOVES {
        for row in printed(groove) {
            let forms = Forms::of_row(groove, row);
            for (error, (_, largest)) in errors.forms.iter_mut().zip(forms.table_errors()) {
                *error = error.max(largest);
            }
            let surface = row.surface(reference(groove));
            for degrees in 1..=70 {
                let angle = f64::from(degrees).to_radians();
                let truth = surface.principal(angle).kappa1;
                let printed = surface.principal_cartesian(angle).kappa1;
                errors.weingarten = errors.weingarten.max((printed / truth - 1.0).abs());
                let appendix = surface.appendix_b(angle);
                errors.appendix_b = errors.appendix_b.max((appendix / truth - 1.0).abs());
            }
        }
    }
    errors
}

/// One form under one way of calling, with its error.
struct Contender<'a> {
    time: &'a Competition,
    error: f64,
    operations: &'static str,
}

const KEYS: [&str; 4] = ["literature", "circular_groove", "fitted", "exact"];
const KEYS_FROM_ANGLE: [&str; 4] = [
    "literature_angle",
    "circular_groove_angle",
    "fitted_angle",
    "exact_angle",
];
/// What a call computes beside cosine and sine of the contact angle.
const OPERATIONS: [&str; 4] = [
    "1 division, 2 others",
    "1 division, 2 others",
    "1 division, 8 others",
    "2 divisions, 2 roots, 40 others",
];

/// The section.
pub fn section(context: &Context) -> Result<Section, Failure> {
    let errors = errors();
    let contenders = contenders(context, &errors)?;
    let given = context.time("exact")?;
    let angle = context.time("exact_angle")?;
    let appendix = context.time("appendix_b_f64")?;
    let weingarten = context.time("weingarten_f64")?;
    let blocks = vec![
        Block::text(
            "Run times on this machine, in one run: the functions take turns, batch by batch, over the \
             same 256 inputs, and the time of an empty call is subtracted in each round. Latency is the \
             time until an answer is there that the next call waits for; throughput the time a call \
             takes where calls are independent and the processor overlaps them. The ratio is the median, \
             over the rounds, of the time over that of the literature formula in the same round. For \
             the f32 forms there are two ways of calling: with cosine and sine of the contact angle at \
             hand, and from the contact angle itself, as the paper's formulas are written and timed.",
        ),
        Block::Table(table(&contenders)),
        Block::Figure(scatter(&contenders)?),
        Block::Figure(histograms(context)?),
        Block::text(format!(
            "Bertolino et al. 2023 print 0.249, 0.328 and 17.81 microseconds for literature formula, \
             circular groove and exact solution: ratios of 1.32 and 71. Here the exact form takes {:.2} \
             times the literature formula's time from the contact angle, and {:.2} times with cosine and \
             sine at hand. Three things make the difference. First, the paper's exact solution is the \
             expanded formula of its Appendix B, about 730 operations; the same curvature follows from \
             the shape operator in orthonormal directions with 2 divisions, 2 square roots and 40 other \
             operations, after everything that depends on the design alone has been folded at set-up, \
             and both curvatures come out. Second, cosine and sine of the contact angle are more work \
             than the literature formula, and every form needs the cosine. Third, compiled code has none \
             of the interpreter's overhead: Appendix B itself, compiled in float64, takes {:.1} times its \
             literature formula's time here, and the Weingarten map by its definition {:.1} times.",
            angle.ratios.0, given.ratios.0, appendix.ratios.0, weingarten.ratios.0,
        )),
        Block::text(format!(
            "The circular groove costs as much as the literature formula ({:.2} times from the angle, \
             {:.2} with cosine and sine at hand), because dividing its numerator and denominator by the \
             squared cosine of the lead angle leaves the same operations. The fitted form ({:.2} and \
             {:.2} times) adds six multiplications and additions. With cosine and sine at hand and \
             independent calls the ratios say little: a formula with one division hides almost entirely \
             behind the reading of its inputs, so that the unit is a fraction of a nanosecond.",
            context.time("circular_groove_angle")?.ratios.0,
            context.time("circular_groove")?.ratios.0,
            context.time("fitted_angle")?.ratios.0,
            context.time("fitted")?.ratios.0,
        )),
    ];
    Ok(Section {
        id: "curvature-cost",
        title: "Groove curvature: error against run time (Figure 11)",
        blocks,
    })
}

fn contenders<'a>(context: &'a Context, errors: &Errors) -> Result<Vec<Contender<'a>>, Failure> {
    let mut contenders = Vec::new();
    for keys in [KEYS, KEYS_FROM_ANGLE] {
        for ((key, error), operations) in keys.into_iter().zip(errors.forms).zip(OPERATIONS) {
            contenders.push(Contender {
                time: context.time(key)?,
                error,
                operations,
            });
        }
    }
    for (key, error, operations) in [
        ("literature_f64", errors.forms[0], OPERATIONS[0]),
        (
            "circular_groove_f64",
            errors.forms[1],
            "1 division, 4 others",
        ),
        ("weingarten_f64", errors.weingarten, "by its definition"),
        (
            "weingarten_printed_f64",
            errors.weingarten,
            "by its definition",
        ),
        ("appendix_b_f64", errors.appendix_b, "about 730"),
    ] {
        contenders.push(Contender {
            time: context.time(key)?,
            error,
            operations,
        });
    }
    Ok(contenders)
}

/// Median with its quartiles, ns.
pub fn shown(measure: &Measure) -> [Cell; 2] {
    let (low, high) = measure.quartiles;
    [
        Cell::fixed(measure.median, 2),
        Cell::text(format!("{low:.2} to {high:.2}")),
    ]
}

fn table(contenders: &[Contender]) -> Table {
    let mut table = Table::new(
        "curvature-cost",
        "Largest error of the first radius of curvature (31 sizes, both grooves, contact angles 1 to 70 \
         degrees) and time of one call: median and quartiles over the rounds, ratio to the literature \
         formula called the same way",
        &[
            "called",
            "form",
            "operations",
            "largest error",
            "latency (ns)",
            "quartiles (ns)",
            "ratio, latency",
            "throughput (ns)",
            "quartiles, throughput (ns)",
            "ratio, throughput",
        ],
    );
    for Contender {
        time,
        error,
        operations,
    } in contenders
    {
        let mut cells = vec![
            Cell::text(time.group),
            Cell::text(time.name),
            Cell::text(*operations),
            Cell::error(*error),
        ];
        cells.extend(shown(&time.latency));
        cells.push(Cell::fixed(time.ratios.0, 2));
        cells.extend(shown(&time.throughput));
        cells.push(Cell::fixed(time.ratios.1, 2));
        table.rows.push(cells);
    }
    table
}

fn scatter(contenders: &[Contender]) -> Result<Figure, Failure> {
    /// Float64's own rounding: an error below cannot be told.
    const FLOOR: f64 = 1e-16;
    let groups = [
        ("f32, cosine and sine at hand", 0, Mark::Triangles),
        ("f32, from the contact angle", 1, Mark::Circles),
        ("f64, from the contact angle", 6, Mark::Crosses),
    ];
    let place = |contender: &Contender| (contender.time.latency.median, contender.error.max(FLOOR));
    let mut rest = contenders;
    let mut series = Vec::new();
    let mut notes = Vec::new();
    for ((name, colour, mark), count) in groups.into_iter().zip([4, 4, 5]) {
        let (group, others) = rest.split_at(count.min(rest.len()));
        rest = others;
        series.push(Series::new(
            name,
            colour,
            mark,
            group.iter().map(place).collect(),
        ));
        for contender in group {
            let (time, error) = place(contender);
            // The two float64 points above lie on those of the f32 forms.
            let short = contender
                .time
                .name
                .split([',', '('])
                .next()
                .unwrap_or_default();
            let text = match contender.time.key {
                "weingarten_printed_f64" | "literature_f64" | "circular_groove_f64" => continue,
                "weingarten_f64" => "Weingarten map, two ways",
                _ => short.trim(),
            };
            notes.push(Note {
                at: (time, error),
                text: text.to_owned(),
                left: mark == Mark::Triangles,
            });
        }
    }
    let chart = Chart {
        title: "Largest error of the first radius of curvature against the time of a call".into(),
        x: Axis::log("latency of one call (ns)").between(1.0, 1000.0),
        y: Axis::log("largest relative error on the 31 sizes").between(1e-16, 10.0),
        series,
        notes,
    };
    let mut data = Table::new(
        "error-against-time",
        "Error against run time, latency of one call on this machine. The circular groove gains two orders \
         of magnitude of accuracy for nothing, the fitted form another four for a nanosecond or two; \
         the exact form gives both curvatures.",
        &["called", "form", "largest error", "latency (ns)"],
    );
    for contender in contenders {
        data.rows.push(vec![
            Cell::text(contender.time.group),
            Cell::text(contender.time.name),
            Cell::raw(contender.error),
            Cell::raw(contender.time.latency.median),
        ]);
    }
    Ok(Figure {
        svg: render(&[Panel::Chart(chart)], 1, (1000, 600))?,
        data,
    })
}

/// Figure 11.
fn histograms(context: &Context) -> Result<Figure, Failure> {
    const BINS_PER_DECADE: f64 = 60.0;
    let bin = |time: f64| (time.log10() * BINS_PER_DECADE).floor();
    let edge = |bin: f64| 10f64.powf(bin / BINS_PER_DECADE);
    let row = TABLE_A1[15];
    let mut data = Table::new(
        "figure-11",
        format!(
            "Figure 11 of Bertolino et al. 2023 on this machine: times of one call in each round of the \
             run, screw {} x {} x {} mm, from the contact angle (latency). f32 forms, and Appendix B in \
             float64, which the paper timed as its exact solution.",
            row.nominal_diameter, row.lead, row.ball_diameter
        ),
        &["form", "round", "time (ns)"],
    );
    let mut series = Vec::new();
    let forms = KEYS_FROM_ANGLE.into_iter().zip(FORMS);
    let all = forms.chain([("appendix_b_f64", "Appendix B, f64")]);
    for (colour, (key, name)) in all.enumerate() {
        let rounds = &context.time(key)?.latency.rounds;
        for (round, &time) in rounds.iter().enumerate() {
            data.rows.push(vec![
                Cell::text(name),
                Cell::raw(round as f64),
                Cell::raw(time),
            ]);
        }
        let mut counts = std::collections::BTreeMap::new();
        for &time in rounds.iter().filter(|time| **time > 0.0) {
            *counts.entry(bin(time) as i64).or_insert(0_u32) += 1;
        }
        let mut outline = Vec::new();
        if let (Some((&first, _)), Some((&last, _))) =
            (counts.first_key_value(), counts.last_key_value())
        {
            for index in first - 1..=last + 1 {
                let count = counts.get(&index).copied().unwrap_or(0);
                let share = 100.0 * f64::from(count) / rounds.len() as f64;
                outline.push((edge(index as f64), share));
                outline.push((edge(index as f64 + 1.0), share));
            }
        }
        series.push(Series::new(name, colour, Mark::ShadedBelow, outline));
    }
    let chart = Chart {
        title: "Distribution of the time of one call, from the contact angle".into(),
        x: Axis::log("latency of one call (ns)").between(10.0, 1000.0),
        y: Axis::linear("share of the rounds (%)").between(0.0, 100.0),
        series,
        notes: Vec::new(),
    };
    Ok(Figure {
        svg: render(&[Panel::Chart(chart)], 1, (1000, 420))?,
        data,
    })
}
