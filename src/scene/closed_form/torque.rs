//! Friction torque by a closed form.

use super::configuration::{ClosedFormScrewConfiguration, FrictionBranch};
use crate::ball::PreloadSum;
use crate::efficiency::{Drive, EfficiencyGeometry};
use crate::error::{Error, attempt};
use crate::geometry::BallScrew;
use crate::ranges;
use crate::scene::caged_friction::CagedFriction;
use crate::scene::contract::{Inputs, Regime};
use crate::scene::faults::Faults;
use crate::scene::outputs::Outputs;
use crate::scene::reversal::{Reversal, ReversalState};

/// Friction torque over load and pitch radius from which on a direction counts as locked: no motor of a steering gear
/// has a thousandth of that.
const LOCKED_RADII: f32 = 1e3;

/// Constants of a closed form.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct ClosedForm {
    /// Half the friction torque per load on the flank that opposes the motion, m.
    half_drive: f32,
    /// Half the friction torque per load on the flank that assists the motion, m.
    half_backdrive: f32,
    /// Torque per axial load without friction, `lead / 2 pi`, m.
    reduced_lead: f32,
    /// Whether no torque drives a load.
    drive_locked: bool,
    /// Sum of both flanks' axial loads under the load between them.
    flanks: PreloadSum,
    /// What a locked drive holds with, N m.
    largest_torque: f32,
}

impl ClosedForm {
    /// Checks what it reads of a configuration, and folds it.
    ///
    /// # Errors
    /// [`Error`] naming `friction` or `clearance`.
    pub(super) const fn new(configuration: &ClosedFormScrewConfiguration) -> Result<Self, Error> {
        let ClosedFormScrewConfiguration {
            ref design,
            friction,
            rolling_tangent: rolling,
            branch,
            clearance,
            loaded_balls,
            limits,
            ..
        } = *configuration;
        attempt!(ranges::FRICTION_OR_NONE.checked("friction", friction));
        let clearance = attempt!(clearance.checked(design));
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
            reduced_lead: design.reduced_lead(),
            drive_locked,
            flanks: PreloadSum::new(clearance.axial_preload(design, loaded_balls)),
            largest_torque: limits.friction_torque,
        })
    }

    /// `T = s [c_d (S + s F) + c_b (S - s F)] / 2` with the blended direction `s = w / sqrt(w² +
    /// w_s²)` at the speed `w`, the flanks' sum `S` and difference `F`: `c_d |F|` driving and `c_b |F|` back-driving
    /// away from the reversal, zero at standstill, smooth between, odd under reversal of speed and
    /// load together, and never of the sign that would make friction a source of power.
    #[inline(always)]
    pub(super) fn outputs(&self, reversal: &Reversal, inputs: Inputs) -> Outputs {
        let Inputs {
            nut_speed: speed,
            axial_load: load,
        } = inputs;
        let reversal = reversal.at(speed);
        let direction = reversal.factor;
        let sum = self.flanks.under(load);
        // Sliding friction in the direction of motion, for the efficiency; standstill counts as forward.
        let opposing_load = if speed < 0.0 { -load } else { load };
        let friction_torque = if self.locks(opposing_load) {
            direction * self.largest_torque
        } else {
            direction * self.friction_torque(sum, direction * load)
        };
        let sliding = self.friction_torque(sum, opposing_load);
        self.put_out(
            load,
            opposing_load,
            sliding,
            friction_torque,
            reversal.standing,
        )
    }

    /// Sliding friction in both directions.
    #[inline(always)]
    pub(super) fn both_ways(&self, load: f32) -> CagedFriction {
        let sum = self.flanks.under(load);
        let of = |opposing_load| {
            if self.locks(opposing_load) {
                self.largest_torque
            } else {
                self.friction_torque(sum, opposing_load)
            }
        };
        CagedFriction {
            forward: of(load),
            backward: of(-load),
            load: self.flanks.counted(load),
            faults: Faults::NONE,
        }
    }

    /// Sliding friction times the factor of the reversal.
    #[inline(always)]
    pub(super) fn outputs_at(
        &self,
        load: f32,
        found: &CagedFriction,
        reversal: ReversalState,
    ) -> Outputs {
        let friction_torque = reversal.factor * found.of(reversal.factor);
        let opposing_load = reversal.direction * load;
        let sliding = found.of(reversal.direction);
        self.put_out(
            load,
            opposing_load,
            sliding,
            friction_torque,
            reversal.standing,
        )
    }

    /// Whether no torque drives this load.
    #[inline(always)]
    fn locks(&self, opposing_load: f32) -> bool {
        self.drive_locked && opposing_load > 0.0
    }

    /// The outputs under a load that opposes the motion by `opposing_load`.
    #[inline(always)]
    fn put_out(
        &self,
        load: f32,
        opposing_load: f32,
        sliding: f32,
        friction_torque: f32,
        standing: bool,
    ) -> Outputs {
        let opposing_torque = opposing_load * self.reduced_lead;
        let locks_driving = self.locks(opposing_load);
        let load_opposes = !(opposing_torque < 0.0);
        let moves = if load_opposes {
            !locks_driving
        } else {
            sliding < -opposing_torque
        };
        Outputs {
            friction_torque,
            load_torque: load * self.reduced_lead,
            efficiency: 0.0,
            regime: Regime::of(standing, load_opposes, moves),
            faults: Faults::NONE.with(
                locks_driving && friction_torque != 0.0,
                Faults::FRICTION_LIMIT,
            ),
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
        FrictionBranch::Sliding => geometry.sliding_torque_per_load(drive, radius, friction),
        FrictionBranch::Rolling => {
            geometry.rolling_torque_per_load(drive, radius, friction, rolling)
        }
    }
}
