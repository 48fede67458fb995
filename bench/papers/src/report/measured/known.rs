//! Cells of numbers that may not be known.

use epas_page::document::Cell;

/// A number, or nothing where there is none.
pub fn known(value: f64, decimals: usize) -> Cell {
    if value.is_finite() {
        Cell::fixed(value, decimals)
    } else {
        "".into()
    }
}
