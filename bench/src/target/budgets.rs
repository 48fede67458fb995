//! What the crate promises to cost, beside what was counted: every number stands in
//! [`promises`](epas_friction::promises).

use epas_friction::promises::{ALL, FOOTPRINTS, Footprint, STEP_SPREAD};

use super::figures::{Figures, SceneFigures};
use crate::failure::Failure;

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
    for promise in ALL {
        for &name in promise.counted {
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
                most: STEP_SPREAD,
                found: Some(f64::from(entry.cycles_max) / f64::from(entry.cycles_min)),
            });
        }
    }
    for footprint in FOOTPRINTS {
        budgets.extend(sizes(&footprint, figures.scene(footprint.scene)));
    }
    budgets
}

fn sizes(promised: &Footprint, found: Option<&SceneFigures>) -> [Budget; 4] {
    type Size = fn(&SceneFigures) -> u64;
    let sizes: [(&str, u32, Size); 4] = [
        ("flash", promised.flash, |scene| scene.flash),
        ("flash, built for size", promised.flash_small, |scene| {
            scene.flash_small
        }),
        ("RAM", promised.ram, |scene| scene.ram),
        ("stack", promised.stack, |scene| {
            scene.stack.max(scene.stack_small)
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
        "promises of src/promises.rs that do not hold:\n{}",
        broken.join("\n")
    )))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use epas_firmware::subjects::SUBJECTS;
    use epas_friction::promises::Promise;

    use super::*;
    use crate::target::stored;

    /// The stored counts are those of the crate's functions, each has one promise, and all promises hold.
    #[test]
    fn every_stored_count_keeps_its_promise() {
        let figures = stored::figures().unwrap();
        require(&figures).unwrap();
        let counted: BTreeSet<&str> = SUBJECTS.iter().map(|subject| subject.name).collect();
        let promised: Vec<&str> = ALL
            .iter()
            .flat_map(|promise| promise.counted.iter().copied())
            .collect();
        let distinct: BTreeSet<&str> = promised.iter().copied().collect();
        assert_eq!(distinct.len(), promised.len(), "{promised:?}");
        assert_eq!(distinct, counted);
        for subject in SUBJECTS {
            assert!(figures.function(subject.name).is_some(), "{}", subject.name);
        }
        for scene in &figures.scenes {
            assert!(
                FOOTPRINTS
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
        for Promise {
            function,
            cycles,
            counted,
            ..
        } in ALL
        {
            assert_eq!(cycles > 0, !counted.is_empty(), "{function}");
        }
    }

    #[test]
    fn a_broken_promise_fails() {
        let mut figures = stored::figures().unwrap();
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
