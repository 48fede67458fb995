//! A circuit as bytes: its balls and the phase of the groove that passes by.

use super::configuration::{Circuit, CircuitState};
use crate::stored::{Fingerprint, Port, Refusal, Stored};
use crate::train::Train;

impl<const N: usize> Stored for CircuitState<N> {
    const BYTES: usize = <Train<N> as Stored>::BYTES + 8;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        self.train.exchange(port)?;
        self.phase.exchange(port)
    }
}

impl Circuit {
    /// The track and the period of the passing groove.
    pub(crate) fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        self.track.fingerprint(fingerprint);
        fingerprint.number(self.zone.passing_turns());
    }
}
