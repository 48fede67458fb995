//! Roots by halving an interval.

/// Halvings: 24 for the digits of an f32, and 16 for roots that are small beside the interval.
const HALVINGS: u8 = 40;

/// Upper end of the interval in which `is_below` changes from true to false, after 40 halvings of the interval from `low` to `high`.
pub fn first_not_below(mut low: f32, mut high: f32, is_below: impl Fn(f32) -> bool) -> f32 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if is_below(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}
