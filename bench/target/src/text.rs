//! The figures of a run as text, for the screen.

use std::fmt::Write as _;

use super::measure::Beside;
use epas_bench::counts::{Figures, budgets};

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
         to its return; `longest` is the longest path in the image, whatever the inputs;\n\
         `small` is what is built for size\n\n",
    );
    let _ = writeln!(
        text,
        "{:30}{:>8}{:>8}{:>10}{:>8}{:>9}{:>8}{:>12}",
        "function", "instr.", "most", "cycles", "most", "longest", "small", "M7 instr."
    );
    for entry in &figures.functions {
        let _ = writeln!(
            text,
            "{:30}{:>8}{:>8}{:>10}{:>8}{:>9}{:>8}{:>12}",
            entry.name,
            entry.instructions_min,
            entry.instructions_max,
            entry.cycles_min,
            entry.cycles_max,
            cycles(entry.longest),
            entry.cycles_max_small,
            entry.instructions_max_cortex_m7
        );
    }
    for entry in &figures.functions {
        if let Some(why) = &entry.no_longest {
            let _ = writeln!(text, "no longest path of {}: {why}", entry.name);
        }
    }
    text
}

fn cycles(cycles: Option<u32>) -> String {
    cycles.map_or_else(|| "none".into(), |cycles| cycles.to_string())
}

pub fn longest(paths: &[Beside]) -> String {
    let mut text = format!(
        "{:30}{:>9}{:>9}{:>8}\n",
        "function, cycles", "counted", "longest", "ratio"
    );
    for Beside {
        name,
        counted,
        longest,
    } in paths
    {
        let longest = match longest {
            Ok(cycles) => {
                let ratio = f64::from(*cycles) / f64::from(*counted);
                format!("{cycles:>9}{ratio:>8.3}")
            }
            Err(why) => format!("  none: {why}"),
        };
        let _ = writeln!(text, "{name:30}{counted:>9}{longest}");
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
