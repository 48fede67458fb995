//! The ball and its grooves, with constants folded at set-up; its contacts from angles and forces.

use super::contacts::{FourPointContact, FourPointContacts};
use super::motion::{BallMotion, ContactMotion};
use crate::ball::loaded;
use crate::contact::FrictionMap;
use crate::error::{Error, attempt};
use crate::math::{constant, inverse_cube_roots};

/// Contact angles are taken at most this far from the nominal one, rad.
pub const LARGEST_ANGLE_DEVIATION: f32 = 0.3;

/// Position of the contacts BL, BR, TR, TL about the ball's centre: signs of cosine and sine.
const QUADRANTS: [(f32, f32); 4] = [(-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0), (1.0, 1.0)];

/// A ball in a four-point contact bearing, linear or rotary, with constants folded at set-up.
///
/// Velocities are in units of the track speed `v`: the speed of the top groove of a linear bearing, or
/// inner speed times pitch radius of a rotary one. With ball speed `v_B` and rotation `omega_x`,
/// `omega_y` about the axes across the track, contact `i` at `(n_x, n_y) = (∓cos beta_i, ±sin beta_i)`
/// has
///
/// ```text
/// slip V_i = v_B + r_b (n_x omega_x + n_y omega_y) - groove speed
/// spin w_i = n_y omega_x - n_x omega_y - groove spin
/// ```
///
/// (Lin 2019, eqs. (3.11), (3.13), (3.23), (F.1)-(F.3); the printed `omega_IR`, `omega_OR` have the
/// wrong sign). Equilibrium (3.19), (3.25) says that the ball moves with the least dissipation
/// `sum D_i(V_i, w_i)`, a convex function of three unknowns. Rotary and linear bearings differ in the
/// speeds of the grooves only.
///
/// Made by [`FourPointBall::linear`] or inside [`RotaryBall`](crate::refined::RotaryBall).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FourPointBall {
    friction: f32,
    contact_angle: f32,
    cos: f32,
    sin: f32,
    speed: f32,
    inverse_speed: f32,
    pub(super) stick_spin: f32,
    lower: FourPointGroove,
    upper: FourPointGroove,
}

/// One groove, in units of ball radius and track speed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct FourPointGroove {
    pub(super) map: FrictionMap,
    /// Semi-major axis over ball radius at one newton, `N^(-1/3)`.
    pub(super) semi_major: f32,
    /// Rotation of the ball relative to the groove, about the axis across, in nominal rolling.
    pub(super) roll: f32,
}

impl FourPointBall {
    pub(super) const fn folded(
        friction: f32,
        contact_angle: f32,
        speed: f32,
        stick_spin: f32,
        lower: FourPointGroove,
        upper: FourPointGroove,
    ) -> Self {
        let (sin, cos) = constant::sin_cos(contact_angle);
        Self {
            friction,
            contact_angle,
            cos,
            sin,
            speed,
            inverse_speed: 1.0 / speed,
            stick_spin,
            lower,
            upper,
        }
    }

    /// Speed of the ball in nominal rolling, in units of the track speed.
    #[must_use]
    pub const fn nominal_speed(&self) -> f32 {
        self.speed
    }

    /// `r_b omega_x` of the ball in nominal rolling, in units of the track speed.
    #[must_use]
    pub const fn nominal_roll(&self) -> f32 {
        // The upper groove does not turn about the axis across the track: the ball's rotation against it is its
        // absolute one.
        self.upper.roll
    }

