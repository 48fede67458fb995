//! The built-in designs as blocks that come with the crate, for who has no host.
//!
//! `src/scene/caged/built_in.bin` is the blocks one after another, in the order of [`files::built_in`], each as its words, least significant byte first.
//! [`crate::folds`] stores others, for this program: the papers' designs have the papers' friction coefficient and clearance there, the default's here.

use std::path::{Path, PathBuf};

use epas_friction::scene::{BUILT_IN_NODES, CagedBallScrewConfiguration};
use epas_friction::{BallScrew, BallScrewParameters};
use rayon::prelude::*;

use crate::files::{self, Design};
use crate::{CagedFold, Failure};

/// Friction coefficients of the nodes.
pub const NODES: [f32; BUILT_IN_NODES] = [
    0.05, 0.06, 0.07, 0.08, 0.09, 0.1, 0.11, 0.12, 0.13, 0.14, 0.15,
];

/// A block of the file.
pub type Block = CagedBallScrewConfiguration<BUILT_IN_NODES>;

/// What is folded of a design: with the default friction coefficient, clearance and rolling resistance, for 5 to 300 N a ball.
pub fn fold_of(
    parameters: BallScrewParameters,
    loaded_balls: Option<u16>,
) -> Result<CagedFold, Failure> {
    let screw = BallScrew::new(parameters)?;
    Ok(CagedFold::of(Design::usual(screw, loaded_balls).caged))
}

/// The block of a fold.
pub fn block_of(fold: &CagedFold) -> Result<Block, Failure> {
    fold.block_at(NODES)
}

/// The bytes of a fold's block.
pub fn bytes_of(fold: &CagedFold) -> Result<Vec<u8>, Failure> {
    let mut words = vec![0; Block::WORDS];
    block_of(fold)?.write(fold.digest(), &mut words)?;
    Ok(words.into_iter().flat_map(u32::to_le_bytes).collect())
}

/// The whole file, folded anew.
pub fn folded() -> Result<Vec<u8>, Failure> {
    let designs: Vec<_> = files::built_in().collect();
    let blocks = designs
        .into_par_iter()
        .map(|(name, parameters, balls)| {
            let bytes = fold_of(parameters, balls).and_then(|fold| bytes_of(&fold));
            bytes.map_err(|failure| failure.of(name))
        })
        .collect::<Result<Vec<_>, Failure>>()?;
    Ok(blocks.concat())
}

/// Where the file is in a checkout.
pub fn path(root: &Path) -> PathBuf {
    root.join("src/scene/caged/built_in.bin")
}
