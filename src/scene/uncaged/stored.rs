//! A ball screw without cage as bytes.

use super::{Ring, UncagedBallScrew, UncagedConstants, UncagedState};
use crate::scene::circuit::CircuitState;
use crate::scene::stored::StoredScene;
use crate::stored::{Fingerprint, Port, Refusal, Stored};

impl<const N: usize> StoredScene for UncagedBallScrew<N> {
    const KIND: u16 = 2;
    const BALLS: u16 = N as u16;

    fn fingerprint(constants: &UncagedConstants<N>, fingerprint: &mut Fingerprint) {
        constants.ring.fingerprint(fingerprint);
        constants.circuit.fingerprint(fingerprint);
        fingerprint.numbers(&[constants.friction, constants.clearance, constants.per_ball]);
    }

    fn complete(
        constants: &UncagedConstants<N>,
        state: &mut UncagedState<N>,
    ) -> Result<(), Refusal> {
        state.circuit.train.in_order()?;
        state.ring.complete(&constants.ring)
    }

    fn forget_readings(_: &mut UncagedState<N>) {}
}

impl<const N: usize> Stored for UncagedState<N> {
    const BYTES: usize = CircuitState::<N>::BYTES + Ring::<N>::BYTES;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        self.circuit.exchange(port)?;
        self.ring.exchange(port)
    }
}
