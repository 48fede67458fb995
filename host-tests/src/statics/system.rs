//! Energy, residual and Newton step of a load case; each ball is eliminated by its own 2 x 2 block.

use nalgebra::{DMatrix, Matrix2, SMatrix, SVector, Vector2};
use nalgebra_sparse::CscMatrix;
use nalgebra_sparse::factorization::CscCholesky;

use super::ball::{Arm, Touch};
use super::problem::{State, StaticLoad};
use super::shaft::ShaftModel;

/// Degrees of freedom and the banded matrix over the free ones.
pub struct System<'a> {
    case: &'a StaticLoad,
    free: Vec<Option<usize>>,
    free_count: usize,
    elements: Vec<SMatrix<f64, 12, 12>>,
    /// First row of each column of the band, and where its values start.
    first_row: Vec<usize>,
    start: Vec<usize>,
    rows: Vec<usize>,
    diagonal: Vec<f64>,
}

/// Energy and forces of a state.
pub struct Evaluation {
    /// Total energy, J.
    pub energy: f64,
    /// Sum of the magnitudes of all parts of the energy, J: its rounding error is relative to this.
    pub magnitude: f64,
    /// Gradient over all node displacements.
    pub nodes: Vec<f64>,
    /// Gradient over each ball's centre.
    pub balls: Vec<Vector2<f64>>,
    /// Contacts of each ball.
    pub touches: Vec<[Option<Touch>; 4]>,
}

/// A Newton step.
pub struct Step {
    /// Of all node displacements.
    pub nodes: Vec<f64>,
    /// Of each ball's centre.
    pub balls: Vec<Vector2<f64>>,
}

impl<'a> System<'a> {
    /// Sets up the band.
    pub fn new(case: &'a StaticLoad) -> Self {
        let held = case.held();
        let mut free_count = 0;
        let free: Vec<_> = held
            .iter()
            .map(|value| {
                value.is_none().then(|| {
                    free_count += 1;
                    free_count - 1
                })
            })
            .collect();
        let node_count = case.shaft.nodes.len();
        let elements: Vec<_> = case
            .shaft
            .nodes
            .windows(2)
            .map(|ends| case.shaft.section.stiffness(ends[1] - ends[0]))
            .collect();

        // Lowest node that each node is coupled with: its neighbour, or through a ball one further off.
        let mut lowest: Vec<usize> = (0..node_count).map(|node| node.saturating_sub(1)).collect();
        for arms in &case.arms {
            let nodes = || arms.iter().flatten().filter_map(|arm| arm.node);
            let (Some(low), Some(high)) = (nodes().min(), nodes().max()) else {
                continue;
            };
            for entry in lowest.iter_mut().take(high + 2).skip(low) {
                *entry = low.min(*entry);
            }
        }
        let mut highest: Vec<usize> = (0..node_count).collect();
        for (node, low) in lowest.iter().enumerate() {
            for entry in &mut highest[*low..node] {
                *entry = node.max(*entry);
            }
        }
        let first_free: Vec<usize> = {
            let mut next = free_count;
            let mut first = vec![free_count; node_count + 1];
            for node in (0..node_count).rev() {
                if let Some(index) = free[6 * node..6 * node + 6].iter().flatten().next() {
                    next = *index;
                }
                first[node] = next;
            }
            first
        };
        let mut first_row = Vec::with_capacity(free_count);
        let mut start = vec![0];
        let mut rows = Vec::new();
        for (dof, index) in free.iter().enumerate() {
            if index.is_some() {
                let node = dof / 6;
                let (low, high) = (first_free[lowest[node]], first_free[highest[node] + 1]);
                first_row.push(low);
                rows.extend(low..high);
                start.push(rows.len());
            }
        }
        let mut diagonal = vec![0.0; free.len()];
        for (element, stiffness) in elements.iter().enumerate() {
            for line in 0..12 {
                diagonal[6 * element + line] += stiffness[(line, line)];
            }
        }
        Self {
            case,
            free,
            free_count,
            elements,
            first_row,
            start,
            rows,
            diagonal,
        }
    }

