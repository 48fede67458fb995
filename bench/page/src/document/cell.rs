//! One value of a table: what it is, and how each form of a report shows it.

use serde_json::{Value, json};

/// One value of a table: what it is and how it is shown.
#[derive(Clone, Debug)]
pub enum Cell {
    /// A text.
    Text(String),
    /// A number and its shown form.
    Number(f64, String),
    /// A line for a program, which a page folds.
    Code(String),
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.into())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl Cell {
    /// A number with so many decimals; a zero that rounding leaves has no sign.
    pub fn fixed(value: f64, decimals: usize) -> Self {
        let text = format!("{value:.decimals$}");
        let zero = text.bytes().all(|byte| matches!(byte, b'-' | b'0' | b'.'));
        let text = if zero { text.replace('-', "") } else { text };
        Self::Number(value, text)
    }

    /// A number with two significant digits: in full where that is short, else with its power of ten.
    pub fn power(value: f64) -> Self {
        let size = value.abs();
        let text = if value == 0.0 {
            "0".into()
        } else if (1e-3..1e4).contains(&size) {
            let decimals = (1.0 - size.log10().floor()).max(0.0) as usize;
            format!("{value:.decimals$}")
        } else {
            format!("{value:.1e}")
        };
        Self::Number(value, text)
    }

    /// How it reads in a text.
    pub fn shown(&self) -> &str {
        match self {
            Self::Text(text) | Self::Number(_, text) | Self::Code(text) => text,
        }
    }

    /// Whether it is a number.
    pub const fn is_number(&self) -> bool {
        matches!(self, Self::Number(..))
    }

    /// The value for a program.
    pub fn json(&self) -> Value {
        match self {
            Self::Text(text) | Self::Code(text) => json!(text),
            Self::Number(value, _) => json!(value),
        }
    }

    /// The value in a table for a program.
    pub fn csv(&self) -> String {
        match self {
            Self::Text(text) | Self::Code(text) => text.clone(),
            Self::Number(value, _) => value.to_string(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_have_no_idle_sign() {
        let shown = |cell: Cell| cell.shown().to_owned();
        assert_eq!(shown(Cell::fixed(-1e-9, 3)), "0.000");
        assert_eq!(shown(Cell::fixed(-0.25, 1)), "-0.2");
        assert_eq!(shown(Cell::power(7.1)), "7.1");
        assert_eq!(shown(Cell::power(-0.0251)), "-0.025");
        assert_eq!(shown(Cell::power(521.4)), "521");
        assert_eq!(shown(Cell::power(3.2e-7)), "3.2e-7");
        assert_eq!(shown(Cell::power(13102330.0)), "1.3e7");
        assert_eq!(shown(Cell::power(0.0)), "0");
    }
}
