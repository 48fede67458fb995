//! Friction with a memory: the crate's elements beside the exact hysteresis and the laws in use today.

mod compensation;
mod laws;
mod loads;
mod loops;
mod noise;
mod trial;

use super::Context;
use crate::peers::candidates::{best, ours, published};
use epas_page::document::{Block, Section};
use epas_page::failure::Failure;

/// Figures: panels in a row, width and height of one, pixels.
const WIDE: (usize, u32, u32) = (1, 1080, 440);
const PAIRS: (usize, u32, u32) = (2, 540, 440);

pub fn section(context: &Context) -> Result<Section, Failure> {
    let mut candidates = published();
    candidates.extend(best());
    candidates.extend(ours());
    let mut blocks = vec![Block::Text(
        "Friction after a reversal is a hysteresis in the angle: full friction comes back over a breakaway angle, in nested loops that close. The reference is exact: \
         Mindlin's first loading of a contact across its path, repeated from every turning point (Masing), by a stack of turning points in float64; under a load that changes, \
         the Hertzian contact as a row of springs, in closed form. Angles are over the breakaway angle, torques over the limit of sliding. Laws in use today stand beside the \
         crate's elements with the exact first stiffness of 1.5, and with the constants that come closest to the exact loops. They are taken without what depends on \
         speed, which adds nothing at the speeds of a reversal."
            .into(),
    )];
    blocks.push(loops::picture()?);
    blocks.extend(laws::blocks(context, &candidates)?);
    blocks.extend(loads::blocks(context)?);
    blocks.extend(noise::blocks()?);
    blocks.extend(compensation::blocks()?);
    blocks.extend(trial::blocks(context.quick)?);
    Ok(Section {
        title: "Friction with a memory",
        blocks,
    })
}
