//! A screw without cage that runs on this machine: the law of one ball, folded from its design.
//!
//! Folding takes some seconds. A law is folded once, and that of a built-in design never: `folds`. It is kept as long as the program
//! runs, because models refer to it: five kilobytes for one friction coefficient, fifteen for a range.

pub use crate::uncaged::Folded;
use crate::uncaged::{NODES, UncagedBlock};
use crate::{FoldedUncaged, UncagedFold};
use epas_friction::Error;
use epas_friction::scene::{FoldedBall, UncagedBallScrewConfiguration};
use epas_friction::{DeviationMap, LoadShares};

use crate::Failure;
use crate::caged_scene::range_for;
use crate::files::Design;
use crate::files::train::UncagedDesign;
use crate::folds::{Folds, digest_of};

/// What is set for a screw beside what a host has folded of its ball: see [`UncagedBallScrewConfiguration`].
#[derive(Clone, Copy, Debug)]
pub struct ScrewConfiguration {
    /// What a host has folded.
    pub folded: Folded,
    /// Friction coefficient of ball and ball.
    pub ball_friction: f32,
    /// Balls in the circuit, 1 to 64.
    pub balls: u16,
    /// Turns of the loaded track.
    pub turns: f32,
    /// Length of the return, m.
    pub return_length: f32,
    /// Deviation along the screw's groove.
    pub screw_deviation: &'static DeviationMap,
    /// Deviation along the nut's groove.
    pub nut_deviation: &'static DeviationMap,
    /// Loads of the balls over their mean.
    pub load_shares: LoadShares,
    /// Time between two ticks, s.
    pub tick: f32,
}

impl ScrewConfiguration {
    /// The scene's configuration, with one of the blocks.
    #[must_use]
    pub const fn with<const N: usize>(
        &self,
        folded: &'static FoldedBall<N>,
    ) -> UncagedBallScrewConfiguration<N> {
        UncagedBallScrewConfiguration {
            folded,
            ball_friction: self.ball_friction,
            balls: self.balls,
            turns: self.turns,
            return_length: self.return_length,
            screw_deviation: self.screw_deviation,
            nut_deviation: self.nut_deviation,
            load_shares: self.load_shares,
            tick: self.tick,
        }
    }
}

static FOLDS: Folds<Folded> = Folds::new(usize::MAX, |words| Ok(leaked(&block_of(words)?)));

/// By how much the loads that are folded for pass the largest one that is asked for, at least: a model counts loaded balls by their places.
pub const MARGIN: f32 = 1.1;

/// Least deviation that a law is folded for where a groove has none, rad.
pub const LEAST_DEVIATION: f32 = 1e-4;

/// Largest axial load of a ball that can be folded for, N.
const LARGEST_LOAD: f32 = 1e5;

/// Least and largest load of a ball, N, that a law is folded for which has to hold loads between two: to the next powers of two where these are
/// beyond, so that requests that are much alike share a law.
pub fn loads_holding([least, most]: [f32; 2], [from, to]: [f32; 2]) -> [f32; 2] {
    let below = |load: f32| load.log2().floor().exp2();
    let above = |load: f32| load.log2().ceil().exp2();
    [
        if from < least { below(from) } else { least },
        if to > most { above(to) } else { most },
    ]
}

/// The law of a fold, folded where it is not kept.
pub fn folded(fold: &UncagedFold) -> Result<Folded, Failure> {
    FOLDS.get_or(fold.digest(), || Ok(leaked(&fold.block()?)))
}

