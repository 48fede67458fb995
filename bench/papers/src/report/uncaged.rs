//! Whole screws of Lin 2019, and what the papers' closed forms make of a ball.

mod closed_forms;
mod figures;

use super::context::Context;
use epas_page::document::{Block, Section};
use epas_page::failure::Failure;

/// The section.
pub fn section(context: &Context) -> Result<Section, Failure> {
    let mut blocks = figures::blocks(context.quick)?;
    blocks.push(Block::Figure(closed_forms::figure(context.quick)?));
    Ok(Section {
        title: "Ball screw without cage",
        blocks,
    })
}
