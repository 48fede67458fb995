//! Charts, maps, figures and tables from what differs between them.

use epas_page::document::{Block, Cell, Figure, Table};
use epas_page::plot::{Axis, Chart, ColourMap, Colours, Panel, Series};

/// A chart without texts beside its points.
pub fn chart(title: &str, x: Axis, y: Axis, series: Vec<Series>) -> Panel {
    Panel::Chart(Chart {
        title: title.into(),
        x,
        y,
        series,
        notes: Vec::new(),
    })
}

/// A map in bands of a quantity between bounds.
pub fn map(
    title: &str,
    (x, y): (Axis, Axis),
    (quantity, bounds): (&str, &[f64]),
    values: Vec<Vec<f64>>,
) -> Panel {
    let text = |bound: f64| {
        if bound.abs() < 0.01 && bound != 0.0 {
            format!("{bound:e}")
        } else {
            bound.to_string()
        }
    };
    Panel::Map(ColourMap {
        title: title.into(),
        x,
        y,
        quantity: quantity.into(),
        colours: Colours::of(bounds),
        bounds: bounds.iter().map(|bound| (*bound, text(*bound))).collect(),
        values,
    })
}

/// Centres of so many equal cells between two ends.
pub fn centres((low, high): (f64, f64), cells: usize) -> impl Iterator<Item = f64> + Clone {
    (0..cells).map(move |cell| low + (high - low) * (cell as f64 + 0.5) / cells as f64)
}

/// A figure: panels in a row, and width and height of one, pixels.
pub fn figure(
    name: &'static str,
    caption: impl Into<String>,
    (columns, width, height): (usize, u32, u32),
    panels: Vec<Panel>,
) -> Block {
    Block::Figure(Figure {
        name,
        caption: caption.into(),
        panels,
        columns,
        size: (width, height),
    })
}

/// A table; its headings with ` | ` between them.
pub fn table(
    name: &'static str,
    caption: impl Into<String>,
    columns: &str,
    rows: Vec<Vec<Cell>>,
) -> Table {
    Table {
        name,
        caption: caption.into(),
        columns: columns.split(" | ").map(str::to_owned).collect(),
        rows,
    }
}

/// Number of headings.
pub fn width(columns: &str) -> usize {
    columns.split(" | ").count()
}

/// A row of texts and then nothing, but for a text in its last cell.
pub fn told<const N: usize>(columns: &str, first: [&str; N], last: &str) -> Vec<Cell> {
    let mut row: Vec<Cell> = first.map(Cell::from).into();
    row.resize(width(columns) - 1, "".into());
    row.push(last.into());
    row
}

/// A number, or nothing where there is none.
pub fn known(value: f64, decimals: usize) -> Cell {
    if value.is_finite() {
        Cell::fixed(value, decimals)
    } else {
        "".into()
    }
}
