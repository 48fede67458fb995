//! Bounds that are measured, not derived, from `measured.toml`: what was found, and what is accepted. All sweeps give the same
//! numbers in every run.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::sync::{LazyLock, Mutex};

use serde::Deserialize;

/// One measured quantity: largest error, root mean square and mean by its size; one number where only the largest is bounded.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Measured {
    accepted: Vec<f64>,
    found: Vec<f64>,
}

impl Measured {
    /// Largest, root mean square and mean error that a test accepts.
    pub fn accepted(&self) -> [f64; 3] {
        [0, 1, 2].map(|index| self.accepted.get(index).copied().unwrap_or(f64::INFINITY))
    }
}

static TABLE: LazyLock<BTreeMap<String, Measured>> =
    LazyLock::new(|| toml::from_str(include_str!("../measured.toml")).expect("a table"));

static LARGEST: Mutex<BTreeMap<String, f64>> = Mutex::new(BTreeMap::new());

/// Asserts that an error is at most what the row of its name accepts.
pub fn assert(name: &str, error: impl Into<f64>) {
    assert_at(name, error, "");
}

/// The same, with the case for the message.
pub fn assert_at(name: &str, error: impl Into<f64>, case: impl Display) {
    let error = error.into().abs();
    let [accepted, ..] = of(name).accepted();
    assert!(
        error <= accepted,
        "{name}: {error:e}; accepted is {accepted:e}; {case}"
    );
    let mut largest = LARGEST.lock().unwrap();
    let before = largest.entry(name.to_owned()).or_insert(-1.0);
    if error > *before {
        *before = error;
        println!("{name}: {error:.2e}");
    }
}

/// Asserts errors of one case; the name of a row is the group's, a comma, and the quantity's.
pub fn of_case(group: &str, case: impl Display) -> impl Fn(&str, f64) {
    move |quantity, error| assert_at(&format!("{group}, {quantity}"), error, &case)
}

/// The row of a name.
///
/// # Panics
/// Where there is none, or less is accepted than was found, or far more.
pub fn of(name: &str) -> &'static Measured {
    let row = TABLE
        .get(name)
        .unwrap_or_else(|| panic!("{name} is not in testkit/measured.toml"));
    for (index, (accepted, found)) in row.accepted.iter().zip(&row.found).enumerate() {
        assert!(found <= accepted, "{name}: {found:e} above {accepted:e}");
        // Three times, rounded up to two digits.
        let far = index < 2 && *found > 0.0 && *accepted > 3.3 * found;
        assert!(!far, "{name}: {accepted:e} far above {found:e}");
    }
    row
}
