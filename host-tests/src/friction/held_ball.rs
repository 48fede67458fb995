//! One ball of a ball screw whose neighbours let it run, or hold it at a speed: the force that they need for it, and what it loses.
//!
//! The balance is that of one ball of an [`ElasticRow`](super::ball_screw_row::ElasticRow), to 1e-8 of the contacts' loads, with either the
//! force along the track given, or the orbital speed. Friction of the neighbours is that of two balls that move as this one does:
//!
//! ```text
//! slip between two balls alike   s = S_rear m + S_front m,   with the motion m of both and the slips S of Lin 2019, eq. (3.73)
//! friction on this ball          -(f_behind S_front' + f_ahead S_rear') s/|s|
//! ```
//!
//! with the friction forces `f` of the two contacts, N. It follows the slip inside Newton's method: with a friction of given direction a
//! ball has no balance beyond 0.15 to 0.5 of the grooves' friction. Neighbours on a curved track also push a ball outward
//! ([`HeldBall::outward`]).
//!
//! Source: Lin 2019, eqs. (2.11) to (2.14), (3.65) to (3.77).

use super::ball_screw_grooves::ElasticGrooves;
use super::ball_screw_placed::{AlikeNeighbours, BallState, Drive, PlacedBall, Solved};
use super::ball_screw_row::RowBallMotion;
use super::ball_screw_rubbing::BallContact;
use super::ball_screw_settle::{near, settle, unit};
use super::patch::Integration;
use super::rolling_resistance::{RollingResistance, rolling_losses};
use crate::design::BallScrewDesign;
use crate::error::{ReferenceError, within};

/// A ball of a screw that its neighbours may hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldBall {
    /// Screw.
    pub design: BallScrewDesign,
    /// Radial gap of every contact at the centred ball and the unloaded screw, m: play above zero, oversize below; -0.05 to 0.2 ball radii.
    pub clearance: f64,
    /// Friction coefficient of the grooves, 0.001 to 1.
    pub friction: f64,
    /// Rolling resistance of every contact.
    pub rolling: RollingResistance,
    /// Nodes of the contact integrals.
    pub integration: Integration,
}

/// The ball in grooves that deviate.
#[derive(Clone, Copy, Debug)]
pub struct DeviatingBall {
    ball: HeldBall,
    grooves: ElasticGrooves,
}

/// What is given along the track.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AlongTrack {
    /// No force: the ball runs as it would alone, but for its neighbours' friction.
    Free,
    /// An orbital speed over the nut's speed, -10 to 10.
    Held(f64),
}

/// What acts on the ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallDrive {
    /// Axial load, N, not zero: above zero it opposes the travel of a nut that turns forward.
    pub axial_load: f64,
    /// Along the track.
    pub along: AlongTrack,
    /// Friction forces of the ball behind and of the one ahead, N, 0 to 1e5: friction coefficient between balls times the force between them.
    pub rubbing: [f64; 2],
    /// Outward force of both neighbours because the track is curved, N, 0 to 1e5: [`HeldBall::outward`] times the sum of their forces along it.
    pub outward: f64,
}

impl BallDrive {
    /// An axial load, N, alone.
    pub fn free(axial_load: f64) -> Self {
        Self {
            axial_load,
            along: AlongTrack::Free,
            rubbing: [0.0; 2],
            outward: 0.0,
        }
    }
}

/// A state from which the next one starts, when it is near.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallStart(BallState);

/// How the ball runs while the nut turns forward, and what it takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldBallFriction {
    /// Axial load, N: above zero it opposes the travel of a nut that turns forward.
    pub axial_load: f64,
    /// Orbital speed over the nut's speed.
    pub orbital_speed: f64,
    /// Force of the neighbours on the ball along the track, in the direction of orbiting, N.
    pub force: f64,
    /// Change of this force with the orbital speed over the nut's speed at given friction of the neighbours, N.
    pub stiffness: f64,
    /// Friction torque on the nut, N m: power lost in the grooves over the nut's speed, and rolling resistance. What the neighbours' friction
    /// loses is not in it.
    pub torque: f64,
    /// Half the speed with which two balls rub that both move as this one, m per unit of nut speed.
    pub half_slip: f64,
    /// Loads of SL, SR, NL, NR, N.
    pub loads: [f64; 4],
    /// For the next state.
    pub start: BallStart,
}

