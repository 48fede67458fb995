//! Readings and plays as bytes, and what they are read with.

use super::angle::{AngleReading, WrappedAngle};
use super::counts::{CountReading, CountSensor};
use super::deadband::{Deadband, DeadbandReading};
use super::play::{Play, PlayState};
use super::speed::SpeedOverTick;
use crate::error::Range;
use crate::stored::{Fingerprint, Fingerprinted, Port, Refusal, Stored};

/// Kinds of sensors.
const COUNTS: u32 = 1;
const ANGLE: u32 = 2;
const SPEED: u32 = 3;
const STEADY: u32 = 4;

impl Stored for CountReading {
    const BYTES: usize = 5;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        let (mut known, mut last) = (self.0.is_some(), self.0.unwrap_or(0));
        port.flag("known", &mut known)?;
        port.word(&mut last)?;
        self.0 = known.then_some(last);
        Ok(())
    }
}

impl Fingerprinted for CountSensor {
    fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        fingerprint.count(COUNTS);
        fingerprint.count(self.period);
        fingerprint.number(self.turn_per_count);
    }
}

impl Stored for AngleReading {
    const BYTES: usize = 5;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        let (mut known, mut last) = (self.0.is_some(), self.0.unwrap_or(0.0));
        port.flag("known", &mut known)?;
        port.number("reading", &mut last, Range::new(-3e6, 3e6))?;
        self.0 = known.then_some(last);
        Ok(())
    }
}

impl Fingerprinted for WrappedAngle {
    fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        fingerprint.count(ANGLE);
        fingerprint.numbers(&[self.lowest, self.highest]);
    }
}

impl Fingerprinted for SpeedOverTick {
    fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        fingerprint.count(SPEED);
    }
}

impl<S: Stored> Stored for DeadbandReading<S> {
    const BYTES: usize = S::BYTES + PlayState::BYTES;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        self.reading.exchange(port)?;
        self.play.exchange(port)
    }
}

impl<A: Fingerprinted> Fingerprinted for Deadband<A> {
    fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        fingerprint.count(STEADY);
        self.angle.fingerprint(fingerprint);
        self.play.fingerprint(fingerprint);
    }
}

impl Stored for PlayState {
    const BYTES: usize = 8;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.number("position", &mut self.position, Range::new(-1e3, 1e3))?;
        port.number("direction", &mut self.direction, Range::new(-1.0, 1.0))
    }
}

impl Play {
    /// Whether a state is one of this play.
    pub(crate) fn holds(&self, state: &PlayState) -> bool {
        state.position.abs() <= self.half_width && [-1.0, 0.0, 1.0].contains(&state.direction)
    }

    /// Its width.
    pub(crate) fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        fingerprint.number(self.half_width);
    }
}
