//! A linear bearing with four-point contact and balls that press on each other.

use super::circuit::{
    Circuit, CircuitConfiguration, CircuitState, DeviationMap, LONGEST_TRACK, UNLOADED,
    per_loaded_ball,
};
use super::contract::{Admitted, Regime, Reversal, Scene};
use super::faults::{Faults, bounded};
use super::outputs::LinearOutputs;
use crate::ball::{
    AnalyticLinearBall, BorderParameters, GrooveFriction, LoadShare, LoadShares, largest_deviation,
};
use crate::contact::FrictionMap;
use crate::error::{Error, attempt, in_range};
use crate::geometry::LinearBearing;
use crate::hertz::HertzContact;
use crate::math;
use crate::ranges;

/// Force of a diagonal below which it does not count, N.
const SMALLEST_FORCE: f32 = 2e-6;

/// `2^(-4/3)`: a diagonal's force to the power of 4/3 is that of its sum of two equal contact forces, times this.
pub(crate) const HALF_TO_FOUR_THIRDS: f32 = 0.396_850_26;

/// A linear bearing without cage, with `N` balls in one circuit, in four-point contact: the published
/// closed form for every ball ([`AnalyticLinearBall`](crate::ball::AnalyticLinearBall)), with its corrections.
///
/// Unflagged, with one groove that deviates by up to 3 degrees: the speed of a ball alone is within 7.5e-3 of `v/2` at
/// 100 N a ball, 1e-2 at 10 N and 1.5e-2 at 1 N, and the friction of balls that press on each other within 12 % from 30 N
/// on and 23 % at 10 N (too small: the closed form leaves out that a ball rubbed by its neighbours turns).
/// [`FourPointBall::refine_chain`](crate::refined::FourPointBall::refine_chain) is within 4e-5 of `v/2` up to side-force
/// ratios of 0.8, at some 1,500 cycles a ball.
///
/// Where side forces leave little on one diagonal, balls change to two-point rolling, and their speed jumps.
/// [`Faults::BEYOND_MODEL`] stands from the tick on in which the loads and the force between balls let some ball do so,
/// at the least favourable deviations of both maps. With the ball of Lin 2019, Table 3.3, under 100 N that is a side-force
/// ratio of 0.92 where grooves are straight, 0.87 where one deviates by 3 degrees; less with heavier balls, closer
/// grooves, and friction between balls that press. The flag comes up to 0.03 of the ratio before a ball alone jumps, up to
/// 0.1 before a row of pressing balls, and in no tested case after. From there on the grooves' friction is that of two-point
/// rolling, within 4 % of the friction before where grooves are straight; forces between balls go on as before, and the
/// friction of a row is within 40 % up to a ratio of 0.97.
///
/// A tick whose speed or load is no number is flagged in that tick, puts out no force, and leaves the state as
/// it is; the next sound tick is unflagged. Balls, and the phase of the rail's deviations, stand behind by the
/// travel of the missed ticks from then on, until [`FrictionModel::reset`](crate::FrictionModel::reset);
/// [`FrictionModel::set_carriage_position`](crate::FrictionModel::set_carriage_position) brings the phase back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LinearBearingTrain<const N: usize>;

/// What the control interrupt knows of a linear bearing at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LinearInputs {
    /// Speed of the carriage on the rail, m/s.
    pub speed: f32,
    /// Force that presses the carriage on the row of balls, N, preload included; zero or less lifts it
    /// off.
    pub normal_load: f32,
    /// Force across, N: positive loads the diagonal from bottom left to top right.
    pub side_load: f32,
}

/// Bounds that are kept whatever comes in.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LinearLimits {
    /// Largest speed that is believed, m/s, 1e-6 to 1e3.
    pub speed: f32,
    /// Largest normal and side load that is believed, N, 1e-3 to 1e7.
    pub load: f32,
    /// Largest friction force that is put out, N, 1e-6 to 1e6.
    pub friction_force: f32,
}

