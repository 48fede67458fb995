//! From a design to the law of one ball that its neighbours press on.

mod ball;
mod certificate;
mod fit;
mod knots;
mod neighbours;
mod ring;

use std::time::Instant;

use epas_friction::Range;
use epas_friction::ball::pressed::{
    BallLaw, BallNode, BallNumbers, Knot, NeighbourNumbers, RubbedNode,
};
use epas_friction::scene::FoldedBall;
use rayon::prelude::*;

use crate::Failure;
use crate::caged::{CagedDesign, Exact, check_domain, falling};
use crate::digest;
use ball::{Balls, Speeds, exact_ball};
pub use certificate::{RowFigures, UncagedCertificate, UncagedFigure};
use fit::{Branch, Fit, Numbers};
pub use ring::PressedRow;

/// Version of the way from a design to a block, which the digest of a block covers: raised by every change that gives the same design other bits.
pub const ALGORITHM: u32 = 6;

/// Nodes of a range of friction coefficients.
pub const NODES: usize = 3;

/// Loads that are solved for a branch: in the domain, and below it down to a tenth of the least.
const LOADS: usize = 150;
const LOADS_BELOW: usize = 25;
const BELOW: f64 = 10.0;

/// Weight of errors below the least load, where forces and torques themselves are small.
const WEIGHT_BELOW: f64 = 0.05;

/// Error of the forces that hold balls, over their root mean square, from which on forces between balls are not held under a load.
const UNHELD: f64 = 0.016;

/// A largest error of the torque of a row without friction between balls, from which on a domain is not held.
const LARGEST_ERROR: f64 = 0.03;

/// The same of rows with friction between balls that a step does not flag.
const LARGEST_RUBBING_ERROR: f64 = 0.1;

/// Friction coefficient between balls where none is given.
pub const BALL_FRICTION: f32 = 0.1;

/// Least friction coefficient between balls by which an outward force is taken along with friction: with less of it balls hardly rub.
const LEAST_BALL_FRICTION: f64 = 0.03;

/// Share of the work that the fold is, beside its certificate.
const FOLDED: f64 = 0.3;

/// Range of a largest deviation, rad.
const DEVIATION: Range = Range::new(1e-4, 0.1);

/// A ball screw whose balls touch and press on each other, with its numbers; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UncagedDesign {
    /// The screw with its numbers, as for a caged one.
    pub gear: CagedDesign,
    /// Largest deviations of the contact angles on the screw and in the nut for which the law holds, rad, 1e-4 to 0.1 each.
    pub deviations: [f32; 2],
}

/// A design to be folded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UncagedFold {
    /// The screw with its numbers.
    pub gear: UncagedDesign,
    /// Least and largest friction coefficient for which the law holds, where it is more than one: 1e-3 to 0.5.
    pub friction: Option<[f32; 2]>,
    /// Friction coefficient between balls, 0 to 1: that of the rows of the certificate, and by which an outward force of neighbours goes with their
    /// friction.
    pub ball_friction: f32,
    /// Least and largest axial load of one ball for which the law holds, N, 0.01 to 1e5.
    pub axial_load: [f32; 2],
    /// Seed of the rows of the certificate.
    pub seed: u64,
}

/// A folded design.
#[derive(Clone, Debug)]
pub struct FoldedUncaged {
    /// What was folded.
    pub fold: UncagedFold,
    /// The law of one ball, and what else a step needs.
    pub block: UncagedBlock,
    /// Its errors.
    pub certificate: UncagedCertificate,
    /// [`UncagedFold::digest`].
    pub digest: u64,
    /// Time that it took, s.
    pub seconds: f64,
}

/// A block, by its number of friction coefficients.
#[expect(
    clippy::large_enum_variant,
    reason = "a host has room, and a program has few of them"
)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum UncagedBlock {
    /// One friction coefficient.
    One(FoldedBall<1>),
    /// A range of them.
    Range(FoldedBall<NODES>),
}

