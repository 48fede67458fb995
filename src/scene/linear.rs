//! A linear bearing with four-point contact and balls that press on each other.

mod configuration;
mod step;

use super::circuit::{Circuit, CircuitState};
use super::contract::{
    ChangingFriction, CheckedInputs, Reversal, ReversalState, Scene, SceneOutputs as _,
};
use super::contract::{Faults, bounded};
use super::outputs::{LinearOutputs, TrainFriction};
use super::sliding::{NO_DRAG, Sliding, SlidingFriction};
use super::stored::StoredScene;
use crate::ball::{AnalyticLinearBall, GrooveFriction};
use crate::error::{Error, Range, attempt};
use crate::law::coefficient::DirectionalCoefficient;
use crate::ranges;
use crate::stored::{Fingerprint, Port, Refusal, Stored};

pub use configuration::{LinearBearingConfiguration, LinearInputs, LinearLimits};
pub use step::LinearFriction;

/// A linear bearing without cage, with up to `N` balls in one circuit, in four-point contact: the published
/// closed form for every ball ([`AnalyticLinearBall`]), with its corrections.
///
/// Unflagged, with one groove that deviates by up to 3 degrees: the speed of a ball alone is within 7.5e-3 of `v/2` at
/// 100 N a ball, 1e-2 at 10 N and 1.5e-2 at 1 N, and the friction of balls that press on each other within 12 % from 30 N
/// on and 23 % at 10 N (too small: the closed form leaves out that a ball rubbed by its neighbours turns).
///
/// [`Faults::BEYOND_MODEL`](crate::Faults::BEYOND_MODEL) is set from the tick on in which the loads and the force between balls let some ball do so,
/// at the least favourable deviations of both maps. With the ball of Lin 2019, Table 3.3, under 100 N that is a side-force
/// ratio of 0.92 where grooves are straight, 0.87 where one deviates by 3 degrees; less with heavier balls, closer grooves and friction
/// between balls. The flag comes up to 0.03 of the ratio before a ball alone jumps, up to 0.1 before a row of pressing balls, and in no
/// tested case after. From there on the grooves' friction is that of two-point rolling, within 4 % of the friction before where grooves
/// are straight; forces between balls go on as before, and the friction of a row is within 40 % up to a ratio of 0.97.
///
/// After a step whose speed or load is NaN or infinite, balls and the phase of the rail's deviations lag by its travel:
/// [`FrictionModel::set_carriage_position`](crate::FrictionModel::set_carriage_position) brings the phase back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LinearBearingTrain<const N: usize>;

/// State of a linear bearing.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LinearState<const N: usize> {
    /// Where the balls are, and how they press under the configuration's friction coefficient.
    pub circuit: CircuitState<N>,
    /// Friction coefficient over that of the configuration.
    friction: f32,
}

/// Constants of a linear bearing with up to `N` balls.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LinearConstants<const N: usize> {
    circuit: Circuit,
    friction: f32,
    /// Time between two ticks, s, and 1 / it.
    tick: f32,
    per_tick: f32,
    ball: AnalyticLinearBall,
    /// Half the sum of both diagonals' forces of a ball over its normal load, `1/cos(beta)`.
    normal: f32,
    /// Half the difference of both diagonals' forces of a ball over its side load, `1/sin(beta)`.
    side: f32,
    grooves: GrooveFriction,
    /// Friction force of two balls over the force between them.
    rubbing: f32,
    /// Length that counts as one turn of the deviation maps, m.
    wavelength: f32,
    reversal: Reversal,
    limits: LinearLimits,
}

impl<const N: usize> Scene for LinearBearingTrain<N> {
    type Configuration = LinearBearingConfiguration;
    type Constants = LinearConstants<N>;
    type State = LinearState<N>;
    type Inputs = LinearInputs;
    type Outputs = LinearOutputs;

    fn constants(configuration: &Self::Configuration) -> Result<Self::Constants, Error> {
        LinearConstants::new(configuration)
    }

    #[inline(always)]
    fn initial_state(constants: &Self::Constants) -> Self::State {
        LinearState {
            circuit: CircuitState::new(&constants.circuit),
            friction: 1.0,
        }
    }

    fn take_over(constants: &Self::Constants, state: &mut Self::State) -> Result<(), Error> {
        state.circuit.is_on(&constants.circuit)?;
        state.friction = 1.0;
        Ok(())
    }

    #[inline(always)]
    fn step(
        constants: &Self::Constants,
        state: &mut Self::State,
        inputs: LinearInputs,
    ) -> LinearOutputs {
        let CheckedInputs { inputs, faults } = constants.limits.check_inputs(inputs);
        let Some(inputs) = inputs else {
            return LinearOutputs::safe(faults);
        };
        let sliding = constants.friction_of_balls(&mut state.circuit, inputs, state.friction);
        let reversal = constants.reversal.at(inputs.speed);
        Self::outputs_at(constants, inputs, &sliding, reversal, NO_DRAG, faults)
    }
}

impl<const N: usize> Sliding for LinearBearingTrain<N> {
    const FRICTION: Range = ranges::FRICTION;

    const COUNTS_PRELOAD: bool = false;

    type Friction = LinearFriction;

