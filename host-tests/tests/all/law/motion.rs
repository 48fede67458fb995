//! The turn between two readings: across ends and gaps, of bad readings; and the play.

use std::f64::consts::TAU;

use epas_friction::law::motion::{
    CountReading, CountSensor, CountSensorParameters, Deadband, NutAngle, Play, PlayState,
    SpeedOverTick, Turn, WrappedAngle, WrappedAngleParameters,
};
use epas_reference::promises;

use crate::remembering::{counter, wrapped};
use epas_testkit::errors::Errors;
use epas_testkit::random::Random;

/// A random walk of counts, some of them across the end of the counter: every turn is the count, rounded once.
#[test]
fn counts_are_exact_across_the_end() {
    let mut random = Random(1);
    let mut errors = Errors::default();
    for period in [2, 3, 1000, 16_384, 16_385, 1 << 31, u32::MAX, 0] {
        let whole = if period == 0 {
            1_i64 << 32
        } else {
            i64::from(period)
        };
        let sensor = counter(
            period,
            1e-6,
            1e-6_f32.max(whole as f32 * 0.49e-6).min(1000.0),
        );
        let (mut state, mut count) = (CountSensor::FRESH, whole - 1);
        assert_eq!(sensor.turn(&mut state, count as u32), Turn::Measured(0.0));
        for _ in 0..20_000 {
            let most = (whole as f64 * 0.48).max(0.0);
            let step = random.between(-most, most) as i64;
            count = (count + step).rem_euclid(whole);
            let turn = sensor.turn(&mut state, count as u32);
            // In f32 as the counter is in counts: the constant's own rounding is not the difference's.
            let exact = step as f64 * f64::from(1e-6_f32);
            if exact.abs() < 1000.0 {
                let relative = if step == 0 {
                    f64::from(turn.angle())
                } else {
                    f64::from(turn.angle()) / exact - 1.0
                };
                assert!(turn.is_measured());
                // Derived: the product has one rounding of 6e-8, and beyond 2^24 counts these have one, too. Measured: 1.15e-7.
                assert!(relative.abs() < 1.2e-7);
                if step.abs() < 1 << 24 {
                    errors.add_case(relative, || format!("{step}"));
                }
            } else {
                assert_eq!(turn, Turn::Limited(1000_f32.copysign(exact as f32)));
            }
        }
    }
    errors.assert_promised(promises::of("turn_of_counts"));
}

#[test]
fn a_counter_of_all_bits_overflows_without_a_jump() {
    const COUNT: f32 = 1.0 / 1024.0;
    let sensor = counter(0, -COUNT, 1.0);
    let mut state = CountSensor::FRESH;
    for (reading, turn) in [
        (u32::MAX - 1, 0.0),
        (3, -5.0 * COUNT),
        (u32::MAX, 4.0 * COUNT),
        (0x7fff_ffff, 1.0),
    ] {
        assert_eq!(sensor.turn(&mut state, reading).angle(), turn, "{reading}");
    }
}

#[test]
fn gaps_are_spanned() {
    let sensor = counter(16_384, 1e-3, 1.0);
    let mut state = CountSensor::FRESH;
    assert_eq!(sensor.turn(&mut state, 20_000), Turn::Unknown);
    assert_eq!(state, CountSensor::FRESH);
    sensor.turn(&mut state, 16_300);
    for bad in [16_384, u32::MAX, 99_999] {
        let before: CountReading = state;
        assert_eq!(sensor.turn(&mut state, bad), Turn::Unknown);
        assert_eq!(Turn::Unknown.angle(), 0.0);
        assert_eq!(state, before);
    }
    assert_eq!(sensor.turn(&mut state, 16), Turn::Measured(0.1));
    assert_eq!(sensor.turn(&mut state, 5_000), Turn::Limited(1.0));
    assert_eq!(sensor.turn(&mut state, 0), Turn::Limited(-1.0));

    let sensor = wrapped(-3.0, 6.0, 0.5);
    let mut state = WrappedAngle::FRESH;
    sensor.turn(&mut state, 2.875);
    for bad in [
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        3.1,
        -3.1,
        f32::MAX,
    ] {
        assert_eq!(sensor.turn(&mut state, bad), Turn::Unknown);
    }
    assert_eq!(sensor.turn(&mut state, -2.75), Turn::Measured(0.375));
    assert_eq!(sensor.turn(&mut state, -1.0), Turn::Limited(0.5));

    let speed = SpeedOverTick::new(1e-3, 0.5).unwrap();
    assert_eq!(speed.turn(&mut (), 100.0), Turn::Measured(0.1));
    assert_eq!(speed.turn(&mut (), f32::NAN), Turn::Unknown);
    assert_eq!(speed.turn(&mut (), f32::INFINITY), Turn::Limited(0.5));
    assert_eq!(speed.turn(&mut (), -1e9), Turn::Limited(-0.5));
}

