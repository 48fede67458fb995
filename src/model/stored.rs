//! A model's state across ignition.

use core::borrow::Borrow;

use super::FrictionModel;
use crate::law::Elements;
use crate::law::motion::NutAngle;
use crate::scene::{CoefficientFor, Scene, Sliding, StoredScene, WithMemory, WithMemoryConstants};
use crate::stored::{Block, Fingerprint, Fingerprinted, Label, OVERHEAD, Refusal, Stored};
use crate::train::BALL_BYTES;

impl<S: StoredScene, C: Borrow<S::Constants>> FrictionModel<S, C> {
    /// Bytes of a block that holds the state: see [`stored`](crate::stored) for its layout.
    pub const STATE_BYTES: usize = OVERHEAD + <S::State as Stored>::BYTES;

    /// Writes the state as a block to the begin of `bytes`, when the ignition goes off, and gives its length
    /// [`STATE_BYTES`](FrictionModel::STATE_BYTES).
    ///
    /// The block has balls, memory and what has been set while the model ran; neither the constants nor the number of faulted
    /// ticks. Outside the interrupt; where one still steps the model, copy it in a critical section and export the copy.
    ///
    /// | counted on a Cortex-M4F | block, bytes | export, instructions | import | stack, bytes | flash of both |
    /// |---|---|---|---|---|---|
    /// | 37 balls | 1,794 | 28,000 | 32,000 | 2,700 | 8 KiB |
    ///
    /// A caged ball screw's block has 24 bytes, with a memory of eight elements 116.
    ///
    /// ```
    /// use epas_friction::scene::{BUILT_IN_NODES, CagedBallScrew, built_in};
    /// use epas_friction::{FrictionModel, Inputs};
    ///
    /// type Screw = FrictionModel<CagedBallScrew<BUILT_IN_NODES>>;
    /// let gear = built_in("25x5x3.175").unwrap();
    /// let mut kept = [0xFF; Screw::STATE_BYTES]; // in non-volatile memory
    ///
    /// // Ignition on: whatever is wrong with the block, the model runs on from its first state.
    /// let mut model = Screw::new(&gear)?;
    /// if let Err(refusal) = model.import(&kept) {
    ///     println!("friction starts anew: {refusal}"); // a diagnostic message
    /// }
    /// model.set_friction(0.08)?;
    /// model.step(Inputs { nut_speed: 40.0, axial_load: 3_000.0 });
    ///
    /// // Ignition off.
    /// model.export(&mut kept).expect("the block is large enough");
    ///
    /// // Ignition on: the friction that was set is there again.
    /// let mut next = Screw::new(&gear)?;
    /// assert_eq!(next.import(&kept), Ok(()));
    /// # let inputs = Inputs { nut_speed: 40.0, axial_load: 3_000.0 };
    /// # assert_eq!(model.step(inputs), next.step(inputs));
    /// # Ok::<(), epas_friction::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Refusal::Length`] where `bytes` are too short; [`Refusal::OutOfRange`] where the state holds a NaN or an
    /// infinity: such a block could not be read again.
    pub fn export(&self, bytes: &mut [u8]) -> Result<usize, Refusal> {
        // A state has one description, which also reads: it works on a copy.
        let mut state = self.state;
        self.block().seal(&mut state, bytes)
    }

    /// Takes over the state of a block that a model of the same constants exported: when the ignition goes on, before the first
    /// step. From then on steps give the same bits as those of that model; on a refusal the model is as it was. Outside the interrupt.
    ///
    /// An angle sensor begins anew: the first reading is no turn, whatever the nut did without power. If somebody turned the wheel
    /// then, model and true friction are the same again after a turn of twice the breakaway angle;
    /// [`FrictionModel::import_with_reading`] serves a sensor that spans the gap.
    pub fn import(&mut self, block: &[u8]) -> Result<(), Refusal> {
        let mut state = self.state;
        self.read(&mut state, block)?;
        S::forget_readings(&mut state);
        self.take(&state);
        Ok(())
    }

    #[inline(never)]
    fn block(&self) -> Block {
        let mut fingerprint = Fingerprint::NONE;
        S::fingerprint(self.constants.borrow(), &mut fingerprint);
        let balls = S::balls(&self.state);
        let label = Label {
            kind: S::KIND,
            balls,
            fingerprint,
        };
        let missing = usize::from(S::BALLS.saturating_sub(balls));
        Block::new(label, <S::State as Stored>::BYTES - missing * BALL_BYTES)
    }

    fn read(&self, state: &mut S::State, block: &[u8]) -> Result<(), Refusal> {
        self.block().open(state, block)?;
        S::complete(self.constants.borrow(), state)
    }

    fn take(&mut self, state: &S::State) {
        self.state = *state;
        self.faulted_ticks = 0;
    }
}

impl<S, E, A, L, C> FrictionModel<WithMemory<S, E, A, L>, C>
where
    S: StoredScene + Sliding<Constants: Copy, Inputs: Stored, Friction: Stored + Default> + Copy,
    E: Elements<State: Stored> + Fingerprinted + Copy,
    A: NutAngle<State: Stored> + Fingerprinted + Copy,
    L: CoefficientFor<<S as Scene>::Inputs>,
    C: Borrow<WithMemoryConstants<S::Constants, E, A, L>>,
{
    /// As [`FrictionModel::import`], with the last reading of the angle sensor: the turn of the next reading spans the time without power.
    ///
    /// Right only for a sensor that is absolute over all that the nut may have turned by. A turn beyond the sensor's largest one is cut to
    /// that and flagged.
    ///
    /// # Errors
    /// The [`Refusal`]; the model is as it was.
    pub fn import_with_reading(&mut self, block: &[u8]) -> Result<(), Refusal> {
        let mut state = self.state;
        self.read(&mut state, block)?;
        self.take(&state);
        Ok(())
    }
}
