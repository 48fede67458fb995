//! Traces of the rig in themselves.

use epas_reference::friction::ball_screw_efficiency::LoadedScrew;
use epas_rig::course::{Course, Manoeuvre};
use epas_rig::parameters::Parameters;
use epas_rig::sliding::SlidingTorque;
use epas_rig::spoiled::Spoiling;
use epas_rig::{Rig, Sensors};

fn deviation(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    (values
        .iter()
        .map(|value| (value - mean).powi(2))
        .sum::<f64>()
        / values.len() as f64)
        .sqrt()
}

fn less(one: &[f64], other: &[f64]) -> Vec<f64> {
    one.iter()
        .zip(other)
        .map(|(one, other)| one - other)
        .collect()
}

fn rms_of(values: &[f64]) -> f64 {
    (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt()
}

/// 60 s at 1 kHz: noises within five standard errors (`1/sqrt(2 n)`) of their set size, angles within half a count, courses of the sizes
/// that they are named for.
#[test]
fn sensors_and_courses_are_as_set() {
    let sensors = Sensors::default();
    let rig = Rig::new(Parameters::default(), sensors).unwrap();
    let trace = rig.run(&Course::vehicle(), 5).unwrap();
    assert_eq!(trace.len(), 60_000);
    let within = 5.0 / (2.0 * trace.len() as f64).sqrt();
    let noise = less(&trace.motor_torque, &trace.truth.torque);
    let set = sensors.torque_noise * deviation(&trace.truth.torque);
    assert!((deviation(&noise) / set - 1.0).abs() < within);
    let noise = less(&trace.axial_load, &trace.truth.load);
    assert!((deviation(&noise) / sensors.load_noise - 1.0).abs() < within);
    let rounded = less(&trace.nut_position, &trace.truth.position);
    assert!(
        rounded
            .iter()
            .all(|error| error.abs() <= 0.500_001 * sensors.count)
    );

    // 0.6 rad rms over all of the weave but its fading ends.
    let (_, weave) = &trace.parts[0];
    let size = rms_of(&less(
        &trace.truth.position[weave.clone()],
        &vec![trace.truth.position[0]; weave.len()],
    ));
    assert!((0.5..0.7).contains(&size), "{size}");
    let fastest = trace
        .truth
        .speed
        .iter()
        .fold(0.0_f64, |most, speed| most.max(speed.abs()));
    assert!((40.0..46.0).contains(&fastest), "{fastest}");
    // A trace of the same seed is the same, of another one another.
    assert_eq!(rig.run(&Course::vehicle(), 5).unwrap(), trace);
    assert_ne!(rig.run(&Course::vehicle(), 6).unwrap(), trace);
}

/// A colour of 0.9: neighbours correlate by that within five standard errors, the size stays.
#[test]
fn noise_may_be_coloured() {
    let coloured = Sensors {
        colour: 0.9,
        ..Sensors::default()
    };
    let rig = Rig::new(Parameters::default(), coloured).unwrap();
    let trace = rig.run(&Course::of(Manoeuvre::Weave, 20.0), 3).unwrap();
    let noise = less(&trace.motor_torque, &trace.truth.torque);
    let size = deviation(&noise);
    let products: f64 = noise.windows(2).map(|pair| pair[0] * pair[1]).sum();
    let correlation = products / (noise.len() as f64 - 1.0) / (size * size);
    // Standard error of a correlation r over n samples: sqrt((1 - r^2)/n).
    assert!(
        (correlation - 0.9).abs() < 5.0 * (0.19 / noise.len() as f64).sqrt(),
        "{correlation}"
    );
    // Coloured noise has (1 - r^2)/(1 + r^2) as many independent squares: a tenth.
    let set = coloured.torque_noise * deviation(&trace.truth.torque);
    assert!((size / set - 1.0).abs() < 5.0 / (0.2 * noise.len() as f64).sqrt());
}

/// Friction never drives over a whole course, and lies between the limits of sliding.
#[test]
fn friction_takes_power_and_stays_between_its_limits() {
    for parameters in [Parameters::default(), Parameters::other_physics()] {
        let seal = parameters.seal.map_or(0.0, |seal| seal.torque);
        let rig = Rig::new(parameters, Sensors::default()).unwrap();
        let trace = rig.run(&Course::whole(), 1).unwrap();
        let truth = &trace.truth;
        let mut work = 0.0;
        let mut size = 0.0;
        for index in 1..trace.len() {
            let turn = truth.position[index] - truth.position[index - 1];
            work += turn * truth.friction[index];
            size += (turn * truth.friction[index]).abs();
            let limits = rig.sliding().limits(&epas_rig::friction::State {
                turn,
                speed: truth.speed[index],
                load: truth.load[index],
                temperature: trace.temperature[index],
            });
            // Rounding of the sums of 60 elements.
            let above = limits.forward + seal + 1e-12;
            let below = -limits.backward - seal - 1e-12;
            assert!((below..above).contains(&truth.friction[index]), "{index}");
        }
        assert!(work > 0.9 * size, "{work} of {size}");
    }
}

/// The measured columns as a table, one row a sample.
#[test]
fn a_trace_is_written_as_a_table() {
    let rig = Rig::new(Parameters::default(), Sensors::default()).unwrap();
    let trace = rig.run(&Course::of(Manoeuvre::Micro, 2.0), 3).unwrap();
    let mut out = Vec::new();
    trace.write_csv(&mut out).unwrap();
    let text = String::from_utf8(out).unwrap();
    let mut lines = text.lines();
    assert_eq!(
        lines.next(),
        Some("time,nut_position,motor_torque,axial_load,temperature")
    );
    let row: Vec<f64> = lines
        .nth(1000)
        .unwrap()
        .split(',')
        .map(|cell| cell.parse().unwrap())
        .collect();
    assert_eq!(lines.count(), 999);
    let wanted = [
        trace.time[1000],
        trace.nut_position[1000],
        trace.motor_torque[1000],
        trace.axial_load[1000],
        trace.temperature[1000],
    ];
    // Half of the last digit written.
    for ((found, wanted), digit) in row.iter().zip(wanted).zip([1e-6, 1e-9, 1e-7, 1e-3, 1e-3]) {
        assert!((found - wanted).abs() <= 0.5001 * digit, "{found} {wanted}");
    }
}

/// The grid of balls against balls that are solved where the grid has none.
#[test]
fn between_the_balls_of_the_grid_lie_balls() {
    // Without preload a bend that moves with the coefficient lies between the balls of the grid.
    for (preload, accepted) in [(700.0, 4e-3), (0.0, 2e-2), (250.0, 2e-2)] {
        let mut parameters = Parameters::default();
        parameters.screw.axial_preload = preload;
        let screw = parameters.screw;
        let torque = SlidingTorque::new(&screw, [0.06, 0.115]).unwrap();
        let clearance = screw.clearance().unwrap();
        let balls: Vec<LoadedScrew> = [0.062, 0.067, 0.08, 0.1, 0.113]
            .into_iter()
            .flat_map(|friction| {
                (0..25).flat_map(move |place| {
                    let load = 5.0 * 1.3_f64.powi(place);
                    [(load, friction), (-load, friction)]
                })
            })
            .filter(|(load, _)| load.abs() < 3500.0)
            .map(|(axial_load, friction)| LoadedScrew {
                design: screw.design,
                clearance,
                friction,
                rolling: screw.rolling,
                balls: screw.balls,
                axial_load,
            })
            .collect();
        let mut largest = 0.0_f64;
        for (ball, exact) in balls.iter().zip(LoadedScrew::solve_all(&balls, &|| ())) {
            let found = torque.at(ball.axial_load, ball.friction);
            let error = found / exact.unwrap().torque() - 1.0;
            assert!(error.abs() < accepted, "{preload}: {error} at {ball:?}");
            largest = largest.max(error.abs());
        }
        println!("preload {preload}: {largest:.1e}");
    }
}

/// Careless traces are careless in what they are named for alone.
#[test]
fn spoiled_traces_are_wrong_in_one_way() {
    let rig = Rig::new(Parameters::default(), Sensors::default()).unwrap();
    let course = Course::of(Manoeuvre::Weave, 4.0);
    let trace = rig.run(&course, 3).unwrap();
    for spoiling in Spoiling::ALL {
        let spoiled = trace.clone().spoiled(spoiling);
        assert_ne!(format!("{spoiled:?}"), format!("{trace:?}"), "{spoiling:?}");
        let lost = trace.len() - spoiled.len();
        let expected = match spoiling {
            Spoiling::DroppedSamples => 40,
            Spoiling::Gap => 1000,
            _ => 0,
        };
        assert_eq!(lost, expected, "{spoiling:?}");
        assert_eq!(spoiled.truth.friction.len(), spoiled.time.len());
    }
    // Steady and one-way courses never turn back, and an unloaded one has no load.
    for manoeuvre in [Manoeuvre::Steady, Manoeuvre::OneWay] {
        let trace = rig.run(&Course::of(manoeuvre, 4.0), 3).unwrap();
        let slowest = trace.truth.speed[50..3950]
            .iter()
            .fold(f64::MAX, |least, speed| least.min(*speed));
        // A condition of the case: never back, here not below 1.0 rad/s.
        assert!(slowest > 0.9, "{manoeuvre:?}: {slowest}");
    }
    let trace = rig.run(&course.unloaded(), 3).unwrap();
    assert!(trace.truth.load.iter().all(|load| *load == 0.0));
}
