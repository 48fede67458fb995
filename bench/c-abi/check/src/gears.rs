//! Folded blocks of the tests and of the README's examples: those of the project's firmware, as words in C.

use std::fmt::Write as _;
use std::sync::LazyLock;

use epas_friction::scene::FoldedBall;

use crate::tools::Outcome;

const IN_A_LINE: usize = 6;

/// A gear of the firmware: its constants, and in the same file its words.
macro_rules! gear {
    ($module:ident, $file:literal, $words:ident) => {
        mod $module {
            #![allow(dead_code, missing_docs, clippy::all)]
            include!(concat!("../../../firmware/src/gears/", $file));

            /// Its words.
            pub static WORDS: &[u32] = &$words;
        }
    };
}

gear!(gear_33x20, "gear_33x20.rs", GEAR_33X20_BLOCK);
gear!(
    gear_33x20_range,
    "gear_33x20_range.rs",
    GEAR_33X20_RANGE_BLOCK
);
gear!(gear_33x20_worn, "gear_33x20_worn.rs", GEAR_33X20_WORN_BLOCK);
gear!(gear_29x7_range, "gear_29x7_range.rs", GEAR_29X7_RANGE_BLOCK);

/// For one friction coefficient.
pub static GEAR_33X20: &[u32] = gear_33x20::WORDS;
/// For a range of them.
pub static GEAR_33X20_RANGE: &[u32] = gear_33x20_range::WORDS;
/// Worn, with play.
pub static GEAR_33X20_WORN: &[u32] = gear_33x20_worn::WORDS;
/// The gear of the README's first example.
pub static GEAR_29X7_RANGE: &[u32] = gear_29x7_range::WORDS;

#[path = "../../../firmware/src/gears/balls.rs"]
mod balls;

pub use balls::{GEAR_33X20_BALL, GEAR_33X20_BALL_RANGE};

/// [`GEAR_33X20_BALL`] with a fifth more friction torque: as worn as a test needs it.
pub static GEAR_33X20_BALL_WORN: LazyLock<FoldedBall> = LazyLock::new(|| {
    let mut worn = GEAR_33X20_BALL;
    for node in &mut worn.law.nodes {
        for knot in node.branches.as_flattened_mut() {
            knot.numbers.torque = knot.numbers.torque.map(|torque| 1.2 * torque);
        }
    }
    worn
});

/// Words of a folded ball. Their digest is that of no design.
pub fn words_of<const NODES: usize>(ball: &FoldedBall<NODES>) -> Outcome<Vec<u32>> {
    let mut words = vec![0; FoldedBall::<NODES>::WORDS];
    ball.write(0, &mut words)?;
    Ok(words)
}

fn header(guard: &str, arrays: &[(&str, &[u32])]) -> Outcome<String> {
    let mut text = format!(
        "/* Written by `cargo run -p epas-c-check -- --write`; do not edit. Folded ball screws, as `epas design` writes\n\
         \x20* them: those of bench/firmware/src/gears. */\n#ifndef {guard}\n#define {guard}\n\n#include <stdint.h>\n"
    );
    for (name, words) in arrays {
        write!(
            text,
            "\nstatic const uint32_t {name}[{}] = {{\n",
            words.len()
        )?;
        for line in words.chunks(IN_A_LINE) {
            text.push_str("   ");
            for word in line {
                write!(text, " 0x{word:08x}u,")?;
            }
            text.push('\n');
        }
        text.push_str("};\n");
    }
    writeln!(text, "\n#endif")?;
    Ok(text)
}

/// The blocks of the tests, but for those that the examples have.
pub fn of_tests() -> Outcome<String> {
    header(
        "EPAS_TEST_GEARS_H",
        &[
            ("GEAR_33X20_BLOCK", GEAR_33X20),
            ("GEAR_33X20_RANGE_BLOCK", GEAR_33X20_RANGE),
            ("GEAR_33X20_WORN_BLOCK", GEAR_33X20_WORN),
            ("GEAR_33X20_BALL_BLOCK", &words_of(&GEAR_33X20_BALL)?),
            (
                "GEAR_33X20_BALL_WORN_BLOCK",
                &words_of(&GEAR_33X20_BALL_WORN)?,
            ),
        ],
    )
}

/// The blocks of the README's examples: each the header that `epas design` writes.
pub fn of_examples() -> Outcome<[(&'static str, String); 2]> {
    let screw = words_of(&GEAR_33X20_BALL_RANGE)?;
    Ok([
        (
            "test/gear.h",
            header("GEAR_BLOCK_H", &[("GEAR_BLOCK", GEAR_29X7_RANGE)])?,
        ),
        (
            "test/screw.h",
            header("SCREW_BLOCK_H", &[("SCREW_BLOCK", &screw)])?,
        ),
    ])
}
