//! Traces of the rig in themselves.

use super::*;
use crate::friction::SlidingTorque;
use epas_reference::friction::ball_screw_efficiency::LoadedScrew;

fn rig(parameters: Parameters) -> Rig {
    Rig::new(parameters).unwrap()
}

fn less(one: &[f64], other: &[f64]) -> Vec<f64> {
    one.iter()
        .zip(other)
        .map(|(one, other)| one - other)
        .collect()
}

/// 60 s at 1 kHz: noises within five standard errors (`1/sqrt(2 n)`) of their set size, angles within half a count, courses of the sizes
/// that they are named for.
#[test]
fn sensors_and_courses_are_as_set() {
    let rig = rig(Parameters::default());
    let trace = rig.run(&Course::vehicle(), 5).unwrap();
    let truth = &trace.truth;
    assert_eq!(trace.time.len(), 60_000);
    let within = 5.0 / (2.0 * trace.time.len() as f64).sqrt();
    let set = TORQUE_NOISE * deviation(&truth.torque);
    for (measured, exact, set) in [
        (&trace.motor_torque, &truth.torque, set),
        (&trace.axial_load, &truth.load, LOAD_NOISE),
    ] {
        assert!((deviation(&less(measured, exact)) / set - 1.0).abs() < within);
    }
    let rounded = less(&trace.nut_position, &truth.position);
    assert!(rounded.iter().all(|error| error.abs() <= 0.500_001 * COUNT));
    // 0.6 rad rms over all of the weave but its fading ends.
    let size = deviation(&truth.position[..20_000]);
    assert!((0.5..0.7).contains(&size), "{size}");
    let fastest = truth
        .speed
        .iter()
        .fold(0.0_f64, |most, speed| most.max(speed.abs()));
    assert!((40.0..46.0).contains(&fastest), "{fastest}");
    assert_eq!(rig.run(&Course::vehicle(), 5).unwrap(), trace);
    assert_ne!(rig.run(&Course::vehicle(), 6).unwrap(), trace);
}

/// Friction never drives over a whole course, and lies between the limits of sliding. What a calibration has no name for is not named.
#[test]
fn friction_takes_power_and_stays_between_its_limits() {
    for (parameters, named) in [
        (Parameters::default(), true),
        (Parameters::other_physics(), false),
    ] {
        for name in ["viscosity_pole", "breakaway_angle"] {
            assert_eq!(parameters.header().contains(name), named);
        }
        let seal = parameters.seal.map_or(0.0, |[torque, _]| torque);
        let rig = rig(parameters);
        let trace = rig.run(&Course::whole(), 1).unwrap();
        let truth = &trace.truth;
        let (mut work, mut size) = (0.0, 0.0);
        for index in 1..trace.time.len() {
            let turn = truth.position[index] - truth.position[index - 1];
            work += turn * truth.friction[index];
            size += (turn * truth.friction[index]).abs();
            let limits = rig.0.limits(&State {
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

/// The grid of balls against balls that are solved where the grid has none.
#[test]
fn between_the_balls_of_the_grid_lie_balls() {
    // Without preload a bend that moves with the coefficient lies between the balls of the grid.
    for (preload, accepted) in [(700.0, 4e-3), (0.0, 2e-2), (250.0, 2e-2)] {
        let mut screw = Parameters::default().screw;
        screw.axial_preload = preload;
        let torque = SlidingTorque::new(&screw, [0.06, 0.115]).unwrap();
        let clearance = screw.clearance().unwrap();
        let loads =
            (0..25).flat_map(|place| [1.0, -1.0].map(|side| side * 5.0 * 1.3_f64.powi(place)));
        let balls: Vec<LoadedScrew> = loads
            .filter(|load| load.abs() < 3500.0)
            .flat_map(|load| {
                [0.062, 0.067, 0.08, 0.1, 0.113]
                    .map(|friction| screw.loaded(load, friction, clearance))
            })
            .collect();
        for (ball, exact) in balls.iter().zip(LoadedScrew::solve_all(&balls, &|| ())) {
            let error = torque.at(ball.axial_load, ball.friction) / exact.unwrap().torque() - 1.0;
            assert!(error.abs() < accepted, "{preload}: {error} at {ball:?}");
        }
    }
}