    /// Contacts from their angles, rad, and forces, N, in the order BL, BR, TR, TL.
    ///
    /// An angle further than [`LARGEST_ANGLE_DEVIATION`] from the nominal one is taken at that limit, NaN
    /// as the nominal one; a force up to zero, above 1e7 N, or NaN is a lost contact. Sine and cosine
    /// come from their series about the nominal angle, within 1e-6 at the limit and exact in f32 up to 0.15 rad. Cost: 425 modelled cycles.
    #[inline(always)]
    #[must_use]
    pub fn contacts(
        &self,
        contact_angles: &[f32; 4],
        contact_forces: &[f32; 4],
    ) -> FourPointContacts {
        let [bottom_left, bottom_right, top_right, top_left] = contact_forces.map(loaded);
        let [left, right] = inverse_cube_roots([bottom_left, bottom_right]);
        let [far_right, far_left] = inverse_cube_roots([top_right, top_left]);
        let loads = [
            (bottom_left, left),
            (bottom_right, right),
            (top_right, far_right),
            (top_left, far_left),
        ];
        let mut contact = [FourPointContact::default(); 4];
        let given = contact_angles.iter().zip(loads);
        for (((contact, given), quadrant), groove) in contact
            .iter_mut()
            .zip(given)
            .zip(&QUADRANTS)
            .zip(self.grooves())
        {
            let (&angle, (force, root)) = given;
            let deviation = limited_angle(angle - self.contact_angle);
            let square = deviation * deviation;
            let sin = deviation - deviation * square * (1.0 / 6.0 - square * (1.0 / 120.0));
            let versine = square * (0.5 - square * (1.0 / 24.0));
            let cos_change = self.cos * versine + self.sin * sin;
            let sin_now = self.sin + (self.cos * sin - self.sin * versine);

            let (right, left) = *quadrant;
            let yaw_arm = left * sin_now;
            contact.arm = (right * (self.cos - cos_change), yaw_arm);
            contact.slip = -right * cos_change * groove.roll;
            contact.spin = yaw_arm * groove.roll;
            contact.friction = self.friction * force;
            contact.semi_major = groove.semi_major * (force * root * root);
        }
        FourPointContacts { contact }
    }

    /// Slip and spin of the four contacts at a motion.
    #[must_use]
    pub fn contact_motion(
        &self,
        contacts: &FourPointContacts,
        motion: &BallMotion,
    ) -> [ContactMotion; 4] {
        contacts.contact.map(|contact| contact.motion(*motion))
    }

    /// Relative speed deviation of a motion.
    #[inline]
    pub(super) fn speed_deviation(&self, speed: f32) -> f32 {
        speed * self.inverse_speed
    }

    #[inline]
    pub(super) fn grooves(&self) -> [&FourPointGroove; 4] {
        [&self.lower, &self.lower, &self.upper, &self.upper]
    }

    /// Potential and power loss at a motion, N.
    #[inline]
    pub(super) fn dissipation(
        &self,
        contacts: &FourPointContacts,
        motion: BallMotion,
    ) -> (f32, f32) {
        let mut potential = 0.0;
        let mut power = 0.0;
        for (contact, groove) in contacts.contact.iter().zip(self.grooves()) {
            if contact.friction > 0.0 {
                let ContactMotion { slip, spin } = contact.motion(motion);
                let at = groove
                    .map
                    .dissipation(slip, spin, contact.semi_major, self.stick_spin);
                potential += contact.friction * at.potential;
                power += contact.friction * at.power;
            }
        }
        (potential, power)
    }
}

impl FourPointGroove {
    pub(super) const fn new(
        axis_ratio: f32,
        semi_major: f32,
        ball_radius: f32,
        roll: f32,
    ) -> Result<Self, Error> {
        Ok(Self {
            map: attempt!(FrictionMap::new(axis_ratio)),
            semi_major: semi_major / ball_radius,
            roll,
        })
    }
}

/// An angle's deviation within the limits of the series; NaN gives zero.
#[inline]
fn limited_angle(deviation: f32) -> f32 {
    if deviation.abs() <= LARGEST_ANGLE_DEVIATION {
        deviation
    } else if deviation.is_nan() {
        0.0
    } else {
        LARGEST_ANGLE_DEVIATION.copysign(deviation)
    }
}
