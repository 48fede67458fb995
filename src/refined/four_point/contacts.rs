//! Angles and loads of a ball's contacts, as the equations of motion take them.

use super::motion::{BallMotion, ContactMotion};

/// Angles and loads of a ball's contacts, as the equations of motion take them.
///
/// Made by [`FourPointBall::contacts`](super::FourPointBall::contacts); one per ball and tick.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FourPointContacts {
    pub(super) contact: [FourPointContact; 4],
}

/// One contact in the equations of motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct FourPointContact {
    /// `(n_x, n_y)`: gradient of the slip in roll and yaw.
    pub(super) arm: (f32, f32),
    /// Slip and spin in nominal rolling.
    pub(super) slip: f32,
    pub(super) spin: f32,
    /// Friction force `mu F` at full slip, N; 0 where the contact is lost.
    pub(super) friction: f32,
    /// Semi-major axis over ball radius.
    pub(super) semi_major: f32,
}

impl FourPointContacts {
    /// Semi-major axis of each contact over the ball radius, in the order BL, BR, TR, TL; 0 where a
    /// contact is lost. Within 5.4e-5.
    #[must_use]
    pub fn semi_major(&self) -> [f32; 4] {
        self.contact.map(|contact| contact.semi_major)
    }
}

impl FourPointContact {
    #[inline]
    pub(super) fn motion(&self, motion: BallMotion) -> ContactMotion {
        let (roll, yaw) = self.arm;
        ContactMotion {
            slip: self.slip + motion.speed + roll * motion.roll + yaw * motion.yaw,
            spin: self.spin + yaw * motion.roll - roll * motion.yaw,
        }
    }
}
