//! A whole ball screw without cage in closed form: balls that recirculate and press on each other (Lin 2019, section 3.4.4), each moving by
//! [`super::ball_screw_closed`]. For figures 3.24 and 3.25 of the dissertation; the exact whole screw is [`super::ball_screw_ring`].

use nalgebra::{DMatrix, DVector};

use super::ball_screw_closed::{ContactAngles, Support, ThreePointBall, ThreePointModel};
use super::ball_screw_elastic::BallSlip;
use crate::error::{ReferenceError, within};

/// Ball screw with a contact-angle deviation on the screw that varies along the track, evenly loaded balls, and a closed return.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WholeScrew {
    /// Closed-form model of a ball.
    pub model: ThreePointModel,
    /// Number of balls.
    pub balls: usize,
    /// Turns of the loaded track; the return joins its ends without delay.
    pub turns: f64,
    /// Axial load on the screw, N, along z; the balls share it evenly.
    pub axial_load: f64,
    /// Angular velocity of the nut, rad/s.
    pub nut_speed: f64,
    /// Amplitude of the deviation `theta = amplitude sin(cycles phi)` of the contact angles on the screw, rad: `+theta` on SR,
    /// `-theta` on SL (Figure 3.21).
    pub deviation: f64,
    /// Cycles of the deviation per turn: 2 in Figure 3.23.
    pub cycles: f64,
    /// Friction coefficient between balls.
    pub ball_friction: f64,
    /// Convention of the slip between balls.
    pub ball_slip: BallSlip,
}

/// State of the screw at one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct WholeScrewState {
    /// Angle of the nut, rad.
    pub nut_angle: f64,
    /// Azimuths of the balls on the screw, rear to front, rad.
    pub azimuths: Vec<f64>,
    /// Speeds of the balls, rad/s.
    pub speeds: Vec<f64>,
    /// Force between ball `j` and the next, the last with the first, N.
    pub contact_forces: Vec<f64>,
    /// Friction torque of the main groove contacts, N m.
    pub main_torque: f64,
    /// Friction torque of the third contacts, N m.
    pub third_torque: f64,
    /// Friction torque of the ball-to-ball contacts, N m.
    pub ball_torque: f64,
    /// Smallest angular gap between two balls, rad; negative when they overlap.
    pub smallest_gap: f64,
}

impl WholeScrewState {
    /// Friction torque of all groove contacts, N m.
    pub fn groove_torque(&self) -> f64 {
        self.main_torque + self.third_torque
    }

    /// Number of pressing ball-to-ball contacts.
    pub fn contacts(&self) -> usize {
        self.contact_forces
            .iter()
            .filter(|force| **force > 0.0)
            .count()
    }
}

const TABLE: usize = 512;

impl WholeScrew {
    fn ball(&self, deviation: f64) -> Result<ThreePointBall, ReferenceError> {
        let support = Support::of(self.axial_load, self.nut_speed);
        let angle = self.model.contact_angle;
        // The load is carried by SR-NL when negative along z: then the main contact on the screw is SR.
        let main = if self.axial_load < 0.0 {
            deviation
        } else {
            -deviation
        };
        let angles = match support {
            Support::ThirdOnNut => ContactAngles {
                screw: angle + main,
                nut: angle,
                third: angle,
            },
            _ => ContactAngles {
                screw: angle + main,
                nut: angle,
                third: angle - main,
            },
        };
        self.model.ball(
            support,
            angles,
            self.axial_load / self.balls as f64,
            self.nut_speed,
        )
    }

    /// Share of the track that the balls fill: `n 2 asin(2 pi R_B/L)/(2 pi turns)`, 97.8 per cent in the text.
    pub fn occupation(&self) -> f64 {
        let (sin, _) = self.model.track.ball_contact_angle();
        self.balls as f64 * sin.asin() / (std::f64::consts::PI * self.turns)
    }

    /// Simulates from evenly spaced balls, `steps` equal steps of nut angle up to `nut_angle`, each of `substeps`; a state at the start and
    /// after each step.
    ///
    /// In every substep the balls move at the speeds `w_j = free_j + (Y_j/(L/2 pi)) (F_(j-1) - F_j)/(L/2 pi)` that solve `F >= 0`, `gap >=
    /// 0` at its end, `F gap = 0`: a linear complementarity problem with an M-matrix, solved by growing the set of contacts until no gap is
    /// negative. The rule printed in (3.77), by the free speeds of two neighbours, lets chains of balls overlap.
    pub fn simulate(
        &self,
        nut_angle: f64,
        steps: usize,
        substeps: usize,
    ) -> Result<Vec<WholeScrewState>, ReferenceError> {
        within("balls", self.balls as f64, 2.0, 1000.0)?;
        within("turns", self.turns, 0.1, 100.0)?;
        within("deviation", self.deviation, -0.2, 0.2)?;
        within("cycles", self.cycles, 0.0, 100.0)?;
        within("ball_friction", self.ball_friction, 0.0, 1.0)?;
        within("nut_angle", nut_angle, 0.0, 1e6)?;
        within("steps", steps as f64, 1.0, 1e7)?;
        within("substeps", substeps as f64, 1.0, 1e6)?;
        within("balls", self.occupation(), 0.0, 1.0)?;
        let size = self.deviation.abs().max(1e-9);
        let table = (0..=2 * TABLE)
            .map(|i| self.ball(size * (i as f64 / TABLE as f64 - 1.0)))
            .collect::<Result<Vec<_>, _>>()?;
        let n = self.balls;
        let ring = std::f64::consts::TAU * self.turns;
        let direction = self.nut_speed.signum();
        let diameter = 2.0 * self.model.track.ball_contact_angle().0.asin();
        let step = nut_angle / (steps * substeps) as f64 / self.nut_speed.abs();
        let mut azimuths: Vec<f64> = (0..n)
            .map(|j| ring * j as f64 / n as f64 * direction)
            .collect();
        let mut states = Vec::with_capacity(steps + 1);
        for count in 0..=steps * substeps {
            let balls: Vec<_> = azimuths
                .iter()
                .map(|phi| {
                    interpolate(
                        &table,
                        (self.deviation * (self.cycles * phi).sin() / size + 1.0) * TABLE as f64,
                    )
                })
                .collect();
            let gaps: Vec<_> = (0..n)
                .map(|j| {
                    let ahead = if j + 1 < n {
                        azimuths[j + 1]
                    } else {
                        azimuths[0] + direction * ring
                    };
                    (ahead - azimuths[j]) * direction - diameter
                })
                .collect();
            let (speeds, forces) = self.press(&balls, &gaps, step);
            if count % substeps == 0 {
                let nut_angle = count as f64 * step * self.nut_speed.abs();
                states.push(self.state(
                    nut_angle,
                    &azimuths,
                    &balls,
                    speeds.clone(),
                    forces,
                    &gaps,
                ));
            }
            for (phi, speed) in azimuths.iter_mut().zip(&speeds) {
                *phi += speed * step;
            }
        }
        Ok(states)
    }

