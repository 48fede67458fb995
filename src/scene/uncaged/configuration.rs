//! What the engineer sets for a ball screw without cage, and its checks.

use core::f32::consts::TAU;

use crate::ball::{Clearance, LoadShares, ScrewRow};
use crate::contact::RollingResistance;
use crate::error::{Error, attempt, in_range};
use crate::geometry::BallScrew;
use crate::math::elliptic::arc_sine;
use crate::scene::circuit::{Circuit, CircuitConfiguration, DeviationMap, LONGEST_TRACK};
use crate::scene::contract::Limits;
use crate::train::LARGEST_FREE_SPEED;

/// Largest speed deviation = first x that of the closed form + second: room for what elastic contacts add.
///
/// A bound for balls that have not settled. In the tests of `host-tests/tests/scenes/uncaged.rs`, 320,000 renewals, no ball came to
/// more than 52 % of it: 0.013 without deviations, 1.2 to 1.7 times the closed form's with them.
const ELASTIC_ROOM: (f32, f32) = (1.5, 0.05);

/// What the engineer sets for a ball screw without cage; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct UncagedBallScrewConfiguration {
    /// The validated design.
    pub design: BallScrew,
    /// Coulomb friction coefficient of ball and groove, 1e-6 to 0.5.
    pub friction: f32,
    /// Coulomb friction coefficient of ball and ball, 0 to 1.
    pub ball_friction: f32,
    /// Rolling resistance of every contact of ball and groove.
    pub rolling_resistance: RollingResistance,
    /// How balls fit between the grooves, -0.02 to 0.05 ball radii.
    pub clearance: Clearance,
    /// Turns of the loaded track, 0.1 to 100.
    pub turns: f32,
    /// Length of the return, m, 0 to 10, up to 250 times the loaded track, and 1000 turns with it: there
    /// balls carry no load.
    pub return_length: f32,
    /// Deviation of the contact angles along the screw's groove, at most
    /// [`ScrewRow::largest_deviation`].
    pub screw_deviation: &'static DeviationMap,
    /// Deviation of the contact angles along the nut's groove, from the start of the loaded track, at
    /// most [`ScrewRow::largest_deviation`].
    pub nut_deviation: &'static DeviationMap,
    /// Load of a ball over the mean load, in equal parts of the loaded track from its start; 1 to 256 for each sign of
    /// the load, as many for both.
    pub load_shares: LoadShares,
    /// Nut speed over which friction changes its direction, rad/s, 1e-6 to 1e3: at this speed it has
    /// 71 % of its full value.
    pub reversal_speed: f32,
    /// Time between two ticks, s, 1e-6 to 1; at the largest nut speed the balls may move by 3 % of the
    /// track in it, and the screw by half a period of its deviation map.
    ///
    /// That is not all it needs: a tick renews one of the `N` balls, and they follow as long as the nut turns by no more than
    /// 0.12 rad in `N + 1` ticks, `N + 2` where a ball passes the return. With 37 balls that is 3 rad/s at 1 ms and 60 rad/s at 50 us; beyond,
    /// [`Faults::BEYOND_MODEL`](crate::Faults::BEYOND_MODEL) stands, after three such rounds until the balls have passed the return.
    pub tick: f32,
    /// Bounds that are kept whatever comes in.
    pub limits: Limits,
}

impl UncagedBallScrewConfiguration {
    /// The circuit's part, checked and folded for so many balls that move against the nut with `speed`, m per unit of
    /// nut speed.
    pub(super) const fn circuit(
        &self,
        speed: f32,
        limits: &Limits,
        balls: usize,
    ) -> Result<Circuit, Error> {
        let Self {
            ref design,
            turns,
            return_length,
            tick,
            ..
        } = *self;
        attempt!(in_range("turns", turns, 0.1, 100.0));
        attempt!(in_range("return_length", return_length, 0.0, 10.0));
        attempt!(in_range("tick", tick, 1e-6, 1.0));
        let path = design.path_radius();
        let per_turn = TAU * path;
        let loaded_length = self.loaded_length();
        let longest = LONGEST_TRACK * per_turn - loaded_length;
        attempt!(in_range("return_length", return_length, 0.0, longest));
        CircuitConfiguration {
            loaded_length,
            loaded_turns: turns,
            return_length,
            turn_length: per_turn,
            pitch: 2.0 * path * arc_sine(design.ball_radius() / path),
            travel_per_motion: speed,
            motion_per_turn: TAU,
            passing_deviation: self.screw_deviation,
            recirculating_deviation: self.nut_deviation,
            load_shares: self.load_shares,
            tick,
            largest_speed: limits.nut_speed,
        }
        .folded(balls)
    }

    /// Length of the loaded track, m.
    pub(super) const fn loaded_length(&self) -> f32 {
        self.turns * (TAU * self.design.path_radius())
    }

    /// Checks the deviations of both grooves: each within what the row's formula takes, and both so small that no ball's speed
    /// deviates by more than [`LARGEST_FREE_SPEED`] of the balls' `speed` against the nut, m per unit of nut speed.
    ///
    /// Gives the largest deviation of a ball's speed over that speed, with room for what elastic contacts add.
    pub(super) const fn check_deviations(&self, row: &ScrewRow, speed: f32) -> Result<f32, Error> {
        let largest = row.largest_deviation();
        let on_screw = attempt!(self.screw_deviation.checked("screw_deviation", largest));
        let in_nut = attempt!(self.nut_deviation.checked("nut_deviation", largest));
        // Where balls hardly move against the nut, a small deviation of their speed is large beside their speed
        // against it.
        let relative = row.fastest_deviation(on_screw, in_nut) / speed;
        if relative > LARGEST_FREE_SPEED {
            let part = LARGEST_FREE_SPEED / relative;
            attempt!(in_range("screw_deviation", on_screw, 0.0, on_screw * part));
            attempt!(in_range("nut_deviation", in_nut, 0.0, in_nut * part));
        }
        let fastest = ELASTIC_ROOM.0 * relative + ELASTIC_ROOM.1;
        Ok(if fastest < LARGEST_FREE_SPEED {
            fastest
        } else {
            LARGEST_FREE_SPEED
        })
    }
}
