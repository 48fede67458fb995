//! A ball in a rotary four-point contact bearing.

use super::ball::{FourPointBall, FourPointGroove};
use super::contacts::FourPointContacts;
use super::motion::BallState;
use crate::contact::SMALLEST_AXIS_RATIO;
use crate::error::{Error, attempt, in_range};
use crate::math::constant;
use crate::ranges;

/// Spin below which a contact counts as sticking, over `omega_I sin(beta_0)`, the sum of the spins of the two contacts of a
/// diagonal in two-point rolling. Where they share it by halves the loss changes by the order of `(0.02/0.5)²`, 1.6e-3
/// (measured: 7e-4 at most of the torques of Table 3.2).
const STICK_SPIN: f32 = 0.02;

/// Dimensions of a four-point contact rotary bearing and of its contact ellipses.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct RotaryBallParameters {
    /// Ball radius `r_b`, m; 1e-5 to 1.
    pub ball_radius: f32,
    /// Pitch radius `r_m`, m; 1.01 times the ball radius to 100.
    pub pitch_radius: f32,
    /// Nominal contact angle `beta_0`, rad; 0.05 to 1.5.
    pub contact_angle: f32,
    /// Axis ratio `b/a` on the inner ring; 0.01 to 1.
    pub axis_ratio_inner: f32,
    /// Axis ratio `b/a` on the outer ring; 0.01 to 1.
    pub axis_ratio_outer: f32,
    /// Semi-major axis over the cube root of the contact force on the inner ring, m/N^(1/3); 1e-8 to 1.
    pub semi_major_coefficient_inner: f32,
    /// Semi-major axis over the cube root of the contact force on the outer ring, m/N^(1/3); 1e-8 to 1.
    pub semi_major_coefficient_outer: f32,
    /// Coulomb friction coefficient `mu` of ball and groove; 1e-6 to 1.
    pub friction: f32,
}

/// A ball in a four-point contact rotary bearing whose inner ring turns and whose outer ring stands still.
///
/// Kinematics of Lin 2019, eqs. (3.11)-(3.14), in the ball's absolute rotation `omega_x + omega_B`; with
/// it the slip of every contact is `r_m omega_B` plus the rotation's part, as on a straight track, and
/// the [`FourPointBall`] inside is that of a linear bearing with other groove speeds.
///
/// The friction torques of cases I, II, III of Table 3.2 (a sigmoid for stick; 2.465, 12.877 and
/// 33.686 N mm when its integrals are not interpolated) are met within 0.07, 0.005 and 0.001 %.
///
/// ```
/// use epas_friction::refined::{RotaryBall, RotaryBallParameters};
/// let ball = RotaryBall::new(&RotaryBallParameters {
///     ball_radius: 0.00625,
///     pitch_radius: 0.035,
///     contact_angle: 0.785,
///     axis_ratio_inner: 0.157,
///     axis_ratio_outer: 0.216,
///     semi_major_coefficient_inner: 1.288e-4,
///     semi_major_coefficient_outer: 1.196e-4,
///     friction: 0.1,
/// })?;
/// let contacts = ball
///     .four_point()
///     .contacts(&[0.782, 0.777, 0.782, 0.778], &[188.5, 46.89, 188.6, 46.94]);
/// let state = ball.four_point().solve(&contacts);
/// assert!((ball.friction_torque(&state) - 0.0337).abs() < 1e-4);
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct RotaryBall {
    ball: FourPointBall,
    pitch_radius: f32,
    radius_ratio: f32,
}

/// Motion of a ball in a rotary bearing.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct RotaryMotion {
    /// Orbital speed `omega_B`, rad/s.
    pub orbital_speed: f32,
    /// Rotation `omega_x` about the bearing's axis, relative to the orbiting frame, rad/s.
    pub roll: f32,
    /// Rotation `omega_y` about the radius, rad/s.
    pub yaw: f32,
}

