//! Models of friction on a trace of a screw: laws of the literature times the load that both flanks share, and this crate's without and
//! with memory.

use super::Told;
use super::friction::{ElementsKind, Screw};
use super::problem::{ScrewProblem, flank_sum};
use super::stages::Prepared;
use crate::answer::ModelScore;
use crate::estimator::record::Record;
use crate::fit::problem::{Evaluation, Model, Parameter, Separable};
use crate::laws::{BREAKAWAY, Cost, Law, Scales};
use crate::models::{LITERATURE, WITH_MEMORY, WITHOUT_MEMORY, score};
use crate::trace::Trace;
use crate::without_design::placed;
use epas_page::failure::Failure;

/// Speeds of a reversal, rad/s: least, first guess, most.
const REVERSAL_SPEEDS: [f64; 3] = [1e-3, 0.2, 50.0];

/// Preload of a flank in a law's load share over the largest load: least and most.
const PRELOADS: [f64; 2] = [1e-3, 10.0];

/// Friction of gross sliding without a load: what a law of unit level is multiplied by.
const LEVEL: Parameter = Parameter::linear("level", "N m", 0.0);

struct Side<'a> {
    prepared: &'a Prepared<'a>,
    problem: ScrewProblem<'a>,
    told: &'a Told,
}

pub fn models(
    prepared: &Prepared<'_>,
    told: &Told,
    unseen: Option<&Trace>,
) -> Vec<(String, Result<ModelScore, Failure>)> {
    let screw = &prepared.screw;
    let unseen = unseen.map(placed);
    let other = unseen.as_deref().map(|unseen| {
        let rests = Record::of(unseen, &[]).rests();
        Prepared::new(unseen, &rests, *screw)
    });
    let side = |prepared| -> Side<'_> {
        let rows = Prepared::rows_over_turns(prepared, told.window, true);
        Side {
            problem: prepared.remembered(rows, told.known()),
            prepared,
            told,
        }
    };
    let (fitted, other) = (side(prepared), other.as_ref().map(side));
    let laws = LITERATURE.map(|law| (law.name, law.cost, Some(law)));
    let without = (WITHOUT_MEMORY, Cost::Counted(&["step_caged"]), None);
    let scored = |(name, cost, law): (&str, Cost, Option<Law>)| {
        let model = |side| match law {
            Some(law) => Side::of_law(side, law),
            None => side.without_memory(),
        };
        let (fitted, unseen) = (model(&fitted), other.as_ref().map(model));
        let unseen = unseen.as_ref().map(|model| model as &dyn Separable);
        let scored = score((name, cost), &fitted, unseen);
        (name.to_string(), scored.map(|(score, _)| score))
    };
    let mut scores: Vec<_> = laws.into_iter().chain([without]).map(scored).collect();
    let unseen = other.as_ref();
    let unseen = unseen.map(|side| &side.problem as &dyn Separable);
    let own = (WITH_MEMORY, cost_with_memory(screw));
    let scored = score(own, &fitted.problem, unseen);
    scores.push((WITH_MEMORY.into(), scored.map(|(score, _)| score)));
    scores
}

/// Cost of a step with memory: counted for elements in constant shares; load-exact ones cost what they cost beyond these.
fn cost_with_memory(screw: &Screw) -> Cost {
    match screw.elements {
        ElementsKind::Proportional => Cost::Counted(&["step_caged_law"]),
        // 371 in place of 190 cycles, and 30 for the load of both flanks.
        ElementsKind::LoadExact | ElementsKind::Preloaded => Cost::Estimated(1400),
    }
}

