//! The built-in designs as folded blocks: `built_in.bin`, which `epas design --store` writes.
//!
//! The file is one block after another in the order of the catalogues, each word with its least significant byte first.

use super::CagedBallScrewConfiguration;
use crate::geometry::position;

/// Friction coefficients of a built-in design's block: 0.05 to 0.15 in steps of 0.01.
pub const BUILT_IN_NODES: usize = 11;

const WORDS: usize = CagedBallScrewConfiguration::<BUILT_IN_NODES>::WORDS;
const BYTES: usize = WORDS * size_of::<u32>();

static FILE: &[u8] = include_bytes!("built_in.bin");

/// The words of the first block of some bytes, 0 behind their end.
const fn words(bytes: &[u8]) -> [u32; WORDS] {
    let mut words = [0; WORDS];
    let (mut rest, mut number) = (bytes, 0);
    while number < WORDS
        && let Some((word, after)) = rest.split_first_chunk()
    {
        words[number] = u32::from_le_bytes(*word);
        rest = after;
        number += 1;
    }
    words
}

/// Folded law of a built-in design ([`CATALOGUE`](crate::CATALOGUE), [`FINE_LEAD_SIZES`](crate::geometry::FINE_LEAD_SIZES),
/// [`STEERING_SIZES`](crate::geometry::STEERING_SIZES), [`DISSERTATION_DESIGNS`](crate::DISSERTATION_DESIGNS)) by its name, for balls that do not touch.
///
/// Folded for [`defaults::CLEARANCE`](crate::defaults::CLEARANCE), [`defaults::ROLLING_RESISTANCE`](crate::defaults::ROLLING_RESISTANCE), 5 to 300 N a ball and
/// friction coefficients 0.05 to 0.15. To change: `friction` (0.1), `loaded_balls` (of 2.5 turns, or those of the dissertation),
/// `reversal_speed` (2 rad/s), `limits` (2000 rad/s, 100 kN, 100 N m).
///
/// Errors against the exact ball over the designs, each at 2048 states of both signs:
///
/// | | largest | rms |
/// |---|---|---|
/// | at 0.05, 0.1 and 0.15, 52 designs | 1.7 % (40x5x3.175 at 0.15) | 0.034 % |
/// | the same without 125x10 and the leads of 5 mm, 43 designs | 0.36 % | 0.018 % |
/// | any coefficient from 0.05 to 0.15, without 32x5, 40x5 and 50x5, 47 designs | 1.6 % | 0.064 % |
/// | the same of 32x5, 40x5 and 50x5, 5 designs | 7.9 % | 0.47 % |
///
/// Between two coefficients of the last ones a contact opens: take [`nearest`](CagedBallScrewConfiguration::nearest), or fold them with a host.
///
/// Cost: at set-up the checksum of a block, 4 KB of stack, and 194 KB of flash where the name is not known when firmware is compiled; in a constant only the
/// block's own 3.7 KB, or 0.4 KB behind [`nearest`](CagedBallScrewConfiguration::nearest).
///
/// ```
/// use epas_friction::scene::{CagedBallScrew, CagedBallScrewConfiguration, CagedConstants, built_in};
/// use epas_friction::{FrictionModel, Inputs};
///
/// static GEAR: CagedConstants = match built_in("25x5x3.175") {
///     Some(design) => match CagedConstants::new(&CagedBallScrewConfiguration { loaded_balls: 60, ..design.nearest(0.1) }) {
///         Ok(constants) => constants,
///         Err(_) => panic!("out of range"),
///     },
///     None => panic!("no built-in design has this name"),
/// };
///
/// let mut model = FrictionModel::<CagedBallScrew, _>::of(&GEAR);
/// let torque = model.step(Inputs { nut_speed: 10.0, axial_load: 5e3 }).friction_torque;
/// assert!(torque > 0.2 && torque < 0.6, "{torque}");
/// ```
pub const fn built_in(name: &str) -> Option<CagedBallScrewConfiguration<BUILT_IN_NODES>> {
    let Some(place) = position(name) else {
        return None;
    };
    let Some((_, rest)) = FILE.split_at_checked(place * BYTES) else {
        return None;
    };
    match CagedBallScrewConfiguration::read(&words(rest)) {
        Ok(design) => Some(design),
        Err(_) => None,
    }
}
