//! Friction of the contacts of balls that are alike: a law over the load, or a ball that is renewed in every tick.

mod stored;

use core::f32::consts::TAU;

use super::CagedBallScrewConfiguration;
use super::coefficients::CoefficientLaws;
use super::full::CagedFull;
use super::recent::{CagedRecent, Found};
use crate::ball::Clearance;
use crate::ball::elastic::constants::BallConstants;
use crate::ball::elastic::load_law::{LoadLaw, LoadRange};
use crate::ball::elastic::nominal::{Grooving, NominalBall, SMALLEST_LOAD};
use crate::error::{Error, attempt};
use crate::law::coefficient::DirectionalCoefficient;
use crate::ranges;
use crate::scene::contract::{Inputs, Regime};
use crate::scene::faults::Faults;
use crate::scene::outputs::{Outputs, efficiency};
use crate::scene::passage::{Passage, way};

/// Axial load of a ball, N, for which balls are settled before the first tick.
const FIRST_LOAD: f32 = 50.0;

/// Ticks of which one renews the ball of the other direction.
const OTHER_TURN: u8 = 4;

/// Constants of the contacts' friction.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Contacts {
    ball: BallConstants,
    friction: f32,
    clearance: Clearance,
    range: LoadRange,
    balls: f32,
    per_ball: f32,
    /// Axial load of all balls over the contact force of one.
    load_per_whole: f32,
    /// Torque per axial load without friction, `lead / 2 pi`, m.
    reduced_lead: f32,
}

/// What a tick reads and changes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct ContactsState {
    /// Law of a load that opposes the motion, and of one that assists it; for the configuration's friction and clearance.
    laws: [LoadLaw; 2],
    /// A ball of each, for those that are set while running.
    balls: [NominalBall; 2],
    grooving: Grooving,
    /// Whether friction or clearance have been set.
    changes: bool,
    turn: u8,
}

impl Contacts {
    /// Checks what the contacts' friction reads of a configuration, and folds it.
    ///
    /// # Errors
    /// [`Error`] naming the field out of range.
    pub(super) const fn new(configuration: &CagedBallScrewConfiguration) -> Result<Self, Error> {
        let CagedBallScrewConfiguration {
            ref design,
            friction,
            rolling_resistance,
            clearance,
            loaded_balls,
            limits,
            ..
        } = *configuration;
        let balls = loaded_balls as f32;
        Ok(Self {
            friction: attempt!(ranges::FRICTION_OF_A_ROW.checked("friction", friction)),
            clearance: attempt!(clearance.checked(design)),
            ball: attempt!(BallConstants::new(design, rolling_resistance)),
            range: LoadRange::to(limits.axial_load / balls),
            balls,
            per_ball: 1.0 / balls,
            load_per_whole: balls * (design.contact_angle().sin * design.cos_lead_angle()),
            reduced_lead: design.lead() / TAU,
        })
    }

    /// Laws for friction coefficients between these two: none where they are that of the configuration.
    pub(super) fn laws_between(&self, least: f32, largest: f32) -> Option<CoefficientLaws> {
        let gap = self.clearance.gap();
        CoefficientLaws::new(&self.ball, gap, self.range, self.friction, (least, largest))
    }

    /// Laws and balls before the first tick: some thousand renewals.
    pub(super) fn initial_state(&self) -> ContactsState {
        let grooving = Grooving::new(&self.ball, self.friction, self.clearance.gap());
        let nominal = |side| NominalBall::new(&self.ball, &grooving, side * FIRST_LOAD, 0.0);
        let mut state = ContactsState {
            laws: [LoadLaw::NONE; 2],
            balls: [nominal(1.0), nominal(-1.0)],
            grooving,
            changes: false,
            turn: 0,
        };
        for (law, side) in state.laws.iter_mut().zip([1.0, -1.0]) {
            law.fold(&self.ball, &grooving, self.range, side);
        }
        state
    }

    /// Back to the state before the first tick: the laws are as they were.
    pub(super) fn reset(&self, state: &mut ContactsState) {
        state.grooving = Grooving::new(&self.ball, self.friction, self.clearance.gap());
        state.changes = false;
    }

