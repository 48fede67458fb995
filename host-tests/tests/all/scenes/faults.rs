//! Faults of sensors and of the configuration: flagged within the tick, over within the next, never kept.

use crate::recorded;
use epas_friction::{DeviationMap, Faults, FrictionModel, LinearBearingTrain};
use epas_reference::promises::PROMISES;
use epas_testkit::gears;
use epas_testkit::gears::{linear_inputs, screw_inputs};
use epas_testkit::measured;
use epas_testkit::random::Random;
use epas_testkit::random_scenes::{Trial, sound_train};

const COMMAND: &str = "cargo test -p epas-reference --test all scenes::faults -- --nocapture";

type Screw = gears::UncagedScrew<{ gears::SCREW_BALLS }>;
type Rail = LinearBearingTrain<{ gears::LINEAR_BALLS }>;

#[test]
fn flags_are_bits() {
    for (flag, bit) in [
        (Faults::SPEED_NOT_FINITE, 0),
        (Faults::LOAD_NOT_FINITE, 1),
        (Faults::SPEED_RANGE, 2),
        (Faults::LOAD_RANGE, 3),
        (Faults::FRICTION_LIMIT, 4),
        (Faults::BEYOND_MODEL, 5),
        (Faults::FORCES_NOT_HELD, 6),
        (Faults::ANGLE_NOT_VALID, 7),
        (Faults::TEMPERATURE_RANGE, 8),
        (Faults::LOAD_STALE, 9),
        (Faults::TEMPERATURE_STALE, 10),
    ] {
        assert_eq!(flag.bits(), 1 << bit);
        let accuracy = Faults::BEYOND_MODEL | Faults::FORCES_NOT_HELD;
        assert_eq!(flag.faulty(), !accuracy.contains(flag));
        assert_eq!(flag.doubtful(), flag != Faults::FORCES_NOT_HELD);
    }
}

/// Speed and load of a weave with reversals: one a second at 10 kHz.
fn weave(tick: u32) -> (f32, f32) {
    let phase = f64::from(tick) * 1e-4;
    (
        (phase * std::f64::consts::PI).sin() as f32,
        (phase * 7.3).cos() as f32,
    )
}

const FAILURES: [&str; 7] = [
    "NaN",
    "infinite",
    "stuck",
    "spike",
    "sign flipped",
    "overload",
    "subnormal",
];

/// The sensors of a tick under a failure of one of them, and whether it must be flagged.
fn failing(failure: &str, which: usize, sound: [f32; 3], limits: [f32; 3]) -> ([f32; 3], bool) {
    let mut sensors = sound;
    let (value, flagged) = match failure {
        "NaN" => (f32::NAN, true),
        "infinite" => (f32::NEG_INFINITY, true),
        "stuck" => (0.37 * limits[which], false),
        "spike" => (-limits[which], false),
        "sign flipped" => (-sound[which], false),
        "overload" => (1e3 * limits[which], true),
        _ => (1e-42, false),
    };
    sensors[which] = value;
    (sensors, flagged)
}

/// Runs a weave beside its copy that suffers every failure of every sensor in turn, for 20 ticks each.
///
/// Returns failures injected. In each of their ticks outputs are checked against everything a scene
/// promises; what must be flagged is flagged; and in the first sound tick afterwards no flag is left.
fn suffer<S: Trial>(
    configuration: &S::Configuration,
    limits: [f32; 3],
    sensors: usize,
    faults: impl Fn(&S::Outputs) -> Faults,
    after: impl Fn(&S::Outputs, &S::Outputs, u32),
) -> u32 {
    let mut sound_model = FrictionModel::<S>::new(configuration).unwrap();
    let mut model = FrictionModel::<S>::new(configuration).unwrap();
    let mut injected = 0;
    let mut tick = 0;
    while tick < 40_000 {
        let (speed, load) = weave(tick);
        let sound = [
            0.4 * speed * limits[0],
            0.5 * load * limits[1],
            0.2 * load * limits[2],
        ];
        let episode = tick / 40;
        let which = episode as usize % sensors;
        let failure = FAILURES[(episode as usize / sensors) % FAILURES.len()];
        let broken = tick % 40 >= 20;
        let (given, flagged) = if broken {
            failing(failure, which, sound, limits)
        } else {
            (sound, false)
        };
        injected += u32::from(broken);
        let expected = sound_model.step(S::inputs(sound));
        let outputs = model.step(S::inputs(given));
        let line = format!(
            "{}, tick {tick}: {failure} of sensor {which}: {given:?}",
            S::name()
        );
        S::check(configuration, given, &outputs).unwrap_or_else(|error| panic!("{line}: {error}"));
        S::check_state(&model).unwrap_or_else(|error| panic!("{line}: {error}"));
        assert_eq!(
            (faults(&outputs).bits()
                & !(Faults::FRICTION_LIMIT | Faults::BEYOND_MODEL | Faults::FORCES_NOT_HELD)
                    .bits())
                != 0,
            flagged,
            "{line}"
        );
        if !broken {
            after(&outputs, &expected, tick % 40);
        }
        tick += 1;
    }
    recorded::print(
        &format!("ticks with a failing sensor, {}", S::name()),
        injected.into(),
        COMMAND,
    );
    injected
}

