//! What laws over the load said in the last ticks of a caged ball screw with memory.

use crate::ranges;
use crate::stored::{Port, Refusal, Stored};

/// Ticks of which one looks up the other direction.
const OTHER_TURN: u8 = 4;

/// What laws said last, for a load that opposes the motion and for one that assists it.
///
/// One of both is looked up in a tick: the ratio of friction to load changes little from tick to tick.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CagedRecent {
    pub(super) found: [Found; 2],
    turn: u8,
}

/// What laws say of a load.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Found {
    /// Friction torque over the whole contact force, m.
    pub(super) ratio: f32,
    /// Whether balls are not known well there.
    pub(super) beyond: bool,
}

impl CagedRecent {
    /// No friction.
    pub(super) const NONE: Self = Self::of(
        [Found {
            ratio: 0.0,
            beyond: false,
        }; 2],
    );

    /// What laws said before the first tick.
    pub(super) const fn of(found: [Found; 2]) -> Self {
        Self { found, turn: 0 }
    }

    /// Whether it is the other direction's turn.
    #[inline(always)]
    pub(super) const fn turned(&mut self) -> bool {
        self.turn = self.turn.wrapping_add(1) % OTHER_TURN;
        self.turn == 0
    }
}

impl Stored for CagedRecent {
    const BYTES: usize = 2 * Found::BYTES + 1;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        self.found
            .iter_mut()
            .try_for_each(|found| found.exchange(port))?;
        port.count("turn", &mut self.turn, OTHER_TURN - 1)
    }
}

impl Stored for Found {
    const BYTES: usize = 5;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        port.number("ratio", &mut self.ratio, ranges::STORED_FRICTION)?;
        port.flag("beyond", &mut self.beyond)
    }
}
