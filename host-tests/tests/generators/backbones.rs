//! Tables of elements: the best broken line of so many pieces, from its definition, and how near to it the stored ones are.

use epas_friction::law::memory::{
    Backbone, SLIP_4, SLIP_6, SLIP_8, SLIP_10, SPIN_4, SPIN_6, SPIN_8, SPIN_10,
};
use roots::{SimpleConvergency, find_root_brent};

fn slip(z: f64) -> f64 {
    1.0 - (1.0 - z).max(0.0).powf(1.5)
}

fn spin(z: f64) -> f64 {
    1.5 * z / (1.0 + 2.25 * z * z).sqrt()
}

/// A curve that rises to 1 with a falling slope, and where it ends to rise.
#[derive(Clone, Copy)]
struct Curve {
    at: fn(f64) -> f64,
    end: f64,
}

const SLIP: Curve = Curve { at: slip, end: 1.0 };
const SPIN: Curve = Curve { at: spin, end: 1e3 };

/// Where a function that falls through zero between two places does so.
fn zero(low: f64, high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let mut accuracy = SimpleConvergency {
        eps: 1e-15,
        max_iter: 200,
    };
    find_root_brent(low, high, f, &mut accuracy).unwrap()
}

impl Curve {
    /// Corners of the broken line from zero that goes as far as it can with every piece within `error` of the curve: a piece touches
    /// the curve less the error, and ends where it meets the curve and the error. None where it is at 1 before.
    fn furthest(self, count: usize, error: f64) -> Option<Vec<(f64, f64)>> {
        let curve = self.at;
        let (mut z, mut value) = (0.0, 0.0);
        let mut corners = Vec::new();
        for piece in 1..=count {
            // The steepest line to the curve less the error, by the golden section: its slope rises to the tangent's and falls.
            let slope = |to: f64| (curve(to) - error - value) / (to - z);
            let (mut low, mut high) = (z + 1e-9 * self.end.min(1.0), self.end);
            let section = 0.5 * (5_f64.sqrt() - 1.0);
            for _ in 0..120 {
                let (left, right) = (high - section * (high - low), low + section * (high - low));
                if slope(left) > slope(right) {
                    high = right;
                } else {
                    low = left;
                }
            }
            let touching = 0.5 * (low + high);
            let steepest = slope(touching);
            let above = |to: f64| value + steepest * (to - z) - curve(to) - error;
            let limit = z + (1.0 + error - value) / steepest + 1e-9;
            if above(limit) < 0.0 {
                return None;
            }
            let corner = zero(touching, limit, above);
            (z, value) = (corner, value + steepest * (corner - z));
            corners.push((z, value));
            // Within the error of 1 the curve needs no further piece.
            if value > 1.0 || piece < count && value >= 1.0 - error {
                return None;
            }
        }
        Some(corners)
    }

    /// The least error of `count` pieces that end at 1, with their corners: a larger error takes the line further.
    fn best(self, count: usize) -> (f64, Vec<(f64, f64)>) {
        let (mut low, mut high) = (1e-6, 0.2);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            match self.furthest(count, middle) {
                Some(_) => low = middle,
                None => high = middle,
            }
        }
        (high, self.furthest(count, low).unwrap())
    }

    /// Largest distance of a broken line from the curve: at corners, and at the tangents in between.
    fn error(self, elements: &[(f64, f64)]) -> f64 {
        let line = |z: f64| {
            elements
                .iter()
                .map(|(angle, weight)| weight * (z / angle).min(1.0))
                .sum::<f64>()
        };
        let off = |z: f64| (line(z) - (self.at)(z)).abs();
        let last = elements.last().unwrap().0;
        let grid = (0..=200_000).map(|step| last * f64::from(step) / 200_000.0);
        grid.chain(elements.iter().map(|element| element.0))
            .map(off)
            .fold(0.0, f64::max)
    }

    /// Compares a stored table with the best one: its error is what it says, and the best one's is less by no more than `gain`.
    fn holds<const N: usize>(self, name: &str, table: &Backbone<N>, gain: f64) {
        let stored = table
            .elements
            .map(|element| (f64::from(element.angle), f64::from(element.weight)));
        let (least, _) = self.best(N);
        let error = self.error(&stored);
        let sum: f64 = stored.iter().map(|element| element.1).sum();
        // Derived: rounded to f32 one by one, each by 6e-8 of less than one.
        assert!((sum - 1.0).abs() < 6e-8 * N as f64);
        // Derived: said to five decimals, rounded up.
        let said = f64::from(table.error);
        assert!(
            error <= said && error > said - 1.1e-5,
            "{name}: {error} where {said} is said"
        );
        assert!(
            error / least < gain && error >= least * (1.0 - 1e-6),
            "{name}: {}",
            error / least
        );
        assert!(stored.windows(2).all(|pair| pair[0].0 < pair[1].0));
    }
}

/// The best line's own corners, as weights: the fall of the slope at each.
fn elements(corners: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut before = (0.0, 0.0);
    let mut slopes: Vec<f64> = corners
        .iter()
        .map(|&corner| {
            let slope = (corner.1 - before.1) / (corner.0 - before.0);
            before = corner;
            slope
        })
        .collect();
    slopes.push(0.0);
    corners
        .iter()
        .zip(slopes.windows(2))
        .map(|(corner, pair)| (corner.0, corner.0 * (pair[0] - pair[1])))
        .collect()
}

#[test]
fn the_best_line_has_the_error_that_it_is_found_for() {
    for (curve, count) in [(SLIP, 4), (SLIP, 8), (SPIN, 6), (SPIN, 10)] {
        let (least, corners) = curve.best(count);
        let error = curve.error(&elements(&corners));
        // Measured: 1.4e-13, of a corner that is sought to 1e-15.
        assert!((error / least - 1.0).abs() < 4e-13, "{error} {least}");
    }
}

/// The stored ones were fitted to loops, by a search that stopped. They are what stored cases were made with.
#[test]
fn stored_tables_are_near_the_best_ones() {
    // Measured: 1.110, 1.125, 1.267 and 1.315; 1.437, 1.592, 2.091 and 1.619.
    SLIP.holds("slip4", &SLIP_4, 1.12);
    SLIP.holds("slip6", &SLIP_6, 1.14);
    SLIP.holds("slip8", &SLIP_8, 1.28);
    SLIP.holds("slip10", &SLIP_10, 1.32);
    SPIN.holds("spin4", &SPIN_4, 1.45);
    SPIN.holds("spin6", &SPIN_6, 1.6);
    SPIN.holds("spin8", &SPIN_8, 2.1);
    SPIN.holds("spin10", &SPIN_10, 1.63);
}
