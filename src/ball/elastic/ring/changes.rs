//! Friction coefficient and clearance that change while balls run.

use super::{Ring, SETTLING_ROUNDS};
use crate::ball::elastic::law::RingConstants;

/// Change of the friction coefficient over it, and of the clearance, m, that balls follow without settling anew.
const SMALL_CHANGE: (f32, f32) = (0.01, 1e-8);

/// Difference of the friction coefficient from that of the last renewals, over it, from which on balls count as unsettled.
const FRICTION_BEHIND: f32 = 0.1;

impl<const N: usize> Ring<N> {
    /// Sets friction coefficient and clearance, m; balls settle where one of them jumps.
    pub(crate) fn set(&mut self, constants: &RingConstants, friction: f32, clearance: f32) {
        let (most, widest) = SMALL_CHANGE;
        let changed = (friction - self.friction).abs() > most * self.friction
            || (clearance - self.clearance).abs() > widest;
        if changed {
            self.settling = SETTLING_ROUNDS * N as u16;
        }
        self.friction = friction;
        self.clearance = clearance;
        self.lift_off = constants.ball.lift_off(clearance);
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
        if behind && self.settling == 0 {
            self.settling = 1;
        }
    }

    /// The friction coefficient over that of the last renewals: groove friction is in proportion to it to first order.
    #[inline(always)]
    pub(crate) fn friction_ahead(&self) -> f32 {
        self.friction / self.renewed_friction
    }
}
