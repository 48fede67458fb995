//! Applications of the static model: Lin 2019, chapter 4, in kind.

use epas_testkit::measured;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::load_studies::Waviness;
use crate::load_studies::lash::{LashTest, Pattern, spread};
use crate::load_studies::tie_rod::{self, RACK_LOAD};
use epas_reference::statics::StaticSolution;
use epas_reference::statics::cases::CaseStudy;
use serde_json::Value;

fn largest(solution: &StaticSolution) -> f64 {
    solution
        .forces
        .iter()
        .flatten()
        .fold(0.0, |most: f64, force| most.max(*force))
}

/// 71 balls take 83 % of 3.75 turns; patterns keep them on the track and apart.
#[test]
fn patterns_fit_on_the_track() {
    let case = CaseStudy::table_4_1();
    let track = 3.75 * std::f64::consts::TAU;
    let ball = 2.0 * (2e-3_f64 / 14.5e-3_f64.hypot(7e-3 / std::f64::consts::TAU)).asin();
    // Half a unit of the last digit.
    assert!((71.0 * ball / track - 0.83).abs() < 5e-3);
    for pattern in Pattern::ALL {
        let azimuths = pattern.azimuths(&case.geometry, 71, 3.75).unwrap();
        assert_eq!(azimuths.len(), 71);
        assert!(
            azimuths
                .windows(2)
                .all(|pair| pair[1] - pair[0] > ball * (1.0 - 1e-12)),
            "{pattern:?}"
        );
        let room = 0.499_999 * ball;
        assert!(
            azimuths[0] >= room && azimuths[70] <= track - room,
            "{pattern:?}"
        );
    }
    assert!(Pattern::Even.azimuths(&case.geometry, 86, 3.75).is_err());
    assert!(Pattern::Even.azimuths(&case.geometry, 0, 3.75).is_err());
}

/// The text: 3.72 % of spread between the patterns in the axial test, 14.7 % in the conical one. With 2 um of oversize an independent
/// solver on another mesh found displacements within 0.4 % of these: axial, half of the range; conical, in one direction. Most of the
/// conical spread is what the larger balls of an uneven pattern push without any force: over the range of the force it is 3 %.
#[test]
fn conical_lash_depends_more_on_ball_locations_than_axial_lash() {
    let golden: Value =
        serde_json::from_str(include_str!("../../../../host-tests/golden/ballscrew.json")).unwrap();
    let golden = &golden["static"]["lash_oversize_0.002"];
    let test = LashTest {
        oversize: 2e-6,
        steps: 21,
    };
    let half = |test: &LashTest, pattern| {
        let side = |force| test.axial(pattern, force).unwrap();
        0.5 * (side(200.0) - side(-200.0))
    };
    let axial = Pattern::ALL.map(|pattern| half(&test, pattern));
    let conical = Pattern::ALL.map(|pattern| test.conical(pattern, 10.0).unwrap());
    let back = Pattern::ALL.map(|pattern| test.conical(pattern, -10.0).unwrap());
    for (found, field) in [(axial, "axial_mm"), (conical, "conical_mm")] {
        for (index, found) in found.into_iter().enumerate() {
            let truth = 1e-3 * golden[field][index].as_f64().unwrap();
            println!("{field} {:?}: {found:e} for {truth:e}", Pattern::ALL[index]);
            measured::assert_at(
                "lash of an independent solver",
                found / truth - 1.0,
                format_args!("{field} {index}: {found} {truth}"),
            );
        }
    }
    let over_range = [0, 1, 2, 3].map(|index| conical[index] - back[index]);
    let loose = LashTest {
        oversize: 0.0,
        steps: 21,
    };
    let loose = Pattern::ALL.map(|pattern| half(&loose, pattern));
    let spreads = [axial, conical, over_range, loose].map(|values| spread(&values));
    println!(
        "spreads: axial, conical, conical over the range, axial without preload: {spreads:.4?}"
    );
    for (found, expected) in spreads.into_iter().zip([0.044, 0.152, 0.029, 0.055]) {
        // Half a unit of the last digit.
        assert!((found - expected).abs() < 5e-4, "{spreads:?}");
    }
}

#[test]
fn lash_curves_rise() {
    let test = LashTest {
        oversize: 2e-6,
        steps: 5,
    };
    let done = AtomicUsize::new(0);
    let count = || {
        done.fetch_add(1, Ordering::Relaxed);
    };
    let curves = test.curves(&count).unwrap();
    assert_eq!(done.into_inner(), 20);
    for curves in &curves {
        for curve in [&curves.axial, &curves.conical] {
            assert!(
                curve.windows(2).all(|pair| pair[1].1 > pair[0].1),
                "{:?}",
                curves.pattern
            );
        }
    }
    let none = LashTest { steps: 1, ..test };
    assert!(none.curves(&|| ()).unwrap_err().field().is_some());
}

