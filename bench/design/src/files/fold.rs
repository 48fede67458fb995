//! Table `[fold]` of a design file: the domain over which `design` folds it.

use crate::{CagedDesign, CagedFold, Failure, UncagedFold};
use epas_friction::Range;
use serde::Deserialize;

use super::Design;
use super::train::UncagedDesign;

/// Largest deviations that a law is folded for, rad.
const DEVIATION: Range = Range::new(1e-4, 0.1);

/// Table `[fold]` of a design file.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FoldTable {
    friction: Option<Friction>,
    axial_load: Option<Loads>,
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

/// Least and largest load of a ball, N.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(
    untagged,
    expecting = "expected the least and the largest load of one ball, N, such as axial_load = [5, 300]; a ball's load is the screw's over \
                 the number of loaded balls"
)]
enum Loads {
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

    /// Refuses a domain that no fold of the design can have, before anything is solved.
    pub fn check(&self, design: &Design) -> Result<(), String> {
        let said = |failure: Failure| failure.to_string();
        if let Some(Loads::Range([least, most])) = self.axial_load
            && least >= most
        {
            return Err(format!(
                "axial_load = [{least}, {most}] is [least, largest] of one ball, N: the largest is at least 1.1 times the least; \
                 allowed: 0.01 to 100000"
            ));
        }
        if design.branch.is_none() {
            self.fold(design)?.check().map_err(said)?;
        }
        match &design.uncaged {
            Some(row) => self.fold_uncaged(design, Some(row))?.check().map_err(said),
            None => Ok(()),
        }
    }

    /// Least and largest load of a ball that it says, N.
    fn loads(&self) -> Option<[f32; 2]> {
        self.axial_load.map(|Loads::Range(loads)| loads)
    }

    /// Whether it says for which loads of a ball a design is folded.
    pub const fn says_axial_load(&self) -> bool {
        self.axial_load.is_some()
    }

    /// Whether it says for which friction coefficients a design is folded.
    pub const fn says_friction(&self) -> bool {
        self.friction.is_some()
    }

    /// Whether it says for which deviations a design is folded: of balls that press on each other.
    pub const fn says_deviations(&self) -> bool {
        self.screw_deviation.is_some() || self.nut_deviation.is_some()
    }

    /// A caged design with the domain of this table.
    pub fn fold(&self, design: &Design) -> Result<CagedFold, String> {
        if design.branch.is_some() {
            return Err("a closed form (branch = \"rolling\" or \"sliding\") needs no fold".into());
        }
        let mut fold = CagedFold::of(design.caged);
        let domain = self.domain(fold.gear.friction, design.mark("friction"))?;
        fold.gear.friction = domain.friction;
        fold.friction = domain.range;
        fold.axial_load = self.loads().unwrap_or(fold.axial_load);
        fold.seed = self.seed.map_or(fold.seed, u64::from);
        Ok(fold)
    }

    /// A design without cage with the domain of this table: deviations of a groove are this table's, or those of its map, at least the least that
    /// a law is folded for. Its balls are those of `row`, or where it has none those of the design.
    pub fn fold_uncaged(
        &self,
        design: &Design,
        row: Option<&UncagedDesign>,
    ) -> Result<UncagedFold, String> {
        let gear = row.map_or(design.caged, |row| row.gear);
        let of_maps = row.map_or([0.0; 2], UncagedDesign::deviations);
        let deviation = |name: &str, given: Option<f32>, of_map: f32| match given {
            None => Ok(of_map.max(DEVIATION.minimum)),
            Some(given) if DEVIATION.contains(given) && given >= of_map => Ok(given),
            Some(given) => Err(format!(
                "{name} = {given} is out of range; allowed: {} to {}",
                of_map.max(DEVIATION.minimum),
                DEVIATION.maximum
            )),
        };
        let [screw, nut] = of_maps;
        let deviations = [
            deviation("screw_deviation", self.screw_deviation, screw)?,
            deviation("nut_deviation", self.nut_deviation, nut)?,
        ];
        let domain = self.domain(gear.friction, design.mark("friction"))?;
        let mut fold = UncagedFold::of(crate::UncagedDesign {
            gear: CagedDesign {
                friction: domain.friction,
                // The law is that of one ball.
                loaded_balls: 1,
                ..gear
            },
            deviations,
        });
        fold.friction = domain.range;
        fold.ball_friction = row.map_or(fold.ball_friction, |row| row.ball_friction);
        fold.axial_load = self.loads().unwrap_or(fold.axial_load);
        fold.seed = self.seed.map_or(fold.seed, u64::from);
        Ok(fold)
    }
}
