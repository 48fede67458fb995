//! One ball of a ball screw integrated in time: where the equations of motion of Lin, Velinsky, Ravani 1994 lead from a rolling start.
//!
//! The steady state of their eq. (5)-(9) ([`epas_reference::steady_state`]) lets every contact slide and needs a spin of millions of
//! revolutions a minute. The same equations with their rates kept (eq. (5) with `m d W'` and `I omega'`), Coulomb friction smoothed over a
//! small slip speed, and a ball that starts to roll stay at rolling: A and A' stick, B slips across the groove alone, and the efficiency is
//! eq. (3) without rolling resistance, whether screw or nut turns. They never lead to eq. (4), which is printed for the nut.
//!
//! Where the load drives, the friction of the slipping contact presses the ball inward: A' opens, and the minor contact is B' on the screw.
//! Then B and B' stick and A slips, with the efficiency `1 - x` to the `1 / (1 + x)` of eq. (3), `x = f a / (Sb - f Cb)`.

use std::f64::consts::TAU;

use ivp::prelude::{Direction, EventConfig, FirstOrderSystem, Ivp, Matrix, Method};
use num_dual::jacobian;

use crate::ball_motion::{Motion, State};
use epas_reference::curvature::Groove;
use epas_reference::error::{ReferenceError, within};
use epas_reference::steady_state::BallScrewState;

