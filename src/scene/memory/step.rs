//! Parts of a step with memory: temperature, turn of the nut, friction of the elements.

use super::{SceneMemory, WithMemoryConstants, WithMemoryInputs};
use crate::law::Elements;
use crate::law::coefficient::CoefficientModel;
use crate::law::motion::NutAngle;
use crate::scene::contract::SceneOutputs as _;
use crate::scene::faults::Faults;
use crate::scene::reversal::{Motion as _, ReversalState, direction};
use crate::scene::sliding::Sliding;

/// Part of sliding friction below which the mechanism counts as standing. Only [`Regime`](crate::scene::Regime) and what is read from it
/// depend on it, not friction. A hundredth below 1, because the last elements of spin slide late: one of
/// [`SPIN_8`](crate::law::memory::SPIN_8) carries 3.5 % and slides after seven breakaway angles.
const SLIDES: f32 = 0.99;

impl<C, E: Elements, A: NutAngle, L: CoefficientModel> WithMemoryConstants<C, E, A, L> {
    /// The friction coefficient's law at the temperature of this tick: computed anew where that changes.
    #[inline(always)]
    pub(super) fn take_temperature<S: Sliding>(
        &self,
        remembered: &mut SceneMemory<S, E, A, L>,
        known: &WithMemoryInputs<Option<S::Inputs>, A::Reading>,
    ) -> Faults {
        let fade = &self.temperature;
        let temperature = fade.at(known.temperature, known.temperature_age);
        if temperature != remembered.temperature {
            remembered.temperature = temperature;
            remembered.at_temperature = remembered.coefficient.at_temperature(temperature);
        }
        Faults::NONE
            .with(
                !fade.is_temperature(known.temperature),
                Faults::TEMPERATURE_RANGE,
            )
            .with(
                !fade.holds(known.temperature_age),
                Faults::TEMPERATURE_STALE,
            )
    }

    /// The turn since the last valid reading; its part beyond the play is added to the travel of the balls.
    #[inline(always)]
    pub(super) fn turn<S: Sliding>(
        &self,
        remembered: &mut SceneMemory<S, E, A, L>,
        reading: A::Reading,
    ) -> (f32, Faults) {
        let turn = self.angle.turn(&mut remembered.reading, reading);
        let faults = Faults::NONE.with(!turn.is_measured(), Faults::ANGLE_NOT_VALID);
        let turn = turn.angle();
        remembered.moved += self.play.follow(&mut remembered.play, turn).turn;
        (turn, faults)
    }

    /// See [`FrictionModel::between`](crate::FrictionModel::between).
    #[inline(always)]
    pub(crate) fn between<S: Sliding<Constants = C>>(
        &self,
        remembered: &mut SceneMemory<S, E, A, L>,
        reading: A::Reading,
    ) -> S::Outputs {
        let (turn, faults) = self.turn(remembered, reading);
        self.follow(remembered, turn, remembered.inputs, faults)
    }

    /// Friction after a turn, between the limits of the last sliding friction.
    #[inline(always)]
    pub(super) fn follow<S: Sliding<Constants = C>>(
        &self,
        remembered: &mut SceneMemory<S, E, A, L>,
        turn: f32,
        inputs: S::Inputs,
        faults: Faults,
    ) -> S::Outputs {
        let Some(sliding) = &remembered.sliding else {
            return S::Outputs::SAFE.limited(f32::MAX, faults);
        };
        let limits = &remembered.limits.times(&remembered.level);
        let friction = self.elements.follow(&mut remembered.elements, turn, limits);
        let limit = if friction < 0.0 {
            limits.backward
        } else {
            limits.forward
        };
        let factor = if limit > 0.0 { friction / limit } else { 0.0 };
        let reversal = ReversalState {
            factor: factor * remembered.level.of(friction),
            carried: factor.abs(),
            // Where there is friction and the nut does not stand, that of its motion.
            direction: direction(if limit > 0.0 { friction } else { turn }),
            standing: if limit > 0.0 {
                factor.abs() < SLIDES || turn * friction < 0.0
            } else {
                turn == 0.0
            },
        };
        let mut outputs = S::outputs_at(&self.scene, inputs, sliding, reversal);
        let (torque, flags) = outputs.friction_and_faults();
        *torque += remembered.drag;
        let held = L::holds_drag(&remembered.at_temperature, inputs.speed());
        *flags |= faults.with(!held, Faults::BEYOND_MODEL);
        outputs
    }
}
