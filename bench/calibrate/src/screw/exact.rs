//! Friction of a screw by the exact ball of the reference, over load, friction coefficient and preload, for a fit that moves all three.
//!
//! The ball is solved on a grid of friction coefficients and preloads, each node when a fit first comes near it, and kept: a fit then
//! evaluates polynomials. `q = T / (mu W)` of one ball, with `W = |F| + F_0` and the lift-off load `F_0`, is interpolated by cubics along the
//! logarithms of `W/F_0`, of the coefficient and of the gap. At equal `W/F_0` a contact opens at about the same place whatever the preload is.
//!
//! A search crosses many nodes and needs none of them exactly: it runs on a grid with [`Spacing::COARSE`]. The answer and its covariance come
//! from a grid with [`Spacing::FINE`], of which only the nodes around the answer are solved.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use epas_design::CagedDesign;
use epas_design::drawing::drawing;
use epas_friction::law::coefficient::DirectionalCoefficient;
use epas_friction::scene::SlidingFriction;
use epas_reference::ReferenceError;
use epas_reference::curvature::Groove;
use epas_reference::design::BallScrewDesign;
use epas_reference::friction::held_ball::HeldBall;
use epas_reference::friction::patch::Integration;
use epas_reference::friction::rolling_resistance::RollingResistance;
use rayon::prelude::*;

/// Octaves above none between which a contact of a preload lifts off, and the torque changes within a few percent of the load.
const LIFT_OFF: (f64, f64) = (0.6, 1.2);

/// How closely the nodes of a grid lie, and how the contacts of its ball are integrated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spacing {
    /// Ratio of neighbouring friction coefficients with a preload.
    friction: f64,
    /// The same with play, where regimes move faster with the coefficient.
    friction_with_play: f64,
    gap: f64,
    in_an_octave: f64,
    /// Loads in an octave around the lift-off of a preload.
    at_lift_off: f64,
    integration: Integration,
}

impl Spacing {
    /// For an answer.
    ///
    /// 32 nodes of a contact integral err by less than a tenth of what the interpolation between loads does, and take a third of the time.
    pub const FINE: Self = Self {
        friction: 1.08,
        friction_with_play: 1.03,
        gap: 1.2,
        in_an_octave: 20.0,
        at_lift_off: 80.0,
        integration: Integration::Coarse,
    };

    /// For a search: twice as wide in each direction, so that it takes an eighth of the time for the same range. It errs by some parts in a
    /// thousand of the friction.
    pub const COARSE: Self = Self {
        friction: 1.17,
        friction_with_play: 1.06,
        gap: 1.4,
        in_an_octave: 10.0,
        at_lift_off: 40.0,
        ..Self::FINE
    };

    /// For numbers that are written: few nodes, integrated to the last digit.
    pub const WRITTEN: Self = Self {
        integration: Integration::Full,
        ..Self::FINE
    };

    /// A preload half a node of the gap away: the grid of a design with it needs four nodes for a fit about this one, and not five.
    pub fn beside(&self, preload: f64) -> f64 {
        preload * self.gap.powf(0.75)
    }

    const fn friction_ratio(&self, play: bool) -> f64 {
        if play {
            self.friction_with_play
        } else {
            self.friction
        }
    }

    /// Place of a load on the grid, from its octaves above the first one.
    fn load_place(&self, octaves: f64, preloaded: bool) -> f64 {
        let (begin, end) = LIFT_OFF;
        let finer = self.at_lift_off - self.in_an_octave;
        let near = octaves.clamp(begin, end) - begin;
        self.in_an_octave * octaves + if preloaded { finer * near } else { 0.0 }
    }

    /// Octaves of a load above the first one, from its place on the grid.
    fn load_octaves(&self, place: f64, preloaded: bool) -> f64 {
        let (begin, end) = LIFT_OFF;
        let [low, high] = [begin, end].map(|octaves| self.load_place(octaves, preloaded));
        if !preloaded || place <= low {
            place / self.in_an_octave
        } else if place <= high {
            begin + (place - low) / self.at_lift_off
        } else {
            end + (place - high) / self.in_an_octave
        }
    }
}

/// Octaves below the largest load that are solved without a preload; below them friction is in proportion to the load.
const OCTAVES: f64 = 8.0;

/// Least largest load of a ball over its lift-off load. Where one flank alone carries, the balance is found from nothing; between both
/// flanks, from its neighbour only.
const BEYOND_LIFT_OFF: f64 = 3.0;

/// Load that stands for none, over the lift-off load.
const NO_LOAD: f64 = 1e-4;

/// Friction coefficients that are solved; beyond them friction is in proportion.
const FRICTION: (f64, f64) = (1e-3, 0.6);