#[test]
fn a_caged_screw_recovers_at_once() {
    let limits = gears::LIMITS;
    suffer::<gears::CagedScrew>(
        &gears::caged(),
        [limits.nut_speed, limits.axial_load, 0.0],
        2,
        |outputs| outputs.faults,
        // Nothing is kept from tick to tick: the first sound tick is that of a model that never failed.
        |outputs, expected, _| assert_eq!(outputs, expected),
    );
}

#[test]
fn trains_recover_at_once_but_for_where_the_balls_are() {
    // A train keeps where its balls and the screw are. After a failure of the speed these differ from where they would be, as after a start
    // at another angle; friction stays what it can be at any angle. Speed deviations that are larger than their mean make friction between
    // balls vary by a factor of some two with the angle, which bounds the band.
    let limits = gears::LIMITS;
    let friction = |a: f32, b: f32, line: u32| {
        measured::assert_at(
            "groove friction after a failure",
            (a - b) / (b.abs() + 2e-3),
            format_args!("{a} N m where a model that never failed has {b} ({line} ticks after)"),
        );
    };
    suffer::<Screw>(
        &gears::uncaged(),
        [limits.nut_speed, limits.axial_load, 0.0],
        2,
        |outputs| outputs.faults,
        |outputs, expected, since| {
            friction(outputs.groove_torque, expected.groove_torque, since);
        },
    );
    suffer::<Rail>(
        &gears::linear(),
        [3.0, 20_000.0, 20_000.0],
        3,
        |outputs| outputs.faults,
        |outputs, expected, since| {
            friction(outputs.groove_force, expected.groove_force, since);
        },
    );
}

#[test]
fn a_lost_sensor_stops_the_state() {
    // A tick without speed or load is a tick that did not happen.
    let mut random = Random(5);
    let mut model = FrictionModel::<Screw>::new(&gears::uncaged()).unwrap();
    for tick in 0..20_000_u32 {
        let (speed, load) = weave(tick);
        let inputs = screw_inputs(300.0 * speed, 9e3 * load);
        let mut lost = inputs;
        match random.below(3) {
            0 => lost.nut_speed = f32::NAN,
            1 => lost.axial_load = f32::INFINITY,
            _ => lost.axial_load = f32::NAN,
        }
        let mut without = model;
        let outputs = model.step(lost);
        assert!(outputs.faults.faulty() && outputs.friction_torque == 0.0);
        assert_eq!(model.state().circuit.train, without.state().circuit.train);
        assert_eq!(model.step(inputs), without.step(inputs), "tick {tick}");
        assert_eq!(model.faulted_ticks(), 0);
    }
}

/// Runs a model at one speed and load, loses the speed for `missed` ticks, and holds it to what the
/// documentation of the scenes with a train says: flagged and finite within `TICKS_TO_FLAG`, unflagged within
/// `TICKS_TO_RECOVER` of the first sound tick, and from then on the model that never failed, `missed` ticks
/// ago: the balls and the phase of the deviations stand back by the missed travel, and by nothing else.
///
/// Returns the model and the one that never failed, at the same tick.
fn lose_the_speed<S: Trial<State: std::fmt::Debug>>(
    configuration: &S::Configuration,
    sound: [f32; 3],
    missed: u32,
    faults: impl Fn(&S::Outputs) -> Faults,
) -> (FrictionModel<S>, FrictionModel<S>)
where
    FrictionModel<S>: Copy,
{
    let mut lost = sound;
    lost[0] = f32::NAN;
    let mut never_failed = FrictionModel::<S>::new(configuration).unwrap();
    let mut model = never_failed;
    for _ in 0..500 {
        never_failed.step(S::inputs(sound));
        model.step(S::inputs(sound));
    }
    let mut ahead = never_failed;
    for tick in 0..missed {
        ahead.step(S::inputs(sound));
        let outputs = model.step(S::inputs(lost));
        S::check(configuration, lost, &outputs).unwrap();
        assert!(
            faults(&outputs).faulty() || tick + 1 < PROMISES.ticks_to_flag,
            "tick {tick} is not flagged"
        );
    }
    for tick in 0..500 {
        ahead.step(S::inputs(sound));
        let outputs = model.step(S::inputs(sound));
        let expected = never_failed.step(S::inputs(sound));
        assert!(
            !faults(&outputs).faulty() || tick + 1 < PROMISES.ticks_to_recover,
            "still flagged {tick} ticks after"
        );
        assert_eq!(S::numbers(&outputs), S::numbers(&expected), "tick {tick}");
        let debug = |model: &FrictionModel<S>| format!("{:?}", model.state());
        assert_eq!(debug(&model), debug(&never_failed), "tick {tick}");
    }
    (model, ahead)
}

