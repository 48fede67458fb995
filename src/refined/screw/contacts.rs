//! Angles and forces of a ball's contacts, as the equations take them.

use super::motion::{ScrewBallMotion, ScrewContactMotion};

/// Angles and forces of a ball's contacts, as the equations take them.
///
/// Made by [`ScrewBall::contacts`](super::ScrewBall::contacts).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ScrewContacts {
    pub(super) contact: [ScrewContact; 4],
}

/// One contact in the equations of motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct ScrewContact {
    /// `(n_x, n_z)`.
    pub(super) arm: (f32, f32),
    /// Slip along and across the track and spin of a ball at its nominal speed that does not turn.
    pub(super) along: f32,
    pub(super) across: f32,
    pub(super) spin: f32,
    /// Friction force `mu F` at full slip, N; 0 where the contact is lost.
    pub(super) friction: f32,
    /// Semi-major axis over ball radius.
    pub(super) semi_major: f32,
}

impl ScrewContact {
    #[inline]
    pub(super) fn motion(&self, motion: &ScrewBallMotion) -> ScrewContactMotion {
        let (nx, nz) = self.arm;
        let [x, y, z] = motion.turn;
        ScrewContactMotion {
            across: self.across + y,
            along: self.along + motion.speed + nx * z - nz * x,
            spin: self.spin + nx * x + nz * z,
        }
    }
}