/// What the engineer sets for a linear bearing; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LinearBearingConfiguration {
    /// The validated design.
    pub bearing: LinearBearing,
    /// Coulomb friction coefficient of ball and groove, 1e-6 to 1.
    pub friction: f32,
    /// Coulomb friction coefficient of ball and ball, 0 to 1.
    pub ball_friction: f32,
    /// Length of the loaded track, m, 1e-4 to 100.
    pub loaded_length: f32,
    /// Length of the return, m, 0 to 100, up to 250 times the loaded track: there balls carry no load.
    pub return_length: f32,
    /// Length that counts as one turn of the deviation maps, m, 1e-4 to 100, at least a thousandth of the
    /// track.
    pub wavelength: f32,
    /// Deviation of the contact angles along the rail, added on BR, taken off on BL: at most 0.2 rad for
    /// contact angles from 23 to 68 degrees, beyond half of the contact angle or its cotangent.
    pub rail_deviation: &'static DeviationMap,
    /// Deviation of the contact angles along the carriage, added on TR, taken off on TL; as large.
    pub carriage_deviation: &'static DeviationMap,
    /// Load of a ball over the mean load, in equal parts of the loaded track from its start; 1 to 256.
    pub load_shares: &'static [LoadShare],
    /// Speed over which friction changes its direction, m/s, 1e-9 to 10: at this speed it has 71 % of
    /// its full value.
    pub reversal_speed: f32,
    /// Time between two ticks, s, 1e-6 to 1; at the largest speed the balls may move by 3 % of the track
    /// in it, and the rail by half a period of its deviation map.
    pub tick: f32,
    /// Bounds that are kept whatever comes in.
    pub limits: LinearLimits,
}

/// Constants of a linear bearing with `N` balls.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LinearConstants<const N: usize> {
    circuit: Circuit,
    ball: AnalyticLinearBall,
    /// Half the sum of both diagonals' forces over the normal load, `1/(n cos beta)` for `n` loaded balls.
    normal: f32,
    /// Half the difference of both diagonals' forces over the side load, `1/(n sin beta)`.
    side: f32,
    grooves: GrooveFriction,
    /// Friction force of two balls over the force between them.
    rubbing: f32,
    /// Length that counts as one turn of the deviation maps, m.
    wavelength: f32,
    reversal: Reversal,
    limits: LinearLimits,
}

impl LinearLimits {
    /// The limits, checked.
    ///
    /// # Errors
    /// [`Error`] naming `speed`, `load` or `friction_force`.
    pub const fn checked(self) -> Result<Self, Error> {
        attempt!(in_range("speed", self.speed, 1e-6, 1e3));
        attempt!(in_range("load", self.load, 1e-3, 1e7));
        attempt!(in_range("friction_force", self.friction_force, 1e-6, 1e6));
        Ok(self)
    }

    /// The inputs within these limits, with what was wrong.
    #[inline(always)]
    fn admit(&self, inputs: LinearInputs) -> Admitted<LinearInputs> {
        let LinearInputs {
            speed,
            normal_load,
            side_load,
        } = inputs;
        let loads_are_finite = normal_load.is_finite() && side_load.is_finite();
        if speed.is_finite() && loads_are_finite {
            Admitted {
                inputs: Some(LinearInputs {
                    speed: bounded(speed, self.speed),
                    normal_load: bounded(normal_load, self.load),
                    side_load: bounded(side_load, self.load),
                }),
                faults: Faults::beyond(
                    speed.abs() > self.speed,
                    normal_load.abs() > self.load || side_load.abs() > self.load,
                ),
            }
        } else {
            Admitted {
                inputs: None,
                faults: Faults::not_finite(!speed.is_finite(), !loads_are_finite),
            }
        }
    }
}

impl<const N: usize> Scene for LinearBearingTrain<N> {
    type Configuration = LinearBearingConfiguration;
    type Constants = LinearConstants<N>;
    type State = CircuitState<N>;
    type Inputs = LinearInputs;
    type Outputs = LinearOutputs;