/// Smallest largest load of a ball, N.
const LEAST_LARGEST: f64 = 16.0;

/// Resistances for which the contacts' rolling is solved apart.
const HYSTERESIS: f64 = 0.1;
const DRAG: f64 = 1.0;

const POINTS: usize = 4;

/// With which rolling resistance a ball is solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Part {
    /// That of the design.
    Whole,
    Hysteresis,
    Drag,
    None,
}

/// Numbers of the friction coefficient and of the gap on the grid.
type Node = (Part, i32, i32);

/// `T/(mu W)` at rising loads, m, under a load that opposes the motion and under one that assists it.
type Curves = [Vec<f64>; 2];

type Solved = Arc<OnceLock<Result<Arc<Curves>, ReferenceError>>>;

/// The exact ball of a design, solved where it is asked for.
#[derive(Debug)]
pub struct Grid {
    design: BallScrewDesign,
    rolling: RollingResistance,
    balls: f64,
    spacing: Spacing,
    ratio: f64,
    /// Gap of the node 0, m.
    gap: f64,
    /// Approach of ball and both grooves under 1 N, m, and axial load over a contact's force.
    deflection: f64,
    per_normal: f64,
    /// Largest load of a ball, N.
    largest: f64,
    solved: Mutex<HashMap<Node, Solved>>,
}

/// Friction of a screw with one preload, for friction coefficients between two.
#[derive(Clone, Debug)]
pub struct ExactLaw {
    balls: f64,
    spacing: Spacing,
    /// Lift-off load of a ball, N; 0 without a preload.
    lift_off: f64,
    /// Load of the first point, N.
    first_load: f64,
    /// Logarithm of the ratio of neighbouring friction coefficients, number of the first one, and how many there are.
    logarithm: f64,
    first_friction: i32,
    frictions: usize,
    /// By side, load, friction coefficient.
    values: [Vec<f64>; 2],
}

/// The four points of a cubic around a place, as the number of the first and their weights: Catmull and Rom.
fn weights(place: f64) -> (i32, [f64; POINTS]) {
    // The floor, which is a call where the processor's own is not taken for granted.
    let towards_zero = place as i32;
    let below = towards_zero - i32::from(place < f64::from(towards_zero));
    let t = place - f64::from(below);
    let weights = [
        -0.5 * t + t * t - 0.5 * t * t * t,
        1.0 - 2.5 * t * t + 1.5 * t * t * t,
        0.5 * t + 2.0 * t * t - 1.5 * t * t * t,
        -0.5 * t * t + 0.5 * t * t * t,
    ];
    (below - 1, weights)
}

/// Place of a friction coefficient on a grid with this logarithm of the ratio of neighbours.
fn friction_place(friction: f64, logarithm: f64) -> f64 {
    let (least, largest) = FRICTION;
    friction.clamp(least, largest).ln() / logarithm
}

impl Grid {
    /// Of a design, under axial loads up to a largest one, N.
    pub fn of(
        caged: &CagedDesign,
        largest_load: f64,
        spacing: Spacing,
    ) -> Result<Arc<Self>, ReferenceError> {
        let largest = largest_load.abs() / f64::from(caged.loaded_balls);
        Ok(Arc::new(Self::new(
            caged,
            largest.max(LEAST_LARGEST),
            spacing,
        )?))
    }

    fn new(caged: &CagedDesign, largest: f64, spacing: Spacing) -> Result<Self, ReferenceError> {
        let design = drawing(caged.design.parameters());
        let deflection =
            design.contact(Groove::Screw)?.deflection + design.contact(Groove::Nut)?.deflection;
        Ok(Self {
            design,
            rolling: RollingResistance {
                hysteresis_loss: caged.rolling_resistance.hysteresis_loss.into(),
                lubricant_drag: caged.rolling_resistance.lubricant_drag.into(),
            },
            balls: caged.loaded_balls.into(),
            spacing,
            ratio: spacing.friction_ratio(caged.clearance.gap() > 0.0),
            gap: caged.clearance.gap().into(),
            deflection,
            per_normal: design.contact_angle.sin() * design.lead_angle().cos(),
            largest,
            solved: Mutex::default(),
        })
    }

    /// Axial load of a ball at which the side without a load lifts off, N.
    fn lift_off(&self, gap: f64) -> f64 {
        let preload = (-2.0 * gap / self.deflection).max(0.0).powf(1.5);
        8f64.sqrt() * preload * self.per_normal
    }

    /// Load of the first point where nothing is preloaded, N.
    fn first_load(&self) -> f64 {
        (self.largest.log2().ceil() - OCTAVES).exp2()
    }

