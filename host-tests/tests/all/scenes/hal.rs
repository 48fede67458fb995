//! The adapters for `embedded-hal`: frames on the bus, wrap-around, faults of bus and sensor, duty cycles.

use crate::refusals::assert_refused;
use epas_testkit::gears::{closed_form, screw_inputs};
use std::cell::Cell;
use std::convert::Infallible;
use std::f32::consts::TAU;

use embedded_hal::spi::{ErrorKind, ErrorType, Operation, SpiDevice};
use embedded_hal_mock::eh1::MockError;
use embedded_hal_mock::eh1::pwm::{Mock as PwmMock, Transaction as Pwm};
use embedded_hal_mock::eh1::spi::{Mock as SpiMock, Transaction as Spi};
use epas_friction::hal::{
    EncoderConfiguration, EncoderError, FaultReaction, FeedForwardConfiguration,
    FrictionFeedForward, MagneticEncoder,
};
use epas_friction::{
    BallScrew, Clearance, ClosedFormScrew, ClosedFormScrewConfiguration, DISSERTATION_DESIGNS,
    Faults, FrictionBranch, FrictionModel, Outputs, Regime,
};
use proptest::prelude::*;

const READ_ANGLE: u16 = 0xFFFF;
const READ_DIAGNOSTICS: u16 = 0xFFFC;
const READ_ERRORS: u16 = 0x4001;
/// Start-up finished, gain in the middle.
const HEALTHY: u16 = 0x0180;

/// A frame with its parity in bit 15.
fn sealed(data: u16) -> u16 {
    data | u16::from(data.count_ones() % 2 == 1) << 15
}

const CONFIGURATION: EncoderConfiguration = EncoderConfiguration {
    tick: 1e-3,
    gear_ratio: 1.0,
    largest_nut_speed: 500.0,
    smoothing_time: 0.0,
    stuck_ticks: 3,
};

fn frame(command: u16, answer: u16) -> [Spi<u8>; 3] {
    [
        Spi::transaction_start(),
        Spi::transfer_in_place(command.to_be_bytes().into(), answer.to_be_bytes().into()),
        Spi::transaction_end(),
    ]
}

fn mocked(frames: &[(u16, u16)]) -> MagneticEncoder<SpiMock<u8>> {
    let expected: Vec<_> = frames
        .iter()
        .flat_map(|&(command, answer)| frame(command, answer))
        .collect();
    MagneticEncoder::new(SpiMock::new(&expected), &CONFIGURATION).unwrap()
}

/// The frames of the first tick: one more, for the answer that nobody asked for.
fn first(angle: u16) -> [(u16, u16); 3] {
    [
        (READ_DIAGNOSTICS, 0x1234),
        (READ_ANGLE, sealed(HEALTHY)),
        (READ_DIAGNOSTICS, sealed(angle)),
    ]
}

/// The frames of every tick after a sound one.
fn next(angle: u16) -> [(u16, u16); 2] {
    [
        (READ_ANGLE, sealed(HEALTHY)),
        (READ_DIAGNOSTICS, sealed(angle)),
    ]
}

/// One count in 1 ms is `2 pi / 16384 / 1e-3` = 0.3835 rad/s.
///
/// Measured: within 4.9e-8 of the exact speeds; roundings of the tick, of the quotient and of the product. The numbers here are
/// the exact ones to 8e-9.
#[test]
fn speed_is_the_difference_of_two_angles() {
    let mut encoder = mocked(&[&first(100)[..], &next(200), &next(170)].concat());
    assert_eq!(encoder.tick(false), Err(EncoderError::NoEarlierReading));
    let motion = encoder.tick(false).unwrap();
    approx::assert_relative_eq!(motion.nut_speed, 38.349_52, max_relative = 1.5e-7);
    approx::assert_relative_eq!(motion.rotor_angle, 200.0 * TAU / 16384.0);
    assert!(motion.diagnostics.ready() && motion.diagnostics.bits() == HEALTHY);
    let motion = encoder.tick(false).unwrap();
    approx::assert_relative_eq!(motion.nut_speed, -11.504_856, max_relative = 1.5e-7);
    approx::assert_relative_eq!(
        encoder.resolution(),
        0.383_495_2,
        epsilon = 0.0,
        max_relative = 1.5e-7
    );
    encoder.release().done();
}