    fn pair(nodes: &[f64], node: usize) -> SVector<f64, 12> {
        let mut pair = SVector::<f64, 12>::zeros();
        for (entry, value) in pair.iter_mut().zip(nodes.iter().skip(6 * node)) {
            *entry = *value;
        }
        pair
    }

    fn add_pair(nodes: &mut [f64], node: usize, pair: &SVector<f64, 12>) {
        for (value, entry) in nodes.iter_mut().skip(6 * node).zip(pair.iter()) {
            *value += *entry;
        }
    }

    fn motion(arm: &Arm, nodes: &[f64]) -> Vector2<f64> {
        arm.node
            .map_or_else(Vector2::zeros, |node| arm.motion * Self::pair(nodes, node))
    }

    /// Energy, gradient and contacts of a state.
    pub fn evaluate(&self, state: &State) -> Evaluation {
        let mut nodes = vec![0.0; state.nodes.len()];
        let mut energy = 0.0;
        let mut magnitude = 0.0;
        for (element, stiffness) in self.elements.iter().enumerate() {
            let pair = Self::pair(&state.nodes, element);
            let force = stiffness * pair;
            let part = 0.5 * pair.dot(&force);
            energy += part;
            magnitude += part.abs();
            Self::add_pair(&mut nodes, element, &force);
        }
        for ((gradient, load), value) in nodes.iter_mut().zip(&self.case.loads).zip(&state.nodes) {
            *gradient -= load;
            energy -= load * value;
            magnitude += (load * value).abs();
        }
        let mut balls = Vec::with_capacity(state.balls.len());
        let mut touches = Vec::with_capacity(state.balls.len());
        for (arms, centre) in self.case.arms.iter().zip(&state.balls) {
            let mut sum = Vector2::zeros();
            let mut four = [None; 4];
            for (touch, arm) in four.iter_mut().zip(arms) {
                let Some(arm) = arm else { continue };
                let here = arm.touch(*centre, Self::motion(arm, &state.nodes));
                energy += here.energy;
                magnitude += here.energy;
                let push = here.force * here.normal;
                sum += push;
                if let (Some(node), true) = (arm.node, here.force > 0.0) {
                    let pair = arm.motion.transpose() * -push;
                    Self::add_pair(&mut nodes, node, &pair);
                }
                *touch = Some(here);
            }
            balls.push(sum);
            touches.push(four);
        }
        Evaluation {
            energy,
            magnitude,
            nodes,
            balls,
            touches,
        }
    }

    /// What rounding of the displacements leaves in the shaft's forces.
    pub fn rounding(&self, state: &State) -> Vec<f64> {
        let mut noise = vec![0.0; state.nodes.len()];
        for (element, stiffness) in self.elements.iter().enumerate() {
            let pair = Self::pair(&state.nodes, element).abs();
            Self::add_pair(
                &mut noise,
                element,
                &(f64::EPSILON * (stiffness.abs() * pair)),
            );
        }
        noise
    }

    fn add_block(
        &self,
        values: &mut [f64],
        (row_node, column_node): (usize, usize),
        block: &SMatrix<f64, 12, 12>,
    ) {
        for column in 0..12 {
            let Some(Some(free_column)) = self.free.get(6 * column_node + column) else {
                continue;
            };
            let base = self.start[*free_column];
            let first = self.first_row[*free_column];
            for row in 0..12 {
                if let Some(Some(free_row)) = self.free.get(6 * row_node + row) {
                    values[base + free_row - first] += block[(row, column)];
                }
            }
        }
    }

