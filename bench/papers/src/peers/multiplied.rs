//! Elements whose torque is multiplied by the load.

use epas_reference::presliding::Limits;
use epas_reference::presliding::answers::Tick;
use epas_reference::presliding::elements::Elements;
use epas_reference::presliding::tables::Table;

use super::Law;

/// A hysteresis in angle times the load, as tyre models multiply LuGre's bristles: stiffness changes with the load, and so does the stored energy, though
/// nothing moves.
#[derive(Clone, Debug, PartialEq)]
pub struct Multiplied {
    elements: Elements,
    load: f64,
}

impl Multiplied {
    /// Elements of a table.
    pub fn new(table: &Table) -> Self {
        Self {
            elements: table.elements(),
            load: 1.0,
        }
    }
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
