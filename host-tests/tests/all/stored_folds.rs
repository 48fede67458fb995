//! Blocks that other tests evaluate are those of a fold of today.

use std::collections::BTreeMap;
use std::path::Path;

use epas_design::{CagedFold, UncagedFold};
use epas_testkit::folded::{STORE, blocks, digest_of};

use crate::scenes::{caged, uncaged};

enum Fold {
    Caged(CagedFold),
    Uncaged(UncagedFold),
}

impl Fold {
    fn digest(&self) -> u64 {
        match self {
            Self::Caged(fold) => fold.digest(),
            Self::Uncaged(fold) => fold.digest(),
        }
    }

    fn words(&self) -> Vec<u32> {
        match self {
            Self::Caged(fold) => fold.block().unwrap().words(fold.digest()).unwrap(),
            Self::Uncaged(fold) => fold.block().unwrap().words(fold.digest()).unwrap(),
        }
    }
}

fn folds() -> Vec<Fold> {
    let caged = caged::folds().into_iter().map(Fold::Caged);
    caged
        .chain(uncaged::exact::folds().map(Fold::Uncaged))
        .collect()
}

fn stored() -> BTreeMap<u64, Vec<u32>> {
    blocks().map(|words| (digest_of(&words), words)).collect()
}

#[test]
fn each_fold_is_stored() {
    let stored: Vec<u64> = stored().into_keys().collect();
    let mut wanted: Vec<u64> = folds().iter().map(Fold::digest).collect();
    wanted.sort_unstable();
    assert!(stored == wanted, "{STORE}");
}

/// One caged block, bit by bit; all of them in `stored_folds_are_those_of_today_whole`.
#[test]
fn stored_folds_are_those_of_today() {
    let fold = &folds()[0];
    assert!(stored()[&fold.digest()] == fold.words(), "{STORE}");
}

/// With `EPAS_STORE` in the environment it stores them instead.
#[test]
#[ignore = "whole sweep: cargo test -p epas-reference --test all -- --ignored _whole"]
fn stored_folds_are_those_of_today_whole() {
    let folded: Vec<Vec<u32>> = folds().iter().map(Fold::words).collect();
    if std::env::var_os("EPAS_STORE").is_some() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../bench/testkit/folded.bin");
        let words = folded.into_iter().flatten();
        let bytes: Vec<u8> = words.flat_map(u32::to_le_bytes).collect();
        std::fs::write(path, bytes).unwrap();
        return;
    }
    let stored = stored();
    for words in folded {
        assert!(stored.get(&digest_of(&words)) == Some(&words), "{STORE}");
    }
}
