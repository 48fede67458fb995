//! Models of friction on a trace of a screw: laws of the literature times the load that both flanks share, and this crate's without and
//! with memory.

use std::sync::Arc;

use super::Told;
use super::exact::Grid;
use super::friction::{ElementsKind, Screw};
use super::problem::{ScrewProblem, flank_sum};
use super::quantities::Values;
use super::stages::Prepared;
use crate::estimator::record::Record;
use crate::fit::problem::{Parameter, Scale, Separable};
use crate::laws::Cost;
use crate::models::{
    Beside, Driven, Entry, LITERATURE, LoadShare, Model, Table, WITH_MEMORY, WITHOUT_MEMORY,
    compared,
};
use crate::trace::Trace;
use crate::without_design::placed;

/// Speeds of a reversal, rad/s: least, first guess, most.
const REVERSAL_SPEEDS: [f64; 3] = [1e-3, 0.2, 50.0];

/// Models of friction beside each other, on another trace or on the last third of the fitted one.
pub fn models(prepared: &Prepared<'_>, told: &Told, unseen: Option<&Trace>) -> Table {
    let screw = &prepared.screw;
    let unseen = unseen.map(placed);
    let other = unseen.as_deref().map(|unseen| {
        let rests = Record::of(unseen, &[]).rests();
        Prepared::new(unseen, &rests, *screw)
    });
    let sides: Vec<(&Prepared<'_>, ScrewProblem<'_>)> = std::iter::once(prepared)
        .chain(&other)
        .map(|side| {
            let rows = side.rows_over_turns(told.window, true);
            (
                side,
                side.remembered(rows, (&told.values, &told.choice), &told.grid),
            )
        })
        .collect();
    let besides: Vec<Beside> = sides
        .iter()
        .map(|(_, problem)| problem.beside(&told.values))
        .collect();
    let fitted: Vec<Vec<Box<dyn Separable + '_>>> = sides
        .iter()
        .zip(&besides)
        .map(|((side, problem), beside)| {
            let driven = driven(side, problem, &told.values);
            let laws = LITERATURE.iter().map(|law| {
                let law = Model::of_law(*law, driven, beside, ["rad", "rad/s"]);
                Box::new(law) as Box<dyn Separable>
            });
            let without = without_memory(screw, told, problem, beside);
            laws.chain([Box::new(without) as Box<dyn Separable>])
                .collect()
        })
        .collect();
    let names = LITERATURE.iter().map(|law| (law.name, law.cost));
    let names = names.chain([(WITHOUT_MEMORY, Cost::Counted(&["step_caged"]))]);
    let mut entries: Vec<Entry<'_>> = names
        .enumerate()
        .map(|(k, (name, cost))| Entry {
            name,
            cost,
            fitted: &*fitted[0][k],
            unseen: fitted.get(1).map(|models| &*models[k]),
        })
        .collect();
    entries.push(Entry {
        name: WITH_MEMORY,
        cost: cost_with_memory(screw),
        fitted: &sides[0].1,
        unseen: sides.get(1).map(|(_, problem)| problem as &dyn Separable),
    });
    compared(&entries)
}

/// A trace as a law of the literature is told it.
fn driven<'a>(
    prepared: &'a Prepared<'_>,
    problem: &'a ScrewProblem<'_>,
    values: &Values,
) -> Driven<'a> {
    let (position, speed, load) = problem.signals();
    let (record, screw) = (&prepared.record, &prepared.screw);
    Driven {
        position,
        speed,
        tick: record.tick,
        resolution: prepared.trace.resolution,
        rows: problem.rows(),
        breakaway: Some(values.breakaway_angle),
        share: load
            .filter(|_| screw.largest_load > 0.0)
            .map(|load| LoadShare {
                load,
                preload: screw.axial_preload(values),
                largest: screw.largest_load,
                sum: flank_sum,
            }),
    }
}

/// Cost of a step with memory: counted for elements in constant shares; load-exact ones cost what they cost beyond these.
fn cost_with_memory(screw: &Screw) -> Cost {
    match screw.elements {
        ElementsKind::Proportional => Cost::Counted(&["step_caged_law"]),
        // 371 in place of 190 cycles, and 30 for the load of both flanks.
        ElementsKind::LoadExact | ElementsKind::Preloaded => Cost::Estimated(1400),
    }
}

/// The screw without memory: gross sliding with one coefficient times `w/sqrt(w^2 + w_r^2)`, with the reversal speed `w_r`.
fn without_memory<'a>(
    screw: &'a Screw,
    told: &'a Told,
    problem: &'a ScrewProblem<'_>,
    beside: &'a Beside,
) -> Model<'a> {
    let [low, start, high] = REVERSAL_SPEEDS;
    let of_screw = problem.nonlinear().iter();
    let mut nonlinear: Vec<Parameter> = of_screw
        .filter(|of| matches!(of.name, "friction" | "preload"))
        .cloned()
        .collect();
    nonlinear.push(Parameter {
        name: "reversal_speed",
        unit: "rad/s",
        start,
        low,
        high,
        scale: Scale::Logarithmic,
    });
    let names: Vec<&'static str> = nonlinear.iter().map(|of| of.name).collect();
    let grid: Arc<Grid> = Arc::clone(&told.grid);
    let friction = move |parameters: &[f64]| {
        let (mut reversal, mut values) = (0.0, told.values);
        for (name, value) in names.iter().zip(parameters) {
            match *name {
                "friction" => values.friction = *value,
                "preload" => values.preload = *value,
                _ => reversal = *value,
            }
        }
        let one = values.friction as f32;
        let law = screw
            .scene(&values)
            .map(|scene| grid.law(&scene, (one, one)));
        let Ok(Ok(law)) = law else {
            return vec![f64::NAN; beside.target.len()];
        };
        let (_, speed, load) = problem.signals();
        let at = |(sample, speed): (usize, &f64)| {
            let load = load.map_or(0.0, |load| load[sample]);
            let full = law.sliding(load, 1_f64.copysign(*speed), values.friction);
            speed / speed.hypot(reversal) * full
        };
        let friction: Vec<f64> = speed.iter().enumerate().map(at).collect();
        problem.rows().sums(0, &friction)
    };
    Model::new(nonlinear, beside, problem.row_step(), Box::new(friction))
}
