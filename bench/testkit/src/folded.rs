//! Blocks of folds that tests evaluate but do not test: stored, and found by the digest of what was folded.
//!
//! `folded.bin` is the blocks one after another, each as its words, least significant byte first; a block's third word is how many it has.

use epas_design::caged::CagedFold;
use epas_design::uncaged::UncagedFold;
use epas_friction::scene::{CagedBallScrewConfiguration, FoldedBall};

static STORED: &[u8] = include_bytes!("../folded.bin");

/// Makes `folded.bin` anew.
pub const STORE: &str =
    "EPAS_STORE=1 cargo test --release -p epas-reference --test all -- --ignored stored_folds";

/// The words of every stored block.
pub fn blocks() -> impl Iterator<Item = Vec<u32>> {
    let (words, _) = STORED.as_chunks();
    let mut rest: Vec<u32> = words.iter().copied().map(u32::from_le_bytes).collect();
    std::iter::from_fn(move || {
        let length = *rest.get(2)? as usize;
        let after = rest.split_off(length);
        Some(std::mem::replace(&mut rest, after))
    })
}

/// The digest in a block's words.
pub fn digest_of(words: &[u32]) -> u64 {
    u64::from(words[5]) << 32 | u64::from(words[4])
}

fn stored(digest: u64) -> Vec<u32> {
    blocks()
        .find(|words| digest_of(words) == digest)
        .unwrap_or_else(|| panic!("no block {digest:016x} is stored; {STORE}"))
}

/// The block of a caged screw.
pub fn caged<const NODES: usize>(fold: &CagedFold) -> CagedBallScrewConfiguration<NODES> {
    CagedBallScrewConfiguration::read(&stored(fold.digest())).unwrap()
}

/// The block of a screw without cage.
pub fn uncaged<const NODES: usize>(fold: &UncagedFold) -> FoldedBall<NODES> {
    FoldedBall::read(&stored(fold.digest())).unwrap()
}
