//! What elements remember as bytes, and what their torques are read with.

use super::load_exact::LoadExactElements;
use super::parallel::{ParallelElements, ParallelElementsState};
use super::preloaded::PreloadedElements;
use super::proportional::ProportionalElements;
use super::seat::{SeatElement, SeatState};
use super::state::{LARGEST, MemoryState};
use crate::error::Range;
use crate::stored::{Fingerprint, Fingerprinted, Port, Refusal, Stored};

/// Kinds of elements.
const PROPORTIONAL: u32 = 1;
const LOAD_EXACT: u32 = 2;
const SEAT: u32 = 3;
const TOGETHER: u32 = 4;
const PRELOADED: u32 = 5;

impl<const N: usize> Stored for MemoryState<N> {
    const BYTES: usize = 4 * N;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.numbers("held", &mut self.held, Range::new(-LARGEST, LARGEST))
    }
}

impl<const N: usize> Fingerprinted for ProportionalElements<N> {
    fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        fingerprint.count(PROPORTIONAL);
        fingerprint.numbers(&self.rates);
        fingerprint.numbers(&self.shares);
    }
}

impl<const N: usize> Fingerprinted for LoadExactElements<N> {
    fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        fingerprint.count(LOAD_EXACT);
        fingerprint.numbers(&self.stiffnesses);
        fingerprint.numbers(&self.onsets);
    }
}

impl<E: Fingerprinted> Fingerprinted for PreloadedElements<E> {
    fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        fingerprint.count(PRELOADED);
        self.elements.fingerprint(fingerprint);
    }
}

impl Stored for SeatState {
    const BYTES: usize = 4;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.number(
            "displacement",
            &mut self.displacement,
            Range::new(-1e6, 1e6),
        )
    }
}

impl Fingerprinted for SeatElement {
    fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        fingerprint.count(SEAT);
        fingerprint.numbers(&[self.free_play, self.stiffness]);
    }
}

impl<A: Stored, B: Stored> Stored for ParallelElementsState<A, B> {
    const BYTES: usize = A::BYTES + B::BYTES;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        self.first.exchange(port)?;
        self.second.exchange(port)
    }
}

impl<A: Fingerprinted, B: Fingerprinted> Fingerprinted for ParallelElements<A, B> {
    fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        fingerprint.count(TOGETHER);
        self.first.fingerprint(fingerprint);
        self.second.fingerprint(fingerprint);
        fingerprint.number(self.share);
    }
}
