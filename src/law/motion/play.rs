//! A backlash: what follows a turn only beyond it.

use crate::error::{Error, attempt, in_range};

/// A play of `half_width` to either side: the output follows the turn only after it has gone through the play.
///
/// `p <- clamp(p + dtheta, -h, h)`, moved `= dtheta - dp`. As wide as the noise of an encoder, it keeps a row of balls from
/// turning round with every count. What has moved and what is in the play add up to the turn, to rounding. A NaN
/// counts as no turn. Cost: 40 modelled cycles.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Play {
    pub(super) half_width: f32,
}

/// Position of the turn within its play, and direction of the output's last motion.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct PlayState {
    pub(super) position: f32,
    pub(super) direction: f32,
}

/// What the output does.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Moved {
    /// How far it moves, rad (m).
    pub turn: f32,
    /// Direction of its last motion: 1 or -1; 0 before the first.
    pub direction: f32,
}

impl PlayState {
    /// In the middle of the play, and not moved yet.
    pub const FRESH: Self = Self {
        position: 0.0,
        direction: 0.0,
    };

    /// Turn from the middle of the play, rad (m), within its half width.
    #[must_use]
    pub const fn position(&self) -> f32 {
        self.position
    }

    /// Direction of the output's last motion: 1 or -1; 0 before the first.
    #[must_use]
    pub const fn direction(&self) -> f32 {
        self.direction
    }
}

impl Play {
    /// A play of `half_width`, rad (m): 0 to 1e3. Without width the output follows every turn.
    ///
    /// # Errors
    /// `half_width` out of range.
    pub const fn new(half_width: f32) -> Result<Self, Error> {
        let half_width = attempt!(in_range("half_width", half_width, 0.0, 1e3));
        Ok(Self { half_width })
    }

    /// Half its width, rad (m).
    #[inline(always)]
    pub(crate) const fn half_width(&self) -> f32 {
        self.half_width
    }

    /// Makes a state that another play left one of this play.
    pub(crate) const fn take_over(&self, state: &mut PlayState) {
        if state.position.abs() > self.half_width {
            state.position = self.half_width.copysign(state.position);
        }
    }

    /// What the output does under a turn, rad (m).
    #[inline]
    pub fn follow(&self, state: &mut PlayState, turn: f32) -> Moved {
        let position = state.position + turn;
        let turn = if position > self.half_width {
            state.position = self.half_width;
            state.direction = 1.0;
            position - self.half_width
        } else if position < -self.half_width {
            state.position = -self.half_width;
            state.direction = -1.0;
            position + self.half_width
        } else {
            // A turn that is no number stays outside.
            if !position.is_nan() {
                state.position = position;
            }
            0.0
        };
        Moved {
            turn,
            direction: state.direction,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Play, PlayState};

    /// What a wider play left beyond this one is at its edge; what is inside stays.
    #[test]
    fn a_state_of_a_wider_play_is_cut() {
        let play = Play::new(1.0).unwrap();
        for (was, is) in [(0.5, 0.5), (-0.5, -0.5), (2.0, 1.0), (-2.0, -1.0)] {
            let mut state = PlayState {
                position: was,
                direction: 0.0,
            };
            play.take_over(&mut state);
            assert_eq!(state.position, is);
        }
    }
}
