//! A scene whose friction remembers: a hysteresis in the nut's angle, with a friction coefficient that follows speed and
//! temperature.
//!
//! # Balls that press on each other, at a reversal
//!
//! A ball presses on the next one because friction of its grooves pushes it on while that of the other's grooves holds the other back: along
//! the path nothing else acts on them. So forces between balls are in proportion to what the grooves carry of their sliding friction, and none is
//! left where that is zero: friction of the other sign would part the balls. Friction `f` of the elements, positive in the direction in which the
//! balls went last, lies between
//!
//! ```text
//! -T_0 <= f <= T_g + T_b,   between balls: T_b f/(T_g + T_b) where f > 0, else 0
//! ```
//!
//! with the sliding friction of the grooves `T_g`, between balls `T_b`, and of the grooves where no ball presses `T_0`. After a reversal springs
//! of constant stiffness take `f` from the upper limit to the lower one over twice the breakaway angle, the whole width of the play; then the balls
//! turn round, and those that pressed have nothing left to lose. A limit `L` that falls there all the same (elements that turn later, under
//! a load far above their reference) is `L (1 + e)`, with `e >= 0` from its value before over the load, and `e` falls by one with each half of the
//! play that the balls go on. Constant springs between limits that hold zero are passive, however the limits change: torque is continuous in the
//! angle and takes work out of every closed path.

mod configuration;
mod inputs;
mod remembered;
mod step;
mod stored;

use core::marker::PhantomData;

use super::contract::{CheckedInputs, Scene};
use super::faults::Faults;
use super::reversal::Motion;
use super::sliding::Sliding;
use crate::error::{Error, attempt, in_range};
use crate::law::Elements;
use crate::law::coefficient::{CoefficientLaw, CoefficientModel, TemperatureFade};
use crate::law::fade::Fade;
use crate::law::motion::{NutAngle, Play};

pub use configuration::{CoefficientFor, WithMemoryConfiguration};
pub use inputs::{Freshness, WithMemoryInputs};
pub use remembered::SceneMemory;
use remembered::checked;

/// Speed given to the scene when the nut has not moved, rad/s (m/s), with the sign of its last motion: at zero speed Coulomb
/// friction has no direction. Forces between balls are then those with which motion sets in.
///
/// Below the resolution of any sensor, and large enough that the train's travel stays a normal number: 1e-9 rad/s is 0.009 rad in
/// 100 days.
const CREEP: f32 = 1e-9;

/// A scene `S` with memory elements `E`, which follow the readings of an angle sensor `A`, and a friction coefficient by `L`.
///
/// Friction passes between its two directions with the angle: elements stick and slip under the limits that sliding friction
/// of the same tick sets them. In steady sliding it is the friction of `S` away from its reversal; its reversal speed has no
/// meaning here. Standing is where elements still stick, or where the nut has just turned back against the friction: elsewhere friction has the
/// sign of the motion.
///
/// Wrong inputs: without a valid speed and load the last ones are used, flagged; without a valid reading of the angle friction
/// stays as it is, flagged, and the next reading spans the gap. A load that is too old fades to zero; a temperature that is too
/// old is replaced by the configuration's.
///
/// [`Faults::BEYOND_MODEL`] is set beside the scene's own reasons where the law has a drag of rolling contacts and the speed is above
/// [`RollingDrag::FITTED_SPEED`](crate::law::coefficient::RollingDrag::FITTED_SPEED).
///
/// Balls of a train move only by the turn beyond a play ([`WithMemoryConfiguration::play`]): noise of the encoder does not
/// reverse them, and after a reversal what presses leaves with the friction of the grooves before they part.
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
    /// Factor of a load by its age.
    load: Fade,
}

/// What a tick changes in a scene with memory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WithMemoryState<
    S: Sliding,
    E: Elements,
    A: NutAngle,
    L: CoefficientModel = CoefficientLaw,
> {
    /// State of the scene without memory.
    pub scene: S::State,
    /// What the scene keeps from tick to tick beside that.
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
    /// Without the scene's inputs where one of them is NaN or infinite.
    type ValidInputs = WithMemoryInputs<Option<S::Inputs>, A::Reading>;
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

    /// Inputs of the scene that are no numbers leave the others as they are.
    #[inline(always)]
    fn check_inputs(
        constants: &Self::Constants,
        inputs: Self::Inputs,
    ) -> CheckedInputs<Self::ValidInputs> {
        let WithMemoryInputs {
            scene,
            reading,
            load_age,
            temperature,
            temperature_age,
        } = inputs;
        let CheckedInputs {
            inputs: scene,
            faults,
        } = S::check_inputs(&constants.scene, scene);
        CheckedInputs {
            inputs: Some(WithMemoryInputs {
                scene,
                reading,
                load_age,
                temperature,
                temperature_age,
            }),
            faults,
        }
    }

    #[inline(always)]
    fn outputs(
        constants: &Self::Constants,
        state: &mut Self::State,
        known: Self::ValidInputs,
    ) -> S::Outputs {
        let remembered = &mut state.remembered;
        let mut faults = constants.take_temperature(remembered, &known);
        let inputs = known.scene.unwrap_or(remembered.inputs);
        remembered.inputs = inputs;
        let factor = constants.load.left(known.load_age);
        faults = faults.with(factor < 1.0, Faults::LOAD_STALE);
        let (turn, angle_faults) = constants.turn(remembered, known.reading);

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
        constants.follow(remembered, turn, inputs, faults | angle_faults)
    }

    #[inline(always)]
    fn largest_friction(constants: &Self::Constants) -> f32 {
        S::largest_friction(&constants.scene)
    }
}

impl<C: Copy, E: Copy, A: Copy, L: Copy> WithMemoryConstants<C, E, A, L> {
    /// Checks what memory adds to the constants of a scene: at set-up, or in a constant when firmware is compiled. The compiler cannot
    /// ask a law for its largest coefficient, as [`FrictionModel::new`](crate::FrictionModel::new) does: one that is more than the
    /// scene takes counts in the loop as the most that it takes, without a flag.
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
}