    fn press(&self, balls: &[ThreePointBall], gaps: &[f64], step: f64) -> (Vec<f64>, Vec<f64>) {
        let n = balls.len();
        let path = self.model.track.path_radius();
        let free: Vec<_> = balls.iter().map(|b| b.orbital_speed.abs()).collect();
        // Angular speed per newton: v = w L/2 pi, w = (Y F)/(L/2 pi).
        let give: Vec<_> = balls.iter().map(|b| b.compliance / path).collect();
        let mut forces = vec![0.0; n];
        let mut active = vec![false; n];
        loop {
            let speeds: Vec<_> = (0..n)
                .map(|j| free[j] + give[j] * (forces[(j + n - 1) % n] - forces[j]))
                .collect();
            let mut grown = false;
            for j in 0..n {
                let gap = gaps[j] + step * (speeds[(j + 1) % n] - speeds[j]);
                if !active[j] && gap < 0.0 {
                    active[j] = true;
                    grown = true;
                }
            }
            let set: Vec<usize> = (0..n).filter(|j| active[*j]).collect();
            if !grown || set.len() == n {
                let direction = self.nut_speed.signum();
                return (speeds.iter().map(|w| w * direction).collect(), forces);
            }
            let matrix = DMatrix::from_fn(set.len(), set.len(), |row, column| {
                let (i, j) = (set[row], set[column]);
                let mut entry = 0.0;
                if i == j {
                    entry += give[i] + give[(i + 1) % n];
                }
                if j == (i + 1) % n {
                    entry -= give[j];
                }
                if i == (j + 1) % n {
                    entry -= give[i];
                }
                entry
            });
            let right = DVector::from_fn(set.len(), |row, _| {
                let i = set[row];
                free[i] - free[(i + 1) % n] - gaps[i] / step
            });
            if let Some(solution) = matrix.lu().solve(&right) {
                for (j, force) in set.iter().zip(solution.iter()) {
                    forces[*j] = force.max(0.0);
                }
            }
        }
    }

    fn state(
        &self,
        nut_angle: f64,
        azimuths: &[f64],
        balls: &[ThreePointBall],
        speeds: Vec<f64>,
        contact_forces: Vec<f64>,
        gaps: &[f64],
    ) -> WholeScrewState {
        let n = balls.len();
        let r = self.model.track.ball_radius;
        let (_, cos_a) = self.model.track.lead_angle();
        let loss: f64 = (0..n)
            .map(|j| {
                let next = (j + 1) % n;
                let orbit = match self.ball_slip {
                    BallSlip::Orbiting => (speeds[j] + speeds[next]) * cos_a,
                    BallSlip::Total => 0.0,
                };
                let slip = (balls[j].spin + balls[next].spin - orbit).abs() * r;
                self.ball_friction * contact_forces[j] * slip
            })
            .sum();
        WholeScrewState {
            nut_angle,
            azimuths: azimuths.to_vec(),
            speeds,
            main_torque: balls.iter().map(|b| b.main_loss).sum::<f64>() / self.nut_speed,
            third_torque: balls.iter().map(|b| b.third_loss).sum::<f64>() / self.nut_speed,
            ball_torque: loss / self.nut_speed,
            smallest_gap: gaps.iter().copied().fold(f64::INFINITY, f64::min),
            contact_forces,
        }
    }
}

fn interpolate(table: &[ThreePointBall], at: f64) -> ThreePointBall {
    let last = table.len() - 1;
    let at = at.clamp(0.0, last as f64);
    let low = (at as usize).min(last - 1);
    let part = at - low as f64;
    let mix =
        |f: fn(&ThreePointBall) -> f64| f(&table[low]) * (1.0 - part) + f(&table[low + 1]) * part;
    ThreePointBall {
        orbital_speed: mix(|b| b.orbital_speed),
        spin: mix(|b| b.spin),
        main_load: mix(|b| b.main_load),
        third_load: mix(|b| b.third_load),
        compliance: mix(|b| b.compliance),
        main_loss: mix(|b| b.main_loss),
        third_loss: mix(|b| b.third_loss),
    }
}