    #[inline(always)]
    fn check_inputs(
        constants: &Self::Constants,
        inputs: LinearInputs,
    ) -> CheckedInputs<LinearInputs> {
        constants.limits.check_inputs(inputs)
    }

    #[inline(always)]
    fn sliding_friction(
        constants: &Self::Constants,
        state: &mut Self::State,
        inputs: LinearInputs,
        friction: DirectionalCoefficient,
    ) -> LinearFriction {
        let ratio = friction.of(inputs.speed).0 / constants.friction;
        let mut sliding = constants.friction_of_balls(&mut state.circuit, inputs, ratio);
        sliding.row.ratios = friction.over_own(inputs.speed);
        sliding
    }

    #[inline(always)]
    fn by_direction(sliding: &LinearFriction) -> SlidingFriction {
        sliding.row.friction()
    }

    #[inline(always)]
    fn continue_from(sliding: &mut LinearFriction, last: &LinearFriction, travelled: f32) {
        sliding.row.continue_from(&last.row, travelled);
    }

    #[inline(always)]
    fn outputs_at(
        constants: &Self::Constants,
        _: LinearInputs,
        sliding: &LinearFriction,
        reversal: ReversalState,
        drag: f32,
        faults: Faults,
    ) -> LinearOutputs {
        let row = sliding.row.outputs_at(
            reversal,
            0.0,
            drag,
            faults.with(sliding.beyond_model, Faults::BEYOND_MODEL),
            constants.limits.friction_force,
        );
        LinearOutputs {
            friction_force: row.whole.friction_torque,
            groove_force: row.groove,
            ball_force: row.ball,
            contacts: row.contacts,
            largest_contact_force: row.largest_contact_force,
            regime: row.whole.regime,
            faults: row.whole.faults,
        }
    }

    #[inline(always)]
    fn limited_travel(constants: &Self::Constants, travel: f32, _: f32) -> (f32, f32) {
        let travel = bounded(travel, constants.limits.speed * constants.tick);
        (travel, travel * constants.per_tick)
    }
}

impl<const N: usize> LinearConstants<N> {
    /// Checks a configuration and folds its constants.
    pub const fn new(configuration: &LinearBearingConfiguration) -> Result<Self, Error> {
        let LinearBearingConfiguration {
            ref bearing,
            friction,
            ball_friction,
            reversal_speed,
            limits,
            ..
        } = *configuration;
        attempt!(ranges::FRICTION.checked("friction", friction));
        attempt!(ranges::FRICTION_OR_NONE.checked("ball_friction", ball_friction));
        let reversal = attempt!(Reversal::new(reversal_speed, 1e-9, 10.0));
        let limits = attempt!(limits.checked());
        let circuit = attempt!(configuration.circuit(&limits, N));
        let (ball, grooves) = attempt!(configuration.friction());
        let angle = bearing.contact_angle();
        Ok(Self {
            circuit,
            friction,
            tick: configuration.tick,
            per_tick: 1.0 / configuration.tick,
            ball,
            normal: 1.0 / angle.cos,
            side: 1.0 / angle.sin,
            grooves,
            // Lin 2019, (3.52): balls that roll alike rub with v/cos(beta).
            rubbing: ball_friction / angle.cos,
            wavelength: configuration.wavelength,
            reversal,
            limits,
        })
    }

    pub(crate) fn set_carriage_position(&self, state: &mut LinearState<N>, position: f32) {
        state
            .circuit
            .set_turns(&self.circuit, position / self.wavelength);
    }
}

impl<const N: usize> ChangingFriction for LinearBearingTrain<N> {
    fn set_friction(
        constants: &Self::Constants,
        state: &mut Self::State,
        friction: f32,
    ) -> Result<(), Error> {
        let friction = ranges::FRICTION.checked("friction", friction)?;
        state.friction = friction / constants.friction;
        Ok(())
    }
}

impl<const N: usize> StoredScene for LinearBearingTrain<N> {
    const KIND: u16 = 3;
    const BALLS: u16 = N as u16;

    fn balls(state: &Self::State) -> u16 {
        state.circuit.train.balls() as u16
    }

    fn fingerprint(constants: &Self::Constants, fingerprint: &mut Fingerprint) {
        constants.circuit.fingerprint(fingerprint);
        let per_ball = constants.circuit.per_loaded_ball();
        fingerprint.numbers(&[
            constants.friction,
            per_ball * constants.normal,
            per_ball * constants.side,
            constants.wavelength,
        ]);
    }

    fn complete(_: &Self::Constants, state: &mut Self::State) -> Result<(), Refusal> {
        state.circuit.train.in_order()
    }
}

impl<const N: usize> Stored for LinearState<N> {
    const BYTES: usize = CircuitState::<N>::BYTES + 4;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        self.circuit.exchange(port)?;
        // Any friction coefficient over any other.
        let largest = ranges::FRICTION.maximum / ranges::FRICTION.minimum;
        port.number(
            "friction",
            &mut self.friction,
            Range::new(0.5 / largest, 2.0 * largest),
        )
    }
}

impl Stored for LinearFriction {
    const BYTES: usize = TrainFriction::BYTES + 1;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        self.row.exchange(port)?;
        port.flag("beyond_model", &mut self.beyond_model)
    }
}
