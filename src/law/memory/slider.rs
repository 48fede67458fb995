//! What a slider lets through, by comparisons in an order that ends at a limit where a number is none.

use crate::law::SlidingLimits;

/// `force`, or the limit that it is beyond; `high` where it is no number.
#[inline(always)]
pub(super) fn held(force: f32, low: f32, high: f32) -> f32 {
    let force = if force < high { force } else { high };
    if force > low { force } else { low }
}

/// A quantity that is not negative: 0 where it is, and where it is no number.
#[inline(always)]
pub(super) fn not_negative(value: f32) -> f32 {
    if value > 0.0 { value } else { 0.0 }
}

/// A turn: none where it is no number.
#[inline(always)]
pub(super) fn turned(turn: f32) -> f32 {
    if turn.is_nan() { 0.0 } else { turn }
}

/// The sum of `count` elements: the limit itself where all of them slide, whatever rounding has made of their sum.
///
/// Rounding takes from the sum at most `2^-24` for each addition, and five for the roundings of a share (three), its
/// product and the comparison. A sum as near to the limit without all elements sliding is off by as little.
#[inline(always)]
pub(super) fn sum(friction: f32, count: usize, low: f32, high: f32) -> f32 {
    let almost = 1.0 - 0.5 * f32::EPSILON * (count as f32 + 4.0);
    let friction = if friction < almost * high {
        friction
    } else {
        high
    };
    if friction > almost * low {
        friction
    } else {
        low
    }
}

/// How much of the limit `friction` leaves: 1 at no friction, 0 in full sliding, and 0 without a limit.
///
/// `1 - |T| / T±`, of 0 to 1. A mechanism stands as long as some share sticks, whatever its speed.
#[inline]
#[must_use]
pub fn sticking_share(friction: f32, limits: &SlidingLimits) -> f32 {
    let (size, limit) = if friction < 0.0 {
        (-friction, limits.backward)
    } else {
        (friction, limits.forward)
    };
    if size < limit {
        1.0 - size / limit
    } else {
        0.0
    }
}
