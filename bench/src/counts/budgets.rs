//! What the crate promises to cost, beside what was counted: every number is in [`promises`](epas_reference::promises).

use epas_reference::promises::{Footprint, PROMISES};

use super::figures::{Figures, SceneFigures};
use epas_page::failure::Failure;

/// One promise of a cost, and what was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Budget {
    /// Function or scene, and what is limited.
    pub what: String,
    /// The promise.
    pub most: f64,
    /// What was counted or measured; none where nothing was.
    pub found: Option<f64>,
}

impl Budget {
    /// Whether the promise is kept: what was not counted keeps none.
    pub fn is_kept(&self) -> bool {
        self.found.is_some_and(|found| found <= self.most)
    }
}

/// Every promise of a cost: cycles of each counted function, how much they differ from step to step, and
/// the size of each scene.
pub fn budgets(figures: &Figures) -> Vec<Budget> {
    let mut budgets = Vec::new();
    for promise in PROMISES.all() {
        for name in &promise.counted {
            budgets.push(Budget {
                what: format!("{name}: cycles"),
                most: f64::from(promise.cycles),
                found: figures
                    .function(name)
                    .map(|entry| f64::from(entry.cycles_max)),
            });
        }
    }
    for entry in &figures.functions {
        if entry.name.starts_with("step_") {
            budgets.push(Budget {
                what: format!("{}: most over least cycles", entry.name),
                most: PROMISES.step_spread,
                found: Some(f64::from(entry.cycles_max) / f64::from(entry.cycles_min)),
            });
        }
    }
    for footprint in &PROMISES.footprints {
        budgets.extend(sizes(footprint, figures.scene(&footprint.scene)));
    }
    budgets
}

fn sizes(promised: &Footprint, found: Option<&SceneFigures>) -> [Budget; 5] {
    type Size = fn(&SceneFigures) -> u64;
    let sizes: [(&str, u32, Size); 5] = [
        ("flash", promised.flash, |scene| scene.flash),
        ("flash, built for size", promised.flash_small, |scene| {
            scene.flash_small
        }),
        ("RAM", promised.ram, |scene| scene.ram),
        ("stack", promised.stack, |scene| {
            scene.stack.max(scene.stack_small)
        }),
        ("stack of the set-up", promised.stack_set_up, |scene| {
            scene.stack_set_up
        }),
    ];
    sizes.map(|(quantity, most, size)| Budget {
        what: format!("{}: {quantity}", promised.scene),
        most: f64::from(most),
        found: found.map(|scene| size(scene) as f64),
    })
}

