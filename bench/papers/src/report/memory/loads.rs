//! What a changing load does to the laws.

use rayon::prelude::*;

use super::laws::shown;
use crate::peers::candidates::under_load;
use crate::peers::compare::{LOAD_CASES, errors_under_load, least_loss, work_of_a_load_cycle};
use crate::report::Context;
use epas_bench::report::draw::table;
use epas_page::document::{Block, Cell};
use epas_page::failure::Failure;

pub fn blocks(context: &Context) -> Result<Vec<Block>, Failure> {
    Ok(vec![
        Block::Text(
            "Under a load that changes, a contact is a row of springs of constant stiffness that meet the surface one after the other; elements may do the same (load-exact), or have limits in \
             proportion to the load, or be multiplied by the load as bristles of tyre models are. Multiplied ones give out energy: a nut that goes out under a low load and comes back under a high \
             one is pushed for ever."
                .into(),
        ),
        errors()?,
        energies(context)?,
    ])
}

fn errors() -> Result<Block, Failure> {
    let laws = under_load(1.0);
    let names: Vec<&str> = laws.iter().map(|law| law.name.as_str()).collect();
    let columns = format!("load | longest stroke | {}", names.join(" | "));
    let row = |&((least, most), amplitude): &((f64, f64), f64)| {
        let range = Cell::from(format!("{least} to {most}"));
        let errors = errors_under_load(amplitude, (least, most))?.into_iter();
        let errors = errors.map(|(_, error)| Cell::fixed(100.0 * error, 1));
        let head = [range, Cell::fixed(amplitude, 1)];
        Ok(head.into_iter().chain(errors).collect())
    };
    let rows = LOAD_CASES
        .par_iter()
        .map(row)
        .collect::<Result<_, Failure>>()?;
    Ok(Block::Table(table(
        "memory_under_load",
        "Error under a random load and random strokes, per cent of the rms of the exact torque. Loads are over the reference load, strokes over the breakaway angle under it; \
         load-exact elements are made for the largest load of each row",
        &columns,
        rows,
    )))
}

fn energies(context: &Context) -> Result<Block, Failure> {
    let mut rows = Vec::new();
    for (one, other) in under_load(3.0).iter().zip(under_load(1.8)) {
        let least = least_loss(one.start()?.as_mut(), 200_000);
        let work = work_of_a_load_cycle(other.start()?.as_mut());
        rows.push(vec![
            Cell::from(one.name.as_str()),
            Cell::power(least),
            Cell::fixed(work, 4),
            shown(context, &one.cycles),
        ]);
    }
    Ok(Block::Table(table(
        "memory_energy",
        "Energy under a changing load, over limit times breakaway angle: least loss of a tick over 200,000 random ticks with loads of 0.1 to 3, and work in a cycle that goes \
         out by 0.2 under a load of 0.2 to 1 and back under 1 to 1.8. Energy given out is below zero; cycles as in the table of laws",
        "elements | least loss in a tick | work in a cycle | cycles",
        rows,
    )))
}
