//! Rows of balls in elastic grooves: stored pairs with play and oversize, and the laws of the model.

use crate::kit::random::Random;
use epas_reference::ReferenceError;
use epas_reference::design::BallScrewDesign;
use epas_reference::friction::ball_screw_row::{ElasticRow, RowBall, RowMotion};
use epas_reference::material::Elastic;
use serde_json::Value;
use std::f64::consts::TAU;

fn golden() -> Value {
    let text = include_str!("../../golden/ballscrew_exact.json");
    serde_json::from_str(text).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    std::array::from_fn(|i| number(&value[i]))
}

fn design(all: &Value, name: &str) -> BallScrewDesign {
    let stored = &all["meta"]["designs"][name];
    let length = |key: &str| number(&stored[key]) * 1e-3;
    let steel = Elastic {
        youngs_modulus: number(&stored["E"]) * 1e6,
        poisson_ratio: number(&stored["nu"]),
    };
    BallScrewDesign {
        pitch_radius: length("pitch_radius"),
        lead: length("pitch"),
        ball_radius: length("ball_radius"),
        screw_groove_radius: length("groove_radius"),
        nut_groove_radius: length("groove_radius"),
        contact_angle: number(&stored["contact_angle_deg"]).to_radians(),
        ball: steel,
        groove: steel,
    }
}

/// A stored pair. Its force has a sign; where it is negative, the balls press in the other order.
fn row(all: &Value, case: &Value) -> ElasticRow {
    let side = if case["pair"] == "SRNL" { -1.0 } else { 1.0 };
    let of = |key: &str| numbers::<2>(&case[key]);
    let balls = [0, 1].map(|i| RowBall {
        screw_deviation: of("screw_deviation_deg")[i].to_radians(),
        nut_deviation: of("nut_deviation_deg")[i].to_radians(),
        axial_load: side * of("axial_load_N")[i],
    });
    ElasticRow {
        design: design(all, case["design"].as_str().unwrap()),
        clearance: number(&case["clearance_um"]) * 1e-6,
        friction: number(&case["friction"]),
        ball_friction: 0.0,
        nut_speed: TAU,
        balls: balls.to_vec(),
    }
}

#[test]
fn stored_pairs() {
    let all = golden();
    let mut worst = [0.0_f64; 5];
    for case in all["cases"].as_array().unwrap() {
        let mut row = row(&all, case);
        let stored = number(&case["ball_force_N"]);
        let swapped = stored < 0.0;
        if swapped {
            row.balls.reverse();
        }
        let solved = match row.solve() {
            Ok(s) => s,
            Err(e) => {
                println!("FAILED {case} {e}");
                continue;
            }
        };
        let place = |i: usize| if swapped { 1 - i } else { i };
        let found = solved.contact_forces[0];
        let force = (found / stored.abs() - 1.0).abs();
        println!("{found} {stored} {force:.1e} res {:.1e} pow {:.1e}", solved.residual, solved.power_error);
        worst[0] = worst[0].max(force);
        for (i, key) in [(0, "ball1"), (1, "ball2")] {
            let (free, pressing) = (&solved.free[place(i)], &solved.pressing[place(i)]);
            worst[1] = worst[1].max(
                (free.motion.orbital_speed / TAU - number(&case["free_orbital_speed"][i])).abs(),
            );
            for (ball, state) in [(free, "free"), (pressing, "pressed")] {
                let loads: [f64; 4] = numbers(&case[format!("{state}_loads_{key}_N")]);
                for (a, b) in ball.loads.iter().zip(loads) {
                    worst[2] = worst[2].max((a - b).abs());
                }
                let torque = number(&case[format!("groove_torque_{state}_Nm")][i]);
                worst[3] = worst[3].max((ball.motion.power_loss / TAU / torque - 1.0).abs());
            }
        }
        worst[4] = worst[4].max(solved.residual);
    }
    println!("{worst:?}");
}

/// A pair over the whole range of fits, loads and deviations, on either stored design.
fn random_row(random: &mut Random, all: &Value, balls: usize) -> ElasticRow {
    let side = f64::from(random.sign());
    let name = random.of(&["lin36", "b25x10"]);
    let turned = 3.0_f64.to_radians();
    ElasticRow {
        design: design(all, name),
        clearance: random.between(-5e-6, 10e-6),
        friction: random.between(0.03, 0.15),
        ball_friction: 0.0,
        nut_speed: TAU * f64::from(random.sign()),
        balls: (0..balls)
            .map(|_| RowBall {
                screw_deviation: turned * random.signed(),
                nut_deviation: turned * random.signed(),
                axial_load: side * 5.0 * 60.0_f64.powf(random.between(0.0, 1.0)),
            })
            .collect(),
    }
}

#[test]
#[ignore = "minutes"]
fn random_pairs() {
    let all = golden();
    let mut random = Random(1);
    let (mut solved, mut asked) = (0, 0);
    let start = std::time::Instant::now();
    for k in 0..500 {
        let t = std::time::Instant::now();
        let row = random_row(&mut random, &all, 2);
        asked += 1;
        match row.solve() {
            Ok(found) => {
                solved += 1;
                if !(found.residual < 1e-7 && found.power_error.abs() < 1e-9) { println!("WEAK {:e} {:e}", found.residual, found.power_error); }
            }
            Err(error) => println!("{error}: mu {} g {} w {} {:?}", row.friction, row.clearance*1e6, row.nut_speed, row.balls),
        }
        if t.elapsed().as_secs_f64() > 0.3 { println!("SLOW {k} {:?}", t.elapsed()); }
    }
    println!("{solved} of {asked} in {:?}", start.elapsed());
}
