//! Every state of the promised domain has an answer, the same from every start.

use crate::refusals::assert_refused;
use epas_friction::geometry::named;
use epas_reference::ReferenceError;
use epas_reference::friction::ball_screw_efficiency::LoadedScrew;
use epas_reference::friction::held_ball::{HeldBall, HeldBallFriction};
use epas_reference::friction::patch::Integration;
use epas_reference::friction::rolling_resistance::RollingResistance;
use epas_testkit::given;
use epas_testkit::promised::{self, Promised};
use epas_testkit::random::Random;

/// Balance of power that [`epas_reference::friction::ball_screw_row::ElasticRow`] promises.
const POWER_ERROR: f64 = 1e-8;
/// Unbalanced force over the sum of the loads that is accepted.
const RESIDUAL: f64 = 1e-8;
const LOADS: [f64; 8] = [5.0, 9.0, 16.0, 29.0, 52.0, 93.0, 167.0, 300.0];

fn solve_all(seed: u64, count: usize, balls: usize) {
    let mut random = Random(seed);
    for _ in 0..count {
        let state = promised::row(&mut random, balls);
        let found = state
            .row
            .solve()
            .unwrap_or_else(|error| panic!("{error}: {}", state.line()));
        assert!(
            found.power_error.abs() <= POWER_ERROR,
            "{:e} of the power: {}",
            found.power_error,
            state.line()
        );
        let loads = found
            .pressing
            .iter()
            .map(|ball| ball.loads.iter().sum::<f64>())
            .fold(0.0, f64::max);
        assert!(
            found.residual <= RESIDUAL * loads,
            "{:e} N: {}",
            found.residual,
            state.line()
        );
    }
}

#[test]
fn every_ball_has_an_answer() {
    solve_all(11, 40, 1);
    solve_all(12, 8, 2);
}

#[test]
#[ignore = "hundreds of balls"]
fn every_ball_has_an_answer_whole() {
    solve_all(11, 400, 1);
    solve_all(12, 60, 2);
}

fn caged(state: &Promised) -> (HeldBall, f64) {
    let ball = HeldBall {
        design: state.row.design,
        clearance: state.row.clearance,
        friction: state.row.friction,
        rolling: RollingResistance::STEEL,
        integration: Integration::Full,
    };
    (ball, state.row.balls[0].axial_load.signum())
}

fn along(ball: &HeldBall, loads: &[f64], line: &str) -> Vec<HeldBallFriction> {
    ball.along(loads)
        .unwrap()
        .into_iter()
        .map(|found| found.unwrap_or_else(|error| panic!("{error}: {line}")))
        .collect()
}

#[test]
fn all_paths_lead_to_one_answer() {
    compare_paths(5);
}

#[test]
#[ignore = "forty balls"]
fn all_paths_lead_to_one_answer_whole() {
    compare_paths(40);
}

fn compare_paths(balls: usize) {
    let mut random = Random(13);
    for _ in 0..balls {
        let state = promised::row(&mut random, 1);
        let (ball, side) = caged(&state);
        let line = state.line();
        let rising = LOADS.map(|load| side * load);
        let mut falling = rising;
        falling.reverse();
        let up = along(&ball, &rising, &line);
        let down = along(&ball, &falling, &line);
        for ((up, down), load) in up.iter().zip(down.iter().rev()).zip(rising) {
            let alone = LoadedScrew {
                design: ball.design,
                clearance: ball.clearance,
                friction: ball.friction,
                rolling: ball.rolling,
                balls: 1.0,
                axial_load: load,
            };
            let cold = alone
                .solve()
                .unwrap_or_else(|error| panic!("{error}: {load} N, {line}"))
                .torque();
            assert_eq!([up.axial_load, down.axial_load], [load; 2]);
            let off = |torque: f64| (torque / cold - 1.0).abs();
            assert!(
                off(up.torque).max(off(down.torque)) <= 1e-9,
                "{:e} rising, {:e} falling: {load} N, {line}",
                off(up.torque),
                off(down.torque)
            );
        }
    }
}

fn screw() -> HeldBall {
    caged(&promised::row(&mut Random(1), 1)).0
}

#[test]
fn a_caged_ball_names_what_is_wrong() {
    #[rustfmt::skip]
    assert_refused(
        &screw(),
        |ball| ball.along(&[10.0]),
        &[
            ("friction", |b, v| b.friction = v, &[0.0]),
            // Over the ball radius.
            ("clearance", |b, v| b.clearance = v * b.design.ball_radius, &[0.21, -0.051]),
            ("hysteresis_loss", |b, v| b.rolling.hysteresis_loss = v, &[-0.1]),
            ("contact_angle", |b, v| b.design.contact_angle = v, &[1.56]),
        ],
    );
}

#[test]
fn a_wrong_load_of_a_caged_ball_stops_no_other() {
    let found = screw().along(&[10.0, 0.0, f64::NAN, 2e6, 20.0]).unwrap();
    assert_eq!(found[1], Err(ReferenceError::Undriven));
    for wrong in &found[2..4] {
        assert_eq!(wrong.as_ref().unwrap_err().field(), Some("axial_load"));
    }
    for (index, load) in [(0, 10.0), (4, 20.0)] {
        assert_eq!(found[index].as_ref().unwrap().axial_load, load);
    }
    assert_eq!(screw().along(&[]), Ok(vec![]));
}

#[test]
fn a_caged_ball_carries_loads_of_both_signs_in_their_order() {
    let ball = HeldBall {
        clearance: 2e-6,
        ..screw()
    };
    let order = [50.0, 5.0, 300.0];
    for side in [1.0, -1.0] {
        let loads = order.map(|load| side * load);
        let found = along(&ball, &loads, "both signs");
        for (found, load) in found.iter().zip(loads) {
            assert_eq!(found.axial_load, load);
            let alone = along(&ball, &[load], "alone")[0].torque;
            assert!(alone > 0.0 && (found.torque / alone - 1.0).abs() <= 1e-9);
            let [sl, sr, nl, nr] = found.loads;
            let (main, other) = if side > 0.0 {
                ([sl, nr], [sr, nl])
            } else {
                ([sr, nl], [sl, nr])
            };
            let least = main[0].min(main[1]);
            assert!(least > other[0].max(other[1]), "{:?}", found.loads);
            assert!(found.orbital_speed > 0.0 && found.orbital_speed < 1.0);
        }
    }
}

/// A small ball with play under the largest load, from nothing: its third contact is light and sticks.
#[test]
fn a_small_ball_with_play_is_found_from_nothing() {
    let parameters = named("50x5x3.175").unwrap();
    let ball = HeldBall {
        design: given::ball_screw(&parameters),
        clearance: 5e-6,
        friction: 0.15,
        ..screw()
    };
    let loads = [-300.0, -150.0, -75.0, -38.0, -19.0, -10.0, -5.0];
    assert_eq!(along(&ball, &loads, "50x5x3.175").len(), loads.len());
}
