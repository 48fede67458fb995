//! Errors of a folded block against the exact solver, on states that were not fitted.

use epas_friction::scene::{CagedBallScrew, CagedBallScrewConfiguration};
use epas_friction::{FrictionModel, Inputs, Limits};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

use crate::Failure;
use crate::caged::{CagedFold, Exact};

/// States of a certificate, in as many groups of one friction coefficient and one sign of the load.
pub const STATES: usize = 2_048;
const GROUPS: usize = 16;

/// Relative difference of two torques from which on they are two answers: far above what the solver leaves.
const TWO_ANSWERS: f64 = 1e-5;

/// An error from which on a state is looked at for a second answer.
const SUSPICIOUS: f64 = 2e-3;

/// Errors of a block.
#[derive(Clone, Debug, PartialEq)]
pub struct Certificate {
    /// Seed of its states.
    pub seed: u64,
    /// The quantities.
    pub figures: [Figure; 1],
}

/// Errors of one quantity, each at the same state as the exact one.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// `caged_torque`.
    pub quantity: &'static str,
    /// Largest relative error.
    pub largest: f64,
    /// Its root mean square.
    pub rms: f64,
    /// Its mean, with its sign.
    pub mean: f64,
    /// States, flagged ones included.
    pub states: usize,
    /// Share of the states that the step flags.
    pub flagged: f64,
    /// Share of the states that are known to have two exact answers, because a contact opens under a rising load later than it closes under a
    /// falling one: their error is that to the nearer answer. They are looked for where an error is above 0.2 %.
    pub two_answers: f64,
    /// States for which the exact solver found no answer: neither counted in the errors nor in the states.
    pub unsolved: usize,
    /// Axial load of a ball, N, and friction coefficient of the largest error.
    pub worst_load: f64,
    /// Friction coefficient of the largest error.
    pub worst_friction: f64,
}

/// Outputs of the step at a state, N m, beside the exact torque.
struct Found {
    torque: f64,
    exact: f64,
    load: f64,
    friction: f32,
    flagged: bool,
    two_answers: bool,
}

impl Found {
    fn error(&self) -> f64 {
        self.torque / self.exact - 1.0
    }

    fn take_other(&mut self, exact: f64) {
        self.two_answers = (exact / self.exact - 1.0).abs() > TWO_ANSWERS;
        if (self.torque - exact).abs() < (self.torque - self.exact).abs() {
            self.exact = exact;
        }
    }
}

impl Certificate {
    pub(crate) fn of<const N: usize>(
        fold: &CagedFold,
        exact: &Exact,
        block: &CagedBallScrewConfiguration<N>,
    ) -> Result<Self, Failure> {
        let mut random = Pcg64::seed_from_u64(fold.seed);
        let [least, most] = fold.axial_load.map(f64::from);
        let (low, high) = block.law.friction_range();
        let groups: Vec<(f32, f64, Vec<f64>)> = (0..GROUPS)
            .map(|group| {
                let share: f64 = random.random();
                let friction = f64::from(low) * (f64::from(high) / f64::from(low)).powf(share);
                let friction = (friction as f32).clamp(low, high);
                let mut loads: Vec<f64> = (0..STATES / GROUPS)
                    .map(|_| least * (most / least).powf(random.random::<f64>()))
                    // A load that the block can be asked for.
                    .map(|load| f64::from(load as f32))
                    .collect();
                // From the largest down, so that each state starts from its neighbour.
                loads.sort_by(|a, b| b.total_cmp(a));
                let side = if group % 2 == 0 { 1.0 } else { -1.0 };
                (friction, side, loads)
            })
            .collect();
        let found = groups
            .par_iter()
            .map(|(friction, side, loads)| errors(exact, block, *friction, *side, loads))
            .collect::<Result<Vec<_>, Failure>>()?;
        let unsolved: usize = found.iter().map(|(_, unsolved)| unsolved).sum();
        let all: Vec<&Found> = found.iter().flat_map(|(found, _)| found).collect();
        let count = all.len().max(1) as f64;
        let worst = all
            .iter()
            .max_by(|a, b| a.error().abs().total_cmp(&b.error().abs()))
            .ok_or_else(|| Failure::Domain("the exact solver has no answer at any state".into()))?;
        let figure = Figure {
            quantity: "caged_torque",
            largest: worst.error().abs(),
            rms: (all.iter().map(|found| found.error().powi(2)).sum::<f64>() / count).sqrt(),
            mean: all.iter().map(|found| found.error()).sum::<f64>() / count,
            states: all.len(),
            flagged: all.iter().filter(|found| found.flagged).count() as f64 / count,
            two_answers: all.iter().filter(|found| found.two_answers).count() as f64 / count,
            unsolved,
            worst_load: worst.load,
            worst_friction: worst.friction.into(),
        };
        Ok(Self {
            seed: fold.seed,
            figures: [figure],
        })
    }
}

/// A model of one ball of a block with a friction coefficient, whose friction is full at any speed.
pub fn one_ball<const N: usize>(
    block: &CagedBallScrewConfiguration<N>,
    friction: f32,
) -> Result<FrictionModel<CagedBallScrew<N>>, Failure> {
    let mut model = FrictionModel::new(&CagedBallScrewConfiguration {
        loaded_balls: 1,
        reversal_speed: 1e-6,
        limits: Limits {
            nut_speed: 10.0,
            axial_load: 1e7,
            friction_torque: 1e6,
        },
        ..*block
    })?;
    model.set_friction(friction)?;
    Ok(model)
}

/// What `step()` outputs under these loads, against the exact torque; and how many of these there are not.
fn errors<const N: usize>(
    exact: &Exact,
    block: &CagedBallScrewConfiguration<N>,
    friction: f32,
    side: f64,
    loads: &[f64],
) -> Result<(Vec<Found>, usize), Failure> {
    let mut model = one_ball(block, friction)?;
    let ball = exact.ball(friction);
    let signed: Vec<f64> = loads.iter().map(|load| side * load).collect();
    let falling = ball.along(&signed)?;
    let mut found: Vec<Option<Found>> = signed
        .iter()
        .zip(&falling)
        .map(|(&axial_load, answer)| {
            let outputs = model.step(Inputs {
                nut_speed: 1.0,
                axial_load: axial_load as f32,
            });
            let torque = outputs.friction_torque.into();
            answer.as_ref().ok().map(|answer| Found {
                torque,
                exact: answer.torque,
                load: axial_load,
                friction,
                flagged: outputs.faults.any(),
                two_answers: false,
            })
        })
        .collect();
    let suspicious = |found: &Option<Found>| {
        found
            .as_ref()
            .is_none_or(|found| found.error().abs() > SUSPICIOUS)
    };
    if found.iter().any(suspicious) {
        let rising: Vec<f64> = signed.iter().rev().copied().collect();
        for (found, answer) in found.iter_mut().rev().zip(ball.along(&rising)?) {
            if let (Some(found), Ok(answer)) = (found, answer) {
                found.take_other(answer.torque);
            }
        }
    }
    let unsolved = found.iter().filter(|found| found.is_none()).count();
    Ok((found.into_iter().flatten().collect(), unsolved))
}
