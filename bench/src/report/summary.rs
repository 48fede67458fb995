//! Error against run time of every formula: the table and the picture.

use super::Context;
use super::curvature::{self, FORMS};
use super::statistics::Errors;
use super::times::{quartiles, ratio, time};
use super::{efficiency, hertz};
use crate::report::draw::{figure, table};
use crate::timing;
use epas_page::document::{Block, Cell, Section, Table};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Chart, Mark, Note, Panel, Series};

const CURVATURE: &str = "31 sizes, both grooves, contact angles 0-70 deg";
const EFFICIENCY: &str = "friction to 0.3, lead to 60, contact 10-80 deg";

/// Name, mark, and keys of the times, texts and errors of points.
type PointGroup<'a> = (&'a str, Mark, Vec<&'a str>, &'a [&'a str], &'a [f64]);

/// Key of the time, name, kind of error and domain of each formula.
#[rustfmt::skip]
const FORMULAS: [[&str; 4]; 8] = [
    ["literature", "curvature: literature (27),(28)", "relative", CURVATURE],
    ["circular_groove", "curvature: circular groove (25),(26)", "relative", CURVATURE],
    ["fitted", "curvature: fitted", "relative", CURVATURE],
    ["exact", "curvature: exact, both curvatures", "relative", CURVATURE],
    ["hertz_ellipse", "contact ellipse under a load", "relative", "radius ratios 1 to 1e5"],
    ["efficiency_rolling", "efficiency: rolling (3)", "absolute", EFFICIENCY],
    ["efficiency_sliding", "efficiency: full sliding (14)", "absolute", EFFICIENCY],
    ["efficiency_sliding", "loss of full sliding", "relative", EFFICIENCY],
];

/// Key of the time, name and printed ratio of each curvature.
#[rustfmt::skip]
const CURVATURES: [[&str; 3]; 12] = [
    ["literature", "literature, cosine given", "1"],
    ["circular_groove", "circular groove, cosine given", "1.32"],
    ["fitted", "fitted, cosine and sine given", ""],
    ["exact", "exact f32, cosine and sine given", "71.5"],
    ["literature_angle", "literature, from the angle", "1"],
    ["circular_groove_angle", "circular groove, from the angle", "1.32"],
    ["fitted_angle", "fitted, from the angle", ""],
    ["exact_angle", "exact f32, from the angle", "71.5"],
    ["literature_f64", "literature, f64", "1"],
    ["weingarten_f64", "Weingarten map in the Frenet frame, f64", ""],
    ["weingarten_printed_f64", "Weingarten map as printed, f64", ""],
    ["appendix_b_f64", "Appendix B, f64", "71.5"],
];

pub fn section(context: &Context) -> Result<Section, Failure> {
    let [literature, circular, fitted, exact] = curvature::catalogue_errors(context.quick)?;
    let [rolling, sliding, loss] = efficiency::form_errors(context.quick)?;
    let ellipse = hertz::largest_error(context.quick)?;
    let errors = [
        &literature,
        &circular,
        &fitted,
        &exact,
        &ellipse,
        &rolling,
        &sliding,
        &loss,
    ];
    Ok(Section {
        title: "Error against run time",
        blocks: vec![
            Block::Text(
                "Errors in f32 against the float64 reference; times of one call on this machine, the empty \
                 call taken off, every competitor in the same run. Latency: each call waits for the one before, \
                 as in a control loop. Throughput: calls are independent. A time that cannot be told from an \
                 empty call reads as less than what can be told. The unit is one multiplication with an addition in a \
                 chain where each waits for the one before, timed beside every batch: ratios, with the quartiles of the rounds, \
                 come out the same on a machine that is busy with other things."
                    .into(),
            ),
            Block::Table(errors_and_times(context, errors)?),
            Block::Table(ratios(context)?),
            Block::Text(
                "Why the exact form costs a few times the literature formula and not the paper's 71 times: the \
                 paper times Appendix B, some 730 operations with powers taken again and again, in an \
                 interpreter whose call costs more than the short formulas themselves (its own circular-groove \
                 form is 1.32 times the literature's there, and the same operations here). In orthonormal \
                 directions the shape operator takes 44 operations, two roots and one division, and one of the \
                 roots does not wait for the other."
                    .into(),
            ),
            picture(context, &[literature, circular, fitted, exact])?,
        ],
    })
}

