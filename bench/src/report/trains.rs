//! Ball-to-ball friction: error against run time of one ball and of two, and the cost of a train.

mod cost;
mod linear;
mod screw;

pub use linear::{Closed, closed_form_errors};

use super::Context;
use epas_page::document::{Block, Section};
use epas_page::failure::Failure;

pub fn section(context: &Context) -> Result<Section, Failure> {
    let mut blocks = vec![Block::Text(
        "Balls are driven apart or together by small differences of their speeds, and where they press on \
         each other they rub with 1.4 times the track speed. A ball moves so that it loses the least power: \
         what is compared is how well, and in what time, each formula finds that motion."
            .into(),
    )];
    blocks.extend(linear::blocks(context)?);
    blocks.extend(screw::blocks(context)?);
    blocks.extend(cost::blocks(context)?);
    Ok(Section {
        title: "Ball-to-ball friction",
        blocks,
    })
}
