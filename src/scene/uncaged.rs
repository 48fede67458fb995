//! A ball screw without cage: its balls press on each other.

use core::f32::consts::TAU;

use super::circuit::{
    Circuit, CircuitConfiguration, CircuitState, DeviationMap, LONGEST_TRACK, UNLOADED,
    per_loaded_ball,
};
use super::contract::{Admitted, Inputs, Limits, Regime, Reversal, Scene};
use super::faults::Faults;
use super::outputs::UncagedOutputs;
use crate::ball::elastic::constants::BallConstants;
use crate::ball::elastic::law::{Neighbour, Neighbours, RingConstants, RingLoad};
use crate::ball::elastic::ring::Ring;
use crate::ball::{Clearance, GrooveFit, LoadShare, LoadShares, ScrewRow};
use crate::contact::RollingResistance;
use crate::error::{Error, attempt, in_range};
use crate::geometry::BallScrew;
use crate::math::elliptic::arc_sine;
use crate::ranges;
use crate::train::LARGEST_FREE_SPEED;

/// Balls that are renewed in a tick.
const RENEWALS: u8 = 1;

/// Largest deviation of a ball's speed over the pitch circle's: a factor, and what is added.
const ELASTIC_ROOM: (f32, f32) = (1.5, 0.05);

/// A ball screw without cage, with `N` balls in one circuit: friction of the grooves and between balls.
///
/// A tick whose speed or load is no number is flagged in that tick, puts out no torque, and leaves the state as
/// it is; the next sound tick is unflagged. Balls, and the phase of the screw's deviations, then stand behind by
/// the travel of the missed ticks, and friction is that of this position: sound, but that of an earlier angle.
/// [`FrictionModel::set_nut_angle`](crate::FrictionModel::set_nut_angle) brings the phase back; the balls, whose places no sensor knows, stay behind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct UncagedBallScrew<const N: usize>;

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
    pub tick: f32,
    /// Bounds that are kept whatever comes in.
    pub limits: Limits,
}

/// What a tick changes in a ball screw without cage.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct UncagedState<const N: usize> {
    /// Where the balls are, and how they press.
    pub circuit: CircuitState<N>,
    ring: Ring<N>,
}

/// Constants of a ball screw without cage, with `N` balls.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct UncagedConstants<const N: usize> {
    ring: RingConstants,
    circuit: Circuit,
    friction: f32,
    /// Radial gap of every contact at the centred ball, m.
    clearance: f32,
    /// Time between two ticks, s.
    tick: f32,
    ball_friction: f32,
    /// 1 / number of loaded balls.
    per_ball: f32,
    /// Torque per axial load without friction, `lead / 2 pi`, m.
    reduced_lead: f32,
    reversal: Reversal,
    limits: Limits,
}

impl<const N: usize> Scene for UncagedBallScrew<N> {
    type Configuration = UncagedBallScrewConfiguration;
    type Constants = UncagedConstants<N>;
    type State = UncagedState<N>;
    type Inputs = Inputs;
    type Outputs = UncagedOutputs;

    fn constants(
        configuration: &UncagedBallScrewConfiguration,
    ) -> Result<UncagedConstants<N>, Error> {
        UncagedConstants::new(configuration)
    }

    fn initial_state(constants: &UncagedConstants<N>) -> UncagedState<N> {
        UncagedState {
            circuit: CircuitState::new(&constants.circuit),
            ring: Ring::new(&constants.ring, constants.friction, constants.clearance),
        }
    }

    #[inline(always)]
    fn admit(constants: &UncagedConstants<N>, inputs: Inputs) -> Admitted<Inputs> {
        constants.limits.admit(inputs)
    }

    #[inline(always)]
    fn outputs(
        constants: &UncagedConstants<N>,
        state: &mut UncagedState<N>,
        inputs: Inputs,
    ) -> UncagedOutputs {
        constants.outputs(state, inputs)
    }

    #[inline(always)]
    fn largest_friction(constants: &UncagedConstants<N>) -> f32 {
        constants.limits.friction_torque
    }
}

