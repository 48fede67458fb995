//! The trait that every mechanism implements, and what scenes have in common: inputs, limits, regimes.

use super::faults::{Faults, bounded};
use super::reversal::Motion;
use crate::error::{Error, attempt, in_range};

/// A mechanism with its configuration, its constants, its state and its outputs.
///
/// Constants are folded once and never change; the state is small and is all that a tick changes. A scene gives its
/// checks ([`Scene::check_inputs`]) and its physics ([`Scene::outputs`]) as plain functions; faults are handled in
/// one place, [`FrictionModel::step`](crate::FrictionModel::step).
pub trait Scene {
    /// Set-up parameters.
    type Configuration;
    /// Constants that follow from the configuration.
    type Constants;
    /// State that a tick changes.
    type State;
    /// Inputs of a tick.
    type Inputs;
    /// Inputs within their limits.
    type ValidInputs;
    /// Outputs of a tick.
    type Outputs: SceneOutputs;

    /// Checks the configuration and folds the constants.
    ///
    /// # Errors
    /// [`Error`] naming the field out of range.
    fn constants(configuration: &Self::Configuration) -> Result<Self::Constants, Error>;

    /// The state before the first tick.
    fn initial_state(constants: &Self::Constants) -> Self::State;

    /// Continues a state that other constants left under these: balls and memory stay.
    ///
    /// # Errors
    /// [`Error`] naming what does not fit to the state, which then is as it was.
    fn take_over(constants: &Self::Constants, state: &mut Self::State) -> Result<(), Error>;

    /// The inputs within their limits, with what was wrong with them.
    fn check_inputs(
        constants: &Self::Constants,
        inputs: Self::Inputs,
    ) -> CheckedInputs<Self::ValidInputs>;

    /// What the mechanism does under checked inputs, before its friction is limited: bounded time, no panic.
    fn outputs(
        constants: &Self::Constants,
        state: &mut Self::State,
        known: Self::ValidInputs,
    ) -> Self::Outputs;

    /// Largest friction that is put out: N m of a screw, N of a bearing.
    fn largest_friction(constants: &Self::Constants) -> f32;
}

/// A scene whose friction coefficient may change while it runs.
pub trait ChangingFriction: Scene {
    /// See [`FrictionModel::set_friction`](crate::FrictionModel::set_friction).
    ///
    /// # Errors
    /// [`Error`] naming `friction`; the state is then as it was.
    fn set_friction(
        constants: &Self::Constants,
        state: &mut Self::State,
        friction: f32,
    ) -> Result<(), Error>;
}

/// A scene's outputs, as far as faults decide them.
pub trait SceneOutputs: Copy {
    /// The safe output: no friction, nothing pressing, standing.
    const SAFE: Self;

    /// The friction that is put out (torque of a screw, N m; force of a bearing, N), and the flags beside it.
    fn friction_and_faults(&mut self) -> (&mut f32, &mut Faults);

    /// What was wrong.
    fn faults(&self) -> Faults;

    /// These outputs with `faults` added, and with their friction within plus and minus `largest`, which is flagged where
    /// it cuts. Friction that is no number, which no scene is known to make, becomes zero, with the same flag.
    #[must_use]
    #[inline(always)]
    fn limited(mut self, largest: f32, faults: Faults) -> Self {
        let (friction, flags) = self.friction_and_faults();
        let within = friction.abs() <= largest;
        *flags = (*flags | faults).with(!within, Faults::FRICTION_LIMIT);
        if !within {
            *friction = cut(*friction, largest);
        }
        self.concluded()
    }

    /// These outputs with what follows from the friction that is put out.
    #[must_use]
    #[inline(always)]
    fn concluded(self) -> Self {
        self
    }
}

/// Replacement of friction that is not within plus and minus `largest`.
#[cold]
const fn cut(friction: f32, largest: f32) -> f32 {
    if friction.is_nan() {
        0.0
    } else {
        largest.copysign(friction)
    }
}

/// Inputs within their limits, with what was wrong with them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CheckedInputs<I> {
    /// The inputs; `None` where one is NaN or infinite.
    pub inputs: Option<I>,
    /// What was wrong.
    pub faults: Faults,
}

