//! Friction coefficient and clearance that change while balls run.

use super::Ring;
use super::chosen::SETTLING_ROUNDS;
use crate::ball::elastic::law::RingConstants;

/// Changes since the begin of a round that balls follow without being flagged, as their turn comes: of the friction coefficient, over it, and of the
/// clearance, m.
///
/// Of 72 screws a coefficient larger by 2 % changes the torque by 1.2 % rms more than in proportion, by 5.8 % at most; a gap
/// larger by 1e-8, 1e-7 and 1e-6 m by 0.4, 4.3 and 28 % rms, 1.5, 15 and 81 % at most (light balls, whose third contact opens).
const SMALL_CHANGE: (f32, f32) = (0.01, 1e-8);

/// Difference of the friction coefficient from that of the last renewals, over it, from which on balls count as unsettled:
/// until they are renewed their friction is taken in proportion to it.
///
/// Of 72 screws the torque of settled balls is off from that by 1.2, 3.2, 6.6, 14 and 33 % rms where the coefficient is
/// larger by 2, 5, 10, 20 and 50 %.
const FRICTION_BEHIND: f32 = 0.1;

impl<const N: usize> Ring<N> {
    /// Sets friction coefficient and clearance, m; balls settle where one of them jumps.
    pub(crate) fn set(&mut self, constants: &RingConstants, friction: f32, clearance: f32) {
        let (most, widest) = SMALL_CHANGE;
        let (old_friction, old_clearance) = self.followed;
        let changed = (friction - old_friction).abs() > most * old_friction
            || (clearance - old_clearance).abs() > widest;
        self.friction = friction;
        self.clearance = clearance;
        if changed {
            self.settling = SETTLING_ROUNDS * N as u16;
            self.follow_changes();
        }
        self.lift_off = constants.ball.lift_off(clearance);
    }

    /// What is set from now on counts from what is set now.
    pub(super) const fn follow_changes(&mut self) {
        self.followed = (self.friction, self.clearance);
    }

    /// Balls of other constants settle under these.
    pub(crate) fn take_over(&mut self, constants: &RingConstants, friction: f32, clearance: f32) {
        self.set(constants, friction, clearance);
        self.settling = SETTLING_ROUNDS * N as u16;
    }

    /// Takes a friction coefficient, 1e-6 to 0.5, that follows speed or temperature; balls take it over as their turn comes.
    #[inline(always)]
    pub(crate) fn take_friction(&mut self, friction: f32) {
        self.friction = friction;
        self.renewed_friction += (friction - self.renewed_friction) * (1.0 / N as f32);
        let behind = (friction - self.renewed_friction).abs() > FRICTION_BEHIND * friction;
        // One for this tick's renewal, which counts down, and one to be flagged.
        if behind && self.settling < 2 {
            self.settling = 2;
        }
    }

    /// The friction coefficient over that of the last renewals: groove friction is in proportion to it to first order.
    #[inline(always)]
    pub(crate) fn friction_ahead(&self) -> f32 {
        self.friction / self.renewed_friction
    }
}
