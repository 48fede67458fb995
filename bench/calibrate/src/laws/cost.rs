//! Cost of a law of friction on the reference core, from the counts that are stored beside the firmware.

use serde_json::Value;

use crate::laws::Cost;

/// Counts of the last run of `target --store`.
const COUNTS: &str = include_str!("../../../target.json");

/// Modelled cycles of a tick; `None` where a function has no count.
pub fn cycles(cost: Cost) -> Option<u32> {
    match cost {
        Cost::Estimated(cycles) => Some(cycles),
        Cost::Counted(names) => {
            let counts: Value = serde_json::from_str(COUNTS).ok()?;
            names.iter().map(|name| counted(&counts, name)).sum()
        }
    }
}

fn counted(counts: &Value, name: &str) -> Option<u32> {
    let functions = counts.get("functions")?.as_array()?;
    let function = functions
        .iter()
        .find(|function| function["name"] == *name)?;
    u32::try_from(function["cycles_max"].as_u64()?).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_found_and_added() {
        let one = cycles(Cost::Counted(&["memory_8"])).unwrap();
        let other = cycles(Cost::Counted(&["friction_coefficient"])).unwrap();
        let both = cycles(Cost::Counted(&["memory_8", "friction_coefficient"]));
        assert_eq!(both, Some(one + other));
        assert!(one > 100 && other > 20);
        assert_eq!(cycles(Cost::Counted(&["no_such_function"])), None);
        assert_eq!(cycles(Cost::Estimated(38)), Some(38));
    }
}
