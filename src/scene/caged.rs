//! A ball screw whose balls do not touch: caged, or with spacer balls.

mod coefficients;
mod configuration;
mod contacts;
mod stored;

use super::changing::{ChangingClearance, ChangingFriction};
use super::closed_form::{ClosedForm, FrictionBranch};
use super::contract::{Admitted, Inputs, Limits, Scene, SceneOutputs};
use super::faults::Faults;
use super::full::CagedFull;
use super::outputs::Outputs;
use super::passage::{Passage, Reversal};
use super::sliding::{Sliding, SlidingFriction};
use crate::ball::Clearance;
use crate::error::{Error, Range, attempt, in_range};
use crate::law::coefficient::DirectionalCoefficient;
use crate::ranges;
use coefficients::CoefficientLaws;
pub use configuration::CagedBallScrewConfiguration;
use contacts::{Contacts, ContactsState};

/// Numbers for the two kinds of law, because [`Error`] reports a number.
const CONTACTS: f32 = 0.0;
const CLOSED: f32 = 1.0;

/// A caged ball screw: friction from the grooves alone.
///
/// Without a preload there is no friction without a load; with one, that of the preload.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CagedBallScrew;

/// Constants of a caged ball screw.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CagedConstants {
    law: Law,
    reversal: Reversal,
    limits: Limits,
}

/// Where friction comes from.
#[expect(
    clippy::large_enum_variant,
    reason = "without a heap there is no box; constants stand in flash"
)]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
enum Law {
    Contacts(Contacts),
    Closed(ClosedForm),
}

/// What a tick reads and changes in a caged ball screw: laws over the load, and balls that are renewed; nothing for a closed
/// form.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CagedState {
    contacts: Option<ContactsState>,
}

impl Scene for CagedBallScrew {
    type Configuration = CagedBallScrewConfiguration;
    type Constants = CagedConstants;
    type State = CagedState;
    type Inputs = Inputs;
    type Known = Inputs;
    type Outputs = Outputs;

    fn constants(configuration: &CagedBallScrewConfiguration) -> Result<CagedConstants, Error> {
        CagedConstants::new(configuration)
    }

    fn initial_state(constants: &CagedConstants) -> CagedState {
        CagedState {
            contacts: match &constants.law {
                Law::Contacts(contacts) => Some(contacts.initial_state()),
                Law::Closed(_) => None,
            },
        }
    }

    fn reset(constants: &CagedConstants, state: &mut CagedState) {
        if let (Law::Contacts(contacts), Some(state)) = (&constants.law, &mut state.contacts) {
            contacts.reset(state);
        }
    }

    fn take_over(constants: &CagedConstants, state: &mut CagedState) -> Result<(), Error> {
        match (&constants.law, &mut state.contacts) {
            (Law::Contacts(contacts), Some(state)) => {
                contacts.take_over(state);
                Ok(())
            }
            (Law::Closed(_), None) => Ok(()),
            (Law::Contacts(_), None) => in_range("branch", CONTACTS, CLOSED, CLOSED).map(|_| ()),
            (Law::Closed(_), Some(_)) => in_range("branch", CLOSED, CONTACTS, CONTACTS).map(|_| ()),
        }
    }

    #[inline(always)]
    fn admit(constants: &CagedConstants, inputs: Inputs) -> Admitted<Inputs> {
        constants.limits.admit(inputs)
    }

    #[inline(always)]
    fn outputs(constants: &CagedConstants, state: &mut CagedState, inputs: Inputs) -> Outputs {
        let reversal = &constants.reversal;
        match (&constants.law, &mut state.contacts) {
            (Law::Contacts(contacts), Some(state)) => {
                let passage = reversal.passage(inputs.nut_speed);
                let full = contacts.one_way(state, inputs, passage.way);
                contacts.passed(inputs.axial_load, &full, passage)
            }
            (Law::Closed(closed), _) => closed.outputs(reversal, inputs),
            (Law::Contacts(_), None) => Outputs::SAFE,
        }
    }

    #[inline(always)]
    fn largest_friction(constants: &CagedConstants) -> f32 {
        constants.limits.friction_torque
    }
}

/// Laws for two friction coefficients beside the configuration's; none where the coefficient does not change, or friction is
/// that of a closed form.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CagedCoefficients {
    laws: Option<CoefficientLaws>,
}

