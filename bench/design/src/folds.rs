//! Blocks that need no fold: those of the built-in designs, which come with the program, and those that it has folded before.
//!
//! Both are found by the digest of what was folded, which covers the version of the fold's algorithm: a block that another version has folded is
//! not found. `bench/design/folded/built_in.bin` is the blocks one after another, each as its words, least significant byte first; a block's third
//! word is how many it has. `design --store` writes it, `design --gate` compares it with a new fold bit by bit.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{LazyLock, Mutex, MutexGuard, PoisonError};

use crate::{CagedFold, UncagedFold};
use epas_friction::Error;
use rayon::prelude::*;

use crate::Failure;
use crate::built_in;
use crate::files::{self, Design, DesignSource};
use crate::{caged_scene as caged, uncaged_scene as uncaged};

static BUILT_IN: &[u8] = include_bytes!("../folded/built_in.bin");

/// Words before the numbers of a block.
const HEADER: usize = 6;

const WORD: usize = size_of::<u32>();

/// Blocks of one kind that were folded, and reasons why a design was not.
pub struct Folds<T> {
    folded: LazyLock<Mutex<HashMap<u64, Result<T, String>>>>,
    /// Most that are kept: a study folds thousands of designs once.
    most: usize,
    /// A block of this kind from its words.
    read: fn(&[u32]) -> Result<T, Error>,
}

impl<T: Clone> Folds<T> {
    /// None so far.
    pub const fn new(most: usize, read: fn(&[u32]) -> Result<T, Error>) -> Self {
        Self {
            folded: LazyLock::new(Mutex::default),
            most,
            read,
        }
    }

    /// What was folded from inputs with this digest, or why nothing was.
    pub fn get(&self, digest: u64) -> Option<Result<T, Failure>> {
        let found = self.folded().get(&digest).cloned();
        if let Some(found) = found {
            return Some(found.map_err(Failure::Domain));
        }
        // One that is damaged is folded again.
        let block = (self.read)(&stored(digest)?).ok()?;
        self.keep(digest, block.clone());
        Some(Ok(block))
    }

    fn folded(&self) -> MutexGuard<'_, HashMap<u64, Result<T, String>>> {
        self.folded.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The same, folded where it is not there.
    pub fn get_or(
        &self,
        digest: u64,
        fold: impl FnOnce() -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        if let Some(found) = self.get(digest) {
            return found;
        }
        // Not locked: others go on meanwhile, and who of them folds the same keeps what was there first.
        match fold() {
            Ok(block) => {
                let found = self.room().entry(digest).or_insert(Ok(block)).clone();
                found.map_err(Failure::Domain)
            }
            Err(failure) => {
                self.room().insert(digest, Err(failure.to_string()));
                Err(failure)
            }
        }
    }

    /// Keeps what was folded from inputs with this digest.
    pub fn keep(&self, digest: u64, block: T) {
        self.room().insert(digest, Ok(block));
    }

    /// With room for one more.
    fn room(&self) -> MutexGuard<'_, HashMap<u64, Result<T, String>>> {
        let mut folded = self.folded();
        if folded.len() >= self.most {
            folded.clear();
        }
        folded
    }
}

/// The digest in a block's words, 0 of words that are no block.
pub const fn digest_of(words: &[u32]) -> u64 {
    match words {
        [_, _, _, _, low, high, ..] => (*high as u64) << 32 | *low as u64,
        _ => 0,
    }
}

/// The words of a stored block that was folded from inputs with this digest.
fn stored(digest: u64) -> Option<Vec<u32>> {
    blocks(BUILT_IN).find(|words| digest_of(words) == digest)
}

/// Whether a block that was folded from inputs with this digest comes with the program.
pub fn is_stored(digest: u64) -> bool {
    stored(digest).is_some()
}

/// The words of every block of a file, up to the first that is cut off.
fn blocks(bytes: &[u8]) -> impl Iterator<Item = Vec<u32>> {
    let mut rest = bytes;
    std::iter::from_fn(move || {
        let length = words_of(rest.get(2 * WORD..3 * WORD)?).next()? as usize;
        let (block, after) = rest.split_at_checked(WORD * length.max(HEADER))?;
        rest = after;
        Some(words_of(block).collect())
    })
}

fn words_of(bytes: &[u8]) -> impl Iterator<Item = u32> {
    let (words, _) = bytes.as_chunks();
    words.iter().copied().map(u32::from_le_bytes)
}

/// A fold of either kind.
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

    /// The words of its block, folded anew.
    fn words(&self) -> Result<Vec<u32>, Failure> {
        Ok(match self {
            Self::Caged(fold) => fold.block()?.words(self.digest())?,
            Self::Uncaged(fold) => fold.block()?.words(self.digest())?,
        })
    }
}

/// What is stored of a built-in design, each with its name: its ball in a cage, and that of its row where it has one, each with its own friction
/// coefficient and for the usual loads.
fn folds_of(design: &Design) -> Result<Vec<(String, Fold)>, Failure> {
    let named = |message: String| Failure::Domain(format!("{}: {message}", design.name));
    let own = (design.caged.friction, design.caged.friction);
    let fold = caged::fold_for(design, own).map_err(named)?;
    let mut folds = vec![(design.name.clone(), Fold::Caged(fold))];
    let Some(row) = &design.uncaged else {
        return Ok(folds);
    };
    let own = (row.gear.friction, row.gear.friction);
    let fold = uncaged::fold_for(design, row, own, 0.0).map_err(named)?;
    let name = format!("{} without cage", design.name);
    folds.push((name, Fold::Uncaged(fold)));
    Ok(folds)
}

