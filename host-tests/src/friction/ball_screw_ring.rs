//! The whole ball screw without cage, exactly: balls on a closed ring, each in elastic balance in both gothic grooves with Coulomb friction
//! by exact contact integrals, that push the ball in front. Left out: a ball's inertia.
//!
//! The track runs through the nut: first the loaded part, then the return, whose end joins the start. The nut's deviation is fixed to the
//! track, the screw's passes by with the nut's angle. Each ball finds place and motion as in [`super::ball_screw_row`] under its own axial
//! load.
//!
//! A ball takes up its load, and gives it up, over a run-in: in proportion to the way over the distance of two touching balls, half of it
//! on either side of the border (over the whole return where that is shorter). The loads of all balls are the axial load times their
//! weights (load share times part of the run-in) over the sum of these. A preload runs in with it: the oversize by the power of 2/3. Two
//! balls rub on each other by the lesser of their parts.
//!
//! At every instant the forces between touching balls are those of a complementarity problem on the actual speeds: forces push, no ball
//! overtakes the one in front, and balls that press are equally fast. Where two balls meet or part inside a step, or one enters or leaves
//! the loaded part, the instant is located and solved, so that balls never overlap. Friction does not depend on the size of the speed.
//!
//! The force between two balls acts along the chord between their centres: a part of it (`sin b`, 7 to 17 %) points outward, unless
//! [`ElasticRing::chord`] leaves it out. Friction of a contact that sticks is smoothed over a spin of 1e-4 of the nut's speed.
//!
//! Source: Lin 2019, eqs. (2.11) to (2.14), (3.65) to (3.77) and section 3.4.4. Corrected: (3.77) takes contacts by the free speeds of two
//! neighbours, which lets chains of balls overlap; here by the actual speeds.

use std::f64::consts::TAU;

use super::ball_screw_grooves::ElasticGrooves;
pub use super::ball_screw_ring_deviation::{DeviationWave, GrooveDeviation};
use super::patch::Integration;
use crate::design::BallScrewDesign;
use crate::error::{ReferenceError, within};

/// Largest error of the power balance that is accepted of a solved state.
const POWER_ERROR: f64 = 1e-7;
/// Largest violation of the complementarity that is accepted of a solved state.
const COMPLEMENTARITY: f64 = 1e-8;

/// A ball screw without cage.
#[derive(Clone, Debug, PartialEq)]
pub struct ElasticRing {
    /// Screw.
    pub design: BallScrewDesign,
    /// Radial gap of every contact at the centred ball and the unloaded screw, m: play above zero, oversize below.
    pub clearance: f64,
    /// Friction coefficient of the grooves, 0.001 to 1.
    pub friction: f64,
    /// Friction coefficient between the balls, 0 to 1.
    pub ball_friction: f64,
    /// Number of balls, 1 to 1000; they must fit on the track.
    pub balls: usize,
    /// Turns of the loaded track, 0.01 to 100.
    pub turns: f64,
    /// Length of the return, m, 0 to 10.
    pub return_length: f64,
    /// Deviation of the screw's groove by the azimuth on the screw.
    pub screw_deviation: GrooveDeviation,
    /// Deviation of the nut's groove by the azimuth from the start of the loaded track.
    pub nut_deviation: GrooveDeviation,
    /// Loads of the balls over their mean, 0 to 100, at the middles of equal parts of the loaded track from its start, linear between them; empty
    /// for equal loads.
    pub load_shares: Vec<f64>,
    /// Whether forces between balls have the part that points outward because the track is curved: yes, but for figures of papers without it.
    pub chord: bool,
    /// Azimuths of the balls from the start of the track, rad, rising; empty for balls at equal distances from there.
    pub places: Vec<f64>,
    /// Nodes of the contact integrals.
    pub integration: Integration,
}

/// What the screw does at an instant; speed, and by a line the load, until the next sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RingSample {
    /// Time, s; not before that of the sample before.
    pub time: f64,
    /// Angular velocity of the nut, rad/s, from this sample to the next.
    pub nut_speed: f64,
    /// Axial load on the screw, N, along z: above zero carried by SL and NR.
    pub axial_load: f64,
}

/// Samples of constant speed and load over an angle of the nut, rad, the start included.
pub fn steady_samples(
    nut_speed: f64,
    axial_load: f64,
    nut_angle: f64,
    steps: usize,
) -> Vec<RingSample> {
    (0..=steps)
        .map(|step| RingSample {
            time: nut_angle / nut_speed.abs() * step as f64 / steps as f64,
            nut_speed,
            axial_load,
        })
        .collect()
}

/// One ball at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RingBall {
    /// Azimuth from the start of the track, rad; beyond the loaded turns in the return.
    pub place: f64,
    /// Orbital speed about the screw, rad/s.
    pub speed: f64,
    /// Force between this ball and the next of the list, the last and the first, N; zero where they part.
    pub force: f64,
    /// Distance to the next ball of the list between their surfaces, as an azimuth, rad.
    pub gap: f64,
    /// Axial force of the screw on the ball, N; zero in the return.
    pub axial_load: f64,
    /// Loads of SL, SR, NL, NR, N; zero in the return.
    pub loads: [f64; 4],
}

