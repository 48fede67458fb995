//! The model that runs in the interrupt: constants folded at set-up, a small state, one `step`.

use crate::error::Error;
use crate::scene::Scene;

/// Friction of one scene: configured once, stepped in the interrupt.
///
/// ```
/// use epas_friction::{
///     CATALOGUE, CagedBallScrew, CagedBallScrewConfiguration, FrictionBranch, FrictionModel, Inputs,
///     Limits, Regime,
/// };
///
/// let mut model = FrictionModel::<CagedBallScrew>::new(&CagedBallScrewConfiguration {
///     design: CATALOGUE[15].design()?, // 32 x 20 x 6.35
///     friction: 0.075,
///     rolling_tangent: 0.0,
///     branch: FrictionBranch::Rolling,
///     preload: 0.0,
///     reversal_speed: 0.5,
///     limits: Limits { nut_speed: 500.0, axial_load: 20_000.0, friction_torque: 5.0 },
/// })?;
///
/// // in the interrupt
/// let outputs = model.step(Inputs { nut_speed: 40.0, axial_load: 3_000.0 });
/// assert_eq!(outputs.regime, Regime::Driving);
/// assert!(outputs.friction_torque > 0.0 && outputs.efficiency > 0.9);
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionModel<S: Scene> {
    constants: S::Constants,
    state: S::State,
}

impl<S: Scene> FrictionModel<S> {
    /// Checks the configuration and folds the constants. Set-up only.
    ///
    /// # Errors
    /// [`Error`] naming the field out of range.
    pub fn new(configuration: &S::Configuration) -> Result<Self, Error> {
        let constants = S::constants(configuration)?;
        let state = S::initial_state(&constants);
        Ok(Self { constants, state })
    }

    /// One tick: bounded time, no panic, finite outputs whatever the inputs are.
    #[inline]
    pub fn step(&mut self, inputs: S::Inputs) -> S::Outputs {
        S::step(&self.constants, &mut self.state, inputs)
    }

    /// Back to the state before the first tick.
    pub fn reset(&mut self) {
        self.state = S::initial_state(&self.constants);
    }

    /// The folded constants.
    pub const fn constants(&self) -> &S::Constants {
        &self.constants
    }

    pub(crate) const fn state_mut(&mut self) -> &mut S::State {
        &mut self.state
    }

    /// The state, for diagnosis.
    pub const fn state(&self) -> &S::State {
        &self.state
    }
}
