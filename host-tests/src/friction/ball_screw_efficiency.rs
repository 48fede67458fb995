//! Friction torque and efficiency of a ball screw under a steady load, by the exact balance of one of its balls.
//!
//! All balls are alike and carry the same share; none presses on another. The torque is that of the grooves: sliding
//! and spinning of every contact that carries ([`ElasticRow`]), and rolling resistance ([`RollingResistance`]). Left
//! out: balls that rub on each other, the return, wipers and seals, unequal shares.

use std::f64::consts::TAU;

use rayon::prelude::*;

use super::ball_screw_row::{ElasticRow, RowBall, RowBallMotion};
use super::newton::root_between;
use super::patch::Integration;
use super::rolling_resistance::{RollingResistance, rolling_losses};
use crate::curvature::Groove;
use crate::design::BallScrewDesign;
use crate::error::{ReferenceError, within};

/// Least friction coefficient of the exact balance. Below it the balance is taken with this one: loads and speeds have
/// settled, and the torque is in proportion.
const LEAST_FRICTION: f64 = 1e-3;

/// A fit ends where its parameter no longer changes, or its torque is met within 1 %.
const FIT: (f64, f64) = (1e-9, 0.01);

/// A ball screw under a load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadedScrew {
    /// Screw.
    pub design: BallScrewDesign,
    /// Radial gap of every contact at the centred ball and the unloaded screw, m: play above zero, oversize below.
    pub clearance: f64,
    /// Friction coefficient of the grooves, 0 to 1.
    pub friction: f64,
    /// Rolling resistance of every contact.
    pub rolling: RollingResistance,
    /// Balls that carry, 1 to 1e4.
    pub balls: f64,
    /// Axial load on the screw, N, not zero; above zero it opposes the travel of a nut that turns forward.
    pub axial_load: f64,
}

/// What a loaded screw loses, as torques on the nut, N m.
#[derive(Clone, Debug, PartialEq)]
pub struct ScrewFriction {
    /// Sliding and spinning of the contacts.
    pub sliding: f64,
    /// Elastic hysteresis.
    pub hysteresis: f64,
    /// Drag of the lubricant.
    pub lubricant: f64,
    /// Torque of the axial load without friction, `|F| lead/2 pi`.
    pub ideal: f64,
    /// One of the balls, at a nut speed of 1 rad/s.
    pub ball: RowBallMotion,
}

impl ScrewFriction {
    /// Friction torque, N m.
    pub fn torque(&self) -> f64 {
        self.sliding + self.hysteresis + self.lubricant
    }

    /// Efficiency where the nut drives the load: `T / (T + friction)`.
    pub fn efficiency(&self) -> f64 {
        self.ideal / (self.ideal + self.torque())
    }

    /// Efficiency where the load drives the nut: `1 - friction / T`; below zero where it cannot.
    pub fn backdrive_efficiency(&self) -> f64 {
        1.0 - self.torque() / self.ideal
    }

    /// Contacts that carry.
    pub fn contacts(&self) -> usize {
        self.ball.loads.iter().filter(|load| **load > 0.0).count()
    }
}

impl LoadedScrew {
    /// Solves one ball, at a nut speed of 1 rad/s: Coulomb friction does not depend on it, and the lubricant's drag is given as a force.
    pub fn solve(&self) -> Result<ScrewFriction, ReferenceError> {
        within("friction", self.friction, 0.0, 1.0)?;
        within("balls", self.balls, 1.0, 1e4)?;
        within("axial_load", self.axial_load, -1e9, 1e9)?;
        let friction = self.friction.max(LEAST_FRICTION);
        let row = ElasticRow {
            design: self.design,
            clearance: self.clearance,
            friction,
            ball_friction: 0.0,
            nut_speed: 1.0,
            balls: vec![RowBall {
                screw_deviation: 0.0,
                nut_deviation: 0.0,
                axial_load: self.axial_load / self.balls,
            }],
            chord: true,
            integration: Integration::Full,
        };
        let mut motion = row.solve()?;
        let sliding = motion.free_groove_loss() * self.friction / friction;
        let ball = motion.free.swap_remove(0);
        let [hysteresis, lubricant] =
            rolling_losses(&self.design, &self.rolling, &ball, row.nut_speed)?;
        Ok(ScrewFriction {
            sliding: sliding * self.balls,
            hysteresis: hysteresis * self.balls,
            lubricant: lubricant * self.balls,
            ideal: self.axial_load.abs() * self.design.lead / TAU,
            ball,
        })
    }

    /// Many screws at once, in parallel. `step` is called after each.
    pub fn solve_all(
        screws: &[Self],
        step: &(dyn Fn() + Sync),
    ) -> Vec<Result<ScrewFriction, ReferenceError>> {
        screws
            .par_iter()
            .map(|screw| {
                let friction = screw.solve();
                step();
                friction
            })
            .collect()
    }

    /// Friction torque of two nuts that are braced against each other by `|axial_load|`, N m: one drives, the other is driven.
    pub fn double_nut_torque(&self) -> Result<f64, ReferenceError> {
        let opposite = Self {
            axial_load: -self.axial_load,
            ..*self
        };
        Ok(self.solve()?.torque() + opposite.solve()?.torque())
    }

    /// The same screw with balls so much larger than their grooves that each diagonal carries the axial force
    /// `|axial_load|` without an outer load; and next to none of that (a fiftieth).
    pub fn braced_by_oversize(&self) -> Result<Self, ReferenceError> {
        let deflection = self.design.contact(Groove::Screw)?.deflection
            + self.design.contact(Groove::Nut)?.deflection;
        let normal = self.axial_load.abs()
            / self.balls
            / (self.design.contact_angle.sin() * self.design.lead_angle().cos());
        Ok(Self {
            clearance: -0.5 * deflection * normal.powf(2.0 / 3.0),
            axial_load: 0.02 * self.axial_load,
            ..*self
        })
    }

    /// The friction coefficient between 0.01 and 0.4 at which a torque is `target`, N m, within 1 %; None where no such
    /// coefficient gives it.
    ///
    /// `torque` is [`Self::solve`]'s or [`Self::double_nut_torque`]; it rises with the coefficient.
    pub fn friction_for(
        &self,
        target: f64,
        torque: impl Fn(&Self) -> Result<f64, ReferenceError>,
    ) -> Option<f64> {
        let missing = |logarithm: f64| {
            let friction = logarithm.exp();
            Some((torque(&Self { friction, ..*self }).ok()? / target).ln())
        };
        root_between((0.01_f64.ln(), 0.4_f64.ln()), FIT, missing).map(f64::exp)
    }

    /// The clearance between 20 um of play and 6 um of oversize at which the friction torque is `target`, N m, within 1
    /// %; None where none gives it.
    pub fn clearance_for(&self, target: f64) -> Option<f64> {
        let missing = |clearance: f64| {
            let friction = Self { clearance, ..*self }.solve().ok()?;
            Some((friction.torque() / target).ln())
        };
        root_between((-6e-6, 20e-6), FIT, missing)
    }
}
