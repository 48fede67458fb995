//! One ball of a caged ball screw along its loads: what it loses in its grooves under one load after the other.
//!
//! The same balance as [`ElasticRow`](super::ball_screw_row::ElasticRow) with one ball, but each load starts from the state of the load before,
//! which is a hundred times faster than from nothing, and every answer is of the same accuracy: a state that Newton's method does not
//! reach from its neighbour is searched for from nothing.

use super::ball_screw_ball::dimensional;
use super::ball_screw_grooves::ElasticGrooves;
use super::ball_screw_placed::{BallState, Drive, PlacedBall, Rubbing, STICK_SPIN};
use super::ball_screw_row::RowBallMotion;
use super::ball_screw_settle::settle;
use super::patch::Integration;
use super::rolling_resistance::{RollingResistance, rolling_losses};
use crate::curvature::Groove;
use crate::design::BallScrewDesign;
use crate::error::{ReferenceError, within};

/// A ball in the grooves of a screw, no neighbour pressing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CagedBall {
    /// Screw.
    pub design: BallScrewDesign,
    /// Radial gap of every contact at the centred ball and the unloaded screw, m: play above zero, oversize below.
    pub clearance: f64,
    /// Friction coefficient of the grooves, 0.001 to 1.
    pub friction: f64,
    /// Rolling resistance of every contact.
    pub rolling: RollingResistance,
    /// Nodes of the contact integrals.
    pub integration: Integration,
}

/// What a ball loses under a load while the nut turns forward.
#[derive(Clone, Debug, PartialEq)]
pub struct CagedBallFriction {
    /// Axial load on the ball, N: above zero it opposes the travel of a nut that turns forward.
    pub axial_load: f64,
    /// Friction torque on the nut, N m, rolling resistance included.
    pub torque: f64,
    /// Loads of SL, SR, NL, NR, N.
    pub loads: [f64; 4],
    /// Orbital speed over the nut's.
    pub orbital_speed: f64,
}

impl CagedBall {
    /// Friction under each of these axial loads, N, none of them zero, all of one sign; in their order.
    pub fn along(
        &self,
        axial_loads: &[f64],
    ) -> Result<Vec<Result<CagedBallFriction, ReferenceError>>, ReferenceError> {
        let grooves = self.grooves()?;
        let mut last: Option<BallState> = None;
        Ok(axial_loads
            .iter()
            .map(|&axial_load| {
                within("axial_load", axial_load, -1e6, 1e6)?;
                if axial_load == 0.0 {
                    return Err(ReferenceError::Undriven);
                }
                let ball = PlacedBall {
                    grooves: &grooves,
                    friction: self.friction,
                    direction: 1.0,
                    axial_load,
                    rubbing: Rubbing::default(),
                    alike: None,
                    integration: self.integration,
                    rest_spin: STICK_SPIN,
                };
                let solved = settle(&ball, Drive::Force(0.0), last.as_ref());
                last = solved.as_ref().ok().map(|solved| solved.state);
                let solved = solved?;
                self.friction_of(&ball, &solved.state, solved.residual)
            })
            .collect())
    }

    fn grooves(&self) -> Result<ElasticGrooves, ReferenceError> {
        within("friction", self.friction, 1e-3, 1.0)?;
        let radius = self.design.ball_radius;
        self.design.check_grooves()?;
        within("clearance", self.clearance, -0.05 * radius, 0.2 * radius)?;
        self.rolling.check()?;
        let grooves = ElasticGrooves {
            track: (&self.design).into(),
            screw_groove_radius: self.design.screw_groove_radius,
            nut_groove_radius: self.design.nut_groove_radius,
            arc_angles: [self.design.contact_angle; 4],
            screw: self.design.contact(Groove::Screw)?.into(),
            nut: self.design.contact(Groove::Nut)?.into(),
            oversize: -self.clearance,
        };
        grooves
            .check()
            .map_err(|error| error.renamed("contact_angle"))?;
        Ok(grooves)
    }

    fn friction_of(
        &self,
        ball: &PlacedBall<'_>,
        state: &BallState,
        residual: f64,
    ) -> Result<CagedBallFriction, ReferenceError> {
        let rows = ball.rows_of(state).unwrap_or_default();
        let motion = RowBallMotion {
            motion: dimensional(
                &ball.grooves.track,
                &rows,
                &state.motion,
                STICK_SPIN,
                self.friction,
                1.0,
                residual / self.friction,
            ),
            loads: ball.loads(&state.place),
            position: [state.place.x, state.place.y],
            screw_displacement: state.place.z,
            force: state.force,
        };
        let [hysteresis, lubricant] = rolling_losses(&self.design, &self.rolling, &motion, 1.0)?;
        Ok(CagedBallFriction {
            axial_load: ball.axial_load,
            torque: motion.motion.power_loss + hysteresis + lubricant,
            loads: motion.loads,
            orbital_speed: motion.motion.orbital_speed,
        })
    }
}
