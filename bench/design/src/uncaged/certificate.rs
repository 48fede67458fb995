//! Errors of a folded law against rows of exact balls that press on each other, on states that were not fitted.

use epas_friction::ball::pressed::BallLaw;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

use super::UncagedFold;
use super::ball::Speeds;
use super::ring::{BALLS, Row, RowAnswer};
use crate::Failure;

/// Rows of a certificate.
pub const ROWS: usize = 64;

/// Friction coefficient between the balls of every other row; the others have none.
const BALL_FRICTION: f32 = 0.1;

/// Rows that may be left without an exact answer, as a share.
const UNSOLVED: f64 = 0.1;

/// Errors of a law on rows of balls, each at the same state as the exact one.
#[derive(Clone, Debug, PartialEq)]
pub struct UncagedCertificate {
    /// Seed of its rows.
    pub seed: u64,
    /// Rows, and balls in all of them.
    pub rows: usize,
    /// Balls in all rows.
    pub balls: usize,
    /// Rows for which the exact solver found no answer: not counted.
    pub unsolved: usize,
    /// Share of the rows that the step flags.
    pub flagged: f64,
    /// Friction torque of a row, relative error: of all rows.
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

/// A row with both its answers.
struct Found {
    row: Row,
    exact: RowAnswer,
    folded: RowAnswer,
    flagged: bool,
}

impl Found {
    fn torque_errors(&self) -> Vec<f64> {
        vec![self.folded.torque / self.exact.torque - 1.0]
    }

    fn force_errors(&self) -> Vec<f64> {
        let largest = self.exact.forces.iter().copied().fold(0.0, f64::max);
        let pairs = self.folded.forces.iter().zip(&self.exact.forces);
        pairs.map(|(found, exact)| (found - exact) / largest).collect()
    }
}

impl UncagedFigure {
    fn of<'a>(found: impl Iterator<Item = &'a Found>, errors: fn(&Found) -> Vec<f64>) -> Self {
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

impl UncagedCertificate {
    pub(super) fn of<const N: usize>(
        fold: &UncagedFold,
        law: &BallLaw<N>,
    ) -> Result<Self, Failure> {
        let ball = fold.gear.gear.exact_ball(fold.gear.gear.friction);
        let speeds = Speeds::of(&ball.design);
        let rows = rows(fold, law.friction_range());
        let found: Vec<Option<Found>> = rows
            .into_par_iter()
            .map(|row| {
                let exact = row.exact(&ball, fold.gear.deviations).ok()?;
                Some(Found {
                    folded: row.folded(law, &speeds),
                    flagged: row.is_flagged(law),
                    exact,
                    row,
                })
            })
            .collect();
        let unsolved = found.iter().filter(|found| found.is_none()).count();
        if unsolved as f64 > UNSOLVED * ROWS as f64 {
            return Err(Failure::Domain(format!(
                "the exact balance of {unsolved} of {ROWS} rows of balls is not found"
            )));
        }
        let found: Vec<Found> = found.into_iter().flatten().collect();
        let flagged = found.iter().filter(|found| found.flagged).count();
        let unflagged = || found.iter().filter(|found| !found.flagged);
        Ok(Self {
            seed: fold.seed,
            rows: found.len(),
            balls: BALLS * found.len(),
            unsolved,
            flagged: flagged as f64 / found.len() as f64,
            torque: UncagedFigure::of(found.iter(), Found::torque_errors),
            unflagged_torque: UncagedFigure::of(unflagged(), Found::torque_errors),
            forces: UncagedFigure::of(found.iter(), Found::force_errors),
            unflagged_forces: UncagedFigure::of(unflagged(), Found::force_errors),
        })
    }
}

/// Rows over the whole domain: in turns with a load that opposes the motion and one that assists it, and in turns of two without and with
/// friction between balls.
fn rows(fold: &UncagedFold, (low, high): (f32, f32)) -> Vec<Row> {
    let mut random = Pcg64::seed_from_u64(fold.seed);
    let [least, most] = fold.axial_load;
    (0..ROWS)
        .map(|row| {
            let side = if row % 2 == 0 { 1.0 } else { -1.0 };
            let load = least * (most / least).powf(random.random_range(0.0..1.0_f32));
            Row {
                friction: (low * (high / low).powf(random.random_range(0.0..1.0_f32)))
                    .clamp(low, high),
                ball_friction: if row / 2 % 2 == 0 { 0.0 } else { BALL_FRICTION },
                axial_load: side * load,
                deviations: std::array::from_fn(|_| {
                    std::array::from_fn(|_| random.random_range(-1.0..1.0_f32))
                }),
            }
        })
        .collect()
}
