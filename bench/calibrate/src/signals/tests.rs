//! Tests of smoothed motion and of rows.

use crate::signals::{Motion, RowSettings, Rows, SmoothingSettings};
use crate::trace::{Coordinate, Repairs, Trace};
use epas_page::failure::Failure;
use std::f64::consts::TAU;

const STEP: f64 = 1e-3;

/// Two sines: position, speed and acceleration.
fn exact(time: f64) -> [f64; 3] {
    [(3.0, TAU * 0.4), (0.05, TAU * 5.0)]
        .into_iter()
        .map(|(size, frequency)| {
            let (sine, cosine) = (frequency * time).sin_cos();
            [
                size * sine,
                size * frequency * cosine,
                -size * frequency * frequency * sine,
            ]
        })
        .fold([0.0; 3], |sum, add| [0, 1, 2].map(|k| sum[k] + add[k]))
}

fn trace(samples: usize, resolution: f64) -> Trace {
    let position = (0..samples)
        .map(|k| exact(STEP * k as f64)[0])
        .map(|x| {
            if resolution > 0.0 {
                (x / resolution).round() * resolution
            } else {
                x
            }
        })
        .collect();
    Trace {
        name: "sines".into(),
        coordinate: Coordinate::Rotation,
        start: 0.0,
        step: STEP,
        position,
        resolution,
        position_summed: false,
        speed: None,
        effort: vec![0.0; samples],
        reference_position: None,
        load: None,
        load_is_effort: false,
        known: None,
        temperature: None,
        left_out: Vec::new(),
        origins: crate::trace::Origins::default(),
        repairs: Repairs::default(),
        ignored: Vec::new(),
    }
}

fn errors(motion: &Motion) -> [f64; 2] {
    let inner = motion.edge..motion.position.len() - motion.edge;
    let squares = inner.clone().fold([0.0; 2], |sum, k| {
        let [_, speed, acceleration] = exact(STEP * k as f64);
        [
            sum[0] + (motion.speed[k] - speed).powi(2),
            sum[1] + (motion.acceleration[k] - acceleration).powi(2),
        ]
    });
    squares.map(|sum| (sum / inner.len() as f64).sqrt())
}

#[test]
fn motion_of_a_fine_sensor_is_exact() {
    let motion = Motion::of(&trace(20_000, 0.0), &SmoothingSettings::default()).unwrap();
    let [speed, acceleration] = errors(&motion);
    // The 5 Hz sine, of amplitudes 1.57 rad/s and 49 rad/s^2: the filter takes (5/40)^8 = 6e-8 of it, a central
    // difference (TAU 5 STEP)^2 / 6 = 1.6e-4, two of them twice that.
    assert!(speed < 1.6e-4 * 1.6, "{speed}");
    assert!(acceleration < 3.3e-4 * 50.0, "{acceleration}");
}

#[test]
fn noise_of_a_sensor_that_rounds_is_what_it_says() {
    for counts in [2000.0, 16384.0 * 2.5] {
        let motion =
            Motion::of(&trace(60_000, TAU / counts), &SmoothingSettings::default()).unwrap();
        let fine = errors(&Motion::of(&trace(60_000, 0.0), &SmoothingSettings::default()).unwrap());
        for ((error, fine), noise) in errors(&motion).into_iter().zip(fine).zip(motion.noise) {
            let error = (error * error - fine * fine).sqrt();
            // Both are means over a minute of a noise that repeats with the motion: measured ratios within 2 %.
            assert!(
                (error / noise - 1.0).abs() < 0.1,
                "{counts}: {error} {noise}"
            );
        }
    }
}

#[test]
fn noise_of_a_noisy_sensor_is_what_it_says() {
    use rand::SeedableRng;
    use rand_distr::{Distribution, Normal};
    let mut random = rand_pcg::Pcg64::seed_from_u64(5);
    let normal = Normal::new(0.0, 1e-3).unwrap();
    let mut noisy = trace(60_000, 0.0);
    for position in &mut noisy.position {
        *position += normal.sample(&mut random);
    }
    let motion = Motion::of(&noisy, &SmoothingSettings::default()).unwrap();
    for (error, noise) in errors(&motion).into_iter().zip(motion.noise) {
        // A minute holds 60 s x 2 x 40 Hz = 4800 independent values: 1 % of the deviation.
        assert!((error / noise - 1.0).abs() < 0.04, "{error} {noise}");
    }
}