const fn axis_ratio(field: &'static str, value: f32) -> Result<f32, Error> {
    in_range(field, value, SMALLEST_AXIS_RATIO, 1.0)
}

impl RotaryBall {
    /// A ball in a rotary bearing.
    ///
    /// # Errors
    /// [`Error`] naming the field of [`RotaryBallParameters`] that is out of range.
    pub const fn new(parameters: &RotaryBallParameters) -> Result<Self, Error> {
        let ball_radius =
            attempt!(ranges::BALL_RADIUS.checked("ball_radius", parameters.ball_radius));
        let pitch_radius = attempt!(in_range(
            "pitch_radius",
            parameters.pitch_radius,
            1.01 * ball_radius,
            100.0,
        ));
        let contact_angle = attempt!(
            ranges::ROLLING_CONTACT_ANGLE.checked("contact_angle", parameters.contact_angle)
        );
        let friction = attempt!(ranges::FRICTION.checked("friction", parameters.friction));

        // Neither ring slips at the nominal angle: in units of omega_I r_m and with g = r_b/r_m,
        // omega_B = (1 - g cos)/2 and omega_x + omega_B = -omega_B/(g cos).
        let (sin, cos) = constant::sin_cos(contact_angle);
        let radius_ratio = ball_radius / pitch_radius;
        let speed = 0.5 * (1.0 - radius_ratio * cos);
        let roll = -speed / cos;
        let inner = attempt!(FourPointGroove::new(
            attempt!(axis_ratio("axis_ratio_inner", parameters.axis_ratio_inner)),
            attempt!(ranges::SEMI_MAJOR_COEFFICIENT.checked(
                "semi_major_coefficient_inner",
                parameters.semi_major_coefficient_inner,
            )),
            ball_radius,
            roll - radius_ratio,
        ));
        let outer = attempt!(FourPointGroove::new(
            attempt!(axis_ratio("axis_ratio_outer", parameters.axis_ratio_outer)),
            attempt!(ranges::SEMI_MAJOR_COEFFICIENT.checked(
                "semi_major_coefficient_outer",
                parameters.semi_major_coefficient_outer,
            )),
            ball_radius,
            roll,
        ));
        Ok(Self {
            ball: FourPointBall::folded(
                friction,
                contact_angle,
                speed,
                STICK_SPIN * radius_ratio * sin,
                inner,
                outer,
            ),
            pitch_radius,
            radius_ratio,
        })
    }

    /// The ball itself: contacts in the order inner left, inner right, outer right, outer left; track
    /// speed is inner speed times pitch radius.
    #[must_use]
    pub const fn four_point(&self) -> &FourPointBall {
        &self.ball
    }

    /// Motion of the ball where the inner ring turns with `inner_speed`, rad/s.
    #[must_use]
    pub fn motion(&self, state: &BallState, inner_speed: f32) -> RotaryMotion {
        let orbital_speed = (self.ball.nominal_speed() + state.motion.speed) * inner_speed;
        let rotation = inner_speed / self.radius_ratio;
        RotaryMotion {
            orbital_speed,
            roll: (self.ball.nominal_roll() + state.motion.roll) * rotation - orbital_speed,
            yaw: state.motion.yaw * rotation,
        }
    }

    /// Friction torque on the inner ring from this ball, N m (Lin 2019, eq. (3.21)), for either
    /// direction of rotation, never negative. At standstill static friction takes any value up to it.
    #[must_use]
    pub fn friction_torque(&self, state: &BallState) -> f32 {
        state.friction_force * self.pitch_radius
    }

    /// Contacts of the ball; see [`FourPointBall::contacts`].
    #[must_use]
    pub fn contacts(
        &self,
        contact_angles: &[f32; 4],
        contact_forces: &[f32; 4],
    ) -> FourPointContacts {
        self.ball.contacts(contact_angles, contact_forces)
    }
}
