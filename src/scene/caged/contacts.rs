//! Friction of the contacts of balls that are alike: a law over the load, or a ball that is renewed in every tick.

mod stored;

use super::coefficients::CoefficientLaws;
use super::configuration::CagedBallScrewConfiguration;
use crate::ball::Clearance;
use crate::ball::elastic::constants::BallConstants;
use crate::ball::elastic::load_law::{Grooved, LoadLaws, LoadRange};
use crate::ball::elastic::nominal::{Grooving, NominalBall, SMALLEST_LOAD};
use crate::error::{Error, attempt};
use crate::law::coefficient::DirectionalCoefficient;
use crate::ranges;
use crate::scene::contract::{Inputs, Regime};
use crate::scene::faults::Faults;
use crate::scene::full::CagedFull;
use crate::scene::outputs::{Outputs, efficiency};
use crate::scene::passage::{Passage, way};

/// Axial load of a ball, N, for which balls are settled before the first tick: that of the comparisons with Lin 2019, in the
/// middle of 5 to 300 N. A ball begins anew where the load is another by a factor of three, so that little depends on it.
const FIRST_LOAD: f32 = 50.0;

/// Every fourth tick renews the ball of the opposite load direction, so that it is ready at a reversal.
///
/// A tick has one renewal either way: of four, three go to the ball whose friction is put out, which follows the load the
/// faster the more it gets.
const OTHER_TURN: u8 = 4;