#[test]
fn a_summed_position_gives_way_to_the_speed() {
    let mut summed = trace(20_000, 0.0);
    summed.position_summed = true;
    summed.speed = Some((0..20_000).map(|k| exact(STEP * f64::from(k))[1]).collect());
    let motion = Motion::of(&summed, &SmoothingSettings::default()).unwrap();
    let [speed, acceleration] = errors(&motion);
    // The filter's 6e-8 of the small sine's speed, and at the edges what is left of the mirror: a thousandth of the
    // slope of 50 rad/s^2 over the settling time, over 20 s.
    assert!(speed < 1e-6, "{speed}");
    assert!(acceleration < 1.7e-4 * 50.0, "{acceleration}");
}

#[test]
fn defaults_follow_the_sampling_rate() {
    for (step, smoothing, rows, every) in [
        (1e-3, 40.0, 25.0, 10),
        (1e-4, 40.0, 25.0, 100),
        (5e-3, 25.0, 25.0, 2),
        (1e-2, 12.5, 12.5, 2),
        (1e-3 / 1.5, 40.0, 25.0, 15),
    ] {
        let filter = SmoothingSettings::default().filter(step).unwrap();
        assert!((filter.cutoff() - smoothing).abs() < 1e-9);
        let made = Rows::new(step, &RowSettings::default()).unwrap();
        assert!((made.filter().cutoff() - rows).abs() < 1e-9);
        assert!(
            (made.row_step() / step - f64::from(every)).abs() < 1e-9,
            "{step}"
        );
    }
}

#[test]
fn rows_are_filtered_samples() {
    let rows = Rows::new(STEP, &RowSettings::default()).unwrap();
    let signal: Vec<f64> = (0..5000).map(|k| exact(STEP * f64::from(k))[0]).collect();
    let made = rows.of(&signal);
    assert_eq!(made.len(), rows.count(signal.len()));
    for (row, sample) in made.iter().zip(rows.samples(signal.len())) {
        // (5/25)^6 of the small sine, and what is left of the edges' mirror: 1e-3 of a slope over the settling.
        assert!((row - signal[sample]).abs() < 6.4e-5 * 0.05 + 1e-5);
    }
    assert!(rows.of(&signal[..20]).is_empty());
    assert!(rows.of(&signal[..300]).is_empty());
    assert_eq!(rows.count(20), 0);
}

#[test]
fn rates_that_are_too_low_and_bad_settings_are_refused() {
    let word = |failure: Failure| match failure {
        Failure::Data(message) => message,
        other => format!("{other:?}"),
    };
    let wanted = SmoothingSettings {
        cutoff: Some(400.0),
        order: 4,
    };
    let message = word(Motion::of(&trace(9000, 0.0), &wanted).unwrap_err());
    assert!(message.contains("sampling rate of 1000"), "{message}");
    let short = Motion::of(&trace(100, 0.0), &SmoothingSettings::default());
    assert!(word(short.unwrap_err()).contains("too few"));
    for (settings, expected) in [
        (
            RowSettings {
                cutoff: Some(300.0),
                ..RowSettings::default()
            },
            "too low",
        ),
        (
            RowSettings {
                every: Some(0),
                ..RowSettings::default()
            },
            "every 0th",
        ),
        (
            RowSettings {
                every: Some(21),
                ..RowSettings::default()
            },
            "at most every 20th",
        ),
        (
            RowSettings {
                edge: Some(-1.0),
                ..RowSettings::default()
            },
            "edge",
        ),
        (
            RowSettings {
                order: 20,
                ..RowSettings::default()
            },
            "order",
        ),
    ] {
        let message = word(Rows::new(STEP, &settings).unwrap_err());
        assert!(message.contains(expected), "{message}");
    }
}