impl Side<'_> {
    /// A law of unit level, from the breakaway angle that was told: from one far off, it may do best without any friction. It may choose the preload of the
    /// load that both flanks share: with a large one friction does not follow the load at all.
    fn of_law(&self, law: Law) -> Model<'_> {
        let (position, speed, load) = self.problem.signals();
        let Prepared {
            trace,
            record,
            screw,
        } = self.prepared;
        let tick = record.tick;
        let scales = Scales::of((position, speed), trace.resolution, tick);
        let mut nonlinear = law.parameters(&scales, ["rad", "rad/s"]);
        for of in nonlinear.iter_mut().filter(|of| of.name == BREAKAWAY) {
            of.start = self.told.values.breakaway_angle.max(of.low).min(of.high);
        }
        let load = load.filter(|_| screw.largest_load > 0.0);
        if load.is_some() {
            let [low, high] = PRELOADS.map(|part| part * screw.largest_load);
            let preload = screw.axial_preload(&self.told.values);
            let start = preload.max(low).min(high);
            nonlinear.push(Parameter::positive(
                "axial_preload",
                "N",
                start,
                [low, high],
            ));
        }
        let friction = move |values: &[f64]| {
            let Ok(friction) = law.friction(&scales, values) else {
                return vec![f64::NAN; position.len()];
            };
            let mut friction = friction.along(position, speed, tick);
            if let (Some(load), Some(preload)) = (load, values.last()) {
                for (friction, load) in friction.iter_mut().zip(load) {
                    *friction *= flank_sum(*preload, *load) / (2.0 * preload);
                }
            }
            friction
        };
        self.model(nonlinear, true, friction)
    }

    /// The screw without memory: gross sliding with one coefficient times `w/sqrt(w^2 + w_r^2)`, with the reversal speed `w_r`.
    fn without_memory(&self) -> Model<'_> {
        let [low, start, high] = REVERSAL_SPEEDS;
        let of_screw = self.problem.nonlinear().iter();
        let of_screw = of_screw.filter(|of| matches!(of.name, "friction" | "preload"));
        let mut nonlinear: Vec<Parameter> = of_screw.cloned().collect();
        nonlinear.push(Parameter::positive(
            "reversal_speed",
            "rad/s",
            start,
            [low, high],
        ));
        let names: Vec<&'static str> = nonlinear.iter().map(|of| of.name).collect();
        let (_, speed, load) = self.problem.signals();
        let friction = move |parameters: &[f64]| {
            let (mut reversal, mut values) = (0.0, self.told.values);
            for (name, value) in names.iter().zip(parameters) {
                match *name {
                    "friction" => values.friction = *value,
                    "preload" => values.preload = *value,
                    _ => reversal = *value,
                }
            }
            let one = values.friction as f32;
            let scene = self.prepared.screw.scene(&values);
            let Ok(Ok(law)) = scene.map(|scene| self.told.grid.law(&scene, (one, one))) else {
                return vec![f64::NAN; speed.len()];
            };
            let at = |(sample, speed): (usize, &f64)| {
                let load = load.map_or(0.0, |load| load[sample]);
                let full = law.sliding(load, 1_f64.copysign(*speed), values.friction);
                speed / speed.hypot(reversal) * full
            };
            speed.iter().enumerate().map(at).collect()
        };
        self.model(nonlinear, false, friction)
    }

    /// A friction at every sample beside all else: of unit level, so that a linear parameter multiplies it, or not.
    fn model<'b>(
        &'b self,
        nonlinear: Vec<Parameter>,
        of_unit_level: bool,
        friction: impl Fn(&[f64]) -> Vec<f64> + Sync + 'b,
    ) -> Model<'b> {
        let problem = &self.problem;
        let beside = problem.beside(&self.told.values);
        let mut linear = problem.linear().to_vec();
        linear.extend(of_unit_level.then_some(LEVEL));
        Model {
            nonlinear,
            linear,
            target: problem.target().to_vec(),
            evaluate: Box::new(move |values| {
                let friction = problem.rows().sums(0, &friction(values));
                let Evaluation {
                    mut fixed,
                    mut columns,
                } = beside.clone();
                if of_unit_level {
                    columns.push(friction);
                } else {
                    for (fixed, friction) in fixed.iter_mut().zip(friction) {
                        *fixed += friction;
                    }
                }
                Evaluation { fixed, columns }
            }),
        }
    }
}
