//! What a scene with memory keeps from tick to tick.

use crate::error::{Error, attempt};
use crate::law::coefficient::CoefficientModel;
use crate::law::motion::{NutAngle, PlayState};
use crate::law::{Elements, FrictionLevel, SlidingLimits};
use crate::scene::reversal::{Motion, direction};
use crate::scene::sliding::Sliding;

/// What a scene with memory keeps from tick to tick beside the state of the scene without.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneMemory<S: Sliding, E: Elements, A: NutAngle, L: CoefficientModel> {
    /// What the elements remember.
    pub elements: E::State,
    pub(super) reading: A::State,
    pub(super) play: PlayState,
    /// Travel beyond the play that is not yet applied to the balls, rad (m): the next steps apply it, each within the scene's largest
    /// speed.
    pub(super) moved: f32,
    pub(super) coefficient: L,
    /// Temperature of the last step, K, 150 to 500, and the law at it.
    pub(super) temperature: f32,
    pub(super) at_temperature: L::At,
    /// The last sound inputs, and the last sliding friction with its limits and the viscous drag beside it.
    pub(super) inputs: S::Inputs,
    pub(super) sliding: Option<S::Friction>,
    pub(super) limits: SlidingLimits,
    pub(super) drag: f32,
    /// Levels that scale the limits.
    pub(super) level: FrictionLevel,
}

/// Checks that the scene takes every coefficient that the law gives. Constants that the compiler folds are not checked so: in the
/// loop a coefficient above the scene's largest counts as that.
pub(super) fn checked<S: Sliding, L: CoefficientModel>(law: L) -> Result<L, Error> {
    let (least, largest) = law.extremes();
    S::FRICTION.checked("coefficient", least)?;
    S::FRICTION.checked("coefficient", largest)?;
    Ok(law)
}

/// No friction.
const NONE: SlidingLimits = SlidingLimits {
    forward: 0.0,
    backward: 0.0,
    load: 0.0,
};

impl<S: Sliding, E: Elements, A: NutAngle, L: CoefficientModel> SceneMemory<S, E, A, L> {
    /// Before the first tick.
    pub(super) fn nothing(coefficient: L, temperature: f32) -> Self {
        Self {
            elements: E::VIRGIN,
            reading: A::FRESH,
            play: PlayState::FRESH,
            moved: 0.0,
            coefficient,
            temperature,
            at_temperature: coefficient.at_temperature(temperature),
            inputs: S::Inputs::STILL,
            sliding: None,
            limits: NONE,
            drag: 0.0,
            level: FrictionLevel::ONE,
        }
    }

    /// See [`FrictionModel::set_coefficient`](crate::FrictionModel::set_coefficient).
    pub(crate) fn set_coefficient(&mut self, law: L) -> Result<(), Error> {
        self.coefficient = checked::<S, L>(law)?;
        self.at_temperature = law.at_temperature(self.temperature);
        Ok(())
    }

    /// See [`FrictionModel::set_level`](crate::FrictionModel::set_level).
    pub(crate) const fn set_level(&mut self, level: FrictionLevel) -> Result<(), Error> {
        self.level = attempt!(level.checked());
        Ok(())
    }

    /// Travel that is not yet applied to the balls, rad (m).
    pub(crate) const fn moved(&self) -> f32 {
        self.moved
    }

    /// Lubricant drag beside the last sliding friction.
    pub(crate) const fn drag(&self) -> f32 {
        self.drag
    }

    /// -1 where the balls went backward last, else 1.
    #[inline(always)]
    pub(super) const fn direction(&self) -> f32 {
        direction(self.play.direction())
    }
}
