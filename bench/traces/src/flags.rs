//! Flags of a tick: their names, what they mean, and what a controller does. README, help and tables have them from here.

use std::fmt::Write as _;
use std::sync::LazyLock;

use epas_friction::Faults;

/// One flag.
#[derive(Clone, Copy, Debug)]
pub struct Flag {
    /// The flag.
    pub fault: Faults,
    /// Its name.
    pub name: &'static str,
    /// The same for a summary.
    pub short: &'static str,
    /// What it means.
    pub meaning: &'static str,
    /// What a controller does.
    pub reaction: &'static str,
}

const fn flag(fault: Faults, [name, short, meaning, reaction]: [&'static str; 4]) -> Flag {
    Flag {
        fault,
        name,
        short,
        meaning,
        reaction,
    }
}

/// Every flag, in the order of their bits.
pub const FLAGS: [Flag; 11] = [
    flag(
        Faults::SPEED_NOT_FINITE,
        [
            "SPEED_NOT_FINITE",
            "speed not finite",
            "the speed is NaN or infinite: no friction; with memory the last sound speed",
            "hold the last torque, then fade it out; count",
        ],
    ),
    flag(
        Faults::LOAD_NOT_FINITE,
        [
            "LOAD_NOT_FINITE",
            "load not finite",
            "a load is NaN or infinite: no friction; with memory the last sound load",
            "hold the last torque, then fade it out; count",
        ],
    ),
    flag(
        Faults::SPEED_RANGE,
        [
            "SPEED_RANGE",
            "speed limit",
            "the speed is beyond its limit: friction at the limit",
            "check sensor and limits",
        ],
    ),
    flag(
        Faults::LOAD_RANGE,
        [
            "LOAD_RANGE",
            "load limit",
            "a load is beyond its limit: friction at the limit",
            "check sensor and limits",
        ],
    ),
    flag(
        Faults::FRICTION_LIMIT,
        [
            "FRICTION_LIMIT",
            "torque limit",
            "friction was cut to its limit",
            "check the calibration page",
        ],
    ),
    flag(
        Faults::BEYOND_MODEL,
        [
            "BEYOND_MODEL",
            "beyond the model",
            "outside the block's domain: best estimate",
            "keep compensating; do not adapt",
        ],
    ),
    flag(
        Faults::FORCES_NOT_HELD,
        [
            "FORCES_NOT_HELD",
            "forces not held",
            "forces between balls are not held, the torque is",
            "go on",
        ],
    ),
    flag(
        Faults::ANGLE_NOT_VALID,
        [
            "ANGLE_NOT_VALID",
            "angle not valid",
            "a reading of the encoder is missing or impossible: friction stays",
            "fade out if it lasts",
        ],
    ),
    flag(
        Faults::TEMPERATURE_RANGE,
        [
            "TEMPERATURE_RANGE",
            "temperature range",
            "no usable temperature: that of the configuration",
            "go on; set a diagnostic",
        ],
    ),
    flag(
        Faults::LOAD_STALE,
        [
            "LOAD_STALE",
            "load too old",
            "the load is older than allowed: its friction fades, that of a preload stays",
            "set a diagnostic",
        ],
    ),
    flag(
        Faults::TEMPERATURE_STALE,
        [
            "TEMPERATURE_STALE",
            "temperature too old",
            "the temperature is older than allowed: that of the configuration",
            "go on; set a diagnostic",
        ],
    ),
];

/// Names of the flags of a set, joined by `|`; empty where none is set.
pub fn words(faults: Faults) -> String {
    of_bits(faults.bits())
}

/// Bits and words of every set of flags, for a channel that keeps the bits.
pub fn every_set() -> &'static [(u16, String)] {
    static EVERY: LazyLock<Vec<(u16, String)>> = LazyLock::new(|| {
        let bits = |set: &u32| {
            let chosen = FLAGS.iter().enumerate();
            let chosen = chosen.filter(|(place, _)| set >> place & 1 == 1);
            chosen.fold(0, |bits, (_, flag)| bits | flag.fault.bits())
        };
        let sets = 0..1_u32 << FLAGS.len();
        sets.map(|set| bits(&set))
            .map(|bits| (bits, of_bits(bits)))
            .collect()
    });
    &EVERY
}

fn of_bits(bits: u16) -> String {
    let names = FLAGS
        .iter()
        .filter(|flag| bits & flag.fault.bits() != 0)
        .map(|flag| flag.name);
    names.collect::<Vec<_>>().join("|")
}

/// The table of a command's help.
pub fn table() -> String {
    let mut text = "Flags of a sample (column faults, a sum of numbers; column fault_words, their names), and what a controller does:\n"
        .to_owned();
    for flag in FLAGS {
        let Flag {
            fault,
            name,
            meaning,
            reaction,
            ..
        } = flag;
        let bits = fault.bits();
        let _ = write!(
            text,
            "\n{bits:>6}  {name:18} {meaning}\n{:26} -> {reaction}",
            ""
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_has_the_names_of_its_flags() {
        assert_eq!(words(Faults::NONE), "");
        let both = Faults::BEYOND_MODEL | Faults::LOAD_RANGE;
        assert_eq!(words(both), "LOAD_RANGE|BEYOND_MODEL");
        assert!(every_set().contains(&(both.bits(), words(both))));
        assert_eq!(every_set().len(), 2048);
    }

    /// README's table has every flag with its bit and its reaction.
    #[test]
    fn the_readme_has_the_same_flags() {
        let readme = include_str!("../../../README.md");
        for flag in FLAGS {
            let cell = format!("`{}` ({})", flag.name, flag.fault.bits().trailing_zeros());
            let row = readme.lines().find(|line| line.contains(&cell));
            let row = row.unwrap_or_else(|| panic!("{cell}"));
            assert!(row.contains(flag.reaction), "{row}");
            assert!(table().contains(flag.name));
        }
    }
}
