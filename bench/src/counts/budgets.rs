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

    use super::*;
    use crate::counts::stored;

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

    #[test]
    fn every_promise_of_cycles_is_counted() {
        for promise in PROMISES.all() {
            let counted = !promise.counted.is_empty();
            assert_eq!(promise.cycles > 0, counted, "{}", promise.name);
        }
    }

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
