//! The crate's own elements, in f32.

use epas_friction::Error;
use epas_friction::law::memory::{
    BackboneElement, Hysteresis, LoadExactElements, Part, ProportionalElements,
};
use epas_friction::law::{Elements, SlidingLimits};
use epas_reference::presliding::answers::Tick;

use super::Law;

/// Elements of the crate and what they remember.
pub struct Remembered<E: Elements> {
    elements: E,
    state: E::State,
}

impl<E: Elements> Remembered<E> {
    fn new(elements: E) -> Self {
        Self {
            elements,
            state: E::VIRGIN,
        }
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

/// Elements in proportion.
pub fn proportional<const N: usize>(
    backbone: &[BackboneElement; N],
) -> Result<Box<dyn Law>, Error> {
    let part = Part {
        backbone,
        share: 1.0,
        breakaway_angle: 1.0,
    };
    let elements = ProportionalElements::<N>::new(1.0, &[part])?;
    Ok(Box::new(Remembered::new(elements)))
}

/// Load-exact elements.
pub fn load_exact<const N: usize>(largest_load: f64) -> Result<Box<dyn Law>, Error> {
    let elements = LoadExactElements::<N>::new(1.0, 1.0, largest_load as f32)?;
    Ok(Box::new(Remembered::new(elements)))
}