/// The law of a fold with its certificate, whose share that is done is told to `progress`; kept as any other law.
pub fn certified(
    fold: &UncagedFold,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<FoldedUncaged, Failure> {
    let folded = fold.folded_with(progress)?;
    keep(folded.digest, &folded.block);
    Ok(folded)
}

/// Keeps a law that was folded from inputs with this digest: one that is there already stays where it is.
fn keep(digest: u64, block: &UncagedBlock) -> Folded {
    let same = |kept: &Folded| match (kept, block) {
        (Folded::One(kept), UncagedBlock::One(block)) => *kept == block,
        (Folded::Range(kept), UncagedBlock::Range(block)) => *kept == block,
        _ => false,
    };
    let law = match FOLDS.get(digest) {
        Some(Ok(kept)) if same(&kept) => kept,
        _ => leaked(block),
    };
    FOLDS.keep(digest, law);
    law
}

fn leaked(block: &UncagedBlock) -> Folded {
    match block {
        UncagedBlock::One(block) => Folded::One(Box::leak(Box::new(*block))),
        UncagedBlock::Range(block) => Folded::Range(Box::leak(Box::new(*block))),
    }
}

fn block_of(words: &[u32]) -> Result<UncagedBlock, Error> {
    const RANGE: u32 = NODES as u32;
    Ok(match words.get(3) {
        Some(&RANGE) => UncagedBlock::Range(FoldedBall::read(words)?),
        _ => UncagedBlock::One(FoldedBall::read(words)?),
    })
}

/// The law of a block's words, kept by the digest that they hold.
pub fn read(words: &[u32]) -> Result<Folded, Error> {
    Ok(keep(digest_of(words), &block_of(words)?))
}

/// The words of a design's block for its own friction coefficient, with the digest of its inputs.
pub fn words(design: &Design, row: &UncagedDesign) -> Result<Vec<u32>, Failure> {
    let friction = row.gear.friction;
    let fold = fold_for(design, row, (friction, friction), 0.0).map_err(Failure::Domain)?;
    let block = match folded(&fold)? {
        Folded::One(block) => UncagedBlock::One(*block),
        Folded::Range(block) => UncagedBlock::Range(*block),
    };
    block.words(fold.digest())
}

/// What is folded of a design for friction coefficients between two. Loads of a ball are those of the table `[fold]`, or 5 to 300 N, and up
/// to the next power of two where an axial load, N, needs more: so that traces that are much alike share a law.
pub fn fold_for(
    design: &Design,
    row: &UncagedDesign,
    coefficients: (f32, f32),
    axial_load: f32,
) -> Result<UncagedFold, String> {
    row.check_room()?;
    let table = &design.fold;
    let mut fold = table
        .fold_uncaged(design, Some(row))
        .map_err(|message| format!("fold: {message}"))?;
    fold.gear.gear.friction = row.gear.friction;
    fold.friction = range_for(fold.friction, row.gear.friction, coefficients)?;
    let load = MARGIN * row.ball_load(axial_load.abs().min(row.gear.limits.axial_load));
    if !table.says_axial_load() {
        let [least, _] = fold.axial_load;
        let held = loads_holding(fold.axial_load, [least, load]);
        fold.axial_load = held.map(|load| load.min(LARGEST_LOAD));
    }
    Ok(fold)
}

/// What a model of a design is made of, for friction coefficients between two and up to an axial load, N; its tick is a millisecond.
pub fn configuration(
    design: &Design,
    row: &UncagedDesign,
    coefficients: (f32, f32),
    axial_load: f32,
) -> Result<ScrewConfiguration, Failure> {
    let named = |message: String| Failure::Domain(format!("{}: {message}", design.name));
    let fold = fold_for(design, row, coefficients, axial_load).map_err(named)?;
    let folded = folded(&fold).map_err(|failure| failure.of(&design.name))?;
    Ok(configuration_with(row, folded))
}

/// The same with a law that was folded before.
pub const fn configuration_with(row: &UncagedDesign, folded: Folded) -> ScrewConfiguration {
    ScrewConfiguration {
        folded,
        ball_friction: row.ball_friction,
        balls: row.balls as u16,
        turns: row.turns,
        return_length: row.return_length,
        screw_deviation: row.screw_deviation,
        nut_deviation: row.nut_deviation,
        load_shares: row.load_shares,
        tick: 1e-3,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::read as read_design;
    use epas_friction::{FrictionModel, UncagedBallScrew};

    /// 29 x 7 x 4 with 16 balls, on half a turn.
    fn design(more: &str) -> Design {
        taken_or_refused(more).unwrap()
    }

    fn taken_or_refused(more: &str) -> Result<Design, String> {
        let text = "nominal_diameter = 0.029\nlead = 0.007\nball_diameter = 4e-3\nconformity = 0.54\ncontact_angle = 0.7853982\nclearance = 0\n";
        let row =
            "[uncaged]\nballs = 16\nturns = 0.75\nscrew_deviation = [{ order = 2, sine = 0.01 }]\n";
        read_design(&format!("{text}{more}{row}"), "gear")
    }

    fn fold(design: &Design, axial_load: f32) -> UncagedFold {
        let row = design.uncaged.unwrap();
        let own = (row.gear.friction, row.gear.friction);
        fold_for(design, &row, own, axial_load).unwrap()
    }

    /// Loads are those of the table, or up to the power of two above the largest of a ball; deviations are the maps'.
    #[test]
    fn a_fold_holds_what_is_asked_for() {
        let plain = design("");
        let usual = fold(&plain, 4_000.0);
        assert_eq!(usual.axial_load, [5.0, 300.0]);
        assert_eq!(usual.friction, None);
        let [screw, nut] = usual.gear.deviations;
        assert!((screw - 0.01).abs() < 1e-4 && nut == 1e-4, "{screw} {nut}");
        // 16 balls under 5 kN each, and under no more than the limit of 100 kN.
        assert_eq!(fold(&plain, 8e4).axial_load, [5.0, 8192.0]);
        assert_eq!(fold(&plain, 1e7), fold(&plain, 1e5));
        let table = design("[fold]\naxial_load = [20, 100]\nscrew_deviation = 0.02\n");
        let own = fold(&table, 8e4);
        assert_eq!(own.axial_load, [20.0, 100.0]);
        assert_eq!(own.gear.deviations, [0.02, 1e-4]);
        let refused = taken_or_refused("[fold]\nscrew_deviation = 0.005\n").unwrap_err();
        assert!(refused.contains("screw_deviation = 0.005"), "{refused}");
    }

    /// Loads within the domain leave it as it is; others widen it to powers of two.
    #[test]
    fn loads_are_held_by_powers_of_two() {
        let usual = [5.0, 300.0];
        assert_eq!(loads_holding(usual, [5.0, 300.0]), usual);
        assert_eq!(loads_holding(usual, [4.9, 301.0]), [4.0, 512.0]);
        assert_eq!(loads_holding(usual, [2.0, 512.0]), [2.0, 512.0]);
    }

    /// A design that is not folded is not tried again, and its reason stays the same.
    #[test]
    fn a_reason_is_kept() {
        let mut wrong = fold(&design(""), 0.0);
        wrong.gear.deviations = [0.2, 1e-4];
        let refused = folded(&wrong).unwrap_err();
        assert!(
            refused.to_string().starts_with("deviations"),
            "{}",
            refused.to_string()
        );
        let kept = FOLDS.get(wrong.digest()).unwrap().unwrap_err();
        assert_eq!(kept.to_string(), refused.to_string());
    }

    /// Words are the law, one that is kept is not folded again, and a model goes on with it.
    #[test]
    fn words_are_the_law() {
        let design = design("[fold]\naxial_load = [20, 30]\n");
        let row = design.uncaged.unwrap();
        let words = words(&design, &row).unwrap();
        let (Folded::One(law), Folded::One(again)) =
            (read(&words).unwrap(), folded(&fold(&design, 0.0)).unwrap())
        else {
            panic!("one friction coefficient is one node");
        };
        assert!(std::ptr::eq(law, again));
        // In a millisecond balls would travel too far at the limit of the nut's speed.
        let made = ScrewConfiguration {
            tick: 1e-4,
            ..configuration_with(&row, Folded::One(law))
        };
        let mut model = FrictionModel::<UncagedBallScrew<16>>::new(&made.with(law)).unwrap();
        let found = model.step(epas_friction::Inputs {
            nut_speed: 10.0,
            axial_load: 400.0,
        });
        assert!(
            found.friction_torque > 0.0 && !found.faults.any(),
            "{found:?}"
        );
        assert!(read(&words[1..]).is_err());
    }
}
