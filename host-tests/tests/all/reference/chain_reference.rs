//! Chains of touching balls: stored chains, the linear model by two methods, and the laws of contact.

use super::linear_cases::{balance, ball, tilted};
use epas_testkit::golden::{file as golden, list_of as list};
use epas_testkit::measured;
use epas_testkit::random::Random;
use std::f64::consts::FRAC_PI_4;

use epas_reference::ReferenceError;
use epas_reference::friction::chain::{LinearChain, solve_chain};
use epas_reference::friction::isotonic::pool_adjacent_violators;
use epas_reference::friction::linear_ball::{LinearBall, PUBLISHED_FORCE_SLOPE};

/// Equations (3.29) to (3.31) row by row from the forces of the solution, and the energy: power in = power lost.
fn check_laws(
    balls: &[LinearBall],
    chain: &LinearChain,
    ball_friction: f64,
    speed: f64,
    name: &str,
) {
    let n = balls.len();
    let mut input = 0.0;
    let mut loss = 0.0;
    for (j, (ball, motion)) in balls.iter().zip(&chain.balls).enumerate() {
        let f = motion.contacts.map(|c| c.force);
        let mut rows = balance(ball, motion);
        for k in [j.wrapping_sub(1), j] {
            let Some(&force) = chain.contact_forces.get(k) else {
                continue;
            };
            rows[0] += if k == j { -force } else { force };
            let slip = [
                chain.balls[k].roll + chain.balls[k + 1].roll,
                chain.balls[k].yaw + chain.balls[k + 1].yaw,
            ];
            let size = slip[0].hypot(slip[1]);
            rows[1] -= ball_friction * force * slip[0] / size;
            rows[2] -= ball_friction * force * slip[1] / size;
        }
        for row in rows {
            measured::assert_at(
                &format!("balance of {name} in N"),
                row,
                format_args!("ball {j}: {rows:?}"),
            );
        }
        input += (f[2] + f[3]) * speed;
        loss += motion.power_loss;
    }
    loss += (0..n - 1)
        .map(|j| ball_friction * chain.contact_forces[j] * chain.ball_slip[j])
        .sum::<f64>();
    assert!((loss - chain.power_loss()).abs() < 1.5e-14 * loss);
    // Derived: unbalanced forces do work at speeds of the order of the track's, on three unknowns a ball; and the same roundings.
    let unbalanced = 6.0 * n as f64 * chain.residual * speed.abs();
    assert!(
        (input - loss).abs() < 1.5e-14 * loss + unbalanced,
        "input {input}, loss {loss}, unbalanced {unbalanced:e}"
    );
    for j in 0..n - 1 {
        let gap_speed = chain.balls[j + 1].ball_speed - chain.balls[j].ball_speed;
        assert!(gap_speed >= -1e-13 * speed.abs() && chain.contact_forces[j] >= 0.0);
        // One of the two is zero. Measured: 0.0; a rounding of a speed times the largest force of 32 N would be 4e-15.
        assert!(
            (gap_speed * chain.contact_forces[j]).abs() < 1e-14 * speed.abs(),
            "contact {j} pulls or parts under load"
        );
    }
}

#[test]
fn stored_chains() {
    for case in golden("friction")["chain"].as_array().unwrap() {
        let deviations: [f64; 4] = list(&case["dbeta"]).try_into().unwrap();
        let rho = list(&case["rho"]);
        let balls: Vec<_> = rho.iter().map(|&rho| ball(deviations, rho)).collect();
        for (ball_friction, force_key, eps_key, _which) in [
            (0.0, "F_mu0", "eps_mu0", 0),
            (0.1, "F_mu0.1", "eps_mu0.1", 1),
        ] {
            let chain = solve_chain(&balls, ball_friction, 0.01).unwrap();
            check_laws(&balls, &chain, ball_friction, 0.01, "stored chains");
            for (force, stored) in chain.contact_forces.iter().zip(list(&case[force_key])) {
                measured::assert_at(
                    "stored chains, contact force in N",
                    force - stored,
                    format_args!("{rho:?} {force_key}: {force}, stored {stored}"),
                );
            }
            for (motion, stored) in chain.balls.iter().zip(list(&case[eps_key])) {
                let off = (motion.speed_deviation - stored).abs();
                measured::assert_at(
                    "stored chains, speed deviation",
                    off,
                    format_args!(
                        "{rho:?} {eps_key}: {} stored {stored}",
                        motion.speed_deviation
                    ),
                );
            }
        }
        // The published closed form with the loads of both contacts of each diagonal.
        let free: Vec<_> = balls
            .iter()
            .map(|b| b.analytic_speed_deviation(FRAC_PI_4))
            .collect();
        let compliance: Vec<_> = balls
            .iter()
            .map(|b| b.analytic_compliance(FRAC_PI_4, PUBLISHED_FORCE_SLOPE))
            .collect();
        let (speeds, forces) = pool_adjacent_violators(&free, &compliance);
        for (values, key) in [
            (&free, "eps_analytic"),
            (&compliance, "s"),
            (&speeds, "x_analytic"),
            (&forces, "F_analytic"),
        ] {
            for (value, stored) in values.iter().zip(list(&case[key])) {
                measured::assert_at(
                    "stored chains, closed form",
                    (value - stored) / stored.abs().max(1.0),
                    format_args!("{rho:?} {key}: {value}, stored {stored}"),
                );
            }
        }
    }
}

