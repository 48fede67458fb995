//! Rows of the regression: sums of the kernel over windows that lie in one direction of motion.

use nalgebra::DMatrix;

use super::fit::dot;
use super::kernel::Kernel;
use super::record::{QUARTER, Record};
use crate::trace::channels::median;

const ROWS: usize = 3;

/// Half-widths in a piece of a stretch.
const PIECE: usize = 8;

#[derive(Clone, Debug)]
pub struct Rows {
    pub kernel: Kernel,
    /// Sample at the middle of each row.
    pub centres: Vec<usize>,
    /// Direction of each row, 1 or -1.
    pub directions: Vec<f64>,
    pub stretches: Vec<usize>,
    /// Number of the piece of a stretch in which it lies; those of neighbours in a stretch differ by 1, those of two stretches by more.
    pub pieces: Vec<usize>,
    /// Median distance between two turns, rad or m.
    pub stroke: f64,
}

impl Rows {
    pub(crate) const fn none(kernel: Kernel) -> Self {
        Self {
            kernel,
            centres: Vec::new(),
            directions: Vec::new(),
            stretches: Vec::new(),
            pieces: Vec::new(),
            stroke: 0.0,
        }
    }

    /// Rows of a record for a kernel of `half` samples to each side, at least a way `settling`, rad or m, after a turn, and with `spare` samples
    /// of the stretch beyond the window. `None` where there is no stretch.
    pub fn of(record: &Record, half: usize, settling: f64, spare: usize) -> Option<Self> {
        let stretches = record.stretches(half);
        if stretches.is_empty() {
            return None;
        }
        let hop = (half / ROWS).max(1);
        let mut rows = Self::none(Kernel::new(half, record.tick));
        let mut strokes: Vec<(f64, f64)> = Vec::new();
        let mut next_piece = 0;
        for (number, stretch) in stretches.iter().enumerate() {
            let way = (record.path[stretch.last] - stretch.turn).abs();
            match strokes.last_mut() {
                Some((turn, longest)) if *turn == stretch.turn => *longest = longest.max(way),
                _ => strokes.push((stretch.turn, way)),
            }
            let settled = |sample: &usize| {
                stretch.direction * (record.path[*sample] - stretch.turn) >= settling
            };
            let first = (stretch.first..=stretch.last).find(settled);
            let Some(first) = first.map(|first| first + half + spare) else {
                continue;
            };
            let Some(last) = stretch.last.checked_sub(half + spare) else {
                continue;
            };
            let centres: Vec<usize> = (first..=last).step_by(hop).collect();
            let length = centres.last().map_or(0, |last| last - first);
            let pieces = (length / (PIECE * half)).max(1);
            for centre in centres {
                if record.sound(centre - half, centre + half) {
                    let piece = ((centre - first) * pieces / length.max(1)).min(pieces - 1);
                    rows.centres.push(centre);
                    rows.directions.push(stretch.direction);
                    rows.stretches.push(number);
                    rows.pieces.push(next_piece + piece);
                }
            }
            next_piece += pieces + 1;
        }
        rows.stroke = median(strokes.iter().map(|(_, way)| *way).collect());
        Some(rows)
    }

    pub fn len(&self) -> usize {
        self.centres.len()
    }

    /// A derivative, 0 to 3, of a signal in every row.
    pub fn sums(&self, order: usize, signal: &[f64]) -> Vec<f64> {
        self.centres
            .iter()
            .map(|centre| self.kernel.at(order, signal, *centre))
            .collect()
    }

    /// Covariance `sigma^2 sum phi_i phi_j` of the motion's noise in a row's columns, which are these derivatives of the motion, or none.
    pub fn noise(&self, record: &Record, derivatives: &[Option<usize>]) -> DMatrix<f64> {
        let weights = |k: usize| Some(self.kernel.weights(record.order(derivatives[k]?)));
        let entry = |i: usize, j: usize| Some(dot(weights(i)?, weights(j)?));
        let count = derivatives.len();
        DMatrix::from_fn(count, count, |i, j| {
            record.noise.powi(2) * entry(i, j).unwrap_or(0.0)
        })
    }

    /// A signal in every row, so many samples later; what is beyond an end of it counts as the end.
    pub fn later(&self, by: isize, signal: &[f64]) -> Vec<f64> {
        let at = |centre: &usize| {
            let centre = centre.saturating_add_signed(by);
            self.kernel.at(0, signal, centre)
        };
        self.centres.iter().map(at).collect()
    }

    fn smooth(&self, load: &[f64]) -> Vec<f64> {
        Kernel::new((self.kernel.half() / QUARTER).max(3), 1.0).along(0, load)
    }

    /// The sign of a load in every row, which is that of a short mean.
    pub fn signs(&self, load: &[f64]) -> Vec<f64> {
        let signs: Vec<f64> = self.smooth(load).iter().map(|load| load.signum()).collect();
        self.sums(0, &signs)
    }

    /// The positive and the negative part of a load in every row; its sign is that of a short mean.
    pub fn parts(&self, load: &[f64]) -> [Vec<f64>; 2] {
        let smooth = self.smooth(load);
        [1.0, -1.0].map(|sign| {
            let part: Vec<f64> = smooth.iter().map(|load| (sign * load).max(0.0)).collect();
            self.sums(0, &part)
        })
    }
}
