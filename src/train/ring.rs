//! Around the ring of balls, once.

use core::mem::take;

use super::ball::Ball;

/// The two rows of a ring that opens in front of its foremost ball, in the order in which a walk meets them: the balls
/// up to the foremost one and those beyond it when it goes backwards from there, the other way round when it goes
/// forwards. Within a row the walker takes the balls backwards or forwards itself.
///
/// An iterator over single balls would test in each step which of the two rows it is in; that is 5 % of a tick.
pub(super) struct Rows<'balls> {
    next: &'balls mut [Ball],
    last: &'balls mut [Ball],
}

impl<'balls> Rows<'balls> {
    /// For a walk from the foremost ball backwards.
    #[inline(always)]
    pub(super) fn backwards(balls: &'balls mut [Ball], foremost: usize) -> Self {
        let (next, last) = split(balls, foremost);
        Self { next, last }
    }

    /// For a walk forwards that ends with the foremost ball.
    #[inline(always)]
    pub(super) fn forwards(balls: &'balls mut [Ball], foremost: usize) -> Self {
        let (last, next) = split(balls, foremost);
        Self { next, last }
    }
}

impl<'balls> Iterator for Rows<'balls> {
    type Item = &'balls mut [Ball];

    #[inline(always)]
    fn next(&mut self) -> Option<Self::Item> {
        if self.next.is_empty() {
            self.next = take(&mut self.last);
        }
        let row = take(&mut self.next);
        (!row.is_empty()).then_some(row)
    }
}

/// Balls up to the foremost one, and those beyond.
#[inline(always)]
fn split(balls: &mut [Ball], foremost: usize) -> (&mut [Ball], &mut [Ball]) {
    balls.split_at_mut_checked(foremost + 1).unwrap_or_default()
}