    /// Friction of both directions before the first tick of a scene with memory.
    pub(super) fn recent(&self, state: &ContactsState) -> CagedRecent {
        let [drive, backdrive] = &state.laws;
        CagedRecent::of([drive, backdrive].map(|law| {
            let (ratio, beyond) = law.found(self.range, FIRST_LOAD);
            Found { ratio, beyond }
        }))
    }

    /// Balls go on with the friction coefficient and the clearance of these constants, renewed in every tick: the laws are those
    /// of other constants.
    pub(super) fn take_over(&self, state: &mut ContactsState) {
        state.grooving = Grooving::new(&self.ball, self.friction, self.clearance.gap());
        self.change(state);
    }

    /// See [`FrictionModel::set_friction`](crate::FrictionModel::set_friction).
    pub(super) fn set_friction(
        &self,
        state: &mut ContactsState,
        friction: f32,
    ) -> Result<(), Error> {
        state.grooving.friction = ranges::FRICTION_OF_A_ROW.checked("friction", friction)?;
        self.change(state);
        Ok(())
    }

    /// See [`FrictionModel::set_clearance`](crate::FrictionModel::set_clearance).
    pub(super) fn set_clearance(
        &self,
        state: &mut ContactsState,
        clearance: Clearance,
    ) -> Result<(), Error> {
        let clearance = self.ball.checked(clearance)?;
        let friction = state.grooving.friction;
        state.grooving = Grooving::new(&self.ball, friction, clearance.gap());
        self.change(state);
        Ok(())
    }

    /// Turns from the laws to balls.
    fn change(&self, state: &mut ContactsState) {
        if !state.changes {
            state.changes = true;
            for ((ball, law), side) in state.balls.iter_mut().zip(&state.laws).zip([1.0, -1.0]) {
                let load = side * FIRST_LOAD;
                *ball = NominalBall::new(
                    &self.ball,
                    &state.grooving,
                    load,
                    law.at(self.range, FIRST_LOAD).0,
                );
            }
        }
    }

    /// Axial load of a ball and its contact force with that of a preload, N, and whether the load assists the motion.
    #[inline(always)]
    fn under(&self, state: &ContactsState, axial_load: f32, way: f32) -> (f32, f32, bool) {
        let opposing = way * axial_load;
        let load = opposing.abs() * self.per_ball;
        let whole = state.grooving.whole(&self.ball, load);
        (load, whole, opposing < 0.0)
    }

    /// Full friction in the direction of motion, which stands for both.
    #[inline(always)]
    pub(super) fn one_way(&self, state: &mut ContactsState, inputs: Inputs, way: f32) -> CagedFull {
        let (load, whole, other) = self.under(state, inputs.axial_load, way);
        let (ratio, accuracy) = if state.changes {
            self.renewed(state, load, whole, other)
        } else {
            state.folded(self.range, load, other)
        };
        let full = self.balls * (whole * ratio);
        CagedFull {
            forward: full,
            backward: full,
            load: whole * self.load_per_whole,
            faults: accuracy,
        }
    }

    /// Full friction in both directions, with a friction coefficient.
    #[inline(always)]
    pub(super) fn both_ways(
        &self,
        state: &mut ContactsState,
        recent: &mut CagedRecent,
        laws: Option<&CoefficientLaws>,
        inputs: Inputs,
        friction: DirectionalCoefficient,
    ) -> CagedFull {
        let way = way(inputs.nut_speed);
        let (load, whole, other) = self.under(state, inputs.axial_load, way);
        let (own_friction, opposite_friction) = friction.of(way);
        let (own, opposite, accuracy) = if state.changes {
            state.grooving.friction = own_friction;
            let (own, accuracy) = self.renewed(state, load, whole, other);
            let [drive, backdrive] = &state.balls;
            let opposite = if other { drive } else { backdrive };
            (own, opposite.ratio(), accuracy)
        } else {
            let turned = recent.turned();
            let looked_up = other != turned;
            let friction = if turned {
                opposite_friction
            } else {
                own_friction
            };
            let found = self.between(state, laws, load, looked_up, friction);
            let [drive, backdrive] = &mut recent.found;
            *(if looked_up {
                &mut *backdrive
            } else {
                &mut *drive
            }) = found;
            let (own, opposite) = if other {
                (*backdrive, *drive)
            } else {
                (*drive, *backdrive)
            };
            let beyond = Faults::NONE.with(own.beyond, Faults::BEYOND_MODEL);
            (own.ratio, opposite.ratio, beyond)
        };
        let (forward, backward) = if way < 0.0 {
            (opposite, own)
        } else {
            (own, opposite)
        };
        CagedFull {
            forward: self.balls * (whole * forward),
            backward: self.balls * (whole * backward),
            load: whole * self.load_per_whole,
            faults: accuracy,
        }
    }