fn phase<S: Trial<State: std::fmt::Debug>>(model: &FrictionModel<S>) -> String {
    gears::printed_phase(model.state())
}

#[test]
fn recovery_takes_a_tick_and_leaves_the_missed_travel() {
    for missed in [1, 7, 300] {
        let screw = gears::uncaged();
        let (speed, tick) = (150.0, screw.tick);
        let (mut model, mut ahead) =
            lose_the_speed::<Screw>(&screw, [speed, 6e3, 0.0], missed, |outputs| outputs.faults);
        assert_ne!(phase(&model), phase(&ahead));
        let balls = model.state().circuit.train;
        let angle = speed * tick * (1000 + missed) as f32;
        model.set_nut_angle(angle);
        ahead.set_nut_angle(angle);
        assert_eq!(phase(&model), phase(&ahead));
        assert_eq!(model.state().circuit.train, balls);
        model.reset();
        ahead.reset();
        assert_eq!(model.state(), ahead.state());

        let rail = gears::linear();
        let (mut model, mut ahead) =
            lose_the_speed::<Rail>(&rail, [1.0, 5e3, 1e3], missed, |outputs| outputs.faults);
        assert_ne!(phase(&model), phase(&ahead));
        let balls = model.state().circuit.train;
        let position = rail.tick * (1000 + missed) as f32;
        model.set_carriage_position(position);
        ahead.set_carriage_position(position);
        assert_eq!(phase(&model), phase(&ahead));
        assert_eq!(model.state().circuit.train, balls);
        model.set_carriage_position(f32::NAN);
        ahead.set_carriage_position(0.0);
        assert_eq!(phase(&model), phase(&ahead));

        lose_the_speed::<gears::CagedScrew>(
            &gears::caged(),
            [150.0, 6e3, 0.0],
            missed,
            |outputs| outputs.faults,
        );
    }
}

#[test]
fn ticks_from_a_microsecond_to_ten_milliseconds() {
    for (tick, fastest) in [(1e-6, 500.0), (1e-5, 500.0), (1e-3, 400.0), (1e-2, 40.0)] {
        let mut screw = gears::uncaged();
        screw.tick = tick;
        screw.folded = gears::changed(screw.folded, |folded| folded.limits.nut_speed = fastest);
        let mut model = FrictionModel::<Screw>::new(&screw).unwrap();
        for step in 0..20_000 {
            let (speed, load) = weave(step);
            let sensors = [fastest * speed, 9e3 * load, 0.0];
            let outputs = model.step(Screw::inputs(sensors));
            Screw::check(&screw, sensors, &outputs).unwrap();
            sound_train(&model.state().circuit.train).unwrap();
        }
    }
}

#[test]
fn a_reversal_every_tick_is_even() {
    static NONE: DeviationMap = DeviationMap::NONE;
    let mut screw = FrictionModel::<Screw>::new(&gears::uncaged()).unwrap();
    let mut rail = FrictionModel::<Rail>::new(&gears::linear()).unwrap();
    let mut even = FrictionModel::<Screw>::new(&gears::UncagedConfiguration {
        screw_deviation: &NONE,
        nut_deviation: &NONE,
        ..gears::uncaged()
    })
    .unwrap();
    let start: Vec<u32> = even.state().circuit.train.positions().collect();
    for _ in 0..100_000 {
        for sign in [1.0, -1.0] {
            let inputs = screw_inputs(sign * 200.0, 5e3);
            let outputs = screw.step(inputs);
            assert!(outputs.friction_torque * sign > 0.0 && !outputs.faults.faulty());
            even.step(inputs);
            let outputs = rail.step(linear_inputs(sign, 5e3, 1e3));
            assert!(outputs.friction_force * sign > 0.0 && !outputs.faults.faulty());
        }
    }
    sound_train(&screw.state().circuit.train).unwrap();
    sound_train(&rail.state().circuit.train).unwrap();
    // With deviations balls wander: a load that does not turn with the speed lays them against other
    // flanks. Without, they stay where they are.
    for (before, now) in start.iter().zip(even.state().circuit.train.positions()) {
        let moved = now.wrapping_sub(*before).cast_signed();
        assert!(moved.unsigned_abs() <= 2, "{moved} units");
    }
}