/// At 0 degrees the bearing's balls share evenly and the ball screw's nearly so; at 18 degrees the text's bearing takes 1.47 times as much
/// on one ball and its ball screw 3.32 times. Positions of bearing and pinion are not printed: nearer ones give less.
#[test]
fn tie_rod_angle_loads_the_ball_screw_more_than_the_bearing() {
    let angles = [0.0, 0.2, 18_f64.to_radians()];
    let points = tie_rod::over(&angles, &|| ()).unwrap();
    let nut_position = CaseStudy::table_4_1().nut_position;
    for point in &points {
        measured::assert_at(
            "tie rod, residual over the load",
            point.residual / RACK_LOAD,
            format_args!("{}", point.residual),
        );
        // What the screw's balls give to the nut, the bearing's take.
        let on_nut = point.screw.on_nut_about(nut_position);
        let on_outer = point.bearing.on_nut_about(nut_position);
        for axis in 0..3 {
            measured::assert_at(
                "tie rod, forces in N",
                on_nut[axis] - on_outer[axis],
                format_args!("{axis}: {on_nut:?} {on_outer:?}"),
            );
        }
        measured::assert(
            "tie rod, rack load",
            on_nut[2] / (RACK_LOAD * point.angle.cos()) - 1.0,
        );
    }
    let even: Vec<f64> = points[0]
        .bearing
        .forces
        .iter()
        .map(|four| four[0])
        .collect();
    let mean = even.iter().sum::<f64>() / even.len() as f64;
    // Measured: 0.5 %.
    assert!(
        even.iter().all(|force| (force / mean - 1.0).abs() < 0.01),
        "{even:?}"
    );
    let of = |index: usize| points[index].largest();
    let ratios = [0, 1].map(|body| of(2)[body] / of(0)[body]);
    println!(
        "largest load at 18 degrees over 0: ball screw {:.2}, bearing {:.2}",
        ratios[0], ratios[1]
    );
    // Of the text's 3.32 and 1.47, at other positions. Measured: 4.50 and 1.72.
    assert!(
        (2.0..6.0).contains(&ratios[0]) && (1.2..2.2).contains(&ratios[1]),
        "{ratios:?}"
    );
    assert!(ratios[0] > 1.5 * ratios[1]);
    for body in [0, 1] {
        assert!((1..3).all(|index| of(index)[body] > of(index - 1)[body]));
    }
}

/// Roundness takes 25 of the 71 balls of Table 4.1 off the groove, pitch error of the same size none; on the
/// screw of Table 2.1 none is lost, but the loads go from 1.8 to 106 N.
#[test]
fn roundness_error_loosens_balls_and_pitch_error_does_not() {
    let long = CaseStudy::table_4_1();
    let [pitch, round] =
        [Waviness::Pitch, Waviness::Roundness].map(|error| error.loads(&long, 5e-6).unwrap());
    assert_eq!([pitch.balls_lost, round.balls_lost], [0, 25]);
    // Measured: 1.65.
    assert!(largest(&round) > 1.5 * largest(&pitch));
    let short = CaseStudy {
        axial_load: 1000.0,
        ..CaseStudy::table_2_1()
    };
    let round = Waviness::Roundness.loads(&short, 5e-6).unwrap();
    let least = round
        .forces
        .iter()
        .fold(f64::INFINITY, |least, four| least.min(four[0]));
    assert_eq!(round.balls_lost, 0);
    // Half a unit of the last digit, here and below.
    assert!(
        (least - 1.8).abs() < 0.05 && (largest(&round) - 106.0).abs() < 0.5,
        "{least}"
    );
    let nominal = short.load().unwrap().solve().unwrap();
    assert!((largest(&nominal) - 47.9).abs() < 0.05);
}

/// Case 1 of section 2.4 with more balls: as many turns as they need at the same distance, on a screw as much longer, under the same
/// load per ball.
fn long_nut(balls: usize) -> CaseStudy {
    let case = CaseStudy::table_2_1();
    let factor = balls as f64 / case.balls as f64;
    let nut = factor * case.balls as f64 * case.ball_spacing * case.geometry.advance();
    let screw_length = case.screw_length.max(nut + 0.2);
    CaseStudy {
        balls,
        axial_load: factor * case.axial_load,
        screw_length,
        nut_position: 0.5 * screw_length,
        ..case
    }
}

/// Any number of balls, in a handful of steps.
#[test]
fn long_nuts_are_solved_in_as_many_steps() {
    for balls in [1, 2, 32, 100, 1000] {
        let solution = long_nut(balls).load().unwrap().solve().unwrap();
        assert!(
            solution.iterations <= 15,
            "{balls}: {}",
            solution.iterations
        );
        measured::assert_at(
            "long nuts, residual in N",
            solution.residual,
            format_args!("{balls}: {}", solution.residual),
        );
    }
}