    /// The law of a design with another friction coefficient, fit or rolling resistance, for friction coefficients between two.
    pub fn law(
        &self,
        caged: &CagedDesign,
        (least, largest): (f32, f32),
    ) -> Result<ExactLaw, ReferenceError> {
        let gap = f64::from(caged.clearance.gap());
        let preloaded = self.gap < 0.0 && gap < 0.0;
        let (first_gap, gap_weights) = if gap == self.gap || !preloaded {
            (0, vec![1.0])
        } else {
            let (first, weights) = weights((gap / self.gap).ln() / self.spacing.gap.ln());
            (first, weights.to_vec())
        };
        let logarithm = self.ratio.ln();
        let (first, _) = weights(friction_place(least.into(), logarithm));
        let (last, _) = weights(friction_place(largest.into(), logarithm));
        let frictions = (last - first) as usize + POINTS;
        let curves = self.curves(caged, (first, frictions), (first_gap, &gap_weights))?;
        let lift_off = if preloaded { self.lift_off(gap) } else { 0.0 };
        let points = curves.iter().map(|(curves, ..)| curves[0].len()).min();
        let values = [0, 1].map(|side: usize| {
            let mut values = vec![0.0; points.unwrap_or(0) * frictions];
            for (curves, friction, weight) in curves
                .iter()
                .map(|(curves, friction, weight)| (&**curves, friction, weight))
            {
                for (row, value) in values.chunks_mut(frictions).zip(&curves[side]) {
                    row[*friction] += weight * value;
                }
            }
            values
        });
        Ok(ExactLaw {
            balls: self.balls,
            spacing: self.spacing,
            lift_off,
            first_load: if preloaded {
                lift_off
            } else {
                self.first_load()
            },
            logarithm,
            first_friction: first,
            frictions,
            values,
        })
    }

    /// Curves that make a law: each with the number of its friction coefficient and its weight.
    fn curves(
        &self,
        caged: &CagedDesign,
        (first, frictions): (i32, usize),
        (first_gap, gap_weights): (i32, &[f64]),
    ) -> Result<Vec<(Arc<Curves>, usize, f64)>, ReferenceError> {
        let rolling = &caged.rolling_resistance;
        // Each torque of rolling is in proportion to its resistance.
        let hysteresis = f64::from(rolling.hysteresis_loss) - self.rolling.hysteresis_loss;
        let drag = f64::from(rolling.lubricant_drag) - self.rolling.lubricant_drag;
        let (hysteresis, drag) = (hysteresis / HYSTERESIS, drag / DRAG);
        let parts = [
            (Part::Whole, 1.0),
            (Part::Hysteresis, hysteresis),
            (Part::Drag, drag),
            (Part::None, -hysteresis - drag),
        ];
        let mut nodes = Vec::new();
        for (part, share) in parts.into_iter().filter(|(_, share)| *share != 0.0) {
            for (number, weight) in gap_weights.iter().enumerate() {
                for friction in 0..frictions {
                    let node = (part, first + friction as i32, first_gap + number as i32);
                    nodes.push((node, friction, share * weight));
                }
            }
        }
        nodes
            .par_iter()
            .map(|(node, friction, weight)| Ok((self.at(*node)?, *friction, *weight)))
            .collect()
    }

    fn at(&self, node: Node) -> Result<Arc<Curves>, ReferenceError> {
        let solved = {
            let mut all = self.solved.lock().unwrap_or_else(PoisonError::into_inner);
            Arc::clone(all.entry(node).or_default())
        };
        // Other threads wait for the one that solves it, which uses none of them.
        let made = solved.get_or_init(|| Ok(Arc::new(self.solve(node)?)));
        made.clone()
    }

