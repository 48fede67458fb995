//! A train as bytes: where its balls are, and how they press.

use super::ball::Ball;
use super::positions::Train;
use super::track::OVERLAP;
use super::track::Track;
use crate::error::Range;
use crate::stored::{Fingerprint, Port, Refusal, Stored};

/// Bytes that a ball takes.
pub(crate) const BALL_BYTES: usize = Ball::BYTES;

impl<const N: usize> Stored for Train<N> {
    const BYTES: usize = 4 + 1 + N * BALL_BYTES;

    /// The track stays that of the constants.
    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.number("carried", &mut self.carried, Range::new(-1.0, 1.0))?;
        let last = self.press.last();
        port.count("foremost", &mut self.press.foremost, last)?;
        self.press
            .balls_mut()
            .iter_mut()
            .try_for_each(|ball| ball.exchange(port))
    }
}

impl<const N: usize> Train<N> {
    /// Whether the balls follow each other once around the track, none of them within the next; the last ball and the foremost
    /// one may be by what rounding leaves: these two are moved before the balls in front of them.
    ///
    /// # Errors
    /// [`Refusal::OutOfRange`] naming `position`.
    pub(crate) fn in_order(&self) -> Result<(), Refusal> {
        let ahead = self.positions().skip(1).chain(self.positions().take(1));
        let around: i64 = self
            .positions()
            .zip(ahead)
            .enumerate()
            .map(|(index, (position, ahead))| {
                let gap = self.track.gap(position, ahead);
                let rounds =
                    index == usize::from(self.press.last()) || index == self.press.foremost();
                let gap = if rounds && gap > u32::MAX - OVERLAP {
                    i64::from(gap.cast_signed())
                } else {
                    i64::from(gap)
                };
                gap + i64::from(self.track.pitch())
            })
            .sum();
        if around == 1 << 32 {
            Ok(())
        } else {
            Err(Refusal::OutOfRange { field: "position" })
        }
    }
}

impl Track {
    /// Length and pitch, to the bit.
    pub(crate) fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        fingerprint.count(self.pitch());
        fingerprint.number(self.units_per_metre());
    }
}
