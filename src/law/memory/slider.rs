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

/// How much over 1 the shares of `count` elements add up to, so that rounding cannot leave the sum of full sliding
/// below the limit; the sum is then cut to the limit.
///
/// `2^-24` for each addition, and six for the roundings of a share, its product and the excess itself.
pub(super) const fn excess(count: usize) -> f32 {
    1.0 + 0.5 * f32::EPSILON * (count as f32 + 6.0)
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