impl HeldBall {
    /// Outward force of two balls that press on each other on the curved track, on either, over that along the track.
    pub fn outward(&self) -> f64 {
        BallContact::new(&(&self.design).into(), 0.0, 1.0, true).outward_force(1.0)
    }

    /// The ball where the arc centres of the screw's and the nut's groove are turned by these angles, rad, -0.2 to 0.2.
    pub fn in_grooves(
        &self,
        screw_deviation: f64,
        nut_deviation: f64,
    ) -> Result<DeviatingBall, ReferenceError> {
        within("friction", self.friction, 1e-3, 1.0)?;
        self.rolling.check()?;
        let nominal = ElasticGrooves::of(&self.design, self.clearance)?;
        Ok(DeviatingBall {
            ball: *self,
            grooves: nominal.deviating(screw_deviation, nut_deviation)?,
        })
    }

    /// Friction without deviations and neighbours under each of these axial loads, N, none of them zero, all of one sign; in their order.
    ///
    /// Each load starts from the state of the load before, which is a hundred times faster than from nothing, and every answer is of the same
    /// accuracy: a state that Newton's method does not reach from its neighbour is searched for from nothing.
    pub fn along(
        &self,
        axial_loads: &[f64],
    ) -> Result<Vec<Result<HeldBallFriction, ReferenceError>>, ReferenceError> {
        let ball = self.in_grooves(0.0, 0.0)?;
        let mut last: Option<BallStart> = None;
        let friction = |axial_load: &f64| {
            let found = ball.solve(&BallDrive::free(*axial_load), last.as_ref());
            last = found.as_ref().ok().map(|found| found.start);
            found
        };
        Ok(axial_loads.iter().map(friction).collect())
    }
}

impl DeviatingBall {
    /// A state near that of the free ball under an axial load, N, for [`Self::solve`]: in a tenth of the time that a ball takes from nothing.
    /// None where the ball leaves its grooves.
    pub fn near(&self, axial_load: f64) -> Option<BallStart> {
        near(&self.placed(axial_load)).map(BallStart)
    }

