//! Table `[fold]` of a design file: the domain over which `design` folds it.

use epas_design::CagedFold;
use serde::Deserialize;

use super::Design;

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

impl FoldTable {
    /// Refuses deviations, which a caged screw's balls do not feel: whoever asks for a block of them means another one.
    ///
    /// # Errors
    /// The key that stands there.
    pub fn check_deviations(&self) -> Result<(), String> {
        for (key, there) in [
            ("screw_deviation", self.screw_deviation.is_some()),
            ("nut_deviation", self.nut_deviation.is_some()),
        ] {
            if there {
                return Err(format!(
                    "{key} belongs to the law of balls that press on each other, which is not folded yet: without it the design is folded \
                     with a cage"
                ));
            }
        }
        Ok(())
    }

    /// The design with the domain of this table.
    ///
    /// # Errors
    /// What of it cannot be folded.
    pub fn fold(&self, design: &Design) -> Result<CagedFold, String> {
        if design.branch.is_some() {
            return Err("a closed form (branch = \"rolling\" or \"sliding\") needs no fold".into());
        }
        let mut fold = CagedFold::of(design.caged);
        match self.friction {
            None => {}
            Some(Friction::One(friction)) => fold.gear.friction = friction,
            Some(Friction::Range([least, most])) => {
                let friction = fold.gear.friction;
                if least < most && !(least..=most).contains(&friction) {
                    return Err(format!(
                        "the design's friction = {friction}{} is not within friction = [{least}, {most}]",
                        design.mark("friction")
                    ));
                }
                fold.friction = Some([least, most]);
            }
        }
        fold.axial_load = self.axial_load.unwrap_or(fold.axial_load);
        fold.seed = self.seed.map_or(fold.seed, u64::from);
        Ok(fold)
    }
}