impl Sliding for CagedBallScrew {
    const FRICTION: Range = ranges::FRICTION_OF_A_ROW;

    const COUNTS_PRELOAD: bool = true;

    type Coefficients = CagedCoefficients;
    type Full = CagedFull;

    fn coefficients(constants: &CagedConstants, least: f32, largest: f32) -> CagedCoefficients {
        let Law::Contacts(contacts) = &constants.law else {
            return CagedCoefficients { laws: None };
        };
        CagedCoefficients {
            laws: contacts.laws_between(least, largest),
        }
    }

    #[inline(always)]
    fn full(
        constants: &CagedConstants,
        state: &mut CagedState,
        coefficients: Option<&CagedCoefficients>,
        inputs: Inputs,
        friction: DirectionalCoefficient,
    ) -> CagedFull {
        match (&constants.law, &mut state.contacts) {
            (Law::Contacts(contacts), Some(state)) => {
                let laws = coefficients.and_then(|known| known.laws.as_ref());
                contacts.both_ways(state, laws, inputs, friction)
            }
            (Law::Closed(closed), _) => closed.both_ways(inputs.axial_load),
            (Law::Contacts(_), None) => CagedFull {
                forward: 0.0,
                backward: 0.0,
                load: 0.0,
                faults: Faults::NONE,
            },
        }
    }

    #[inline(always)]
    fn friction(full: &CagedFull) -> SlidingFriction {
        full.sliding()
    }

    #[inline(always)]
    fn passed(
        constants: &CagedConstants,
        inputs: Inputs,
        full: &CagedFull,
        passage: Passage,
    ) -> Outputs {
        match &constants.law {
            Law::Contacts(contacts) => contacts.passed(inputs.axial_load, full, passage),
            Law::Closed(closed) => closed.passed(inputs.axial_load, full, passage),
        }
    }

    #[inline(always)]
    fn in_a_tick(_: &CagedConstants, turn: f32, measured: f32) -> (f32, f32) {
        (turn, measured)
    }
}

impl CagedConstants {
    /// Checks a configuration and folds its constants: at set-up, or in a constant when firmware is compiled (see
    /// [`FrictionModel`](crate::FrictionModel)).
    ///
    /// # Errors
    /// [`Error`] naming the field out of range.
    pub const fn new(configuration: &CagedBallScrewConfiguration) -> Result<Self, Error> {
        let CagedBallScrewConfiguration {
            branch,
            rolling_tangent,
            loaded_balls,
            reversal_speed,
            limits,
            ..
        } = *configuration;
        attempt!(configuration.rolling_resistance.checked());
        attempt!(in_range("rolling_tangent", rolling_tangent, 0.0, 0.1));
        attempt!(in_range("loaded_balls", loaded_balls as f32, 1.0, 1e3));
        let reversal = attempt!(Reversal::new(reversal_speed, 1e-6, 1e3));
        let limits = attempt!(limits.checked());
        Ok(Self {
            law: match branch {
                FrictionBranch::Contacts => Law::Contacts(attempt!(Contacts::new(configuration))),
                FrictionBranch::Rolling | FrictionBranch::Sliding => {
                    Law::Closed(attempt!(ClosedForm::new(&configuration.closed_form())))
                }
            },
            reversal,
            limits,
        })
    }
}

impl ChangingFriction for CagedBallScrew {
    fn set_friction(
        constants: &CagedConstants,
        state: &mut CagedState,
        friction: f32,
    ) -> Result<(), Error> {
        match (&constants.law, &mut state.contacts) {
            (Law::Contacts(contacts), Some(state)) => contacts.set_friction(state, friction),
            _ => ranges::FRICTION_OF_A_ROW
                .checked("friction", friction)
                .map(|_| ()),
        }
    }
}

impl ChangingClearance for CagedBallScrew {
    fn set_clearance(
        constants: &CagedConstants,
        state: &mut CagedState,
        clearance: Clearance,
    ) -> Result<(), Error> {
        match (&constants.law, &mut state.contacts) {
            (Law::Contacts(contacts), Some(state)) => contacts.set_clearance(state, clearance),
            _ => Ok(()),
        }
    }
}
