//! Folded balls of a screw without cage: `.bin` files beside this one, as `epas-design` wrote them.
//!
//! Pitch radius 16.5 mm, lead 20 mm, ball radius 2.778 mm, contact angle 45 degrees, oversize 0.41 um; axial loads of 5 to 300 N a ball, both signs;
//! deviations of the contact angles to 0.01745 rad on the screw and 0.00873 rad in the nut. `epas-design`'s example `gears` prints their
//! certificates.

use epas_friction::scene::FoldedBall;

/// For a friction coefficient of 0.075.
pub static GEAR_33X20_BALL: FoldedBall =
    read::<{ FoldedBall::<1>::WORDS }, 1>(include_bytes!("gear_33x20_ball.bin"));

/// For friction coefficients of 0.05 to 0.15.
pub static GEAR_33X20_BALL_RANGE: FoldedBall<3> =
    read::<{ FoldedBall::<3>::WORDS }, 3>(include_bytes!("gear_33x20_ball_range.bin"));

const fn read<const WORDS: usize, const NODES: usize>(mut bytes: &[u8]) -> FoldedBall<NODES> {
    let mut words = [0; WORDS];
    let mut number = 0;
    while number < WORDS
        && let Some((word, rest)) = bytes.split_first_chunk()
    {
        words[number] = u32::from_le_bytes(*word);
        bytes = rest;
        number += 1;
    }
    match FoldedBall::read(&words) {
        Ok(ball) => ball,
        Err(_) => panic!("the block is damaged, or of another version of epas-friction"),
    }
}
