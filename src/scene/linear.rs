//! A linear bearing with four-point contact and balls that press on each other.

use super::deviation::DeviationMap;
use super::faults::{admit, answered, limit};
use super::uncaged::TrainOutputs;
use super::zone::{LARGEST_ADVANCE, LONGEST_RETURN, LONGEST_TRACK, LoadedZone, Phase};
use super::{Faults, Regime, Scene};
use crate::ball::{LoadShare, largest_deviation};
use crate::contact::FrictionMap;
use crate::error::{Error, attempt, in_range};
use crate::geometry::LinearBearing;
use crate::hertz::HertzContact;
use crate::math;
use crate::train::{LARGEST_TRAVEL, Track, Train};

/// Impedance of a ball that no load presses into its grooves, N: it goes along with its neighbours.
const UNLOADED: f32 = 1e-6;

/// Force on a diagonal below which it does not count, N.
const SMALLEST_FORCE: f32 = 1e-6;

/// A linear bearing without cage, with `N` balls in one circuit, in four-point contact: the published
/// closed form for every ball ([`AnalyticLinearBall`](crate::ball::AnalyticLinearBall)), with its corrections.
///
/// Speed deviations are within 6e-3 of `v/2` for side-force ratios up to 0.8 and deviations up to 3
/// degrees, where [`FourPointBall::refine_chain`](crate::refined::FourPointBall::refine_chain) is within 4e-5 at
/// some 1,500 cycles a ball. From ratios of 0.88 to 0.98 on, where balls change to two-point rolling, they
/// are too large by up to 9.5e-3 per degree, and so is the force between balls; no flag says so.
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
    /// Coulomb friction coefficient of ball and groove, 1e-3 to 1.
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
    zone: LoadedZone,
    track: Track,
    /// Loads over the diagonals' forces: `1/(2 n cos beta)` and `1/(2 n sin beta)` for `n` loaded balls.
    normal: f32,
    side: f32,
    /// `tan(beta)/2`.
    half_tangent: f32,
    /// Impedance of a ball over `F_U^(2/3) + F_D^(2/3)`, N^(1/3).
    impedance: f32,
    /// Drag of a ball over `F_U^(4/3) + F_D^(4/3)`, N^(-1/3).
    drag: f32,
    /// Friction force of two balls over the force between them.
    rubbing: f32,
    travel: f32,
    phase: f32,
    /// Periods of the rail's deviations per metre.
    periods: f32,
    reversal_speed: f32,
    reversal_squared: f32,
    limits: LinearLimits,
}

/// State of a linear bearing.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct LinearState<const N: usize> {
    /// The balls.
    pub train: Train<N>,
    phase: Phase,
    /// Consecutive ticks whose outputs were flagged, up to `u32::MAX`; 0 after a sound tick.
    pub faulted_ticks: u32,
}

impl LinearLimits {
    const fn checked(self) -> Result<Self, Error> {
        attempt!(in_range("speed", self.speed, 1e-6, 1e3));
        attempt!(in_range("load", self.load, 1e-3, 1e7));
        attempt!(in_range("friction_force", self.friction_force, 1e-6, 1e6));
        Ok(self)
    }

    /// The inputs within their limits, with what was wrong; `None` beside the flags where no number can
    /// stand in.
    #[inline]
    fn admit(&self, inputs: LinearInputs) -> (Option<LinearInputs>, Faults) {
        let (admitted, faults) = admit(
            inputs.speed,
            self.speed,
            [inputs.normal_load, inputs.side_load],
            self.load,
        );
        let admitted = admitted.map(|(speed, [normal_load, side_load])| LinearInputs {
            speed,
            normal_load,
            side_load,
        });
        (admitted, faults)
    }
}

impl<const N: usize> Scene for LinearBearingTrain<N> {
    type Configuration = LinearBearingConfiguration;
    type Constants = LinearConstants<N>;
    type State = LinearState<N>;
    type Inputs = LinearInputs;
    type Outputs = TrainOutputs;

    fn constants(configuration: &LinearBearingConfiguration) -> Result<LinearConstants<N>, Error> {
        LinearConstants::new(configuration)
    }

    fn initial_state(constants: &LinearConstants<N>) -> LinearState<N> {
        LinearState {
            train: Train::spread(constants.track),
            phase: Phase::default(),
            faulted_ticks: 0,
        }
    }

    #[inline]
    fn step(
        constants: &LinearConstants<N>,
        state: &mut LinearState<N>,
        inputs: LinearInputs,
    ) -> TrainOutputs {
        let (outputs, ticks) = answered(
            constants.limits.admit(inputs),
            state.faulted_ticks,
            |inputs, faults| constants.outputs(state, inputs, faults),
        );
        state.faulted_ticks = ticks;
        outputs
    }
}

