//! A linear bearing as bytes.

use super::{LinearBearingTrain, LinearConstants, LinearFriction, LinearState};
use crate::error::Range;
use crate::ranges;
use crate::scene::circuit::CircuitState;
use crate::scene::row::TrainFriction;
use crate::scene::stored::StoredScene;
use crate::stored::{Fingerprint, Port, Refusal, Stored};

impl<const N: usize> StoredScene for LinearBearingTrain<N> {
    const KIND: u16 = 3;
    const BALLS: u16 = N as u16;

    fn balls(state: &LinearState<N>) -> u16 {
        state.circuit.train.balls() as u16
    }

    fn fingerprint(constants: &LinearConstants<N>, fingerprint: &mut Fingerprint) {
        constants.circuit.fingerprint(fingerprint);
        let per_ball = constants.circuit.per_loaded_ball();
        fingerprint.numbers(&[
            constants.friction,
            per_ball * constants.normal,
            per_ball * constants.side,
            constants.wavelength,
        ]);
    }

    fn complete(_: &LinearConstants<N>, state: &mut LinearState<N>) -> Result<(), Refusal> {
        state.circuit.train.in_order()
    }

    fn forget_readings(_: &mut LinearState<N>) {}
}

impl<const N: usize> Stored for LinearState<N> {
    const BYTES: usize = CircuitState::<N>::BYTES + 4;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        self.circuit.exchange(port)?;
        // Any friction coefficient over any other.
        let largest = ranges::FRICTION.maximum / ranges::FRICTION.minimum;
        port.number(
            "friction",
            &mut self.friction,
            Range::new(0.5 / largest, 2.0 * largest),
        )
    }
}

impl Stored for LinearFriction {
    const BYTES: usize = TrainFriction::BYTES + 1;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        self.row.exchange(port)?;
        port.flag("beyond_model", &mut self.beyond_model)
    }
}
