//! A ball screw whose balls do not touch: caged, or with spacer balls.

mod closed_form;
mod coefficients;
mod contacts;
mod full;
mod stored;

use super::changing::{ChangingClearance, ChangingFriction};
use super::contract::{Admitted, Inputs, Limits, Scene, SceneOutputs};
use super::faults::Faults;
use super::outputs::Outputs;
use super::passage::{Passage, Reversal};
use super::sliding::{Sliding, SlidingFriction};
use crate::ball::Clearance;
use crate::contact::RollingResistance;
use crate::error::{Error, Range, attempt, in_range};
use crate::geometry::BallScrew;
use crate::law::coefficient::DirectionalCoefficient;
use crate::ranges;
use closed_form::ClosedForm;
use coefficients::CoefficientLaws;
use contacts::{Contacts, ContactsState};
pub use full::CagedFull;

/// Friction of contacts, and closed forms, as numbers that an error can name.
const CONTACTS: f32 = 0.0;
const CLOSED: f32 = 1.0;

/// Which state of the ball the friction torque is computed for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum FrictionBranch {
    /// What the contacts of a ball dissipate in its balance between elastic grooves: they spin and slip, along the track and
    /// across it, all of them that carry; with their rolling resistance. It is the friction of an
    /// [`UncagedBallScrew`](crate::UncagedBallScrew) whose balls do not press on each other.
    ///
    /// Before the first tick the friction torque is folded into a law over the load, 0.01 to 1000 N a ball, for both
    /// directions. Where friction coefficient or clearance are set while the model runs
    /// ([`FrictionModel::set_friction`](crate::FrictionModel::set_friction)), a ball is renewed in every tick instead.
    #[default]
    Contacts,
    /// The ball rolls and slips across the groove at the screw, eq. (3) of Lin, Velinsky and Ravani 1994: a closed form, for
    /// comparison. It leaves out spin, the third contact, clearance but for a preload, and the contacts' size: torque is in
    /// proportion to the load, and without [`rolling_tangent`](CagedBallScrewConfiguration::rolling_tangent) hardly depends
    /// on the lead.
    Rolling,
    /// The ball slides along the path at both contacts, eq. (14) and (17) of the same: a closed form for comparison, a
    /// pessimistic bound. It leaves out that balls roll.
    Sliding,
}

/// A caged ball screw: friction from the grooves alone.
///
/// Without a preload there is no friction without a load; with one, that of the preload.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CagedBallScrew;

/// What the engineer sets for a caged ball screw; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CagedBallScrewConfiguration {
    /// The validated design; contact angle 0.05 to 1.5 rad for [`FrictionBranch::Contacts`].
    pub design: BallScrew,
    /// Coulomb friction coefficient of ball and groove, 1e-6 to 0.5; 0 to 1 for the closed forms.
    pub friction: f32,
    /// Rolling resistance of every contact of ball and groove; closed forms know none.
    pub rolling_resistance: RollingResistance,
    /// Lever arm of rolling friction over `ball_radius sin(contact_angle)`, eq. (2), 0 to 0.1; for the closed forms alone:
    /// see [`FrictionBranch`].
    pub rolling_tangent: f32,
    /// Which state of the ball the torque is computed for.
    pub branch: FrictionBranch,
    /// How balls fit between the grooves, -0.02 to 0.05 ball radii. The closed forms know no third contact: for them oversize
    /// presses each flank of the nut with [`Clearance::axial_preload`], and play changes nothing.
    pub clearance: Clearance,
    /// Number of balls that carry load, 1 to 1000.
    pub loaded_balls: u16,
    /// Nut speed over which friction changes its direction, rad/s, 1e-6 to 1e3: at this speed it has
    /// 71 % of its full value.
    pub reversal_speed: f32,
    /// Bounds that are kept whatever comes in.
    pub limits: Limits,
}

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

/// What friction coefficients beside the configuration's need: laws for two more; nothing where there is one alone, or
/// friction is that of a closed form.
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
        SlidingFriction {
            forward: full.forward,
            backward: full.backward,
            load: full.load,
        }
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
    fn speed_of(_: &CagedConstants, _: f32, measured: f32) -> f32 {
        measured
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
                    Law::Closed(attempt!(ClosedForm::new(configuration)))
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
            _ => Ok(()),
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
