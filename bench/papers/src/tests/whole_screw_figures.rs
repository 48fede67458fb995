//! Figures 3.24 and 3.25 of Lin 2019: the closed form of a whole screw beside the exact ring.

use crate::published::balls::{peak_and_release, whole_screw};
use epas_reference::design::BallScrewDesign;
use epas_reference::friction::ball_screw_ball::ScrewTrack;
use epas_reference::friction::ball_screw_elastic::BallSlip;
use epas_reference::friction::ball_screw_ring::{
    ElasticRing, GrooveDeviation, RingState, steady_samples,
};
use epas_reference::friction::patch::Integration;
use epas_reference::friction::whole_screw::WholeScrew;
use std::f64::consts::{PI, TAU};

const DEGREE: f64 = PI / 180.0;

/// The closed form beside the exact ring, where it is at its best: 10 N a ball. It has the same three-point contact, and its orbital speeds
/// leave out that friction shifts the contacts, and that a third contact with less load slides.
#[test]
fn closed_form_beside() {
    let track = ScrewTrack::from(&BallScrewDesign::LIN);
    let turns = 9.15 * 2.0 * track.ball_contact_angle().0.asin() / TAU;
    let cycles = 2.0 / turns;
    let load = -10.0 * 9.0;
    let ring = ElasticRing {
        design: BallScrewDesign::LIN,
        clearance: 0.0,
        friction: 0.1,
        ball_friction: 0.1,
        balls: 9,
        turns,
        return_length: 0.0,
        screw_deviation: GrooveDeviation::sine(cycles, 2.5 * DEGREE),
        nut_deviation: GrooveDeviation::NONE,
        load_shares: Vec::new(),
        // The closed form has forces along the track alone.
        chord: false,
        places: Vec::new(),
        integration: Integration::Full,
    };
    let samples = steady_samples(TAU, load, TAU, 90);
    let exact = ring.simulate(&samples, |_, _| {}).unwrap();
    assert!(exact.iter().all(RingState::solved));
    let closed = WholeScrew {
        balls: 9,
        turns,
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

/// Figure 3.25 by the closed form. Peak against amplitude: 26/48/63/107 % at 108/104/97/94 degrees, released from 248/266/274/299
/// degrees. The published 49.6 % at 126 degrees and release at 306 degrees are not met by one amplitude: Figure 3.23 gives none in the text.
#[test]
fn figure_3_25_peaks_against_amplitude() {
    let found = |degrees: f64| {
        let screw = whole_screw(degrees * DEGREE).unwrap();
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
        let total = found(degrees);
        for (value, printed) in total.iter().zip(printed) {
            // Half a unit of the last digit.
            assert!((value - printed).abs() < 0.5, "{degrees} deg: {total:?}");
        }
    }
}