    fn constants(configuration: &LinearBearingConfiguration) -> Result<LinearConstants<N>, Error> {
        LinearConstants::new(configuration)
    }

    fn initial_state(constants: &LinearConstants<N>) -> CircuitState<N> {
        CircuitState::new(&constants.circuit)
    }

    #[inline(always)]
    fn admit(constants: &LinearConstants<N>, inputs: LinearInputs) -> Admitted<LinearInputs> {
        constants.limits.admit(inputs)
    }

    #[inline(always)]
    fn outputs(
        constants: &LinearConstants<N>,
        state: &mut CircuitState<N>,
        inputs: LinearInputs,
    ) -> LinearOutputs {
        constants.outputs(state, inputs)
    }

    #[inline(always)]
    fn largest_friction(constants: &LinearConstants<N>) -> f32 {
        constants.limits.friction_force
    }
}

impl LinearBearingConfiguration {
    /// The circuit's part, checked and folded for so many balls.
    const fn circuit(&self, limits: &LinearLimits, balls: usize) -> Result<Circuit, Error> {
        let Self {
            loaded_length,
            return_length,
            wavelength,
            tick,
            ..
        } = *self;
        attempt!(in_range("loaded_length", loaded_length, 1e-4, 100.0));
        attempt!(in_range("return_length", return_length, 0.0, 100.0));
        attempt!(in_range("tick", tick, 1e-6, 1.0));
        let shortest = (loaded_length + return_length) / LONGEST_TRACK;
        let shortest = if shortest > 1e-4 { shortest } else { 1e-4 };
        attempt!(in_range("wavelength", wavelength, shortest, 100.0));
        CircuitConfiguration {
            loaded_length,
            loaded_turns: loaded_length / wavelength,
            return_length,
            turn_length: wavelength,
            pitch: 2.0 * self.bearing.ball_radius(),
            // A ball that rolls gets on half as far as the carriage.
            travel_per_motion: 0.5,
            motion_per_turn: wavelength,
            passing_deviation: self.rail_deviation,
            recirculating_deviation: self.carriage_deviation,
            load_shares: LoadShares::same(self.load_shares),
            tick,
            largest_speed: limits.speed,
        }
        .folded(balls)
    }
}

impl<const N: usize> LinearConstants<N> {
    /// Checks a configuration and folds its constants: at set-up, or in a constant when firmware is compiled (see
    /// [`FrictionModel`](crate::FrictionModel)).
    ///
    /// # Errors
    /// [`Error`] naming the field out of range.
    pub const fn new(configuration: &LinearBearingConfiguration) -> Result<Self, Error> {
        let LinearBearingConfiguration {
            ref bearing,
            friction,
            ball_friction,
            rail_deviation,
            carriage_deviation,
            reversal_speed,
            limits,
            ..
        } = *configuration;
        attempt!(ranges::FRICTION.checked("friction", friction));
        attempt!(ranges::FRICTION_OR_NONE.checked("ball_friction", ball_friction));
        let reversal = attempt!(Reversal::new(reversal_speed, 1e-9, 10.0));
        let limits = attempt!(limits.checked());
        let circuit = attempt!(configuration.circuit(&limits, N));

        // The deviations' sum times half the tangent is a ball's speed deviation: no more than a half.
        let nominal = bearing.parameters().contact_angle;
        let angle = bearing.contact_angle();
        let largest = largest_deviation(nominal, angle.sin / angle.cos);
        attempt!(rail_deviation.checked("rail_deviation", largest));
        attempt!(carriage_deviation.checked("carriage_deviation", largest));

        let contact = HertzContact::of_linear(bearing);
        let map = attempt!(FrictionMap::new(contact.axis_ratio()));
        let radius = bearing.ball_radius();
        let semi_major = contact.semi_major_coefficient();
        let half_tangent = 0.5 * angle.sin / angle.cos;
        // Four contacts that spin with v tan(beta)/(2 r_b) each.
        let drag = 2.0 * map.spin_moment() * friction * semi_major * half_tangent / radius;
        let ball = AnalyticLinearBall::folded(
            half_tangent,
            semi_major / (map.slope() * friction * radius),
        );
        let grooves = GrooveFriction::new(&BorderParameters {
            angle: (angle.sin, angle.cos),
            friction,
            ball_friction,
            spin: HALF_TO_FOUR_THIRDS * drag,
            bottom: rail_deviation.extremes(),
            top: carriage_deviation.extremes(),
            shares: LoadShare::extremes(configuration.load_shares),
        });
        let per_ball = per_loaded_ball(configuration.loaded_length, configuration.return_length, N);
        Ok(Self {
            circuit,
            ball,
            normal: per_ball / angle.cos,
            side: per_ball / angle.sin,
            grooves,
            // (3.52): balls that roll alike rub with v/cos(beta).
            rubbing: ball_friction / angle.cos,
            wavelength: configuration.wavelength,
            reversal,
            limits,
        })
    }

