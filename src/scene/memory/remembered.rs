//! State of a scene with memory, also as bytes.

use super::{CoefficientFor, WithMemory, WithMemoryState};
use crate::error::{Error, Range, attempt};
use crate::law::coefficient::{CoefficientModel, TEMPERATURE};
use crate::law::motion::{NutAngle, PlayState};
use crate::law::{Elements, FrictionLevel, SlidingLimits};
use crate::scene::contract::{Motion, Scene, direction};
use crate::scene::sliding::Sliding;
use crate::scene::stored::StoredScene;
use crate::stored::{Fingerprint, Fingerprinted, Port, Refusal, Stored};

/// State of a memory beside that of its scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneMemory<S: Sliding, E: Elements, A: NutAngle, L: CoefficientModel> {
    /// State of the elements.
    pub elements: E::State,
    pub(super) reading: A::State,
    pub(super) play: PlayState,
    /// Travel beyond the play that is not yet applied to the balls, rad (m).
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
    pub(super) level: FrictionLevel,
}

pub(super) fn checked<S: Sliding, L: CoefficientModel>(law: L) -> Result<L, Error> {
    let (least, largest) = law.extremes();
    S::FRICTION.checked("coefficient", least)?;
    S::FRICTION.checked("coefficient", largest)?;
    Ok(law)
}

const NONE: SlidingLimits = SlidingLimits {
    forward: 0.0,
    backward: 0.0,
    load: 0.0,
};

impl<S: Sliding, E: Elements, A: NutAngle, L: CoefficientModel> SceneMemory<S, E, A, L> {
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

    pub(crate) fn set_coefficient(&mut self, law: L) -> Result<(), Error> {
        self.coefficient = checked::<S, L>(law)?;
        self.at_temperature = law.at_temperature(self.temperature);
        Ok(())
    }

    pub(crate) const fn set_level(&mut self, level: FrictionLevel) -> Result<(), Error> {
        self.level = attempt!(level.checked());
        Ok(())
    }

    pub(crate) const fn moved(&self) -> f32 {
        self.moved
    }

    pub(crate) const fn drag(&self) -> f32 {
        self.drag
    }

    #[inline(always)]
    pub(super) const fn direction(&self) -> f32 {
        direction(self.play.direction())
    }
}

/// Added to the kind of the scene without memory.
const MEMORY: u16 = 0x100;

impl<S, E, A, L> StoredScene for WithMemory<S, E, A, L>
where
    S: StoredScene + Sliding<Constants: Copy, Inputs: Stored, Friction: Stored + Default> + Copy,
    E: Elements<State: Stored> + Fingerprinted + Copy,
    A: NutAngle<State: Stored> + Fingerprinted + Copy,
    L: CoefficientFor<<S as Scene>::Inputs>,
{
    const KIND: u16 = MEMORY + S::KIND;
    const BALLS: u16 = S::BALLS;

    fn balls(state: &Self::State) -> u16 {
        S::balls(&state.scene)
    }

    fn fingerprint(constants: &Self::Constants, fingerprint: &mut Fingerprint) {
        S::fingerprint(&constants.scene, fingerprint);
        constants.elements.fingerprint(fingerprint);
        constants.angle.fingerprint(fingerprint);
        fingerprint.number(constants.per_reference_load);
        constants.play.fingerprint(fingerprint);
    }

    fn complete(constants: &Self::Constants, state: &mut Self::State) -> Result<(), Refusal> {
        S::complete(&constants.scene, &mut state.scene)?;
        let remembered = &mut state.remembered;
        if !constants.angle.is_valid_state(&remembered.reading) {
            return Err(Refusal::OutOfRange { field: "reading" });
        }
        if !constants.play.holds(&remembered.play) {
            return Err(Refusal::OutOfRange { field: "play" });
        }
        if S::check_inputs(&constants.scene, remembered.inputs)
            .faults
            .any()
        {
            return Err(Refusal::OutOfRange { field: "inputs" });
        }
        remembered.at_temperature = remembered
            .coefficient
            .at_temperature(remembered.temperature);
        Ok(())
    }

    fn forget_readings(state: &mut Self::State) {
        S::forget_readings(&mut state.scene);
        state.remembered.reading = A::FRESH;
    }
}

impl<S, E, A, L> Stored for WithMemoryState<S, E, A, L>
where
    S: Sliding<State: Stored, Inputs: Stored, Friction: Stored + Default>,
    E: Elements<State: Stored>,
    A: NutAngle<State: Stored>,
    L: CoefficientModel,
{
    const BYTES: usize = <S::State as Stored>::BYTES + SceneMemory::<S, E, A, L>::BYTES;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        self.scene.exchange(port)?;
        self.remembered.exchange(port)
    }
}

impl<S, E, A, L> Stored for SceneMemory<S, E, A, L>
where
    S: Sliding<Inputs: Stored, Friction: Stored + Default>,
    E: Elements<State: Stored>,
    A: NutAngle<State: Stored>,
    L: CoefficientModel,
{
    const BYTES: usize = <E::State as Stored>::BYTES
        + <A::State as Stored>::BYTES
        + PlayState::BYTES
        + <<S as Scene>::Inputs as Stored>::BYTES
        + (1 + <S::Friction as Stored>::BYTES)
        + SlidingLimits::BYTES
        + 3 * 4;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        self.elements.exchange(port)?;
        self.reading.exchange(port)?;
        self.play.exchange(port)?;
        self.inputs.exchange(port)?;
        self.limits.exchange(port)?;
        port.number("temperature", &mut self.temperature, TEMPERATURE)?;
        port.number("moved", &mut self.moved, Range::new(-1e9, 1e9))?;
        port.number("drag", &mut self.drag, Range::new(-1e9, 1e9))?;
        self.sliding.exchange(port)
    }
}
