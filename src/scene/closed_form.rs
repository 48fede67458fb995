//! A ball screw whose balls do not touch, by the closed forms of the papers: from catalogue numbers alone, without a host.

use super::contract::Faults;
use super::contract::{
    CheckedInputs, Inputs, Limits, Regime, Reversal, ReversalState, Scene, SceneOutputs as _,
};
use super::outputs::Outputs;
use super::sliding::{CagedFriction, Sliding, SlidingFriction};
use super::stored::StoredScene;
use crate::ball::{Clearance, PreloadSum};
use crate::efficiency::{Drive, EfficiencyGeometry};
use crate::error::{Error, Range, attempt, in_range};
use crate::geometry::BallScrew;
use crate::law::coefficient::DirectionalCoefficient;
use crate::ranges;
use crate::stored::{Fingerprint, Refusal};

/// Friction torque over load and pitch radius from which on a direction counts as locked.
const LOCKED_RADII: f32 = 1e3;

/// A ball screw whose balls do not touch, by a paper's closed form: for comparison.
///
/// Torque is in proportion to the load. Over the built-in designs, 5 to 300 N a ball, a rolling ball has 0.02 to 1.1 times the exact torque, a
/// sliding one 0.6 to 14 times (see [`FrictionBranch`]); [`built_in`](crate::scene::built_in) sizes of a
/// [`CagedBallScrew`](crate::scene::CagedBallScrew) need no host either and are exact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ClosedFormScrew;

/// Configuration of a screw by a closed form; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ClosedFormScrewConfiguration {
    /// The validated design.
    pub design: BallScrew,
    /// Coulomb friction coefficient of ball and groove, 0 to 1.
    pub friction: f32,
    /// Lever arm of rolling friction over `ball_radius sin(contact_angle)`, eq. (2), 0 to 0.1.
    pub rolling_tangent: f32,
    /// Which state of the ball the torque is computed for.
    pub branch: FrictionBranch,
    /// How balls fit between the grooves, -0.02 to 0.05 ball radii: oversize presses each flank of the nut with
    /// [`Clearance::axial_preload`]; play changes nothing.
    pub clearance: Clearance,
    /// Number of balls that carry load, 1 to 1000.
    pub loaded_balls: u16,
    /// Nut speed over which friction changes its direction, rad/s, 1e-6 to 1e3: at this speed it has 71 % of its full value.
    pub reversal_speed: f32,
    /// Limits of inputs and outputs.
    pub limits: Limits,
}

/// Which state of the ball the friction torque is computed for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum FrictionBranch {
    /// The ball rolls and slips across the groove at the screw, eq. (3) of Lin, Velinsky and Ravani 1994. It leaves out spin, the
    /// third contact, clearance but for a preload, and the contacts' size: without
    /// [`rolling_tangent`](ClosedFormScrewConfiguration::rolling_tangent) the torque hardly depends on the lead.
    Rolling,
    /// The ball slides along the path at both contacts, eq. (14) and (17) of the same: a pessimistic bound.
    Sliding,
}

/// Constants of a screw by a closed form.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ClosedFormScrewConstants {
    /// Half the friction torque per load on the flank that opposes the motion, m.
    half_drive: f32,
    /// Half the friction torque per load on the flank that assists the motion, m.
    half_backdrive: f32,
    /// Torque per axial load without friction, `lead / 2 pi`, m.
    reduced_lead: f32,
    drive_locked: bool,
    /// Sum of both flanks' axial loads under the load between them.
    flanks: PreloadSum,
    reversal: Reversal,
    limits: Limits,
}

impl ClosedFormScrewConstants {
    /// Checks a configuration and folds its constants.
    pub const fn new(configuration: &ClosedFormScrewConfiguration) -> Result<Self, Error> {
        let ClosedFormScrewConfiguration {
            ref design,
            friction,
            rolling_tangent: rolling,
            branch,
            clearance,
            loaded_balls,
            reversal_speed,
            limits,
        } = *configuration;
        attempt!(in_range("rolling_tangent", rolling, 0.0, 0.1));
        attempt!(in_range("loaded_balls", loaded_balls as f32, 1.0, 1e3));
        let reversal = attempt!(Reversal::new(reversal_speed, 1e-6, 1e3));
        let limits = attempt!(limits.checked());
        attempt!(ranges::FRICTION_OR_NONE.checked("friction", friction));
        let clearance = attempt!(clearance.checked(design));
        let drive = torque_per_load(design, branch, Drive::Driving, friction, rolling);
        let backdrive = torque_per_load(design, branch, Drive::BackDriving, friction, rolling);
        // Beyond its lock the formula turns infinite or negative.
        let lock = LOCKED_RADII * design.pitch_radius();
        let drive_locked = !(drive >= 0.0 && drive < lock);
        let drive = if drive_locked { backdrive } else { drive };
        Ok(Self {
            half_drive: 0.5 * drive,
            half_backdrive: 0.5 * backdrive,
            reduced_lead: design.reduced_lead(),
            drive_locked,
            flanks: PreloadSum::new(clearance.axial_preload(design, loaded_balls)),
            reversal,
            limits,
        })
    }

    #[inline]
    fn locks(&self, opposing_load: f32) -> bool {
        self.drive_locked && opposing_load > 0.0
    }

