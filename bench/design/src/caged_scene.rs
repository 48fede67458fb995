//! A caged screw that runs on this machine: by a block that is folded from its design, or by a closed form.
//!
//! Folding takes half a second for one friction coefficient and two for a range of them. A block is folded once, and that of a built-in design never:
//! `folds`.

use crate::caged::{Block, NODES};
use crate::certificate::one_ball;
use crate::{CagedFold, Folded};
use epas_friction::scene::{CagedBallScrewConfiguration, ClosedFormScrewConfiguration};
use epas_friction::{Error, Inputs};
use rayon::prelude::*;

use crate::Failure;
use crate::files::Design;
use crate::folds::{Folds, digest_of};

/// Blocks that need no fold; of those that were folded 256 are kept.
static FOLDS: Folds<Block> = Folds::new(256, read);

/// Ratio of two friction coefficients that count as one, and the least ratio of the ends of a range.
const ONE: f32 = 1.001;
const APART: f32 = 1.11;

/// Error of a range between its nodes from which on it is refused, and loads of each sign at which that is looked at.
const LARGEST_ERROR: f64 = 0.03;
const LOADS: u32 = 48;

/// The block of a design, folded where it is not kept.
pub fn block(fold: &CagedFold) -> Result<Block, Failure> {
    FOLDS.get_or(fold.digest(), || {
        let block = fold.block()?;
        if let Block::Range(range) = &block {
            check_range(fold, range)?;
        }
        Ok(block)
    })
}

/// The block of a design, folded where it is not kept; a range may be far off between its nodes.
pub fn unchecked(fold: &CagedFold) -> Result<Block, Failure> {
    if let Some(Ok(block)) = FOLDS.get(fold.digest()) {
        return Ok(block);
    }
    let block = fold.block()?;
    FOLDS.keep(fold.digest(), block);
    Ok(block)
}

/// The block of a design with its certificate, whose share that is done is told to `progress`; kept as any other block.
pub fn certified(fold: &CagedFold, progress: &(dyn Fn(f64) + Sync)) -> Result<Folded, Failure> {
    let folded = fold.folded_with(progress)?;
    FOLDS.keep(folded.digest, folded.block);
    Ok(folded)
}

/// Refuses a design whose block is too far from the exact ball; one that is kept is not measured again.
pub fn check_errors(fold: &CagedFold, progress: &(dyn Fn(f64) + Sync)) -> Result<(), Failure> {
    match FOLDS.get(fold.digest()) {
        Some(kept) => kept.map(drop),
        None => certified(fold, progress).map(drop),
    }
}

fn read(words: &[u32]) -> Result<Block, Error> {
    const RANGE: u32 = NODES as u32;
    match words.get(3) {
        Some(&RANGE) => Ok(Block::Range(CagedBallScrewConfiguration::read(words)?)),
        _ => Ok(Block::One(CagedBallScrewConfiguration::read(words)?)),
    }
}

/// Refuses a range that is far from the exact ball midway between two of its nodes.
fn check_range(
    fold: &CagedFold,
    block: &CagedBallScrewConfiguration<NODES>,
) -> Result<(), Failure> {
    let gear = &fold.gear;
    let [least, most] = fold.axial_load.map(f64::from);
    let middles = block.law.nodes.windows(2).filter_map(|pair| match pair {
        [low, high] => Some((low.friction * high.friction).sqrt()),
        _ => None,
    });
    let asked: Vec<(f32, f64)> = middles
        .flat_map(|friction| [(friction, 1.0), (friction, -1.0)])
        .collect();
    let worst = asked
        .par_iter()
        .map(|&(friction, side)| {
            let ball = gear.exact_ball(friction);
            let load = |step: u32| most * (least / most).powf(f64::from(step) / f64::from(LOADS));
            let loads: Vec<f64> = (0..=LOADS).map(|step| side * load(step)).collect();
            let mut model = one_ball(block, friction)?;
            let found = ball.along(&loads)?.into_iter().flatten().map(|exact| {
                let inputs = Inputs {
                    nut_speed: 1.0,
                    axial_load: exact.axial_load as f32,
                };
                let error = f64::from(model.step(inputs).friction_torque) / exact.torque - 1.0;
                (error.abs(), exact.axial_load.abs(), friction)
            });
            Ok(found.fold(
                (0.0, 0.0, 0.0),
                |worst, one| if one.0 > worst.0 { one } else { worst },
            ))
        })
        .collect::<Result<Vec<_>, Failure>>()?;
    let worst = worst
        .into_iter()
        .max_by(|one, other| one.0.total_cmp(&other.0));
    match worst {
        Some((error, load, friction)) if error > LARGEST_ERROR => {
            let (low, high) = block.law.friction_range();
            Err(Failure::Domain(format!(
                "friction coefficients from {low} to {high} cannot be folded into one block: its torque is {:.1} % off at {load:.1} N a ball, \
                 friction coefficient {friction:.4}; narrow the range, or the loads (axial_load in the table [fold])",
                100.0 * error
            )))
        }
        _ => Ok(()),
    }
}

