//! Newton's method with a Levenberg term and an energy test.

use super::ball::Touch;
use super::contact::ContactConstants;
use super::problem::{State, StaticLoad};
use super::shaft::ShaftModel;
use super::solution::{LEAST_FORCE, StaticSolution};
use super::system::{Evaluation, System};
use crate::error::ReferenceError;
use nalgebra::Vector2;

const LARGEST_ITERATIONS: usize = 300;
/// Smallest Levenberg term, relative to the stiffness. With hardly any contact closed the load alone decides the step, and this
/// term bounds it.
const LEAST_LEVENBERG: f64 = 1e-13;
/// Residual relative to the largest force at which the search ends.
const TOLERANCE: f64 = 1e-11;
/// A search that can improve no further because of rounding has converged where its residual, relative to the largest force, is below this.
const ROUNDING: f64 = 1e-7;

impl StaticLoad {
    /// Finds the loads from a start that suits the axial load, in three to ten steps.
    pub fn solve(&self) -> Result<StaticSolution, ReferenceError> {
        self.solve_from(self.start())
    }

    /// State with nothing moved but what is held.
    pub fn rest(&self) -> State {
        State {
            nodes: self
                .held()
                .iter()
                .map(|value| value.unwrap_or(0.0))
                .collect(),
            balls: vec![Vector2::zeros(); self.arms.len()],
        }
    }

    /// Shaft moved along its axis by the closed form of evenly shared axial load,
    /// `u = (C_S + C_N) (F / (N sin(beta) cos(alpha)))^(2/3) / (sin(beta) cos(alpha))`, each ball by half of
    /// it. From rest without oversize no contact has a stiffness yet.
    pub fn start(&self) -> State {
        let mut state = self.rest();
        let held = self.held();
        if held.iter().skip(2).step_by(6).any(Option::is_some) {
            return state;
        }
        let load: f64 = self.loads.iter().skip(2).step_by(6).sum();
        let lead = self.geometry.lead_angle().cos();
        let share = self.geometry.contact_angle.sin() * lead;
        let ContactConstants { screw, nut } = self.contact;
        let compliance = screw.deflection + nut.deflection;
        let force = load.abs() / (self.balls.len() as f64 * share);
        let mean: f64 =
            self.balls.iter().map(|ball| ball.oversize).sum::<f64>() / self.balls.len() as f64;
        let clearance = if mean < 0.0 { -2.0 * mean } else { 0.0 };
        let travel = load.signum()
            * (compliance * force.cbrt().powi(2) + if load == 0.0 { 0.0 } else { clearance })
            / share;
        for (value, held) in state.nodes.iter_mut().zip(held).skip(2).step_by(6) {
            if held.is_none() {
                *value = travel;
            }
        }
        for ball in &mut state.balls {
            ball.y = 0.5 * travel * lead;
        }
        state
    }

    /// Energy of a state, J, and its gradient over node displacements and ball centres.
    pub fn energy(&self, state: &State) -> (f64, State) {
        let at = System::new(self).evaluate(state);
        let gradient = State {
            nodes: at.nodes,
            balls: at.balls,
        };
        (at.energy, gradient)
    }

    /// Finds the loads from any start. Held displacements take their values whatever the start says.
    pub fn solve_from(&self, mut state: State) -> Result<StaticSolution, ReferenceError> {
        self.fits(&state)?;
        for (value, held) in state.nodes.iter_mut().zip(self.held()) {
            if let Some(held) = held {
                *value = held;
            }
        }
        let system = System::new(self);
        let held = self.held();
        let mut at = system.evaluate(&state);
        let mut levenberg = 0.0;
        for iteration in 0..LARGEST_ITERATIONS {
            let residual = self.residual(&at, &held);
            if residual <= TOLERANCE {
                return Ok(StaticSolution::new(self, &state, &at, iteration, residual));
            }
            let reference = self.reference_stiffness(&at);
            let mut moved = None;
            while moved.is_none() && levenberg < 1e6 {
                let step = system.step(&at, levenberg, reference);
                moved = step.and_then(|step| {
                    [1.0, 0.5, 0.25, 0.1, 0.02].into_iter().find_map(|share| {
                        let trial = state.moved(&step.nodes, &step.balls, share);
                        let there = system.evaluate(&trial);
                        // Near the minimum the energy changes by less than its rounding; there the residual decides.
                        let better = there.energy < at.energy
                            || (there.energy <= at.energy + 1e-12 * at.magnitude
                                && self.residual(&there, &held) < residual);
                        better.then_some((trial, there, share))
                    })
                });
                if moved.is_none() {
                    levenberg = (30.0 * levenberg).max(LEAST_LEVENBERG);
                }
            }
            let Some((trial, there, share)) = moved else {
                if residual <= ROUNDING || self.at_rounding(&system, &state, &at, &held) {
                    return Ok(StaticSolution::new(self, &state, &at, iteration, residual));
                }
                return Err(not_converged(residual));
            };
            (state, at) = (trial, there);
            if share == 1.0 {
                levenberg *= 0.05;
                if levenberg < LEAST_LEVENBERG {
                    levenberg = 0.0;
                }
            }
        }
        let residual = self.residual(&at, &held);
        if residual <= ROUNDING {
            return Ok(StaticSolution::new(
                self,
                &state,
                &at,
                LARGEST_ITERATIONS,
                residual,
            ));
        }
        Err(not_converged(residual))
    }

