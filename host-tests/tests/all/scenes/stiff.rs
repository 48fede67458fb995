//! Stiff cases: impedances that differ by powers of ten, full tracks, long runs.

use crate::recorded;
use epas_friction::FrictionModel;
use epas_friction::train::{Press, Train};
use epas_reference::promises;
use epas_testkit::errors::Errors;
use epas_testkit::gears;
use epas_testkit::gears::screw_inputs;
use epas_testkit::measured;
use epas_testkit::random::Random;
use epas_testkit::random_scenes::{Trial, sound_train};

/// Speeds and forces of a row in contact by the max-min formula of isotonic regression, in f64.
pub fn exact_row(free: &[f64], impedance: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let n = free.len();
    let mean = |from: usize, to: usize| {
        let weight: f64 = impedance[from..=to].iter().sum();
        let sum: f64 = (from..=to).map(|j| free[j] * impedance[j]).sum();
        sum / weight
    };
    let speeds: Vec<f64> = (0..n)
        .map(|j| {
            (0..=j)
                .map(|from| {
                    (j..n)
                        .map(|to| mean(from, to))
                        .fold(f64::INFINITY, f64::min)
                })
                .fold(f64::NEG_INFINITY, f64::max)
        })
        .collect();
    // From whichever end adds up fewer and lighter balls.
    let forces = (0..n)
        .map(|j| {
            let push = |i: usize| (free[i] - speeds[i]) * impedance[i];
            let (behind, ahead): (f64, f64) = ((0..=j).map(push).sum(), (j + 1..n).map(push).sum());
            if impedance[..=j].iter().sum::<f64>() < impedance[j + 1..].iter().sum() {
                behind
            } else {
                -ahead
            }
        })
        .collect();
    (speeds, forces)
}

fn force_error<const N: usize>(ratio: f32, rows: u32, random: &mut Random) -> (f64, f64) {
    let mut errors = Errors::of(format!("impedance ratio {ratio:e}"));
    for _ in 0..rows {
        let free: [f32; N] = std::array::from_fn(|_| 0.05 * (2.0 * random.unit() - 1.0));
        let impedance: [f32; N] =
            std::array::from_fn(|_| (1e3 / ratio.sqrt()) * ratio.powf(random.unit()));
        let mut room = [0.0; N];
        room[N - 1] = f32::INFINITY;
        let mut press = Press::<N>::new();
        assert!(press.solve(&free, &impedance, &room));
        let wide = |numbers: &[f32; N]| numbers.map(f64::from);
        let (speeds, forces) = exact_row(&wide(&free), &wide(&impedance));
        let largest = forces.iter().copied().fold(1e-12, f64::max);
        for (found, exact) in press.forces().zip(&forces) {
            let error = (f64::from(found) - exact) / largest;
            errors.add_case(error, || {
                format!("{found} for {exact}\n{free:?}\n{impedance:?}")
            });
        }
        for (found, exact) in press.speeds().zip(&speeds) {
            measured::assert_at(
                "stiff rows, speeds",
                f64::from(found) - exact,
                format_args!("{found} {exact}"),
            );
        }
    }
    if ratio <= 1e6 {
        errors.assert_promised(promises::of("press"));
    } else {
        measured::assert("stiff rows beyond a ratio of 1e6, force", errors.largest);
    }
    (errors.largest, errors.rms())
}

fn rows_of_light_balls_between_heavy_ones(rows: u32) {
    let mut random = Random(11);
    for ratio in [1.0, 1e2, 1e4, 1e6, 1e9, 1e12] {
        let (worst, rms) = force_error::<37>(ratio, rows, &mut random);
        println!("37 balls, impedance ratio {ratio:e}: force error max {worst:.1e} rms {rms:.1e}");
        let (worst, rms) = force_error::<64>(ratio, rows / 4, &mut random);
        println!("64 balls, impedance ratio {ratio:e}: force error max {worst:.1e} rms {rms:.1e}");
    }
}

#[test]
fn light_balls_between_heavy_ones() {
    rows_of_light_balls_between_heavy_ones(60);
}

#[test]
#[ignore = "whole sweep: cargo test -p epas-reference --test all -- --ignored _whole"]
fn light_balls_between_heavy_ones_whole() {
    rows_of_light_balls_between_heavy_ones(400);
}

/// A track with `spare` of a ball left, run for `ticks` with free speeds that change now and then.
fn full_track<const N: usize>(spare: f32, ticks: u32, random: &mut Random) {
    let pitch = 1.0 / (N as f32 + spare);
    let mut train = Train::<N>::evenly_spaced(1.0, pitch, N).unwrap();
    let before: f64 = train.gaps().map(f64::from).sum();
    let mut free = [0.0; N];
    let mut impedance = [1e3; N];
    for tick in 0..ticks {
        if tick % 50 == 0 {
            free = std::array::from_fn(|_| 0.1 * (2.0 * random.unit() - 1.0));
            impedance = std::array::from_fn(|_| 1e6_f32.powf(random.unit()));
        }
        let travel = 0.03 * (2.0 * random.unit() - 1.0);
        assert!(train.step(&free, &impedance, travel));
        if tick % 16 == 0 {
            sound_train(&train).unwrap_or_else(|error| {
                panic!("{N} balls, {spare} of a ball spare, tick {tick}: {error}")
            });
        }
    }
    let after: f64 = train.gaps().map(f64::from).sum();
    measured::assert_at(
        "full track, sum of gaps in m",
        before - after,
        format_args!("{before} m of gaps became {after}"),
    );
}