impl<const N: usize> LinearConstants<N> {
    /// Checks a configuration and folds its constants: at set-up, or in a constant when firmware is compiled (see
    /// [`FrictionModel`](crate::FrictionModel)).
    ///
    /// # Errors
    /// [`Error`] naming the field out of range.
    pub const fn new(configuration: &LinearBearingConfiguration) -> Result<Self, Error> {
        let bearing = &configuration.bearing;
        let friction = attempt!(in_range("friction", configuration.friction, 1e-3, 1.0));
        let ball_friction = attempt!(in_range(
            "ball_friction",
            configuration.ball_friction,
            0.0,
            1.0
        ));
        let loaded = attempt!(in_range(
            "loaded_length",
            configuration.loaded_length,
            1e-4,
            100.0
        ));
        let return_length = attempt!(in_range(
            "return_length",
            configuration.return_length,
            0.0,
            100.0
        ));
        let wavelength = attempt!(in_range(
            "wavelength",
            configuration.wavelength,
            1e-4,
            100.0
        ));
        let reversal_speed = attempt!(in_range(
            "reversal_speed",
            configuration.reversal_speed,
            1e-9,
            10.0
        ));
        let tick = attempt!(in_range("tick", configuration.tick, 1e-6, 1.0));
        let limits = attempt!(configuration.limits.checked());

        attempt!(in_range(
            "return_length",
            return_length,
            0.0,
            LONGEST_RETURN * loaded
        ));
        let length = loaded + return_length;
        let radius = bearing.ball_radius();
        let track = attempt!(Track::new(length, 2.0 * radius, N));
        attempt!(in_range(
            "wavelength",
            wavelength,
            length / LONGEST_TRACK,
            100.0
        ));
        let zone = attempt!(LoadedZone::new(
            loaded / wavelength,
            length / wavelength,
            configuration.rail_deviation,
            configuration.carriage_deviation,
            configuration.load_shares,
        ));
        attempt!(in_range(
            "tick",
            tick,
            0.0,
            2.0 * LARGEST_TRAVEL * length / limits.speed,
        ));
        let period = wavelength * zone.passing_turns() as f32;
        attempt!(in_range(
            "tick",
            tick,
            0.0,
            LARGEST_ADVANCE * period / limits.speed
        ));

        // The deviations' sum times half the tangent is a ball's speed deviation: no more than a half.
        let nominal = bearing.parameters().contact_angle;
        let angle = bearing.contact_angle();
        let largest = largest_deviation(nominal, angle.sin / angle.cos);
        attempt!(
            configuration
                .rail_deviation
                .checked("rail_deviation", largest)
        );
        attempt!(
            configuration
                .carriage_deviation
                .checked("carriage_deviation", largest)
        );

        let contact = HertzContact::of_linear(bearing);
        let map = attempt!(FrictionMap::new(contact.axis_ratio()));
        let per_ball = length / (loaded * N as f32);
        let half_tangent = 0.5 * angle.sin / angle.cos;
        let semi_major = contact.semi_major_coefficient();
        Ok(Self {
            zone,
            track,
            normal: 0.5 * per_ball / angle.cos,
            side: 0.5 * per_ball / angle.sin,
            half_tangent,
            // (3.43), (3.49) with tan(beta) for 1 - cos(2 beta), in units of v/2.
            impedance: map.slope() * friction * radius / (half_tangent * semi_major),
            // Four contacts that spin with v tan(beta)/(2 R_B) each.
            drag: 2.0 * map.spin_moment() * friction * semi_major * half_tangent / radius,
            // (3.52): balls that roll alike rub with v/cos(beta).
            rubbing: ball_friction / angle.cos,
            travel: -0.5 * tick,
            phase: zone.phase_per_turn() * tick / wavelength,
            periods: 1.0 / (wavelength * zone.passing_turns() as f32),
            reversal_speed,
            reversal_squared: reversal_speed * reversal_speed,
            limits,
        })
    }

    #[inline(always)]
    fn outputs(
        &self,
        state: &mut LinearState<N>,
        inputs: LinearInputs,
        faults: Faults,
    ) -> TrainOutputs {
        let LinearInputs {
            speed,
            normal_load,
            side_load,
        } = inputs;
        let direction = speed / math::sqrt(speed * speed + self.reversal_squared);
        let (normal, side) = (normal_load * self.normal, side_load * self.side);
        let up = at_least(normal + side, SMALLEST_FORCE);
        let down = at_least(normal - side, SMALLEST_FORCE);
        let (up_root, up_squared) = math::cbrt_and_squared(up);
        let (down_root, down_squared) = math::cbrt_and_squared(down);
        let sum = up_squared + down_squared;

        // epsilon = tan(beta) ((dTR - dBL) A_U + (dTL - dBR) A_D)/(2 (A_U + A_D)).
        let turn = self.half_tangent * (up_squared - down_squared) / sum;
        let turn = if speed < 0.0 { -turn } else { turn };
        let impedance = self.impedance * sum;
        let drag = self.drag * (up * up_root + down * down_root);

        let phase = state.phase.units();
        let (passing, own) = self.zone.units();
        let (passing, own) = (turn * passing, turn * own);
        let mut drags = 0.0;
        let pressing = state.train.run(speed * self.travel, |position| {
            match self.zone.at(position, phase) {
                Some(place) => {
                    drags += place.share.four_thirds();
                    let free = own * place.own + passing * place.passing;
                    (free, impedance * place.share.two_thirds())
                }
                None => (0.0, UNLOADED),
            }
        });
        state.phase.advance(speed * self.phase);

        let groove_friction = direction * (drag * drags);
        let ball_friction = direction * (self.rubbing * pressing.force);
        let (friction, limited) =
            limit(groove_friction + ball_friction, self.limits.friction_force);
        TrainOutputs {
            friction,
            groove_friction,
            ball_friction,
            load_torque: 0.0,
            contacts: pressing.contacts,
            largest_contact_force: pressing.largest,
            regime: if speed.abs() < self.reversal_speed {
                Regime::Standing
            } else {
                Regime::Driving
            },
            faults: faults | limited,
        }
    }
}

impl<const N: usize> LinearState<N> {
    pub(crate) fn set_carriage_position(&mut self, constants: &LinearConstants<N>, position: f32) {
        self.phase.set(position * constants.periods);
    }
}

#[inline]
fn at_least(value: f32, bound: f32) -> f32 {
    if value > bound { value } else { bound }
}
