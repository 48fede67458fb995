//! The figures of a run as text, for the screen.

use std::fmt::Write as _;

use super::budgets::budgets;
use super::figures::Figures;

/// Everything as text.
pub fn text(figures: &Figures) -> String {
    [
        functions(figures),
        scenes(figures),
        promised(figures),
        figures.proofs(),
    ]
    .join("\n")
}

fn functions(figures: &Figures) -> String {
    let mut text = String::from(
        "Cortex-M4F, cycles by Arm's table (a model, no wait states), each call from its first instruction\n\
         to its return; `small` is what is built for size\n\n",
    );
    let _ = writeln!(
        text,
        "{:26}{:>8}{:>8}{:>10}{:>8}{:>8}{:>12}",
        "function", "instr.", "most", "cycles", "most", "small", "M7 instr."
    );
    for entry in &figures.functions {
        let _ = writeln!(
            text,
            "{:26}{:>8}{:>8}{:>10}{:>8}{:>8}{:>12}",
            entry.name,
            entry.instructions_min,
            entry.instructions_max,
            entry.cycles_min,
            entry.cycles_max,
            entry.cycles_max_small,
            entry.instructions_max_cortex_m7
        );
    }
    text
}

fn scenes(figures: &Figures) -> String {
    let mut text = String::new();
    let _ = writeln!(
        text,
        "{:26}{:>8}{:>14}{:>8}{:>8}{:>16}{:>8}{:>8}",
        "scene, bytes", "flash", "beyond empty", "RAM", "stack", "set-up's stack", "small", "stack"
    );
    for scene in figures.scenes.iter().chain([&figures.empty]) {
        let _ = writeln!(
            text,
            "{:26}{:>8}{:>14}{:>8}{:>8}{:>16}{:>8}{:>8}",
            scene.name,
            scene.flash,
            scene.flash_beyond_empty,
            scene.ram,
            scene.stack,
            scene.stack_set_up,
            scene.flash_small,
            scene.stack_small
        );
    }
    text
}

fn promised(figures: &Figures) -> String {
    let mut text = format!("{:44}{:>10}{:>10}\n", "promised", "at most", "found");
    for budget in budgets(figures) {
        let decimals = usize::from(budget.most < 10.0);
        let found = budget
            .found
            .map_or_else(|| "none".into(), |found| format!("{found:.decimals$}"));
        let kept = if budget.is_kept() { "" } else { "  BROKEN" };
        let _ = writeln!(
            text,
            "{:44}{:>10.decimals$}{found:>10}{kept}",
            budget.what, budget.most
        );
    }
    text
}
