//! Errors of a folded law against rows of exact balls that press on each other, on states that were not fitted.

use std::f32::consts::TAU;
use std::sync::atomic::{AtomicUsize, Ordering};

use epas_friction::ball::pressed::BallLaw;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

use super::UncagedFold;
use super::ball::{Speeds, exact_ball};
use super::ring::{BALLS, Row, RowAnswer};
use crate::Failure;

/// Rows whose deviations are random, each ball's by itself.
pub const ROWS: usize = 64;

/// Rows whose deviations go in waves along the grooves, as those of a ground groove do: neighbours deviate alike, and what is wrong in a corner of
/// the box does not average out.
pub const WAVES: usize = 48;

/// Least and most waves in a row.
const IN_A_ROW: [f32; 2] = [0.5, 9.0];

/// Rows that may be left without an exact answer, as a share. With one more no further row is solved: a search without an answer is the longest.
const UNSOLVED: f64 = 0.06;

/// Errors of a law on rows of balls, each at the same state as the exact one.
#[derive(Clone, Debug, PartialEq)]
pub struct UncagedCertificate {
    /// Seed of its rows.
    pub seed: u64,
    /// Balls of a row.
    pub balls: usize,
    /// Rows for which the exact solver found no answer: counted in no figure.
    pub unsolved: usize,
    /// Rows of random deviations without friction between balls.
    pub smooth: RowFigures,
    /// Rows of random deviations with the fold's friction coefficient between balls.
    pub rubbing: RowFigures,
    /// Rows in waves without friction between balls.
    pub waves: RowFigures,
    /// Rows in waves with the fold's friction coefficient between balls.
    pub rubbing_waves: RowFigures,
}

/// Errors on some of the rows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RowFigures {
    /// Rows.
    pub rows: usize,
    /// Share of them that the step flags.
    pub flagged: f64,
    /// Friction torque, relative error: of all rows.
    pub torque: UncagedFigure,
    /// The same of rows that are not flagged.
    pub unflagged_torque: UncagedFigure,
    /// Forces between neighbours, error over the largest force of the row: of all rows.
    pub forces: UncagedFigure,
    /// The same of rows that are not flagged.
    pub unflagged_forces: UncagedFigure,
}

/// Errors of one quantity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct UncagedFigure {
    /// Largest error.
    pub largest: f64,
    /// Root mean square.
    pub rms: f64,
    /// Mean, with its sign.
    pub mean: f64,
    /// Axial load of a ball, N, where it is largest.
    pub worst_load: f64,
    /// Friction coefficient of the grooves where it is largest.
    pub worst_friction: f64,
}

struct Found {
    row: Row,
    exact: RowAnswer,
    folded: RowAnswer,
    in_waves: bool,
}

impl Found {
    fn torque_errors(&self) -> Vec<f64> {
        vec![self.folded.torque / self.exact.torque - 1.0]
    }

    fn largest_force(&self) -> f64 {
        self.exact.forces.iter().copied().fold(0.0, f64::max)
    }

    fn force_errors(&self) -> Vec<f64> {
        let largest = self.largest_force();
        let pairs = self.folded.forces.iter().zip(&self.exact.forces);
        pairs
            .map(|(found, exact)| (found - exact) / largest)
            .collect()
    }
}

impl UncagedFigure {
    fn of(found: &[&Found], errors: fn(&Found) -> Vec<f64>) -> Self {
        let (mut figure, mut count) = (Self::default(), 0.0_f64);
        for found in found {
            for error in errors(found) {
                count += 1.0;
                figure.rms += error * error;
                figure.mean += error;
                if error.abs() > figure.largest {
                    figure.largest = error.abs();
                    figure.worst_load = found.row.axial_load.into();
                    figure.worst_friction = found.row.friction.into();
                }
            }
        }
        let count = count.max(1.0);
        figure.rms = (figure.rms / count).sqrt();
        figure.mean /= count;
        figure
    }
}

impl RowFigures {
    fn of<'a>(rows: impl Iterator<Item = &'a Found>) -> Self {
        let all: Vec<&Found> = rows.collect();
        let unflagged: Vec<&Found> = all
            .iter()
            .copied()
            .filter(|row| !row.folded.flagged)
            .collect();
        let flagged = all.len() - unflagged.len();
        Self {
            rows: all.len(),
            flagged: flagged as f64 / all.len().max(1) as f64,
            torque: UncagedFigure::of(&all, Found::torque_errors),
            unflagged_torque: UncagedFigure::of(&unflagged, Found::torque_errors),
            forces: UncagedFigure::of(&all, Found::force_errors),
            unflagged_forces: UncagedFigure::of(&unflagged, Found::force_errors),
        }
    }
}

