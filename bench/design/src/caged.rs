//! From a design to the law of one ball over its load.

mod design;
mod exact;
mod nodes;

use std::time::Instant;

use epas_friction::Range;
use epas_friction::ball::folded::{FrictionNode, LoadLaw, log2_biased};
use epas_friction::scene::{CagedBallScrewConfiguration, CagedConstants};
use rayon::prelude::*;

use crate::Failure;
use crate::certificate::Certificate;
use crate::curve::fitted;
use crate::digest;
pub use design::CagedDesign;
pub(crate) use design::FRICTION;
pub(crate) use exact::Exact;
use nodes::{Nodes, aligned};

/// Loads of one ball for which a law holds where nothing else is asked, N.
pub const AXIAL_LOAD: [f32; 2] = [5.0, 300.0];

/// Version of the way from a design to a block, which the digest of a block covers: raised by every change that gives the same design other bits.
pub const ALGORITHM: u32 = 1;

/// Nodes of a range of friction coefficients.
pub const NODES: usize = 5;

/// Loads that are solved for a curve: in the domain, and below it.
const LOADS: usize = 400;
const LOADS_BELOW: usize = 80;

/// One in so many loads is solved to place nodes, and between two of them to align them.
const SPARSE: usize = 4;

/// How far below the least load a curve is fitted, as a factor.
const BELOW: f64 = 100.0;

/// How far above the largest load an even node is fitted, octaves: as far as its regimes are shifted.
const SHIFT: f64 = 1.5;

/// A largest error of the torque from which on a domain is not held.
const LARGEST_ERROR: f64 = 0.03;

/// Largest axial load of a ball, N, and the least ratio of the ends of a range.
const LARGEST_LOAD: f32 = 1e5;
const APART: f32 = 1.1;

/// A design to be folded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CagedFold {
    /// The screw with its numbers.
    pub gear: CagedDesign,
    /// Least and largest friction coefficient for which the law holds, where it is more than one: 1e-3 to 0.5.
    pub friction: Option<[f32; 2]>,
    /// Least and largest axial load of one ball for which the law holds, N, 0.01 to 1e5.
    pub axial_load: [f32; 2],
    /// Seed of the states of the certificate.
    pub seed: u64,
}

/// A folded design.
#[derive(Clone, Debug)]
pub struct Folded {
    /// What was folded.
    pub fold: CagedFold,
    /// The block.
    pub block: Block,
    /// Its errors.
    pub certificate: Certificate,
    /// [`CagedFold::digest`].
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
pub enum Block {
    /// One friction coefficient.
    One(CagedBallScrewConfiguration<1>),
    /// A range of them.
    Range(CagedBallScrewConfiguration<NODES>),
}

impl CagedFold {
    /// A design with the friction coefficient that it has, for loads of 5 to 300 N a ball.
    #[must_use]
    pub const fn of(gear: CagedDesign) -> Self {
        Self {
            gear,
            friction: None,
            axial_load: AXIAL_LOAD,
            seed: 1,
        }
    }

    /// Folds it, and measures the block's errors.
    pub fn folded(&self) -> Result<Folded, Failure> {
        self.folded_with(&|_| ())
    }

    /// The same; `progress` is told the share that is done, rising from 0 to 1.
    pub fn folded_with(&self, progress: &(dyn Fn(f64) + Sync)) -> Result<Folded, Failure> {
        let begun = Instant::now();
        self.check()?;
        let exact = Exact::of(&self.gear)?;
        progress(0.0);
        let block = self.block_of(&exact)?;
        progress(0.5);
        let certificate = match &block {
            Block::One(block) => Certificate::of(self, &exact, block),
            Block::Range(block) => Certificate::of(self, &exact, block),
        }?;
        progress(1.0);
        let [torque] = &certificate.figures;
        if torque.largest > LARGEST_ERROR {
            return Err(Failure::Domain(format!(
                "the torque over the load is accurate to {:.1} % only, largest at {:.3} N a ball, friction coefficient {:.4}; narrow the \
                 domain there",
                100.0 * torque.largest,
                torque.worst_load,
                torque.worst_friction,
            )));
        }
        Ok(Folded {
            fold: *self,
            block,
            certificate,
            digest: self.digest(),
            seconds: begun.elapsed().as_secs_f64(),
        })
    }

    /// The block alone, in a fifth of the time: its errors are not measured.
    pub fn block(&self) -> Result<Block, Failure> {
        self.check()?;
        self.block_of(&Exact::of(&self.gear)?)
    }

    fn block_of(&self, exact: &Exact) -> Result<Block, Failure> {
        Ok(match self.friction {
            None => {
                let nodes = Nodes::aligned_later([self.gear.friction]);
                Block::One(self.configured(self.law(exact, &nodes)?))
            }
            Some(range) => {
                let loads = self.axial_load.map(f64::from);
                let from = shifted_from(exact).into();
                let nodes = Nodes::placed(exact, range, loads, from);
                Block::Range(self.configured(self.law(exact, &nodes)?))
            }
        })
    }

