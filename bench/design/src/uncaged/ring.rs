//! A row of touching balls: by the exact solver, and by a folded law as a control interrupt evaluates it.

use epas_friction::ball::folded::FrictionInterval;
use epas_friction::ball::pressed::BallLaw;
use epas_friction::train::Press;
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
            // The law of a ball knows no force that points outward.
            chord: false,
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
        })
    }

    /// By a law.
    pub fn folded<const N: usize>(&self, law: &BallLaw<N>, speeds: &Speeds) -> RowAnswer {
        let interval = law.interval(self.friction);
        let (load, branch) = self.load(law);
        let numbers = law.numbers(load, branch, interval);
        let motions = self.deviations.map(|at| numbers.at(at));
        let mut room = [0.0; BALLS];
        room[BALLS - 1] = f32::INFINITY;
        let mut press = Press::<BALLS>::new();
        press.solve_rubbing(
            &motions.map(|motion| motion.speed),
            &motions.map(|motion| motion.impedance),
            &room,
            &motions.map(|motion| motion.grip * self.ball_friction),
        );
        let mut torque = 0.0;
        for (motion, speed) in motions.iter().zip(press.speeds()) {
            let x = f64::from(speed - motion.speed);
            let push = f64::from(motion.impedance) * x;
            torque += f64::from(motion.torque)
                + (f64::from(numbers.slope)
                    + 0.5 * f64::from(numbers.work) * speeds.against_nut * push)
                    * x;
        }
        let forces: Vec<f64> = press.forces().take(BALLS - 1).map(f64::from).collect();
        let rubbing = f64::from(self.ball_friction * numbers.rubbing);
        torque += rubbing * forces.iter().sum::<f64>();
        RowAnswer { torque, forces }
    }

    /// Whether the law says that it does not hold these forces between balls.
    pub fn is_flagged<const N: usize>(&self, law: &BallLaw<N>, forces: &[f64]) -> bool {
        let interval: FrictionInterval = law.interval(self.friction);
        let (load, branch) = self.load(law);
        let mean = forces.iter().sum::<f64>() / BALLS as f64;
        let rubbing = self.ball_friction * mean as f32;
        !(law.holds_forces(load, branch, interval) && law.holds_rubbing(load, interval, rubbing))
    }

    fn load<const N: usize>(&self, law: &BallLaw<N>) -> (f32, usize) {
        let branch = usize::from(self.axial_load < 0.0);
        (law.load_of(self.axial_load), branch)
    }
}
