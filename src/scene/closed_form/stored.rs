//! A screw by a closed form as bytes: it keeps none.

use super::{ClosedFormScrew, ClosedFormScrewConstants, ClosedFormScrewState};
use crate::scene::stored::StoredScene;
use crate::stored::{Fingerprint, Port, Refusal, Stored};

impl StoredScene for ClosedFormScrew {
    const KIND: u16 = 5;

    /// Nothing of the constants is in the state.
    fn fingerprint(_: &ClosedFormScrewConstants, fingerprint: &mut Fingerprint) {
        fingerprint.count(0);
    }

    fn complete(_: &ClosedFormScrewConstants, _: &mut ClosedFormScrewState) -> Result<(), Refusal> {
        Ok(())
    }

    fn forget_readings(_: &mut ClosedFormScrewState) {}
}

impl Stored for ClosedFormScrewState {
    const BYTES: usize = 0;

    fn exchange<P: Port>(&mut self, _: &mut P) -> Result<(), Refusal> {
        Ok(())
    }
}