/// The screw at an instant.
#[derive(Clone, Debug, PartialEq)]
pub struct RingState {
    /// Time, s.
    pub time: f64,
    /// Angle of the nut since the start, rad.
    pub nut_angle: f64,
    /// Balls in the order of the track.
    pub balls: Vec<RingBall>,
    /// Torque that the friction of the grooves puts on the nut: their power over its speed, N m.
    pub groove_torque: f64,
    /// The same of the friction between balls, N m.
    pub ball_torque: f64,
    /// Largest unbalanced force of a ball over the sum of its contacts' loads.
    pub residual: f64,
    /// Power that the nut puts in less all that is lost, over the latter.
    pub power_error: f64,
    /// Largest violation of the complementarity: how much a ball overtakes the one it touches, over the nut's speed; a force that pulls, over
    /// the largest load; the lesser of a force and the speed at which its balls part, over the same.
    pub complementarity: f64,
    /// Instants solved inside the step before, where balls met or parted.
    pub events: usize,
    /// Why there is no solution: speeds, forces and torques then are NaN, and the balls go on with their speeds of before.
    pub failure: Option<ReferenceError>,
}

impl RingState {
    /// Friction torque, N m.
    pub fn torque(&self) -> f64 {
        self.groove_torque + self.ball_torque
    }

    /// Number of pairs that press.
    pub fn pressing(&self) -> usize {
        self.balls.iter().filter(|ball| ball.force > 0.0).count()
    }

    /// Largest force between two balls, N.
    pub fn largest_force(&self) -> f64 {
        self.balls.iter().map(|ball| ball.force).fold(0.0, f64::max)
    }

    /// True where the balances, that of power and the complementarity are met.
    pub fn solved(&self) -> bool {
        self.failure.is_none()
    }

    /// What a solved state must keep; otherwise it has failed.
    pub(crate) fn checked(mut self) -> Self {
        let broken = |residual: f64, unit| Some(ReferenceError::NotConverged { residual, unit });
        if self.failure.is_none() {
            self.failure = if !(self.power_error.abs() <= POWER_ERROR) {
                broken(self.power_error, "of the power lost")
            } else if !(self.complementarity <= COMPLEMENTARITY) {
                broken(self.complementarity, "of complementarity")
            } else {
                None
            };
        }
        self
    }
}

impl ElasticRing {
    /// Share of the track that the balls fill.
    pub fn occupation(&self) -> f64 {
        let pitch = 2.0 * self.track().ball_contact_angle().0.asin();
        self.balls as f64 * pitch / self.length()
    }

    fn track(&self) -> super::ball_screw_ball::ScrewTrack {
        (&self.design).into()
    }

    fn length(&self) -> f64 {
        TAU * self.turns + self.return_length / self.track().path_radius()
    }

    pub(crate) fn checked(&self) -> Result<RingTrack, ReferenceError> {
        within("friction", self.friction, 1e-3, 1.0)?;
        within("ball_friction", self.ball_friction, 0.0, 1.0)?;
        within("balls", self.balls as f64, 1.0, 1e3)?;
        within("turns", self.turns, 0.01, 100.0)?;
        within("return_length", self.return_length, 0.0, 10.0)?;
        let grooves = ElasticGrooves::of(&self.design, self.clearance)?;
        self.screw_deviation.check("screw_deviation")?;
        self.nut_deviation.check("nut_deviation")?;
        for share in &self.load_shares {
            within("load_shares", *share, 0.0, 100.0)?;
        }
        let angle = self.design.contact_angle;
        within("contact_angle", angle, 0.25, 1.3)?;
        within("balls", self.occupation(), 0.0, 1.0 + 1e-12)?;
        let pitch = 2.0 * self.track().ball_contact_angle().0.asin();
        let track = RingTrack {
            length: self.length(),
            loaded: TAU * self.turns,
            run_in: pitch
                .min(TAU * self.turns)
                .min(self.return_length / self.track().path_radius()),
            pitch,
            per_ball: self.length() / (TAU * self.turns * self.balls as f64),
            grooves,
        };
        self.check_places(&track)?;
        Ok(track)
    }

    fn check_places(&self, track: &RingTrack) -> Result<(), ReferenceError> {
        if self.places.is_empty() {
            return Ok(());
        }
        if self.places.len() != self.balls {
            return Err(ReferenceError::input("places", "are not one for each ball"));
        }
        for place in &self.places {
            within("places", *place, 0.0, track.length)?;
        }
        let first = self.places[0] + track.length;
        let ahead = self.places.iter().skip(1).chain(std::iter::once(&first));
        for (place, next) in self.places.iter().zip(ahead) {
            if next - place < track.pitch * (1.0 - 1e-12) {
                return Err(ReferenceError::input("places", "make balls overlap"));
            }
        }
        Ok(())
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct RingTrack {
    pub length: f64,
    pub loaded: f64,
    /// Over which a ball takes up its load, half of it before the loaded part.
    pub run_in: f64,
    /// Between the centres of two touching balls.
    pub pitch: f64,
    /// 1 / number of loaded balls, where all balls are spread evenly over the track.
    pub per_ball: f64,
    /// Without deviation.
    pub grooves: ElasticGrooves,
}

impl RingTrack {
    /// The azimuth at which the grooves are met, from the start of the loaded part: below zero on the run-in before it.
    pub fn azimuth(&self, place: f64) -> f64 {
        if place < self.loaded + 0.5 * self.run_in {
            place
        } else {
            place - self.length
        }
    }

    /// Part of its load that a ball carries at an azimuth: 1 between the run-ins, 0 in the return.
    pub fn part(&self, azimuth: f64) -> f64 {
        if self.run_in == 0.0 {
            return 1.0;
        }
        let beyond_border = azimuth.min(self.loaded - azimuth);
        (beyond_border / self.run_in + 0.5).clamp(0.0, 1.0)
    }
}
