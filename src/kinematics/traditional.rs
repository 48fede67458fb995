//! The traditional formulation, beside the revised one.

use super::direction::Direction;
use super::parameters::KinematicsParameters;
use super::path::Path;
use super::slip::{BallKinematics, ContactSlip};
use crate::error::Error;
use crate::math;

/// Contact kinematics by the traditional formulation, to see what the revised one changes.
///
/// Slip: Lin, Ravani, Velinsky 1994 as Alberdi et al. restate it, the first term of (26) and (29)
/// minus (19) or (21). Orbital and spin speed: Wei and Lin, which is (22) and (23) without the
/// advance `L / (2 pi) sin psi`, `G_k = (r_m -+ r'_k cos alpha_k) cos psi / (r'_k b_k)`.
/// `rolling_slip = omega_k r_m / cos psi +- omega_race S cos psi cos alpha_k + omega_R S b_k`,
/// `side_slip = -omega_race S sin psi +- omega_R S cos beta sin beta'`,
/// `spin = -omega_race cos psi sin alpha_k -+ omega_R n_k`, with
/// `omega_race` the screw's speed at the screw and 0 at the nut.
///
/// It lets the ball turn by its rotation *relative* to the orbiting frame where the formula needs
/// the *absolute* one, which is larger by the orbital speed: with
/// `(omega_t + omega_m sin psi, omega_n, omega_b + omega_m cos psi)` in place of
/// `(omega_t, omega_n, omega_b)` it equals the revised formulation. For the paper's screw the error
/// is three times the true slip (2.9 at the screw, 3.4 at the nut), nearly all of it along the path,
/// and side slip at the nut vanishes where there is as much as at the screw.
/// **Never feed it to wear or heat.**
///
/// Errors against the same formulas in f64: 4e-7 of `omega r_m / cos psi`, the speed it
/// subtracts from (20 000 random geometries); spin and speeds 4e-7 of the spin and of the speed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct TraditionalKinematics {
    per_speed: BallKinematics,
}

impl TraditionalKinematics {
    /// Checks the parameters and forms the constants; only for set-up.
    ///
    /// # Errors
    /// As [`ContactKinematics::new`](super::ContactKinematics::new).
    pub fn new(parameters: &KinematicsParameters) -> Result<Self, Error> {
        let path = Path::new(parameters)?;
        let (screw, nut) = path.checked_directions(parameters)?;
        let revised = super::ContactKinematics::new(parameters)?;
        let (c, s) = (path.cos_lead, path.sin_lead);
        let pitch_radius = parameters.pitch_radius;
        // A_k / r'_k without the advance of the helix.
        let reach_screw = c * (pitch_radius / parameters.rolling_radius_screw - screw.cosine);
        let reach_nut = c * (pitch_radius / parameters.rolling_radius_nut + nut.cosine);
        let inverse = 1.0 / (reach_screw * nut.grip + reach_nut * screw.grip);
        let orbital_speed = reach_screw * nut.grip * inverse;
        let screw_speed = -(reach_nut * screw.grip * inverse);
        let spin_speed = reach_screw * reach_nut * inverse;

        let slip =
            |direction: &Direction, distance: f32, sign: f32, relative_speed: f32, raceway: f32| {
                let turning = sign * spin_speed;
                // Speeds of raceway and ball relative to the moving contact, along and across the path.
                let raceway_rolling =
                    relative_speed * path.radius + raceway * distance * c * direction.cosine;
                let ball_rolling = spin_speed * distance * direction.grip;
                let raceway_side = -raceway * distance * s;
                let ball_side = turning * distance * path.axis_tangent;
                let (mean_rolling, mean_side) = (
                    0.5 * (raceway_rolling - ball_rolling),
                    0.5 * (raceway_side - ball_side),
                );
                ContactSlip {
                    rolling_slip: raceway_rolling + ball_rolling,
                    side_slip: raceway_side + ball_side,
                    spin: -(raceway * c * direction.sine) - turning * direction.lean,
                    entrainment_speed: math::sqrt(
                        mean_rolling * mean_rolling + mean_side * mean_side,
                    ),
                }
            };
        Ok(Self {
            per_speed: BallKinematics {
                orbital_speed,
                spin_speed,
                screw: slip(&screw, revised.screw().distance, 1.0, screw_speed, 1.0),
                nut: slip(&nut, revised.nut().distance, -1.0, -orbital_speed, 0.0),
            },
        })
    }

    /// Motion and slip per rad/s of the screw.
    #[inline]
    #[must_use]
    pub const fn per_speed(&self) -> &BallKinematics {
        &self.per_speed
    }

    /// Motion and slip at a screw speed (rad/s), as
    /// [`ContactKinematics::tick`](super::ContactKinematics::tick).
    #[inline]
    #[must_use]
    pub fn tick(&self, speed: f32) -> BallKinematics {
        self.per_speed.at_speed(speed)
    }
}
