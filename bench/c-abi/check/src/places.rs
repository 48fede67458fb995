//! The places that the header gives to the models are as large as they have to be.

use epas_friction::scene::Scene;
use epas_friction::{CagedBallScrew, FrictionModel, LinearBearingTrain, UncagedBallScrew};

use crate::Outcome;

/// As the library keeps a model.
#[repr(C)]
struct Placed<S: Scene> {
    mark: u32,
    model: FrictionModel<S>,
}

/// Words of eight bytes where pointers have eight bytes too.
const fn words<S: Scene>() -> usize {
    size_of::<Placed<S>>().div_ceil(8)
}

/// Says which constant of `types.rs` has to be another; the library's build says only that one has to.
pub fn check(header: &str) -> Outcome<()> {
    let balls = |name| defined(header, name);
    if balls("EPAS_SCREW_BALLS") != Some(37) || balls("EPAS_LINEAR_BALLS") != Some(32) {
        // Not the numbers of the stored cases: the library's build alone can tell.
        return Ok(());
    }
    for (name, words) in [
        ("EPAS_CAGED_WORDS", words::<CagedBallScrew>()),
        ("EPAS_SCREW_WORDS", words::<UncagedBallScrew<37>>()),
        ("EPAS_LINEAR_WORDS", words::<LinearBearingTrain<32>>()),
    ] {
        if defined(header, name) != Some(words) {
            return Err(format!("{name} in src/types.rs has to be {words}").into());
        }
    }
    Ok(())
}

/// A number that the header defines.
fn defined(header: &str, name: &str) -> Option<usize> {
    header
        .lines()
        .find_map(|line| line.strip_prefix("#define ")?.strip_prefix(name))?
        .trim()
        .parse()
        .ok()
}