    /// Size of the friction torque, N m, from the flanks' sum of loads and their difference, N, positive where it
    /// opposes the motion: `[c_d (S + F) + c_b (S - F)] / 2`.
    #[inline]
    fn friction_torque(&self, sum: f32, difference: f32) -> f32 {
        self.half_drive * (sum + difference) + self.half_backdrive * (sum - difference)
    }

    /// Outputs with this friction torque, where sliding in the direction of motion has `sliding`. A locked drive holds with the largest torque.
    #[inline]
    fn outputs(
        &self,
        load: f32,
        sliding: f32,
        friction_torque: f32,
        reversal: &ReversalState,
        faults: Faults,
    ) -> Outputs {
        let locked = self.locks(reversal.direction * load);
        let outputs = Outputs::new(
            friction_torque,
            sliding,
            load * self.reduced_lead,
            reversal,
            faults.with(locked && friction_torque != 0.0, Faults::FRICTION_LIMIT),
            self.limits.friction_torque,
        );
        if locked && !reversal.standing {
            Outputs {
                regime: Regime::Locked,
                ..outputs
            }
        } else {
            outputs
        }
    }
}

/// Friction torque over the axial load in one direction of motion, m.
const fn torque_per_load(
    design: &BallScrew,
    branch: FrictionBranch,
    drive: Drive,
    friction: f32,
    rolling: f32,
) -> f32 {
    let geometry = EfficiencyGeometry::of(design);
    let radius = design.pitch_radius();
    match branch {
        FrictionBranch::Sliding => geometry.sliding_torque_per_load(drive, radius, friction),
        FrictionBranch::Rolling => {
            geometry.rolling_torque_per_load(drive, radius, friction, rolling)
        }
    }
}

impl Scene for ClosedFormScrew {
    type Configuration = ClosedFormScrewConfiguration;
    type Constants = ClosedFormScrewConstants;
    type State = ();
    type Inputs = Inputs;
    type Outputs = Outputs;

    fn constants(configuration: &Self::Configuration) -> Result<Self::Constants, Error> {
        ClosedFormScrewConstants::new(configuration)
    }

    fn initial_state(_: &Self::Constants) {}

    fn take_over(_: &Self::Constants, (): &mut Self::State) -> Result<(), Error> {
        Ok(())
    }

    /// `T = s [c_d (S + s F) + c_b (S - s F)] / 2` with the blended direction `s = w / sqrt(w² +
    /// w_s²)` at the speed `w`, the flanks' sum `S` and difference `F`: `c_d |F|` driving and `c_b |F|` back-driving
    /// away from the reversal, zero at standstill, smooth between, odd under reversal of speed and
    /// load together, and never of the sign that would make friction a source of power.
    #[inline]
    fn step(constants: &Self::Constants, (): &mut Self::State, inputs: Inputs) -> Outputs {
        let CheckedInputs { inputs, faults } = constants.limits.check_inputs(inputs);
        let Some(Inputs {
            nut_speed,
            axial_load,
        }) = inputs
        else {
            return Outputs::safe(faults);
        };
        let reversal = constants.reversal.at(nut_speed);
        let ReversalState {
            factor, direction, ..
        } = reversal;
        let sum = constants.flanks.under(axial_load);
        let opposing_load = direction * axial_load;
        let friction_torque = if constants.locks(opposing_load) {
            factor * constants.limits.friction_torque
        } else {
            factor * constants.friction_torque(sum, factor * axial_load)
        };
        let sliding = constants.friction_torque(sum, opposing_load);
        constants.outputs(axial_load, sliding, friction_torque, &reversal, faults)
    }
}

impl Sliding for ClosedFormScrew {
    const FRICTION: Range = ranges::FRICTION_OF_A_ROW;

    const COUNTS_PRELOAD: bool = true;

    type Friction = CagedFriction;

    #[inline]
    fn check_inputs(constants: &Self::Constants, inputs: Inputs) -> CheckedInputs<Inputs> {
        constants.limits.check_inputs(inputs)
    }

    #[inline]
    fn sliding_friction(
        constants: &Self::Constants,
        (): &mut Self::State,
        inputs: Inputs,
        _: DirectionalCoefficient,
    ) -> CagedFriction {
        let load = inputs.axial_load;
        let sum = constants.flanks.under(load);
        let sliding = |opposing_load| {
            if constants.locks(opposing_load) {
                constants.limits.friction_torque
            } else {
                constants.friction_torque(sum, opposing_load)
            }
        };
        CagedFriction {
            sliding: SlidingFriction {
                forward: sliding(load),
                backward: sliding(-load),
                load: constants.flanks.counted(load),
            },
            faults: Faults::NONE,
        }
    }

    #[inline]
    fn by_direction(sliding: &CagedFriction) -> SlidingFriction {
        sliding.sliding
    }

    #[inline]
    fn outputs_at(
        constants: &Self::Constants,
        inputs: Inputs,
        friction: &CagedFriction,
        reversal: ReversalState,
        drag: f32,
        faults: Faults,
    ) -> Outputs {
        let torque = reversal.factor * friction.of(reversal.factor);
        let sliding = friction.of(reversal.direction);
        constants.outputs(inputs.axial_load, sliding, torque + drag, &reversal, faults)
    }
}

impl StoredScene for ClosedFormScrew {
    const KIND: u16 = 5;

    fn fingerprint(_: &Self::Constants, fingerprint: &mut Fingerprint) {
        fingerprint.count(0);
    }

    fn complete(_: &Self::Constants, (): &mut Self::State) -> Result<(), Refusal> {
        Ok(())
    }
}
