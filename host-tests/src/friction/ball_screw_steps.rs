//! Newton's method on the seven equations of a ball between elastic grooves, from a start that lies near.

use nalgebra::{Matrix4, SMatrix, Vector4};

use super::ball_screw_placed::{Balance, BallState, Drive, PlacedBall, Solved};

const SHORT_STEPS: usize = 20;

impl PlacedBall<'_> {
    /// Damped Newton steps on all seven equations until the residual no longer falls, or many short steps show that the start was too far.
    pub fn newton(&self, start: &BallState, drive: Drive, unit: f64) -> Option<Solved> {
        let mut state = *start;
        match drive {
            Drive::Force(force) => state.force = force,
            Drive::Speed(speed) => (state.motion[0], state.remainder[0]) = (speed, 0.0),
        }
        let mut balance = self.balance(&state)?;
        let mut short_steps = 0;
        while short_steps < SHORT_STEPS {
            if balance.amax() <= self.accuracy(&state).0 {
                break;
            }
            let Some(step) = self
                .driven_jacobian(&state, drive, unit)
                .and_then(|jacobian| jacobian.lu().solve(&balance))
            else {
                break;
            };
            let mut fraction = 1.0;
            let taken = loop {
                let there = moved(&state, &step, drive, unit, fraction);
                if let Some(new) = self.balance(&there)
                    && new.norm() < (1.0 - 1e-4 * fraction) * balance.norm()
                {
                    break Some((there, new));
                }
                fraction *= 0.5;
                if fraction < 1e-4 {
                    break None;
                }
            };
            let Some((there, new)) = taken else { break };
            if fraction < 1.0 || new.norm() > 0.5 * balance.norm() {
                short_steps += 1;
            }
            (state, balance) = (there, new);
        }
        let state = self.trimmed(state, balance, drive, unit);
        Some(Solved {
            state,
            residual: self.balance(&state)?.amax(),
            stiffness: self.stiffness(&state, unit)?,
        })
    }

    /// Steps below the last digit of the motion, at the place that was found: a contact at rest answers a slip of the last digit with 1e-9 of
    /// its load.
    fn trimmed(
        &self,
        mut state: BallState,
        mut balance: Balance,
        drive: Drive,
        unit: f64,
    ) -> BallState {
        let (rounding, accepted) = self.accuracy(&state);
        for _ in 0..4 {
            if !(balance.amax() > rounding && balance.amax() <= accepted) {
                break;
            }
            let motion = self.driven_jacobian(&state, drive, unit).and_then(|all| {
                let forces: Vector4<f64> = balance.fixed_rows::<4>(3).into();
                let by_motion: Matrix4<f64> = all.fixed_view::<4, 4>(3, 3).into();
                by_motion.lu().solve(&forces)
            });
            let Some(motion) = motion else { break };
            let mut there = state;
            there.remainder -= motion;
            if let Drive::Speed(_) = drive {
                there.remainder[0] = state.remainder[0];
                there.force -= motion[0];
            }
            match self.balance(&there) {
                Some(new) if new.norm() < balance.norm() => (state, balance) = (there, new),
                _ => break,
            }
        }
        state
    }

    fn driven_jacobian(
        &self,
        state: &BallState,
        drive: Drive,
        unit: f64,
    ) -> Option<SMatrix<f64, 7, 7>> {
        let mut jacobian = self.tangent(state, unit)?.jacobian;
        if let Drive::Speed(_) = drive {
            jacobian.column_mut(3).fill(0.0);
            jacobian[(3, 3)] = self.path();
        }
        Some(jacobian)
    }

    /// Change of the force along the track with the orbital speed, all else in balance.
    fn stiffness(&self, state: &BallState, unit: f64) -> Option<f64> {
        let mut jacobian = self.tangent(state, unit)?.jacobian;
        let by_speed: Balance = jacobian.column(3).into();
        jacobian.column_mut(3).fill(0.0);
        jacobian[(3, 3)] = self.path();
        let change = jacobian.lu().solve(&by_speed)?;
        Some(-change[3])
    }
}

fn moved(state: &BallState, step: &Balance, drive: Drive, unit: f64, fraction: f64) -> BallState {
    let mut there = *state;
    there.place -= step.fixed_rows::<3>(0) * (unit * fraction);
    let motion = step.fixed_rows::<4>(3) * fraction;
    match drive {
        Drive::Force(_) => there.motion -= motion,
        Drive::Speed(_) => {
            there.force -= motion[0];
            there.motion -= Vector4::new(0.0, motion[1], motion[2], motion[3]);
        }
    }
    there
}