/// Fails where a promise is broken.
pub fn require(figures: &Figures) -> Result<(), Failure> {
    let broken: Vec<String> = budgets(figures)
        .into_iter()
        .filter(|budget| !budget.is_kept())
        .map(|Budget { what, most, found }| match found {
            Some(found) => format!("  {what}: {found} where {most} is promised"),
            None => format!("  {what}: promised and not counted"),
        })
        .collect();
    if broken.is_empty() {
        return Ok(());
    }
    Err(Failure::Data(format!(
        "promises of host-tests/promises.toml that do not hold:\n{}",
        broken.join("\n")
    )))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use epas_reference::promises;

    use super::*;
    use crate::counts::stored;

    /// Each stored count has one promise, and all promises hold. (`epas-target` holds the counts to the functions that the firmware counts.)
    #[test]
    fn every_stored_count_keeps_its_promise() {
        let figures = stored().unwrap();
        require(&figures).unwrap();
        let promised: Vec<&str> = PROMISES
            .all()
            .flat_map(|promise| promise.counted.iter().map(String::as_str))
            .collect();
        let distinct: BTreeSet<&str> = promised.iter().copied().collect();
        assert_eq!(distinct.len(), promised.len(), "{promised:?}");
        for name in promised {
            assert!(figures.function(name).is_some(), "{name}");
        }
        for scene in &figures.scenes {
            assert!(
                PROMISES
                    .footprints
                    .iter()
                    .any(|footprint| footprint.scene == scene.name),
                "{}",
                scene.name
            );
        }
    }

    /// A function of the loop is counted; only what runs at set-up has no cycles.
    #[test]
    fn every_promise_of_cycles_is_counted() {
        for promise in PROMISES.all() {
            let counted = !promise.counted.is_empty();
            assert_eq!(promise.cycles > 0, counted, "{}", promise.name);
        }
    }

    /// A promise far above what it is for says nothing.
    #[test]
    fn no_promise_of_cycles_is_far_above_its_count() {
        let figures = stored().unwrap();
        let count = |name: &String| figures.function(name).unwrap().cycles_max;
        for promise in PROMISES.all() {
            let cycles = promise.cycles;
            let Some(most) = promise.counted.iter().map(count).max() else {
                continue;
            };
            // Derived: numbers that are easy to read lie so close.
            let room = (most / 20).max(20);
            assert!(
                (most..=most + room).contains(&cycles),
                "{}: {most} counted, {cycles} promised",
                promise.name
            );
        }
    }

    /// What the page of accuracy says of a formula.
    struct Line {
        /// How its row begins.
        row: &'static str,
        /// Entry of the promise whose error is of the same kind; none where there is none.
        error: Option<&'static str>,
        /// What its cycles are of, in their order.
        cycles: &'static [&'static str],
    }

    const fn line(
        row: &'static str,
        error: Option<&'static str>,
        cycles: &'static [&'static str],
    ) -> Line {
        Line { row, error, cycles }
    }

    /// Every row of the page's table, in its order.
    const LINES: [Line; 13] = [
        line(
            "groove curvature: literature",
            Some("literature_curvature"),
            &["curvature_literature"],
        ),
        line(
            "groove curvature: circular groove",
            Some("circular_curvature"),
            &["curvature_circular_groove"],
        ),
        line(
            "groove curvature: fitted",
            Some("fitted_curvature"),
            &["curvature_fitted"],
        ),
        line(
            "groove curvature: exact",
            Some("gothic_arch"),
            &["curvature_exact"],
        ),
        line("contact ellipse", Some("hertz"), &["hertz_ellipse"]),
        line(
            "efficiency, rolling",
            Some("rolling_efficiency"),
            &["efficiency_rolling"],
        ),
        line(
            "efficiency, full sliding",
            Some("efficiency"),
            &["efficiency_sliding"],
        ),
        line(
            "caged ball screw",
            Some("step_caged"),
            &["step_caged", "step_caged_range"],
        ),
        line(
            "the caged one with memory",
            Some("memory"),
            &["step_caged_memory", "step_caged_law", "between_caged"],
        ),
        line(
            "ball screw with 37 balls",
            None,
            &["step_train_37", "step_train_37_shares"],
        ),
        line(
            "linear ball, published formula",
            Some("analytic_ball"),
            &["linear_ball_analytic"],
        ),
        line("cube root", Some("cbrt"), &["cbrt"]),
        line("sine and cosine", Some("sin_cos"), &["sin_cos"]),
    ];

    /// The numbers of a cell, a per cent as a hundredth.
    fn numbers(cell: &str) -> Vec<f64> {
        let words: Vec<&str> = cell.split_whitespace().collect();
        words
            .iter()
            .enumerate()
            .filter_map(|(place, word)| {
                let word = word.trim_matches(|sign| "(),;".contains(sign));
                let number: f64 = word.replace(',', "").parse().ok()?;
                let per_cent = words
                    .get(place + 1)
                    .is_some_and(|next| next.starts_with('%'));
                Some(if per_cent { 0.01 * number } else { number })
            })
            .collect()
    }

    /// README prints the stored cycles of each scene.
    #[test]
    fn readme_has_the_stored_cycles() {
        let figures = stored().unwrap();
        let readme = include_str!("../../../README.md");
        for (scene, counted) in [
            ("`CagedBallScrew`", &["step_caged"] as &[&str]),
            (
                "`UncagedBallScrew<37>`",
                &["step_train_37", "step_train_37_shares"],
            ),
            ("`LinearBearingTrain<24>`", &["step_linear"]),
            ("`ClosedFormScrew`", &["step_closed_form"]),
            ("`LoadProportionalScrew`", &["step_load_proportional"]),
        ] {
            let row = format!("| {scene} |");
            let row = readme.lines().find(|line| line.starts_with(&row)).unwrap();
            let cells: Vec<&str> = row.split('|').collect();
            let cycles: Vec<f64> = counted
                .iter()
                .map(|name| f64::from(figures.function(name).unwrap().cycles_max))
                .collect();
            assert_eq!(numbers(cells[3]), cycles, "{row}");
        }
    }

    /// The page of accuracy prints what was found: errors are within the promises, cycles are those that are stored.
    #[test]
    fn accuracy_page_is_within_the_promises() {
        let figures = stored().unwrap();
        let page = include_str!("../../accuracy.md");
        let (_, table) = page.split_once("| formula | largest error |").unwrap();
        let rows: Vec<&str> = table
            .lines()
            .skip(2)
            .take_while(|row| row.starts_with('|'))
            .collect();
        assert_eq!(rows.len(), LINES.len());
        for (text, line) in rows.into_iter().zip(LINES) {
            let cells: Vec<&str> = text.split('|').map(str::trim).collect();
            let [_, row, error, _, cycles, ..] = cells[..] else {
                panic!("{text}");
            };
            assert!(row.starts_with(line.row), "{text}");
            if let Some(promise) = line.error {
                let found = numbers(error)[0];
                let largest = promises::of(promise).largest;
                assert!(found > 0.0 && found <= largest, "{text}");
            }
            let counted: Vec<f64> = line
                .cycles
                .iter()
                .map(|name| f64::from(figures.function(name).unwrap().cycles_max))
                .collect();
            assert_eq!(numbers(cycles), counted, "{text}");
        }
    }

    #[test]
    fn a_broken_promise_fails() {
        let mut figures = stored().unwrap();
        figures.functions[0].cycles_max += 1000;
        figures.functions.pop();
        let Err(Failure::Data(message)) = require(&figures) else {
            panic!("a thousand cycles more pass");
        };
        assert!(message.contains("curvature_literature"), "{message}");
        figures.functions.clear();
        assert!(require(&figures).is_err());
    }
}
