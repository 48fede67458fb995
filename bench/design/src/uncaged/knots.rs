//! Where the knots of a law lie: at the loads from which on numbers change in another proportion to the load.
//!
//! Numbers are linear between knots, and least squares over all loads give them for any set of knots. Knots are added where they lower the
//! errors most, and then moved until no move lowers them any more.

use super::Column;

/// Rounds in which knots are moved, at most.
const ROUNDS: usize = 40;

/// Intervals in which a next knot is tried.
const TRIED: usize = 4;

/// Knots, as places among rising loads.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Knots<'a> {
    /// All loads, N, rising.
    loads: &'a [f64],
    /// Places of the knots among them, rising, at least two.
    pub at: Vec<usize>,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Between {
    pub knot: usize,
    /// Shares of the knot below and of the one above.
    pub shares: [f64; 2],
}

impl<'a> Knots<'a> {
    /// At most so many knots, by the sum of the squares of the columns' weighted errors.
    pub fn placed(loads: &'a [f64], columns: &[Column], most: usize) -> Self {
        let mut knots = Self {
            loads,
            at: vec![0, loads.len() - 1],
        };
        while knots.at.len() < most.min(loads.len()) {
            let Some(next) = knots.with_one_more(columns) else {
                break;
            };
            knots = next;
        }
        for _ in 0..ROUNDS {
            if !knots.moved(columns) {
                break;
            }
        }
        knots
    }

    pub fn places(&self) -> Vec<Between> {
        let mut knot = 0;
        (0..self.loads.len())
            .map(|load| {
                while knot + 2 < self.at.len() && load >= self.at[knot + 1] {
                    knot += 1;
                }
                let [low, high] = [self.at[knot], self.at[knot + 1]].map(|at| self.loads[at]);
                let share = (self.loads[load] - low) / (high - low);
                Between {
                    knot,
                    shares: [1.0 - share, share],
                }
            })
            .collect()
    }

    /// Values at the knots with the least squares of a column's errors.
    pub fn fitted(&self, places: &[Between], column: &Column) -> Vec<f64> {
        let count = self.at.len();
        let (mut diagonal, mut beside) = (vec![0.0; count], vec![0.0; count]);
        let mut right = vec![0.0; count];
        for ((place, &value), &weight) in places.iter().zip(&column.values).zip(&column.weights) {
            let [low, high] = place.shares;
            let knot = place.knot;
            diagonal[knot] += weight * low * low;
            diagonal[knot + 1] += weight * high * high;
            beside[knot] += weight * low * high;
            right[knot] += weight * low * value;
            right[knot + 1] += weight * high * value;
        }
        // Elimination from the first knot on: the matrix has three diagonals.
        for knot in 1..count {
            let factor = beside[knot - 1] / diagonal[knot - 1];
            diagonal[knot] -= factor * beside[knot - 1];
            right[knot] -= factor * right[knot - 1];
        }
        for knot in (0..count).rev() {
            let above = if knot + 1 < count {
                beside[knot] * right[knot + 1]
            } else {
                0.0
            };
            right[knot] = (right[knot] - above) / diagonal[knot];
        }
        right
    }

    /// Sum of the squares of all columns' weighted errors at each load.
    fn errors(&self, columns: &[Column]) -> Vec<f64> {
        let places = self.places();
        let mut errors = vec![0.0; self.loads.len()];
        for column in columns {
            let values = self.fitted(&places, column);
            for (load, (error, place)) in errors.iter_mut().zip(&places).enumerate() {
                let [low, high] = place.shares;
                let found = low * values[place.knot] + high * values[place.knot + 1];
                *error += column.weights[load] * (found - column.values[load]).powi(2);
            }
        }
        errors
    }

    fn error(&self, columns: &[Column]) -> f64 {
        self.errors(columns).iter().sum()
    }

    /// One knot more, where it lowers the errors most, in one of the intervals that have the largest.
    fn with_one_more(&self, columns: &[Column]) -> Option<Self> {
        let errors = self.errors(columns);
        let mut intervals: Vec<(f64, usize, usize)> = self
            .at
            .windows(2)
            .filter(|ends| ends[1] > ends[0] + 1)
            .map(|ends| {
                let sum = errors[ends[0] + 1..ends[1]].iter().sum();
                (sum, ends[0], ends[1])
            })
            .collect();
        intervals.sort_by(|a, b| b.0.total_cmp(&a.0));
        let candidates = intervals
            .iter()
            .take(TRIED)
            .flat_map(|&(_, from, to)| {
                let step = ((to - from) / 16).max(1);
                (from + 1..to).step_by(step)
            })
            .map(|place| {
                let mut at = self.at.clone();
                at.insert(at.partition_point(|&other| other < place), place);
                Self {
                    loads: self.loads,
                    at,
                }
            });
        best(candidates.collect(), columns).map(|(_, knots)| knots)
    }

    /// Moves each knot to the neighbouring loads where that lowers the errors; and the one that is missed least to where it helps most.
    fn moved(&mut self, columns: &[Column]) -> bool {
        let before = self.error(columns);
        let mut error = before;
        for knot in 1..self.at.len() - 1 {
            let here = self.at[knot];
            let (low, high) = (self.at[knot - 1], self.at[knot + 1]);
            let candidates = [1, 2, 4, 8]
                .into_iter()
                .flat_map(|step| [here.checked_sub(step), Some(here + step)])
                .flatten()
                .filter(|&place| low < place && place < high)
                .map(|place| {
                    let mut there = self.clone();
                    there.at[knot] = place;
                    there
                });
            if let Some((found, there)) = best(candidates.collect(), columns)
                && found < error
            {
                (error, *self) = (found, there);
            }
        }
        let fewer = (1..self.at.len() - 1).map(|knot| {
            let mut there = self.clone();
            there.at.remove(knot);
            there
        });
        if let Some((_, fewer)) = best(fewer.collect(), columns)
            && let Some(there) = fewer.with_one_more(columns)
            && let found = there.error(columns)
            && found < error
        {
            (error, *self) = (found, there);
        }
        error < before * (1.0 - 1e-4)
    }
}

fn best<'a>(candidates: Vec<Knots<'a>>, columns: &[Column]) -> Option<(f64, Knots<'a>)> {
    let mut least: Option<(f64, Knots<'a>)> = None;
    for knots in candidates {
        let error = knots.error(columns);
        if least.as_ref().is_none_or(|(least, _)| error < *least) {
            least = Some((error, knots));
        }
    }
    least
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is linear between three kinks is held exactly by knots at the kinks.
    #[test]
    fn kinks_are_found() {
        let loads: Vec<f64> = (0..=100).map(f64::from).collect();
        let kinked = |x: f64| 1.0 + (x - 13.0).abs() + 0.5 * (x - 47.0).abs() - (x - 80.0).abs();
        let column = Column {
            values: loads.iter().map(|&load| kinked(load)).collect(),
            weights: vec![1.0; loads.len()],
        };
        let knots = Knots::placed(&loads, std::slice::from_ref(&column), 6);
        for kink in [0, 13, 47, 80, 100] {
            assert!(knots.at.contains(&kink), "{:?}", knots.at);
        }
        let error = knots.error(&[column]);
        assert!(error < 1e-20, "{error:e}");
    }
}
