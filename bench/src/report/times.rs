//! Times and their ratios in a table: a number, or an upper limit where the time is below the resolution.

use crate::timing::{Measure, Ratio, Spread};
use epas_page::document::Cell;

/// The median of a time, ns.
pub fn time(measure: &Measure, decimals: usize) -> Cell {
    if measure.is_resolved() {
        Cell::fixed(measure.median, decimals)
    } else {
        below(measure, decimals).into()
    }
}

/// The quartiles of a time, ns.
pub fn quartiles(measure: &Measure, decimals: usize) -> Cell {
    let (low, high) = measure.quartiles;
    if low >= measure.resolution {
        format!("{low:.decimals$}\u{2013}{high:.decimals$}").into()
    } else if high >= measure.resolution {
        format!("{}\u{2013}{high:.decimals$}", below(measure, decimals)).into()
    } else {
        below(measure, decimals).into()
    }
}

/// One time over another, with the quartiles of the rounds.
pub fn ratio(ratio: Ratio, decimals: usize) -> Cell {
    match ratio {
        Ratio::Is(Spread {
            median,
            quartiles: (low, high),
        }) => Cell::Number(
            median,
            format!("{median:.decimals$} ({low:.decimals$}\u{2013}{high:.decimals$})"),
        ),
        Ratio::Below(ratio) => format!("< {ratio:.decimals$}").into(),
        Ratio::Above(ratio) => format!("> {ratio:.decimals$}").into(),
        Ratio::Unknown => "not resolved".into(),
    }
}

/// Rounded up, or a resolution below the last digit would read as nothing at all.
fn below(measure: &Measure, decimals: usize) -> String {
    let unit = 10_f64.powi(decimals as i32);
    format!("< {:.decimals$}", (measure.resolution * unit).ceil() / unit)
}
