//! Faults of sensors and of the configuration: flagged within the tick, over within the next, never kept.

use crate::recorded;
use epas_friction::ball::pressed::BallNode;
use epas_friction::scene::FoldedBall;
use epas_friction::{
    BallScrew, Clearance, ClosedFormScrew, DeviationMap, Faults, FrictionBranch, FrictionModel,
    Inputs, LinearBearing, LinearBearingTrain, LinearInputs,
};
use epas_reference::promises::PROMISES;
use epas_testkit::absurd::{EDGES, Trial, sound_train};
use epas_testkit::gears;
use epas_testkit::measured;
use epas_testkit::random::Random;

const COMMAND: &str = "cargo test -p epas-reference --test all scenes::faults -- --nocapture";

type Screw = gears::UncagedScrew<{ gears::SCREW_BALLS }>;
type Rail = LinearBearingTrain<{ gears::LINEAR_BALLS }>;

/// Each flag has the bit that the README's table says.
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

/// What sensors do when they fail.
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
    // A train keeps where its balls and the screw are. After a failure of the speed these differ from
    // where they would be, as after a start at another angle; friction stays what it can be at any angle.
    // Speed deviations that are larger than their mean make friction between balls vary by a factor of
    // some two with the angle, which bounds the band.
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
        let inputs = Inputs {
            nut_speed: 300.0 * speed,
            axial_load: 9e3 * load,
        };
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
        // An absolute sensor tells where the screw is; the balls stay where they are.
        assert_ne!(phase(&model), phase(&ahead));
        let balls = model.state().circuit.train;
        let angle = speed * tick * (1000 + missed) as f32;
        model.set_nut_angle(angle);
        ahead.set_nut_angle(angle);
        assert_eq!(phase(&model), phase(&ahead));
        assert_eq!(model.state().circuit.train, balls);
        // `reset` takes both back to the start.
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
fn a_time_step_that_is_none_is_refused() {
    for tick in [0.0, -0.0, -1e-4, f32::NAN, f32::INFINITY, 1e-45, 1e9] {
        let mut screw = gears::uncaged();
        screw.tick = tick;
        let error = FrictionModel::<Screw>::new(&screw).unwrap_err();
        assert_eq!(error.field(), "tick");
        let mut rail = gears::linear();
        rail.tick = tick;
        let error = FrictionModel::<Rail>::new(&rail).unwrap_err();
        assert_eq!(error.field(), "tick");
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

/// One to three bits of a number turned over.
fn corrupted(random: &mut Random, value: &mut f32) {
    let mut bits = value.to_bits();
    for _ in 0..=random.below(3) {
        bits ^= 1 << random.below(32);
    }
    *value = f32::from_bits(bits);
    if random.one_in(16) {
        *value = random.of(&EDGES);
    }
}

/// Refused, or a model that keeps all promises.
fn refused_or_sound<S: Trial>(configuration: &S::Configuration, random: &mut Random) -> bool {
    let Ok(mut model) = FrictionModel::<S>::new(configuration) else {
        return true;
    };
    let mut sensors = [0.0; 3];
    for tick in 0..40 {
        sensors = S::sensors(random, configuration, sensors);
        let outputs = model.step(S::inputs(sensors));
        S::check(configuration, sensors, &outputs)
            .and_then(|()| S::check_state(&model))
            .unwrap_or_else(|error| {
                panic!(
                    "{}, tick {tick}, {sensors:?}: {error}\n{configuration:?}",
                    S::name()
                )
            });
    }
    false
}

/// One of these numbers.
fn corrupt_one(random: &mut Random, fields: &mut [&mut f32]) {
    let which = random.below(fields.len());
    corrupted(random, fields[which]);
}

/// Numbers of a folded ball, of all kinds.
fn folded_fields<const NODES: usize>(folded: &mut FoldedBall<NODES>) -> Vec<&mut f32> {
    let BallNode {
        friction,
        branches: [[first, .., last], [.., other]],
        neighbours: [[_, neighbours, ..], _],
        ..
    } = &mut folded.law.nodes[0];
    let [screw, nut] = &mut folded.law.deviations;
    vec![
        &mut folded.friction,
        &mut folded.lead,
        &mut folded.ball_radius,
        &mut folded.path_radius,
        &mut folded.speed,
        &mut folded.reversal_speed,
        &mut folded.limits.nut_speed,
        &mut folded.limits.axial_load,
        &mut folded.limits.friction_torque,
        screw,
        nut,
        &mut folded.law.lift_off,
        friction,
        &mut first.load,
        &mut first.per_width,
        &mut first.numbers.free[0],
        &mut first.numbers.impedance[0],
        &mut last.load,
        &mut last.numbers.torque[3],
        &mut last.numbers.slope,
        &mut other.numbers.free[5],
        &mut other.numbers.impedance[2],
        &mut neighbours.numbers.nodes[1].push[0],
        &mut neighbours.numbers.nodes[2].impedance[1],
        &mut neighbours.numbers.nodes[0].torque[0],
        &mut neighbours.numbers.outward[2],
        &mut neighbours.numbers.outward_torque,
    ]
}

#[test]
fn corrupted_configurations_are_refused_or_harmless() {
    const COUNT: u32 = 30_000;
    let mut random = Random(3);
    let mut refused = 0;
    for count in 0..COUNT {
        let mut screw = gears::uncaged();
        // What is folded stays in memory for as long as the program runs: 15 kB each.
        if count % 10 == 0 {
            screw.folded = gears::changed(screw.folded, |folded| {
                corrupt_one(&mut random, &mut folded_fields(folded));
            });
        } else {
            corrupt_one(
                &mut random,
                &mut [
                    &mut screw.ball_friction,
                    &mut screw.turns,
                    &mut screw.return_length,
                    &mut screw.tick,
                ],
            );
        }
        refused += u32::from(refused_or_sound::<Screw>(&screw, &mut random));

        let mut caged = gears::closed_form(FrictionBranch::Rolling);
        let mut parameters = *caged.design.parameters();
        let mut gap = caged.clearance.gap();
        let fields: [&mut f32; 8] = [
            &mut parameters.pitch_radius,
            &mut parameters.lead,
            &mut parameters.ball_radius,
            &mut parameters.contact_angle,
            &mut caged.friction,
            &mut caged.rolling_tangent,
            &mut gap,
            &mut caged.reversal_speed,
        ];
        let which = random.below(fields.len());
        for (index, field) in fields.into_iter().enumerate() {
            if index == which {
                corrupted(&mut random, field);
            }
        }
        if let (Ok(clearance), Ok(design)) = (Clearance::new(gap), BallScrew::new(parameters)) {
            (caged.clearance, caged.design) = (clearance, design);
            refused += u32::from(refused_or_sound::<ClosedFormScrew>(&caged, &mut random));
        } else {
            refused += 1;
        }

        let mut rail = gears::linear();
        let mut parameters = *rail.bearing.parameters();
        let fields: [&mut f32; 10] = [
            &mut parameters.ball_radius,
            &mut parameters.contact_angle,
            &mut rail.friction,
            &mut rail.loaded_length,
            &mut rail.return_length,
            &mut rail.wavelength,
            &mut rail.reversal_speed,
            &mut rail.tick,
            &mut rail.limits.speed,
            &mut rail.limits.load,
        ];
        let which = random.below(fields.len());
        for (index, field) in fields.into_iter().enumerate() {
            if index == which {
                corrupted(&mut random, field);
            }
        }
        match LinearBearing::new(parameters) {
            Ok(bearing) => {
                rail.bearing = bearing;
                refused += u32::from(refused_or_sound::<Rail>(&rail, &mut random));
            }
            Err(_) => refused += 1,
        }
    }
    println!("{refused} refused");
    recorded::print(
        "configurations with corrupted bits",
        (3 * COUNT).into(),
        COMMAND,
    );
    // Most turned bits are low ones of the mantissa; if none were refused the test would be blind.
    assert!(refused > COUNT / 10);
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
            let inputs = Inputs {
                nut_speed: sign * 200.0,
                axial_load: 5e3,
            };
            let outputs = screw.step(inputs);
            assert!(outputs.friction_torque * sign > 0.0 && !outputs.faults.faulty());
            even.step(inputs);
            let outputs = rail.step(LinearInputs {
                speed: sign,
                normal_load: 5e3,
                side_load: 1e3,
            });
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