#[test]
fn tracks_full_and_almost_full_keep_every_ball() {
    let mut random = Random(12);
    for spare in [0.0, 1e-7, 1e-6, 1e-3, 0.5] {
        full_track::<1>(spare, 20_000, &mut random);
        full_track::<2>(spare, 20_000, &mut random);
        full_track::<3>(spare, 20_000, &mut random);
        full_track::<37>(spare, 20_000, &mut random);
        full_track::<64>(spare, 20_000, &mut random);
    }
    full_track::<3>(1e4, 20_000, &mut random);
}

fn long_run<const N: usize>(ticks: u64, every: u64) {
    let mut configuration = gears::uncaged();
    configuration.balls = N as u16;
    configuration.turns = 2.5 * N as f32 / 37.0;
    let mut model = FrictionModel::<gears::UncagedScrew<N>>::new(&configuration).unwrap();
    let turn = 2.0 * std::f64::consts::PI * 1e-4;
    let (step_sin, step_cos) = turn.sin_cos();
    let (mut sin, mut cos) = (0.0, 1.0);
    let (mut worst, mut sum, mut contacts) = (0.0_f32, 0.0_f64, 0_u64);
    for tick in 0..ticks {
        if tick % 10_000 == 0 {
            (sin, cos) = (0.0, 1.0);
        }
        (sin, cos) = (
            sin * step_cos + cos * step_sin,
            cos * step_cos - sin * step_sin,
        );
        let sensors = [(300.0 * sin) as f32, (8e3 * cos) as f32, 0.0];
        let outputs = model.step(gears::UncagedScrew::<N>::inputs(sensors));
        worst = worst.max(outputs.largest_contact_force);
        sum += f64::from(outputs.friction_torque.abs());
        contacts += u64::from(outputs.contacts);
        if tick % every == 0 {
            let checked = gears::UncagedScrew::<N>::check(&configuration, sensors, &outputs)
                .and_then(|()| sound_train(&model.state().circuit.train));
            checked.unwrap_or_else(|error| panic!("tick {tick}: {error}"));
        }
    }
    println!(
        "{N} balls, {ticks} ticks: {:.3} contacts a tick, largest force {worst:.1} N, mean friction {:.4} N m",
        contacts as f64 / ticks as f64,
        sum / ticks as f64,
    );
    assert!(contacts > 0 && worst < 8e3);
}

#[test]
fn a_minute_of_turning_to_and_fro() {
    long_run::<37>(600_000, 100);
}

#[test]
#[ignore = "minutes: cargo test --release -p epas-reference --test all scenes::stiff -- --ignored --nocapture"]
fn a_thousand_million_ticks() {
    const TICKS: u64 = 1_000_000_000;
    long_run::<8>(TICKS, 1000);
    recorded::print(
        "ticks of one train that turns to and fro: no drift, no overlap, no ball lost",
        TICKS,
        "cargo test --release -p epas-reference --test all scenes::stiff -- --ignored --nocapture",
    );
}

#[test]
fn the_row_goes_as_far_as_the_nut_turns() {
    // Without deviations balls keep their distances and the row advances by the sum of travels: f32 rounds each to 6e-8 of itself.
    let mut train = Train::<8>::evenly_spaced(0.25, 0.01, 8).unwrap();
    let start: Vec<u32> = train.positions().collect();
    let travel = 3.7e-5_f32;
    let ticks = 3_000_000_u32;
    for _ in 0..ticks {
        train.step(&[0.0; 8], &[1e3; 8], travel);
    }
    let units = f64::from(travel) / 0.25 * 4_294_967_296.0 * f64::from(ticks);
    for (start, now) in start.iter().zip(train.positions()) {
        let expected = (f64::from(*start) + units).rem_euclid(4_294_967_296.0);
        let error = (f64::from(now) - expected + 2_147_483_648.0).rem_euclid(4_294_967_296.0)
            - 2_147_483_648.0;
        let relative = error / units;
        // Derived: each travel has one rounding of 2^-24, and the same one in every tick.
        assert!(relative.abs() < 6e-8, "{relative:e} of the way");
    }
}

#[test]
fn standstill_is_smooth_at_the_least_reversal_speed() {
    // The blending width down to 1e-6 rad/s, speeds from subnormal to a million times the width: no step,
    // no sign change, and the least friction at rest.
    for width in [1e-6, 1e-3, 1.0, 1e3] {
        let mut configuration = gears::caged();
        configuration.reversal_speed = width;
        configuration.limits.nut_speed = 1e6;
        let mut model = FrictionModel::<gears::CagedScrew>::new(&configuration).unwrap();
        let mut friction =
            |nut_speed: f32| model.step(screw_inputs(nut_speed, 4e3)).friction_torque;
        let full = friction(1e6);
        let mut last = 0.0;
        let mut speed = 1e-38_f32;
        while speed < 1e6 {
            let (ahead, back) = (friction(speed), friction(-speed));
            assert!(
                ahead >= last && back <= 0.0,
                "width {width} speed {speed}: {ahead} {last}"
            );
            let share = f64::from(speed) / f64::from(speed).hypot(f64::from(width));
            // The flanks' sum and difference blend with the speed as well: between the two torques. Beyond what f32 rounds to nothing.
            let over = (f64::from(ahead) - 1e-12).max(0.0) / (share * f64::from(full));
            measured::assert_at(
                "low speeds, friction over its share of the full",
                over,
                format_args!("width {width} speed {speed}: {ahead}"),
            );
            last = ahead;
            speed *= 1.3;
        }
        assert_eq!(friction(0.0), 0.0);
        assert_eq!(friction(-0.0), 0.0);
    }
}
