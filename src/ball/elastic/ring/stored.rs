//! A ring of balls as bytes.

use super::Ring;
use super::chosen::SETTLING_ROUNDS;
use crate::ball::elastic::law::{RingBall, RingConstants};
use crate::ball::elastic::renewal::Settled;
use crate::ball::elastic::stored::CLEARANCE;
use crate::error::Range;
use crate::ranges;
use crate::stored::{Port, Refusal, Stored};

/// Angle of the nut in a round, rad: no round of a checked configuration comes near it. A bound against what is no number.
const ROUND: Range = Range::new(-1e9, 1e9);

/// Contact force that balls are settled for, N: above 0, which is divided by, and beyond the largest load and preload (1e7 N
/// each) at the flattest contact angle.
const LOAD: Range = Range::new(1e-9, 1e12);

impl<const N: usize> Stored for Ring<N> {
    const BYTES: usize = (N + 1) * RingBall::BYTES + Settled::BYTES + 5 * 4 + 2 * 2 + 5 + 3;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        self.balls
            .iter_mut()
            .try_for_each(|ball| ball.exchange(port))?;
        self.nominal.exchange(port)?;
        self.fresh.exchange(port)?;
        let friction = ranges::FRICTION_OF_A_ROW;
        port.number("friction", &mut self.friction, friction)?;
        port.number("friction", &mut self.renewed_friction, friction)?;
        port.number("clearance", &mut self.clearance, CLEARANCE)?;
        port.number("settled_load", &mut self.settled_load, LOAD)?;
        port.number("round", &mut self.round, ROUND)?;
        port.long_count("stale", &mut self.stale, N as u16)?;
        port.long_count("settling", &mut self.settling, SETTLING_ROUNDS * N as u16)?;
        port.count("next", &mut self.next, N as u8)?;
        port.count("entered", &mut self.entered, N as u8)?;
        port.count("two_point", &mut self.two_point, u8::MAX)?;
        port.count("rounds_beyond", &mut self.rounds_beyond, u8::MAX)?;
        port.count("astray", &mut self.astray, N as u8)?;
        port.flag("backward", &mut self.backward)?;
        port.flag("negative", &mut self.negative)?;
        port.flag("begun", &mut self.begun)
    }
}

impl<const N: usize> Ring<N> {
    /// Puts in what follows from the clearance.
    ///
    /// # Errors
    /// [`Refusal::OutOfRange`] naming `clearance`, or `impedance` of the nominal ball, which is never without load.
    pub(crate) fn complete(&mut self, constants: &RingConstants) -> Result<(), Refusal> {
        constants.ball.takes(self.clearance)?;
        self.lift_off = constants.ball.lift_off(self.clearance);
        self.follow_changes();
        if self.nominal.loaded() {
            Ok(())
        } else {
            Err(Refusal::OutOfRange { field: "impedance" })
        }
    }
}
