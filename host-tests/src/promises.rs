//! What every function of the crate promises, from `promises.toml` beside this package: for tests, report and counts on the target.

use std::sync::LazyLock;

use serde::Deserialize;

/// What one function promises.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Promise {
    /// Name of the entry.
    pub name: String,
    /// The function.
    pub function: String,
    /// Inputs for which the errors hold.
    pub domain: String,
    /// What the error is of, and in which unit.
    pub error: String,
    /// Largest error.
    pub largest: f64,
    /// Root mean square error.
    pub rms: f64,
    /// Mean error, of either sign: the bias.
    pub mean: f64,
    /// Behaviour outside the domain.
    pub outside: String,
    /// Behaviour for NaN and infinities.
    pub not_finite: String,
    /// Behaviour for zeros of either sign and subnormal numbers.
    pub tiny: String,
    /// Most modelled cycles over the counted inputs, rounded up; those of a scene are for the sizes in its domain.
    pub cycles: u32,
    /// Names under which the program counts it.
    pub counted: Vec<String>,
}

/// What the image of a program with one scene promises, bytes: all of it, start-up and constants included.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq)]
#[serde(deny_unknown_fields)]
pub struct Footprint {
    /// The scene, as the program names it.
    pub scene: String,
    /// Most flash.
    pub flash: u32,
    /// Most flash built for size.
    pub flash_small: u32,
    /// Most memory for variables, without the stack.
    pub ram: u32,
    /// Most stack of a step.
    pub stack: u32,
    /// Most stack of the set-up: `FrictionModel::of` of constants that are in flash, built for speed.
    pub stack_set_up: u32,
}

/// The whole table.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Promises {
    /// Most cycles of a step over its least ones, whatever sound inputs come.
    pub step_spread: f64,
    /// Ticks within which a scene flags what is wrong with its inputs.
    pub ticks_to_flag: u32,
    /// Ticks after a failure until outputs are unflagged and right for the state.
    pub ticks_to_recover: u32,
    /// Every `step()` and `between()`, and every function that one of them calls as it is.
    #[serde(rename = "step")]
    pub steps: Vec<Promise>,
    /// Functions of which a step runs the parts, or the same formulas in another form.
    #[serde(rename = "part")]
    pub parts: Vec<Promise>,
    /// Functions that no step calls.
    pub direct: Vec<Promise>,
    /// Sizes of programs with one scene each, and of one with all of them.
    #[serde(rename = "footprint")]
    pub footprints: Vec<Footprint>,
}

impl Promises {
    /// Every promise.
    pub fn all(&self) -> impl Iterator<Item = &Promise> {
        self.steps.iter().chain(&self.parts).chain(&self.direct)
    }
}

/// The table.
///
/// # Panics
/// Where `promises.toml` is no such table, which its tests exclude.
pub static PROMISES: LazyLock<Promises> = LazyLock::new(|| {
    toml::from_str(include_str!("../promises.toml")).expect("promises.toml is such a table")
});

/// The promise of an entry.
///
/// # Panics
/// Where there is none of this name.
pub fn of(name: &str) -> &'static Promise {
    let found = PROMISES.all().find(|promise| promise.name == name);
    found.unwrap_or_else(|| panic!("promises.toml has no entry {name:?}"))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn names_are_unique() {
        let names: BTreeSet<&str> = PROMISES.all().map(|promise| &*promise.name).collect();
        assert_eq!(names.len(), PROMISES.all().count());
    }

    /// A promise without an error has none in any column.
    #[test]
    fn no_error_is_zero() {
        for promise in PROMISES.all() {
            let zero = [promise.largest, promise.rms, promise.mean] == [0.0; 3];
            assert_eq!(zero, promise.error.starts_with("none"), "{}", promise.name);
        }
    }
}