    /// The block for friction coefficients between the first and the last of some nodes, at least 1.01 times apart; [`Self::friction`] is not read.
    pub fn block_at<const N: usize>(
        &self,
        nodes: [f32; N],
    ) -> Result<CagedBallScrewConfiguration<N>, Failure> {
        self.check()?;
        let law = self.law(&Exact::of(&self.gear)?, &Nodes::aligned_later(nodes))?;
        let block = self.configured(law);
        CagedConstants::new(&block)?;
        Ok(block)
    }

    /// The errors of a block of this design, over the loads of this fold and the friction coefficients of the block's nodes.
    pub fn errors<const N: usize>(
        &self,
        block: &CagedBallScrewConfiguration<N>,
    ) -> Result<Certificate, Failure> {
        Certificate::of(self, &Exact::of(&self.gear)?, block)
    }

    /// Whether every number of the design and of the domain is within its range; nothing is solved.
    pub fn check(&self) -> Result<(), Failure> {
        self.gear.checked()?;
        check_domain(self.gear.friction, self.friction, self.axial_load)
    }

    fn configured<const N: usize>(&self, law: LoadLaw<N>) -> CagedBallScrewConfiguration<N> {
        let CagedDesign {
            design,
            friction,
            loaded_balls,
            reversal_speed,
            limits,
            ..
        } = self.gear;
        let (least, largest) = law.friction_range();
        CagedBallScrewConfiguration {
            friction: friction.clamp(least, largest),
            lead: design.lead(),
            loaded_balls,
            reversal_speed,
            limits,
            law,
        }
    }

    fn law<const N: usize>(&self, exact: &Exact, of: &Nodes<N>) -> Result<LoadLaw<N>, Failure> {
        let [least, most] = self.axial_load.map(f64::from);
        let frictions = of.frictions;
        let loads = loads(least, most * of.reach.exp2());
        let solved = frictions
            .par_iter()
            .flat_map(|&friction| [(friction, 1.0), (friction, -1.0)])
            .map(|(friction, side)| exact.samples(friction, side, &loads, least))
            .collect::<Result<Vec<_>, Failure>>()?;
        let curves = solved
            .par_iter()
            .map(|samples| Ok(fitted(samples)?.0))
            .collect::<Result<Vec<_>, Failure>>()?;
        let end = |load: f64| log2_biased((load + exact.lift_off) as f32);
        let shifted_from = shifted_from(exact);
        let mut nodes: [FrictionNode; N] = std::array::from_fn(|node| FrictionNode {
            friction: frictions[node],
            curves: [curves[2 * node], curves[2 * node + 1]],
            shift: [0.0; 2],
        });
        let sparse: Vec<f64> = loads.iter().copied().step_by(SPARSE).collect();
        for node in 1..N {
            if let Some(shifts) = of.shifts {
                nodes[node - 1].shift = shifts[node - 1].map(|shift| shift as f32);
                continue;
            }
            for (branch, side) in [1.0, -1.0].into_iter().enumerate() {
                let [low, high] = [node - 1, node].map(|node| &solved[2 * node + branch][..]);
                let friction = (f64::from(frictions[node - 1]) * f64::from(frictions[node])).sqrt();
                let middle = exact.samples(friction as f32, side, &sparse, least)?;
                nodes[node - 1].shift[branch] =
                    aligned(low, &middle, high, shifted_from.into()) as f32;
            }
        }
        Ok(LoadLaw {
            nodes,
            ends: [end(least / BELOW), end(most)],
            lift_off: exact.lift_off as f32,
            shifted_from,
        })
    }

    /// FNV-1a over [`ALGORITHM`] and the numbers of all inputs, in a stated order: a name that changes changes no digest.
    #[must_use]
    pub fn digest(&self) -> u64 {
        digest::of_caged(self)
    }
}

/// Octaves from which on loads are shifted between nodes.
fn shifted_from(exact: &Exact) -> f32 {
    if exact.lift_off > 0.0 {
        log2_biased((exact.lift_off + exact.lift_off) as f32)
    } else {
        1.0
    }
}

/// Whether the coefficients, with the one that a design has, and the loads of a ball are within their ranges.
pub(crate) fn check_domain(
    own: f32,
    friction: Option<[f32; 2]>,
    [least, most]: [f32; 2],
) -> Result<(), Failure> {
    Range::new(0.01, LARGEST_LOAD).checked("axial_load", least)?;
    Range::new(APART * least, LARGEST_LOAD).checked("axial_load", most)?;
    if let Some([least, largest]) = friction {
        FRICTION.checked("friction", least)?;
        Range::new(APART * least, FRICTION.maximum).checked("friction", largest)?;
        Range::new(least, largest).checked("friction", own)?;
    }
    Ok(())
}

/// Loads from the largest to a [`BELOW`]th of the least.
fn loads(least: f64, most: f64) -> Vec<f64> {
    falling([least, most], [LOADS, LOADS_BELOW], BELOW)
}

/// So many loads at equal ratios from the largest to the least, and from there to a part of it.
pub(crate) fn falling(
    [least, most]: [f64; 2],
    [within, beyond]: [usize; 2],
    below: f64,
) -> Vec<f64> {
    let part = |from: f64, to: f64, count: usize| {
        (0..count).map(move |step| from * (to / from).powf(step as f64 / count as f64))
    };
    part(most, least, within)
        .chain(part(least, least / below, beyond))
        .chain([least / below])
        .collect()
}
