//! The refined ball in a linear bearing.

use super::ball::{FourPointBall, FourPointGroove};
use crate::ball::LinearBallParameters;
use crate::error::{Error, attempt};
use crate::math::constant;

/// Spin below which a contact counts as sticking, in units of track speed over ball radius; contacts of
/// a ball in four-point contact spin with about half that unit: the loss changes by the order of `(0.01/0.5)²`, 4e-4
/// (measured: 2.7e-4).
const STICK_SPIN: f32 = 0.01;

impl FourPointBall {
    /// A ball in a linear bearing: the bottom groove stands still, the top groove moves with the track speed.
    ///
    /// Largest error of the speed deviation, in units of `v/2`, against the least exact dissipation in
    /// f64, contact angle deviations of the bottom groove up to 3 degrees (deviations up to 0.025):
    ///
    /// | side-force ratio up to | (3.43) | start | +1 step | +2 | +3 |
    /// |---|---|---|---|---|---|
    /// | 0.5 | 2.3e-3 | 2.2e-3 | 4.6e-4 | 9.3e-6 | 1.7e-6 |
    /// | 0.6 | 4.1e-3 | 4.0e-3 | 1.4e-3 | 2.4e-5 | 3.1e-6 |
    /// | 0.8 | 5.8e-3 | 5.6e-3 | 2.4e-3 | 3.8e-5 | 3.1e-6 |
    /// | 0.93 | 2.2e-2 | 5.7e-3 | 2.8e-3 | 5.9e-4 | 8.2e-4 |
    ///
    /// 400 random sets of four angles within ±3 degrees, side-force ratio up to 0.8 (largest, rms): start
    /// 1.4e-2, 1.8e-3; two steps 3.1e-4, 2.0e-5; three steps 3.4e-6, 6.5e-7. One step a tick from the last
    /// tick's state follows a side force that swings by ±0.8 in 100 ticks within 5.2e-5. The drag is
    /// too small by at most 2.7e-4 of itself.
    ///
    /// Where loads are so light that the angle deviations move the contacts by more than their own size
    /// (1 N in the ball of Table 3.3), three steps leave up to 7e-3, the five of [`FourPointBall::solve`]
    /// 4.5e-4; from 10 N on three steps leave 7e-5, at 30, 45 and 60 degrees alike.
    ///
    /// At a ratio of 0.88 to 0.98 the ball changes from four-point to two-point rolling, and its speed
    /// jumps by up to 0.025: a true discontinuity of Coulomb friction. Within some 0.02 of it the error
    /// is up to the jump, and a ball takes some ticks to follow it.
    ///
    /// ```
    /// use epas_friction::ball::LinearBallParameters;
    /// use epas_friction::refined::FourPointBall;
    /// let ball = FourPointBall::linear(&LinearBallParameters {
    ///     ball_radius: 0.005,
    ///     contact_angle: core::f32::consts::FRAC_PI_4,
    ///     axis_ratio: 0.2321,
    ///     semi_major_coefficient: 9.075e-5,
    ///     friction: 0.1,
    /// })?;
    /// // Lin 2019, Table 3.4, case (a), numerical model: 0.87 %.
    /// let angles = [0.7505, 0.8203, 0.7854, 0.7854];
    /// let contacts = ball.contacts(&angles, &[114.06, 24.32, 113.14, 28.28]);
    /// let mut state = ball.solve(&contacts);
    /// assert!((state.speed_deviation - 0.0087).abs() < 1e-4);
    /// // In the loop: one step a tick.
    /// state = ball.step(&contacts, &state, 0.0);
    /// # assert!((state.speed_deviation - 0.0087).abs() < 1e-4);
    /// # Ok::<(), epas_friction::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error`] naming the field of [`LinearBallParameters`] that is out of range.
    pub const fn linear(parameters: &LinearBallParameters) -> Result<Self, Error> {
        let parameters = attempt!(parameters.checked());
        let (_, cos) = constant::sin_cos(parameters.contact_angle);
        // Half the track speed along, and no slip at the bottom: r_b omega_x cos(beta_0) = v/2.
        let track = attempt!(FourPointGroove::new(
            parameters.axis_ratio,
            parameters.semi_major_coefficient,
            parameters.ball_radius,
            0.5 / cos,
        ));
        Ok(Self::folded(
            parameters.friction,
            parameters.contact_angle,
            0.5,
            STICK_SPIN,
            track,
            track,
        ))
    }
}
