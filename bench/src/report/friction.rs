//! Friction of the whole screw, first of all: what the scenes that firmware runs say over a manoeuvre, their error and their cost.

use crate::timing;
use epas_reference::promises;

use super::Context;
use super::statistics::Errors;
use super::times::time;
use super::weave::{Row, Weave};
use crate::report::draw::{chart, figure, table};
use epas_page::document::{Block, Cell, Section, Table};
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Mark, Series, thin};

const CYCLES_A_MILLISECOND: f64 = 168_000.0;

pub fn section(context: &Context) -> Result<Section, Failure> {
    let weave = Weave::new()?;
    Ok(Section {
        title: "Friction of the whole screw",
        blocks: vec![
            Block::Text(
                "A step takes nut speed and axial load and says how much motor torque friction takes. Three scenes: balls in a cage, which do \
                 not touch; the same with memory, where friction comes back over an angle after a reversal; and 37 balls that press on each other. \
                 Exact is a float64 reference from other formulas: every ball in elastic balance with Coulomb friction by integrals over its \
                 contacts; for reversals Mindlin's first loading repeated from every turning point; for 37 balls the whole screw by \
                 complementarity."
                    .into(),
            ),
            Block::Table(errors_and_costs(context, &weave)?),
            over_the_weave(&weave),
        ],
    })
}

type SceneRow = (&'static str, [f64; 2], String, [&'static str; 3]);

fn errors_and_costs(context: &Context, weave: &Weave) -> Result<Table, Failure> {
    let of = |errors: &Errors| [errors.largest, errors.rms()];
    let [_, memory] = super::accuracy::memory(20_000)?;
    let [largest, rms, _] = context.flagship.comparison.torque.relative();
    let rows: [SceneRow; 3] = [
        (
            "balls in a cage",
            of(&weave.errors),
            "torque, relative: weave, exact ball".into(),
            ["step_caged"; 3],
        ),
        (
            "balls in a cage, with memory",
            of(&memory),
            "torque over that of sliding: eight elements, random strokes, exact hysteresis".into(),
            ["step_caged", "step_caged_memory", "step_caged_memory"],
        ),
        (
            "37 balls that press on each other",
            [largest, rms],
            format!(
                "torque, relative: {} turns under 50 N a ball, exact whole screw",
                context.flagship.turns
            ),
            ["step_uncaged", "step_train_37", "step_train_37_pressing"],
        ),
    ];
    let rows = rows
        .into_iter()
        .map(|row| cells(context, row))
        .collect::<Result<_, _>>()?;
    let columns = "scene | largest error (%) | rms (%) | of what, against what | \
         promised largest (%) | time of a step here (ns) | cycles | of a 168 MHz core at 1 kHz (%)";
    Ok(table(
        "friction",
        "Error and cost of a step. What was found in this run; the largest error promised holds over the whole domain of the scene (table \"promises\"), \
         for memory beyond the reversal alone, for 37 balls without the ticks in which balls meet, which what was found has too. Cycles: the most on a Cortex-M4F.",
        columns,
        rows,
    ))
}

fn cells(context: &Context, row: SceneRow) -> Result<Vec<Cell>, Failure> {
    let (scene, [largest, rms], kind, [promise, time_of, counted]) = row;
    let function = context.counts.function(counted);
    let cycles = function.map(|function| f64::from(function.cycles_max));
    Ok(vec![
        scene.into(),
        Cell::power(100.0 * largest),
        Cell::power(100.0 * rms),
        kind.into(),
        Cell::power(100.0 * promises::of(promise).largest),
        time(&timing::times(&context.competition, time_of)?.latency, 0),
        cycles.map_or("not counted".into(), |cycles| Cell::fixed(cycles, 0)),
        cycles.map_or("".into(), |cycles| {
            Cell::fixed(100.0 * cycles / CYCLES_A_MILLISECOND, 1)
        }),
    ])
}

fn between(rows: &[Row], (start, end): (f64, f64)) -> &[Row] {
    let from = rows.partition_point(|row| row.time < start);
    let to = rows.partition_point(|row| row.time <= end);
    &rows[from..to.max(from)]
}

/// The start of the reversal under the largest load, s.
pub(super) fn reversal(rows: &[Row]) -> f64 {
    let reversals = rows
        .windows(2)
        .filter(|pair| pair[0].speed * pair[1].speed <= 0.0);
    reversals
        .max_by(|one, other| one[0].load.abs().total_cmp(&other[0].load.abs()))
        .map_or(0.0, |pair| pair[0].time)
}

fn over_the_weave(weave: &Weave) -> Block {
    const WHOLE: (f64, f64) = (0.0, 5.0);
    let start = reversal(&weave.rows);
    let close = (start - 0.02, start + 0.06);
    let line = |name: &str, colour, ends, value: &dyn Fn(&Row) -> f64| {
        let points = thin(between(&weave.rows, ends), &|row| row.time, value);
        Series::new(name, colour, Mark::Line, points)
    };
    let panel = |title: &str, label: &str, ends: (f64, f64), series| {
        chart(
            title,
            Axis::linear("time (s)").between(ends.0, ends.1),
            Axis::linear(label),
            series,
        )
    };
    let three = |ends| {
        vec![
            line("cage", 0, ends, &|row: &Row| row.caged),
            line("cage, memory", 1, ends, &|row: &Row| row.memory),
            line("37 balls, memory", 2, ends, &|row: &Row| row.balls[0]),
        ]
    };
    figure(
        "friction_over_a_manoeuvre",
        "Friction torque of a screw of 33 mm and lead 20 mm with 37 balls, on centre. A weave at 0.2 Hz with small corrections; the \
                  reversal under the largest load closer; motor torque at the nut without inertia; and friction of the 37 balls in its parts. Without memory \
                  friction turns round with the speed, with memory over an angle. All have the numbers of the design lin-3.6: friction 0.1, balls that just fit; the \
                  37 balls also have its contact angles that deviate by 40 mrad, which a cage does not notice. Model of this crate; geometry of Lin 2019, Table 3.6.",
        (2, 540, 350),
        vec![
            panel(
                "Friction on centre",
                "friction torque (N m)",
                WHOLE,
                three(WHOLE),
            ),
            panel("One reversal", "friction torque (N m)", close, three(close)),
            panel(
                "What the motor has to do",
                "motor torque (N m)",
                WHOLE,
                vec![
                    line("load alone", 6, WHOLE, &|row: &Row| row.load_torque),
                    line("load and friction of 37 balls", 1, WHOLE, &|row: &Row| {
                        row.load_torque + row.balls[0]
                    }),
                ],
            ),
            panel(
                "Friction of 37 balls in its parts",
                "friction torque (N m)",
                WHOLE,
                vec![
                    line("grooves", 0, WHOLE, &|row: &Row| row.balls[1]),
                    line("ball to ball", 1, WHOLE, &|row: &Row| row.balls[2]),
                ],
            ),
        ],
    )
}