impl UncagedCertificate {
    pub(super) fn of<const N: usize>(
        fold: &UncagedFold,
        law: &BallLaw<N>,
        progress: &(dyn Fn(f64) + Sync),
    ) -> Result<Self, Failure> {
        let ball = exact_ball(&fold.gear.gear, fold.gear.gear.friction);
        let speeds = Speeds::of(&ball.design);
        let (done, unsolved) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let rows = rows(fold, law.friction_range());
        let all = rows.len();
        let most = (UNSOLVED * all as f64) as usize;
        let found: Vec<Option<Found>> = rows
            .into_par_iter()
            .enumerate()
            .map(|(number, row)| {
                if unsolved.load(Ordering::Relaxed) > most {
                    return None;
                }
                let exact = row.exact(&ball, fold.gear.deviations);
                unsolved.fetch_add(exact.is_err().into(), Ordering::Relaxed);
                let rows = done.fetch_add(1, Ordering::Relaxed) + 1;
                progress(rows as f64 / all as f64);
                let exact = exact.ok()?;
                let folded = row.folded(law, &speeds);
                Some(Found {
                    exact,
                    folded,
                    in_waves: number >= ROWS,
                    row,
                })
            })
            .collect();
        let unsolved = unsolved.into_inner();
        if unsolved > most {
            let [least, largest] = fold.axial_load;
            return Err(Failure::Domain(format!(
                "the exact balance of more than {most} of {all} rows of balls is not found, under {least} to {largest} N a ball; narrow the loads \
                 ([fold] axial_load = [least, largest] of one ball, N), or the deviations"
            )));
        }
        let found: Vec<Found> = found.into_iter().flatten().collect();
        let of = |in_waves: bool, rubbing: bool| {
            found
                .iter()
                .filter(move |found| found.in_waves == in_waves)
                .filter(move |found| (found.row.ball_friction > 0.0) == rubbing)
        };
        Ok(Self {
            seed: fold.seed,
            balls: BALLS,
            unsolved,
            smooth: RowFigures::of(of(false, false)),
            rubbing: RowFigures::of(of(false, true)),
            waves: RowFigures::of(of(true, false)),
            rubbing_waves: RowFigures::of(of(true, true)),
        })
    }
}

/// Rows over the whole domain: in turns with a load that opposes the motion and one that assists it, and half of each with friction
/// between balls. First those of random deviations, then those in waves.
fn rows(fold: &UncagedFold, (low, high): (f32, f32)) -> Vec<Row> {
    let mut random = Pcg64::seed_from_u64(fold.seed);
    (0..ROWS + WAVES)
        .map(|row| {
            let side = if row % 2 == 0 { 1.0 } else { -1.0 };
            let load = by_octaves(fold.axial_load, &mut random);
            Row {
                friction: by_octaves([low, high], &mut random).clamp(low, high),
                ball_friction: if row / 2 % 2 == 1 {
                    fold.ball_friction
                } else {
                    0.0
                },
                axial_load: side * load,
                deviations: if row < ROWS {
                    std::array::from_fn(|_| {
                        std::array::from_fn(|_| random.random_range(-1.0..1.0_f32))
                    })
                } else {
                    in_waves(row - ROWS, &mut random)
                },
            }
        })
        .collect()
}

/// A number from the least to the most, each octave as often as every other.
fn by_octaves([least, most]: [f32; 2], random: &mut Pcg64) -> f32 {
    least * (most / least).powf(random.random_range(0.0..1.0_f32))
}

/// Deviations that reach the largest ones in waves: in turns both grooves in one phase, in opposite phases, and each with waves of its own.
fn in_waves(row: usize, random: &mut Pcg64) -> [[f32; 2]; BALLS] {
    let mut wave = || {
        let angle = TAU * by_octaves(IN_A_ROW, random);
        let phase = random.random_range(0.0..TAU);
        move |ball: usize| (phase + angle * ball as f32 / BALLS as f32).sin()
    };
    let (screw, nut) = (wave(), wave());
    std::array::from_fn(|ball| {
        let screw = screw(ball);
        // Every pair of rows has both signs of the load.
        let nut = match row / 2 % 3 {
            0 => screw,
            1 => -screw,
            _ => nut(ball),
        };
        [screw, nut]
    })
}