/// Inputs of a ball screw at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Inputs {
    /// Angular speed of the nut relative to the screw, rad/s; limited to that of the [`Limits`].
    pub nut_speed: f32,
    /// Axial force of the load, N; positive where it opposes the travel that a positive nut speed
    /// makes. `nut_speed * axial_load > 0` is driving, `< 0` back-driving. Within that of the [`Limits`], as the speed.
    pub axial_load: f32,
}

/// Limits of the inputs and outputs of a ball screw.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Limits {
    /// Largest nut speed, rad/s, 1e-3 to 1e6.
    pub nut_speed: f32,
    /// Largest axial load, N, 1e-3 to 1e7.
    pub axial_load: f32,
    /// Largest friction torque of an output, N m, 1e-6 to 1e6.
    pub friction_torque: f32,
}

impl Motion for Inputs {
    const STILL: Self = Self {
        nut_speed: 0.0,
        axial_load: 0.0,
    };

    #[inline(always)]
    fn speed(&self) -> f32 {
        self.nut_speed
    }

    #[inline(always)]
    fn load(&self) -> f32 {
        self.axial_load
    }

    #[inline(always)]
    fn with(self, speed: f32, load_factor: f32) -> Self {
        Self {
            nut_speed: speed,
            axial_load: load_factor * self.axial_load,
        }
    }
}

impl Limits {
    /// The limits, checked.
    ///
    /// # Errors
    /// [`Error`] naming `nut_speed`, `axial_load` or `friction_torque`.
    pub const fn checked(self) -> Result<Self, Error> {
        attempt!(in_range("nut_speed", self.nut_speed, 1e-3, 1e6));
        attempt!(in_range("axial_load", self.axial_load, 1e-3, 1e7));
        attempt!(in_range("friction_torque", self.friction_torque, 1e-6, 1e6));
        Ok(self)
    }

    /// The inputs within these limits, with what was wrong.
    #[inline(always)]
    pub(super) fn check_inputs(&self, inputs: Inputs) -> CheckedInputs<Inputs> {
        let Inputs {
            nut_speed,
            axial_load,
        } = inputs;
        // Limits are finite: what is within them is a number, and needs nothing else.
        if nut_speed.abs() <= self.nut_speed && axial_load.abs() <= self.axial_load {
            return CheckedInputs {
                inputs: Some(inputs),
                faults: Faults::NONE,
            };
        }
        if nut_speed.is_finite() && axial_load.is_finite() {
            CheckedInputs {
                inputs: Some(Inputs {
                    nut_speed: bounded(nut_speed, self.nut_speed),
                    axial_load: bounded(axial_load, self.axial_load),
                }),
                faults: Faults::beyond(
                    nut_speed.abs() > self.nut_speed,
                    axial_load.abs() > self.axial_load,
                ),
            }
        } else {
            CheckedInputs {
                inputs: None,
                faults: Faults::not_finite(!nut_speed.is_finite(), !axial_load.is_finite()),
            }
        }
    }
}

/// What the mechanism does at a tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Regime {
    /// The mechanism is slower than the reversal speed, or with memory its elements still stick or the nut has just turned back: friction is
    /// between its two directions.
    Standing,
    /// The motor moves the load (or turns against friction alone).
    Driving,
    /// The load turns the nut.
    BackDriving,
    /// The efficiency of the present direction is not positive: driving, no torque moves the load;
    /// back-driving, the load alone does not sustain the motion and the motor has to push.
    Locked,
}

impl Regime {
    /// Under a load whose torque against the motion is `opposing`, with friction of this size, N m.
    #[inline(always)]
    pub(super) fn under(standing: bool, opposing: f32, friction: f32) -> Self {
        let load_opposes = opposing >= 0.0;
        Self::of(standing, load_opposes, load_opposes || friction < -opposing)
    }

    /// From what is known of a tick: whether the mechanism stands, whether the load opposes the motion, and whether
    /// what drives (motor or load) keeps it in motion.
    #[inline(always)]
    pub(super) const fn of(standing: bool, load_opposes: bool, moves: bool) -> Self {
        if standing {
            Self::Standing
        } else if !moves {
            Self::Locked
        } else if load_opposes {
            Self::Driving
        } else {
            Self::BackDriving
        }
    }
}
