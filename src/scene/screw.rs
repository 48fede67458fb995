//! A ball screw without cage: its balls press on each other.

use core::f32::consts::TAU;

use super::deviation::DeviationMap;
use super::faults::answered;
use super::uncaged::TrainOutputs;
use super::zone::{LARGEST_ADVANCE, LONGEST_RETURN, LONGEST_TRACK, LoadedZone, Phase};
use super::{Faults, Inputs, Limits, Regime, Scene};
use crate::ball::{GrooveFit, LoadShare, LoopSums, ScrewRow};
use crate::error::{Error, attempt, in_range};
use crate::geometry::BallScrew;
use crate::math;
use crate::math::elliptic::arc_sine;
use crate::train::{IMPEDANCE_RANGE, LARGEST_FREE_SPEED, LARGEST_TRAVEL, Track, Train};

/// Impedance of a ball that no load presses into its grooves, N: it goes along with its neighbours.
const UNLOADED: f32 = 1e-6;
const _: () = assert!(UNLOADED >= IMPEDANCE_RANGE.0);

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
    /// Coulomb friction coefficient of ball and groove, 1e-3 to 0.5.
    pub friction: f32,
    /// Coulomb friction coefficient of ball and ball, 0 to 1.
    pub ball_friction: f32,
    /// How balls fit between the grooves.
    pub fit: GrooveFit,
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
    /// Load of a ball over the mean load, in equal parts of the loaded track from its start; 1 to 256.
    pub load_shares: &'static [LoadShare],
    /// Nut speed over which friction changes its direction, rad/s, 1e-6 to 1e3: at this speed it has
    /// 71 % of its full value.
    pub reversal_speed: f32,
    /// Time between two ticks, s, 1e-6 to 1; at the largest nut speed the balls may move by 3 % of the
    /// track in it, and the screw by half a period of its deviation map.
    pub tick: f32,
    /// Bounds that are kept whatever comes in.
    pub limits: Limits,
}

/// Constants of a ball screw without cage, with `N` balls.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct UncagedConstants<const N: usize> {
    row: ScrewRow,
    zone: LoadedZone,
    track: Track,
    ball_friction: f32,
    /// Loaded balls, the other way round.
    per_ball: f32,
    /// Speed of the balls against the nut, m per unit of nut speed, and the other way round.
    speed: f32,
    per_speed: f32,
    /// Travel of the balls along the nut's track in a tick, m s.
    travel: f32,
    /// Advance of the screw's phase in a tick, s.
    phase: f32,
    reduced_lead: f32,
    reversal_speed: f32,
    reversal_squared: f32,
    limits: Limits,
}

/// State of a ball screw without cage.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct UncagedState<const N: usize> {
    /// The balls.
    pub train: Train<N>,
    phase: Phase,
    /// Consecutive ticks whose outputs were flagged, up to `u32::MAX`; 0 after a sound tick.
    pub faulted_ticks: u32,
}

impl<const N: usize> Scene for UncagedBallScrew<N> {
    type Configuration = UncagedBallScrewConfiguration;
    type Constants = UncagedConstants<N>;
    type State = UncagedState<N>;
    type Inputs = Inputs;
    type Outputs = TrainOutputs;

    fn constants(
        configuration: &UncagedBallScrewConfiguration,
    ) -> Result<UncagedConstants<N>, Error> {
        UncagedConstants::new(configuration)
    }

    fn initial_state(constants: &UncagedConstants<N>) -> UncagedState<N> {
        UncagedState {
            train: Train::spread(constants.track),
            phase: Phase::default(),
            faulted_ticks: 0,
        }
    }

