//! The shared library of a co-simulation unit, for FMI 2.0 and 3.0.
//!
//! `instance` is a unit while a simulation has it: its phase, its values, its model. `registry` keeps instances by handles that are
//! numbers and no addresses, so that a handle that was freed, or never given, is told from one that lives. `boundary` is the one folder
//! with pointers: every exported function. What a unit computes stands in `epas_cli::fmu`, and is what `simulate` computes.

mod boundary;
mod instance;
mod kinds;
mod outcome;
mod registry;
mod state;

/// Balls that this library is built for, 0 without a row of balls.
const ROW: usize = balls(option_env!("EPAS_FMU_BALLS"));

/// The same for the models, which have at least one.
pub const BALLS: usize = if ROW == 0 { 1 } else { ROW };

/// Tells the program that packs this library which one it is, see `epas_cli::fmu::mark`.
#[used]
static MARK: [u8; 29] = {
    let mut mark = *b"epas-friction row of 00 balls";
    mark[21] = b'0' + (ROW / 10) as u8;
    mark[22] = b'0' + (ROW % 10) as u8;
    mark
};

/// A number of one or two digits; the screw of Lin 2019 where none is asked for.
const fn balls(text: Option<&str>) -> usize {
    let Some(text) = text else {
        return 37;
    };
    let mut digits = text.as_bytes();
    let mut number = 0;
    while let [digit, rest @ ..] = digits {
        assert!(digit.is_ascii_digit(), "EPAS_FMU_BALLS is a number");
        number = 10 * number + (*digit - b'0') as usize;
        digits = rest;
    }
    assert!(number <= 64, "EPAS_FMU_BALLS is 0 to 64");
    number
}
