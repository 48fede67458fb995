//! A row of touching balls: by the exact solver, and by a folded law as a control interrupt evaluates it.

use epas_friction::ball::pressed::{BallLaw, LoadedBall, Pressed, RowConstants};
use epas_friction::train::{Press, RubbedBall};
use epas_reference::ReferenceError;
use epas_reference::friction::ball_screw_row::{ElasticRow, RowBall};
use epas_reference::friction::caged_ball::CagedBall;
use epas_reference::friction::rolling_resistance::rolling_losses;

use super::ball::Speeds;

/// Balls of a row.
pub(super) const BALLS: usize = 37;

/// What balls of a row meet.
#[derive(Clone, Debug)]
pub(super) struct Row {
    /// Friction coefficient of the grooves.
    pub friction: f32,
    /// Friction coefficient between balls.
    pub ball_friction: f32,
    /// Axial load of each ball, N; positive where it opposes the motion.
    pub axial_load: f32,
    /// Deviations of screw and nut at each ball, over the largest.
    pub deviations: [[f32; 2]; BALLS],
}

/// What they do.
#[derive(Clone, Debug)]
pub(super) struct RowAnswer {
    /// Friction torque on the nut, N m.
    pub torque: f64,
    /// Forces between neighbours, N.
    pub forces: Vec<f64>,
    /// Whether the step flags it.
    pub flagged: bool,
}

impl Row {
    /// By the exact solver.
    ///
    /// # Errors
    /// [`ReferenceError`] where it has no answer.
    pub fn exact(
        &self,
        ball: &CagedBall,
        deviations: [f32; 2],
    ) -> Result<RowAnswer, ReferenceError> {
        let [screw, nut] = deviations.map(f64::from);
        let row = ElasticRow {
            design: ball.design,
            clearance: ball.clearance,
            friction: self.friction.into(),
            ball_friction: self.ball_friction.into(),
            nut_speed: 1.0,
            balls: self
                .deviations
                .iter()
                .map(|at| RowBall {
                    screw_deviation: screw * f64::from(at[0]),
                    nut_deviation: nut * f64::from(at[1]),
                    axial_load: self.axial_load.into(),
                })
                .collect(),
            integration: ball.integration,
        };
        let found = row.solve()?;
        let mut torque = found.groove_loss() + found.ball_loss;
        for ball_of_row in &found.pressing {
            let [hysteresis, lubricant] =
                rolling_losses(&ball.design, &ball.rolling, ball_of_row, 1.0)?;
            torque += hysteresis + lubricant;
        }
        Ok(RowAnswer {
            torque,
            forces: found.contact_forces,
            flagged: false,
        })
    }

    /// By a law, as a step evaluates it.
    pub fn folded<const N: usize>(&self, law: &BallLaw<N>, speeds: &Speeds) -> RowAnswer {
        let interval = law.interval(self.friction);
        let (load, branch) = self.load(law);
        let numbers = law.numbers(load, branch, interval);
        let sliding = law.sliding(load, interval);
        let row = RowConstants {
            ball_friction: self.ball_friction * (speeds.outward as f32).hypot(1.0),
            outward: speeds.outward as f32,
            half_speed: 0.5 * speeds.against_nut as f32,
        };
        let neighbours = law.neighbours(load, branch, interval, &numbers, row);
        let losses = neighbours.losses(sliding, numbers.impedance[0]);
        let balls = self.deviations.map(|deviations| LoadedBall {
            alone: numbers.at(deviations),
            sliding,
            deviations,
        });
        let mut room = [0.0; BALLS];
        room[BALLS - 1] = f32::INFINITY;
        let mut press = Press::<BALLS>::new();
        let mut torque: f64 = balls.iter().map(|ball| f64::from(ball.alone.torque)).sum();
        let mut second = [RubbedBall::default(); BALLS];
        if self.ball_friction > 0.0 {
            let first = balls.map(|ball| neighbours.first(&ball));
            press.solve_rubbing(&first, &room, &losses);
            let mut behind = 0.0;
            let found = press.forces().zip(press.speeds());
            for (ball, (second, (force, speed))) in balls.iter().zip(second.iter_mut().zip(found)) {
                let forces = behind + force;
                let (rubbed, held) = neighbours.second(ball, Pressed { forces, speed });
                behind = force;
                torque += f64::from(held);
                *second = rubbed;
            }
        } else {
            for (ball, second) in balls.iter().zip(&mut second) {
                let (smooth, held) = neighbours.smooth(ball);
                torque += f64::from(held);
                *second = smooth;
            }
        }
        let row = press
            .solve_rubbing(&second, &room, &losses)
            .unwrap_or_default();
        let outward = neighbours.numbers.outward_torque * row.forces;
        torque += f64::from(row.by_speed + row.by_rubbing + outward);
        let forces = press.forces().take(BALLS - 1).map(f64::from).collect();
        let rubbing = neighbours.ball_friction * row.largest_of_both;
        RowAnswer {
            torque,
            forces,
            flagged: !(law.holds_forces(load, branch, interval)
                && law.holds_rubbing(rubbing, sliding)),
        }
    }

    fn load<const N: usize>(&self, law: &BallLaw<N>) -> (f32, usize) {
        let branch = usize::from(self.axial_load < 0.0);
        (law.load_of(self.axial_load), branch)
    }
}
