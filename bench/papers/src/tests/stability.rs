//! Whether a steady state holds against small disturbances.

use nalgebra::SMatrix;
use num_dual::jacobian;

use crate::ball_motion::{Motion, State};
use epas_reference::curvature::Groove;
use epas_reference::steady_state::{BallScrewState, SteadyState};

/// The disturbance of a steady state that grows fastest, or decays slowest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Growth {
    /// Growth rate, 1/s; below zero it decays.
    pub rate: f64,
    /// Angular frequency, rad/s.
    pub frequency: f64,
}

/// What becomes of a small disturbance of `steady`: the eigenvalue with the largest real part of the ball's equations of motion, eq. (5)
/// with `m d W'` and `I omega'`, linearised there. `None` where the numbers are out of range or no eigenvalue is found.
///
/// At the case of Lin, Velinsky, Ravani 1994 (lead angle 10, contact angle 45 degrees, 2113 N on one
/// ball at 2000 rpm) the disturbance grows at 5.6 1/s: the state of eq. (14) does not hold there.
pub fn growth(ball: &BallScrewState, steady: &SteadyState) -> Option<Growth> {
    let omega = ball.speed.abs();
    let moving = BallScrewState {
        speed: omega,
        ..*ball
    };
    // All three contacts slide: Coulomb friction is smooth there without help.
    let motion = Motion::new(&moving, Groove::Screw, Groove::Nut, 0.0).ok()?;
    let rolling = motion.rolling();
    let [t, n, b] = steady.ball_speed.map(|speed| speed / ball.speed);
    let [t0, n0, b0] = rolling.ball;
    let advance = motion.arm() * (steady.orbital_ratio - rolling.orbital);
    let state = State::new(t - t0, n - n0, b - b0, advance);
    let (_, slopes): (_, SMatrix<f64, 4, 4>) = jacobian(|y| motion.rate(&y), &state);
    if !slopes.iter().all(|slope| slope.is_finite()) {
        return None;
    }
    slopes
        .complex_eigenvalues()
        .iter()
        .map(|root| Growth {
            rate: root.re * omega,
            frequency: root.im.abs() * omega,
        })
        .max_by(|left, right| left.rate.total_cmp(&right.rate))
}
