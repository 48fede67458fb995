//! A scene with memory as bytes. The law of the friction coefficient is that of the constants, or what was set last.

use super::{
    CoefficientFor, SceneMemory, Sliding, WithMemory, WithMemoryConstants, WithMemoryState,
};
use crate::error::Range;
use crate::law::coefficient::{CoefficientModel, TEMPERATURE};
use crate::law::motion::{NutAngle, PlayState};
use crate::law::{Elements, SlidingLimits};
use crate::scene::contract::Scene;
use crate::scene::stored::StoredScene;
use crate::stored::{Fingerprint, Fingerprinted, Port, Refusal, Stored};

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

    fn balls(state: &WithMemoryState<S, E, A, L>) -> u16 {
        S::balls(&state.scene)
    }

    fn fingerprint(
        constants: &WithMemoryConstants<S::Constants, E, A, L>,
        fingerprint: &mut Fingerprint,
    ) {
        S::fingerprint(&constants.scene, fingerprint);
        constants.elements.fingerprint(fingerprint);
        constants.angle.fingerprint(fingerprint);
        fingerprint.number(constants.per_reference_load);
        constants.play.fingerprint(fingerprint);
    }

    fn complete(
        constants: &WithMemoryConstants<S::Constants, E, A, L>,
        state: &mut WithMemoryState<S, E, A, L>,
    ) -> Result<(), Refusal> {
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

    fn forget_readings(state: &mut WithMemoryState<S, E, A, L>) {
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
