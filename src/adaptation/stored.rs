//! An adaptation's state across ignition.

use core::borrow::Borrow;

use super::Adaptation;
use super::constants::{AdaptationConstants, UPKEEP};
use super::estimates::ESTIMATES;
use super::factor::{Factor, LEAST, Projection};
use super::health::HealthState;
use super::state::AdaptationState;
use crate::error::Range;
use crate::stored::{Block, Fingerprint, Fingerprinted, Label, OVERHEAD, Port, Refusal, Stored};

/// Number of the kind in a block; those of scenes are below.
const KIND: u16 = 0x1000;

/// Entries of `U` above its diagonal.
const ABOVE: usize = ESTIMATES * (ESTIMATES - 1) / 2;

impl<const N: usize> Stored for Factor<N> {
    const BYTES: usize = 4 * (N + N * (N - 1) / 2);

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        // No variance exceeds that of the set-up, but for rounding.
        let variance = Range::new(LEAST, 1.01);
        port.numbers("diagonal", &mut self.diagonal, variance)?;
        for (index, column) in self.columns.iter_mut().enumerate() {
            for above in column.iter_mut().take(index) {
                port.number("above", above, Range::new(-1e6, 1e6))?;
            }
        }
        if self.variances().iter().all(|&entry| entry <= 1.01) {
            Ok(())
        } else {
            Err(Refusal::OutOfRange { field: "variance" })
        }
    }
}

impl Stored for HealthState {
    const BYTES: usize = 3 * 4 + 2;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        let level = Range::new(-0.9, 9.0);
        port.number("average", &mut self.average, level)?;
        port.number("commissioned", &mut self.commissioned, level)?;
        port.number("drift", &mut self.health.drift, Range::new(-0.99, 99.0))?;
        port.flag("fallen", &mut self.health.fallen)?;
        port.flag("risen", &mut self.health.risen)
    }
}

/// The filter begins anew, and a reading that was only looked at is left out: what they hold is of milliseconds.
impl Stored for AdaptationState {
    const BYTES: usize = 4 * ESTIMATES + Factor::<ESTIMATES>::BYTES + 2 + HealthState::BYTES;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.numbers("estimates", &mut self.estimates, Range::new(-1e4, 1e4))?;
        self.covariance.exchange(port)?;
        port.count("tick", &mut self.tick, UPKEEP - 1)?;
        port.count("next", &mut self.next, ESTIMATES as u8 - 1)?;
        self.health.exchange(port)?;
        self.observed = 0.0;
        self.regressors = [0.0; ESTIMATES];
        self.error = 0.0;
        self.seen = Projection::NONE;
        self.moves = [0.0; ESTIMATES];
        Ok(())
    }
}

impl Fingerprinted for AdaptationConstants {
    /// What the numbers are read with. Filter, gate, bounds and thresholds may change from one ignition to the next.
    fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        fingerprint.count(ABOVE as u32);
        fingerprint.number(self.per_noise);
        fingerprint.numbers(&self.deviations);
        fingerprint.numbers(&[self.growth, self.prior]);
    }
}

impl<C: Borrow<AdaptationConstants>> Adaptation<C> {
    /// Bytes of a block that holds the state: see [`stored`](crate::stored) for its layout.
    pub const STATE_BYTES: usize = OVERHEAD + AdaptationState::BYTES;

    /// Writes the state as a block to the begin of `bytes` and gives its length, [`STATE_BYTES`](Adaptation::STATE_BYTES): when the
    /// ignition goes off, outside the interrupt.
    ///
    /// The block has the estimates, their covariance and the slow average with its commissioning; not the constants, nor the filter.
    ///
    /// # Errors
    /// [`Refusal::Length`] where `bytes` are too short.
    pub fn export(&self, bytes: &mut [u8]) -> Result<usize, Refusal> {
        let mut state = self.state;
        self.block().seal(&mut state, bytes)
    }

    /// Takes over the state of a block that an adaptation with the same noise, deviations and forgetting exported: when the ignition goes on.
    ///
    /// A block is refused for what [`stored`](crate::stored) says, and where an estimate is outside the bounds of these constants. On
    /// a refusal the adaptation is as it was.
    ///
    /// # Errors
    /// The [`Refusal`].
    pub fn import(&mut self, block: &[u8]) -> Result<(), Refusal> {
        let mut state = self.state;
        self.block().open(&mut state, block)?;
        let constants = self.constants.borrow();
        if !constants.allows(&state.estimates) {
            return Err(Refusal::OutOfRange { field: "estimates" });
        }
        state.at_bound = constants.binds(&state.estimates);
        self.state = state;
        Ok(())
    }

    /// The block around states of these constants.
    #[inline(never)]
    fn block(&self) -> Block {
        let mut fingerprint = Fingerprint::default();
        self.constants.borrow().fingerprint(&mut fingerprint);
        let label = Label {
            kind: KIND,
            balls: 0,
            fingerprint,
        };
        Block::new(label, AdaptationState::BYTES)
    }
}
