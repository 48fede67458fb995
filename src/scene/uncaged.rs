//! A ball screw without cage: its balls press on each other.

mod configuration;
mod sliding;
mod stored;

use core::f32::consts::TAU;

use super::changing::{ChangingClearance, ChangingFriction};
use super::circuit::{Circuit, CircuitState, UNLOADED, per_loaded_ball};
use super::contract::{Admitted, Inputs, Limits, Scene};
use super::faults::Faults;
use super::outputs::UncagedOutputs;
use super::passage::Reversal;
use super::pressed::UncagedFull;
use super::row::RowFull;
use crate::ball::elastic::constants::BallConstants;
use crate::ball::elastic::law::{Neighbour, Neighbours, RingConstants, RingLoad};
use crate::ball::elastic::ring::Ring;
use crate::ball::{Clearance, GrooveFit, LoadShare, ScrewRow};
use crate::error::{Error, attempt};
use crate::ranges;

pub use configuration::UncagedBallScrewConfiguration;

/// Balls that are renewed in a tick: each renewal takes up to 5,600 cycles of a Cortex-M4F, beside 4,500 of the row of 37. With
/// one, a ball's turn comes every `N + 1` ticks, and speeds are right as long as the nut turns by no more than 0.12 rad in them.
const RENEWALS: u8 = 1;

/// A ball screw without cage, with `N` balls in one circuit: friction of the grooves and between balls.
///
/// A tick whose speed or load is no number is flagged in that tick, puts out no torque, and leaves the state as
/// it is; the next sound tick is unflagged. Balls, and the phase of the screw's deviations, then stand behind by
/// the travel of the missed ticks, and friction is that of this position: sound, but that of an earlier angle.
/// [`FrictionModel::set_nut_angle`](crate::FrictionModel::set_nut_angle) brings the phase back; the balls, whose places no sensor knows, stay behind.
///
/// [`Faults::BEYOND_MODEL`] stands while balls are in two contacts, or the nut turns by more than 0.12 rad in a round of `N + 1`
/// ticks. Where that lasts for more than three rounds, gaps between balls are no longer known: the flag then stands until every
/// ball has passed the return in one direction; in a circuit without a return (`return_length` 0) until the model is reset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct UncagedBallScrew<const N: usize>;

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
    /// Friction coefficient of ball and groove.
    friction: f32,
    /// Radial gap of every contact at the centred ball, m.
    clearance: f32,
    /// Time between two ticks, s, and 1 / it.
    tick: f32,
    per_tick: f32,
    /// Friction coefficient of ball and ball.
    ball_friction: f32,
    /// 1 / number of loaded balls, and their number.
    per_ball: f32,
    balls: f32,
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
    type Known = Inputs;
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

    fn take_over(
        constants: &UncagedConstants<N>,
        state: &mut UncagedState<N>,
    ) -> Result<(), Error> {
        state.circuit.is_on(&constants.circuit)?;
        let UncagedConstants {
            ring,
            friction,
            clearance,
            ..
        } = constants;
        state.ring.take_over(ring, *friction, *clearance);
        Ok(())
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
        let full = constants.full(state, inputs);
        full.passed(
            inputs.axial_load * constants.reduced_lead,
            constants.reversal.passage(inputs.nut_speed),
        )
    }

    #[inline(always)]
    fn largest_friction(constants: &UncagedConstants<N>) -> f32 {
        constants.limits.friction_torque
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
        let speed = design.path_radius() - row.nominal_speed();
        let fastest = attempt!(configuration.check_deviations(&row, speed));
        let per_ball = per_loaded_ball(configuration.loaded_length(), return_length, N);
        let ring = RingConstants::new(
            &attempt!(BallConstants::new(design, rolling_resistance)),
            fastest,
        );
        Ok(Self {
            ring,
            friction,
            clearance,
            tick: configuration.tick,
            per_tick: 1.0 / configuration.tick,
            circuit: attempt!(configuration.circuit(speed, &limits, N)),
            ball_friction,
            per_ball,
            balls: 1.0 / per_ball,
            reduced_lead: design.reduced_lead(),
            reversal,
            limits,
        })
    }

    #[inline(always)]
    fn full(&self, state: &mut UncagedState<N>, inputs: Inputs) -> UncagedFull {
        let Inputs {
            nut_speed,
            axial_load,
        } = inputs;
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

        let groove = load.torque(torque);
        let rubbing = if pressing.contacts > 0 {
            self.rubbing(state)
        } else {
            0.0
        };
        UncagedFull {
            row: RowFull {
                groove,
                ball: self.ball_friction * rubbing,
                ways: [1.0; 2],
                load: state.ring.preload_counted(&self.ring, &load) * self.balls,
                contacts: pressing.contacts,
                largest_contact_force: pressing.largest,
            },
            faults: faults(&state.ring),
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
        let ring = &mut state.ring;
        ring.renew(&self.ring, load, index, deviations, share, &neighbours);
    }

    /// Sum over all pairs of loaded balls of their force times the speed with which they rub (Lin 2019, eq. (3.73)), N m per unit of
    /// nut speed. A ball without load turns as its neighbour makes it.
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

    /// See [`FrictionModel::set_nut_angle`](crate::FrictionModel::set_nut_angle).
    pub(crate) fn set_nut_angle(&self, state: &mut UncagedState<N>, angle: f32) {
        state.circuit.set_turns(&self.circuit, angle / TAU);
    }
}

impl<const N: usize> ChangingFriction for UncagedBallScrew<N> {
    fn set_friction(
        constants: &UncagedConstants<N>,
        state: &mut UncagedState<N>,
        friction: f32,
    ) -> Result<(), Error> {
        let friction = ranges::FRICTION_OF_A_ROW.checked("friction", friction)?;
        let ring = &mut state.ring;
        ring.set(&constants.ring, friction, ring.clearance);
        Ok(())
    }
}

impl<const N: usize> ChangingClearance for UncagedBallScrew<N> {
    fn set_clearance(
        constants: &UncagedConstants<N>,
        state: &mut UncagedState<N>,
        clearance: Clearance,
    ) -> Result<(), Error> {
        let clearance = constants.ring.ball().checked(clearance)?.gap();
        let ring = &mut state.ring;
        ring.set(&constants.ring, ring.friction, clearance);
        Ok(())
    }
}

/// Accuracy flags of this tick.
#[inline(always)]
const fn faults<const N: usize>(ring: &Ring<N>) -> Faults {
    Faults::NONE
        .with(ring.settles(), Faults::SETTLING)
        .with(ring.beyond_model(), Faults::BEYOND_MODEL)
}
