//! Generalized Maxwell slip.

use epas_reference::presliding::answers::Tick;

use super::{Law, limit};

/// Elements that stick, and while they slide are drawn to their share of the sliding friction with a lag (Al-Bender, Lampaert and Swevers 2005):
/// `dF/dt = s C (share - s F / L)` with the direction `s` and the limit `L`. An element sticks again when the motion turns.
#[derive(Clone, Debug, PartialEq)]
pub struct Generalized {
    elements: Vec<Element>,
    /// `C` times the tick, over the limit.
    attraction: f64,
}

#[derive(Clone, Debug, PartialEq)]
struct Element {
    stiffness: f64,
    share: f64,
    torque: f64,
    /// Direction in which it slides, 0 where it sticks.
    sliding: f64,
}

impl Generalized {
    /// Elements that slip at these angles, with these shares of the limit.
    pub fn new(angles: &[f64], shares: &[f64], attraction: f64) -> Self {
        Self {
            elements: angles
                .iter()
                .zip(shares)
                .map(|(angle, share)| Element {
                    stiffness: share / angle,
                    share: *share,
                    torque: 0.0,
                    sliding: 0.0,
                })
                .collect(),
            attraction,
        }
    }
}

impl Element {
    fn follow(&mut self, tick: &Tick, attraction: f64) -> f64 {
        let direction = tick.turn.signum();
        if tick.turn == 0.0 {
            return self.torque;
        }
        if self.sliding * direction < 0.0 {
            self.sliding = 0.0;
        }
        let limit = limit(tick);
        if self.sliding == 0.0 {
            self.torque += self.stiffness * tick.turn;
            if direction * self.torque > self.share * limit {
                self.sliding = direction;
                self.torque = direction * self.share * limit;
            }
        } else if limit > 0.0 {
            // Implicit, so that a fast attraction is stable.
            let drawn = self.torque + direction * attraction * self.share;
            self.torque = drawn / (1.0 + attraction / limit);
        } else {
            self.torque = 0.0;
        }
        self.torque
    }
}

impl Law for Generalized {
    fn follow(&mut self, tick: &Tick) -> f64 {
        let attraction = self.attraction;
        let elements = self.elements.iter_mut();
        elements
            .map(|element| element.follow(tick, attraction))
            .sum()
    }

    fn energy(&self) -> f64 {
        let elements = self.elements.iter();
        elements
            .map(|element| 0.5 * element.torque.powi(2) / element.stiffness)
            .sum()
    }
}
