//! Pages print what is stored.

use super::{Accuracy, stored};
use crate::counts;
use epas_reference::promises;

const README: &str = include_str!("../../../../README.md");
const ACCURACY: &str = include_str!("../../../accuracy.md");

#[derive(Clone, Copy)]
enum Of {
    Largest(&'static str),
    Rms(&'static str),
}
use Of::{Largest, Rms};

/// A row of a page: how it begins, the errors of its second cell in their order, the entry of the promise whose error is of the same kind
/// (none where there is none), and the functions of which it has the cycles.
type Line = (
    &'static str,
    &'static [Of],
    Option<&'static str>,
    &'static [&'static str],
);

#[rustfmt::skip]
const ROWS_OF_README: [Line; 3] = [
    ("caged ball screw, 20 designs", &[Rms("caged_step"), Largest("caged_step")], None, &[]),
    ("37 balls", &[Rms("uncaged_torque"), Largest("uncaged_torque")], None, &[]),
    ("linear bearing, 24 balls", &[Rms("linear_step"), Largest("linear_step")], None, &[]),
];

#[rustfmt::skip]
const ROWS_OF_ACCURACY: [Line; 13] = [
    ("groove curvature: literature", &[Largest("curvature_literature"); 2], Some("literature_curvature"), &["curvature_literature"]),
    ("groove curvature: circular groove", &[Largest("curvature_circular_groove")], Some("circular_curvature"), &["curvature_circular_groove"]),
    ("groove curvature: fitted", &[Largest("curvature_fitted")], Some("fitted_curvature"), &["curvature_fitted"]),
    ("groove curvature: exact", &[Largest("curvature_exact")], Some("gothic_arch"), &["curvature_exact"]),
    ("contact ellipse", &[Largest("contact_ellipse")], Some("hertz"), &["hertz_ellipse"]),
    ("efficiency, rolling", &[Largest("efficiency_rolling")], Some("rolling_efficiency"), &["efficiency_rolling"]),
    ("efficiency, full sliding", &[Largest("efficiency_sliding")], Some("efficiency"), &["efficiency_sliding"]),
    ("caged ball screw", &[Largest("caged_step")], Some("step_caged"), &["step_caged", "step_caged_range"]),
    ("the caged one with memory", &[Largest("memory")], Some("memory"), &["step_caged_memory", "step_caged_law", "between_caged"]),
    ("ball screw with 37 balls", &[Largest("uncaged_torque"), Rms("uncaged_torque"), Largest("uncaged_forces"), Rms("uncaged_forces")],
        None, &["step_train_37", "step_train_37_shares"]),
    ("linear ball, published formula", &[Largest("linear_ball")], Some("analytic_ball"), &["linear_ball_analytic"]),
    ("cube root", &[Largest("cbrt")], Some("cbrt"), &["cbrt"]),
    ("sine and cosine", &[Largest("sin_cos")], Some("sin_cos"), &["sin_cos"]),
];

/// Cycles of the scenes that README prints in the third cell of their rows.
const CYCLES_OF_README: [(&str, &[&str]); 5] = [
    ("`CagedBallScrew`", &["step_caged"]),
    (
        "`UncagedBallScrew<37>`",
        &["step_train_37", "step_train_37_shares"],
    ),
    ("`LinearBearingTrain<24>`", &["step_linear"]),
    ("`ClosedFormScrew`", &["step_closed_form"]),
    ("`LoadProportionalScrew`", &["step_load_proportional"]),
];

fn entry(name: &str) -> Accuracy {
    let all = stored().unwrap();
    let found = all.into_iter().find(|entry| entry.name == name);
    found.unwrap_or_else(|| panic!("{name} is not stored"))
}

/// The numbers of a cell, per cent as hundredths, each with half a unit of its last digit.
fn numbers(cell: &str) -> Vec<(f64, f64)> {
    let words: Vec<&str> = cell.split_whitespace().collect();
    let number = |(place, word): (usize, &&str)| {
        let word = word.trim_matches(|sign| "(),;".contains(sign));
        let value: f64 = word.replace(',', "").parse().ok()?;
        let (digits, exponent) = word.split_once('e').unwrap_or((word, "0"));
        let decimals = digits.split_once('.').map_or(0, |(_, behind)| behind.len());
        let unit = 10_f64.powi(exponent.parse::<i32>().ok()? - decimals as i32);
        let next = words.get(place + 1);
        let scale = if next.is_some_and(|next| next.starts_with('%')) {
            0.01
        } else {
            1.0
        };
        Some((scale * value, 0.5 * scale * unit))
    };
    words.iter().enumerate().filter_map(number).collect()
}

fn counts_in(cell: &str) -> Vec<f64> {
    numbers(cell)
        .into_iter()
        .map(|(number, _)| number)
        .collect()
}

fn cycles_of(functions: &[&str]) -> Vec<f64> {
    let figures = counts::stored().unwrap();
    let cycles = |name: &&str| f64::from(figures.function(name).unwrap().cycles_max);
    functions.iter().map(cycles).collect()
}

fn prints(page: &str, rows: &[Line]) {
    for (begin, errors, promise, cycles) in rows {
        let begin = format!("| {begin}");
        let row = page.lines().find(|line| line.starts_with(&begin));
        let row = row.unwrap_or_else(|| panic!("no row begins with {begin}"));
        let cells: Vec<&str> = row.split('|').collect();
        let printed = numbers(cells[2]);
        assert!(printed.len() >= errors.len(), "{row}");
        for (of, (number, half)) in errors.iter().zip(printed) {
            let error = match of {
                Largest(name) => entry(name).largest,
                Rms(name) => entry(name).rms,
            };
            // A tie is rounded either way.
            let near = (number - error).abs() <= half * (1.0 + 1e-9);
            assert!(near, "{number:e} is printed and {error:e} stored: {row}");
        }
        if let Some(promise) = promise {
            let found = numbers(cells[2])[0].0;
            assert!(
                found > 0.0 && found <= promises::of(promise).largest,
                "{row}"
            );
        }
        if !cycles.is_empty() {
            assert_eq!(counts_in(cells[4]), cycles_of(cycles), "{row}");
        }
    }
}

#[test]
fn readme_has_the_stored_errors() {
    prints(README, &ROWS_OF_README);
    for (scene, functions) in CYCLES_OF_README {
        let begin = format!("| {scene} |");
        let row = README
            .lines()
            .find(|line| line.starts_with(&begin))
            .unwrap();
        let cycles = row.split('|').nth(3).unwrap();
        assert_eq!(counts_in(cycles), cycles_of(functions), "{row}");
    }
    for name in ["caged_step", "uncaged_torque", "linear_step"] {
        assert_eq!(entry(name).flagged, 0.0, "{name}");
    }
}

#[test]
fn accuracy_page_has_the_stored_errors() {
    prints(ACCURACY, &ROWS_OF_ACCURACY);
    let (_, table) = ACCURACY.split_once("| formula | largest error |").unwrap();
    let rows = table.lines().skip(2).take_while(|row| row.starts_with('|'));
    assert!(rows.clone().count() == ROWS_OF_ACCURACY.len());
    for (row, (begin, ..)) in rows.zip(ROWS_OF_ACCURACY) {
        assert!(row.starts_with(&format!("| {begin}")), "{row}");
    }
    let Accuracy {
        flagged, states, ..
    } = entry("uncaged_torque");
    let said = format!(
        "{} of {states} states flagged",
        (flagged * states as f64).round()
    );
    assert!(ACCURACY.contains(&said), "{said}");
    let said = format!("{} designs to 63 mm", 20);
    assert!(entry("caged_step").error.contains(&said) && ACCURACY.contains(&said));
}

#[test]
fn a_number_has_half_a_unit_of_its_last_digit() {
    let found = numbers("torque 2.8 %, rms 1.0e-5; 21 % of the largest (0.5)");
    let wanted = [(0.028, 5e-4), (1e-5, 5e-7), (0.21, 5e-3), (0.5, 0.05)];
    assert_eq!(found.len(), wanted.len());
    for ((number, half), (value, unit)) in found.into_iter().zip(wanted) {
        assert!((number / value - 1.0).abs() < 1e-12 && (half / unit - 1.0).abs() < 1e-12);
    }
}
