//! Where an effort is cut off at its limits, for those who have a trace without its table.

use std::ops::Range;

use crate::trace::channels::range;
use crate::trace::rests::moving;

/// Fewest samples that stay at a limit. Three equal ones are chance where the steps of the sensor are coarse; many are not.
const STAY: usize = 5;
/// Share of samples that may equal the one before, away from the limits, for equality to say anything.
const STILL: f64 = 0.2;
/// Share of samples below which such stretches are chance.
const SHARE: f64 = 0.001;

/// Stretches at the largest or smallest number of an effort that elsewhere does not stand still, rests left out.
pub fn clipped(effort: &[f64], rests: &[Range<usize>]) -> Vec<Range<usize>> {
    let (low, high) = range(&moving(effort, rests));
    if !(high > low) {
        // A dead channel has no limits.
        return Vec::new();
    }
    let (mut at, mut still, mut moves) = (0, 0, 0);
    let mut found: Vec<Range<usize>> = Vec::new();
    let mut rests = rests.iter().peekable();
    for equal in effort.chunk_by(|a, b| a == b) {
        let run = at..at + equal.len();
        at = run.end;
        while rests.next_if(|rest| rest.end <= run.start).is_some() {}
        if rests.peek().is_some_and(|rest| rest.start < run.end) {
            continue;
        }
        moves += run.len();
        let at_limit = equal.first().is_some_and(|x| *x == low || *x == high);
        if at_limit && run.len() >= STAY {
            found.push(run);
        } else {
            still += run.len() - 1;
        }
    }
    let stay: usize = found.iter().map(Range::len).sum();
    if still as f64 > STILL * (moves - stay) as f64 || stay as f64 <= SHARE * moves as f64 {
        return Vec::new();
    }
    found
}
