//! A row of touching balls: by the exact solver, and by a folded law as a control interrupt evaluates it.

use epas_friction::ball::pressed::{
    BallLaw, BallOfRow, NeighbourLaw, PressedTorques, RowConstants,
};
use epas_friction::train::{FreeBall, Neighbours, Press};
use epas_reference::ReferenceError;
use epas_reference::friction::ball_screw_row::{ElasticRow, RowBall};
use epas_reference::friction::held_ball::HeldBall;
use epas_reference::friction::rolling_resistance::rolling_losses;

use super::ball::Speeds;

pub(super) const BALLS: usize = 37;

/// What balls of a row meet.
#[derive(Clone, Debug)]
pub(super) struct Row {
    pub friction: f32,
    pub ball_friction: f32,
    /// Axial load of each ball, N; positive where it opposes the motion.
    pub axial_load: f32,
    /// Deviations of screw and nut at each ball, over the largest.
    pub deviations: [[f32; 2]; BALLS],
}

#[derive(Clone, Debug)]
pub(super) struct RowAnswer {
    /// Friction torque on the nut, N m.
    pub torque: f64,
    /// Forces between neighbours, N.
    pub forces: Vec<f64>,
    pub flagged: bool,
}

impl Row {
    pub fn exact(
        &self,
        ball: &HeldBall,
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
            chord: true,
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

    pub fn folded<const N: usize>(&self, law: &BallLaw<N>, speeds: &Speeds) -> RowAnswer {
        let interval = law.interval(self.friction);
        let (load, branch) = self.load(law);
        let numbers = law.per_sliding(load, branch, interval);
        let sliding = law.sliding(load, interval);
        let row = RowConstants {
            ball_friction: self.ball_friction * (speeds.outward as f32).hypot(1.0),
            outward: speeds.outward as f32,
            normal: speeds.outward.hypot(1.0) as f32,
            half_speed: 0.5 * speeds.against_nut as f32,
        };
        let neighbours = law.neighbours(load, branch, interval, &numbers, row);
        let alone = self.deviations.map(|deviations| numbers.at(deviations));
        let balls: [BallOfRow; BALLS] = std::array::from_fn(|ball| BallOfRow {
            speed: alone[ball].speed,
            impedance: alone[ball].impedance,
            sliding,
            deviations: self.deviations[ball],
        });
        let free: f64 = alone.iter().map(|ball| f64::from(ball.torque)).sum();
        let row = PressedRow::of(&neighbours, &balls).unwrap_or_default();
        let rubbing = neighbours.ball_friction * row.torques.largest;
        RowAnswer {
            torque: f64::from(sliding) * free + f64::from(row.torques.groove + row.torques.ball),
            forces: row
                .forces
                .iter()
                .map(|along| along * speeds.outward.hypot(1.0))
                .collect(),
            flagged: !(law.holds_forces(load, branch, interval)
                && law.holds_rubbing(rubbing, sliding)),
        }
    }

    fn load<const N: usize>(&self, law: &BallLaw<N>) -> (f32, usize) {
        let branch = usize::from(self.axial_load < 0.0);
        (law.load_of(self.axial_load), branch)
    }
}

/// Balls of an open row, as a step presses them: in two passes where they rub.
#[derive(Clone, Debug, Default)]
pub struct PressedRow {
    /// Forces between neighbours along the track, N.
    pub forces: Vec<f64>,
    /// What each ball meets.
    pub torques: PressedTorques,
}

impl PressedRow {
    const MOST: usize = 255;

    /// None where a ball runs further from nominal rolling than a step takes, or there are none or too many.
    #[must_use]
    pub fn of(neighbours: &NeighbourLaw, balls: &[BallOfRow]) -> Option<Self> {
        let mut press = Press::<{ Self::MOST }>::with_balls(balls.len()).ok()?;
        let mut room = vec![0.0; balls.len()];
        *room.last_mut()? = f32::INFINITY;
        let mut solve = |free: &[FreeBall]| {
            let solved = press.solve_rubbing(free, &room);
            solved.then(|| found(&press))
        };
        let all = |of: fn(&NeighbourLaw, &BallOfRow, f32) -> FreeBall| -> Vec<FreeBall> {
            balls.iter().map(|ball| of(neighbours, ball, 1.0)).collect()
        };
        let found = if neighbours.ball_friction > 0.0 {
            let found = solve(&all(NeighbourLaw::first))?;
            let second = balls.iter().zip(&found);
            let second: Vec<FreeBall> = second
                .map(|(ball, found)| {
                    neighbours.second(ball, found, neighbours.rubbing(ball, found))
                })
                .collect();
            solve(&second)?
        } else {
            solve(&all(NeighbourLaw::smooth))?
        };
        let mut torques = PressedTorques::default();
        for (ball, found) in balls.iter().zip(&found) {
            if found.forces > 0.0 {
                let rubbing = neighbours.rubbing(ball, found);
                neighbours.lose(ball, found, rubbing, &mut torques);
            }
        }
        let forces = press.forces().take(balls.len() - 1);
        Some(Self {
            forces: forces.map(f64::from).collect(),
            torques,
        })
    }
}

fn found<const N: usize>(press: &Press<N>) -> Vec<Neighbours> {
    let behind = std::iter::once(0.0).chain(press.forces());
    let pressed = behind.zip(press.forces()).zip(press.speeds());
    pressed
        .map(|((behind, ahead), speed)| Neighbours {
            speed,
            forces: behind + ahead,
            rubbing: behind + ahead,
        })
        .collect()
}
