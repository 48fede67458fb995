//! Sliding friction of a ball screw without cage, as a memory needs it.

use super::{UncagedBallScrew, UncagedConstants, UncagedFriction, UncagedState};
use crate::error::Range;
use crate::law::coefficient::DirectionalCoefficient;
use crate::ranges;
use crate::scene::contract::{CheckedInputs, Inputs, ReversalState};
use crate::scene::faults::{Faults, bounded};
use crate::scene::outputs::UncagedOutputs;
use crate::scene::sliding::{Sliding, SlidingFriction};

impl<const N: usize, const NODES: usize> Sliding for UncagedBallScrew<N, NODES> {
    const FRICTION: Range = ranges::FRICTION_OF_A_ROW;

    const COUNTS_PRELOAD: bool = true;

    type Friction = UncagedFriction;

    #[inline(always)]
    fn check_inputs(
        constants: &UncagedConstants<N, NODES>,
        inputs: Inputs,
    ) -> CheckedInputs<Inputs> {
        constants.limits.check_inputs(inputs)
    }

    #[inline(always)]
    fn sliding_friction(
        constants: &UncagedConstants<N, NODES>,
        state: &mut UncagedState<N>,
        inputs: Inputs,
        friction: DirectionalCoefficient,
    ) -> UncagedFriction {
        state.friction = constants.interval(friction.of(inputs.nut_speed).0);
        let mut sliding = constants.friction_of_balls(state, inputs);
        sliding.row.ratios = friction.over_own(inputs.nut_speed);
        sliding
    }

    #[inline(always)]
    fn by_direction(sliding: &UncagedFriction) -> SlidingFriction {
        sliding.row.friction()
    }

    #[inline(always)]
    fn continue_from(sliding: &mut UncagedFriction, last: &UncagedFriction, travelled: f32) {
        sliding.row.continue_from(&last.row, travelled);
    }

    #[inline(always)]
    fn outputs_at(
        constants: &UncagedConstants<N, NODES>,
        inputs: Inputs,
        sliding: &UncagedFriction,
        reversal: ReversalState,
        drag: f32,
        faults: Faults,
    ) -> UncagedOutputs {
        let row = sliding.row.outputs_at(
            reversal,
            inputs.axial_load * constants.reduced_lead,
            drag,
            sliding.faults | faults,
            constants.limits.friction_torque,
        );
        UncagedOutputs {
            friction_torque: row.whole.friction_torque,
            groove_torque: row.groove,
            ball_torque: row.ball,
            load_torque: row.whole.load_torque,
            contacts: row.contacts,
            largest_contact_force: row.largest_contact_force,
            regime: row.whole.regime,
            faults: row.whole.faults,
        }
    }

    #[inline(always)]
    fn limited_travel(constants: &UncagedConstants<N, NODES>, turn: f32, _: f32) -> (f32, f32) {
        let turn = bounded(turn, constants.limits.nut_speed * constants.tick);
        (turn, turn * constants.per_tick)
    }
}