#[test]
fn stored_pairs() {
    for case in golden("friction")["pair"].as_array().unwrap() {
        let theta = case["theta_deg"].as_f64().unwrap();
        let rho = case["rho"].as_f64().unwrap();
        let balls = [tilted(theta, rho), tilted(theta, -rho)];
        for (ball_friction, force_key, eps_key) in
            [(0.0, "F_mu0", "eps_mu0"), (0.1, "F_mu0.1", "eps_mu0.1")]
        {
            let chain = solve_chain(&balls, ball_friction, 1.0).unwrap_or_else(|e| {
                panic!("theta = {theta}, rho = {rho}, ball friction {ball_friction}: {e}")
            });
            let stuck = chain.balls.iter().any(|b| b.gap > 0.0);
            let kind = if stuck {
                "sticking pairs"
            } else {
                "stored pairs"
            };
            check_laws(&balls, &chain, ball_friction, 1.0, kind);
            // Where a contact sticks, the stored values rest on a coarser smoothing.
            let force = chain.contact_forces[0];
            let stored = case[force_key].as_f64().unwrap();
            let group = format!("stored pairs, stuck {stuck}");
            let name = format!("theta = {theta}, rho = {rho}, ball friction {ball_friction}");
            let near = measured::of_case(&group, name);
            near("contact force in N", force - stored);
            for (motion, stored) in chain.balls.iter().zip(list(&case[eps_key])) {
                near("speed deviation", motion.speed_deviation - stored);
            }
        }
    }
}

#[test]
fn reversal_swaps_rear_and_front() {
    let pair = [tilted(2.0, -0.6), tilted(2.0, 0.6)];
    let swapped = [pair[1], pair[0]];
    let forward = solve_chain(&pair, 0.1, 1.0).unwrap();
    let backward = solve_chain(&swapped, 0.1, -1.0).unwrap();
    assert!((forward.contact_forces[0] - backward.contact_forces[0]).abs() < 1e-13);
    check_laws(&swapped, &backward, 0.1, -1.0, "reversed pairs");
    assert_eq!(
        solve_chain(&pair, 0.1, -1.0).unwrap().contact_forces[0],
        0.0
    );
    assert_eq!(
        solve_chain(&swapped, 0.1, 1.0).unwrap().contact_forces[0],
        0.0
    );
}

#[test]
fn long_chain_is_solved_and_balanced() {
    let mut random = Random(42);
    let balls: Vec<_> = (0..64)
        .map(|_| {
            let deviations = [0; 4].map(|_| 0.05 * random.signed());
            ball(deviations, 0.6 * random.signed())
        })
        .collect();
    for ball_friction in [0.0, 0.1] {
        let chain = solve_chain(&balls, ball_friction, 0.02).unwrap();
        check_laws(&balls, &chain, ball_friction, 0.02, "long chains");
        let touching = chain.contact_forces.iter().filter(|f| **f > 0.0).count();
        assert!(touching > 10 && touching < 64);
    }
}

#[test]
fn extreme_chains_end() {
    let pair = [tilted(2.0, -0.6), tilted(2.0, 0.6)];
    // Without friction in the grooves there is no force, and the speeds are the limit.
    let smooth = pair.map(|b| LinearBall { friction: 0.0, ..b });
    let chain = solve_chain(&smooth, 0.1, 1.0).unwrap();
    assert_eq!((chain.contact_forces[0], chain.power_loss()), (0.0, 0.0));
    assert!((chain.balls[0].speed_deviation - chain.balls[1].speed_deviation).abs() < 7e-16);
    let rough = pair.map(|b| LinearBall { friction: 0.3, ..b });
    let chain = solve_chain(&rough, 0.3, 1.0).unwrap();
    check_laws(&rough, &chain, 0.3, 1.0, "rough pairs");
    assert_eq!(
        solve_chain(&pair, 0.1, 0.0),
        Err(ReferenceError::Standstill)
    );
    assert!(solve_chain(&[], 0.1, 1.0).is_err());
    assert!(solve_chain(&pair, f64::NAN, 1.0).is_err());
    assert!(
        solve_chain(
            &[
                pair[0],
                LinearBall {
                    ball_radius: 0.004,
                    ..pair[1]
                }
            ],
            0.1,
            1.0
        )
        .is_err()
    );
    assert_eq!(
        solve_chain(
            &[
                pair[0],
                LinearBall {
                    contact_forces: [0.0; 4],
                    ..pair[1]
                }
            ],
            0.1,
            1.0
        ),
        Err(ReferenceError::Undriven)
    );
    for rho in [-0.99, -0.95, -0.93, -0.9, 0.92, 0.96] {
        let balls = [
            tilted(2.0, rho),
            tilted(1.0, -rho),
            tilted(-2.0, rho),
            tilted(3.0, 0.3),
        ];
        for ball_friction in [0.0, 0.1] {
            match solve_chain(&balls, ball_friction, 1.0) {
                Ok(chain) => check_laws(&balls, &chain, ball_friction, 1.0, "chains at the switch"),
                Err(error) => panic!("rho = {rho}, ball friction {ball_friction}: {error}"),
            }
        }
    }
}
