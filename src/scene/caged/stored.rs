//! A caged screw as bytes: its friction coefficient.

use super::{CagedBallScrew, CagedConstants, CagedState};
use crate::ranges;
use crate::scene::stored::StoredScene;
use crate::stored::{Fingerprint, Port, Refusal, Stored};

impl<const NODES: usize> StoredScene for CagedBallScrew<NODES> {
    const KIND: u16 = 4;

    /// The friction coefficient has a meaning of its own; only its range has to fit, which [`Self::complete`] sees to.
    fn fingerprint(constants: &CagedConstants<NODES>, fingerprint: &mut Fingerprint) {
        fingerprint.number(constants.reduced_lead);
    }

    fn complete(constants: &CagedConstants<NODES>, state: &mut CagedState) -> Result<(), Refusal> {
        let friction = state.friction.friction();
        if constants.law.holds(friction) {
            state.friction = constants.interval(friction);
            Ok(())
        } else {
            Err(Refusal::OutOfRange { field: "friction" })
        }
    }

    fn forget_readings(_: &mut CagedState) {}
}

impl Stored for CagedState {
    const BYTES: usize = 4;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        let mut friction = self.friction.friction();
        port.number("friction", &mut friction, ranges::FRICTION_OF_A_ROW)?;
        self.friction = self.friction.with_friction(friction);
        Ok(())
    }
}
