//! The laws one by one.

use std::f64::consts::PI;

use epas_calibrate::bristle::bristle;
use epas_friction::law::memory::Hysteresis;
use epas_friction::law::{Elements, SlidingLimits};
use epas_reference::presliding::answers::Tick;
use epas_reference::presliding::{Limits, elements};

use super::Law;

fn limit(tick: &Tick) -> f64 {
    if tick.turn < 0.0 {
        tick.limits.backward
    } else {
        tick.limits.forward
    }
}

/// `dT/dtheta = K (1 - s T/L)^p` with the direction `s` of the motion and the limit `L` (Dahl 1968), one explicit step a tick; where
/// there is no exponent `p`, it is 1, by implicit steps ([`bristle`]). LuGre's bristles have the exponent 1 (Canudas de Wit and others
/// 1995); with 1/3 the first loading is Mindlin's.
pub struct Dahl {
    stiffness: f64,
    exponent: Option<f64>,
    torque: f64,
}

impl Dahl {
    pub fn new(stiffness: f64, exponent: Option<f64>) -> Self {
        Self {
            stiffness,
            exponent,
            torque: 0.0,
        }
    }
}

impl Law for Dahl {
    fn follow(&mut self, tick: &Tick) -> f64 {
        let pull = self.stiffness * tick.turn;
        if tick.turn == 0.0 {
        } else if let Some(exponent) = self.exponent {
            let left = 1.0 - tick.turn.signum() * self.torque / limit(tick);
            self.torque += pull * left.abs().powf(exponent).copysign(left);
        } else {
            self.torque = bristle(self.torque, pull, limit(tick));
        }
        self.torque
    }

    fn energy(&self) -> f64 {
        0.5 * self.torque.powi(2) / self.stiffness
    }
}

/// LuGre's bristles that only bend up to a part of their largest deflection (Dupont, Hayward, Armstrong and Altpeter 2002), implicit in the
/// deflection.
pub struct ElastoPlastic {
    stiffness: f64,
    /// Deflection from which bristles slip, over the largest one.
    elastic_share: f64,
    deflection: f64,
}

impl ElastoPlastic {
    pub fn new(stiffness: f64, elastic_share: f64) -> Self {
        Self {
            stiffness,
            elastic_share,
            deflection: 0.0,
        }
    }

    /// Share of the motion that slips: none where bristles unbend.
    fn slipping(&self, turn: f64, largest: f64) -> f64 {
        let size = self.deflection.abs();
        let elastic = self.elastic_share * largest;
        if self.deflection * turn <= 0.0 || size <= elastic {
            0.0
        } else if size >= largest {
            1.0
        } else {
            0.5 * (PI * (size - 0.5 * (largest + elastic)) / (largest - elastic)).sin() + 0.5
        }
    }
}

impl Law for ElastoPlastic {
    fn follow(&mut self, tick: &Tick) -> f64 {
        let largest = limit(tick) / self.stiffness;
        let slip = self.slipping(tick.turn, largest) * tick.turn.abs();
        self.deflection += tick.turn;
        if slip > 0.0 {
            self.deflection /= 1.0 + slip / largest;
        }
        self.stiffness * self.deflection
    }

    fn energy(&self) -> f64 {
        0.5 * self.stiffness * self.deflection.powi(2)
    }
}

/// Elements that stick, and while they slide are drawn to their share of the sliding friction with a lag (generalized Maxwell slip,
/// Al-Bender, Lampaert and Swevers 2005): `dF/dt = s C (share - s F / L)` with the direction `s` and the limit `L`. An element sticks
/// again when the motion turns.
pub struct Generalized {
    elements: Vec<Element>,
    /// `C` times the tick, over the limit.
    attraction: f64,
}

struct Element {
    stiffness: f64,
    share: f64,
    torque: f64,
    /// Direction in which it slides, 0 where it sticks.
    sliding: f64,
}

impl Generalized {
    pub fn new(angles: &[f64], shares: &[f64], attraction: f64) -> Self {
        let element = |(angle, share): (&f64, &f64)| Element {
            stiffness: share / angle,
            share: *share,
            torque: 0.0,
            sliding: 0.0,
        };
        Self {
            elements: angles.iter().zip(shares).map(element).collect(),
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
        let elements = self.elements.iter_mut();
        elements
            .map(|element| element.follow(tick, self.attraction))
            .sum()
    }

    fn energy(&self) -> f64 {
        let elements = self.elements.iter();
        elements
            .map(|element| 0.5 * element.torque.powi(2) / element.stiffness)
            .sum()
    }
}

/// A hysteresis in angle times the load, as tyre models multiply LuGre's bristles: stiffness changes with the load, and so does the
/// stored energy, though nothing moves.
pub struct Multiplied {
    pub elements: elements::Elements,
    pub load: f64,
}

impl Law for Multiplied {
    fn follow(&mut self, tick: &Tick) -> f64 {
        self.load = tick.load;
        tick.load * self.elements.follow(tick.turn, Limits::UNIT, 1.0)
    }

    fn energy(&self) -> f64 {
        self.load * self.elements.energy()
    }
}

/// Elements of the crate, in f32, and what they remember.
pub struct Remembered<E: Elements> {
    elements: E,
    state: E::State,
}

impl<E: Hysteresis + 'static> Remembered<E> {
    pub fn start(elements: E) -> Box<dyn Law> {
        Box::new(Self {
            elements,
            state: E::VIRGIN,
        })
    }
}

impl<E: Hysteresis> Law for Remembered<E> {
    fn follow(&mut self, tick: &Tick) -> f64 {
        let limits = SlidingLimits {
            forward: tick.limits.forward as f32,
            backward: tick.limits.backward as f32,
            load: tick.load as f32,
        };
        let turn = tick.turn as f32;
        self.elements.follow(&mut self.state, turn, &limits).into()
    }

    fn energy(&self) -> f64 {
        self.elements.stored_energy(&self.state).into()
    }
}