/// Odd parity in either frame of a tick is an error; the tick after is sound, and its difference spans both ticks.
#[test]
fn odd_parity_is_surfaced() {
    let broken = sealed(150) ^ 1;
    let frames = [
        &first(100)[..],
        &[(READ_ANGLE, sealed(HEALTHY)), (READ_DIAGNOSTICS, broken)],
        &first(300),
        &[(READ_ANGLE, sealed(HEALTHY) ^ 0x8000)],
        &first(300),
    ]
    .concat();
    let mut encoder = mocked(&frames);
    encoder.tick(false).unwrap_err();
    assert_eq!(
        encoder.tick(false),
        Err(EncoderError::Parity { frame: broken })
    );
    let speed = encoder.tick(false).unwrap().nut_speed;
    approx::assert_relative_eq!(speed, 100.0 * encoder.resolution(), max_relative = 1.2e-7);
    assert_eq!(
        encoder.tick(false),
        Err(EncoderError::Parity {
            frame: sealed(HEALTHY) ^ 0x8000
        })
    );
    assert_eq!(encoder.tick(false).unwrap().nut_speed, 0.0);
    encoder.release().done();
}

#[test]
fn the_error_flag_is_read_and_cleared() {
    let flagged = sealed(0x404D);
    let frames = [
        &first(100)[..],
        &[
            (READ_ANGLE, sealed(HEALTHY)),
            (READ_DIAGNOSTICS, flagged),
            (READ_ERRORS, sealed(HEALTHY)),
            (READ_DIAGNOSTICS, sealed(0b100)),
        ],
        &[(READ_DIAGNOSTICS, sealed(HEALTHY))],
        &next(120),
    ]
    .concat();
    let mut encoder = mocked(&frames);
    encoder.tick(false).unwrap_err();
    let Err(EncoderError::Interface(errors)) = encoder.tick(false) else {
        panic!("the error flag was overlooked");
    };
    assert!(errors.parity() && !errors.framing() && !errors.invalid_command());
    let speed = encoder.tick(false).unwrap().nut_speed;
    approx::assert_relative_eq!(speed, 10.0 * encoder.resolution(), max_relative = 1.2e-7);
    encoder.release().done();
}

/// A line that is held low reads as angle 0 with even parity and no error flag, one held high as all ones with even parity.
#[test]
fn a_stuck_line_never_gives_a_speed() {
    for answer in [0x0000, 0xFFFF] {
        let sensor = sensor();
        sensor.line.set(Some(answer));
        let mut encoder = MagneticEncoder::new(&sensor, &CONFIGURATION).unwrap();
        for _ in 0..10 {
            match encoder.tick(false) {
                Err(EncoderError::NoAngle(diagnostics)) => assert!(!diagnostics.ready()),
                Err(EncoderError::Interface(errors)) => assert_eq!(errors.bits(), 0x3FFF),
                other => panic!("line at {answer:#06x}: {other:?}"),
            }
        }
    }
}

#[derive(Debug, Default)]
struct Sensor {
    angle: Cell<u16>,
    fails: Cell<bool>,
    /// What a line gives that is held at one level.
    line: Cell<Option<u16>>,
    diagnostics: Cell<u16>,
    pending: Cell<u16>,
    frames: Cell<u32>,
}

impl Sensor {
    fn turned_to(&self, turns: f64) {
        self.angle
            .set((turns * 16384.0).round().rem_euclid(16384.0) as u16);
    }
}

impl ErrorType for &Sensor {
    type Error = ErrorKind;
}