/// Constants of the contacts' friction.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Contacts {
    ball: BallConstants,
    friction: f32,
    clearance: Clearance,
    /// Loads of a ball over which the laws reach.
    range: LoadRange,
    /// Number of loaded balls, and 1 over it.
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
    laws: LoadLaws<2>,
    /// A ball for each of these two loads: renewed in every tick once friction or clearance have been set while the model runs.
    balls: [NominalBall; 2],
    grooving: Grooving,
    /// Whether friction or clearance have been set.
    changes: bool,
    /// Whether the laws are those of constants that were there before.
    foreign: bool,
    /// Ticks since the opposite ball's turn, 0 to 3.
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
            load_per_whole: balls * design.axial_per_normal(),
            reduced_lead: design.reduced_lead(),
        })
    }

    /// Laws for friction coefficients between these two: none where they are that of the configuration.
    pub(super) fn laws_between(&self, least: f32, largest: f32) -> Option<CoefficientLaws> {
        let gap = self.clearance.gap();
        CoefficientLaws::new(&self.ball, gap, self.range, self.friction, (least, largest))
    }

    /// Laws and balls before the first tick: some thousand renewals.
    pub(super) fn initial_state(&self) -> ContactsState {
        let grooving = self.grooving();
        let mut state = ContactsState {
            laws: LoadLaws::NONE,
            balls: self.first_balls(&grooving, [0.0; 2]),
            grooving,
            changes: false,
            foreign: false,
            turn: 0,
        };
        let grooved = [1.0, -1.0].map(|side| Grooved { grooving, side });
        state.laws.fold(&self.ball, &grooved, self.range);
        state
    }

    /// Friction and fit of the configuration.
    fn grooving(&self) -> Grooving {
        Grooving::new(&self.ball, self.friction, self.clearance.gap())
    }

    /// Balls that have not settled, under a load that opposes the motion and under one that assists it.
    fn first_balls(&self, grooving: &Grooving, [drive, backdrive]: [f32; 2]) -> [NominalBall; 2] {
        let new = |load, ratio| NominalBall::new(&self.ball, grooving, load, ratio);
        [new(FIRST_LOAD, drive), new(-FIRST_LOAD, backdrive)]
    }

    /// Back to the state before the first tick. Laws are as they were; balls are renewed in their place where these are the laws of
    /// other constants.
    pub(super) fn reset(&self, state: &mut ContactsState) {
        state.grooving = self.grooving();
        state.balls = self.first_balls(&state.grooving, [0.0; 2]);
        state.turn = 0;
        state.changes = false;
        self.keep_out_foreign_laws(state);
    }

    /// Balls go on with the friction coefficient and the clearance of these constants, renewed in every tick: the laws are those
    /// of other constants.
    pub(super) fn take_over(&self, state: &mut ContactsState) {
        state.foreign = true;
        self.change(state, self.grooving());
        state.balls.iter_mut().for_each(NominalBall::unsettle);
    }

    /// Balls are renewed in the place of laws that are those of other constants.
    fn keep_out_foreign_laws(&self, state: &mut ContactsState) {
        if state.foreign && !state.changes {
            self.change(state, state.grooving);
        }
    }

    /// See [`FrictionModel::set_friction`](crate::FrictionModel::set_friction).
    pub(super) fn set_friction(
        &self,
        state: &mut ContactsState,
        friction: f32,
    ) -> Result<(), Error> {
        let friction = ranges::FRICTION_OF_A_ROW.checked("friction", friction)?;
        let mut grooving = state.grooving;
        grooving.friction = friction;
        self.change(state, grooving);
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
        let grooving = Grooving::new(&self.ball, friction, clearance.gap());
        self.change(state, grooving);
        Ok(())
    }

    /// From now on balls are renewed under this friction and fit, in the place of the laws.
    fn change(&self, state: &mut ContactsState, grooving: Grooving) {
        if !state.changes {
            state.changes = true;
            let ratios = state.laws.at(self.range, FIRST_LOAD).ratios();
            state.balls = self.first_balls(&grooving, ratios);
        } else if grooving.jumps_from(&state.grooving) {
            state.balls.iter_mut().for_each(NominalBall::unsettle);
        }
        state.grooving = grooving;
    }

    /// Axial load of a ball, N; its contact force `whole`, preload counted, N; whether the load assists the motion.
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
        let (load, whole, assists) = self.under(state, inputs.axial_load, way);
        let (ratio, accuracy) = if state.changes {
            self.renewed(state, load, assists)
        } else {
            state.folded(self.range, load, assists)
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
        laws: Option<&CoefficientLaws>,
        inputs: Inputs,
        friction: DirectionalCoefficient,
    ) -> CagedFull {
        let way = way(inputs.nut_speed);
        let (load, whole, assists) = self.under(state, inputs.axial_load, way);
        let (own_friction, opposite_friction) = friction.of(way);
        let (own, opposite, accuracy) = if state.changes {
            state.grooving.friction = own_friction;
            let (own, accuracy) = self.renewed(state, load, assists);
            let [drive, backdrive] = &state.balls;
            let opposite = if assists { drive } else { backdrive };
            // It is renewed under the coefficient of this direction; friction of another one is about in proportion.
            let opposite = opposite.ratio() * (opposite_friction / own_friction);
            (own, opposite, accuracy)
        } else {
            let friction = if assists {
                [opposite_friction, own_friction]
            } else {
                [own_friction, opposite_friction]
            };
            let ([drive, backdrive], beyond) = self.between(state, laws, load, friction);
            let [drive_beyond, backdrive_beyond] = beyond;
            let (own, opposite, beyond) = if assists {
                (backdrive, drive, backdrive_beyond)
            } else {
                (drive, backdrive, drive_beyond)
            };
            (
                own,
                opposite,
                Faults::NONE.with(beyond, Faults::BEYOND_MODEL),
            )
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

    /// Friction torque over contact force by the laws under a load that opposes the motion and under one that assists it, each
    /// for its friction coefficient. Beside them, whether each is beyond the model's accuracy.
    #[inline(always)]
    fn between(
        &self,
        state: &ContactsState,
        laws: Option<&CoefficientLaws>,
        load: f32,
        friction: [f32; 2],
    ) -> ([f32; 2], [bool; 2]) {
        let place = state.laws.at(self.range, load);
        let first = place.ratios();
        let beyond = [place.beyond(0), place.beyond(1)];
        if let Some(laws) = laws {
            let (ratios, more) = laws.at(self.range, load, friction, first);
            let [drive, backdrive] = beyond;
            let [more_drive, more_backdrive] = more;
            return (ratios, [drive || more_drive, backdrive || more_backdrive]);
        }
        // Friction of another coefficient is about in proportion.
        let [drive, backdrive] = first;
        let [opposed, assisted] = friction;
        let inverse = 1.0 / self.friction;
        (
            [
                drive * (opposed * inverse),
                backdrive * (assisted * inverse),
            ],
            beyond,
        )
    }

    /// Full friction times its passage: zero at standstill, odd under reversal of speed and load together, and never of the
    /// sign that would make friction a source of power.
    #[inline(always)]
    pub(super) fn passed(&self, axial_load: f32, found: &CagedFull, passage: Passage) -> Outputs {
        let full = found.of(passage.way);
        let opposing_torque = passage.way * axial_load * self.reduced_lead;
        Outputs {
            friction_torque: passage.share * found.of(passage.share),
            load_torque: axial_load * self.reduced_lead,
            efficiency: efficiency(opposing_torque > 0.0, opposing_torque, full),
            regime: Regime::under(passage.standing, opposing_torque, full),
            faults: found.faults,
        }
    }

    /// Friction torque over contact force, m, of a ball that is renewed for this tick, with its flags of accuracy. `assists`:
    /// whether the load assists the motion.
    ///
    /// A function of its own, so that a step by the law needs none of its stack.
    #[inline(never)]
    fn renewed(&self, state: &mut ContactsState, load: f32, assists: bool) -> (f32, Faults) {
        let size = if load > SMALLEST_LOAD {
            load
        } else {
            SMALLEST_LOAD
        };
        let whole = state.grooving.whole(&self.ball, size);
        let axial = if assists { -size } else { size };
        state.turn = state.turn.wrapping_add(1) % OTHER_TURN;
        let turned = state.turn == 0;
        let [drive, backdrive] = &mut state.balls;
        let (own, opposite) = if assists {
            (backdrive, drive)
        } else {
            (drive, backdrive)
        };
        let far = own.is_far(whole);
        own.meet(whole);
        if far || turned && opposite.is_far(whole) {
            let (ball, assists, axial) = if far {
                (&mut *own, assists, axial)
            } else {
                (opposite, !assists, -axial)
            };
            // The law is that of another friction coefficient; it is about in proportion.
            let (ratio, _) = state.laws.found(self.range, size, assists.into());
            let ratio = ratio * (state.grooving.friction / self.friction);
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
    /// Friction torque over contact force, m, by the law of this direction, with its flags of accuracy.
    #[inline(always)]
    fn folded(&self, range: LoadRange, load: f32, assists: bool) -> (f32, Faults) {
        let (ratio, beyond) = self.laws.found(range, load, assists.into());
        (ratio, Faults::NONE.with(beyond, Faults::BEYOND_MODEL))
    }
}