/// Slip speed over which friction is smoothed where none is given, over the slip of rolling.
pub const SMOOTHING: f64 = 1e-3;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollingBall {
    /// Geometry, speed, load per ball, friction. With a positive speed the load is moved, with a negative one it drives.
    pub ball: BallScrewState,
    pub turning: Groove,
    /// The groove with the third, minor contact: the nut's at A', or the screw's at B'.
    pub minor: Groove,
    /// Slip speed `V0` of the friction `f V / sqrt(V² + V0²)` over the slip speed `r_b Omega Sa` of rolling at B, 1e-6 to 1; [`SMOOTHING`].
    pub smoothing: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instant {
    /// Angle the driven part has turned, rad.
    pub angle: f64,
    pub efficiency: f64,
    /// Torque on the screw for this ball, N m.
    pub torque: f64,
    pub normal_screw: f64,
    pub normal_nut: f64,
    /// Normal load at the minor contact, N.
    pub normal_minor: f64,
    /// Angular speed of the ball about the screw's axis, rad/s.
    pub orbital_speed: f64,
    /// Angular velocity of the ball along tangent, normal and binormal, rad/s.
    pub ball_speed: [f64; 3],
    /// Slip speeds at A, B and the minor contact, m/s.
    pub slip_speeds: [f64; 3],
    /// Power that friction takes at the three contacts together, W.
    pub friction_power: f64,
    /// Largest change of a slip speed over a turn, over the slip speed of rolling: small once settled.
    pub drift: f64,
}

struct System(Motion);

impl FirstOrderSystem for System {
    fn derivative(&self, _angle: f64, y: &[f64], rate: &mut [f64]) {
        rate.copy_from_slice(self.0.rate(&State::from_column_slice(y)).as_slice());
    }

    fn events(&self, _angle: f64, y: &[f64], out: &mut [f64]) {
        let actions = self.0.actions(&State::from_column_slice(y));
        for (out, action) in out.iter_mut().zip(actions) {
            *out = action.normal_load;
        }
    }

    fn n_events(&self) -> usize {
        3
    }

    fn event_config(&self, _contact: usize) -> EventConfig {
        EventConfig {
            direction: Direction::Negative,
            terminal_count: Some(1),
        }
    }

    fn jac(&self, _angle: f64, y: &[f64], into: &mut Matrix) {
        let (_, exact) = jacobian(|y| self.0.rate(&y), &State::from_column_slice(y));
        for row in 0..4 {
            for column in 0..4 {
                into[(row, column)] = exact[(row, column)];
            }
        }
    }
}

impl RollingBall {
    /// The screw turns; the minor contact is where friction presses the ball: outward, against the nut,
    /// while the load is moved, inward, against the screw, where the load drives.
    pub fn new(ball: BallScrewState) -> Self {
        Self {
            ball,
            turning: Groove::Screw,
            minor: if ball.speed < 0.0 {
                Groove::Screw
            } else {
                Groove::Nut
            },
            smoothing: SMOOTHING,
        }
    }

    /// The state after `turns` turns from the rolling start.
    ///
    /// The equations are stiff by ten orders (friction against inertia over the smoothing speed): LSODA (backward differentiation while
    /// stiff) with exact derivatives, slips accurate to 1e-8 of the smoothing speed or, where rounding forbids it, to at most 1e-5. An
    /// input out of range, a contact that opens, and the integrator's reason to stop are errors.
    pub fn settle(&self, turns: f64) -> Result<Instant, ReferenceError> {
        within("turns", turns, 1e-6, 1e4)?;
        let motion = self.motion()?;
        let end = turns * TAU;
        // An event is a change of sign: a contact that is open from the start has none.
        self.instant(&motion, 0.0, &State::zeros())?;
        // Slips are accurate to a share of the smoothing speed, also while they are zero. Where the rounding of the friction moments
        // is more than that (slow, heavily loaded), the integrator takes ever smaller steps; a coarser share is tried then.
        let attempt = |share: f64| {
            Ivp::first_order(&System(motion), 0.0, end, State::zeros().as_slice())
                .method(Method::LSODA)
                .rtol(1e-4 * share)
                .atol(share * motion.smoothing)
                .first_step((1e-3 / motion.grip.max(1.0)).min(0.1 * end))
                .max_steps(4004)
                .t_eval(vec![end])
                .solve()
        };
        let mut outcome = attempt(1e-8);
        for share in [1e-7, 1e-6, 1e-5] {
            if outcome.as_ref().is_ok_and(|done| {
                done.status.is_success() || done.t_events.iter().flatten().next().is_some()
            }) {
                break;
            }
            outcome = attempt(share);
        }
        let stopped = |reason: String| ReferenceError::Integrator { reason };
        let solution = outcome.map_err(|error| stopped(error.to_string()))?;
        if let Some(&angle) = solution.t_events.iter().flatten().next() {
            return Err(ReferenceError::ContactLost { angle });
        }
        if !solution.status.is_success() {
            return Err(stopped(format!("{:?}", solution.status)));
        }
        let last = solution.iter().last();
        let (angle, state) = last.ok_or_else(|| stopped("no instant".into()))?;
        self.instant(&motion, angle, &State::from_column_slice(state))
    }

    fn motion(&self) -> Result<Motion, ReferenceError> {
        within("smoothing", self.smoothing, 1e-6, 1.0)?;
        Motion::new(&self.ball, self.turning, self.minor, self.smoothing)
    }

    fn instant(
        &self,
        motion: &Motion,
        angle: f64,
        state: &State<f64>,
    ) -> Result<Instant, ReferenceError> {
        let ball = &self.ball;
        let actions = motion.actions(state);
        let [nut, screw, minor] = actions.map(|at| at.normal_load);
        if !(nut >= 0.0 && screw >= 0.0 && minor >= 0.0) {
            return Err(ReferenceError::ContactLost { angle });
        }
        let unit = ball.axial_load / (motion.cos_a * motion.sin_b);
        let torque = motion.torque(&actions) * ball.pitch_radius * unit;
        let ideal = ball.axial_load * ball.pitch_radius * motion.sin_a / motion.cos_a;
        let speeds = motion.speeds(state);
        let omega = ball.speed.abs();
        Ok(Instant {
            angle,
            efficiency: if ball.speed > 0.0 {
                ideal / torque
            } else {
                torque / ideal
            },
            torque,
            normal_screw: screw * unit,
            normal_nut: nut * unit,
            normal_minor: minor * unit,
            orbital_speed: speeds.orbital * omega,
            ball_speed: speeds.ball.map(|speed| speed * omega),
            slip_speeds: actions.map(|at| at.slip[0].hypot(at.slip[1]) * ball.ball_radius * omega),
            friction_power: actions
                .iter()
                .map(|at| -at.normal_load * (at.pull[0] * at.slip[0] + at.pull[1] * at.slip[1]))
                .sum::<f64>()
                * unit
                * ball.friction
                * ball.ball_radius
                * omega,
            drift: motion.rate(state).amax() * TAU / motion.sin_a,
        })
    }
}
