//! Full friction of a ball screw without cage, as a memory needs it.

use super::{UncagedBallScrew, UncagedConstants, UncagedFull, UncagedState};
use crate::error::Range;
use crate::law::coefficient::DirectionalCoefficient;
use crate::ranges;
use crate::scene::contract::Inputs;
use crate::scene::faults::bounded;
use crate::scene::outputs::UncagedOutputs;
use crate::scene::passage::Passage;
use crate::scene::sliding::{Sliding, SlidingFriction};

impl<const N: usize, const NODES: usize> Sliding for UncagedBallScrew<N, NODES> {
    const FRICTION: Range = ranges::FRICTION_OF_A_ROW;

    const COUNTS_PRELOAD: bool = true;

    type Full = UncagedFull;

    #[inline(always)]
    fn full(
        constants: &UncagedConstants<N, NODES>,
        state: &mut UncagedState<N>,
        inputs: Inputs,
        friction: DirectionalCoefficient,
    ) -> UncagedFull {
        state.friction = constants.place(friction.of(inputs.nut_speed).0);
        let mut full = constants.full(state, inputs);
        full.row.ratios = friction.over_own(inputs.nut_speed);
        full
    }

    #[inline(always)]
    fn friction(full: &UncagedFull) -> SlidingFriction {
        full.row.friction()
    }

    #[inline(always)]
    fn passed(
        constants: &UncagedConstants<N, NODES>,
        inputs: Inputs,
        full: &UncagedFull,
        passage: Passage,
    ) -> UncagedOutputs {
        full.passed(inputs.axial_load * constants.reduced_lead, passage)
    }

    #[inline(always)]
    fn in_a_tick(constants: &UncagedConstants<N, NODES>, turn: f32, _: f32) -> (f32, f32) {
        let turn = bounded(turn, constants.limits.nut_speed * constants.tick);
        (turn, turn * constants.per_tick)
    }
}
