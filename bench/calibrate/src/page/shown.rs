//! Numbers, tables and charts as pages, comments and a terminal show them.

use epas_page::document::{Cell, Table};
use epas_page::plot::{Axis, Chart, Panel, Series};

/// A number with so many significant digits, by powers of ten where it is very large or very small.
pub fn digits(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return value.to_string();
    }
    if value == 0.0 {
        return "0".into();
    }
    let scientific = format!("{value:.0$e}", digits.saturating_sub(1));
    // What rounding makes of it decides, so that 0.99996 is shown as 1.000.
    let exponent = scientific
        .split_once('e')
        .and_then(|(_, exponent)| exponent.parse::<i32>().ok())
        .unwrap_or(0);
    if (-3..5).contains(&exponent) {
        let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
        format!("{value:.decimals$}")
    } else {
        scientific
    }
}

pub fn interval(low: f64, high: f64) -> String {
    match (low.is_finite(), high.is_finite()) {
        (true, true) => format!("{} to {}", digits(low, 4), digits(high, 4)),
        (true, false) => format!("{} or more", digits(low, 4)),
        (false, true) => format!("{} or less", digits(high, 4)),
        (false, false) => "without bounds".into(),
    }
}

/// A text in one line, without control characters, cut to 200 letters: for comments of a file.
pub fn one_line(text: &str) -> String {
    text.chars()
        .map(|letter| if letter.is_control() { ' ' } else { letter })
        .take(200)
        .collect()
}

pub fn number(value: f64) -> Cell {
    Cell::Number(value, digits(value, 4))
}

pub fn perhaps(value: Option<f64>) -> Cell {
    value.map_or("".into(), number)
}

/// A table, whose headings stand in one text: `parameter | value`.
pub fn table(
    name: &'static str,
    caption: &str,
    columns: &str,
    rows: impl Iterator<Item = Vec<Cell>>,
) -> Table {
    Table {
        name,
        caption: caption.into(),
        columns: columns.split(" | ").map(String::from).collect(),
        rows: rows.collect(),
    }
}

pub fn chart(title: &str, x: Axis, y: Axis, series: Vec<Series>) -> Panel {
    Panel::Chart(Chart {
        title: title.into(),
        x,
        y,
        series,
        notes: Vec::new(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_significant_and_intervals_say_where_nothing_bounds_them() {
        for (value, count, shown) in [
            (0.115_234, 4, "0.1152"),
            (0.999_96, 4, "1.000"),
            (-3.165_4e-5, 3, "-3.17e-5"),
            (95_109.4, 4, "95109"),
            (0.0, 4, "0"),
            (f64::NAN, 4, "NaN"),
        ] {
            assert_eq!(digits(value, count), shown);
        }
        for (low, high, shown) in [
            (0.1, 0.2, "0.1000 to 0.2000"),
            (0.1, f64::INFINITY, "0.1000 or more"),
            (f64::NEG_INFINITY, 2.0, "2.000 or less"),
            (f64::NAN, f64::NAN, "without bounds"),
        ] {
            assert_eq!(interval(low, high), shown);
        }
    }
}
