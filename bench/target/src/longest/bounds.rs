//! What bounds each loop: the one table to which a new loop is added.
//!
//! A loop belongs to the function of a crate in whose code all of it stands, inlined or not, by the debug information; iterators of
//! `core` belong to the function that walks. A loop whose function is not in [`LOOPS`] has no bound, and what contains it
//! no longest path.

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Count {
    Balls,
    /// One less than the balls of the train.
    BallsLessOne,
}

/// What a loop does on each back edge to its header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// It runs so often at most each time when it is entered.
    Times(Count),
    /// It takes one from each of these totals.
    Takes(&'static [Total]),
    /// It stores a part of the bytes that its function was called with.
    Stores,
    /// It does not run where addresses are multiples of four, as those are that its function is called with.
    Never,
}

/// A total over all loops and places of one call of a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Total {
    /// Balls that pooling passes on its walk from the last one backwards: each stands alone, begins a cluster or joins the
    /// one ahead.
    Passed,
    /// Joins: each makes one cluster of two.
    Joins,
}

impl Total {
    pub const fn most(self) -> Count {
        match self {
            Self::Passed => Count::Balls,
            Self::Joins => Count::BallsLessOne,
        }
    }
}

/// A row of the table: the loops of a function.
pub struct Row {
    /// The function, without lengths of arrays and types of closures.
    pub function: &'static str,
    /// A function whose code stands where the loop goes back; none where the row is for every back edge.
    pub through: Option<&'static str>,
    pub bound: Bound,
}

const fn row(function: &'static str, bound: Bound) -> Row {
    Row {
        function,
        through: None,
        bound,
    }
}

const BALLS: Bound = Bound::Times(Count::Balls);

/// Loops by their functions; the first row that fits counts.
pub const LOOPS: &[Row] = &[
    // Once over all balls.
    row("epas_friction::train::press::Press::solve_all", BALLS),
    row("epas_friction::train::press::Press::settle", BALLS),
    row("epas_friction::train::press::Press::let_go", BALLS),
    row("epas_friction::train::pool::settle", BALLS),
    row("epas_friction::train::pool::take_out", BALLS),
    row("epas_friction::train::track::Train::take_in", BALLS),
    row("epas_friction::train::track::Train::refine", BALLS),
    row("epas_friction::train::track::Train::press", BALLS),
    row("epas_friction::train::track::Train::rub_in_part", BALLS),
    row("epas_friction::train::track::Train::step", BALLS),
    row("epas_friction::scene::uncaged::refine", BALLS),
    row("epas_friction::scene::uncaged::UncagedConstants", BALLS),
    row("epas_friction::scene::circuit::LoadedZone::sharing", BALLS),
    row("epas_friction::scene::linear::LinearConstants", BALLS),
    row(
        "epas_friction::model::FrictionModelepas_friction::scene::linear::LinearBearingTrain, epas_friction::scene::linear::LinearConstants::step",
        BALLS,
    ),
    // "Why joining is exact", `epas_friction::train`: the walk passes each ball once, and every back edge of `grow` or `close`
    // is a join; one that grows backwards passes a ball as well.
    row(
        "epas_friction::train::pool::pool",
        Bound::Takes(&[Total::Passed]),
    ),
    row(
        "epas_friction::train::pool::next_front",
        Bound::Takes(&[Total::Passed]),
    ),
    Row {
        function: "epas_friction::train::pool::grow",
        through: Some("epas_friction::train::pool::Cluster::grown"),
        bound: Bound::Takes(&[Total::Passed, Total::Joins]),
    },
    row(
        "epas_friction::train::pool::grow",
        Bound::Takes(&[Total::Joins]),
    ),
    row(
        "epas_friction::train::pool::close",
        Bound::Takes(&[Total::Joins]),
    ),
    // What the compiler calls to clear and to move memory.
    row("compiler_builtins::arm::__aeabi_memset4", Bound::Stores),
    row("compiler_builtins::arm::__aeabi_memcpy4", Bound::Stores),
    row(
        "compiler_builtins::mem::impls::copy_forward::copy_forward_aligned_words",
        Bound::Stores,
    ),
    row(
        "compiler_builtins::mem::impls::copy_backward::copy_backward_aligned_words",
        Bound::Stores,
    ),
    row(
        "compiler_builtins::mem::impls::set_bytes::set_bytes_bytes",
        Bound::Never,
    ),
    row(
        "compiler_builtins::mem::impls::copy_forward::copy_forward_bytes",
        Bound::Never,
    ),
    row(
        "compiler_builtins::mem::impls::copy_backward::copy_backward_bytes",
        Bound::Never,
    ),
    row(
        "compiler_builtins::mem::impls::copy_forward::copy_forward_misaligned_words",
        Bound::Never,
    ),
    row(
        "compiler_builtins::mem::impls::copy_backward::copy_backward_misaligned_words",
        Bound::Never,
    ),
];

/// Types whose length is the number of balls of a train.
const TRAINS: [&str; 7] = [
    "UncagedBallScrew",
    "UncagedConstants",
    "LinearBearingTrain",
    "LinearConstants",
    "Press",
    "Train",
    "CircuitState",
];

/// The number of balls in the name of a function, `Press<37>::join`.
pub fn balls_in(name: &str) -> Option<u32> {
    TRAINS.iter().find_map(|train| {
        name.match_indices(train).find_map(|(place, _)| {
            let rest = name[place + train.len()..].strip_prefix('<')?;
            rest.split(['>', ',']).next()?.parse().ok()
        })
    })
}

/// The name of a function without lengths of arrays, other constants and brackets.
pub fn plain(name: &str) -> String {
    let mut plain = String::with_capacity(name.len());
    let mut rest = name;
    while let Some(open) = rest.find('<') {
        plain.push_str(&rest[..open]);
        rest = &rest[open + 1..];
        if let Some((length, after)) = rest.split_once('>')
            && is_constant(length)
        {
            rest = after;
            if plain.ends_with("::") {
                plain.truncate(plain.len() - 2);
            }
        }
    }
    plain.push_str(rest);
    plain.replace('>', "")
}

/// Whether arguments of a function are constants: lengths, or a choice.
fn is_constant(argument: &str) -> bool {
    let digits = argument
        .split(", ")
        .all(|one| !one.is_empty() && one.bytes().all(|byte| byte.is_ascii_digit()));
    digits || matches!(argument, "true" | "false")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_balls_and_functions() {
        let name = "<epas_friction::train::press::Press<37>>::join";
        assert_eq!(balls_in(name), Some(37));
        assert_eq!(plain(name), "epas_friction::train::press::Press::join");
        assert_eq!(
            balls_in("<epas_friction::scene::CagedBallScrew<5>>::step"),
            None
        );
        assert_eq!(
            plain("epas_friction::train::pool::pool::<false>"),
            "epas_friction::train::pool::pool"
        );
        assert_eq!(
            plain("<epas_friction::train::settle::Settling<false>>::row"),
            "epas_friction::train::settle::Settling::row"
        );
    }
}
