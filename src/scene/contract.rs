//! The trait that every mechanism implements, and what scenes have in common: inputs, limits, faults, reversal, regimes.

use crate::error::{Error, attempt, in_range};
use crate::math;

/// A mechanism with its configuration, its constants, its state and its outputs.
pub trait Scene {
    /// Set-up parameters.
    type Configuration;
    /// Constants that follow from the configuration.
    type Constants;
    /// State that a step changes.
    type State;
    /// Inputs of a step.
    type Inputs;
    /// Outputs of a step.
    type Outputs: SceneOutputs;

    /// Checks the configuration and folds the constants.
    fn constants(configuration: &Self::Configuration) -> Result<Self::Constants, Error>;

    /// The state before the first step.
    fn initial_state(constants: &Self::Constants) -> Self::State;

    /// Continues a state that other constants left under these: balls and memory stay.
    ///
    /// # Errors
    /// [`Error`] naming what does not fit to the state, which then is as it was.
    fn take_over(constants: &Self::Constants, state: &mut Self::State) -> Result<(), Error>;

    /// One step: inputs and friction within their limits, faults flagged; bounded time, no panic. Where an input is NaN or infinite
    /// the outputs are [`SceneOutputs::safe`] and the state stays (but for [`WithMemory`](super::WithMemory)).
    fn step(
        constants: &Self::Constants,
        state: &mut Self::State,
        inputs: Self::Inputs,
    ) -> Self::Outputs;
}

/// A scene whose friction coefficient may change while it runs.
pub trait ChangingFriction: Scene {
    /// See [`FrictionModel::set_friction`](crate::FrictionModel::set_friction).
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

    /// The safe output with its faults.
    #[must_use]
    fn safe(faults: Faults) -> Self;

    /// What was wrong.
    fn faults(&self) -> Faults;
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
    pub const fn checked(self) -> Result<Self, Error> {
        attempt!(in_range("nut_speed", self.nut_speed, 1e-3, 1e6));
        attempt!(in_range("axial_load", self.axial_load, 1e-3, 1e7));
        attempt!(in_range("friction_torque", self.friction_torque, 1e-6, 1e6));
        Ok(self)
    }

    #[inline(always)]
    pub(super) fn check_inputs(&self, inputs: Inputs) -> CheckedInputs<Inputs> {
        let Inputs {
            nut_speed,
            axial_load,
        } = inputs;
        let speed_beyond = !(nut_speed.abs() <= self.nut_speed);
        let load_beyond = !(axial_load.abs() <= self.axial_load);
        if !(speed_beyond || load_beyond) {
            return CheckedInputs {
                inputs: Some(inputs),
                faults: Faults::NONE,
            };
        }
        if nut_speed.is_finite() && axial_load.is_finite() {
            let limited = Inputs {
                nut_speed: if speed_beyond {
                    self.nut_speed.copysign(nut_speed)
                } else {
                    nut_speed
                },
                axial_load: if load_beyond {
                    self.axial_load.copysign(axial_load)
                } else {
                    axial_load
                },
            };
            CheckedInputs {
                inputs: Some(limited),
                faults: Faults::beyond(speed_beyond, load_beyond),
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
    /// Slower than the reversal speed, or with memory elements still stick or the nut has just turned back: friction is between its
    /// two directions.
    Standing,
    /// The motor moves the load (or turns against friction alone).
    Driving,
    /// The load turns the nut.
    BackDriving,
    /// The efficiency of the present direction is not positive: driving, no torque moves the load; back-driving, the motor has to push.
    Locked,
}

/// Where friction is between its two directions in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ReversalState {
    /// Factor on sliding friction, -1 to 1 with the sign of the direction in which friction opposes motion, times the
    /// [level](crate::law::FrictionLevel) of that direction.
    pub factor: f32,
    /// Part of the forces between balls that friction of the grooves carries, 0 to 1: with memory the factor's size without its level; else 1.
    pub carried: f32,
    /// -1 where the motion goes, or went last, in the negative direction, else 1.
    pub direction: f32,
    /// Whether the mechanism stands: friction is between its two directions.
    pub standing: bool,
}

impl ReversalState {
    /// Sliding forward.
    pub(super) const FORWARD: Self = Self {
        factor: 1.0,
        carried: 1.0,
        direction: 1.0,
        standing: false,
    };
}

/// Inputs of a scene that moves under loads.
pub trait Motion: Copy + core::fmt::Debug + PartialEq {
    /// Neither speed nor loads.
    const STILL: Self;

    /// Speed of the nut, rad/s, or of the carriage, m/s.
    fn speed(&self) -> f32;

    /// Axial load of a screw, normal load of a bearing, N.
    fn load(&self) -> f32;

    /// These inputs with another speed, and with their loads times a factor.
    #[must_use]
    fn with(self, speed: f32, load_factor: f32) -> Self;
}

/// How friction passes through zero with the speed: as `w / sqrt(w^2 + w_s^2)` with the speed `w`, rad/s
/// (m/s), and the reversal speed `w_s`, at which it is 71 %.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Reversal {
    speed: f32,
    squared: f32,
}

impl Reversal {
    /// With a reversal speed in the unit of the scene's speed.
    pub(super) const fn new(
        reversal_speed: f32,
        minimum: f32,
        maximum: f32,
    ) -> Result<Self, Error> {
        let speed = attempt!(in_range("reversal_speed", reversal_speed, minimum, maximum));
        Ok(Self {
            speed,
            squared: speed * speed,
        })
    }

