//! Elasto-plastic bristles.

use std::f64::consts::PI;

use epas_reference::presliding::answers::Tick;

use super::{Law, limit};

/// LuGre's bristles that only bend up to a part of their largest deflection (Dupont, Hayward, Armstrong and Altpeter 2002), implicit in the deflection.
#[derive(Clone, Debug, PartialEq)]
pub struct ElastoPlastic {
    stiffness: f64,
    /// Deflection from which bristles slip, over the largest one.
    elastic_share: f64,
    deflection: f64,
}

impl ElastoPlastic {
    /// Bristles of a stiffness that stick up to this share of their largest deflection.
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
        if slip > 0.0 {
            self.deflection = (self.deflection + tick.turn) / (1.0 + slip / largest);
        } else {
            self.deflection += tick.turn;
        }
        self.stiffness * self.deflection
    }

    fn energy(&self) -> f64 {
        0.5 * self.stiffness * self.deflection.powi(2)
    }
}
