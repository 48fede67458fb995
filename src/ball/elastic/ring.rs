//! Balls of a ball screw that are renewed in turn, and what each of them would do on its own until its turn comes.

mod changes;
mod chosen;
mod stored;

use self::chosen::{
    FAR, FIRST_LOAD, FIRST_RENEWALS, HELD, HELD_GROWTH, LOAD_JUMP, LOAD_STEP, LONGEST_ROUND,
    SETTLING_ROUNDS, SMALLEST_LOAD, STIFFER,
};
use super::law::{Neighbours, RingBall, RingConstants, RingLoad, between, growth};
use super::renewal::{BallInputs, Settled};
use crate::ball::preload::preload_counted;
use crate::train::LARGEST_FREE_SPEED;

/// Balls that are renewed in turn.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct Ring<const N: usize> {
    pub(crate) balls: [RingBall; N],
    /// A ball without deviations under the mean load: what balls without load follow.
    nominal: RingBall,
    /// Place and motion with which balls begin anew.
    fresh: Settled,
    pub(crate) friction: f32,
    /// Mean of the friction coefficients with which the balls were renewed last.
    renewed_friction: f32,
    /// Radial gap of every contact at the centred ball, m.
    pub(crate) clearance: f32,
    /// Friction coefficient and clearance, m, as they were when the round began, or after a jump.
    followed: (f32, f32),
    /// Contact force at which a preloaded ball loses its unloaded diagonal, N: `2 sqrt(2)` times the preload; 0 without.
    lift_off: f32,
    /// Load, preload counted, that the balls are settled for, N.
    settled_load: f32,
    /// Angle of the nut in this round, rad.
    round: f32,
    /// Balls still to begin anew.
    stale: u16,
    /// Renewals until all balls count as settled.
    settling: u16,
    /// Ball whose turn is next; the nominal one comes last, with the number of balls.
    next: u8,
    /// Balls that came under load and wait for their first renewal, as a ball's index and one; 0 is none.
    entered: u8,
    /// Balls in two contacts, in this round.
    two_point: u8,
    /// Balls whose place is uncertain because the model was out of range for more than `SETTLING_ROUNDS`; each leaves the
    /// count when it next comes under load.
    astray: u8,
    /// Rounds up to the last one, without a break, in which balls went beyond the model.
    rounds_beyond: u8,
    backward: bool,
    negative: bool,
    /// Whether a tick has said how the nut turns and what the load is.
    begun: bool,
}

impl<const N: usize> Ring<N> {
    /// Nominal balls, under a load.
    pub(crate) fn new(constants: &RingConstants, friction: f32, clearance: f32) -> Self {
        let inputs = BallInputs::alone(FIRST_LOAD, friction, clearance);
        let mut fresh = constants.ball.grooves.start(&inputs);
        let mut ball = RingBall {
            place: fresh.place,
            turning: fresh.turning,
            free: 0.0,
            impedance: 1.0,
            torque: 0.0,
        };
        let lift_off = constants.ball.lift_off(clearance);
        let load = RingLoad::new(constants, FIRST_LOAD, lift_off);
        for _ in 0..FIRST_RENEWALS {
            let found = constants.ball.grooves.renew(&mut fresh, &inputs);
            if found.lost {
                fresh = constants.ball.grooves.start(&inputs);
                continue;
            }
            ball.keep(constants, &load, &fresh, &found, 0.0, LARGEST_FREE_SPEED);
        }
        Self {
            balls: [ball; N],
            nominal: ball,
            fresh,
            friction,
            renewed_friction: friction,
            clearance,
            followed: (friction, clearance),
            lift_off,
            settled_load: FIRST_LOAD,
            round: 0.0,
            stale: N as u16,
            settling: SETTLING_ROUNDS * N as u16,
            next: 0,
            entered: 0,
            two_point: 0,
            astray: 0,
            rounds_beyond: 0,
            backward: false,
            negative: false,
            begun: false,
        }
    }

    /// Mean axial load of a ball, N, with its preload counted: see [`preload_counted`].
    #[inline(always)]
    pub(crate) fn preload_counted(&self, constants: &RingConstants, load: &RingLoad) -> f32 {
        preload_counted(load.axial, self.lift_off / constants.ball.normal)
    }

    /// Speed of a ball without load less the nominal one, over the nominal one against the nut.
    #[inline(always)]
    pub(crate) const fn idle(&self) -> f32 {
        self.nominal.free
    }

    /// Whether forces between balls are those of balls that still settle.
    pub(crate) const fn settles(&self) -> bool {
        self.settling > 0
    }

