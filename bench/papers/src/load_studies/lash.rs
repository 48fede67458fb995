//! Axial and conical lash tests with four patterns of ball locations: section 4.2.1, Figures 4.2 and 4.3.

use std::f64::consts::TAU;

use rayon::prelude::*;

use super::Tick;
use epas_reference::error::{ReferenceError, within};
use epas_reference::statics::ball::Ball;
use epas_reference::statics::cases::CaseStudy;
use epas_reference::statics::geometry::Geometry;
use epas_reference::statics::problem::{Load, StaticLoad, Support};
use epas_reference::statics::solution::StaticSolution;

/// Where the balls lie on a track that they do not fill (Figure 4.2; the text shows but does not define them).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    Even,
    OneEnd,
    OneSide,
    HalfHalf,
}

impl Pattern {
    pub const ALL: [Self; 4] = [Self::Even, Self::OneEnd, Self::OneSide, Self::HalfHalf];

    pub const fn name(self) -> &'static str {
        match self {
            Self::Even => "evenly distributed",
            Self::OneEnd => "stacked on one end",
            Self::OneSide => "stacked on one side",
            Self::HalfHalf => "half-half",
        }
    }

    /// Azimuths of `balls` balls on a track of `turns` turns from azimuth 0 on.
    pub fn azimuths(
        self,
        geometry: &Geometry,
        balls: usize,
        turns: f64,
    ) -> Result<Vec<f64>, ReferenceError> {
        within("turns", turns, 1e-3, 1e3)?;
        let length = turns * TAU;
        // The angle that a touching ball takes on the path.
        let ball =
            2.0 * (geometry.ball_radius / geometry.pitch_radius.hypot(geometry.advance())).asin();
        if balls == 0 || balls as f64 * ball > length {
            return Err(ReferenceError::input(
                "balls",
                format!("{balls} touching balls do not fit on {turns} turns"),
            ));
        }
        let row = |count: usize, start: f64| {
            (0..count).map(move |index| start + (index as f64 + 0.5) * ball)
        };
        Ok(match self {
            Self::Even => (0..balls)
                .map(|index| (index as f64 + 0.5) * length / balls as f64)
                .collect(),
            Self::OneEnd => row(balls, 0.0).collect(),
            Self::HalfHalf => {
                let first = balls / 2;
                let second = balls - first;
                row(first, 0.0)
                    .chain(row(second, length - second as f64 * ball))
                    .collect()
            }
            Self::OneSide => {
                // Rows of one turn each, the last with what is left; each begins a whole turn after the last.
                let rows = turns.ceil().max(1.0);
                let per_turn = balls as f64 / turns;
                let mut azimuths = Vec::with_capacity(balls);
                for turn in 0..rows as usize {
                    let end = (((turn + 1) as f64 * per_turn).round() as usize).min(balls);
                    let left = if turn + 1 == rows as usize {
                        balls
                    } else {
                        end
                    };
                    let count = left - azimuths.len();
                    azimuths.extend(row(count, turn as f64 * TAU));
                }
                azimuths
            }
        })
    }
}

/// Turns of the loaded track of Table 4.1.
pub const TURNS: f64 = 3.75;
/// Largest axial force, N.
const AXIAL_FORCE: f64 = 200.0;
/// Largest lateral force, N; not printed.
const LATERAL_FORCE: f64 = 10.0;

/// A lash test of the ball screw of Table 4.1. The nut is held, and the screw is kept from turning at its loaded end: the helix makes a torque
/// of the axial force, so that the shaft's torsion up to there adds to the axial displacement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LashTest {
    /// Oversize of the balls' radius, m; not printed.
    pub oversize: f64,
    /// Forces from the negative of the largest to the largest.
    pub steps: usize,
}

impl LashTest {
    fn solve(self, pattern: Pattern, load: Load) -> Result<StaticSolution, ReferenceError> {
        let case = CaseStudy::table_4_1();
        let mut setup = case.setup()?;
        let middle = 0.5 * TURNS * TAU;
        let azimuths = pattern.azimuths(&case.geometry, case.balls, TURNS)?;
        let ball = |azimuth: f64| Ball {
            oversize: self.oversize,
            ..Ball::new(
                azimuth,
                case.nut_position + (azimuth - middle) * case.geometry.advance(),
            )
        };
        setup.balls = azimuths.into_iter().map(ball).collect();
        setup.supports = vec![Support {
            position: 0.0,
            held: [None, None, None, None, None, Some(0.0)],
        }];
        setup.loads = vec![load];
        StaticLoad::new(setup)?.solve()
    }

    /// Axial displacement, m, of the left end under an axial force, N. Only the balls hold the screw aside.
    pub fn axial(self, pattern: Pattern, force: f64) -> Result<f64, ReferenceError> {
        let solution = self.solve(pattern, Load::axial(0.0, force))?;
        Ok(solution.axial_displacement())
    }

    /// Lateral displacement, m, of the far end under a lateral force there, N; only the balls hold the screw, and what keeps
    /// it from turning. Larger balls in an uneven pattern push the screw aside without any force.
    pub fn conical(self, pattern: Pattern, force: f64) -> Result<f64, ReferenceError> {
        let load = Load {
            position: CaseStudy::table_4_1().screw_length,
            force: [force, 0.0, 0.0],
            moment: [0.0; 3],
        };
        let solution = self.solve(pattern, load)?;
        Ok(solution.displacements.last().map_or(0.0, |moved| moved[0]))
    }

    pub fn curves(self, tick: Tick<'_>) -> Result<Vec<LashCurves>, ReferenceError> {
        if !(2..=10_000).contains(&self.steps) {
            return Err(ReferenceError::input("steps", "must be 2 to 10000"));
        }
        let last = self.steps as f64 - 1.0;
        let points: Vec<(usize, f64)> = (0..Pattern::ALL.len())
            .flat_map(|pattern| {
                (0..self.steps).map(move |step| (pattern, 2.0 * step as f64 / last - 1.0))
            })
            .collect();
        let found: Vec<[(f64, f64); 2]> = points
            .par_iter()
            .map(|(pattern, share)| {
                let pattern = Pattern::ALL[*pattern];
                let (axial, lateral) = (share * AXIAL_FORCE, share * LATERAL_FORCE);
                let point = [
                    (axial, self.axial(pattern, axial)?),
                    (lateral, self.conical(pattern, lateral)?),
                ];
                tick();
                Ok(point)
            })
            .collect::<Result<_, ReferenceError>>()?;
        Ok(Pattern::ALL
            .into_iter()
            .zip(found.chunks_exact(self.steps))
            .map(|(pattern, points)| LashCurves {
                pattern,
                axial: points.iter().map(|[axial, _]| *axial).collect(),
                conical: points.iter().map(|[_, conical]| *conical).collect(),
            })
            .collect())
    }
}

/// Force (N) and displacement (m) of both tests of one pattern.
#[derive(Clone, Debug, PartialEq)]
pub struct LashCurves {
    pub pattern: Pattern,
    pub axial: Vec<(f64, f64)>,
    pub conical: Vec<(f64, f64)>,
}

pub fn spread(values: &[f64]) -> f64 {
    let (least, most) = values.iter().fold(
        (f64::INFINITY, f64::NEG_INFINITY),
        |(least, most), value| (least.min(*value), most.max(*value)),
    );
    (most - least) * values.len() as f64 / values.iter().sum::<f64>().abs()
}
