//! Full friction of a ball screw without cage, and what of it is put out.

use crate::scene::contract::Regime;
use crate::scene::faults::Faults;
use crate::scene::outputs::UncagedOutputs;
use crate::scene::passage::Passage;
use crate::scene::row::RowFull;

/// Full friction of a ball screw without cage, in the direction in which its balls go.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct UncagedFull {
    /// Its parts. `load`: the axial load, preload counted, N.
    pub(in crate::scene) row: RowFull,
    pub(in crate::scene) faults: Faults,
}

impl UncagedFull {
    /// The outputs under a load that is held by this torque, N m.
    #[inline(always)]
    pub(in crate::scene) fn passed(&self, load_torque: f32, passage: Passage) -> UncagedOutputs {
        let (groove_torque, ball_torque) = self.row.passed(passage);
        UncagedOutputs {
            friction_torque: groove_torque + ball_torque,
            groove_torque,
            ball_torque,
            load_torque,
            contacts: self.row.contacts,
            largest_contact_force: self.row.largest_contact_force,
            regime: Regime::under(
                passage.standing,
                passage.direction * load_torque,
                self.row.of(passage.direction),
            ),
            faults: self.faults,
        }
    }
}
