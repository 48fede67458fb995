//! How friction passes between its two directions, and what moves.

use crate::error::{Error, attempt, in_range};
use crate::math;

/// Where friction is between its two directions in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ReversalState {
    /// Factor on sliding friction, with the sign of the direction in which friction opposes motion: -1 to 1, times the
    /// [level](crate::law::FrictionLevel) of that direction where one is set.
    pub factor: f32,
    /// Part of the forces between balls that friction of the grooves carries, 0 to 1: with memory the size of the factor, without its
    /// level; 1 in a scene without memory, whose forces are those of sliding at any speed.
    pub carried: f32,
    /// -1 where the motion goes, or went last, in the negative direction, else 1.
    pub direction: f32,
    /// Whether the mechanism stands: friction is between its two directions.
    pub standing: bool,
}

/// Inputs of a scene that moves under loads.
pub trait Motion: Copy + core::fmt::Debug + PartialEq {
    /// Neither speed nor loads.
    const STILL: Self;

    /// Speed of the nut, rad/s, or of the carriage, m/s.
    fn speed(&self) -> f32;

    /// Axial load of a screw, normal load of a bearing, N.
    fn load(&self) -> f32;

    /// These inputs with another speed, and with their loads times a factor.
    #[must_use]
    fn with(self, speed: f32, load_factor: f32) -> Self;
}

/// How friction passes through zero with the speed: as `w / sqrt(w^2 + w_s^2)` with the speed `w`, rad/s
/// (m/s), and the reversal speed `w_s`, at which it is 71 %.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Reversal {
    speed: f32,
    squared: f32,
}

impl Reversal {
    /// With a reversal speed in the unit of the scene's speed.
    ///
    /// # Errors
    /// [`Error`] naming `reversal_speed`.
    pub(super) const fn new(
        reversal_speed: f32,
        minimum: f32,
        maximum: f32,
    ) -> Result<Self, Error> {
        let speed = attempt!(in_range("reversal_speed", reversal_speed, minimum, maximum));
        Ok(Self {
            speed,
            squared: speed * speed,
        })
    }

    /// Factor on sliding friction at a speed, -1 to 1, with the speed's sign.
    #[inline(always)]
    pub(super) fn factor(&self, speed: f32) -> f32 {
        speed / math::sqrt(speed * speed + self.squared)
    }

    /// The reversal state at a speed; standstill counts as forward.
    #[inline(always)]
    pub(super) fn at(&self, speed: f32) -> ReversalState {
        ReversalState {
            factor: self.factor(speed),
            carried: 1.0,
            direction: direction(speed),
            standing: self.stands(speed),
        }
    }

    /// Whether a speed is below the reversal speed, in either direction.
    #[inline(always)]
    pub(super) const fn stands(&self, speed: f32) -> bool {
        speed.abs() < self.speed
    }
}

/// -1 where a speed is negative, else 1.
#[inline(always)]
pub(super) const fn direction(speed: f32) -> f32 {
    if speed < 0.0 { -1.0 } else { 1.0 }
}