    fn fits(&self, state: &State) -> Result<(), ReferenceError> {
        let right_size =
            state.nodes.len() == self.loads.len() && state.balls.len() == self.arms.len();
        let finite = state.nodes.iter().all(|value| value.is_finite())
            && state
                .balls
                .iter()
                .flat_map(|ball| ball.iter())
                .all(|value| value.is_finite());
        if right_size && finite {
            Ok(())
        } else {
            Err(ReferenceError::input("start", "does not fit the load case"))
        }
    }

    /// Stiffness of a contact under the mean or the largest load, N/m.
    fn reference_stiffness(&self, at: &Evaluation) -> f64 {
        let load = self
            .loads
            .iter()
            .fold(0.0, |sum: f64, value| sum.max(value.abs()));
        let force = (load / self.balls.len() as f64)
            .max(largest_force(&at.touches))
            .max(1e-12);
        1.5 * force.cbrt() / self.contact.screw.deflection
    }

    /// Whether all that is unbalanced comes from rounding: displacements of 0.1 mm on a shaft of 1e10 N/m
    /// are known to 1e-9 N only, which tiny loads on small balls do not reach.
    fn at_rounding(
        &self,
        system: &System<'_>,
        state: &State,
        at: &Evaluation,
        held: &[Option<f64>],
    ) -> bool {
        let noise = system.rounding(state);
        let radius = self.geometry.pitch_radius;
        let sides = noise
            .chunks_exact(6)
            .fold([0.0_f64; 2], |[force, moment], six| {
                let (forces, moments) = six.split_at(3);
                let largest =
                    |values: &[f64], least: f64| values.iter().copied().fold(least, f64::max);
                [largest(forces, force), largest(moments, moment)]
            });
        let reach = sides[0].max(sides[1] / radius);
        let unbalanced = at
            .nodes
            .iter()
            .zip(held)
            .enumerate()
            .filter(|(_, (_, held))| held.is_none())
            .map(|(dof, (gradient, _))| {
                if dof % 6 < 3 {
                    gradient.abs()
                } else {
                    gradient.abs() / radius
                }
            })
            .chain(at.balls.iter().map(Vector2::norm))
            .fold(0.0, f64::max);
        unbalanced <= 4.0 * reach
    }

    /// Largest unbalanced force over the largest of loads, contact forces and held reactions; moments count as forces at the pitch radius.
    fn residual(&self, at: &Evaluation, held: &[Option<f64>]) -> f64 {
        let radius = self.geometry.pitch_radius;
        let as_force = |dof: usize, value: f64| {
            if dof % 6 < 3 {
                value.abs()
            } else {
                value.abs() / radius
            }
        };
        let bar = self.shaft.model == ShaftModel::Bar;
        let mut scale = largest_force(&at.touches).max(LEAST_FORCE);
        let mut worst = at
            .balls
            .iter()
            .fold(0.0, |worst: f64, pull| worst.max(pull.norm()));
        for (dof, ((gradient, held), load)) in
            at.nodes.iter().zip(held).zip(&self.loads).enumerate()
        {
            if held.is_none() {
                worst = worst.max(as_force(dof, *gradient));
            } else if !bar {
                scale = scale.max(as_force(dof, *gradient));
            }
            scale = scale.max(as_force(dof, *load));
        }
        worst / scale
    }
}

fn not_converged(residual: f64) -> ReferenceError {
    ReferenceError::NotConverged {
        residual,
        unit: "of the largest force",
    }
}

fn largest_force(touches: &[[Option<Touch>; 4]]) -> f64 {
    touches
        .iter()
        .flatten()
        .flatten()
        .fold(0.0, |largest: f64, touch| largest.max(touch.force))
}

impl State {
    fn moved(&self, nodes: &[f64], balls: &[Vector2<f64>], share: f64) -> Self {
        Self {
            nodes: self
                .nodes
                .iter()
                .zip(nodes)
                .map(|(value, step)| value + share * step)
                .collect(),
            balls: self
                .balls
                .iter()
                .zip(balls)
                .map(|(value, step)| value + share * step)
                .collect(),
        }
    }
}