    /// Whether friction is known less well than promised. Balls stand in two contacts, of which one sticks; or the nut turns so
    /// far in a round that balls leave their laws before they are renewed; or one of these held for more than
    /// `SETTLING_ROUNDS`, and some ball has not passed the return since. Speeds that were wrong add up to wrong gaps between
    /// balls, and a ball's gap begins anew where it comes under load.
    pub(crate) const fn beyond_model(&self) -> bool {
        self.leaves_model() || self.rounds_beyond > 0 || self.astray > 0
    }

    /// Whether balls go beyond the model in this round.
    const fn leaves_model(&self) -> bool {
        self.two_point > 0 || self.round.abs() > LONGEST_ROUND
    }

    /// -1 where the nut turns backward, else 1.
    #[inline(always)]
    pub(crate) const fn way(&self) -> f32 {
        if self.backward { -1.0 } else { 1.0 }
    }

    /// Turns to the speed and the mean axial load of a ball in a tick: balls begin anew where it jumps.
    /// Gives the load, and whether they did.
    #[inline(always)]
    pub(crate) fn turn_to(
        &mut self,
        constants: &RingConstants,
        nut_speed: f32,
        axial_load: f32,
    ) -> (RingLoad, bool) {
        let backward = if nut_speed == 0.0 {
            self.backward
        } else {
            nut_speed < 0.0
        };
        let size = axial_load.abs();
        let negative = if size > SMALLEST_LOAD {
            axial_load < 0.0
        } else {
            self.negative
        };
        let size = if size > SMALLEST_LOAD {
            size
        } else {
            SMALLEST_LOAD
        };
        let axial = if backward == negative { size } else { -size };
        let load = RingLoad::new(constants, axial, self.lift_off);
        let whole = load.whole;
        let reversed = backward != self.backward;
        let crossed = negative != self.negative;
        let held = constants.ball.normal * size < HELD * whole && !reversed;
        let jumped = whole > LOAD_JUMP * self.settled_load || LOAD_JUMP * whole < self.settled_load;
        let anew = (reversed || crossed) && !held || jumped;
        let anew = anew || !self.begun;
        if anew {
            self.begin_anew(constants, axial, self.begun && crossed && !held);
            self.begun = true;
            self.settled_load = whole;
        }
        let old = self.settled_load;
        if whole > LOAD_STEP * old || LOAD_STEP * whole < old {
            self.settling = SETTLING_ROUNDS * N as u16;
        }
        self.backward = backward;
        self.negative = negative;
        (load, anew)
    }

    #[cold]
    #[inline(never)]
    fn begin_anew(&mut self, constants: &RingConstants, axial_load: f32, mirrored: bool) {
        self.fresh = constants.ball.grooves.start(&BallInputs::alone(
            axial_load,
            self.friction,
            self.clearance,
        ));
        if mirrored {
            for ball in &mut self.balls {
                ball.free = -ball.free;
            }
        }
        self.stale = N as u16;
        self.settling = SETTLING_ROUNDS * N as u16;
        // Balls that come under load after a reversal went out of it before.
        if self.astray > 0 {
            self.astray = N as u8;
        }
    }

    /// The ball whose turn it is.
    #[inline(always)]
    pub(crate) fn next(&mut self) -> usize {
        let entered = usize::from(self.entered);
        if entered > 0 {
            self.entered = 0;
            self.astray = self.astray.saturating_sub(1);
            return entered - 1;
        }
        let next = usize::from(self.next);
        if next < N {
            self.next += 1;
        } else {
            self.end_round();
        }
        next
    }

    #[inline(never)]
    fn end_round(&mut self) {
        self.next = 0;
        self.rounds_beyond = if self.leaves_model() {
            self.rounds_beyond.saturating_add(1)
        } else {
            0
        };
        if self.rounds_beyond > SETTLING_ROUNDS as u8 {
            self.astray = N as u8;
        }
        self.round = 0.0;
        self.two_point = 0;
        self.follow_changes();
    }

