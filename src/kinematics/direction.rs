//! A contact angle resolved against the path and the axis of rotation, and whether the ball can roll there.

use super::parameters::{EllipticContact, KinematicsParameters};
use super::path::{GroovePath, Path};
use crate::error::{Error, Range, attempt};
use crate::geometry::Groove;
use crate::math::{self, constant};
use core::f32::consts::FRAC_PI_2;

/// Least `b_k`, the speed of the ball's surface at the contact in units of `omega_R r'_k`. Below it
/// (an axis of rotation within 15° of the contact normal) the ball drills more than it rolls, and
/// spin speed loses digits as `1 / b_k`.
pub(super) const LEAST_GRIP: f32 = 0.25;
/// Least part of `q = r_m / cos psi` that `A_k` may keep.
const LEAST_REACH: f32 = 0.1;

/// A contact angle, resolved against path and axis of rotation.
pub(super) struct Direction {
    pub sine: f32,
    pub cosine: f32,
    /// `A_k / r'_k`.
    pub reach: f32,
    /// `b_k`.
    pub grip: f32,
    /// Semi-axes of the ellipse, m.
    pub semi_major: f32,
    pub semi_minor: f32,
}

impl Direction {
    /// True where the ball's surface moves fast enough at the contact to roll there.
    #[inline]
    pub const fn grips(&self) -> bool {
        self.grip >= LEAST_GRIP
    }

    /// True where the ball's path does not fold past the axis.
    #[inline]
    pub const fn reaches(&self, groove_path: &GroovePath) -> bool {
        self.reach >= LEAST_REACH * groove_path.path_over_rolling
    }
}

impl Path {
    /// Resolves one contact.
    #[inline(always)]
    pub fn direction(
        &self,
        groove_path: &GroovePath,
        contact: EllipticContact,
        groove: Groove,
    ) -> Direction {
        let sin_cos = math::sin_cos(contact.contact_angle);
        self.resolved(sin_cos, groove_path, contact, groove)
    }

    /// The same for set-up, by the kernel that a constant can take.
    pub const fn constant_direction(
        &self,
        groove_path: &GroovePath,
        contact: EllipticContact,
        groove: Groove,
    ) -> Direction {
        let sin_cos = constant::sin_cos(contact.contact_angle);
        self.resolved(sin_cos, groove_path, contact, groove)
    }

    #[inline(always)]
    const fn resolved(
        &self,
        (sine, cosine): (f32, f32),
        groove_path: &GroovePath,
        contact: EllipticContact,
        groove: Groove,
    ) -> Direction {
        Direction {
            sine,
            cosine,
            reach: groove_path.path_over_rolling - groove.sign() * self.cos_lead * cosine,
            grip: self.axis_binormal * cosine + self.axis_normal * sine,
            semi_major: contact.semi_major,
            semi_minor: contact.semi_minor,
        }
    }

    /// Directions of both contacts, or the field that keeps the ball from rolling.
    pub const fn checked_directions(
        &self,
        parameters: &KinematicsParameters,
    ) -> Result<(Direction, Direction), Error> {
        let screw = self.constant_direction(&self.screw, parameters.screw(), Groove::Screw);
        let nut = self.constant_direction(&self.nut, parameters.nut(), Groove::Nut);
        attempt!(self.check(&screw, &self.screw, Groove::Screw, parameters));
        attempt!(self.check(&nut, &self.nut, Groove::Nut, parameters));
        Ok((screw, nut))
    }

    const fn check(
        &self,
        direction: &Direction,
        groove_path: &GroovePath,
        groove: Groove,
        parameters: &KinematicsParameters,
    ) -> Result<(), Error> {
        let (angle_field, angle, radius_field) = match groove {
            Groove::Screw => (
                "contact_angle_screw",
                parameters.contact_angle_screw,
                "rolling_radius_screw",
            ),
            Groove::Nut => (
                "contact_angle_nut",
                parameters.contact_angle_nut,
                "rolling_radius_nut",
            ),
        };
        if !direction.grips() {
            return Err(Error::OutOfRange {
                field: angle_field,
                value: angle,
                allowed: Range::new(
                    self.last_grip(parameters.pitch_angle, -FRAC_PI_2),
                    self.last_grip(parameters.pitch_angle, FRAC_PI_2),
                ),
            });
        }
        if !direction.reaches(groove_path) {
            // A >= 0.1 q, that is r' cos(alpha) cos^2(psi) <= 0.9 r_m, with q = r_m / cos(psi).
            let limit =
                (1.0 - LEAST_REACH) * self.radius / (self.cos_lead * direction.cosine.abs());
            return Err(Error::folded(
                radius_field,
                groove_path.rolling_radius,
                0.25 * parameters.ball_diameter,
                limit,
            ));
        }
        Ok(())
    }

    /// The contact angle, rad, next to `bound` at which the ball still grips.
    ///
    /// `b = h cos(alpha) + sin(beta) sin(alpha)` is a cosine about the pitch angle, which yaw narrows but
    /// leaves above 0.87 there: halving the way from it to the bound finds the one place where the grip ends,
    /// by the numbers that a check of the angle would form.
    const fn last_grip(&self, pitch_angle: f32, bound: f32) -> f32 {
        const HALVINGS: u32 = 24;
        if self.grip_at(bound) >= LEAST_GRIP {
            return bound;
        }
        let (mut inside, mut outside) = (pitch_angle, bound);
        let mut halving = 0;
        while halving < HALVINGS {
            let middle = 0.5 * (inside + outside);
            if self.grip_at(middle) >= LEAST_GRIP {
                inside = middle;
            } else {
                outside = middle;
            }
            halving += 1;
        }
        inside
    }

    /// `b` at a contact angle, rad.
    const fn grip_at(&self, contact_angle: f32) -> f32 {
        let (sine, cosine) = constant::sin_cos(contact_angle);
        self.axis_binormal * cosine + self.axis_normal * sine
    }
}
