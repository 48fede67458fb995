//! Axial and conical lash tests with four patterns of ball locations: section 4.2.1, Figures 4.2 and 4.3.

use std::f64::consts::TAU;

use rayon::prelude::*;

use super::Tick;
use epas_reference::error::{ReferenceError, within};
use epas_reference::statics::ball::Ball;
use epas_reference::statics::cases::CaseStudy;
use epas_reference::statics::geometry::Geometry;
use epas_reference::statics::problem::{Load, StaticLoad, Support};

/// Where the balls lie on a track that they do not fill (Figure 4.2; the text shows but does not define them).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// Evenly distributed.
    Even,
    /// Touching each other, from the start of the track on.
    OneEnd,
    /// Touching each other in rows that leave the same sector of each turn empty.
    OneSide,
    /// Touching each other in two halves at both ends of the track.
    HalfHalf,
}

impl Pattern {
    /// All four, in the order of Figure 4.2.
    pub const ALL: [Self; 4] = [Self::Even, Self::OneEnd, Self::OneSide, Self::HalfHalf];

    /// What the figure calls it.
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

/// A lash test. The nut is held.
#[derive(Clone, Debug, PartialEq)]
pub struct LashTest {
    /// Ball screw, with its number of balls and nut position; its loads and its spacing are not used.
    pub case: CaseStudy,
    /// Turns of the loaded track.
    pub turns: f64,
    /// Largest axial force, N: printed, 200.
    pub axial_force: f64,
    /// Largest lateral force, N; not printed, 10.
    pub lateral_force: f64,
    /// Where the lateral force acts and its displacement is measured, m; not printed, the far end.
    pub lateral_position: f64,
    /// Where the screw is kept from turning about its axis, m: the loaded end. The helix makes a torque of the
    /// axial force, so that the shaft's torsion up to there adds to the axial displacement.
    pub turn_position: f64,
    /// Forces from the negative of the largest to the largest.
    pub steps: usize,
}

impl LashTest {
    /// Table 4.1, with an oversize of the balls' radius, m, which the text does not print.
    pub fn table_4_1(oversize: f64) -> Self {
        let case = CaseStudy::table_4_1();
        Self {
            lateral_position: case.screw_length,
            turn_position: 0.0,
            case: CaseStudy {
                ball_oversize: vec![oversize],
                ..case
            },
            turns: 3.75,
            axial_force: 200.0,
            lateral_force: 10.0,
            steps: 21,
        }
    }

    fn balls(&self, pattern: Pattern) -> Result<Vec<Ball>, ReferenceError> {
        let geometry = &self.case.geometry;
        let middle = 0.5 * self.turns * TAU;
        let oversize = self.case.ball_oversize.first().copied().unwrap_or(0.0);
        Ok(pattern
            .azimuths(geometry, self.case.balls, self.turns)?
            .into_iter()
            .map(|azimuth| {
                let position = self.case.nut_position + (azimuth - middle) * geometry.advance();
                Ball {
                    oversize,
                    ..Ball::new(azimuth, position)
                }
            })
            .collect())
    }

    fn load(&self, pattern: Pattern, load: Load) -> Result<StaticLoad, ReferenceError> {
        let mut setup = self.case.setup()?;
        setup.balls = self.balls(pattern)?;
        setup.supports = vec![Support {
            position: self.turn_position,
            held: [None, None, None, None, None, Some(0.0)],
        }];
        setup.loads = vec![load];
        StaticLoad::new(setup)
    }

    /// Axial displacement, m, of the left end under an axial force, N. Only the balls hold the screw aside.
    pub fn axial(&self, pattern: Pattern, force: f64) -> Result<f64, ReferenceError> {
        let load = Load::axial(0.0, force);
        let case = self.load(pattern, load)?;
        Ok(case.solve()?.axial_displacement())
    }

    /// Lateral displacement, m, where a lateral force, N, acts; only the balls hold the screw, and what keeps
    /// it from turning. Larger balls in an uneven pattern push the screw aside without any force.
    pub fn conical(&self, pattern: Pattern, force: f64) -> Result<f64, ReferenceError> {
        let load = Load {
            position: self.lateral_position,
            force: [force, 0.0, 0.0],
            moment: [0.0; 3],
        };
        let solution = self.load(pattern, load)?.solve()?;
        let node = solution
            .positions
            .partition_point(|place| *place < self.lateral_position - 1e-9);
        Ok(solution
            .displacements
            .get(node)
            .map_or(0.0, |moved| moved[0]))
    }

    /// Both curves of all patterns.
    pub fn curves(&self, tick: Tick<'_>) -> Result<Vec<LashCurves>, ReferenceError> {
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
                let (axial, lateral) = (share * self.axial_force, share * self.lateral_force);
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
    /// Where the balls lie.
    pub pattern: Pattern,
    /// Axial test.
    pub axial: Vec<(f64, f64)>,
    /// Conical test.
    pub conical: Vec<(f64, f64)>,
}

/// Difference of the largest and the smallest of some values over their mean.
pub fn spread(values: &[f64]) -> f64 {
    let (least, most) = values.iter().fold(
        (f64::INFINITY, f64::NEG_INFINITY),
        |(least, most), value| (least.min(*value), most.max(*value)),
    );
    (most - least) * values.len() as f64 / values.iter().sum::<f64>().abs()
}

/// Displacement over the whole range of the force, which leaves out what the balls push without any.
pub fn range(curve: &[(f64, f64)]) -> f64 {
    match (curve.first(), curve.last()) {
        (Some(first), Some(last)) => last.1 - first.1,
        _ => 0.0,
    }
}
