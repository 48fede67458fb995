//! The linear equations of a ball's motion: force along the track, moments about three axes.

use super::contacts::ScrewContact;
use crate::contact::SlipFriction;
use crate::refined::symmetric::{System, Vector};

/// Impedance that keeps a rotation as it is, N: far above any contact's. From 1e6 to 1e15 all digits of the results are the
/// same.
const HELD: f32 = 1e12;

/// Impedance against a rotation that no contact resists, N.
const FREE: f32 = 1e-9;

/// Change of `(speed, Omega_x, Omega_y, Omega_z)`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct MotionChange {
    pub(super) speed: f32,
    pub(super) x: f32,
    pub(super) y: f32,
    pub(super) z: f32,
}

impl MotionChange {
    pub(super) const ZERO: Self = Self {
        speed: 0.0,
        x: 0.0,
        y: 0.0,
        z: 0.0,
    };

    fn new(found: Vector, y: f32) -> Self {
        Self {
            speed: found.speed,
            x: found.roll,
            y,
            z: found.yaw,
        }
    }
}

/// Four symmetric equations, of which that of `Omega_y` stands apart, to be eliminated.
pub(super) struct Equations {
    /// Those of `Omega_x` (roll), `Omega_z` (yaw) and the speed.
    system: System,
    /// Coefficients of `Omega_y` in them.
    coupling: Vector,
    /// Coefficient of `Omega_y` in its own equation.
    diagonal: f32,
    /// Right side of that equation.
    right: f32,
}

/// What the equations give.
pub(super) struct Solution {
    /// Change of the motion without a force along the track.
    pub(super) free: MotionChange,
    /// Change per unit force along the track.
    pub(super) column: MotionChange,
    /// Right side times the free change.
    pub(super) decrement: f32,
}

impl Equations {
    /// No contact yet, and a moment about y; with `held`, `Omega_y` stays as it is.
    #[inline(always)]
    pub(super) const fn new(moment_y: f32, held: bool) -> Self {
        Self {
            system: System::EMPTY,
            coupling: Vector::ZERO,
            diagonal: if held { HELD } else { FREE },
            right: moment_y,
        }
    }

    /// Adds a contact's forces and impedances: `force` along the track over `mu F`, and stiffness against slip
    /// along and across it.
    ///
    /// The impedances `s11 r1² + 2 s12 r1 r2 + s22 r2²` with `r1 = dy - t1 d`, `r2 = slip - t2 d`, `d` the row of the
    /// spin, are added as `s22 (r2 + s12/s22 r1)² + (s11 - s12²/s22) r1²`.
    #[inline(always)]
    pub(super) fn add(
        &mut self,
        contact: &ScrewContact,
        friction: &SlipFriction,
        force: f32,
        (along, across): (f32, f32),
    ) {
        let (nx, nz) = contact.arm;
        let weight = contact.friction;
        let (force, moment) = (weight * force, weight * friction.moment);
        self.system.right.roll += force * nz - moment * nx;
        self.system.right.yaw -= force * nx + moment * nz;
        self.system.right.speed -= force;
        self.right -= weight * friction.across;

        let mixed = friction.stiffness_mixed / along;
        let tilt = friction.tilt_along + mixed * friction.tilt_across;
        let (roll, yaw) = (-nz - tilt * nx, nx - tilt * nz);
        let stiffness = weight * along;
        self.system.add_slip(stiffness, roll, yaw);
        let remainder = weight * (across - mixed * friction.stiffness_mixed);
        let spun = remainder * friction.tilt_across;
        self.system.add_spin(
            spun * friction.tilt_across + weight * friction.stick,
            nx,
            nz,
        );
        let coupling = stiffness * mixed;
        self.diagonal += remainder + coupling * mixed;
        self.coupling.roll += coupling * roll - spun * nx;
        self.coupling.yaw += coupling * yaw - spun * nz;
        self.coupling.speed += coupling;
    }

    /// The solution, with a force along the track and moments about x and z from outside.
    #[inline(always)]
    pub(super) fn solve(mut self, force: f32, moment_x: f32, moment_z: f32) -> Solution {
        self.system.right.speed += force;
        self.system.right.roll += moment_x;
        self.system.right.yaw += moment_z;
        let (coupling, right) = (self.coupling, self.right);
        let inverse = 1.0 / self.diagonal;
        let whole = self.system.right;
        let reduced = Vector {
            roll: whole.roll - coupling.roll * right * inverse,
            yaw: whole.yaw - coupling.yaw * right * inverse,
            speed: whole.speed - coupling.speed * right * inverse,
        };
        self.system.subtract(coupling, inverse);
        let factors = self.system.factors();
        let complete = |found: Vector, right: f32| {
            MotionChange::new(found, (right - coupling.dot(found)) * inverse)
        };
        let found = factors.solve(reduced);
        let free = complete(found, right);
        Solution {
            free,
            column: complete(factors.speed_column(), 0.0),
            decrement: whole.dot(found) + right * free.y,
        }
    }
}
