//! What scenes with a train of balls have in common.

use super::faults::Flagged;
use super::{Faults, Outputs, Regime, efficiency};

/// What a scene with balls that press on each other returns.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct TrainOutputs {
    /// Torque about the nut's axis that the motor has to add to overcome friction, N m (in a linear
    /// bearing the force along the track, N): the sum of the next two, within its limit. It has the sign
    /// of the speed; friction itself acts with the opposite sign.
    pub friction: f32,
    /// Its part from the grooves.
    pub groove_friction: f32,
    /// Its part from balls that rub against each other.
    pub ball_friction: f32,
    /// Torque about the nut's axis that holds the load without friction, N m; 0 in a linear bearing.
    pub load_torque: f32,
    /// Pairs of balls that press on each other.
    pub contacts: u8,
    /// Largest force between two balls, N.
    pub largest_contact_force: f32,
    /// What the mechanism does.
    pub regime: Regime,
    /// What was wrong with this tick's inputs, or limited in its outputs.
    pub faults: Faults,
}

impl Flagged for TrainOutputs {
    #[inline]
    fn safe(faults: Faults) -> Self {
        Self {
            friction: 0.0,
            groove_friction: 0.0,
            ball_friction: 0.0,
            load_torque: 0.0,
            contacts: 0,
            largest_contact_force: 0.0,
            regime: Regime::Standing,
            faults,
        }
    }

    #[inline]
    fn faults(&self) -> Faults {
        self.faults
    }
}

impl From<TrainOutputs> for Outputs {
    /// The outputs that every scene of a ball screw has.
    fn from(outputs: TrainOutputs) -> Self {
        let TrainOutputs {
            friction,
            load_torque,
            regime,
            faults,
            ..
        } = outputs;
        let efficiency = if matches!(regime, Regime::Standing) {
            0.0
        } else {
            // Signs, because the product of two small torques would vanish.
            let driving = (load_torque < 0.0) == (friction < 0.0);
            efficiency(driving, load_torque, friction)
        };
        Self {
            friction_torque: friction,
            load_torque,
            efficiency,
            regime,
            faults,
        }
    }
}