/// What runs of a caged screw.
#[expect(
    clippy::large_enum_variant,
    reason = "a host has room, and a program has few of them"
)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CagedScene {
    /// A folded block.
    Folded(Block),
    /// A closed form.
    ClosedForm(ClosedFormScrewConfiguration),
}

impl CagedScene {
    /// That of a design with its own friction coefficient, as its table `[fold]` says it.
    pub fn of(design: &Design) -> Result<Self, Failure> {
        let friction = design.caged.friction;
        Self::with_coefficients(design, (friction, friction))
    }

    /// That of a design for friction coefficients between two.
    pub fn with_coefficients(design: &Design, coefficients: (f32, f32)) -> Result<Self, Failure> {
        let named = |message: String| Failure::Domain(format!("{}: {message}", design.name));
        if let Some(closed) = design.closed_form() {
            return Ok(Self::ClosedForm(closed));
        }
        let fold = fold_for(design, coefficients).map_err(named)?;
        match block(&fold) {
            Ok(block) => Ok(Self::Folded(block)),
            Err(failure) => Err(failure.of(&design.name)),
        }
    }

    /// That of a block's words.
    pub fn read(words: &[u32]) -> Result<Self, Error> {
        read(words).map(Self::Folded)
    }
}

/// The words of a design's block for friction coefficients between two, with the digest of their inputs; none of a closed form.
pub fn words(design: &Design, coefficients: (f32, f32)) -> Result<Option<Vec<u32>>, Failure> {
    if design.branch.is_some() {
        return Ok(None);
    }
    let fold = fold_for(design, coefficients).map_err(Failure::Domain)?;
    Ok(Some(block(&fold)?.words(fold.digest())?))
}

/// Keeps the block of these words: what was folded from the same inputs is not folded again.
pub fn keep_words(words: &[u32]) -> Result<(), Error> {
    FOLDS.keep(digest_of(words), read(words)?);
    Ok(())
}

/// What is folded of a design for friction coefficients between two.
pub fn fold_for(design: &Design, coefficients: (f32, f32)) -> Result<CagedFold, String> {
    let mut fold = design
        .fold
        .fold(design)
        .map_err(|message| format!("fold: {message}"))?;
    fold.gear.friction = design.caged.friction;
    fold.friction = range_for(fold.friction, fold.gear.friction, coefficients)?;
    Ok(fold)
}

