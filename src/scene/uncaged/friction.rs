//! Sliding friction of a ball screw without cage, and what of it is put out.

use crate::scene::contract::Regime;
use crate::scene::faults::Faults;
use crate::scene::outputs::UncagedOutputs;
use crate::scene::reversal::ReversalState;
use crate::scene::row::TrainFriction;

/// Sliding friction of a ball screw without cage, in the direction in which its balls go.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct UncagedFriction {
    /// Its parts. `load`: the axial load, preload counted, N.
    pub(in crate::scene) row: TrainFriction,
    pub(in crate::scene) faults: Faults,
}

impl UncagedFriction {
    /// The outputs under a load that is held by this torque, N m.
    #[inline(always)]
    pub(in crate::scene) fn outputs_at(
        &self,
        load_torque: f32,
        reversal: ReversalState,
    ) -> UncagedOutputs {
        let (groove_torque, ball_torque) = self.row.outputs_at(reversal);
        UncagedOutputs {
            friction_torque: groove_torque + ball_torque,
            groove_torque,
            ball_torque,
            load_torque,
            contacts: self.row.contacts,
            largest_contact_force: self.row.largest_contact_force,
            regime: Regime::under(
                reversal.standing,
                reversal.direction * load_torque,
                self.row.of(reversal.direction),
            ),
            faults: self.faults,
        }
    }
}
