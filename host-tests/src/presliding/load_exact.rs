//! Exact hysteresis of a Hertzian contact whose load changes with the slip.
//!
//! A contact with slip in one direction is a row of independent springs (method of dimensionality reduction: Popov and Hess 2015; Jaeger
//! 1993 and Ciavarella 1998 say the same of superposed contacts). The spring at `x` meets the surface at the approach `x^2`; under the
//! approach `D = load^(2/3)` it carries friction up to `1.5 (D - x^2) dx`, and its stiffness `1.5 dx` never changes. Its deflection `u`
//! follows `u <- hold(u + turn)` between `-backward (D - x^2)` and `forward (D - x^2)`: over `v = x^2` a broken line for ever, kept as
//! such, and the torque `1.5 integral of u dx` is taken in closed form. Turn and load of one tick act at its end.

use super::Limits;

/// A corner of the broken line.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Corner {
    /// Square of the place, as an approach.
    approach: f64,
    deflection: f64,
}

/// Hysteresis of the contact. Limits are ratios: one for each direction, times the load.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadExact {
    /// Deflection over approach, from zero to the edge of the contact, where it is zero.
    line: Vec<Corner>,
}

impl Default for LoadExact {
    fn default() -> Self {
        Self::new()
    }
}

/// Corners whose removal moves the line by less than this are none: a part in 1e15 of a breakaway angle.
const STRAIGHT: f64 = 1e-15;

impl LoadExact {
    /// Nothing remembered, no load.
    pub fn new() -> Self {
        let corner = Corner {
            approach: 0.0,
            deflection: 0.0,
        };
        Self { line: vec![corner] }
    }

    /// Torque after a turn under limits of `ratio` times `load`.
    pub fn follow(&mut self, turn: f64, ratio: Limits, load: f64) -> f64 {
        let edge = load.max(0.0).cbrt().powi(2);
        self.reach(edge);
        for corner in &mut self.line {
            corner.deflection += turn;
        }
        self.hold(1.0, |approach| ratio.forward * (edge - approach));
        self.hold(-1.0, |approach| ratio.backward * (edge - approach));
        self.simplify();
        self.torque()
    }

    /// Ends the line at `edge`: springs beyond carry nothing, and those that met the surface just now have no deflection yet.
    fn reach(&mut self, edge: f64) {
        let inside = self
            .line
            .partition_point(|corner| corner.approach < edge)
            .max(1);
        let deflection = match (self.line.get(inside - 1), self.line.get(inside)) {
            (Some(one), Some(other)) => between(one, other, edge),
            _ => 0.0,
        };
        self.line.truncate(inside);
        if edge > 0.0 {
            self.line.push(Corner {
                approach: edge,
                deflection,
            });
        }
    }

    /// Keeps `side` times the deflection from passing a limit that is linear in the approach.
    fn hold(&mut self, side: f64, limit: impl Fn(f64) -> f64) {
        let excess = |corner: &Corner| side * corner.deflection - limit(corner.approach);
        if self.line.iter().all(|corner| excess(corner) <= 0.0) {
            return;
        }
        let mut held = Vec::with_capacity(self.line.len() + 2);
        let mut last: Option<Corner> = None;
        for corner in &self.line {
            if let Some(last) = last
                && excess(&last) * excess(corner) < 0.0
            {
                let share = excess(&last) / (excess(&last) - excess(corner));
                let approach = last.approach + share * (corner.approach - last.approach);
                held.push(Corner {
                    approach,
                    deflection: side * limit(approach),
                });
            }
            last = Some(*corner);
            held.push(if excess(corner) > 0.0 {
                Corner {
                    deflection: side * limit(corner.approach),
                    ..*corner
                }
            } else {
                *corner
            });
        }
        self.line = held;
    }

    fn simplify(&mut self) {
        let mut kept: Vec<Corner> = Vec::with_capacity(self.line.len());
        for corner in &self.line {
            while let [.., one, middle] = kept.as_slice()
                && (between(one, corner, middle.approach) - middle.deflection).abs() < STRAIGHT
            {
                kept.pop();
            }
            kept.push(*corner);
        }
        self.line = kept;
    }

    /// `1.5` times the integral of the deflection over the place: on a straight piece from `x` on, `h` long, the deflection is that at `x` plus
    /// a part that grows with `x^2`.
    fn torque(&self) -> f64 {
        let pieces = self.line.iter().zip(self.line.iter().skip(1));
        1.5 * pieces
            .map(|(one, other)| {
                let (start, end) = (one.approach.sqrt(), other.approach.sqrt());
                if end <= start {
                    return 0.0;
                }
                let length = end - start;
                let rise = other.deflection - one.deflection;
                length * (one.deflection + rise * (start + length / 3.0) / (start + end))
            })
            .sum::<f64>()
    }

    /// Corners of the broken line.
    pub fn corners(&self) -> usize {
        self.line.len()
    }
}

fn between(one: &Corner, other: &Corner, approach: f64) -> f64 {
    let span = other.approach - one.approach;
    if span <= 0.0 {
        return one.deflection;
    }
    let share = (approach - one.approach) / span;
    one.deflection + share * (other.deflection - one.deflection)
}
