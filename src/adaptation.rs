//! A friction level that follows the vehicle: recursive least squares beside the model, a few hundred times a second.
//!
//! A model is right in its form and wrong in its size: lubricant ages, preload wears off, a warm housing closes the clearance. An
//! [`Adaptation`] compares the friction torque that the motor has to add with the model's and finds five numbers
//!
//! ```text
//! observed = level(direction) T + T_drag + drag omega_N + offset + load_error T_load
//! ```
//!
//! | number | what it takes in | regressor |
//! |---|---|---|
//! | `forward`, `backward` | friction coefficient and preload, in each direction | full friction `T` of the model in that direction |
//! | `drag` | viscous drag beyond the model's `T_drag` | nut speed `omega_N` |
//! | `offset` | zero of the torque sensor or of the motor's current | 1 |
//! | `load_error` | gain of the load channel | load torque that was taken off |
//!
//! No level scales the drag `T_drag` of a scene with memory: it is taken off both sides. A number whose deviation at set-up is 0 stays where it starts.
//!
//! # How it works
//!
//! 1. **Gate.** A tick counts only where the screw slides, fast enough and with enough friction, inputs are finite and within
//!    their limits, no flag of the step is set and the motor is not saturated ([`AdaptationFlags`]).
//! 2. **Filter.** Observed torque and regressors pass the same one-pole filter in the same ticks: the equation holds for the filtered ones exactly.
//! 3. **Prediction** in one tick and **correction** in the next, by the `U D U'` form of the covariance (Bierman 1977), which stays positive
//!    definite in f32. An error beyond four deviations counts as noise that is as much larger. The numbers stay within their bounds.
//! 4. **Forgetting**, every ninth tick: one of the five variances gets back what it lost, as if its number had been read with its deviation of the
//!    set-up (Kulhavy and Zarrop 1993). No variance exceeds that of the set-up.
//!
//! # Use
//!
//! [`FrictionModel::set_level`](crate::FrictionModel::set_level) of a scene with memory, [`Estimates::friction`] for one without. Only limits are
//! scaled: friction stays passive, and the bound of [`compensation`](crate::law::compensation) on the stiffness holds.
//!
//! ```
//! use epas_friction::adaptation::{Adaptation, AdaptationConfiguration, AdaptationInputs};
//! # use epas_friction::law::FrictionLevel;
//! # use epas_friction::{Faults, Regime};
//! let mut adaptation = Adaptation::new(&AdaptationConfiguration::every(0.01))?; // every 10 ms
//!
//! // In the loop, after the step: a motor that has to add 30 % more than the model says.
//! for _ in 0..1000 {
//!     let model_torque = 0.040; // friction_torque of the step's outputs
//!     adaptation.update(&AdaptationInputs {
//!         observed: 0.052, // motor torque, less that of inertia, less load_torque
//!         modelled: model_torque, lubricant_drag: 0.0, level: FrictionLevel::ONE, // as no level was set
//!         nut_speed: 8.0, load_torque: 0.1, regime: Regime::Driving, faults: Faults::NONE, saturated: false,
//!     });
//! }
//! let compensated = adaptation.estimates().friction(0.040, 8.0); // or model.set_level(adaptation.level())
//! assert!((compensated - 0.052).abs() < 0.002);
//! # Ok::<(), epas_friction::Error>(())
//! ```
//!
//! A far slower average of the level against its value at commissioning ([`Adaptation::commission`]) tells [`Health`].

mod constants;
mod factor;
mod health;
mod state;
mod tick;

use core::borrow::Borrow;

use crate::error::{Error, attempt};
use crate::law::FrictionLevel;
use crate::stored::{
    Block, Fingerprint, Fingerprinted as _, Label, OVERHEAD, Refusal, Stored as _,
};

pub use constants::{AdaptationConfiguration, AdaptationConstants, HealthConfiguration};
pub use health::Health;
pub use state::AdaptationState;
pub use tick::{AdaptationFlags, AdaptationInputs, Estimates};

/// Number of the kind in a block; those of scenes are below.
const KIND: u16 = 0x1000;

/// Friction level, drag and sensor errors, estimated while the model runs; see the [module](self).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adaptation<C = AdaptationConstants> {
    constants: C,
    state: AdaptationState,
}