    /// Newton step with a Levenberg term: `levenberg` is relative to the shaft's stiffness and to
    /// `reference`, N/m, a stiffness of contacts. None where the matrix is not positive definite.
    pub fn step(&self, at: &Evaluation, levenberg: f64, reference: f64) -> Option<Step> {
        let mut values = vec![0.0; self.rows.len()];
        for (element, stiffness) in self.elements.iter().enumerate() {
            self.add_block(&mut values, (element, element), stiffness);
        }
        let mut right: Vec<f64> = at.nodes.iter().map(|value| -value).collect();
        let ball_term = levenberg * reference;
        let mut eliminated = Vec::with_capacity(at.balls.len());
        for ((arms, touches), pull) in self.case.arms.iter().zip(&at.touches).zip(&at.balls) {
            let mut block = Matrix2::zeros();
            for touch in touches.iter().flatten() {
                block += touch.stiffness;
            }
            let trace = block.trace();
            if trace <= 0.0 {
                eliminated.push(Matrix2::zeros());
                continue;
            }
            // A single rounding of the trace keeps the inverse finite for a ball on the verge of contact.
            block += Matrix2::identity() * (ball_term + 1e-15 * trace);
            let inverse = block.try_inverse()?;
            eliminated.push(inverse);
            let shift = inverse * -pull;
            for (first, touch) in arms.iter().zip(touches) {
                let (Some(arm), Some(touch)) = (first, touch) else {
                    continue;
                };
                let (Some(node), true) = (arm.node, touch.force > 0.0) else {
                    continue;
                };
                let left = arm.motion.transpose() * touch.stiffness;
                Self::add_pair(&mut right, node, &(left * shift));
                for (second, other) in arms.iter().zip(touches) {
                    let (Some(other_arm), Some(other)) = (second, other) else {
                        continue;
                    };
                    let (Some(other_node), true) = (other_arm.node, other.force > 0.0) else {
                        continue;
                    };
                    let mut schur = -(touch.stiffness * inverse * other.stiffness);
                    if arm.contact == other_arm.contact {
                        schur += touch.stiffness;
                    }
                    let whole = arm.motion.transpose() * schur * other_arm.motion;
                    self.add_block(&mut values, (node, other_node), &whole);
                }
            }
        }
        let rigid = self.case.shaft.model == ShaftModel::Rigid;
        let lever = self.case.geometry.pitch_radius.powi(2);
        for (dof, index) in self.free.iter().enumerate() {
            if let Some(index) = index {
                let contact = if dof % 6 < 3 {
                    reference
                } else {
                    reference * lever
                };
                // A rounding's worth always: a direction that nothing resists is left alone.
                let floor = if rigid { 1e-14 } else { 1e-16 };
                let place = self.start[*index] + index - self.first_row[*index];
                values[place] += (levenberg + floor) * (self.diagonal[dof] + contact);
            }
        }
        let free_right: Vec<f64> = self
            .free
            .iter()
            .zip(&right)
            .filter(|(index, _)| index.is_some())
            .map(|(_, value)| *value)
            .collect();
        let solved = self.solve(values, &free_right)?;
        let nodes: Vec<f64> = self
            .free
            .iter()
            .map(|index| index.map_or(0.0, |index| solved[index]))
            .collect();
        let mut balls = Vec::with_capacity(at.balls.len());
        for (((arms, touches), pull), inverse) in self
            .case
            .arms
            .iter()
            .zip(&at.touches)
            .zip(&at.balls)
            .zip(eliminated)
        {
            let mut drive = -pull;
            for (arm, touch) in arms.iter().zip(touches) {
                if let (Some(arm), Some(touch)) = (arm, touch) {
                    drive += touch.stiffness * Self::motion(arm, &nodes);
                }
            }
            balls.push(inverse * drive);
        }
        Some(Step { nodes, balls })
    }

    fn solve(&self, values: Vec<f64>, right: &[f64]) -> Option<Vec<f64>> {
        if self.free_count == 0 {
            return Some(Vec::new());
        }
        let matrix = CscMatrix::try_from_csc_data(
            self.free_count,
            self.free_count,
            self.start.clone(),
            self.rows.clone(),
            values,
        )
        .ok()?;
        let factor = CscCholesky::factor(&matrix).ok()?;
        let mut solved = DMatrix::from_column_slice(right.len(), 1, right);
        factor.solve_mut(&mut solved);
        solved
            .iter()
            .all(|value| value.is_finite())
            .then(|| solved.iter().copied().collect())
    }
}