fn stored_folds() -> Result<Vec<(String, Fold)>, Failure> {
    let mut folds = Vec::new();
    for (name, ..) in files::built_in() {
        let source: DesignSource = name.parse().map_err(Failure::Domain)?;
        folds.extend(folds_of(&source.load()?)?);
    }
    Ok(folds)
}

/// The words of all of them, folded anew, each with its name.
fn folded() -> Result<Vec<(String, Vec<u32>)>, Failure> {
    let folds = stored_folds()?;
    folds
        .into_par_iter()
        .map(|(name, fold)| Ok((name, fold.words()?)))
        .collect()
}

/// The files of both kinds of stored blocks, in the sources of this program.
fn paths() -> Result<[PathBuf; 2], Failure> {
    let refused = || {
        Failure::Domain(
            "stored blocks are files of epas-friction's sources: --store and --gate run in the checkout that this program was built from"
                .into(),
        )
    };
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let root = fs::canonicalize(root).map_err(|_| refused())?;
    let here = std::env::current_dir().and_then(fs::canonicalize);
    let inside = here.is_ok_and(|here| here.starts_with(&root));
    let paths = [path(&root), built_in::path(&root)];
    if inside && paths.iter().all(|path| path.is_file()) {
        Ok(paths)
    } else {
        Err(refused())
    }
}

/// Where the file of this program's blocks is.
fn path(root: &Path) -> PathBuf {
    root.join("bench/design/folded/built_in.bin")
}

/// Stores the blocks of the built-in designs, folded anew: those of this program and those of the crate.
pub fn store() -> Result<(), Failure> {
    let [own, the_crate] = paths()?;
    let words = folded()?.into_iter().flat_map(|(_, words)| words);
    let bytes: Vec<u8> = words.flat_map(u32::to_le_bytes).collect();
    written(&own, &bytes)?;
    written(&the_crate, &built_in::folded()?)
}

fn written(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    fs::write(path, bytes)
        .map_err(|error| Failure::Domain(format!("cannot write {}: {error}", path.display())))
}

/// How many stored blocks have the bits of a new fold.
pub fn gate() -> Result<usize, Failure> {
    let [_, the_crate] = paths()?;
    let folded = folded()?;
    let differs =
        |(_, words): &&(String, Vec<u32>)| stored(digest_of(words)).as_ref() != Some(words);
    let differing: Vec<&str> = folded
        .iter()
        .filter(differs)
        .map(|(name, _)| name.as_str())
        .collect();
    let mut differing: Vec<String> = differing.into_iter().map(String::from).collect();
    let anew = built_in::folded()?;
    if fs::read(the_crate).map_err(Failure::File)? != anew {
        differing.push("the crate's built_in.bin".into());
    }
    if differing.is_empty() {
        return Ok(folded.len() + anew.len() / (WORD * built_in::Block::WORDS));
    }
    Err(Failure::Domain(format!(
        "stored blocks are not what is folded: {}; where that is meant, raise ALGORITHM in bench/design/src and run\n  \
         cargo run --release -p epas -- design --store",
        differing.join(", ")
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every built-in design is stored, for the inputs and the algorithm of today, as a block that the crate takes; nothing else is stored.
    #[test]
    fn built_in_designs_need_no_fold() {
        let folds = stored_folds().unwrap();
        for (name, fold) in &folds {
            let words = stored(fold.digest())
                .unwrap_or_else(|| panic!("{name} is not stored: design --store"));
            match fold {
                Fold::Caged(_) => drop(caged::CagedScene::read(&words).unwrap()),
                Fold::Uncaged(_) => drop(uncaged::read(&words).unwrap()),
            }
        }
        assert_eq!(blocks(BUILT_IN).count(), folds.len());
    }

    #[test]
    fn a_stored_block_is_not_folded() {
        let source: DesignSource = "lin-4.1".parse().unwrap();
        for (name, fold) in folds_of(&source.load().unwrap()).unwrap() {
            let found: Folds<()> = Folds::new(1, |_| Ok(()));
            found
                .get_or(fold.digest(), || panic!("{name} is folded"))
                .unwrap();
        }
    }

    /// What has another digest is folded once, and a reason is kept as a block is.
    #[test]
    fn a_fold_is_made_once() {
        let folds: Folds<u32> = Folds::new(2, |_| Ok(0));
        assert_eq!(folds.get_or(1, || Ok(7)).unwrap(), 7);
        assert_eq!(folds.get_or(1, || panic!("folded twice")).unwrap(), 7);
        let refused = || Err(Failure::Domain("no".into()));
        assert_eq!(folds.get_or(2, refused).unwrap_err().to_string(), "no");
        assert_eq!(folds.get(2).unwrap().unwrap_err().to_string(), "no");
        // Full, it begins anew.
        folds.keep(3, 9);
        assert!(folds.get(1).is_none());
        assert_eq!(folds.get(3).unwrap().unwrap(), 9);
    }

    /// A file that is cut off has the blocks before the cut; a length below the header's is no endless loop.
    #[test]
    fn a_cut_file_ends_with_its_last_whole_block() {
        let count = blocks(BUILT_IN).count();
        assert_eq!(blocks(&BUILT_IN[..BUILT_IN.len() - 1]).count(), count - 1);
        assert_eq!(blocks(&[0; 50]).count(), 2);
        assert_eq!(blocks(&[0xff; 50]).count(), 0);
    }
}
