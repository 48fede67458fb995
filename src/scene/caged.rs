//! A ball screw whose balls do not touch: caged, or with spacer balls.

use core::f32::consts::TAU;

use super::faults::answered;
use super::{Faults, Inputs, Limits, Outputs, Regime, Scene, efficiency};
use crate::efficiency::{Drive, EfficiencyGeometry};
use crate::error::{Error, attempt, in_range};
use crate::geometry::BallScrew;
use crate::math;
use crate::ranges;

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
    /// Axial preload on each flank without load, N: 0, or 1e-3 to 1e6.
    pub preload: f32,
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
    /// Square of the reversal speed.
    reversal_squared: f32,
    /// The reversal speed.
    reversal_speed: f32,
    /// Whether no torque drives a load.
    drive_locked: bool,
    preload: Preload,
    limits: Limits,
}

/// Sum of the two flanks' axial loads as a function of their difference, the load.
///
/// Two Hertzian flanks pressed together by `Fp`: `F1^(2/3) + F2^(2/3) = 2 Fp^(2/3)`, `F1 - F2 = F`.
/// The sum is `Fp (2 + y²/12 + ...)` with `y = F / Fp`, up to `y = 2 sqrt(2)` where the light flank
/// lifts off, and `F` from there on. The next coefficient is chosen so that both meet at lift-off; the
/// largest error between is 0.8 %.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct Preload {
    /// `2 sqrt(2) Fp`.
    lift_off: f32,
    /// `2 Fp`.
    constant: f32,
    /// `1 / (12 Fp)`.
    square: f32,
    /// `QUARTIC / Fp²`.
    quartic: f32,
}

impl Preload {
    /// `(12 (2 sqrt(2) - 2) / 8 - 1) / 8`: the sum is continuous at lift-off.
    const QUARTIC: f32 = 0.030330086;

    const fn new(preload: f32) -> Self {
        if preload > 0.0 {
            Self {
                lift_off: 2.0 * core::f32::consts::SQRT_2 * preload,
                constant: 2.0 * preload,
                square: 1.0 / (12.0 * preload),
                quartic: Self::QUARTIC / (preload * preload),
            }
        } else {
            Self {
                lift_off: 0.0,
                constant: 0.0,
                square: 0.0,
                quartic: 0.0,
            }
        }
    }

    #[inline]
    fn flank_sum(&self, load: f32) -> f32 {
        let magnitude = load.abs();
        if magnitude < self.lift_off {
            let squared = load * load;
            self.constant + squared * self.square * (1.0 + squared * self.quartic)
        } else {
            magnitude
        }
    }
}

/// State of a caged ball screw: only a diagnostic counter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CagedState {
    /// Consecutive ticks whose outputs were flagged, up to `u32::MAX`; 0 after a sound tick.
    pub faulted_ticks: u32,
}

impl Scene for CagedBallScrew {
    type Configuration = CagedBallScrewConfiguration;
    type Constants = CagedConstants;
    type State = CagedState;
    type Inputs = Inputs;
    type Outputs = Outputs;

    fn constants(configuration: &CagedBallScrewConfiguration) -> Result<CagedConstants, Error> {
        CagedConstants::new(configuration)
    }

    fn initial_state(_: &CagedConstants) -> CagedState {
        CagedState::default()
    }

    #[inline]
    fn step(constants: &CagedConstants, state: &mut CagedState, inputs: Inputs) -> Outputs {
        let (outputs, ticks) = answered(
            constants.limits.admit(inputs),
            state.faulted_ticks,
            |inputs, faults| constants.outputs(inputs, faults),
        );
        state.faulted_ticks = ticks;
        outputs
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
            preload,
            reversal_speed,
            limits,
        } = *configuration;
        attempt!(ranges::FRICTION_OR_NONE.checked("friction", friction));
        attempt!(in_range("rolling_tangent", rolling, 0.0, 0.1));
        if preload != 0.0 {
            attempt!(in_range("preload", preload, 1e-3, 1e6));
        }
        attempt!(in_range("reversal_speed", reversal_speed, 1e-6, 1e3));
        let limits = attempt!(limits.checked());

        let geometry = EfficiencyGeometry::of(design);
        let radius = design.pitch_radius();
        let (drive, backdrive) = match branch {
            FrictionBranch::Rolling => (
                geometry.rolling_torque_per_load(Drive::Driving, radius, friction, rolling),
                geometry.rolling_torque_per_load(Drive::BackDriving, radius, friction, rolling),
            ),
            FrictionBranch::Sliding => (
                geometry.sliding_torque_per_load(Drive::Driving, radius, friction),
                geometry.sliding_torque_per_load(Drive::BackDriving, radius, friction),
            ),
        };
        // Beyond its lock the formula turns infinite or negative; a torque that would be a thousand
        // pitch radii times the load is as good as locked.
        let drive_locked = !(drive >= 0.0 && drive < 1e3 * radius);

        Ok(Self {
            half_drive: if drive_locked {
                0.5 * backdrive
            } else {
                0.5 * drive
            },
            half_backdrive: 0.5 * backdrive,
            reduced_lead: design.lead() / TAU,
            reversal_squared: reversal_speed * reversal_speed,
            reversal_speed,
            drive_locked,
            preload: Preload::new(preload),
            limits,
        })
    }

    /// `T = s [c_d (S + s F) + c_b (S - s F)] / 2` with the blended direction `s = w / sqrt(w² +
    /// w_s²)`, the flanks' sum `S` and difference `F`: `c_d |F|` driving and `c_b |F|` back-driving
    /// away from the reversal, zero at standstill, smooth between, odd under reversal of speed and
    /// load together, and never of the sign that would make friction a source of power.
    #[inline]
    fn outputs(&self, inputs: Inputs, faults: Faults) -> Outputs {
        let Inputs {
            nut_speed: speed,
            axial_load: load,
        } = inputs;
        let direction = speed / math::sqrt(speed * speed + self.reversal_squared);
        let sum = self.preload.flank_sum(load);
        let load_torque = load * self.reduced_lead;

        // Full friction in the direction of motion, for the efficiency; standstill counts as forward.
        let opposing = if speed < 0.0 { -load } else { load };
        let full = self.half_drive * (sum + opposing) + self.half_backdrive * (sum - opposing);
        let load_work = opposing * self.reduced_lead;

        let locks_driving = self.drive_locked && opposing > 0.0;
        let torque = if locks_driving {
            direction * self.limits.friction_torque
        } else {
            let blended = direction * load;
            direction * (self.half_drive * (sum + blended) + self.half_backdrive * (sum - blended))
        };
        let (friction_torque, limited) = self.limits.limit_torque(torque);

        let efficiency = if locks_driving {
            0.0
        } else {
            efficiency(load_work > 0.0, load_work, full)
        };
        let regime = if speed.abs() < self.reversal_speed {
            Regime::Standing
        } else if locks_driving || (load_work < 0.0 && efficiency <= 0.0) {
            Regime::Locked
        } else if load_work < 0.0 {
            Regime::BackDriving
        } else {
            Regime::Driving
        };
        Outputs {
            friction_torque,
            load_torque,
            efficiency,
            regime,
            faults: (faults | limited).with(locks_driving, Faults::TORQUE_LIMIT),
        }
    }
}