    #[inline]
    fn step(
        constants: &UncagedConstants<N>,
        state: &mut UncagedState<N>,
        inputs: Inputs,
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

impl<const N: usize> UncagedConstants<N> {
    /// Checks a configuration and folds its constants: at set-up, or in a constant when firmware is compiled (see
    /// [`FrictionModel`](crate::FrictionModel)).
    ///
    /// # Errors
    /// [`Error`] naming the field out of range.
    pub const fn new(configuration: &UncagedBallScrewConfiguration) -> Result<Self, Error> {
        let design = &configuration.design;
        let friction = attempt!(in_range("friction", configuration.friction, 1e-3, 0.5));
        let ball_friction = attempt!(in_range(
            "ball_friction",
            configuration.ball_friction,
            0.0,
            1.0
        ));
        let turns = attempt!(in_range("turns", configuration.turns, 0.1, 100.0));
        let return_length = attempt!(in_range(
            "return_length",
            configuration.return_length,
            0.0,
            10.0
        ));
        let reversal_speed = attempt!(in_range(
            "reversal_speed",
            configuration.reversal_speed,
            1e-6,
            1e3
        ));
        let tick = attempt!(in_range("tick", configuration.tick, 1e-6, 1.0));
        let limits = attempt!(configuration.limits.checked());
        let row = attempt!(ScrewRow::new(design, friction, configuration.fit));
        let largest = row.largest_deviation();
        let on_screw = attempt!(
            configuration
                .screw_deviation
                .checked("screw_deviation", largest)
        );
        let in_nut = attempt!(
            configuration
                .nut_deviation
                .checked("nut_deviation", largest)
        );

        let path = design.pitch_radius() / design.cos_lead_angle();
        let per_turn = TAU * path;
        let loaded = turns * per_turn;
        let longest = LONGEST_TRACK * per_turn - loaded;
        attempt!(in_range("return_length", return_length, 0.0, longest));
        attempt!(in_range(
            "return_length",
            return_length,
            0.0,
            LONGEST_RETURN * loaded
        ));
        let length = loaded + return_length;
        let pitch = 2.0 * path * arc_sine(design.ball_radius() / path);
        let track = attempt!(Track::new(length, pitch, N));
        let zone = attempt!(LoadedZone::new(
            turns,
            length / per_turn,
            configuration.screw_deviation,
            configuration.nut_deviation,
            configuration.load_shares,
        ));

        let speed = path - row.nominal_speed();
        // Where balls hardly move against the nut, deviations that are small against the pitch radius
        // are large against that.
        let relative = row.fastest_deviation(on_screw, in_nut) / speed;
        if relative > LARGEST_FREE_SPEED {
            attempt!(in_range(
                "screw_deviation",
                on_screw,
                0.0,
                on_screw * LARGEST_FREE_SPEED / relative,
            ));
            attempt!(in_range(
                "nut_deviation",
                in_nut,
                0.0,
                in_nut * LARGEST_FREE_SPEED / relative,
            ));
        }
        let fastest = LARGEST_TRAVEL * length / (speed * limits.nut_speed);
        attempt!(in_range("tick", tick, 0.0, fastest));
        let period = TAU * zone.passing_turns() as f32;
        attempt!(in_range(
            "tick",
            tick,
            0.0,
            LARGEST_ADVANCE * period / limits.nut_speed,
        ));
        Ok(Self {
            row,
            per_ball: length / (loaded * N as f32),
            speed,
            per_speed: 1.0 / speed,
            travel: -speed * tick,
            phase: zone.phase_per_turn() * tick / TAU,
            zone,
            track,
            ball_friction,
            reduced_lead: design.lead() / TAU,
            reversal_speed,
            reversal_squared: reversal_speed * reversal_speed,
            limits,
        })
    }

    #[inline(always)]
    fn outputs(&self, state: &mut UncagedState<N>, inputs: Inputs, faults: Faults) -> TrainOutputs {
        let Inputs {
            nut_speed,
            axial_load,
        } = inputs;
        let direction = nut_speed / math::sqrt(nut_speed * nut_speed + self.reversal_squared);
        let tick = self.row.at(nut_speed, axial_load * self.per_ball);
        // Speeds are along the track, over the size of the nominal speed against the nut.
        let (way, per_speed) = if nut_speed < 0.0 {
            (-self.speed, -self.per_speed)
        } else {
            (self.speed, self.per_speed)
        };

        let row = tick.per_speed(way, per_speed, self.zone.units());
        let phase = state.phase.units();
        let mut sums = LoopSums::default();
        let pressing = state.train.run(nut_speed * self.travel, |position| {
            match self.zone.at(position, phase) {
                Some(place) => {
                    let ball = row.ball(place.passing, place.own, place.share, &mut sums);
                    (ball.speed, ball.impedance)
                }
                None => (0.0, UNLOADED),
            }
        });
        let groove_torque = row.groove_torque(&sums);
        state.phase.advance(nut_speed * self.phase);

        // Both balls of a pair turn alike; the sign of the speeds is that of the nut speed.
        let rubbing = tick.rubbing() * pressing.force + tick.rubbing_slope() * way * pressing.power;
        let ball_torque = 2.0 * self.ball_friction * rubbing;

        let groove_friction = direction * groove_torque;
        let ball_friction = direction * ball_torque;
        let (friction, limited) = self.limits.limit_torque(groove_friction + ball_friction);
        let load_torque = axial_load * self.reduced_lead;
        let size = if friction < 0.0 { -friction } else { friction };
        let opposing = if nut_speed < 0.0 {
            -load_torque
        } else {
            load_torque
        };
        let regime = if nut_speed.abs() < self.reversal_speed {
            Regime::Standing
        } else if opposing >= 0.0 {
            Regime::Driving
        } else if size < -opposing {
            Regime::BackDriving
        } else {
            Regime::Locked
        };
        TrainOutputs {
            friction,
            groove_friction,
            ball_friction,
            load_torque,
            contacts: pressing.contacts,
            largest_contact_force: pressing.largest,
            regime,
            faults: faults | limited,
        }
    }
}

impl<const N: usize> UncagedState<N> {
    pub(crate) fn set_nut_angle(&mut self, constants: &UncagedConstants<N>, angle: f32) {
        let turns = f32::from(constants.zone.passing_turns());
        self.phase.set(angle / (TAU * turns));
    }
}
