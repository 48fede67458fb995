//! Balls of the contacts' friction as bytes. The laws are those of the constants.

use super::{Contacts, ContactsState, OTHER_TURN};
use crate::ball::elastic::nominal::{Grooving, NominalBall};
use crate::stored::{Fingerprint, Port, Refusal, Stored};

impl Stored for ContactsState {
    const BYTES: usize = 2 * NominalBall::BYTES + Grooving::BYTES + 2;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        self.balls
            .iter_mut()
            .try_for_each(|ball| ball.exchange(port))?;
        self.grooving.exchange(port)?;
        port.flag("changes", &mut self.changes)?;
        port.count("turn", &mut self.turn, OTHER_TURN - 1)
    }
}

impl Contacts {
    /// What the state's numbers are read with.
    pub(in crate::scene::caged) fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        self.ball.fingerprint(fingerprint);
        fingerprint.numbers(&[self.friction, self.clearance.gap(), self.balls]);
    }

    /// Puts in what follows from a state that has been read.
    ///
    /// # Errors
    /// [`Refusal::OutOfRange`] naming `clearance`.
    pub(in crate::scene::caged) fn complete(
        &self,
        state: &mut ContactsState,
    ) -> Result<(), Refusal> {
        state.grooving.complete(&self.ball)?;
        self.keep_out_foreign_laws(state);
        Ok(())
    }
}