/// A turn is the speed times the tick, rounded once: the constant's own rounding is not the product's.
#[test]
fn speeds_are_turns_over_a_tick() {
    let mut random = Random(7);
    let mut errors = Errors::default();
    for _ in 0..200_000 {
        let tick = 10_f64.powf(random.between(-6.0, -1.0)) as f32;
        let speed = random.sign() * 10_f64.powf(random.between(-3.0, 3.0)) as f32;
        let exact = f64::from(speed) * f64::from(tick);
        let turn = SpeedOverTick::new(tick, 1e3).unwrap().turn(&mut (), speed);
        assert!(turn.is_measured());
        errors.add_case(f64::from(turn.angle()) / exact - 1.0, || {
            format!("{speed} {tick}")
        });
    }
    errors.assert_promised(promises::of("turn_of_speed"));
}

/// A sensor behind a play lets through the turn of its counts less what the play takes, from the same place.
#[test]
fn a_steady_sensor_turns_as_promised() {
    const COUNT: f32 = 0.0157;
    let play = Play::new(1.0).unwrap();
    let steady = Deadband::new(counter(16_384, COUNT, 4.0), 1.0).unwrap();
    // Nobody sees a sensor's place: a play beside it is moved by the same turns.
    let (mut behind, mut reading) = (PlayState::FRESH, Deadband::<CountSensor>::FRESH);
    let mut random = Random(8);
    let mut errors = Errors::default();
    let mut count = 0_i64;
    steady.turn(&mut reading, 0);
    for tick in 0..200_000 {
        let counts = random.between(-128.0, 128.0) as i64;
        count += counts;
        let before = f64::from(behind.position());
        let turn = counts as f64 * f64::from(COUNT);
        let _ = play.follow(&mut behind, turn as f32);
        let found = steady.turn(&mut reading, count.rem_euclid(16_384) as u32);
        assert!(found.is_measured());
        let exact = (before + turn) - (before + turn).clamp(-1.0, 1.0);
        errors.add_case(f64::from(found.angle()) - exact, || tick.to_string());
    }
    errors.assert_promised(promises::of("turn_steady"));
}

/// Angles that wrap at either end: the difference of the readings, which are what they are.
#[test]
fn angles_lose_nothing_across_either_end() {
    let mut random = Random(2);
    let mut errors = Errors::default();
    let full = TAU as f32;
    for lowest in [0.0, -0.5 * full] {
        let sensor = wrapped(lowest, full, 3.0);
        let (low, period) = (f64::from(lowest), f64::from(full));
        let (mut state, mut last) = (WrappedAngle::FRESH, f64::from(lowest));
        sensor.turn(&mut state, lowest);
        let mut crossings = 0;
        for _ in 0..100_000 {
            let size = 10_f64.powf(random.between(-5.0, 0.45));
            let step = f64::from(random.sign()) * size;
            let reading = (low + (last + step - low).rem_euclid(period)) as f32;
            let turn = sensor.turn(&mut state, reading);
            let direct = f64::from(reading) - last;
            let exact = direct - period * (direct / period).round();
            crossings += u32::from(exact != direct);
            assert!(turn.is_measured());
            let error = f64::from(turn.angle()) - exact;
            // One rounding of the turn; across the end the readings' ends are rounded, too.
            assert!(error.abs() <= exact.abs() * 6e-8 + if exact == direct { 0.0 } else { 2.4e-7 });
            errors.add_case(error / period, || format!("{last} {reading}"));
            last = f64::from(reading);
        }
        assert!(crossings > 1000);
    }
    errors.assert_promised(promises::of("turn_of_angles"));
}

#[test]
fn a_play_lets_through_what_it_does_not_take() {
    let play = Play::new(1e-3).unwrap();
    let mut state = PlayState::FRESH;
    let mut moved = |turn| {
        let moved = play.follow(&mut state, turn);
        (moved.turn, moved.direction)
    };
    let near = |found: (f32, f32), turn: f32, way: f32| {
        assert!(
            (found.0 - turn).abs() < 1.8e-10 && found.1 == way,
            "{found:?}"
        );
    };
    near(moved(0.5e-3), 0.0, 0.0);
    near(moved(1.5e-3), 1e-3, 1.0);
    near(moved(0.25e-3), 0.25e-3, 1.0);
    near(moved(-0.5e-3), 0.0, 1.0);
    near(moved(0.5e-3), 0.0, 1.0);
    near(moved(-2e-3), 0.0, 1.0);
    near(moved(-0.5e-3), -0.5e-3, -1.0);
    near(moved(2e-3), 0.0, -1.0);
    near(moved(f32::NAN), 0.0, -1.0);
    near(moved(0.25e-3), 0.25e-3, 1.0);
}

