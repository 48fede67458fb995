//! Whole screws of Lin 2019, and what the papers' closed forms make of a ball.

mod closed_forms;
mod figures;

use super::Context;
use epas_page::document::Section;
use epas_page::failure::Failure;

/// The section.
pub fn section(context: &Context) -> Result<Section, Failure> {
    let mut blocks = figures::blocks(context.quick)?;
    blocks.push(closed_forms::picture(context.quick)?);
    Ok(Section {
        title: "Ball screw without cage",
        blocks,
    })
}
