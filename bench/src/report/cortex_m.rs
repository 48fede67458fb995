//! What everything costs on a Cortex-M4F: error against cycles, functions, scenes, promises.

use epas_friction::math;
use micromath::F32Ext;

use super::Context;
use super::curvature::{FORMS, catalogue_errors};
use super::kernels;
use super::trains::closed_form_errors;
use crate::counts::{Budget, Figures, budgets};
use crate::report::draw::{figure, table};
use epas_page::document::{Block, Cell, Section, Table};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Chart, Mark, Note, Panel, Series};

struct Point {
    name: &'static str,
    error: f64,
    cycles: f64,
}

struct Rivals {
    title: &'static str,
    points: Vec<Point>,
}

type Entry = (&'static str, f64, &'static str, f64);

fn rivals(context: &Context) -> Result<Vec<Rivals>, Failure> {
    type Kernel = fn(f32) -> f32;
    let relative = |kernel: Kernel, exact: fn(f64) -> f64| kernels::relative(kernel, exact).largest;
    let root = |kernel: Kernel| relative(kernel, f64::sqrt);
    let cube_root = |kernel: Kernel| relative(kernel, f64::cbrt);
    let power = |kernel: Kernel| relative(kernel, |x| x.cbrt().powi(2));
    let turn = |kernel: fn(f32) -> (f32, f32)| kernels::absolute(kernel).largest;
    let counted = [
        "curvature_literature",
        "curvature_circular_groove",
        "curvature_fitted",
        "curvature_exact",
    ];
    let curvatures = FORMS.into_iter().zip(counted);
    let curvatures = curvatures
        .zip(catalogue_errors(context.quick)?)
        .map(|((form, counted), errors)| (form, errors.largest, counted, 1.0));
    let linear = closed_form_errors(0.8)?.largest;
    let all: [(&'static str, Vec<Entry>); 6] = [
        ("First curvature, relative error", curvatures.collect()),
        (
            "Square root, relative error",
            vec![
                ("own", root(math::sqrt), "sqrt", 1.0),
                ("libm", root(libm::sqrtf), "libm_sqrtf", 1.0),
                ("micromath", root(F32Ext::sqrt), "micromath_sqrt", 1.0),
            ],
        ),
        (
            "Cube root, relative error",
            vec![
                ("own", cube_root(math::cbrt), "cbrt", 1.0),
                ("libm", cube_root(libm::cbrtf), "libm_cbrtf", 1.0),
            ],
        ),
        (
            "Power of 2/3, relative error",
            vec![
                (
                    "own",
                    power(|x| math::cbrt_and_squared(x).1),
                    "cbrt_and_squared",
                    1.0,
                ),
                (
                    "libm",
                    power(|x| libm::powf(x, 2.0 / 3.0)),
                    "libm_powf",
                    1.0,
                ),
                (
                    "micromath",
                    power(|x| F32Ext::powf(x, 2.0 / 3.0)),
                    "micromath_powf",
                    1.0,
                ),
            ],
        ),
        (
            "Sine and cosine, absolute error",
            vec![
                ("own", turn(math::sin_cos), "sin_cos", 1.0),
                ("libm", turn(libm::sincosf), "libm_sincosf", 1.0),
                // It computes the two one after the other.
                ("micromath", turn(F32Ext::sin_cos), "micromath_cos", 2.0),
            ],
        ),
        (
            "Ball in a linear bearing, error of its speed over v/2",
            vec![("closed form", linear, "linear_ball_speed", 1.0)],
        ),
    ];
    let point = |(name, error, counted, calls): Entry| {
        let entry = context.counts.function(counted);
        let entry =
            entry.ok_or_else(|| Failure::Data(format!("nothing was counted as {counted}")))?;
        Ok(Point {
            name,
            error,
            cycles: calls * f64::from(entry.cycles_max),
        })
    };
    all.into_iter()
        .map(|(title, entries)| {
            let points = entries.into_iter().map(point);
            Ok(Rivals {
                title,
                points: points.collect::<Result<_, Failure>>()?,
            })
        })
        .collect()
}

impl Rivals {
    /// Points that no other one beats in both error and cycles, from the cheapest on.
    fn front(&self) -> Vec<(f64, f64)> {
        let mut sorted: Vec<&Point> = self.points.iter().collect();
        sorted.sort_by(|one, other| {
            (one.cycles, one.error)
                .partial_cmp(&(other.cycles, other.error))
                .unwrap_or(std::cmp::Ordering::Equal)
        });
        let mut least = f64::INFINITY;
        sorted
            .into_iter()
            .filter(|point| {
                let better = point.error < least;
                least = least.min(point.error);
                better
            })
            .map(|point| (point.cycles, point.error))
            .collect()
    }

    fn panel(&self) -> Panel {
        let points = self
            .points
            .iter()
            .map(|point| (point.cycles, point.error))
            .collect();
        Panel::Chart(Chart {
            title: self.title.into(),
            x: Axis::log("cycles"),
            y: Axis::log("largest error"),
            series: vec![
                Series::new("Pareto front", 1, Mark::Line, self.front()),
                Series::new("", 0, Mark::Circles, points),
            ],
            notes: self
                .points
                .iter()
                .map(|point| Note {
                    at: (point.cycles, point.error),
                    text: point.name.into(),
                })
                .collect(),
        })
    }
}

fn whole(value: impl Into<f64>) -> Cell {
    Cell::fixed(value.into(), 0)
}

fn functions(figures: &Figures) -> Table {
    table(
        "target_functions",
        "Instructions and modelled cycles of every function, from its first instruction to its \
                  return, least and most over the inputs",
        "function | instructions, least | most | cycles, least | most | most, built for size | \
         instructions on a Cortex-M7",
        figures
            .functions
            .iter()
            .map(|entry| {
                vec![
                    entry.name.as_str().into(),
                    whole(entry.instructions_min),
                    whole(entry.instructions_max),
                    whole(entry.cycles_min),
                    whole(entry.cycles_max),
                    whole(entry.cycles_max_small),
                    whole(entry.instructions_max_cortex_m7),
                ]
            })
            .collect(),
    )
}

fn scenes(figures: &Figures) -> Table {
    table(
        "target_scenes",
        "Size of one image for each scene, bytes",
        "scene | flash | beyond the empty program | RAM | stack of a step | \
         stack of the set-up | flash, built for size | stack of a step, built for size",
        figures
            .scenes
            .iter()
            .chain([&figures.empty])
            .map(|scene| {
                let beyond = scene.flash.saturating_sub(figures.empty.flash);
                vec![
                    scene.name.as_str().into(),
                    whole(scene.flash as f64),
                    whole(beyond as f64),
                    whole(scene.ram as f64),
                    whole(scene.stack as f64),
                    whole(scene.stack_set_up as f64),
                    whole(scene.flash_small as f64),
                    whole(scene.stack_small as f64),
                ]
            })
            .collect(),
    )
}

fn promised(figures: &Figures) -> Table {
    table(
        "target_budgets",
        "What the crate promises, and what was found",
        "promise | at most | found | kept",
        budgets(figures)
            .into_iter()
            .map(|budget| {
                let decimals = usize::from(budget.most < 10.0);
                let kept = if budget.is_kept() { "yes" } else { "NO" };
                let Budget { what, most, found } = budget;
                vec![
                    what.into(),
                    Cell::fixed(most, decimals),
                    found.map_or("none".into(), |found| Cell::fixed(found, decimals)),
                    kept.into(),
                ]
            })
            .collect(),
    )
}

const WHERE: &str = "Where the cycles go. Square root: 14 are the instruction, 9 the frame and \
    the return, 6 the way of the operand through a general register and back, which inline assembly of stable Rust \
    prescribes. Cube root: 64 for common numbers, one chain of operations whose results are used at once, to an error of \
    half a unit in the last place; below 2^-125 a second call and two scalings come to it. Kinematics tick: ten loads and \
    ten stores are 40 alone. Train of 37: 42 a ball to take speeds and impedances in, 36 to 44 to settle speeds, forces \
    and positions, some 1,300 to join balls to clusters. Step of 37 balls: 4,600 for the train, the rest some 70 a \
    ball for the deviations of both grooves and three polynomials of them; with a load of its own for each ball 300 more a ball, for its place among \
    the knots and both ends of its interval.";

pub fn section(context: &Context) -> Result<Section, Failure> {
    let figures = &context.counts;
    let rivals = rivals(context)?;
    let rows = rivals
        .iter()
        .flat_map(|rivals| {
            rivals.points.iter().map(|point| {
                vec![
                    rivals.title.into(),
                    point.name.into(),
                    Cell::power(point.error),
                    Cell::fixed(point.cycles, 0),
                ]
            })
        })
        .collect();
    Ok(Section {
        title: "On the Cortex-M4F",
        blocks: vec![
            Block::Text(
                "Counted by `cargo run --release -p epas-target`, stored in bench/target.json and compared with a new count in CI. Instructions are counted call by call in QEMU. Cycles are those of Arm's table for the \
                 Cortex-M4F with a flash without wait states: a model, not silicon. A function is counted \
                 from its first instruction to its return, with the frame pointer that the target \
                 thumbv7em-none-eabihf prescribes (6 cycles a call). Built at optimisation level 3 with \
                 link-time optimisation; for size, by the profile `small` of bench/firmware, at level s. The \
                 inputs of a broken sensor are left out of the least cycles: the way to the safe output is \
                 short."
                    .into(),
            ),
            figure("error_against_cycles", "Largest error against cycles on a Cortex-M4F, one point for each formula and \
                          backend, with the Pareto front", (2, 460, 340), rivals.iter().map(Rivals::panel).collect()),
            Block::Table(table("errors_and_cycles", "Largest error and most cycles", "what | formula or backend | largest error | cycles", rows)),
            Block::Table(functions(figures)),
            Block::Table(scenes(figures)),
            Block::Table(promised(figures)),
            Block::Text(WHERE.into()),
            Block::Text(figures.proofs()),
        ],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_leaves_out_what_is_dearer_and_worse() {
        let point = |cycles, error| Point {
            name: "",
            error,
            cycles,
        };
        let rivals = Rivals {
            title: "",
            points: vec![
                point(30.0, 1e-2),
                point(10.0, 1e-1),
                point(40.0, 1e-1),
                point(50.0, 1e-5),
            ],
        };
        assert_eq!(rivals.front(), [(10.0, 1e-1), (30.0, 1e-2), (50.0, 1e-5)]);
    }
}
