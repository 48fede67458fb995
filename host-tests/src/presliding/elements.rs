//! A few parallel elements that stick and slip (Maxwell slip, Prandtl-Ishlinskii; Iwan 1966), each a spring in series with a slider.
//!
//! A tick moves every spring and brings its torque back between the slider's limits: `f <- hold(f + k turn)`. That is the backward Euler
//! step of elastoplasticity (Simo and Hughes 1998), exact for motion in one direction, so any tick and any stiffness is stable. The stored energy
//! is `sum f^2 / (2 k)`; with constant `k` no change of the limits raises it, so the elements are passive.

use std::num::NonZeroUsize;

use gauss_quad::GaussLegendre;

use super::Limits;

/// One element.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Element {
    stiffness: f64,
    /// What its limit follows from: its share of the whole limit, or the approach at which it meets the surface.
    place: f64,
    torque: f64,
}

/// How the limits of the elements follow from the whole limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Law {
    Proportional,
    LoadExact,
}

/// Parallel elements.
#[derive(Clone, Debug, PartialEq)]
pub struct Elements {
    law: Law,
    elements: Vec<Element>,
}

impl Elements {
    /// Elements that slip at these angles of a first loading under limits of one, each with a share of the limit. Their limits stay in
    /// proportion to the whole.
    ///
    /// # Panics
    /// Where an angle is not positive.
    pub fn proportional(angles: &[f64], shares: &[f64]) -> Self {
        assert!(angles.iter().all(|angle| *angle > 0.0), "{angles:?}");
        Self {
            law: Law::Proportional,
            elements: angles
                .iter()
                .zip(shares)
                .map(|(angle, share)| Element {
                    stiffness: share / angle,
                    place: *share,
                    torque: 0.0,
                })
                .collect(),
        }
    }

    /// `count` elements that meet the surface one after the other as the load rises, up to `largest_load`: Gauss-Legendre nodes of the
    /// integral that [`super::load_exact`] solves in closed form.
    pub fn load_exact(count: NonZeroUsize, largest_load: f64) -> Self {
        let rule = GaussLegendre::new(count);
        let half = 0.5 * largest_load.cbrt();
        let mut elements: Vec<_> = rule
            .as_node_weight_pairs()
            .iter()
            .map(|&(node, weight)| Element {
                stiffness: 1.5 * half * weight,
                place: (half * (node + 1.0)).powi(2),
                torque: 0.0,
            })
            .collect();
        elements.sort_by(|one, other| one.place.total_cmp(&other.place));
        Self {
            law: Law::LoadExact,
            elements,
        }
    }

    /// `count` elements of the same kind at the middles of equal intervals.
    pub fn dense(count: usize, largest_load: f64) -> Self {
        let width = largest_load.cbrt() / count as f64;
        Self {
            law: Law::LoadExact,
            elements: (0..count)
                .map(|index| Element {
                    stiffness: 1.5 * width,
                    place: (width * (index as f64 + 0.5)).powi(2),
                    torque: 0.0,
                })
                .collect(),
        }
    }

    /// Torque after a turn under `limits` and `load`; elements in proportion do not look at the load.
    pub fn follow(&mut self, turn: f64, limits: Limits, load: f64) -> f64 {
        let shares = Shares::new(self, load);
        let mut torque = 0.0;
        for element in &mut self.elements {
            let limits = limits.times(shares.of(element));
            element.torque = limits.hold(element.torque + element.stiffness * turn);
            torque += element.torque;
        }
        torque
    }

    /// Stored energy, over limit times breakaway angle.
    pub fn energy(&self) -> f64 {
        self.elements
            .iter()
            .map(|element| 0.5 * element.torque.powi(2) / element.stiffness)
            .sum()
    }
}

struct Shares {
    law: Law,
    approach: f64,
    sum: f64,
}

impl Shares {
    fn new(elements: &Elements, load: f64) -> Self {
        let approach = load.max(0.0).cbrt().powi(2);
        let sum = elements
            .elements
            .iter()
            .map(|element| element.stiffness * (approach - element.place).max(0.0))
            .sum();
        Self {
            law: elements.law,
            approach,
            sum,
        }
    }

    fn of(&self, element: &Element) -> f64 {
        match self.law {
            Law::Proportional => element.place,
            Law::LoadExact if self.sum > 0.0 => {
                element.stiffness * (self.approach - element.place).max(0.0) / self.sum
            }
            Law::LoadExact => 0.0,
        }
    }
}
