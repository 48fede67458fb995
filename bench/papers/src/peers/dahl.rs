//! Dahl's law, and LuGre's bristles, which are the same where speed does not matter.

use epas_reference::presliding::answers::Tick;

use super::{Law, limit};
use epas_calibrate::bristle::bristle;

/// `dT/dtheta = K (1 - s T/L)^p` with the direction `s` of the motion and the limit `L` (Dahl 1968), one explicit step a tick.
#[derive(Clone, Debug, PartialEq)]
pub struct Explicit {
    stiffness: f64,
    exponent: f64,
    torque: f64,
}

impl Explicit {
    /// Dahl's law. LuGre's bristles are its exponent 1; with 1/3 the first loading is Mindlin's.
    pub fn new(stiffness: f64, exponent: f64) -> Self {
        Self {
            stiffness,
            exponent,
            torque: 0.0,
        }
    }
}

impl Law for Explicit {
    fn follow(&mut self, tick: &Tick) -> f64 {
        if tick.turn != 0.0 {
            let left = 1.0 - tick.turn.signum() * self.torque / limit(tick);
            let slope = left.abs().powf(self.exponent).copysign(left);
            self.torque += self.stiffness * tick.turn * slope;
        }
        self.torque
    }

    fn energy(&self) -> f64 {
        0.5 * self.torque.powi(2) / self.stiffness
    }
}

/// The exponent 1 by implicit steps ([`bristle`]).
#[derive(Clone, Debug, PartialEq)]
pub struct Implicit {
    stiffness: f64,
    torque: f64,
}

impl Implicit {
    /// Dahl's law, or LuGre's bristles.
    pub fn new(stiffness: f64) -> Self {
        Self {
            stiffness,
            torque: 0.0,
        }
    }
}

impl Law for Implicit {
    fn follow(&mut self, tick: &Tick) -> f64 {
        if tick.turn != 0.0 {
            self.torque = bristle(self.torque, self.stiffness * tick.turn, limit(tick));
        }
        self.torque
    }

    fn energy(&self) -> f64 {
        0.5 * self.torque.powi(2) / self.stiffness
    }
}
