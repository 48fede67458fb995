//! Configuration of a ball screw without cage.

use core::f32::consts::TAU;

use super::UncagedConstants;
use crate::ball::LoadShares;
use crate::ball::folded::node_octaves;
use crate::ball::pressed::{BallLaw, RowConstants};
use crate::error::{Error, attempt, in_range};
use crate::math::constant;
use crate::math::elliptic::arc_sine;
use crate::ranges;
use crate::scene::circuit::{Circuit, CircuitConfiguration, DeviationMap, LONGEST_TRACK};
use crate::scene::contract::{Limits, Reversal};

/// Folded part of a ball screw without cage: the law of one ball, and the numbers of the drawing that a step needs; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FoldedBall<const NODES: usize = 1> {
    /// Law of one ball.
    pub law: BallLaw<NODES>,
    /// Friction coefficient of ball and groove at set-up, within the law's nodes.
    pub friction: f32,
    /// Advance of the nut per turn, m, 0 to 0.2.
    pub lead: f32,
    /// Radius of the balls, m, 1e-5 to 0.1.
    pub ball_radius: f32,
    /// Length of a turn of the ball centres' helix over 2 pi, m, above the ball radius, up to 1.
    pub path_radius: f32,
    /// Nominal speed of a ball along the track against the nut, m per unit of nut speed, above 0 and below the path radius.
    pub speed: f32,
    /// Nut speed over which friction changes its direction, rad/s, 1e-6 to 1e3: at this speed it has 71 % of its full value.
    pub reversal_speed: f32,
    /// Limits of inputs and outputs.
    pub limits: Limits,
}

/// Configuration of a ball screw without cage; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct UncagedBallScrewConfiguration<const NODES: usize = 1> {
    /// The folded ball.
    pub folded: &'static FoldedBall<NODES>,
    /// Coulomb friction coefficient of ball and ball, 0 to 1; friction of its neighbours takes no more than 0.3 of their force on a ball.
    pub ball_friction: f32,
    /// Balls in the circuit, 1 to the `N` of the model.
    pub balls: u16,
    /// Turns of the loaded track, 0.1 to 100.
    pub turns: f32,
    /// Length of the return, m, 0 to 10, up to 250 times the loaded track, and 1000 turns with it: there balls carry no load.
    pub return_length: f32,
    /// Deviation of the contact angles along the screw's groove, at most [`BallLaw::deviations`](crate::ball::pressed::BallLaw::deviations).
    pub screw_deviation: &'static DeviationMap,
    /// Deviation of the contact angles along the nut's groove, from the start of the loaded track, at most the law's.
    pub nut_deviation: &'static DeviationMap,
    /// Load of a ball over the mean load, at the middles of equal parts of the loaded track from its start; 1 to 256 for each sign of the load.
    pub load_shares: LoadShares,
    /// Time between two ticks, s, 1e-6 to 1; at the largest nut speed the balls may move by 3 % of the
    /// track in it, and the screw by half a period of its deviation map.
    pub tick: f32,
}

impl<const NODES: usize> FoldedBall<NODES> {
    /// What its balls have in common in a row; the chord's angle is `sin(b) = R_B/R_path` (Lin 2019, eq. (3.72)).
    pub const fn row(&self, ball_friction: f32) -> RowConstants {
        let sin = self.ball_radius / self.path_radius;
        let per_cos = 1.0 / constant::sqrt(1.0 - sin * sin);
        RowConstants {
            ball_friction: ball_friction * per_cos,
            outward: sin * per_cos,
            normal: per_cos,
            half_speed: 0.5 * self.speed,
        }
    }
}

impl<const NODES: usize> UncagedBallScrewConfiguration<NODES> {
    pub(super) const fn circuit(&self, limits: &Limits, most: usize) -> Result<Circuit, Error> {
        let Self {
            turns,
            return_length,
            tick,
            ..
        } = *self;
        let FoldedBall {
            ball_radius,
            path_radius,
            speed,
            ..
        } = *self.folded;
        attempt!(in_range("ball_radius", ball_radius, 1e-5, 0.1));
        let shortest = 1.01 * ball_radius;
        attempt!(in_range("path_radius", path_radius, shortest, 1.0));
        attempt!(in_range("speed", speed, 1e-6 * path_radius, path_radius));
        attempt!(in_range("turns", turns, 0.1, 100.0));
        attempt!(in_range("return_length", return_length, 0.0, 10.0));
        attempt!(in_range("tick", tick, 1e-6, 1.0));
        let per_turn = TAU * path_radius;
        let loaded_length = self.loaded_length();
        let longest = LONGEST_TRACK * per_turn - loaded_length;
        attempt!(in_range("return_length", return_length, 0.0, longest));
        CircuitConfiguration {
            balls: self.balls,
            loaded_length,
            loaded_turns: turns,
            return_length,
            turn_length: per_turn,
            pitch: 2.0 * path_radius * arc_sine(ball_radius / path_radius),
            travel_per_motion: speed,
            motion_per_turn: TAU,
            passing_deviation: self.screw_deviation,
            recirculating_deviation: self.nut_deviation,
            load_shares: self.load_shares,
            tick,
            largest_speed: limits.nut_speed,
        }
        .folded(most)
    }

    pub(super) const fn loaded_length(&self) -> f32 {
        self.turns * (TAU * self.folded.path_radius)
    }
}

impl<const N: usize, const NODES: usize> UncagedConstants<N, NODES> {
    /// Checks a configuration and folds its constants.
    pub const fn new(configuration: &UncagedBallScrewConfiguration<NODES>) -> Result<Self, Error> {
        let UncagedBallScrewConfiguration {
            folded,
            ball_friction,
            screw_deviation,
            nut_deviation,
            load_shares,
            tick,
            ..
        } = *configuration;
        let FoldedBall {
            ref law,
            friction,
            lead,
            reversal_speed,
            limits,
            ..
        } = *folded;
        attempt!(law.checked());
        let (least, largest) = law.friction_range();
        attempt!(in_range("friction", friction, least, largest));
        attempt!(ranges::FRICTION_OR_NONE.checked("ball_friction", ball_friction));
        attempt!(in_range("lead", lead, 0.0, 0.2));
        let limits = attempt!(limits.checked());
        let circuit = attempt!(configuration.circuit(&limits, N));
        let [screw, nut] = law.deviations;
        attempt!(screw_deviation.checked("screw_deviation", screw));
        attempt!(nut_deviation.checked("nut_deviation", nut));
        let units = circuit.zone.units();
        Ok(Self {
            law,
            friction: law.interval(friction),
            node_octaves: node_octaves(&law.frictions()),
            circuit,
            row: folded.row(ball_friction),
            units: [units.0 / screw, units.1 / nut],
            even: load_shares.are_even(),
            preload: law.lift_off / circuit.per_loaded_ball(),
            tick,
            per_tick: 1.0 / tick,
            reduced_lead: lead / TAU,
            reversal: attempt!(Reversal::new(reversal_speed, 1e-6, 1e3)),
            limits,
        })
    }

    /// These constants with other limits, of a calibration page.
    pub const fn with_limits(&self, limits: Limits) -> Result<Self, Error> {
        Ok(Self {
            limits: attempt!(limits.checked()),
            ..*self
        })
    }
}
