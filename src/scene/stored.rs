//! Scenes whose state can be kept as bytes.

use super::contract::Faults;
use super::contract::{Inputs, Scene};
use super::linear::LinearInputs;
use crate::error::Range;
use crate::law::SlidingLimits;
use crate::ranges;
use crate::stored::{Fingerprint, Port, Refusal, Stored};

/// A scene whose state can be kept as bytes.
pub trait StoredScene: Scene<State: Stored + Copy> {
    /// Number of the kind of scene in a block.
    const KIND: u16;
    /// Most balls in the circuit, 0 without one.
    const BALLS: u16 = 0;

    /// Balls in the circuit, 0 without one.
    fn balls(_: &Self::State) -> u16 {
        0
    }

    /// Takes in the constants that a state's numbers are read with: geometry, elasticity, circuit, friction coefficient and clearance, not
    /// what may change from one ignition to the next (limits, reversal speed, tick, loads' shares, deviations).
    fn fingerprint(constants: &Self::Constants, fingerprint: &mut Fingerprint);

    /// Completes a state that has been read, and checks that its numbers fit to each other and to the constants.
    ///
    /// # Errors
    /// [`Refusal::OutOfRange`] naming what does not fit.
    fn complete(constants: &Self::Constants, state: &mut Self::State) -> Result<(), Refusal>;

    /// Forgets what does not last without power: the reading of an angle sensor.
    fn forget_readings(_state: &mut Self::State) {}
}

const FLAGS: u16 = (Faults::TEMPERATURE_STALE.bits() << 1) - 1;

impl Stored for Faults {
    const BYTES: usize = 2;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        let mut bits = self.bits();
        port.long_count("faults", &mut bits, FLAGS)?;
        *self = Self::of_bits(bits);
        Ok(())
    }
}

impl Stored for SlidingLimits {
    const BYTES: usize = 12;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.number("forward", &mut self.forward, ranges::STORED_FRICTION)?;
        port.number("backward", &mut self.backward, ranges::STORED_FRICTION)?;
        port.number("load", &mut self.load, ranges::STORED_LOAD)
    }
}

/// Any finite number; [`StoredScene::complete`] checks it against the constants' limits.
const ANY: Range = Range::new(f32::MIN, f32::MAX);

impl Stored for Inputs {
    const BYTES: usize = 8;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.number("nut_speed", &mut self.nut_speed, ANY)?;
        port.number("axial_load", &mut self.axial_load, ANY)
    }
}

impl Stored for LinearInputs {
    const BYTES: usize = 12;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.number("speed", &mut self.speed, ANY)?;
        port.number("normal_load", &mut self.normal_load, ANY)?;
        port.number("side_load", &mut self.side_load, ANY)
    }
}
