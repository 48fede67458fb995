//! A ball screw whose balls do not touch: caged, or with spacer balls.

use core::f32::consts::TAU;

use super::contract::{Admitted, Inputs, Limits, Regime, Reversal, Scene};
use super::faults::Faults;
use super::outputs::{Outputs, efficiency};
use crate::ball::{Clearance, PreloadSum};
use crate::efficiency::{Drive, EfficiencyGeometry};
use crate::error::{Error, attempt, in_range};
use crate::geometry::BallScrew;
use crate::ranges;

/// Friction torque over load and pitch radius from which on a direction counts as locked: no motor of a steering gear
/// has a thousandth of that.
const LOCKED_RADII: f32 = 1e3;

/// Which state of the ball the friction torque is computed for (see [`efficiency`](crate::efficiency)).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum FrictionBranch {
    /// The ball rolls and slips across the groove at the screw, eq. (3): the expected value.
    #[default]
    Rolling,
    /// The ball slides along the path at both contacts, eq. (14) and (17): the pessimistic bound.
    Sliding,
}

/// A caged ball screw: friction from the grooves alone, in closed form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CagedBallScrew;

/// What the engineer sets for a caged ball screw; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CagedBallScrewConfiguration {
    /// The validated design.
    pub design: BallScrew,
    /// Coulomb friction coefficient of ball and groove, 0 to 1.
    pub friction: f32,
    /// Lever arm of rolling friction over `ball_radius sin(contact_angle)`, eq. (2), 0 to 0.1.
    pub rolling_tangent: f32,
    /// Which state of the ball the torque is computed for.
    pub branch: FrictionBranch,
    /// How balls fit between the grooves, -0.02 to 0.05 ball radii. Oversize presses each flank of the nut with
    /// [`Clearance::axial_preload`]; play changes nothing, because the papers' closed forms know no third contact.
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
    /// Half the friction torque per load on the flank that opposes the motion, m.
    half_drive: f32,
    /// Half the friction torque per load on the flank that assists the motion, m.
    half_backdrive: f32,
    /// Torque per axial load without friction, `lead / 2 pi`, m.
    reduced_lead: f32,
    reversal: Reversal,
    /// Whether no torque drives a load.
    drive_locked: bool,
    /// Sum of both flanks' axial loads under the load between them.
    flanks: PreloadSum,
    limits: Limits,
}

impl Scene for CagedBallScrew {
    type Configuration = CagedBallScrewConfiguration;
    type Constants = CagedConstants;
    /// Friction of grooves alone has no state.
    type State = ();
    type Inputs = Inputs;
    type Outputs = Outputs;

    fn constants(configuration: &CagedBallScrewConfiguration) -> Result<CagedConstants, Error> {
        CagedConstants::new(configuration)
    }

    fn initial_state(_: &CagedConstants) {}

    #[inline(always)]
    fn admit(constants: &CagedConstants, inputs: Inputs) -> Admitted<Inputs> {
        constants.limits.admit(inputs)
    }

    #[inline(always)]
    fn outputs(constants: &CagedConstants, (): &mut (), inputs: Inputs) -> Outputs {
        constants.outputs(inputs)
    }

    #[inline(always)]
    fn largest_friction(constants: &CagedConstants) -> f32 {
        constants.limits.friction_torque
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
            ref design,
            friction,
            rolling_tangent: rolling,
            branch,
            clearance,
            loaded_balls,
            reversal_speed,
            limits,
        } = *configuration;
        attempt!(ranges::FRICTION_OR_NONE.checked("friction", friction));
        attempt!(in_range("rolling_tangent", rolling, 0.0, 0.1));
        let clearance = attempt!(clearance.checked(design));
        attempt!(in_range("loaded_balls", loaded_balls as f32, 1.0, 1e3));
        let reversal = attempt!(Reversal::new(reversal_speed, 1e-6, 1e3));
        let limits = attempt!(limits.checked());

        let drive = torque_per_load(design, branch, Drive::Driving, friction, rolling);
        let backdrive = torque_per_load(design, branch, Drive::BackDriving, friction, rolling);
        // Beyond its lock the formula turns infinite or negative.
        let lock = LOCKED_RADII * design.pitch_radius();
        let drive_locked = !(drive >= 0.0 && drive < lock);

        Ok(Self {
            half_drive: if drive_locked {
                0.5 * backdrive
            } else {
                0.5 * drive
            },
            half_backdrive: 0.5 * backdrive,
            reduced_lead: design.lead() / TAU,
            reversal,
            drive_locked,
            flanks: PreloadSum::new(clearance.axial_preload(design, loaded_balls)),
            limits,
        })
    }

    /// `T = s [c_d (S + s F) + c_b (S - s F)] / 2` with the blended direction `s = w / sqrt(w² +
    /// w_s²)`, the flanks' sum `S` and difference `F`: `c_d |F|` driving and `c_b |F|` back-driving
    /// away from the reversal, zero at standstill, smooth between, odd under reversal of speed and
    /// load together, and never of the sign that would make friction a source of power.
    #[inline(always)]
    fn outputs(&self, inputs: Inputs) -> Outputs {
        let Inputs {
            nut_speed: speed,
            axial_load: load,
        } = inputs;
        let direction = self.reversal.direction(speed);
        let sum = self.flanks.under(load);
        let load_torque = load * self.reduced_lead;

        // Full friction in the direction of motion, for the efficiency; standstill counts as forward.
        let opposing = if speed < 0.0 { -load } else { load };
        let full = self.friction_torque(sum, opposing);
        let load_work = opposing * self.reduced_lead;

        let locks_driving = self.drive_locked && opposing > 0.0;
        let friction_torque = if locks_driving {
            direction * self.limits.friction_torque
        } else {
            direction * self.friction_torque(sum, direction * load)
        };
        let efficiency = if locks_driving {
            0.0
        } else {
            efficiency(load_work > 0.0, load_work, full)
        };
        let load_opposes = !(load_work < 0.0);
        let moves = if load_opposes {
            !locks_driving
        } else {
            efficiency > 0.0
        };
        Outputs {
            friction_torque,
            load_torque,
            efficiency,
            regime: Regime::of(self.reversal.stands(speed), load_opposes, moves),
            faults: Faults::NONE.with(locks_driving, Faults::FRICTION_LIMIT),
        }
    }

    /// Size of the friction torque, N m, from the flanks' sum of loads and their difference, N, positive where it
    /// opposes the motion: `[c_d (S + F) + c_b (S - F)] / 2`.
    #[inline(always)]
    fn friction_torque(&self, sum: f32, difference: f32) -> f32 {
        self.half_drive * (sum + difference) + self.half_backdrive * (sum - difference)
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
        FrictionBranch::Rolling => {
            geometry.rolling_torque_per_load(drive, radius, friction, rolling)
        }
        FrictionBranch::Sliding => geometry.sliding_torque_per_load(drive, radius, friction),
    }
}
