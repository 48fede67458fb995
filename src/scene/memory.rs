//! A scene whose friction remembers: a hysteresis in the nut's angle, with a friction coefficient that follows speed and
//! temperature.
//!
//! # Balls that press on each other, at a reversal
//!
//! Forces between balls are in proportion to what the grooves carry of their sliding friction. Friction `f` of the elements, positive in the
//! direction in which the balls went last, lies between
//!
//! ```text
//! -T_0 <= f <= T_g + T_b,   between balls: T_b f/(T_g + T_b) where f > 0, else 0
//! ```
//!
//! with the sliding friction of the grooves `T_g`, between balls `T_b`, and of the grooves where no ball presses `T_0`. After a reversal springs of
//! constant stiffness take `f` from the upper limit to the lower one over the width of the play; then the balls turn round. A limit `L` that falls
//! there all the same (elements that turn later, under a load far above their reference) is `L (1 + e)`, with `e >= 0` from its value before over the
//! load; `e` falls by one with each half of the play that the balls go on. Constant springs between limits that hold zero are passive: torque is continuous
//! in the angle and takes work out of every closed path.

mod configuration;
mod remembered;

use core::marker::PhantomData;

use super::contract::Faults;
use super::contract::{
    CheckedInputs, Motion as _, ReversalState, Scene, SceneOutputs as _, direction,
};
use super::sliding::Sliding;
use crate::error::{Error, attempt, in_range};
use crate::law::Elements;
use crate::law::coefficient::{CoefficientLaw, CoefficientModel, TemperatureFade};
use crate::law::fade::Fade;
use crate::law::motion::{NutAngle, Play};

pub use configuration::{CoefficientFor, Freshness, WithMemoryConfiguration, WithMemoryInputs};
pub use remembered::SceneMemory;
use remembered::checked;

/// Part of sliding friction below which the mechanism counts as standing, for [`Regime`](crate::scene::Regime) alone. The last elements of
/// spin slide late: one of [`SPIN_8`](crate::law::memory::SPIN_8) carries 3.5 % and slides after seven breakaway angles.
const SLIDES: f32 = 0.99;

/// Speed given to the scene when the nut has not moved, rad/s (m/s), with the sign of its last motion: at zero speed Coulomb
/// friction has no direction. Below the resolution of any sensor, and large enough that the train's travel stays a normal number.
const CREEP: f32 = 1e-9;

/// A scene `S` with memory elements `E`, which follow the readings of an angle sensor `A`, and a friction coefficient by `L`.
///
/// Friction passes between its two directions with the angle: elements stick and slip under the limits that sliding friction
/// of the same tick sets them. In steady sliding it is the friction of `S` away from its reversal; its reversal speed has no
/// meaning here. Standing is where elements still stick, or where the nut has just turned back against the friction.
///
/// Wrong inputs are flagged: without a valid speed and load the last ones are used; without a valid reading of the angle friction
/// stays as it is, and the next reading spans the gap. A load that is too old fades to zero; a temperature that is too
/// old is replaced by the configuration's.
///
/// [`Faults::BEYOND_MODEL`] is also set where the law has a drag of rolling contacts and the speed is above
/// [`RollingDrag::FITTED_SPEED`](crate::law::coefficient::RollingDrag::FITTED_SPEED).
///
/// Balls of a train move only by the turn beyond a play ([`WithMemoryConfiguration::play`]): noise of the encoder does not reverse them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct WithMemory<S, E, A, L = CoefficientLaw>(PhantomData<(S, E, A, L)>);

/// Constants of a scene with memory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WithMemoryConstants<C, E, A, L = CoefficientLaw> {
    scene: C,
    elements: E,
    angle: A,
    /// 1 / reference load, 1/N.
    per_reference_load: f32,
    play: Play,
    coefficient: L,
    temperature: TemperatureFade,
    load: Fade,
}

/// State of a scene with memory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WithMemoryState<
    S: Sliding,
    E: Elements,
    A: NutAngle,
    L: CoefficientModel = CoefficientLaw,
> {
    /// State of the scene without memory.
    pub scene: S::State,
    /// The memory beside it.
    pub remembered: SceneMemory<S, E, A, L>,
}