    #[inline(always)]
    fn outputs(&self, state: &mut CircuitState<N>, inputs: LinearInputs) -> LinearOutputs {
        let LinearInputs {
            speed,
            normal_load,
            side_load,
        } = inputs;
        let direction = self.reversal.direction(speed);
        let (normal, side) = (normal_load * self.normal, side_load * self.side);
        let up = at_least(normal + side, SMALLEST_FORCE);
        let down = at_least(normal - side, SMALLEST_FORCE);
        let (up_root, up_squared) = math::cbrt_and_squared(up);
        let (down_root, down_squared) = math::cbrt_and_squared(down);

        // A radian by which the angles at TR and BR grow and those at TL and BL shrink: (3.43) is linear in it.
        let diagonals = [up_squared, down_squared];
        let mean = self.ball.closed_form(diagonals, [1.0, -1.0]);
        let turn = if speed < 0.0 {
            -mean.speed_deviation
        } else {
            mean.speed_deviation
        };
        let impedance = self.ball.impedance(diagonals);
        let spins = [up * up_root, down * down_root];
        let loss = self.grooves.at([up, down], spins, normal - side.abs());

        let phase = state.phase();
        let table = self.circuit.shares(false);
        let (passing, recirculating) = self.circuit.deviation_units();
        let (passing, recirculating) = (turn * passing, turn * recirculating);
        let mut shares = 0.0;
        let mut balls = state.train.intake(self.circuit.travel(speed));
        while let Some(next) = balls.next_ball() {
            let (free, impedance) = match self.circuit.place(next.position(), phase, table) {
                Some(place) => {
                    shares += place.share.four_thirds();
                    let free = recirculating * place.recirculating + passing * place.passing;
                    (free, impedance * place.share.two_thirds())
                }
                None => (0.0, UNLOADED),
            };
            next.put(free, impedance);
        }
        let pressing = balls.press();
        state.advance(&self.circuit, speed);

        // Lifted off, no ball rolls.
        let beyond_model = normal + side.abs() > SMALLEST_FORCE
            && self
                .grooves
                .leaves_four_points(&loss, pressing.largest, mean.compliance);
        let groove_force = direction * (loss.friction * shares);
        let ball_force = direction * (self.rubbing * pressing.force);
        LinearOutputs {
            friction_force: groove_force + ball_force,
            groove_force,
            ball_force,
            contacts: pressing.contacts,
            largest_contact_force: pressing.largest,
            regime: Regime::of(self.reversal.stands(speed), true, true),
            faults: Faults::NONE.with(beyond_model, Faults::BEYOND_MODEL),
        }
    }

    /// See [`FrictionModel::set_carriage_position`](crate::FrictionModel::set_carriage_position).
    pub(crate) fn set_carriage_position(&self, state: &mut CircuitState<N>, position: f32) {
        state.set_turns(&self.circuit, position / self.wavelength);
    }
}

#[inline]
fn at_least(value: f32, bound: f32) -> f32 {
    if value > bound { value } else { bound }
}
