//! What encoder noise does to friction by angle and by speed.

use crate::peers::candidates::{Candidate, ours};
use crate::peers::noise::{AtRest, by_angle, by_speed, error_of_counts};
use epas_bench::report::draw::table;
use epas_page::document::{Block, Cell};
use epas_page::failure::Failure;

const BREAKAWAYS: [f64; 3] = [1e-3, 2e-3, 5e-3];

const REVERSAL_SPEEDS: [f64; 5] = [0.01, 0.05, 0.1, 0.2, 0.5];

fn eight() -> Result<Candidate, Failure> {
    let mut laws = ours().into_iter();
    laws.find(|law| law.name.contains(", 8 "))
        .ok_or_else(|| Failure::Data("no law of eight elements".into()))
}

pub fn blocks() -> Result<Vec<Block>, Failure> {
    let law = eight()?;
    let mut rows = Vec::new();
    let row = |name: String, found: &AtRest, counts: Cell| {
        vec![
            Cell::from(name),
            Cell::fixed(found.changes as f64, 0),
            Cell::fixed(found.largest_step, 3),
            counts,
        ]
    };
    for reversal_speed in REVERSAL_SPEEDS {
        let found = by_speed(reversal_speed)?;
        let name = format!("by speed, w/sqrt(w^2 + w_s^2), w_s = {reversal_speed} rad/s");
        rows.push(row(name, &found, "".into()));
    }
    for breakaway in BREAKAWAYS {
        let found = by_angle(law.start()?.as_mut(), breakaway)?;
        let name = format!(
            "by angle, 8 elements, breakaway after {} mrad",
            1e3 * breakaway
        );
        let error = error_of_counts(|| law.start(), breakaway)?;
        rows.push(row(name, &found, Cell::fixed(error, 3)));
    }
    let columns = "friction | changes of regime | largest step of the torque, over the limit | \
         rms error by counts, over the limit";
    Ok(vec![Block::Table(table(
        "memory_noise",
        "Noise of a motor's encoder of 14 bits behind a ratio of 2.5 (0.153 mrad a count at the nut). Hands off for 4.9 s at 1 kHz with 0.05 rad/s of noise, the nut resting \
             where a count changes: by speed, a regime changes whenever the noise passes the reversal speed, which can be avoided only by a \
             reversal speed far above the noise, at which friction is missing in every slow motion; by angle, none changes where the nut rests in the middle of a loop, and a step of the torque is that of one count; where it has slid to rest, elements need a play as wide as the noise (the table of compensation). Counts: rms error \
             over random strokes up to two breakaway angles long, because angles are counts. A breakaway angle below 2 mrad asks for a finer angle than that of counts",
        columns,
        rows,
    ))])
}