impl<S, E, A, L> Scene for WithMemory<S, E, A, L>
where
    S: Sliding,
    E: Elements + Copy,
    A: NutAngle + Copy,
    L: CoefficientFor<S::Inputs>,
    S::Constants: Copy,
{
    type Configuration = WithMemoryConfiguration<S::Configuration, E, A, L>;
    type Constants = WithMemoryConstants<S::Constants, E, A, L>;
    type State = WithMemoryState<S, E, A, L>;
    type Inputs = WithMemoryInputs<S::Inputs, A::Reading>;
    type Outputs = S::Outputs;

    fn constants(configuration: &Self::Configuration) -> Result<Self::Constants, Error> {
        let scene = S::constants(&configuration.scene)?;
        checked::<S, L>(configuration.coefficient)?;
        WithMemoryConstants::new(scene, configuration)
    }

    fn initial_state(constants: &Self::Constants) -> Self::State {
        const {
            assert!(
                S::COUNTS_PRELOAD || !E::PRELOADED,
                "elements of a preloaded screw in a scene whose load does not tell its preload"
            );
        }
        WithMemoryState {
            scene: S::initial_state(&constants.scene),
            remembered: SceneMemory::nothing(
                constants.coefficient,
                constants.temperature.fallback(),
            ),
        }
    }

    fn take_over(constants: &Self::Constants, state: &mut Self::State) -> Result<(), Error> {
        checked::<S, L>(constants.coefficient)?;
        S::take_over(&constants.scene, &mut state.scene)?;
        let remembered = &mut state.remembered;
        constants.play.take_over(&mut remembered.play);
        if !constants.angle.is_valid_state(&remembered.reading) {
            remembered.reading = A::FRESH;
        }
        remembered.set_coefficient(constants.coefficient)
    }

    #[inline(always)]
    fn step(
        constants: &Self::Constants,
        state: &mut Self::State,
        inputs: Self::Inputs,
    ) -> S::Outputs {
        let remembered = &mut state.remembered;
        let CheckedInputs {
            inputs: known,
            mut faults,
        } = S::check_inputs(&constants.scene, inputs.scene);
        faults |= constants.take_temperature(remembered, &inputs);
        let factor = if constants.load.holds(inputs.load_age) {
            1.0
        } else {
            let left = constants.load.left(inputs.load_age);
            faults = faults.with(left < 1.0, Faults::LOAD_STALE);
            left
        };
        let (turn, angle_faults) = constants.turn(remembered, inputs.reading);
        faults |= angle_faults;
        let inputs = known.unwrap_or(remembered.inputs);
        remembered.inputs = inputs;

        let direction = remembered.direction();
        let measured = inputs.speed();
        let (turn_now, speed) = S::limited_travel(&constants.scene, remembered.moved, measured);
        // Travel that was not yet applied and has been reversed is dropped.
        let same_direction = turn_now * direction >= 0.0;
        if same_direction {
            remembered.moved -= turn_now;
        }
        let speed = if same_direction && speed * direction > CREEP {
            speed
        } else {
            direction * CREEP
        };
        let moving = inputs.with(speed, factor);
        let mut sliding = S::sliding_friction(
            &constants.scene,
            &mut state.scene,
            moving,
            L::both(&remembered.at_temperature, measured).within(S::FRICTION.maximum),
        );
        if let Some(last) = &remembered.sliding {
            let travelled = turn_now.abs() / constants.play.half_width();
            S::continue_from(&mut sliding, last, travelled);
        }
        let by_direction = S::by_direction(&sliding);
        remembered.limits = by_direction.limits(constants.per_reference_load);
        remembered.sliding = Some(sliding);
        let load = moving.load().abs();
        remembered.drag = L::drag_torque(
            &remembered.at_temperature,
            measured,
            load,
            by_direction.load - load,
        );
        constants.follow(remembered, turn, inputs, faults)
    }
}

impl<C: Copy, E: Copy, A: Copy, L: Copy> WithMemoryConstants<C, E, A, L> {
    /// Checks what memory adds to the constants of a scene. The compiler cannot ask a law for its largest coefficient, as
    /// [`FrictionModel::new`](crate::FrictionModel::new) does: one above the scene's largest counts in the loop as that, without a flag.
    ///
    /// # Errors
    /// [`Error`] naming `reference_load`, `half_width` (of the play) or a time of the freshness.
    pub const fn new<B>(
        scene: C,
        configuration: &WithMemoryConfiguration<B, E, A, L>,
    ) -> Result<Self, Error> {
        let reference_load = attempt!(in_range(
            "reference_load",
            configuration.reference_load,
            1e-3,
            1e7
        ));
        Ok(Self {
            scene,
            elements: configuration.elements,
            angle: configuration.angle,
            per_reference_load: 1.0 / reference_load,
            play: attempt!(Play::new(configuration.play)),
            coefficient: configuration.coefficient,
            temperature: configuration.temperature,
            load: attempt!(configuration.freshness.fade()),
        })
    }
}

impl<C, E: Elements, A: NutAngle, L: CoefficientModel> WithMemoryConstants<C, E, A, L> {
    /// Constants of the scene without memory.
    #[inline(always)]
    pub const fn scene(&self) -> &C {
        &self.scene
    }

    #[inline(always)]
    fn take_temperature<S: Sliding>(
        &self,
        remembered: &mut SceneMemory<S, E, A, L>,
        inputs: &WithMemoryInputs<S::Inputs, A::Reading>,
    ) -> Faults {
        let fade = &self.temperature;
        let valid = fade.is_temperature(inputs.temperature);
        let fresh = fade.holds(inputs.temperature_age);
        let (temperature, faults) = if valid && fresh {
            (inputs.temperature, Faults::NONE)
        } else {
            let faults = Faults::NONE
                .with(!valid, Faults::TEMPERATURE_RANGE)
                .with(!fresh, Faults::TEMPERATURE_STALE);
            let temperature = fade.at(inputs.temperature, inputs.temperature_age);
            (temperature, faults)
        };
        if temperature != remembered.temperature {
            remembered.temperature = temperature;
            remembered.at_temperature = remembered.coefficient.at_temperature(temperature);
        }
        faults
    }

    /// The turn since the last valid reading; its part beyond the play is added to the travel of the balls.
    #[inline(always)]
    fn turn<S: Sliding>(
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

    #[inline(always)]
    pub(crate) fn between<S: Sliding<Constants = C>>(
        &self,
        remembered: &mut SceneMemory<S, E, A, L>,
        reading: A::Reading,
    ) -> S::Outputs {
        let (turn, faults) = self.turn(remembered, reading);
        self.follow(remembered, turn, remembered.inputs, faults)
    }

    #[inline(always)]
    fn follow<S: Sliding<Constants = C>>(
        &self,
        remembered: &mut SceneMemory<S, E, A, L>,
        turn: f32,
        inputs: S::Inputs,
        faults: Faults,
    ) -> S::Outputs {
        let Some(sliding) = &remembered.sliding else {
            return S::Outputs::safe(faults);
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
        let held = L::holds_drag(&remembered.at_temperature, inputs.speed());
        let faults = faults.with(!held, Faults::BEYOND_MODEL);
        S::outputs_at(
            &self.scene,
            inputs,
            sliding,
            reversal,
            remembered.drag,
            faults,
        )
    }
}