fn errors_and_times(context: &Context, errors: [&Errors; 8]) -> Result<Table, Failure> {
    let mut rows = Vec::new();
    for ([key, name, kind, domain], errors) in FORMULAS.into_iter().zip(errors) {
        let times = timing::times(&context.competition, key)?;
        rows.push(vec![
            Cell::from(name),
            Cell::power(errors.largest),
            Cell::power(errors.rms()),
            Cell::power(errors.mean()),
            kind.into(),
            time(&times.latency, 2),
            ratio(times.latency.over_unit(), 1),
            time(&times.throughput, 2),
            domain.into(),
        ]);
    }
    let step = timing::times(&context.competition, "step_caged")?;
    rows.push(vec![
        "caged ball screw: step()".into(),
        "".into(),
        "".into(),
        "".into(),
        "".into(),
        time(&step.latency, 2),
        ratio(step.latency.over_unit(), 1),
        time(&step.throughput, 2),
        "one tick in the interrupt".into(),
    ]);
    Ok(table(
        "summary",
        "Error and run time",
        "formula | largest error | rms | mean | kind | latency (ns) | in multiply-adds | \
         throughput (ns) | domain",
        rows,
    ))
}

/// Ratios in the paper's own terms, from the contact angle on, with the exact models beside.
fn ratios(context: &Context) -> Result<Table, Failure> {
    let mut rows = Vec::new();
    for [key, name, printed] in CURVATURES {
        let times = timing::times(&context.competition, key)?;
        rows.push(vec![
            Cell::from(name),
            time(&times.latency, 2),
            quartiles(&times.latency, 2),
            ratio(times.ratios.0, 2),
            printed.into(),
            time(&times.throughput, 2),
            ratio(times.ratios.1, 2),
        ]);
    }
    Ok(table(
        "curvature_times",
        "Curvature: time of one call over that of the literature formula of the same kind",
        "formula | latency (ns) | quartiles | ratio | printed ratio | throughput (ns) | ratio",
        rows,
    ))
}

fn picture(context: &Context, errors: &[Errors; 4]) -> Result<Block, Failure> {
    let doubles = curvature::double_errors()?;
    let errors = errors.map(|errors| errors.largest);
    let keys = |rows: &[[&'static str; 3]]| rows.iter().map(|[key, ..]| *key).collect();
    let groups: [PointGroup; 3] = [
        (
            "f32, cosine and sine given",
            Mark::Triangles,
            keys(&CURVATURES[..4]),
            &FORMS,
            &errors,
        ),
        (
            "f32, from the contact angle",
            Mark::Circles,
            keys(&CURVATURES[4..8]),
            &FORMS,
            &errors,
        ),
        (
            "f64 reference, from the contact angle",
            Mark::Crosses,
            vec!["weingarten_f64", "appendix_b_f64"],
            &["Weingarten map", "Appendix B"],
            &doubles,
        ),
    ];
    let mut series = Vec::new();
    let mut notes = Vec::new();
    for (colour, (name, mark, keys, texts, errors)) in groups.into_iter().enumerate() {
        let mut places = Vec::new();
        for ((key, text), error) in keys.into_iter().zip(texts).zip(errors) {
            let times = timing::times(&context.competition, key)?;
            let at = (times.latency.at_least_resolved(), *error);
            places.push(at);
            notes.push(Note {
                at,
                text: (*text).into(),
            });
        }
        series.push(Series::new(name, colour, mark, places));
    }
    Ok(figure(
        "error_against_time",
        "Groove curvature: largest error against the time of one call. Latency on this machine, 31 \
                  catalogue sizes, screw and nut, contact angles 0 to 70 degrees. The exact form gives both \
                  curvatures. The error of the reference is the difference of its separate \
                  derivations.",
        (1, 1080, 560),
        vec![Panel::Chart(Chart {
            title: "Groove curvature: error against run time".into(),
            x: Axis::log("time of one call (ns)").between(1.0, 1000.0),
            y: Axis::log("largest relative error of the first curvature").between(1e-16, 10.0),
            series,
            notes,
        })],
    ))
}