impl UncagedBallScrewConfiguration {
    /// The circuit's part, checked and folded for so many balls that move against the nut with `speed`, m per unit of
    /// nut speed.
    const fn circuit(&self, speed: f32, limits: &Limits, balls: usize) -> Result<Circuit, Error> {
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
        let path = design.pitch_radius() / design.cos_lead_angle();
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
    const fn loaded_length(&self) -> f32 {
        let path = self.design.pitch_radius() / self.design.cos_lead_angle();
        self.turns * (TAU * path)
    }

    /// Checks the deviations of both grooves: what the row's formula holds for, and what keeps every ball within
    /// [`LARGEST_FREE_SPEED`] of the balls' `speed` against the nut, m per unit of nut speed.
    ///
    /// Gives the largest deviation of a ball's speed over that, with room for what elastic contacts add to the pitch circle's.
    const fn check_deviations(&self, row: &ScrewRow, speed: f32) -> Result<f32, Error> {
        let largest = row.largest_deviation();
        let on_screw = attempt!(self.screw_deviation.checked("screw_deviation", largest));
        let in_nut = attempt!(self.nut_deviation.checked("nut_deviation", largest));
        // Where balls hardly move against the nut, deviations that are small against the pitch radius
        // are large against that.
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

impl<const N: usize> UncagedConstants<N> {
    /// Checks a configuration and folds its constants: at set-up, or in a constant when firmware is compiled (see
    /// [`FrictionModel`](crate::FrictionModel)).
    ///
    /// # Errors
    /// [`Error`] naming the field out of range.
    pub const fn new(configuration: &UncagedBallScrewConfiguration) -> Result<Self, Error> {
        let UncagedBallScrewConfiguration {
            ref design,
            friction,
            ball_friction,
            rolling_resistance,
            clearance,
            return_length,
            reversal_speed,
            limits,
            ..
        } = *configuration;
        attempt!(ranges::FRICTION_OF_A_ROW.checked("friction", friction));
        attempt!(ranges::FRICTION_OR_NONE.checked("ball_friction", ball_friction));
        let reversal = attempt!(Reversal::new(reversal_speed, 1e-6, 1e3));
        let limits = attempt!(limits.checked());
        let clearance = attempt!(clearance.checked(design)).gap();
        let row = attempt!(ScrewRow::new(design, friction, GrooveFit::Zero));
        let speed = design.pitch_radius() / design.cos_lead_angle() - row.nominal_speed();
        let fastest = attempt!(configuration.check_deviations(&row, speed));
        let ring = RingConstants::new(
            &attempt!(BallConstants::new(design, rolling_resistance)),
            fastest,
        );
        Ok(Self {
            ring,
            friction,
            clearance,
            tick: configuration.tick,
            circuit: attempt!(configuration.circuit(speed, &limits, N)),
            ball_friction,
            per_ball: per_loaded_ball(configuration.loaded_length(), return_length, N),
            reduced_lead: design.lead() / TAU,
            reversal,
            limits,
        })
    }

    #[inline(always)]
    fn outputs(&self, state: &mut UncagedState<N>, inputs: Inputs) -> UncagedOutputs {
        let Inputs {
            nut_speed,
            axial_load,
        } = inputs;
        let direction = self.reversal.direction(nut_speed);
        let mean = axial_load * self.per_ball;
        let (load, anew) = state.ring.turn_to(&self.ring, nut_speed, mean);
        let way = state.ring.way();
        if !anew {
            let shares = self.circuit.shares(axial_load < 0.0);
            for _ in 0..RENEWALS {
                self.renew_next(state, &load, way, shares);
            }
        }
        let angle = nut_speed * self.tick;
        let mut torque = 0.0;
        let mut entered = None;
        let UncagedState { circuit, ring } = state;
        let idle = way * ring.idle();
        let mut balls = circuit.train.intake(self.circuit.travel(nut_speed));
        let mut known = ring.balls.iter_mut().enumerate().rev();
        while let (Some(next), Some((index, ball))) = (balls.next_ball(), known.next()) {
            if !self.circuit.is_loaded(next.position()) {
                ball.leave();
                next.put(idle, UNLOADED);
            } else if ball.loaded() {
                torque += ball.torque();
                let speed = ball.free();
                next.put(way * speed, load.impedance(ball));
            } else {
                entered = Some(index);
                next.put(idle, UNLOADED);
            }
        }
        let pressing = balls.press();
        if let Some(index) = entered {
            ring.enter(index);
        }
        ring.advance(angle, &load);
        circuit.advance(&self.circuit, nut_speed);

        let groove_torque = direction * load.torque(torque);
        let rubbing = if pressing.contacts > 0 {
            self.rubbing(state)
        } else {
            0.0
        };
        let ball_torque = direction * (self.ball_friction * rubbing);
        let friction_torque = groove_torque + ball_torque;

        let load_torque = axial_load * self.reduced_lead;
        let opposing = if nut_speed < 0.0 {
            -load_torque
        } else {
            load_torque
        };
        UncagedOutputs {
            friction_torque,
            groove_torque,
            ball_torque,
            load_torque,
            contacts: pressing.contacts,
            largest_contact_force: pressing.largest,
            regime: Regime::under(
                self.reversal.stands(nut_speed),
                opposing,
                friction_torque.abs(),
            ),
            faults: Faults::NONE
                .with(state.ring.settles(), Faults::SETTLING)
                .with(state.ring.beyond_model(), Faults::BEYOND_MODEL),
        }
    }

    /// Renews the ball whose turn it is.
    #[inline(always)]
    fn renew_next(
        &self,
        state: &mut UncagedState<N>,
        load: &RingLoad,
        way: f32,
        shares: &'static [LoadShare],
    ) {
        let index = state.ring.next();
        let train = &state.circuit.train;
        let (passing, recirculating) = self.circuit.deviation_units();
        let (deviations, share, forces, beside) = if index < N {
            let position = train.position(index);
            let Some(place) = self.circuit.place(position, state.circuit.phase(), shares) else {
                return;
            };
            let deviations = (
                way * passing * place.passing,
                way * recirculating * place.recirculating,
            );
            (
                deviations,
                place.share.share(),
                train.forces_on(index),
                state.ring.loaded_beside(index),
            )
        } else {
            ((0.0, 0.0), 1.0, [0.0; 2], [false; 2])
        };
        let neighbour = |force, loaded| Neighbour {
            force,
            friction: if loaded {
                self.ball_friction * force
            } else {
                0.0
            },
        };
        let [first, second] = forces;
        let first = neighbour(first, beside[0]);
        let second = neighbour(second, beside[1]);
        let neighbours = if way < 0.0 {
            Neighbours {
                behind: second,
                ahead: first,
            }
        } else {
            Neighbours {
                behind: first,
                ahead: second,
            }
        };
        state
            .ring
            .renew(&self.ring, load, index, deviations, share, &neighbours);
    }

    /// Sum over all pairs of loaded balls of their force times the speed with which they rub, N m per unit of nut speed. A ball
    /// without load turns as its neighbour makes it.
    #[inline(always)]
    fn rubbing(&self, state: &UncagedState<N>) -> f32 {
        let mut sum = 0.0;
        let (mut force, mut behind) = (0.0, None);
        for (ahead, ball) in state.circuit.train.forces().zip(&state.ring.balls) {
            let speed = if ball.loaded() && force + ahead > 0.0 {
                Some(ball.rubbing(&self.ring))
            } else {
                None
            };
            if let (Some(behind), Some(speed)) = (behind, speed) {
                sum += force * (behind + speed);
            }
            (force, behind) = (ahead, speed);
        }
        // The last ball presses on the first one.
        let ball = state.ring.balls.first().filter(|ball| ball.loaded());
        if let (Some(behind), Some(ball)) = (behind, ball)
            && force > 0.0
        {
            sum += force * (behind + ball.rubbing(&self.ring));
        }
        sum
    }

    /// See [`FrictionModel::set_friction`](crate::FrictionModel::set_friction).
    pub(crate) fn set_friction(
        &self,
        state: &mut UncagedState<N>,
        friction: f32,
    ) -> Result<(), Error> {
        let friction = ranges::FRICTION_OF_A_ROW.checked("friction", friction)?;
        state.ring.set(&self.ring, friction, state.ring.clearance);
        Ok(())
    }

    /// See [`FrictionModel::set_clearance`](crate::FrictionModel::set_clearance).
    pub(crate) fn set_clearance(
        &self,
        state: &mut UncagedState<N>,
        clearance: Clearance,
    ) -> Result<(), Error> {
        let clearance = self.ring.ball().checked(clearance)?.gap();
        state.ring.set(&self.ring, state.ring.friction, clearance);
        Ok(())
    }

    /// See [`FrictionModel::set_nut_angle`](crate::FrictionModel::set_nut_angle).
    pub(crate) fn set_nut_angle(&self, state: &mut UncagedState<N>, angle: f32) {
        state.circuit.set_turns(&self.circuit, angle / TAU);
    }
}