impl SpiDevice for &Sensor {
    fn transaction(&mut self, operations: &mut [Operation<'_, u8>]) -> Result<(), ErrorKind> {
        self.frames.set(self.frames.get() + 1);
        if self.fails.get() {
            return Err(ErrorKind::ModeFault);
        }
        let [Operation::TransferInPlace(bytes)] = operations else {
            panic!("a frame is one exchange of two bytes");
        };
        let command = u16::from_be_bytes([bytes[0], bytes[1]]);
        assert_eq!(command.count_ones() % 2, 0, "command {command:#06x}");
        let answer = self.line.get().unwrap_or(sealed(self.pending.get()));
        bytes.copy_from_slice(&answer.to_be_bytes());
        self.pending.set(match command & 0x3FFF {
            0x3FFF => self.angle.get(),
            0x3FFC => self.diagnostics.get(),
            0x0001 => 0,
            register => panic!("register {register:#06x}"),
        });
        Ok(())
    }
}

fn sensor() -> Sensor {
    Sensor {
        diagnostics: Cell::new(HEALTHY),
        ..Sensor::default()
    }
}

/// An encoder after its first tick, which has no earlier reading.
fn started(sensor: &Sensor) -> MagneticEncoder<&Sensor> {
    let mut encoder = MagneticEncoder::new(sensor, &CONFIGURATION).unwrap();
    encoder.tick(false).unwrap_err();
    encoder
}

/// Over many turns both ways, at every speed up to the largest believed: each speed is within one
/// count of the true one (two roundings of half a count), the mean within that over the whole time.
#[test]
fn constant_speeds_through_many_turns() {
    for gear_ratio in [1.0, -1.0, 3.2] {
        for speed in [-490.0, -120.0, -1.0, 0.0, 0.7, 33.0, 490.0_f64] {
            let sensor = sensor();
            let configuration = EncoderConfiguration {
                gear_ratio,
                tick: 0.5e-3,
                ..CONFIGURATION
            };
            let mut encoder = MagneticEncoder::new(&sensor, &configuration).unwrap();
            let mut sum = 0.0;
            let ticks = 2000;
            for tick in 0..=ticks {
                let time = f64::from(tick) * 0.5e-3;
                sensor.turned_to(speed * f64::from(gear_ratio) * time / std::f64::consts::TAU);
                if tick == 0 {
                    encoder.tick(false).unwrap_err();
                    continue;
                }
                let measured = f64::from(encoder.tick(false).unwrap().nut_speed);
                let resolution = f64::from(encoder.resolution());
                assert!(
                    (measured - speed).abs() <= 1.001 * resolution + 1e-6 * speed.abs(),
                    "gear {gear_ratio}, speed {speed}, tick {tick}: {measured}"
                );
                sum += measured;
            }
            let mean = sum / f64::from(ticks);
            let bound = f64::from(encoder.resolution()) / f64::from(ticks) + 1e-6 * speed.abs();
            assert!((mean - speed).abs() <= 1.001 * bound, "{speed}: {mean}");
            // Two frames a tick, one more at the start.
            assert_eq!(sensor.frames.get(), 2 * (ticks + 1) + 1);
        }
    }
}

/// The largest speed believed here is 500 rad/s, 0.080 turns in a tick. From there to `1 - 0.080` turns
/// in a tick, both ways, half a turn included, no speed comes out.
#[test]
fn beyond_the_largest_speed_no_speed_comes_out() {
    let largest = 500e-3 / std::f64::consts::TAU;
    for percent in 1..=100 {
        let step = largest + (1.0 - 2.0 * largest) * f64::from(percent) / 101.0;
        for direction in [-1.0, 1.0] {
            let sensor = sensor();
            let mut encoder = started(&sensor);
            for tick in 1..20 {
                sensor.turned_to(direction * step * f64::from(tick));
                assert_eq!(
                    encoder.tick(false),
                    Err(EncoderError::TooFast),
                    "{step} turns in a tick"
                );
            }
        }
    }
}

#[test]
fn one_wild_angle_costs_two_ticks() {
    let sensor = sensor();
    let mut encoder = MagneticEncoder::new(&sensor, &CONFIGURATION).unwrap();
    let mut outcomes = Vec::new();
    for angle in [10, 20, 30, 9000, 50, 60] {
        sensor.angle.set(angle);
        outcomes.push(encoder.tick(false).map(|motion| motion.nut_speed));
    }
    let speed = 10.0 * encoder.resolution();
    assert_eq!(outcomes[0], Err(EncoderError::NoEarlierReading));
    assert_eq!(outcomes[2], Ok(speed));
    assert_eq!(outcomes[3], Err(EncoderError::TooFast));
    assert_eq!(outcomes[4], Err(EncoderError::TooFast));
    assert_eq!(outcomes[5], Ok(speed));
}

/// At 500 rad/s and 1 ms three ticks are 0.24 of a turn, four more than a quarter: a gap of two failed
/// ticks is bridged, one of three is not.
#[test]
fn failed_ticks_are_bridged_as_long_as_the_angle_is_unambiguous() {
    for (failed, bridged) in [(1, true), (2, true), (3, false), (1000, false)] {
        let sensor = sensor();
        let mut encoder = MagneticEncoder::new(&sensor, &CONFIGURATION).unwrap();
        let mut turns = 0.0;
        let mut tick = |fails: bool| {
            turns += 0.3e-3 * 1000.0 / std::f64::consts::TAU; // 300 rad/s
            sensor.turned_to(turns);
            sensor.fails.set(fails);
            encoder.tick(true).map(|motion| motion.nut_speed)
        };
        tick(false).unwrap_err();
        tick(false).unwrap();
        for _ in 0..failed {
            assert_eq!(tick(true), Err(EncoderError::Bus(ErrorKind::ModeFault)));
        }
        let after = tick(false);
        if bridged {
            // Derived: both angles are whole counts, and a count in two ticks is 0.3835 / 2 = 0.192 rad/s.
            approx::assert_abs_diff_eq!(after.unwrap(), 300.0, epsilon = 0.2);
        } else {
            assert_eq!(after, Err(EncoderError::NoEarlierReading));
        }
        // Derived: a count over one tick, 0.3835 rad/s.
        approx::assert_abs_diff_eq!(tick(false).unwrap(), 300.0, epsilon = 0.4);
    }
}

#[test]
fn an_angle_that_stands_while_the_rotor_turns_is_stuck() {
    let sensor = sensor();
    let mut encoder = started(&sensor);
    for _ in 0..1000 {
        assert_eq!(encoder.tick(false).unwrap().nut_speed, 0.0); // standstill
    }
    sensor.angle.set(1);
    for _ in 0..3 {
        encoder.tick(true).unwrap();
    }
    for ticks in [3, 4] {
        assert_eq!(encoder.tick(true), Err(EncoderError::Stuck { ticks }));
    }
    sensor.angle.set(2);
    assert!(encoder.tick(true).is_ok());
}

#[test]
fn a_rotor_that_begins_to_turn_is_not_stuck() {
    let sensor = sensor();
    let mut encoder = started(&sensor);
    for round in 0..3 {
        for _ in 0..1000 {
            assert_eq!(encoder.tick(false).unwrap().nut_speed, 0.0);
        }
        if round == 1 {
            sensor.fails.set(true);
            encoder.tick(false).unwrap_err();
            encoder.tick(false).unwrap_err();
            sensor.fails.set(false);
        }
        assert_eq!(encoder.tick(true).unwrap().nut_speed, 0.0);
        assert_eq!(encoder.tick(true).unwrap().nut_speed, 0.0);
        if round == 2 {
            assert_eq!(encoder.tick(true), Err(EncoderError::Stuck { ticks: 3 }));
        }
    }
    sensor.angle.set(1);
    encoder.tick(true).unwrap();
    encoder.tick(true).unwrap();
    sensor.fails.set(true);
    encoder.tick(true).unwrap_err();
    sensor.fails.set(false);
    assert_eq!(encoder.tick(true), Err(EncoderError::Stuck { ticks: 3 }));
}

#[test]
fn an_overflow_in_the_sensor_is_no_angle_and_a_weak_magnet_is_one() {
    let sensor = sensor();
    let mut encoder = started(&sensor);
    sensor.diagnostics.set(HEALTHY | 1 << 9);
    encoder.tick(false).unwrap(); // still the diagnostics asked for before
    let Err(EncoderError::NoAngle(diagnostics)) = encoder.tick(false) else {
        panic!("the overflow was overlooked");
    };
    assert!(diagnostics.overflow());
    sensor.diagnostics.set(HEALTHY | 1 << 11);
    let motion = encoder.tick(false).unwrap();
    assert!(motion.diagnostics.magnet_too_weak() && !motion.diagnostics.magnet_too_strong());
}

/// The step response of the smoothing, `1 - (1 - g)^n` with `g = tick / (smoothing_time + tick)`.
#[test]
fn smoothing_is_of_first_order() {
    let sensor = sensor();
    let configuration = EncoderConfiguration {
        smoothing_time: 9e-3,
        ..CONFIGURATION
    };
    let mut encoder = MagneticEncoder::new(&sensor, &configuration).unwrap();
    encoder.tick(false).unwrap_err();
    assert_eq!(encoder.tick(false).unwrap().nut_speed, 0.0);
    for n in 1..50_u16 {
        sensor.angle.set(100 * n);
        let expected = 100.0 * encoder.resolution() * (1.0 - 0.9_f32.powi(n.into()));
        // Measured: 3.0e-7, of which 0.9 rounded is most where 1 - 0.9 is left.
        approx::assert_relative_eq!(
            encoder.tick(false).unwrap().nut_speed,
            expected,
            max_relative = 9e-7
        );
    }
}

#[test]
fn a_wrong_encoder_configuration_is_named() {
    #[rustfmt::skip]
    assert_refused(
        &CONFIGURATION,
        |configuration| MagneticEncoder::new(&sensor(), configuration).map(drop),
        &[
            ("tick", |c, x| c.tick = x, &[0.0, -1e-3, 2.0]),
            ("gear_ratio", |c, x| c.gear_ratio = x, &[0.0, -0.001, 101.0]),
            // A quarter of a turn in 1 ms is 1570.8 rad/s.
            ("largest_nut_speed", |c, x| c.largest_nut_speed = x, &[0.0, -1.0, 1571.0]),
            ("smoothing_time", |c, x| c.smoothing_time = x, &[-1e-9, 11.0]),
        ],
    );
}

const STAGE: FeedForwardConfiguration = FeedForwardConfiguration {
    full_torque: 4.0,
    largest_torque: 2.0,
    share: 0.5,
    reaction: FaultReaction::NeutralOnAnyFault,
};

fn outputs(friction_torque: f32, faults: Faults) -> Outputs {
    Outputs {
        friction_torque,
        load_torque: 0.0,
        efficiency: 0.9,
        regime: Regime::Driving,
        faults,
    }
}

/// A channel of any scale, which no duty may exceed.
pub struct Channel {
    scale: u16,
}

impl Channel {
    pub const fn of(scale: u16) -> Self {
        Self { scale }
    }
}

impl embedded_hal::pwm::ErrorType for Channel {
    type Error = Infallible;
}

impl embedded_hal::pwm::SetDutyCycle for Channel {
    fn max_duty_cycle(&self) -> u16 {
        self.scale
    }

    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Infallible> {
        assert!(duty <= self.scale);
        Ok(())
    }
}

fn puts(scale: u16, duty: u16) -> [Pwm; 2] {
    [Pwm::max_duty_cycle(scale), Pwm::set_duty_cycle(duty)]
}

fn stage(
    expected: &[Pwm],
    configuration: &FeedForwardConfiguration,
) -> FrictionFeedForward<PwmMock> {
    FrictionFeedForward::new(PwmMock::new(expected), configuration).unwrap()
}

/// Half the scale is no torque; 1 N m of friction at a share of a half is an eighth of 4 N m of either half; 2 N m is the authority.
#[test]
fn torque_is_offset_binary_and_saturates() {
    let expected = [
        (0.0, 500, false),
        (1.0, 563, false), // 562.5, away from zero
        (-1.0, 438, false),
        (4.0, 750, false),
        (4.001, 750, true),
        (1e30, 750, true),
        (f32::MAX, 750, true),
        (-1e30, 250, true),
    ];
    let transactions: Vec<_> = expected
        .iter()
        .flat_map(|case| puts(1000, case.1))
        .collect();
    let mut stage = stage(&transactions, &STAGE);
    for (torque, duty, saturated) in expected {
        let applied = stage.apply(&outputs(torque, Faults::NONE)).unwrap();
        assert_eq!(applied.duty, duty, "{torque}");
        assert_eq!(applied.saturated, saturated, "{torque}");
        assert!(!applied.neutral);
    }
    stage.release().done();
}

const FLAGS: [Faults; 5] = [
    Faults::SPEED_NOT_FINITE,
    Faults::LOAD_NOT_FINITE,
    Faults::SPEED_RANGE,
    Faults::LOAD_RANGE,
    Faults::FRICTION_LIMIT,
];

#[test]
fn flagged_outputs_and_no_numbers_give_the_neutral_duty() {
    let cases: Vec<_> = FLAGS
        .map(|flag| outputs(1.0, flag))
        .into_iter()
        .chain(
            [f32::NAN, f32::INFINITY, f32::NEG_INFINITY]
                .map(|torque| outputs(torque, Faults::NONE)),
        )
        .collect();
    let transactions: Vec<_> = cases.iter().flat_map(|_| puts(999, 500)).collect();
    let mut strict = stage(&transactions, &STAGE);
    for case in &cases {
        assert!(strict.apply(case).unwrap().neutral, "{case:?}");
    }
    strict.release().done();

    let passing = FeedForwardConfiguration {
        reaction: FaultReaction::default(),
        ..STAGE
    };
    assert_eq!(passing.reaction, FaultReaction::LimitedValuesPass);
    let expected = [500, 500, 563, 563, 563];
    // Accuracy alone takes no torque away, whatever the reaction to faults is.
    for configuration in [STAGE, passing] {
        let mut stage = stage(&puts(1000, 563), &configuration);
        let applied = stage.apply(&outputs(1.0, Faults::BEYOND_MODEL)).unwrap();
        assert_eq!((applied.duty, applied.neutral), (563, false));
        stage.release().done();
    }
    let transactions: Vec<_> = expected.iter().flat_map(|&duty| puts(1000, duty)).collect();
    let mut stage = stage(&transactions, &passing);
    for (flag, duty) in FLAGS.into_iter().zip(expected) {
        let applied = stage.apply(&outputs(1.0, flag)).unwrap();
        assert_eq!(
            (applied.duty, applied.neutral),
            (duty, duty == 500),
            "{flag:?}"
        );
    }
    stage.release().done();
}

proptest! {
    /// Whatever the model outputs, the duty stays within the authority about the middle, and is neutral
    /// where a flag asks for it or the torque is NaN or infinite.
    #[test]
    fn the_authority_bounds_every_duty(
        bits: u32,
        flags in 0_u8..128,
        scale in prop_oneof![0_u16..4, any::<u16>()],
        full in 1e-6_f32..1e6,
        authority in 0.0_f32..=1.0,
        share in 0.0_f32..=1.0,
        limited_values_pass: bool,
    ) {
        let mut faults = Faults::NONE;
        for flag in FLAGS.into_iter().chain([Faults::BEYOND_MODEL]) {
            if u16::from(flags) & flag.bits() != 0 {
                faults |= flag;
            }
        }
        let configuration = FeedForwardConfiguration {
            full_torque: full,
            largest_torque: authority * full,
            share,
            reaction: if limited_values_pass {
                FaultReaction::LimitedValuesPass
            } else {
                FaultReaction::NeutralOnAnyFault
            },
        };
        let mut stage = FrictionFeedForward::new(Channel::of(scale), &configuration).unwrap();
        let torque = f32::from_bits(bits);
        let Ok(()) = stage.neutral();
        let Ok(applied) = stage.apply(&outputs(torque, faults));
        let middle = 0.5 * f64::from(scale);
        let away = (f64::from(applied.duty) - middle).abs();
        // Half a count of rounding, and what f32 makes of the product.
        let reach = f64::from(authority) * middle;
        prop_assert!(away <= reach * (1.0 + 1e-6) + 0.51, "{away} counts of {reach}");
        let lost = flags & 3 != 0 || (faults.faulty() && !limited_values_pass);
        prop_assert!(applied.neutral || !lost);
        prop_assert!(applied.neutral || torque.is_finite());
        prop_assert!(!applied.neutral || away <= 0.5);
    }
}

#[test]
fn an_error_of_the_channel_is_surfaced() {
    let failure = MockError::Io(std::io::ErrorKind::NotConnected);
    let mut stage = stage(
        &[
            Pwm::max_duty_cycle(1000),
            Pwm::set_duty_cycle(500).with_error(failure.clone()),
        ],
        &STAGE,
    );
    assert_eq!(stage.apply(&outputs(0.0, Faults::NONE)), Err(failure));
    stage.release().done();
}

#[test]
fn a_wrong_stage_configuration_is_named() {
    assert_refused(
        &STAGE,
        |configuration| {
            let mut unused = PwmMock::new(&[]);
            let stage = FrictionFeedForward::new(unused.clone(), configuration).map(drop);
            unused.done();
            stage
        },
        &[
            ("full_torque", |c, x| c.full_torque = x, &[0.0, -1.0, 2e6]),
            ("largest_torque", |c, x| c.largest_torque = x, &[-1.0, 4.1]),
            ("share", |c, x| c.share = x, &[-0.1, 1.1]),
        ],
    );
}

/// Encoder, model and stage as one loop: friction pushes the way the nut turns, and a failed bus leaves
/// the bridge neutral in the same tick.
#[test]
fn a_failed_bus_leaves_the_bridge_neutral() {
    let sensor = sensor();
    let mut encoder = MagneticEncoder::new(&sensor, &CONFIGURATION).unwrap();
    let mut model = FrictionModel::<ClosedFormScrew>::new(&ClosedFormScrewConfiguration {
        design: BallScrew::new(DISSERTATION_DESIGNS[2].parameters).unwrap(),
        clearance: Clearance::ZERO,
        loaded_balls: 71,
        ..closed_form(FrictionBranch::Rolling)
    })
    .unwrap();
    let mut stage = FrictionFeedForward::new(Channel::of(8400), &STAGE).unwrap();
    for tick in 0..40_u16 {
        sensor.angle.set((100 * tick) % 16384);
        sensor.fails.set(tick == 20);
        let nut_speed = encoder
            .tick(true)
            .map_or(f32::NAN, |motion| motion.nut_speed);
        let outputs = model.step(screw_inputs(nut_speed, 8_000.0));
        let Ok(applied) = stage.apply(&outputs);
        if tick == 0 || tick == 20 {
            assert!(applied.neutral && applied.duty == 4200, "tick {tick}");
        } else {
            assert!(
                !applied.neutral && applied.duty > 4200,
                "tick {tick}: {applied:?}"
            );
        }
    }
}