    /// Friction torque over contact force by the laws, for a friction coefficient.
    #[inline(always)]
    fn between(
        &self,
        state: &ContactsState,
        laws: Option<&CoefficientLaws>,
        load: f32,
        other: bool,
        friction: f32,
    ) -> Found {
        let [drive, backdrive] = &state.laws;
        let law = if other { backdrive } else { drive };
        let (first, beyond) = law.at(self.range, load);
        match laws {
            Some(laws) => {
                let (ratio, more) = laws.at(self.range, load, other, friction, first);
                Found {
                    ratio,
                    beyond: beyond || more,
                }
            }
            None => Found {
                ratio: first * (friction / self.friction),
                beyond,
            },
        }
    }

    /// Full friction times its passage: zero at standstill, odd under reversal of speed and load together, and never of the
    /// sign that would make friction a source of power.
    #[inline(always)]
    pub(super) fn passed(&self, axial_load: f32, found: &CagedFull, passage: Passage) -> Outputs {
        let full = found.of(passage.way);
        let load_work = passage.way * axial_load * self.reduced_lead;
        Outputs {
            friction_torque: passage.share * found.of(passage.share),
            load_torque: axial_load * self.reduced_lead,
            efficiency: efficiency(load_work > 0.0, load_work, full),
            regime: Regime::under(passage.standing, load_work, full),
            faults: found.faults,
        }
    }

    /// Friction torque over contact force of a ball that is renewed for this tick, and what it is worth.
    ///
    /// A function of its own, so that a step by the law needs none of its stack.
    #[inline(never)]
    fn renewed(
        &self,
        state: &mut ContactsState,
        load: f32,
        whole: f32,
        other: bool,
    ) -> (f32, Faults) {
        let size = if load > SMALLEST_LOAD {
            load
        } else {
            SMALLEST_LOAD
        };
        let axial = if other { -size } else { size };
        state.turn = state.turn.wrapping_add(1) % OTHER_TURN;
        let turned = state.turn == 0;
        let [drive, backdrive] = &mut state.balls;
        let (own, opposite) = if other {
            (backdrive, drive)
        } else {
            (drive, backdrive)
        };
        let far = own.is_far(whole);
        if far || turned && opposite.is_far(whole) {
            let [drive, backdrive] = &state.laws;
            let (ball, law, axial) = match (far, other) {
                (true, true) => (&mut *own, backdrive, axial),
                (true, false) => (&mut *own, drive, axial),
                (false, true) => (opposite, drive, -axial),
                (false, false) => (opposite, backdrive, -axial),
            };
            // The law is that of another friction coefficient; it is about in proportion.
            let ratio = law.at(self.range, size).0 * (state.grooving.friction / self.friction);
            *ball = NominalBall::new(&self.ball, &state.grooving, axial, ratio);
        } else if turned {
            opposite.renew(&self.ball, &state.grooving, -axial);
        } else {
            own.renew(&self.ball, &state.grooving, axial);
        }
        let faults = Faults::NONE
            .with(own.settles(), Faults::SETTLING)
            .with(own.in_two_points(), Faults::BEYOND_MODEL);
        (own.ratio(), faults)
    }
}

impl ContactsState {
    /// Friction torque over contact force by the law of this direction, and what it is worth.
    #[inline(always)]
    fn folded(&self, range: LoadRange, load: f32, other: bool) -> (f32, Faults) {
        let [drive, backdrive] = &self.laws;
        let law = if other { backdrive } else { drive };
        let (ratio, beyond) = law.at(range, load);
        (ratio, Faults::NONE.with(beyond, Faults::BEYOND_MODEL))
    }
}