    /// Renews a ball under its share of the load, its deviations and the force of its neighbours, in the forward frame.
    #[inline(always)]
    pub(crate) fn renew(
        &mut self,
        constants: &RingConstants,
        load: &RingLoad,
        index: usize,
        (screw_deviation, nut_deviation): (f32, f32),
        share: f32,
        neighbours: &Neighbours,
    ) {
        let force = neighbours.force();
        let is_nominal = index >= N;
        let fastest = self.fastest(constants, is_nominal);
        let ball = self.balls.get_mut(index).unwrap_or(&mut self.nominal);
        self.settling = self.settling.saturating_sub(1);
        let (place, turning) = if self.stale > 0 {
            self.stale -= 1;
            (self.fresh.place, self.fresh.turning)
        } else {
            (ball.place, ball.turning)
        };
        if !ball.loaded() {
            return;
        }
        let pushed = force / (ball.impedance * load.two_thirds);
        let mut settled = Settled {
            place,
            turning,
            speed: constants.nominal + constants.reference * (ball.free + pushed),
        };
        let inputs = BallInputs {
            axial_load: load.axial * share,
            force,
            rubbing: neighbours.rubbing(),
            screw_deviation,
            nut_deviation,
            friction: self.friction,
            clearance: self.clearance,
        };
        let found = constants.ball.grooves.renew(&mut settled, &inputs);
        self.two_point = self.two_point.saturating_add(u8::from(found.two_point()));
        let wanted = inputs.axial_load;
        if found.lost || is_far(self.lift_off, found.carried, wanted) {
            let Settled { place, turning, .. } = constants.ball.grooves.start(&inputs);
            (ball.place, ball.turning) = (place, turning);
            return;
        }
        // The power of a step that is cut short is many times too large: where balls were settled the last one counts, and
        // they settle once more.
        let torque = ball.torque;
        ball.keep(constants, load, &settled, &found, force, fastest);
        ball.torque *= grown(constants, self.lift_off, found.carried, wanted);
        if found.taken < 1.0 {
            if self.settling == 0 {
                ball.torque = torque;
            }
            self.settle_a_round();
        }
        self.limit_impedance(index);
    }

    /// Largest speed of a ball without load less the nominal one, over the nominal one against the nut: play turns the
    /// contacts of all balls; how far a ball deviates is known for a screw without.
    #[inline(always)]
    fn fastest(&self, constants: &RingConstants, is_nominal: bool) -> f32 {
        if is_nominal {
            return LARGEST_FREE_SPEED;
        }
        between(
            constants.fastest + self.nominal.free.abs(),
            0.0,
            LARGEST_FREE_SPEED,
        )
    }

    /// A ball is stiffer than a nominal one by a factor at most.
    #[inline(always)]
    fn limit_impedance(&mut self, index: usize) {
        let nominal = self.nominal.impedance;
        if let Some(ball) = self.balls.get_mut(index) {
            ball.impedance = between(ball.impedance, nominal * (1.0 / STIFFER), nominal * STIFFER);
        }
    }

    /// Balls settle for a round at the least.
    #[inline(always)]
    const fn settle_a_round(&mut self) {
        let round = N as u16;
        self.settling = if self.settling < round {
            round
        } else {
            self.settling
        };
    }

    /// The load for which balls are renewed, once a round is over.
    #[inline(always)]
    pub(crate) fn advance(&mut self, angle: f32, load: &RingLoad) {
        self.round += angle;
        if self.next == 0 {
            self.settled_load = load.whole;
        }
    }

    /// Whether the balls behind and ahead carry load.
    #[inline(always)]
    pub(crate) fn loaded_beside(&self, index: usize) -> [bool; 2] {
        Self::beside(index).map(|place| self.balls.get(place).is_some_and(RingBall::loaded))
    }

    /// The places behind and ahead of a ball.
    #[inline(always)]
    const fn beside(index: usize) -> [usize; 2] {
        let behind = index.wrapping_sub(1);
        [
            if behind < N { behind } else { N - 1 },
            if index + 1 < N { index + 1 } else { 0 },
        ]
    }

    /// Marks a ball as loaded that was not: it takes over what its neighbour does, or the nominal one where no neighbour carries load.
    #[inline(always)]
    pub(crate) fn enter(&mut self, index: usize) {
        let neighbour = Self::beside(index)
            .into_iter()
            .filter_map(|place| self.balls.get(place))
            .find(|ball| ball.loaded());
        let like = *neighbour.unwrap_or(&self.nominal);
        if let Some(ball) = self.balls.get_mut(index) {
            *ball = like;
            self.entered = index as u8 + 1;
        }
    }
}

/// Whether a ball without preload carried far more, or far less, than it should: Newton's method comes from there in many steps, a
/// start in a few.
#[inline(always)]
fn is_far(lift_off: f32, carried: f32, wanted: f32) -> bool {
    let (carried, wanted) = (carried.abs(), wanted.abs());
    lift_off == 0.0 && (carried > FAR * wanted || FAR * carried < wanted)
}

/// Growth of the torque that a renewal found, that of the load which the contacts carried before it, to the load that the ball
/// should carry; 1 where a preload holds a ball far from its balance.
#[inline(always)]
fn grown(constants: &RingConstants, lift_off: f32, carried: f32, wanted: f32) -> f32 {
    let grown = growth(constants, lift_off, carried, wanted);
    if lift_off == 0.0 || grown < HELD_GROWTH && HELD_GROWTH * grown > 1.0 {
        grown
    } else {
        1.0
    }
}
