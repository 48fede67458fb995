//! Table `[fold]` of a design file: the domain over which `design` folds it.

use epas_design::{CagedDesign, CagedFold, UncagedFold};
use serde::Deserialize;

use super::Design;
use super::train::UncagedDesign;

/// Least deviation that a law is folded for, rad.
const LEAST_DEVIATION: f32 = 1e-4;

/// Table `[fold]` of a design file.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FoldTable {
    friction: Option<Friction>,
    axial_load: Option<[f32; 2]>,
    screw_deviation: Option<f32>,
    nut_deviation: Option<f32>,
    seed: Option<u32>,
}

/// One friction coefficient, or the least and the largest one.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(untagged, expecting = "a number or [least, most]")]
enum Friction {
    One(f32),
    Range([f32; 2]),
}

/// What a table says of a domain, beside a design's own friction coefficient.
struct Domain {
    friction: f32,
    range: Option<[f32; 2]>,
}

impl FoldTable {
    /// The domain of a design with a friction coefficient, which its file leaves to the default where `mark` says so.
    fn domain(&self, own: f32, mark: &str) -> Result<Domain, String> {
        match self.friction {
            None => Ok(Domain {
                friction: own,
                range: None,
            }),
            Some(Friction::One(friction)) => Ok(Domain {
                friction,
                range: None,
            }),
            Some(Friction::Range([least, most])) => {
                if least < most && !(least..=most).contains(&own) {
                    return Err(format!(
                        "the design's friction = {own}{mark} is not within friction = [{least}, {most}]"
                    ));
                }
                Ok(Domain {
                    friction: own,
                    range: Some([least, most]),
                })
            }
        }
    }

    /// Whether it says for which loads of a ball a design is folded.
    pub const fn says_axial_load(&self) -> bool {
        self.axial_load.is_some()
    }

    /// Whether it says for which deviations a design is folded: of balls that press on each other.
    pub const fn says_deviations(&self) -> bool {
        self.screw_deviation.is_some() || self.nut_deviation.is_some()
    }

    /// A caged design with the domain of this table.
    ///
    /// # Errors
    /// What of it cannot be folded.
    pub fn fold(&self, design: &Design) -> Result<CagedFold, String> {
        if design.branch.is_some() {
            return Err("a closed form (branch = \"rolling\" or \"sliding\") needs no fold".into());
        }
        let mut fold = CagedFold::of(design.caged);
        let domain = self.domain(fold.gear.friction, design.mark("friction"))?;
        fold.gear.friction = domain.friction;
        fold.friction = domain.range;
        fold.axial_load = self.axial_load.unwrap_or(fold.axial_load);
        fold.seed = self.seed.map_or(fold.seed, u64::from);
        Ok(fold)
    }

    /// A design without cage with the domain of this table: deviations of a groove are its map's, or this table's where it says them.
    ///
    /// # Errors
    /// What of it cannot be folded.
    pub fn fold_uncaged(
        &self,
        design: &Design,
        row: &UncagedDesign,
    ) -> Result<UncagedFold, String> {
        // Deviations of a map that has none count as the least that a law is folded for.
        let mut deviations = row.deviations().map(|largest| largest.max(LEAST_DEVIATION));
        for (deviation, (name, given)) in deviations.iter_mut().zip([
            ("screw_deviation", self.screw_deviation),
            ("nut_deviation", self.nut_deviation),
        ]) {
            match given {
                Some(given) if given < *deviation && *deviation > LEAST_DEVIATION => {
                    return Err(format!(
                        "{name} = {given} is below the largest of the map of [uncaged], {deviation}"
                    ));
                }
                given => *deviation = given.unwrap_or(*deviation),
            }
        }
        let domain = self.domain(row.gear.friction, design.mark("friction"))?;
        let mut fold = UncagedFold::of(epas_design::UncagedDesign {
            gear: CagedDesign {
                friction: domain.friction,
                // The law is that of one ball.
                loaded_balls: 1,
                ..row.gear
            },
            deviations,
        });
        fold.friction = domain.range;
        fold.axial_load = self.axial_load.unwrap_or(fold.axial_load);
        fold.seed = self.seed.map_or(fold.seed, u64::from);
        Ok(fold)
    }
}