    fn solve(&self, (part, friction, gap): Node) -> Result<Curves, ReferenceError> {
        let none = RollingResistance::NONE;
        let rolling = match part {
            Part::Whole => self.rolling,
            Part::Hysteresis => RollingResistance {
                hysteresis_loss: HYSTERESIS,
                ..none
            },
            Part::Drag => RollingResistance {
                lubricant_drag: DRAG,
                ..none
            },
            Part::None => none,
        };
        let (least, largest) = FRICTION;
        let friction = self.ratio.powi(friction).clamp(least, largest);
        let clearance = self.gap * self.spacing.gap.powi(gap);
        let lift_off = self.lift_off(clearance);
        let ball = HeldBall {
            design: self.design,
            clearance,
            friction,
            rolling,
            integration: self.spacing.integration,
        };
        let preloaded = lift_off > 0.0;
        let load = |point: u32| {
            let octaves = self.spacing.load_octaves(point.into(), preloaded);
            if preloaded {
                lift_off * (octaves.exp2() - 1.0).max(NO_LOAD)
            } else {
                self.first_load() * octaves.exp2()
            }
        };
        let octaves = if preloaded {
            (1.0 + (self.largest / lift_off).max(BEYOND_LIFT_OFF)).log2()
        } else {
            OCTAVES
        };
        let last = self.spacing.load_place(octaves, preloaded).ceil() as u32;
        let loads: Vec<f64> = (0..=last).map(load).collect();
        let side = |side: f64| {
            // From the largest down, so that each balance starts from its neighbour's.
            let falling: Vec<f64> = loads.iter().rev().map(|load| side * load).collect();
            let found: Vec<Result<f64, ReferenceError>> = ball
                .along(&falling)?
                .into_iter()
                .zip(loads.iter().rev())
                .map(|(found, load)| Ok(found?.torque / ((load + lift_off) * friction)))
                .collect();
            // One that is not found is taken from its neighbour: of a lower load where none above is found.
            let mut last = match found.iter().find(|value| value.is_ok()).or(found.first()) {
                Some(value) => value.clone()?,
                None => return Err(ReferenceError::Undriven),
            };
            let mut values: Vec<f64> = found
                .into_iter()
                .map(|value| {
                    last = value.unwrap_or(last);
                    last
                })
                .collect();
            values.reverse();
            Ok::<_, ReferenceError>(values)
        };
        Ok([side(1.0)?, side(-1.0)?])
    }
}

impl ExactLaw {
    /// Friction torque of all balls, N m, under an axial load that opposes the motion where it is not below 0, with friction coefficient.
    fn torque(
        &self,
        (first, along): (usize, &[f64; POINTS]),
        side: usize,
        friction: f64,
        whole: f64,
    ) -> f64 {
        let (place, across) = weights(friction_place(friction, self.logarithm));
        let column =
            (place - self.first_friction).clamp(0, self.frictions as i32 - POINTS as i32) as usize;
        let sum: f64 = along
            .iter()
            .enumerate()
            .map(|(row, along)| {
                let at = (first + row) * self.frictions + column;
                let values = self.values[side].get(at..).and_then(<[f64]>::first_chunk);
                let [a, b, c, d] = *values.unwrap_or(&[0.0; POINTS]);
                along * (across[0] * a + across[1] * b + across[2] * c + across[3] * d)
            })
            .sum();
        (self.balls * whole * friction * sum).max(0.0)
    }

    /// Full friction in both directions under an axial load, N, that opposes a forward motion, each by its friction coefficient.
    pub fn friction(
        &self,
        axial_load: f32,
        coefficient: DirectionalCoefficient,
    ) -> SlidingFriction {
        let load = f64::from(axial_load);
        let whole = load.abs() / self.balls + self.lift_off;
        let one =
            |direction: f64, friction: f32| self.sliding(load, direction, friction.into()) as f32;
        SlidingFriction {
            forward: one(1.0, coefficient.forward),
            backward: one(-1.0, coefficient.backward),
            load: (self.balls * whole) as f32,
        }
    }

    /// Friction of gross sliding, N m, in a direction, 1 or -1, under an axial load, N, that opposes a forward motion, with a coefficient.
    pub fn sliding(&self, axial_load: f64, direction: f64, friction: f64) -> f64 {
        let load = axial_load / self.balls;
        let whole = load.abs() + self.lift_off;
        let points = (self.values[0].len() / self.frictions.max(1)).max(POINTS);
        let octaves = (whole / self.first_load).log2().max(0.0);
        let place = self.spacing.load_place(octaves, self.lift_off > 0.0);
        let last = (points - 1) as f64;
        let (mut first, mut along) = weights(place.min(last));
        // A parabola through the first three points gives the one before them.
        if first < 0 {
            let [before, one, two, three] = along;
            along = [one + 3.0 * before, two - 3.0 * before, three + before, 0.0];
            first = 0;
        }
        let beyond = (first + POINTS as i32 - points as i32).max(0) as usize;
        if beyond > 0 {
            along = shifted(along, beyond);
            first -= beyond as i32;
        }
        let assists = usize::from(direction * load < 0.0);
        self.torque((first as usize, &along), assists, friction, whole)
    }
}

/// Weights of points that lie so many places further down; what lies beyond the last counts at the last.
fn shifted(weights: [f64; POINTS], places: usize) -> [f64; POINTS] {
    let mut moved = [0.0; POINTS];
    for (place, weight) in weights.into_iter().enumerate() {
        moved[(place + places).min(POINTS - 1)] += weight;
    }
    moved
}

#[cfg(test)]
mod tests;
