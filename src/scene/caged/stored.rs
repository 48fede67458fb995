//! A caged ball screw as bytes.

use super::contacts::ContactsState;
use super::{CagedBallScrew, CagedConstants, CagedState, Law};
use crate::scene::stored::StoredScene;
use crate::stored::{Fingerprint, Port, Refusal, Stored};

impl StoredScene for CagedBallScrew {
    const KIND: u16 = 1;
    const BALLS: u16 = 0;

    fn fingerprint(constants: &CagedConstants, fingerprint: &mut Fingerprint) {
        match &constants.law {
            Law::Contacts(contacts) => contacts.fingerprint(fingerprint),
            // Nothing of its constants is in the state.
            Law::Closed(_) => fingerprint.count(0),
        }
    }

    fn complete(constants: &CagedConstants, state: &mut CagedState) -> Result<(), Refusal> {
        match (&constants.law, &mut state.contacts) {
            (Law::Contacts(contacts), Some(state)) => contacts.complete(state),
            _ => Ok(()),
        }
    }

    fn forget_readings(_: &mut CagedState) {}
}

/// Nothing of a closed form.
impl Stored for CagedState {
    const BYTES: usize = ContactsState::BYTES;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        match &mut self.contacts {
            Some(contacts) => contacts.exchange(port),
            None => Ok(()),
        }
    }
}
