//! How far balls get in a tick.

use super::ball::Ball;

/// A position keeps sixteenths of a unit: slow balls move by less than a unit in a tick.
pub(super) const SIXTEENTHS: f32 = 16.0;
const SIXTEENTH_BITS: u32 = 4;

/// Distances this far below zero, in units, are contact: rounding of two positions leaves a few units. Many times that, and still
/// a tenth of a micrometre on half a metre.
pub(super) const OVERLAP: u32 = 1 << 10;

/// How far a ball's speed moves it in a tick.
#[derive(Clone, Copy)]
pub(super) struct Motion {
    /// Whole units that the nominal speed moves every ball, signed along the track.
    pub(super) nominal: u32,
    /// Sixteenths of a unit by which a ball moves beyond that, over its speed.
    pub(super) sixteenths_per_speed: f32,
    /// Distance of the centres of two balls in contact, in units.
    pub(super) pitch: u32,
}

impl Motion {
    /// Balls stay where they are.
    pub(super) const NONE: Self = Self {
        nominal: 0,
        sixteenths_per_speed: 0.0,
        pitch: 0,
    };

    /// A place that no ball comes near in this tick, a quarter of the track in front of where this one goes.
    #[inline(always)]
    pub(super) fn far_ahead(&self, ball: &Ball) -> u32 {
        ball.position()
            .wrapping_add(self.nominal.wrapping_add(1 << 30))
    }

    /// Moves a ball by its speed, at most to `limit`, where it touches the one in front; gives where the one behind
    /// touches this one.
    #[inline(always)]
    pub(super) fn advance(&self, ball: &mut Ball, limit: u32) -> u32 {
        let sixteenths = (ball.speed() * self.sixteenths_per_speed) as i32;
        let sixteenths = sixteenths.wrapping_add(ball.sixteenths());
        let place = ball.position().wrapping_add(self.nominal);
        let place = place.wrapping_add_signed(sixteenths >> SIXTEENTH_BITS);
        // Clusters do not run into each other, but rounding may leave that much.
        let place = if limit.wrapping_sub(place) > u32::MAX - OVERLAP {
            limit
        } else {
            place
        };
        ball.set_position(place);
        ball.keep_sixteenths(sixteenths);
        self.touching(place)
    }

    /// Where the ball behind touches one at a place.
    #[inline(always)]
    pub(super) fn touching(&self, place: u32) -> u32 {
        place.wrapping_sub(self.pitch)
    }
}
