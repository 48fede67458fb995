//! Figures 3.24 and 3.25 of Lin 2019: the closed form of a whole screw beside the exact ring.

use epas_papers::published::balls::{peak_and_release, whole_screw};
use epas_reference::design::BallScrewDesign;
use epas_reference::friction::ball_screw_ball::ScrewTrack;
use epas_reference::friction::ball_screw_elastic::BallSlip;
use epas_reference::friction::ball_screw_ring::{
    ElasticRing, GrooveDeviation, RingSample, RingState, steady_samples,
};
use epas_reference::friction::patch::Integration;
use epas_reference::friction::whole_screw::WholeScrew;
use std::f64::consts::{PI, TAU};

use epas_testkit::measured;

const DEGREE: f64 = PI / 180.0;

/// Azimuth between two touching balls.
fn pitch() -> f64 {
    2.0 * ScrewTrack::from(&BallScrewDesign::LIN)
        .ball_contact_angle()
        .0
        .asin()
}

/// The screw of Figures 3.24 and 3.25 with an amplitude in degrees.
fn published(degrees: f64) -> ElasticRing {
    ElasticRing {
        design: BallScrewDesign::LIN,
        clearance: 0.0,
        friction: 0.1,
        ball_friction: 0.1,
        balls: 37,
        turns: 2.0,
        return_length: 0.0,
        screw_deviation: GrooveDeviation::sine(2.0, degrees * DEGREE),
        nut_deviation: GrooveDeviation::NONE,
        load_shares: Vec::new(),
        // The closed form beside it has forces along the track alone.
        chord: false,
        places: Vec::new(),
        integration: Integration::Full,
    }
}

fn run(ring: &ElasticRing, samples: &[RingSample]) -> Vec<RingState> {
    let states = ring.simulate(samples, |_, _| {}).unwrap();
    for state in &states {
        assert!(state.solved(), "{:?}", state.failure);
    }
    states
}

/// The closed form beside the exact ring, where it is at its best: 10 N a ball. It has the same three-point contact, and its orbital speeds
/// leave out that friction shifts the contacts, and that a third contact with less load slides.
#[test]
fn closed_form_beside() {
    let mut ring = published(2.5);
    ring.balls = 9;
    ring.turns = 9.15 * pitch() / TAU;
    let cycles = 2.0 / ring.turns;
    ring.screw_deviation = GrooveDeviation::sine(cycles, 2.5 * DEGREE);
    let load = -10.0 * 9.0;
    let exact = run(&ring, &steady_samples(TAU, load, TAU, 90));
    let closed = WholeScrew {
        balls: 9,
        turns: ring.turns,
        cycles,
        axial_load: load,
        ball_slip: BallSlip::Orbiting,
        ..whole_screw(2.5 * DEGREE).unwrap()
    };
    let closed = closed.simulate(TAU, 90, 8).unwrap();
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    let peak = largest(&mut exact.iter().map(|s| s.ball_torque));
    let closed_peak = largest(&mut closed.iter().map(|s| s.ball_torque));
    let groove = closed[0].groove_torque() / exact[0].groove_torque;
    println!("ball torque {}, groove torque {groove}", closed_peak / peak);
    assert!(peak > 0.0);
    // Measured: 11 % too much for the force's sign that takes load from the third contact, and 1.4 % of groove torque.
    assert!((closed_peak / peak - 1.112).abs() < 0.01);
    assert!((groove - 1.0141).abs() < 1e-3);
}

/// Figures 3.24 and 3.25 by the exact ring. Published: a peak of 49.6 % of the groove torque at 126 degrees, and no contacts from 306 degrees
/// on; Figure 3.23 gives no amplitude in the text. By amplitude, at 720 states: peak, its angle, release, all as printed here to the last
/// digit of the table.
#[test]
#[ignore = "half a minute"]
fn figures_3_24_and_3_25() {
    for (degrees, load, peak, at, release) in [
        (2.0, -1500.0, 20.8, 109.0, 246.0),
        (2.3, -1500.0, 38.2, 104.0, 263.0),
        (2.5, -1500.0, 49.1, 97.0, 272.0),
        (3.0, -1500.0, 74.3, 102.0, 298.0),
        (2.3, 1500.0, 29.1, 108.0, 261.0),
        (3.0, 1500.0, 51.1, 100.0, 270.0),
    ] {
        let ring = published(degrees);
        let samples = steady_samples(TAU, load, 2.0 * TAU, 720);
        let states = run(&ring, &samples);
        let exact = states
            .iter()
            .map(|s| (s.nut_angle, s.groove_torque, s.ball_torque));
        let closed = WholeScrew {
            axial_load: load,
            ball_slip: BallSlip::Orbiting,
            ..whole_screw(degrees * DEGREE).unwrap()
        };
        let closed = closed.simulate(2.0 * TAU, 720, 4).unwrap();
        let closed = closed
            .iter()
            .map(|s| (s.nut_angle, s.groove_torque(), s.ball_torque));
        let found = peak_and_release(exact);
        println!(
            "{degrees} deg {load} N: exact {found:?}, closed {:?}",
            peak_and_release(closed)
        );
        // Measured: 0.03 and 0.0; other rounding may move an event from one state to the next, by a degree.
        assert!((found[0] - peak).abs() < 0.09, "{found:?}");
        assert!(
            (found[1] - at).abs() < 1.5 && (found[2] - release).abs() < 1.5,
            "{found:?}"
        );
    }
}

/// Figure 3.25 by the closed form. Peak against amplitude: 26/48/63/107 % at 108/104/97/94 degrees, released from 248/266/274/299
/// degrees. The published 49.6 % at 126 degrees and release at 306 degrees are not met by one amplitude: Figure 3.23 gives none in the text.
#[test]
fn figure_3_25_peaks_against_amplitude() {
    let found = |degrees: f64, ball_slip: BallSlip| {
        let screw = WholeScrew {
            ball_slip,
            ..whole_screw(degrees * DEGREE).unwrap()
        };
        let run = screw.simulate(2.0 * TAU, 200, 1).unwrap();
        let states = run.iter();
        peak_and_release(states.map(|s| (s.nut_angle, s.main_torque, s.ball_torque)))
    };
    for (degrees, printed) in [
        (2.0, [26.0, 108.0, 248.0]),
        (2.3, [48.0, 104.0, 266.0]),
        (2.5, [63.0, 97.0, 274.0]),
        (3.0, [107.0, 94.0, 299.0]),
    ] {
        let total = found(degrees, BallSlip::Total);
        for (value, printed) in total.iter().zip(printed) {
            // Half a unit of the last digit.
            assert!((value - printed).abs() < 0.5, "{degrees} deg: {total:?}");
        }
        // The relative slip between balls is 12 per cent less, and so is their torque.
        let [relative, ..] = found(degrees, BallSlip::Orbiting);
        measured::assert_at(
            "whole screw, torque by the relative slip",
            relative / total[0] - 0.88,
            format_args!("{relative:?}"),
        );
    }
}