    fn placed(&self, axial_load: f64) -> PlacedBall<'_> {
        let HeldBall {
            friction,
            integration,
            ..
        } = self.ball;
        PlacedBall::alone(&self.grooves, friction, 1.0, axial_load, integration)
    }

    /// How it runs, found from the state of a neighbouring one, or from nothing.
    pub fn solve(
        &self,
        drive: &BallDrive,
        start: Option<&BallStart>,
    ) -> Result<HeldBallFriction, ReferenceError> {
        within("axial_load", drive.axial_load, -1e6, 1e6)?;
        if drive.axial_load == 0.0 {
            return Err(ReferenceError::Undriven);
        }
        for friction in drive.rubbing {
            within("rubbing", friction, 0.0, 1e5)?;
        }
        within("outward", drive.outward, 0.0, 1e5)?;
        let along = match drive.along {
            AlongTrack::Free => Drive::Force(0.0),
            AlongTrack::Held(speed) => Drive::Speed(within("orbital_speed", speed, -10.0, 10.0)?),
        };
        let ball = self.placed(drive.axial_load);
        let start = start.map(|start| &start.0);
        let solved = if drive.rubbing == [0.0; 2] && drive.outward == 0.0 {
            settle(&ball, along, start)?
        } else {
            self.rubbed(&ball, along, drive, start)?
        };
        self.friction_of(&ball, &solved)
    }

    fn rubbed(
        &self,
        ball: &PlacedBall<'_>,
        along: Drive,
        drive: &BallDrive,
        start: Option<&BallState>,
    ) -> Result<Solved, ReferenceError> {
        let first = match start {
            Some(start) => *start,
            None => settle(ball, along, None)?.state,
        };
        let rubbed = |share: f64| PlacedBall {
            alike: Some(AlikeNeighbours {
                contact: self.contact(),
                friction: drive.rubbing.map(|friction| share * friction),
                outward: share * drive.outward,
            }),
            ..*ball
        };
        for steps in [1, 3, 10] {
            let mut solved = None;
            let mut last = Some(first);
            for step in 1..=steps {
                let there = rubbed(f64::from(step) / f64::from(steps));
                let found = last.and_then(|last| there.newton(&last, along, unit(ball)));
                solved = found.filter(|found| found.residual <= ball.accuracy(&found.state).1);
                last = solved.map(|found| found.state);
            }
            if let Some(solved) = solved {
                return Ok(solved);
            }
        }
        settle(&rubbed(1.0), along, Some(&first))
    }

    fn contact(&self) -> BallContact {
        BallContact::new(&self.grooves.track, 1.0, 1.0, false)
    }

    fn friction_of(
        &self,
        ball: &PlacedBall<'_>,
        solved: &Solved,
    ) -> Result<HeldBallFriction, ReferenceError> {
        let state = &solved.state;
        let found = RowBallMotion::of(ball, solved, 1.0);
        let HeldBall {
            design, rolling, ..
        } = &self.ball;
        let [hysteresis, lubricant] = rolling_losses(design, rolling, &found, 1.0)?;
        let slip = self.contact().slip(state, state);
        Ok(HeldBallFriction {
            axial_load: ball.axial_load,
            orbital_speed: state.motion[0],
            force: state.force,
            stiffness: solved.stiffness,
            torque: found.motion.power_loss + hysteresis + lubricant,
            half_slip: 0.5 * slip.norm() * design.ball_radius,
            loads: found.loads,
            start: BallStart(*state),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::friction::ball_screw_row::{ElasticRow, RowBall};

    const BALL: HeldBall = HeldBall {
        design: BallScrewDesign::LIN,
        clearance: -4e-7,
        friction: 0.08,
        rolling: RollingResistance::STEEL,
        integration: Integration::Full,
    };

    fn row(balls: Vec<RowBall>, ball_friction: f64) -> ElasticRow {
        ElasticRow {
            design: BallScrewDesign::LIN,
            clearance: BALL.clearance,
            friction: BALL.friction,
            ball_friction,
            nut_speed: 1.0,
            balls,
            // The ball of a law feels no force that points outward.
            chord: false,
            integration: Integration::Full,
        }
    }

    /// From a state that is near it is the ball found from nothing: both balances are accurate to 1e-8 of the loads.
    #[test]
    fn a_near_start_leads_to_the_same_ball() {
        for (deviation, axial_load) in [(0.0, -200.0), (0.02, -20.0), (-0.02, 8.0), (0.0, 120.0)] {
            let ball = BALL.in_grooves(0.0, deviation).unwrap();
            let drive = BallDrive::free(axial_load);
            let expected = ball.solve(&drive, None).unwrap();
            let near = ball.near(axial_load).unwrap();
            let found = ball.solve(&drive, Some(&near)).unwrap();
            assert!((found.torque / expected.torque - 1.0).abs() < 1e-7);
            assert!((found.orbital_speed - expected.orbital_speed).abs() < 1e-7);
            assert!(near.0.motion != expected.start.0.motion);
        }
    }

    /// Balls alike touch and do not press: each runs as it would alone, with the deviations of their grooves.
    #[test]
    fn balls_alike_of_a_row_are_this_ball() {
        for (screw_deviation, nut_deviation, axial_load) in
            [(0.017, -0.008, 60.0), (-0.01, 0.009, -35.0)]
        {
            let alike = RowBall {
                screw_deviation,
                nut_deviation,
                axial_load,
            };
            let expected = row(vec![alike; 2], 0.0).solve().unwrap();
            let ball = BALL.in_grooves(screw_deviation, nut_deviation).unwrap();
            let found = ball.solve(&BallDrive::free(axial_load), None).unwrap();
            let speed = expected.pressing[0].motion.orbital_speed;
            assert!((found.orbital_speed - speed).abs() < 1e-9);
            for (found, expected) in found.loads.iter().zip(expected.pressing[1].loads) {
                assert!((found - expected).abs() < 1e-6 * axial_load.abs());
            }
        }
    }

    /// Two balls that differ press with the force that holds each of them at their common speed.
    #[test]
    fn a_pair_presses_with_the_force_that_holds_its_balls() {
        let of = |deviation: f64| RowBall {
            screw_deviation: deviation,
            nut_deviation: 0.005,
            axial_load: 60.0,
        };
        let deviations = [0.012, -0.012];
        let mut balls = deviations.map(of).to_vec();
        let mut expected = row(balls.clone(), 0.0).solve().unwrap();
        if expected.contact_forces[0] == 0.0 {
            balls.reverse();
            expected = row(balls.clone(), 0.0).solve().unwrap();
        }
        let force = expected.contact_forces[0];
        assert!(force > 0.05, "{force}");
        for (ball, (motion, sign)) in balls.iter().zip(expected.pressing.iter().zip([-1.0, 1.0])) {
            let held = AlongTrack::Held(motion.motion.orbital_speed);
            let drive = BallDrive {
                along: held,
                ..BallDrive::free(60.0)
            };
            let found = BALL
                .in_grooves(ball.screw_deviation, ball.nut_deviation)
                .unwrap()
                .solve(&drive, None)
                .unwrap();
            assert!((found.force - sign * force).abs() < 1e-5 * force);
        }
    }

    /// What the nut and the neighbours put in is what the grooves lose, with friction of the neighbours and a force along the track; and the
    /// state does not depend on where it starts.
    #[test]
    fn power_is_balanced() {
        let smooth = HeldBall {
            rolling: RollingResistance::NONE,
            ..BALL
        };
        let ball = smooth.in_grooves(0.015, -0.006).unwrap();
        let free = ball.solve(&BallDrive::free(60.0), None).unwrap();
        // Up to nine tenths of the grooves' friction.
        for (axial_load, rubbing, outward) in [
            (60.0, [0.1, 0.02], 0.0),
            (-35.0, [0.0, 0.05], 0.8),
            (60.0, [2.4, 1.9], 5.0),
        ] {
            let drive = BallDrive {
                axial_load,
                along: AlongTrack::Held(free.orbital_speed * 1.002),
                rubbing,
                outward,
            };
            let found = ball.solve(&drive, None).unwrap();
            let again = ball.solve(&drive, Some(&free.start)).unwrap();
            assert!((found.force - again.force).abs() < 1e-6 * axial_load.abs());
            let BallStart(state) = found.start;
            let mut placed = ball.placed(axial_load);
            let slip = ball.contact().slip(&state, &state).normalize();
            placed.rubbing = ball.contact().rubbing(rubbing[0], slip)[1];
            placed.rubbing += ball.contact().rubbing(rubbing[1], slip)[0];
            let rows = placed.rows_of(&state).unwrap();
            let radius = BallScrewDesign::LIN.ball_radius;
            let nut = radius * placed.power_in(&rows, &state.motion);
            let neighbours = radius
                * (placed.rubbing.motion.dot(&state.motion)
                    + placed.path() * state.force * state.motion[0]);
            // Forces balanced to 1e-8 of the loads, times speeds of some ball radii.
            let off = (nut + neighbours - found.torque).abs();
            assert!(off < 1e-6 * found.torque, "{off:e} of {:e}", found.torque);
        }
    }

    #[test]
    fn what_is_out_of_range_is_named() {
        let wrong = |screw: f64, nut: f64| BALL.in_grooves(screw, nut).unwrap_err();
        assert_eq!(wrong(0.3, 0.0).field(), Some("screw_deviation"));
        assert_eq!(wrong(0.0, -0.3).field(), Some("nut_deviation"));
        let ball = BALL.in_grooves(0.0, 0.0).unwrap();
        let of = |drive: BallDrive| ball.solve(&drive, None).unwrap_err();
        let free = BallDrive::free(60.0);
        assert_eq!(of(BallDrive::free(0.0)), ReferenceError::Undriven);
        let rubbing = BallDrive {
            rubbing: [0.0, -1.0],
            ..free
        };
        assert_eq!(of(rubbing).field(), Some("rubbing"));
        let fast = BallDrive {
            along: AlongTrack::Held(f64::NAN),
            ..free
        };
        assert_eq!(of(fast).field(), Some("orbital_speed"));
    }
}
