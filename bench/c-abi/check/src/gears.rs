//! Folded blocks of the tests and of the README's example: those of the project's firmware, as words in C.

use std::fmt::Write as _;

use crate::outcome::Outcome;

/// Words in a line.
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

gear!(lin_3_6, "lin_3_6.rs", LIN_3_6_BLOCK);
gear!(lin_3_6_range, "lin_3_6_range.rs", LIN_3_6_RANGE_BLOCK);
gear!(lin_3_6_worn, "lin_3_6_worn.rs", LIN_3_6_WORN_BLOCK);
gear!(lin_4_1_range, "lin_4_1_range.rs", LIN_4_1_RANGE_BLOCK);

/// For one friction coefficient.
pub static LIN_3_6: &[u32] = lin_3_6::WORDS;
/// For a range of them.
pub static LIN_3_6_RANGE: &[u32] = lin_3_6_range::WORDS;
/// Worn, with play.
pub static LIN_3_6_WORN: &[u32] = lin_3_6_worn::WORDS;
/// The gear of the README's example.
pub static LIN_4_1_RANGE: &[u32] = lin_4_1_range::WORDS;

/// A header with arrays.
fn header(guard: &str, arrays: &[(&str, &[u32])]) -> Outcome<String> {
    let mut text = format!(
        "/* Written by `cargo run -p epas-c-check -- --write`; do not edit. Folded ball screws, as `epas-bench design` writes\n\
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

/// The blocks of the tests.
pub fn of_tests() -> Outcome<String> {
    header(
        "EPAS_TEST_GEARS_H",
        &[
            ("LIN_3_6_BLOCK", LIN_3_6),
            ("LIN_3_6_RANGE_BLOCK", LIN_3_6_RANGE),
            ("LIN_3_6_WORN_BLOCK", LIN_3_6_WORN),
            ("LIN_4_1_RANGE_BLOCK", LIN_4_1_RANGE),
        ],
    )
}

/// The block of the README's example.
pub fn of_example() -> Outcome<String> {
    header("GEAR_BLOCK_H", &[("GEAR_BLOCK", LIN_4_1_RANGE)])
}