/// The range of friction coefficients that is folded for those between two: a table's, where it says one. It holds the design's own one too, which
/// a law that comes to it at rest misses by the rounding of its sum.
pub(crate) fn range_for(
    range: Option<[f32; 2]>,
    own: f32,
    (least, largest): (f32, f32),
) -> Result<Option<[f32; 2]>, String> {
    match range {
        Some([low, high]) if least * ONE < low || largest > high * ONE => Err(format!(
            "fold: the friction coefficient runs from {least} to {largest}, and friction = [{low}, {high}] does not hold that; widen it"
        )),
        None if largest > least * ONE => {
            let (least, largest) = (least.min(own), largest.max(own));
            // What is folded for a law is at least a tenth wide.
            let wider = (APART * least / largest).max(1.0).sqrt();
            Ok(Some([least / wider, (largest * wider).min(0.5)]))
        }
        range => Ok(range),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::read;

    const DESIGN: &str = "nominal_diameter = 0.029\nlead = 0.007\nball_diameter = 4e-3\nconformity = 0.54\n\
                          contact_angle = 0.7853982\nloaded_balls = 71\n";

    fn design(more: &str) -> Design {
        read(&format!("{DESIGN}{more}"), "gear").unwrap()
    }

    /// One coefficient is folded alone; a law's range at least a tenth wide, or the table's where that holds it.
    #[test]
    fn a_fold_holds_what_is_asked_for() {
        let plain = design("");
        assert_eq!(fold_for(&plain, (0.1, 0.1)).unwrap().friction, None);
        assert_eq!(
            fold_for(&plain, (0.06, 0.12)).unwrap().friction,
            Some([0.06, 0.12])
        );
        let Some([least, largest]) = fold_for(&plain, (0.099, 0.101)).unwrap().friction else {
            panic!("a range has two ends");
        };
        assert!(least < 0.099 && largest > 0.101 && largest > 1.1 * least);
        let table = design("[fold]\nfriction = [0.05, 0.15]\naxial_load = [5, 400]\n");
        let fold = fold_for(&table, (0.06, 0.12)).unwrap();
        assert_eq!(fold.friction, Some([0.05, 0.15]));
        assert_eq!(fold.axial_load, [5.0, 400.0]);
        let refused = fold_for(&table, (0.04, 0.12)).unwrap_err();
        assert!(
            refused.contains("0.04") && refused.contains("widen"),
            "{refused}"
        );
    }

    /// A law that comes to the design's own coefficient by a sum is held, whatever its ratio: 0.05 + (0.12 - 0.05) is below 0.12.
    #[test]
    fn a_law_of_the_own_coefficient_is_held() {
        use epas_friction::law::coefficient::{CoefficientLaw, CoefficientParameters};
        let mut rounded = 0;
        for friction in [0.05_f32, 0.075, 0.1, 0.12, 0.13, 0.15] {
            let design = design(&format!("friction = {friction}\n"));
            for parts in 20..200 {
                let law = CoefficientParameters {
                    boundary: friction,
                    full_film: (f64::from(friction) * f64::from(parts) / 120.0) as f32,
                    ..epas_friction::defaults::COEFFICIENT
                };
                let ends = CoefficientLaw::new(&law).unwrap().extremes();
                rounded += usize::from(!(ends.0..=ends.1).contains(&friction));
                let fold = fold_for(&design, ends).unwrap();
                assert!(fold.check().is_ok(), "{friction} {parts}: {ends:?}");
            }
        }
        assert!(rounded > 10, "{rounded} laws end beside the coefficient");
    }

    /// Words are the block, and a block that is kept is not folded again.
    #[test]
    fn words_are_the_block() {
        let design = design("");
        let own = (design.caged.friction, design.caged.friction);
        let words = words(&design, own).unwrap().unwrap();
        assert_eq!(
            CagedScene::read(&words).unwrap(),
            CagedScene::of(&design).unwrap()
        );
        keep_words(&words).unwrap();
        let mut other = words.clone();
        *other.last_mut().unwrap() ^= 1;
        assert_eq!(keep_words(&other).unwrap_err().field(), "checksum");
    }

    /// With play contacts open at loads that move with the coefficient: one block does not hold a factor of three.
    #[test]
    fn a_range_that_is_far_off_is_refused() {
        let refused = CagedScene::with_coefficients(&design("clearance = 1e-5\n"), (0.05, 0.15));
        let Err(Failure::Domain(message)) = refused else {
            panic!("{refused:?}");
        };
        assert!(
            message.contains("narrow the range") && message.contains("N a ball"),
            "{message}"
        );
    }

    #[test]
    fn a_closed_form_is_not_folded() {
        let design = design("branch = \"sliding\"\n");
        assert_eq!(words(&design, (0.1, 0.1)).unwrap(), None);
        let scene = CagedScene::of(&design).unwrap();
        assert!(matches!(scene, CagedScene::ClosedForm(_)));
    }
}
