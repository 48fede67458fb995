//! A ball screw without cage as bytes.

use super::{UncagedBallScrew, UncagedConstants, UncagedFriction, UncagedState};
use crate::ball::pressed::BallOfRow;
use crate::ranges;
use crate::scene::circuit::CircuitState;
use crate::scene::faults::Faults;
use crate::scene::sliding::TrainFriction;
use crate::scene::stored::StoredScene;
use crate::stored::{Fingerprint, Port, Refusal, Stored};

impl<const N: usize, const NODES: usize> StoredScene for UncagedBallScrew<N, NODES> {
    const KIND: u16 = 6;
    const BALLS: u16 = N as u16;

    fn balls(state: &UncagedState<N>) -> u16 {
        state.circuit.train.balls() as u16
    }

    /// The friction coefficient has a meaning of its own; only its range has to fit, which [`Self::complete`] sees to.
    fn fingerprint(constants: &UncagedConstants<N, NODES>, fingerprint: &mut Fingerprint) {
        constants.circuit.fingerprint(fingerprint);
        let per_ball = constants.circuit.per_loaded_ball();
        fingerprint.numbers(&[constants.reduced_lead, per_ball]);
    }

    fn complete(
        constants: &UncagedConstants<N, NODES>,
        state: &mut UncagedState<N>,
    ) -> Result<(), Refusal> {
        state.circuit.train.in_order()?;
        let friction = state.friction.friction();
        if constants.law.holds(friction) {
            state.friction = constants.interval(friction);
            Ok(())
        } else {
            Err(Refusal::OutOfRange { field: "friction" })
        }
    }

    fn forget_readings(_: &mut UncagedState<N>) {}
}

impl<const N: usize> Stored for UncagedState<N> {
    const BYTES: usize = CircuitState::<N>::BYTES + 4;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        self.circuit.exchange(port)?;
        let mut friction = self.friction.friction();
        port.number("friction", &mut friction, ranges::FRICTION_OF_A_ROW)?;
        self.friction = self.friction.with_friction(friction);
        self.balls = [BallOfRow::UNLOADED; N];
        Ok(())
    }
}

impl Stored for UncagedFriction {
    const BYTES: usize = TrainFriction::BYTES + Faults::BYTES;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        self.row.exchange(port)?;
        self.faults.exchange(port)
    }
}