/// The same that models refer to as long as a program runs.
#[derive(Clone, Copy, Debug)]
pub enum Folded {
    /// One friction coefficient.
    One(&'static FoldedBall<1>),
    /// A range of them.
    Range(&'static FoldedBall<NODES>),
}

/// Values of one number under each load, with the weights of the squares of their errors.
#[derive(Clone, Debug)]
struct Column {
    values: Vec<f64>,
    weights: Vec<f64>,
}

impl UncagedFold {
    /// A design with the friction coefficient that it has, for loads of 5 to 300 N a ball.
    #[must_use]
    pub const fn of(gear: UncagedDesign) -> Self {
        Self {
            gear,
            friction: None,
            ball_friction: BALL_FRICTION,
            axial_load: crate::caged::AXIAL_LOAD,
            seed: 1,
        }
    }

    /// Folds it, and measures the block's errors.
    pub fn folded(&self) -> Result<FoldedUncaged, Failure> {
        self.folded_with(&|_| ())
    }

    /// The same; `progress` is told the share that is done, rising from 0 to 1.
    pub fn folded_with(&self, progress: &(dyn Fn(f64) + Sync)) -> Result<FoldedUncaged, Failure> {
        let begun = Instant::now();
        progress(0.0);
        let block = self.block()?;
        progress(FOLDED);
        let certified = |share: f64| progress(FOLDED + (1.0 - FOLDED) * share);
        let certificate = match &block {
            UncagedBlock::One(block) => UncagedCertificate::of(self, &block.law, &certified),
            UncagedBlock::Range(block) => UncagedCertificate::of(self, &block.law, &certified),
        }?;
        let rows = [
            (
                "random deviations",
                &certificate.smooth.torque,
                LARGEST_ERROR,
            ),
            (
                "deviations in waves",
                &certificate.waves.torque,
                LARGEST_ERROR,
            ),
            (
                "random deviations and friction between balls",
                &certificate.rubbing.unflagged_torque,
                LARGEST_RUBBING_ERROR,
            ),
            (
                "deviations in waves and friction between balls",
                &certificate.rubbing_waves.unflagged_torque,
                LARGEST_RUBBING_ERROR,
            ),
        ];
        if let Some((which, torque, _)) = rows
            .into_iter()
            .find(|(_, torque, most)| torque.largest > *most)
        {
            return Err(Failure::Domain(format!(
                "the torque of a row of balls with {which} is accurate to {:.1} % only, largest at {:.3} N a ball, friction coefficient {:.4}; narrow \
                 the domain there, or the deviations",
                100.0 * torque.largest,
                torque.worst_load,
                torque.worst_friction,
            )));
        }
        Ok(FoldedUncaged {
            fold: *self,
            block,
            certificate,
            digest: self.digest(),
            seconds: begun.elapsed().as_secs_f64(),
        })
    }

    /// The block alone: its errors are not measured.
    pub fn block(&self) -> Result<UncagedBlock, Failure> {
        self.check()?;
        Ok(match self.friction {
            None => UncagedBlock::One(self.folded_ball([self.gear.gear.friction])?),
            Some([least, largest]) => {
                let ratio = f64::from(largest) / f64::from(least);
                let nodes = std::array::from_fn(|node| {
                    let share = node as f64 / (NODES - 1) as f64;
                    (f64::from(least) * ratio.powf(share)) as f32
                });
                UncagedBlock::Range(self.folded_ball::<NODES>(nodes)?)
            }
        })
    }

    /// Whether every number of the design and of the domain is within its range; nothing is solved.
    pub fn check(&self) -> Result<(), Failure> {
        let UncagedDesign { gear, deviations } = self.gear;
        gear.checked()?;
        for deviation in deviations {
            DEVIATION.checked("deviations", deviation)?;
        }
        check_domain(gear.friction, self.friction, self.axial_load)
    }

    fn folded_ball<const N: usize>(&self, frictions: [f32; N]) -> Result<FoldedBall<N>, Failure> {
        let gear = &self.gear.gear;
        let law = self.law(frictions)?;
        law.checked()?;
        let speeds = Speeds::of(&exact_ball(gear, gear.friction).design);
        let (least, largest) = law.friction_range();
        Ok(FoldedBall {
            law,
            friction: gear.friction.clamp(least, largest),
            lead: gear.design.lead(),
            ball_radius: gear.design.ball_radius(),
            path_radius: gear.design.path_radius(),
            speed: speeds.against_nut as f32,
            reversal_speed: gear.reversal_speed,
            limits: gear.limits,
        })
    }

    fn law<const N: usize>(&self, frictions: [f32; N]) -> Result<BallLaw<N>, Failure> {
        let lift_off = Exact::of(&self.gear.gear)?.lift_off;
        let loads = falling(self.axial_load.map(f64::from), [LOADS, LOADS_BELOW], BELOW);
        let branches = frictions
            .par_iter()
            .flat_map(|&friction| [(friction, 1.0), (friction, -1.0)])
            .map(|(friction, side)| self.branch(friction, side, &loads, lift_off))
            .collect::<Result<Vec<Branch>, Failure>>()?;
        let nodes = std::array::from_fn(|node| {
            let of = |branch: usize| &branches[2 * node + branch];
            // Between two nodes forces are held where both hold them.
            let unheld = |branch: usize| {
                let next = branches.get(2 * (node + 1) + branch);
                unheld(of(branch), of(branch)) | next.map_or(0, |next| unheld(next, of(branch)))
            };
            BallNode {
                friction: frictions[node],
                branches: [of(0), of(1)].map(|branch| knots_of(&branch.knots, rounded)),
                neighbours: [of(0), of(1)].map(|branch| knots_of(&branch.neighbours, neighbours)),
                unheld: [unheld(0), unheld(1)],
            }
        });
        Ok(BallLaw {
            nodes,
            deviations: self.gear.deviations,
            lift_off: lift_off as f32,
        })
    }

    fn branch(
        &self,
        friction: f32,
        side: f64,
        loads: &[f64],
        lift_off: f64,
    ) -> Result<Branch, Failure> {
        let gear = &self.gear.gear;
        let ball = exact_ball(gear, friction);
        let balls = Balls {
            ball,
            deviations: self.gear.deviations.map(f64::from),
            lift_off,
            loads,
            side,
            ball_friction: f64::from(self.ball_friction).max(LEAST_BALL_FRICTION),
        };
        let samples = balls.samples()?;
        let least = f64::from(self.axial_load[0]) + lift_off;
        let weights: Vec<f64> = samples
            .iter()
            .map(|sample| {
                if sample.load < 0.999 * least {
                    WEIGHT_BELOW
                } else {
                    1.0
                }
            })
            .collect();
        let speeds = Speeds::of(&ball.design);
        Ok(Fit::new(&samples, &weights, speeds.against_nut).branch())
    }

    /// FNV-1a over [`ALGORITHM`] and the numbers of all inputs, in a stated order: a name that changes changes no digest.
    #[must_use]
    pub fn digest(&self) -> u64 {
        digest::of_uncaged(self)
    }
}

/// The knots of a branch; those that it does not need are its last one.
fn knots_of<T, U: Copy, const K: usize>(
    knots: &[(f64, T)],
    rounded: impl Fn(&T) -> U,
) -> [Knot<U>; K] {
    let at = |knot: usize| &knots[knot.min(knots.len() - 1)];
    std::array::from_fn(|knot| {
        let ((load, numbers), (next, _)) = (at(knot), at((knot + 1).min(K - 1)));
        Knot::between(*load as f32, *next as f32, rounded(numbers))
    })
}

fn rounded(numbers: &Numbers) -> BallNumbers {
    BallNumbers {
        free: numbers.free.map(|number| number as f32),
        impedance: numbers.impedance.map(|number| number as f32),
        torque: numbers.torque.map(|number| number as f32),
        slope: numbers.slope as f32,
        work: numbers.work as f32,
    }
}

fn neighbours(numbers: &neighbours::Numbers) -> NeighbourNumbers {
    let line = |line: [f64; 3]| line.map(|number| number as f32);
    NeighbourNumbers {
        nodes: std::array::from_fn(|node| RubbedNode {
            push: line(numbers.push[node]),
            impedance: line(numbers.impedance[node]),
            torque: line(numbers.torque[node]),
        }),
        outward: numbers.outward.map(|number| number as f32),
        outward_torque: numbers.outward_torque as f32,
    }
}

/// A bit for each knot of `knots` up to the next of which a branch does not hold forces.
fn unheld(branch: &Branch, knots: &Branch) -> u32 {
    branch
        .errors
        .iter()
        .filter(|errors| errors.force > UNHELD)
        .map(|errors| {
            let above = knots
                .knots
                .partition_point(|(load, _)| *load <= errors.load);
            above.clamp(1, knots.knots.len() - 1) - 1
        })
        .fold(0, |bits, knot| bits | 1 << knot)
}
