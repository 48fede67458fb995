//! Axes, linear and logarithmic.

use std::ops::Range;

/// How a quantity is laid out along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// In proportion.
    Linear,
    /// In proportion to the logarithm; only positive numbers have a place.
    Log,
}

/// An axis: its label with the unit, its scale, and its ends where they do not follow from the data.
#[derive(Clone, Debug)]
pub struct Axis {
    /// Quantity and unit.
    pub label: String,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// Ends of the axis.
    pub ends: Option<(f64, f64)>,
}

impl Axis {
    /// A linear axis over the data.
    pub fn linear(label: &str) -> Self {
        Self {
            label: label.into(),
            scale: Scale::Linear,
            ends: None,
        }
    }

    /// A logarithmic axis over the data, widened to whole decades.
    pub fn log(label: &str) -> Self {
        Self {
            scale: Scale::Log,
            ..Self::linear(label)
        }
    }

    /// This axis with the ends given.
    #[must_use]
    pub fn between(self, start: f64, end: f64) -> Self {
        Self {
            ends: Some((start, end)),
            ..self
        }
    }

    /// Place of a value on the axis, where it has one.
    pub fn place(&self, value: f64) -> Option<f64> {
        let place = match self.scale {
            Scale::Linear => value,
            Scale::Log => value.log10(),
        };
        place.is_finite().then_some(place)
    }

    /// Both ends as places, wide enough for all `values`.
    pub fn range(&self, values: impl Iterator<Item = f64>) -> Range<f64> {
        if let Some((start, end)) = self.ends
            && let (Some(start), Some(end)) = (self.place(start), self.place(end))
        {
            return start..end;
        }
        let (start, end) = values
            .filter_map(|value| self.place(value))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(start, end), place| {
                (start.min(place), end.max(place))
            });
        if start > end {
            return 0.0..1.0;
        }
        match self.scale {
            Scale::Log => {
                let (start, end) = (start.floor(), end.ceil());
                start..end.max(start + 1.0)
            }
            Scale::Linear => {
                let margin = if end > start {
                    0.04 * (end - start)
                } else {
                    0.5 * start.abs().max(1e-3)
                };
                // An axis that starts at zero keeps its zero at the edge.
                let low = if start >= 0.0 && start < margin {
                    0.0
                } else {
                    start - margin
                };
                low..end + margin
            }
        }
    }

    /// Number of labels to ask for.
    pub fn labels(&self, range: &Range<f64>) -> usize {
        match self.scale {
            Scale::Linear => 7,
            // One a decade while they have room.
            Scale::Log => ((range.end - range.start).round() as usize + 1).min(10),
        }
    }

    /// Text at a place.
    pub fn text(&self, place: f64, range: &Range<f64>) -> String {
        match self.scale {
            Scale::Linear => linear_text(place, range.end - range.start),
            Scale::Log => log_text(place),
        }
    }
}

fn linear_text(value: f64, span: f64) -> String {
    let value = if value.abs() < 1e-9 * span {
        0.0
    } else {
        value
    };
    // Ticks are about a tenth of the span apart; one digit more than that tells them apart.
    let decimals = (1.0 - (span / 10.0).log10().floor()).clamp(0.0, 9.0) as usize;
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        &text
    };
    text.replace('-', "\u{2212}")
}

/// A power of ten: in full where it is short.
fn log_text(place: f64) -> String {
    let exponent = place.round();
    if (place - exponent).abs() > 1e-6 {
        return String::new();
    }
    if (-2.0..=3.0).contains(&exponent) {
        return format!("{}", 10f64.powf(exponent));
    }
    let digits: String = format!("{exponent}")
        .chars()
        .map(|digit| match digit {
            '-' => '\u{207b}',
            '1' => '\u{b9}',
            '2' => '\u{b2}',
            '3' => '\u{b3}',
            other => char::from_u32(0x2070 + u32::from(other) - u32::from('0')).unwrap_or(other),
        })
        .collect();
    format!("10{digits}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_short_and_exact() {
        assert_eq!(linear_text(-0.5, 2.0), "\u{2212}0.5");
        assert_eq!(linear_text(20.0, 80.0), "20");
        assert_eq!(linear_text(0.1 + 0.2 - 0.3, 1.0), "0");
        assert_eq!(log_text(-7.0), "10\u{207b}\u{2077}");
        assert_eq!(log_text(2.0), "100");
        assert_eq!(log_text(0.5), "");
    }

    #[test]
    fn a_constant_still_has_an_axis() {
        let range = Axis::linear("").range([3.0, 3.0].into_iter());
        assert!(range.start < 3.0 && range.end > 3.0);
        let range = Axis::log("").range([1e-3].into_iter());
        assert!(range.end > range.start);
        let nothing = Axis::linear("").range(std::iter::empty());
        assert!(nothing.end > nothing.start);
    }
}