#[test]
fn a_play_keeps_noise_away() {
    let play = Play::new(1.0).unwrap();
    let mut random = Random(3);
    let (mut state, mut turned) = (PlayState::FRESH, 0.0);
    let mut errors = Errors::default();
    let mut place = 0.0_f64;
    for tick in 0..200_000 {
        let turn = random.between(-2.0, 2.0) as f32;
        let before = f64::from(state.position());
        let moved = play.follow(&mut state, turn);
        errors.add_case(
            before + f64::from(turn) - f64::from(state.position()) - f64::from(moved.turn),
            || tick.to_string(),
        );
        place += f64::from(moved.turn);
        turned += f64::from(turn);
        assert!((turned - place).abs() < 1.0 + 1e-2);
    }
    errors.assert_promised(promises::of("play"));
    let mut way = 0.0;
    for tick in 0..10_000 {
        // A slow turn with counts of noise of 0.9 of the play's width.
        let noise = if tick % 2 == 0 { 0.9 } else { -0.9 };
        let moved = play.follow(&mut state, noise + 0.01);
        assert!(tick < 400 || moved.turn >= 0.0);
        way = moved.direction;
    }
    assert_eq!(way, 1.0);
    let none = Play::new(0.0).unwrap();
    let mut state = PlayState::FRESH;
    assert_eq!(none.follow(&mut state, 0.3).turn, 0.3);
    assert_eq!(none.follow(&mut state, -0.1).turn, -0.1);
}

/// A sensor behind a play is the play of the sensor's turns; a bad reading leaves both as they were, a limited one stays limited.
#[test]
fn a_steady_sensor_is_a_play_of_its_turns() {
    let sensor = counter(16_384, 1e-3, 0.5);
    let play = Play::new(3e-3).unwrap();
    let steady = Deadband::new(sensor, 3e-3).unwrap();
    let (mut raw, mut behind) = (CountSensor::FRESH, PlayState::FRESH);
    let mut reading = Deadband::<CountSensor>::FRESH;
    let mut random = Random(5);
    let (mut count, mut moved) = (0_i64, 0);
    for _ in 0..10_000 {
        if random.one_in(50) {
            let before = reading;
            assert_eq!(steady.turn(&mut reading, 20_000), Turn::Unknown);
            assert_eq!(reading, before);
        }
        count += random.between(-6.0, 6.0) as i64;
        let now = count.rem_euclid(16_384) as u32;
        let turn = play.follow(&mut behind, sensor.turn(&mut raw, now).angle());
        assert_eq!(steady.turn(&mut reading, now), Turn::Measured(turn.turn));
        moved += usize::from(turn.turn != 0.0);
    }
    assert!(moved > 1000 && moved < 9000, "{moved}");
    let far = (count + 4000).rem_euclid(16_384) as u32;
    assert!(matches!(steady.turn(&mut reading, far), Turn::Limited(turn) if turn > 0.49));
    for half_width in [-1e-9, 2e3, f32::NAN] {
        let error = Deadband::new(sensor, half_width).unwrap_err();
        assert_eq!(error.field(), "half_width");
    }
}

#[test]
fn set_ups_are_refused_by_field() {
    let count = |period, turn_per_count, largest_turn| {
        let parameters = CountSensorParameters {
            period,
            turn_per_count,
            largest_turn,
        };
        CountSensor::new(parameters).unwrap_err().field()
    };
    assert_eq!(count(1, 1e-3, 1e-3), "period");
    assert_eq!(count(100, 0.0, 1e-3), "turn_per_count");
    assert_eq!(count(100, f32::NAN, 1e-3), "turn_per_count");
    assert_eq!(count(100, -1e-3, 0.06), "largest_turn");
    assert_eq!(count(0, 1e-3, f32::INFINITY), "largest_turn");
    let angle = |lowest, period, largest_turn| {
        let parameters = WrappedAngleParameters {
            lowest,
            period,
            largest_turn,
        };
        WrappedAngle::new(parameters).unwrap_err().field()
    };
    assert_eq!(angle(f32::NAN, 6.0, 1.0), "lowest");
    assert_eq!(angle(0.0, 0.0, 1.0), "period");
    assert_eq!(angle(0.0, 6.0, 3.5), "largest_turn");
    assert_eq!(SpeedOverTick::new(0.0, 1.0).unwrap_err().field(), "tick");
    assert_eq!(
        SpeedOverTick::new(1e-3, 0.0).unwrap_err().field(),
        "largest_turn"
    );
    assert_eq!(Play::new(-1.0).unwrap_err().field(), "half_width");
    assert_eq!(Play::new(f32::NAN).unwrap_err().field(), "half_width");
}