/// Outputs of a tick of the adaptation.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Adapted {
    /// Estimates after this tick, within their bounds.
    pub estimates: Estimates,
    /// Reasons why the tick did not count, and limits.
    pub flags: AdaptationFlags,
    /// Slow drift of the level.
    pub health: Health,
}

impl Adaptation {
    /// Checks the configuration and folds the constants.
    pub const fn new(configuration: &AdaptationConfiguration) -> Result<Self, Error> {
        let constants = attempt!(AdaptationConstants::new(configuration));
        Ok(Self {
            state: AdaptationState::new(&constants),
            constants,
        })
    }
}

impl<C: Borrow<AdaptationConstants>> Adaptation<C> {
    /// An adaptation with folded constants, or with a reference to them.
    pub fn of(constants: C) -> Self {
        let state = AdaptationState::new(constants.borrow());
        Self { constants, state }
    }

    /// One tick: bounded time, no panic, finite outputs whatever the inputs are.
    #[inline]
    pub fn update(&mut self, inputs: &AdaptationInputs) -> Adapted {
        let constants = self.constants.borrow();
        let closed = constants.gate(inputs);
        let flags = if closed.any() {
            closed
        } else {
            self.state.learn(constants, inputs)
        };
        Adapted {
            estimates: self.state.estimates(),
            flags,
            health: self.state.health(),
        }
    }

    /// The estimates, within their bounds.
    pub const fn estimates(&self) -> Estimates {
        self.state.estimates()
    }

    /// Friction levels, for [`FrictionModel::set_level`](crate::FrictionModel::set_level).
    pub const fn level(&self) -> FrictionLevel {
        self.state.estimates().level()
    }

    /// Standard deviations of the estimates, at most those of the set-up. Not in the loop.
    pub fn deviations(&self) -> Estimates {
        self.state.deviations(self.constants.borrow())
    }

    /// Slow drift of the level.
    pub const fn health(&self) -> Health {
        self.state.health()
    }

    /// Takes the present level for that of a sound mechanism: once, at the end of the line, after a run with loads and speeds of both directions.
    pub fn commission(&mut self) {
        self.state.commission();
    }

    /// Back to the state before the first tick and the commissioning.
    pub fn reset(&mut self) {
        self.state = AdaptationState::new(self.constants.borrow());
    }

    /// The folded constants.
    pub fn constants(&self) -> &AdaptationConstants {
        self.constants.borrow()
    }

    /// The state, for diagnosis.
    pub const fn state(&self) -> &AdaptationState {
        &self.state
    }

    /// Bytes of a block that holds the state: see [`stored`](crate::stored) for its layout.
    pub const STATE_BYTES: usize = OVERHEAD + AdaptationState::BYTES;

    /// Writes estimates, covariance and the slow average as a block to the begin of `bytes` and gives its length,
    /// [`STATE_BYTES`](Adaptation::STATE_BYTES): when the ignition goes off, outside the interrupt.
    ///
    /// # Errors
    /// [`Refusal::Length`] where `bytes` are too short.
    pub fn export(&self, bytes: &mut [u8]) -> Result<usize, Refusal> {
        let mut state = self.state;
        self.block().seal(&mut state, bytes)
    }

    /// Takes over the state of a block that an adaptation with the same noise, deviations and forgetting exported: when the ignition goes on. On a
    /// refusal, also of an estimate outside the bounds of these constants, the adaptation is as it was.
    pub fn import(&mut self, block: &[u8]) -> Result<(), Refusal> {
        let mut state = self.state;
        self.block().open(&mut state, block)?;
        let constants = self.constants.borrow();
        if !constants.allows(&state.estimates) {
            return Err(Refusal::OutOfRange { field: "estimates" });
        }
        state.at_bound = constants.binds(&state.estimates);
        self.state = state;
        Ok(())
    }

    #[inline(never)]
    fn block(&self) -> Block {
        let mut fingerprint = Fingerprint::NONE;
        self.constants.borrow().fingerprint(&mut fingerprint);
        let label = Label {
            kind: KIND,
            balls: 0,
            fingerprint,
        };
        Block::new(label, AdaptationState::BYTES)
    }
}
