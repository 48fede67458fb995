//! The places that the header gives to the models are as large as they have to be.

use std::fs;
use std::path::Path;

use epas_friction::adaptation::Adaptation;
use epas_friction::scene::{CagedBallScrew, FoldedBall, Scene};
use epas_friction::{
    ClosedFormScrew, DeviationMap, FrictionModel, LinearBearingTrain, LoadShare, UncagedBallScrew,
};

use crate::setups::{BALL_NODES, MOST_BALLS, NODES, Remembering};
use crate::tools::Outcome;

/// As the library keeps a model.
#[repr(C)]
struct Placed<S: Scene> {
    mark: u32,
    model: FrictionModel<S>,
}

/// The page that tells the sizes.
const README: &str = "README.md";

/// Words of eight bytes where pointers have eight bytes too.
const fn words<S: Scene>() -> usize {
    size_of::<Placed<S>>().div_ceil(8)
}

/// The constants of `types.rs` with what they have to be, and the README's line of each.
fn needed() -> [(&'static str, &'static str, usize); 8] {
    [
        (
            "EPAS_CAGED_WORDS",
            "`epas_caged_t`",
            words::<CagedBallScrew>(),
        ),
        (
            "EPAS_CAGED_RANGE_WORDS",
            "`epas_caged_range_t`",
            words::<CagedBallScrew<NODES>>(),
        ),
        (
            "EPAS_CLOSED_FORM_WORDS",
            "`epas_closed_form_t`",
            words::<ClosedFormScrew>(),
        ),
        (
            "EPAS_MEMORY_WORDS",
            "`epas_memory_t`",
            words::<Remembering>(),
        ),
        (
            "EPAS_SCREW_WORDS",
            "`epas_screw_t` (up to 64 balls)",
            words::<UncagedBallScrew<MOST_BALLS>>(),
        ),
        (
            "EPAS_SCREW_RANGE_WORDS",
            "`epas_screw_range_t` (up to 64 balls)",
            words::<UncagedBallScrew<MOST_BALLS, BALL_NODES>>(),
        ),
        (
            "EPAS_LINEAR_WORDS",
            "`epas_linear_t` (up to 64 balls)",
            words::<LinearBearingTrain<MOST_BALLS>>(),
        ),
        (
            "EPAS_ADAPTATION_WORDS",
            "`epas_adaptation_t`",
            size_of::<(u32, Adaptation)>().div_ceil(8),
        ),
    ]
}

/// The tables that models share, by the README's line of each, and their bytes.
const TABLES: [(&str, usize); 4] = [
    // A mark before the table.
    (
        "`epas_folded_ball_t` | ",
        size_of::<u32>() + size_of::<FoldedBall<1>>(),
    ),
    (
        "`epas_folded_ball_range_t` | ",
        size_of::<u32>() + size_of::<FoldedBall<BALL_NODES>>(),
    ),
    (
        "`epas_deviation_t` | ",
        size_of::<u32>() + size_of::<DeviationMap>(),
    ),
    ("`epas_load_share_t` | ", size_of::<LoadShare>()),
];

/// Sees that the constants are what they have to be, or writes them.
pub fn check(root: &Path, write: bool) -> Outcome<()> {
    let file = root.join("src/types.rs");
    let mut types = fs::read_to_string(&file)?;
    if defined(&types, "EPAS_MOST_BALLS") != Some(MOST_BALLS) {
        // Another number: the library's build alone can tell.
        return Ok(());
    }
    for (name, object, words) in needed() {
        let found = defined(&types, name).ok_or_else(|| format!("src/types.rs: no {name}"))?;
        if found != words {
            if !write {
                return Err(format!("{name} in src/types.rs has to be {words}").into());
            }
            types = types.replace(
                &format!("{name}: usize = {found};"),
                &format!("{name}: usize = {words};"),
            );
            fs::write(&file, &types)?;
            println!("wrote {name} in src/types.rs");
        }
        says(
            root,
            README,
            &format!("| {object} | {} |", with_comma(8 * words)),
        )?;
    }
    for (line, bytes) in TABLES {
        says(root, README, &format!("| {line}{} ", with_comma(bytes)))?;
    }
    Ok(())
}

/// Sees that a page says this.
pub fn says(root: &Path, page: &str, line: &str) -> Outcome<()> {
    if fs::read_to_string(root.join(page))?.contains(line) {
        Ok(())
    } else {
        Err(format!("{page} has to say {line}").into())
    }
}

fn defined(types: &str, name: &str) -> Option<usize> {
    let start = format!("pub const {name}: usize = ");
    types
        .lines()
        .find_map(|line| line.strip_prefix(&start)?.strip_suffix(';'))?
        .parse()
        .ok()
}

pub fn with_comma(number: usize) -> String {
    if number < 1000 {
        number.to_string()
    } else {
        format!("{},{:03}", number / 1000, number % 1000)
    }
}