    /// The reversal state at a speed; standstill counts as forward.
    #[inline(always)]
    pub(super) fn at(&self, speed: f32) -> ReversalState {
        ReversalState {
            factor: speed / math::sqrt(speed * speed + self.squared),
            carried: 1.0,
            direction: direction(speed),
            standing: speed.abs() < self.speed,
        }
    }
}

#[inline(always)]
pub(super) const fn direction(speed: f32) -> f32 {
    if speed < 0.0 { -1.0 } else { 1.0 }
}

/// What was wrong with a tick's inputs, limited in its outputs, or beyond the model; a set of flags.
///
/// [`Faults::BEYOND_MODEL`] and [`Faults::FORCES_NOT_HELD`] speak of accuracy alone: they are in [`Faults::any`], not in [`Faults::faulty`].
///
/// ```
/// use epas_friction::Faults;
/// let faults = Faults::LOAD_RANGE | Faults::FRICTION_LIMIT;
/// assert!(faults.any() && faults.contains(Faults::LOAD_RANGE));
/// assert!(!faults.contains(Faults::SPEED_NOT_FINITE));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Faults(u16);

impl Faults {
    /// Nothing is wrong.
    pub const NONE: Self = Self(0);
    /// The speed is NaN or infinite: the output is the safe one (no friction), or with memory that of the last sound inputs.
    pub const SPEED_NOT_FINITE: Self = Self(1);
    /// A load is NaN or infinite: as for the speed.
    pub const LOAD_NOT_FINITE: Self = Self(1 << 1);
    /// The speed is beyond its limit: the limit is used instead.
    pub const SPEED_RANGE: Self = Self(1 << 2);
    /// A load is beyond its limit: the limit is used instead.
    pub const LOAD_RANGE: Self = Self(1 << 3);
    /// The friction of the output was cut to its limit; or it was NaN, which no scene is known to make, and the output is zero.
    pub const FRICTION_LIMIT: Self = Self(1 << 4);
    /// The friction is less accurate than stated: the mechanism is outside the range of its formulas. The output is the best estimate, finite
    /// and continuous, and no reason to take the friction away. Each scene says where this begins.
    pub const BEYOND_MODEL: Self = Self(1 << 5);
    /// Forces between balls are less accurate than stated, while the friction is not: compensation and adaptation go on.
    pub const FORCES_NOT_HELD: Self = Self(1 << 6);
    /// A reading of the angle is missing or cannot be right: friction stays where it is, and the next reading spans the gap.
    pub const ANGLE_NOT_VALID: Self = Self(1 << 7);
    /// The temperature is NaN or beyond its range: that of the configuration is used instead.
    pub const TEMPERATURE_RANGE: Self = Self(1 << 8);
    /// A load is older than it may be: its friction fades away.
    pub const LOAD_STALE: Self = Self(1 << 9);
    /// A temperature is older than it may be: that of the configuration is used instead.
    pub const TEMPERATURE_STALE: Self = Self(1 << 10);

    /// True where any flag is set.
    #[inline]
    #[must_use]
    pub const fn any(self) -> bool {
        self.0 != 0
    }

    /// True where an input was wrong or an output was limited: any flag but
    /// [`Faults::BEYOND_MODEL`] and [`Faults::FORCES_NOT_HELD`].
    #[inline]
    #[must_use]
    pub const fn faulty(self) -> bool {
        self.0 & !(Self::BEYOND_MODEL.0 | Self::FORCES_NOT_HELD.0) != 0
    }

    /// True where the output friction is not that of the inputs, or less accurate than stated: any flag but [`Faults::FORCES_NOT_HELD`].
    #[inline]
    #[must_use]
    pub const fn doubtful(self) -> bool {
        self.0 & !Self::FORCES_NOT_HELD.0 != 0
    }

    /// True where every flag of `other` is set.
    #[inline]
    #[must_use]
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// The flags as bits, in the order of their constants, for a diagnostic message.
    pub const fn bits(self) -> u16 {
        self.0
    }

    pub(super) const fn of_bits(bits: u16) -> Self {
        Self(bits)
    }

    #[inline(always)]
    pub(super) const fn beyond(speed: bool, load: bool) -> Self {
        Self::NONE
            .with(speed, Self::SPEED_RANGE)
            .with(load, Self::LOAD_RANGE)
    }

    #[inline(always)]
    pub(super) const fn not_finite(speed: bool, load: bool) -> Self {
        Self::NONE
            .with(speed, Self::SPEED_NOT_FINITE)
            .with(load, Self::LOAD_NOT_FINITE)
    }

    #[inline]
    #[must_use]
    pub(crate) const fn with(self, condition: bool, other: Self) -> Self {
        if condition {
            Self(self.0 | other.0)
        } else {
            self
        }
    }
}

impl core::ops::BitOr for Faults {
    type Output = Self;

    #[inline]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl core::ops::BitOrAssign for Faults {
    #[inline]
    fn bitor_assign(&mut self, other: Self) {
        self.0 |= other.0;
    }
}

/// `value` within plus and minus `bound`: `max` and `min` become calls on a Cortex-M, `clamp` keeps a panic.
#[inline(always)]
pub(super) const fn bounded(value: f32, bound: f32) -> f32 {
    if value > bound {
        bound
    } else if value < -bound {
        -bound
    } else {
        value
    }
}
