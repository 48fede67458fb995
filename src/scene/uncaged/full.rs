//! Full friction of a ball screw without cage, and what of it is put out.

use crate::scene::contract::Regime;
use crate::scene::faults::Faults;
use crate::scene::outputs::UncagedOutputs;
use crate::scene::passage::Passage;

/// Full friction of a ball screw without cage, in the direction in which its balls go.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct UncagedFull {
    /// Parts of the friction torque from the grooves and from balls that rub against each other, N m.
    pub(super) groove: f32,
    pub(super) ball: f32,
    /// The grooves' part forward and backward over it.
    pub(super) ways: [f32; 2],
    /// Axial load, preload counted, N.
    pub(super) load: f32,
    pub(super) contacts: u8,
    pub(super) largest_contact_force: f32,
    pub(super) faults: Faults,
}

impl UncagedFull {
    /// The outputs under a load that is held by this torque, N m.
    #[inline(always)]
    pub(super) fn passed(&self, load_torque: f32, passage: Passage) -> UncagedOutputs {
        let [forward, backward] = self.ways;
        let way = if passage.share < 0.0 {
            backward
        } else {
            forward
        };
        let groove_torque = passage.share * (way * self.groove);
        let ball_torque = passage.share * self.ball;
        let friction_torque = groove_torque + ball_torque;
        UncagedOutputs {
            friction_torque,
            groove_torque,
            ball_torque,
            load_torque,
            contacts: self.contacts,
            largest_contact_force: self.largest_contact_force,
            regime: Regime::under(
                passage.standing,
                passage.way * load_torque,
                friction_torque.abs(),
            ),
            faults: self.faults,
        }
    }
}
