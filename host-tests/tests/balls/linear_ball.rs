//! One ball and chains of balls in a linear bearing: published tables, tabulated cases, and the least
//! exact dissipation found by an f64 minimiser.

use crate::kit::errors::Errors;
use crate::kit::exact_ball::{ExactBall, ExactMap};
use crate::kit::golden;
use crate::kit::measured;
use crate::kit::random::Random;
use epas_friction::ball::{AnalyticLinearBall, LinearBallParameters, PUBLISHED_SLOPE};
use epas_friction::promises;
use epas_friction::refined::{BallChain, FourPointBall, FourPointContacts};
use std::f64::consts::FRAC_PI_4;
use std::sync::OnceLock;

const BALL_RADIUS: f64 = 0.005;
const AXIS_RATIO: f64 = 0.232_146_373_366_069_72;
const PSI: f64 = 5.307e-4;
const FRICTION: f64 = 0.1;

/// The ball of Lin 2019, Table 3.3.
fn parameters() -> LinearBallParameters {
    LinearBallParameters {
        ball_radius: BALL_RADIUS as f32,
        contact_angle: FRAC_PI_4 as f32,
        axis_ratio: AXIS_RATIO as f32,
        semi_major_coefficient: (PSI * BALL_RADIUS.cbrt()) as f32,
        friction: FRICTION as f32,
    }
}

fn ball() -> FourPointBall {
    FourPointBall::linear(&parameters()).unwrap()
}

fn analytic() -> AnalyticLinearBall {
    AnalyticLinearBall::new(&parameters(), PUBLISHED_SLOPE).unwrap()
}

/// The exact ball of the case study.
fn exact(angles: [f64; 4], forces: [f64; 4]) -> ExactBall {
    static MAP: OnceLock<ExactMap> = OnceLock::new();
    ExactBall {
        map: *MAP.get_or_init(|| ExactMap::new(AXIS_RATIO)),
        friction: FRICTION,
        semi_major: PSI * BALL_RADIUS.powf(-2.0 / 3.0),
        angles,
        forces,
    }
}

/// Contact angles and forces where the bottom groove is turned: `N_y` = 100 N and `N_x = rho N_y` act on
/// the top groove and give its contact forces, the ball's equilibrium gives those of the bottom.
fn loaded(deviations: [f64; 4], rho: f64) -> ([f64; 4], [f64; 4]) {
    let angles = deviations.map(|deviation| FRAC_PI_4 + deviation);
    let [
        (sin_bl, cos_bl),
        (sin_br, cos_br),
        (sin_tr, cos_tr),
        (sin_tl, cos_tl),
    ] = angles.map(f64::sin_cos);
    // F_TR sin - F_TL sin = -N_x, F_TR cos + F_TL cos = N_y.
    let determinant = sin_tr * cos_tl + sin_tl * cos_tr;
    let top_right = 100.0 * (sin_tl - rho * cos_tl) / determinant;
    let top_left = 100.0 * (sin_tr + rho * cos_tr) / determinant;
    let across = top_right * sin_tr - top_left * sin_tl;
    let down = top_right * cos_tr + top_left * cos_tl;
    // F_BL sin - F_BR sin = across, F_BL cos + F_BR cos = down.
    let determinant = sin_bl * cos_br + sin_br * cos_bl;
    let bottom_left = (across * cos_br + down * sin_br) / determinant;
    let bottom_right = (down * sin_bl - across * cos_bl) / determinant;
    (
        angles,
        [
            bottom_left.max(0.0),
            bottom_right.max(0.0),
            top_right.max(0.0),
            top_left.max(0.0),
        ],
    )
}

/// The case of Lin 2019, Section 3.3.4: only the bottom groove is turned.
fn turned(degrees: f64, rho: f64) -> ([f64; 4], [f64; 4]) {
    let turn = degrees.to_radians();
    loaded([-turn, turn, 0.0, 0.0], rho)
}

fn single(values: [f64; 4]) -> [f32; 4] {
    values.map(|value| value as f32)
}

fn contacts((angles, forces): ([f64; 4], [f64; 4])) -> FourPointContacts {
    ball().contacts(&single(angles), &single(forces))
}

/// Balls in a row after the start and `steps` steps.
fn row<const N: usize>(
    contacts: &[FourPointContacts; N],
    direction: f32,
    ball_friction: f32,
    steps: usize,
) -> BallChain<N> {
    let ball = ball();
    let mut chain = BallChain::new();
    chain.balls = contacts.map(|contacts| ball.start(&contacts));
    let mut room = [0.0; N];
    room[N - 1] = f32::INFINITY;
    for _ in 0..steps {
        assert!(ball.refine_chain(contacts, &mut chain, &room, direction, ball_friction));
    }
    chain
}

#[test]
fn statics_of_the_case_study_are_those_of_the_tables() {
    for case in golden::list("single") {
        let (_, forces) = turned(
            golden::number(&case, "theta_deg"),
            golden::number(&case, "rho"),
        );
        for (force, given) in forces.into_iter().zip(golden::numbers(&case, "F")) {
            // A dozen roundings, 1.1e-16 each, of loads of 100 N.
            assert!((force - given).abs() < 1.4e-13, "{case}");
        }
    }
}

#[test]
fn exact_minimiser_agrees_with_the_tabulated_balls() {
    let (mut worst, mut worst_power) = (0.0_f64, 0.0_f64);
    for case in golden::list("single") {
        let (angles, forces) = turned(
            golden::number(&case, "theta_deg"),
            golden::number(&case, "rho"),
        );
        let (motion, dissipation) = exact(angles, forces).solve(0.0);
        let eps = 2.0 * motion[0] - 1.0;
        worst = worst.max((eps - golden::number(&case, "eps")).abs());
        measured::assert_at(
            "exact ball, speed deviation",
            eps - golden::number(&case, "eps"),
            format_args!("{case}\n{eps}"),
        );
        let power = golden::number(&case, "P_over_v");
        worst_power = worst_power.max((dissipation / power - 1.0).abs());
        measured::assert_at(
            "exact ball, loss",
            dissipation / power - 1.0,
            format_args!("{case}\n{dissipation}"),
        );
    }
    println!("minimiser against tables: deviation {worst:.1e}, loss {worst_power:.1e} relative");
}

#[test]
fn table_3_4_velocity_deviations() {
    // Case (a): 0.87 and -0.79 % by the numerical model, ±0.75 % by the formula; the digits that
    // follow are those of the exact model.
    for (rho, numerical, formula) in [(-0.6, 0.008712, 0.0075), (0.6, -0.007863, -0.0075)] {
        let (angles, forces) = turned(2.0, rho);
        let state = ball().solve(&contacts((angles, forces)));
        measured::assert_at(
            "Table 3.4, refined",
            f64::from(state.speed_deviation) - numerical,
            format_args!("{state:?}"),
        );
        // The formula takes the two diagonals with the forces (1 ± rho)/sqrt 2.
        let [_, _, right, left] = single(forces);
        let found = analytic().speed_deviation(&single(angles), &[right, left, right, left]);
        // Printed to 0.01 %: half a unit of the last digit.
        assert!(
            (f64::from(found.speed_deviation) - formula).abs() < 5e-5,
            "{found:?}"
        );
    }
    // Case (b): the top groove turned alike, no deviation at any load.
    for rho in [-0.6, 0.0, 0.6] {
        let turn = 2_f64.to_radians();
        let state = ball().solve(&contacts(loaded([-turn, turn, -turn, turn], rho)));
        measured::assert_at(
            "mated top groove, speed deviation",
            state.speed_deviation,
            format_args!("{rho}: {state:?}"),
        );
    }
}

#[test]
fn table_3_5_ball_to_ball_force() {
    let pair = [contacts(turned(2.0, -0.6)), contacts(turned(2.0, 0.6))];
    // 4.01 N by the numerical model; 4.023 N without and 4.065 N with friction between the balls.
    for (ball_friction, force) in [(0.0, 4.023), (0.1, 4.065)] {
        let forces = row(&pair, 1.0, ball_friction, 3).forces;
        measured::assert_at(
            "Table 3.5, refined force in N",
            forces[0] - force,
            format_args!("{forces:?}"),
        );
    }
    // 3.74 N by the formula.
    let [rear, front] = [-0.6, 0.6].map(|rho| {
        let (angles, forces) = turned(2.0, rho);
        let [_, _, right, left] = single(forces);
        analytic().speed_deviation(&single(angles), &[right, left, right, left])
    });
    // Half a unit of its last digit.
    assert!((rear.contact_force(&front) - 3.745).abs() < 5e-4);
    assert_eq!(front.contact_force(&rear), 0.0);
}

/// The closed form, and the states after 0 to 3 impedance steps.
const LABELS: [&str; 5] = ["(3.43)", "start", "+1", "+2", "+3"];

#[test]
fn tabulated_single_balls() {
    println!("speed deviation, in units of v/2");
    for (name, near) in [
        ("four-point", false),
        ("next to the two-point switch", true),
    ] {
        let mut errors = LABELS.map(|label| Errors::of(format!("{name}, {label}")));
        let mut loss = Errors::of(format!("{name}, loss"));
        for case in golden::list("single") {
            if case["near_two_point"].as_bool().unwrap() != near {
                continue;
            }
            let (angles, forces) = turned(
                golden::number(&case, "theta_deg"),
                golden::number(&case, "rho"),
            );
            let eps = golden::number(&case, "eps");
            let formula = analytic().speed_deviation(&single(angles), &single(forces));
            errors[0].add(f64::from(formula.speed_deviation) - eps);
            let contacts = contacts((angles, forces));
            let start = ball().start(&contacts);
            for (steps, errors) in (0..4).zip(&mut errors[1..]) {
                let state = ball().refine(&contacts, &start, 0.0, steps);
                errors.add(f64::from(state.speed_deviation) - eps);
                if steps == 3 {
                    let power = golden::number(&case, "P_over_v");
                    loss.add(f64::from(state.friction_force) / power - 1.0);
                }
            }
        }
        for errors in errors.iter().chain([&loss]) {
            errors.assert_measured();
        }
    }
}

#[test]
fn random_contact_angles_and_side_forces() {
    let mut random = Random(1);
    let mut errors = LABELS.map(|label| Errors::of(format!("random linear ball, {label}")));
    let mut loss = Errors::of("random linear ball, loss");
    for _ in 0..400 {
        let deviations = [0; 4].map(|_| 3_f64.to_radians() * random.signed());
        let rho = 0.8 * random.signed();
        let (angles, forces) = loaded(deviations, rho);
        let (motion, dissipation) = exact(angles, forces).solve(0.0);
        let eps = 2.0 * motion[0] - 1.0;
        let formula = analytic().speed_deviation(&single(angles), &single(forces));
        errors[0].add(f64::from(formula.speed_deviation) - eps);
        let contacts = contacts((angles, forces));
        let start = ball().start(&contacts);
        for (steps, errors) in (0..4).zip(&mut errors[1..]) {
            let state = ball().refine(&contacts, &start, 0.0, steps);
            let error = f64::from(state.speed_deviation) - eps;
            errors.add_at(error, format_args!("deviations {deviations:?} rho {rho}"));
            if steps == 3 {
                loss.add(f64::from(state.friction_force) / dissipation - 1.0);
            }
        }
    }
    errors[0].assert_promised(&promises::ANALYTIC_BALL);
    errors[3].assert_promised(&promises::FOUR_POINT_BALL);
    errors[4].assert_measured();
    loss.assert_measured();
}

/// Other contact angles, and loads down to where contact angle deviations move the contacts by several
/// times their own size.
#[test]
fn other_designs_and_loads() {
    let mut random = Random(1);
    println!("load, contact angle: largest error after 2, 3 and 5 steps, in units of v/2");
    for load in [1.0, 10.0, 100.0, 1000.0] {
        for degrees in [30.0_f64, 45.0, 60.0] {
            let contact_angle = degrees.to_radians();
            let ball = FourPointBall::linear(&LinearBallParameters {
                contact_angle: contact_angle as f32,
                ..parameters()
            })
            .unwrap();
            let mut worst = [0.0_f64; 3];
            for _ in 0..20 {
                let angles = [0; 4].map(|_| contact_angle + 3_f64.to_radians() * random.signed());
                let rho = 0.6 * random.signed();
                let sides = [1.0 - rho, 1.0 + rho, 1.0 - rho, 1.0 + rho];
                let forces = sides.map(|side| load * side * (1.0 + 0.05 * random.signed()));
                let exact = 2.0 * exact(angles, forces).solve(0.0).0[0] - 1.0;
                let contacts = ball.contacts(&single(angles), &single(forces));
                let start = ball.start(&contacts);
                for (worst, steps) in worst.iter_mut().zip([2, 3, 5]) {
                    let state = ball.refine(&contacts, &start, 0.0, steps);
                    let error = (f64::from(state.speed_deviation) - exact).abs();
                    measured::assert_at(
                        &format!("other designs, {load} N, {steps} steps"),
                        error,
                        format_args!("angles {angles:?} forces {forces:?}"),
                    );
                    *worst = worst.max(error);
                }
                let solved = ball.solve(&contacts);
                assert_eq!(solved, ball.refine(&contacts, &start, 0.0, 5));
            }
            println!(
                "{load} N, {degrees}: {}",
                worst.map(|e| format!("{e:.1e}")).join(", ")
            );
        }
    }
}

#[test]
fn side_force_sweep_up_to_two_point_rolling() {
    println!("largest error in units of v/2 over |theta| <= 3 degrees");
    println!("rho | (3.43) | start | +1 | +2 | +3 | largest deviation");
    for rho in [
        0.0, 0.2, 0.4, 0.5, 0.6, 0.7, 0.8, 0.85, 0.9, 0.93, 0.96, 0.99,
    ] {
        let mut worst = [0.0_f64; 5];
        let mut largest = 0.0_f64;
        for degrees in -3..=3 {
            for side in [-1.0, 1.0] {
                let (angles, forces) = turned(f64::from(degrees), side * rho);
                let (motion, _) = exact(angles, forces).solve(0.0);
                let eps = 2.0 * motion[0] - 1.0;
                largest = largest.max(eps.abs());
                let formula = analytic().speed_deviation(&single(angles), &single(forces));
                worst[0] = worst[0].max((f64::from(formula.speed_deviation) - eps).abs());
                let contacts = contacts((angles, forces));
                let start = ball().start(&contacts);
                for (steps, worst) in (0..4).zip(&mut worst[1..]) {
                    let state = ball().refine(&contacts, &start, 0.0, steps);
                    *worst = worst.max((f64::from(state.speed_deviation) - eps).abs());
                }
            }
        }
        println!(
            "{rho:.2} | {} | {largest:.1e}",
            worst.map(|error| format!("{error:.1e}")).join(" | ")
        );
        if rho <= 0.8 {
            measured::assert("side force to 0.8, +2", worst[3]);
            measured::assert("side force to 0.8, +3", worst[4]);
        }
        if rho <= 0.6 {
            measured::assert("side force to 0.6, (3.43)", worst[0]);
            measured::assert("side force to 0.6, start", worst[1]);
        }
        // Around the switch the speed itself jumps by up to 0.025.
        measured::assert("any side force, +3", worst[4]);
    }
}

#[test]
fn tabulated_pairs() {
    for near in [false, true] {
        let kind = if near {
            "pairs near the switch"
        } else {
            "pairs"
        };
        let mut errors = ["0", "0.1"].map(|ball_friction| {
            [1, 2, 3]
                .map(|steps| Errors::of(format!("{kind}, ball friction {ball_friction}, +{steps}")))
        });
        let mut formula_errors = Errors::of(format!("{kind}, (3.51)"));
        for case in golden::list("pair") {
            if (golden::number(&case, "rho").abs() > 0.8) != near {
                continue;
            }
            let (degrees, rho) = (
                golden::number(&case, "theta_deg"),
                golden::number(&case, "rho"),
            );
            let pair = [turned(degrees, rho), turned(degrees, -rho)];
            let [rear, front] =
                pair.map(|(a, f)| analytic().speed_deviation(&single(a), &single(f)));
            formula_errors
                .add(f64::from(rear.contact_force(&front)) - golden::number(&case, "F_mu0"));
            for (which, (ball_friction, name)) in
                [(0.0, "F_mu0"), (0.1, "F_mu0.1")].into_iter().enumerate()
            {
                for steps in 1..=3 {
                    let BallChain { balls, forces, .. } =
                        row(&pair.map(contacts), 1.0, ball_friction, steps);
                    let error = f64::from(forces[0]) - golden::number(&case, name);
                    errors[which][steps - 1].add(error);
                    if steps == 3 && forces[0] > 0.0 && !near {
                        // Touching balls keep step.
                        let [rear, front] = balls.map(|ball| ball.speed_deviation);
                        measured::assert_at(
                            "touching balls in step",
                            rear - front,
                            format_args!("{case}"),
                        );
                    }
                }
            }
        }
        for errors in errors.iter().flatten().chain([&formula_errors]) {
            errors.assert_measured();
        }
    }
}

#[test]
fn tabulated_chains() {
    fn check<const N: usize>(case: &serde_json::Value, errors: &mut [Errors; 2]) {
        let deviations: [f64; 4] = golden::numbers(case, "dbeta").try_into().unwrap();
        let rho: [f64; N] = golden::numbers(case, "rho").try_into().unwrap();
        let contacts = rho.map(|rho| contacts(loaded(deviations, rho)));
        for ((ball_friction, suffix), errors) in
            [(0.0, "mu0"), (0.1, "mu0.1")].into_iter().zip(errors)
        {
            let BallChain { balls, forces, .. } = row(&contacts, 1.0, ball_friction, 3);
            for (force, given) in forces
                .iter()
                .zip(golden::numbers(case, &format!("F_{suffix}")))
            {
                errors.add(f64::from(*force) - given);
            }
            let speeds = golden::numbers(case, &format!("eps_{suffix}"));
            for (state, given) in balls.iter().zip(speeds) {
                measured::assert_at(
                    "tabulated chains, speed deviation",
                    f64::from(state.speed_deviation) - given,
                    format_args!("{case}\n{balls:?}"),
                );
            }
        }
    }
    let mut errors =
        ["without", "with"].map(|which| Errors::of(format!("chains {which} ball friction")));
    let mut count = 0;
    for case in golden::list("chain") {
        match golden::number(&case, "N") as usize {
            1 => check::<1>(&case, &mut errors),
            3 => check::<3>(&case, &mut errors),
            4 => check::<4>(&case, &mut errors),
            5 => check::<5>(&case, &mut errors),
            6 => check::<6>(&case, &mut errors),
            8 => check::<8>(&case, &mut errors),
            other => panic!("{other} balls"),
        }
        count += 1;
    }
    assert_eq!(count, 9);
    for errors in errors {
        errors.assert_measured();
    }
}

#[test]
fn reversal_swaps_rear_and_front() {
    let (first, second) = (contacts(turned(2.0, -0.6)), contacts(turned(2.0, 0.6)));
    let forward = row(&[first, second], 1.0, 0.1, 3).forces;
    measured::assert("Table 3.5, refined force in N", forward[0] - 4.065);
    assert_eq!(row(&[first, second], -1.0, 0.1, 3).forces, [0.0, 0.0]);
    assert_eq!(row(&[second, first], 1.0, 0.1, 3).forces, [0.0, 0.0]);
    let backward = row(&[second, first], -1.0, 0.1, 3).forces;
    // The same numbers in another order: some four roundings of 2^-24 of 4 N.
    assert!((backward[0] - forward[0]).abs() < 1e-6, "{backward:?}");
    // Through standstill the force passes with the direction, and vanishes with it.
    assert_eq!(row(&[first, second], 0.0, 0.1, 3).forces, [0.0, 0.0]);
    assert_eq!(row(&[first, second], f32::NAN, 0.1, 3).forces, [0.0, 0.0]);
    let slow = row(&[first, second], 0.1, 0.1, 3).forces;
    measured::assert_at(
        "slow reversal, force in N",
        slow[0] - 0.1 * forward[0],
        format_args!("{slow:?}"),
    );
}

/// One step a tick while the side force swings: the state of the last tick is start enough.
#[test]
fn one_warm_step_a_tick_follows_a_swinging_load() {
    println!("one step a tick, side force in a sine of 100 ticks, theta 2 degrees");
    for amplitude in [0.6, 0.8, 0.85, 0.9] {
        let at = |tick: i32| {
            let phase = f64::from(tick) * std::f64::consts::TAU / 100.0;
            turned(2.0, amplitude * phase.sin())
        };
        let ball = ball();
        let mut state = ball.solve(&contacts(at(0)));
        let mut errors = Errors::of(format!("swinging load, amplitude {amplitude}"));
        for tick in 1..=100 {
            let (angles, forces) = at(tick);
            state = ball.refine(&contacts((angles, forces)), &state, 0.0, 1);
            let (motion, _) = exact(angles, forces).solve(0.0);
            errors.add(f64::from(state.speed_deviation) - (2.0 * motion[0] - 1.0));
        }
        errors.assert_measured();
    }
}

#[test]
fn losses_of_the_moving_groove_are_its_drag() {
    // sum P_i = |f_TR + f_TL| v: the force that moves the top groove does all the work.
    let map = ExactMap::new(AXIS_RATIO);
    for rho in [-0.8, -0.3, 0.0, 0.5] {
        let (angles, forces) = turned(2.0, rho);
        let contacts = contacts((angles, forces));
        let state = ball().solve(&contacts);
        let motions = ball().contact_motion(&contacts, &state.motion);
        let mut drag = 0.0;
        for (motion, force) in motions.iter().zip(forces).skip(2) {
            let semi_major = PSI * BALL_RADIUS.powf(-2.0 / 3.0) * force.cbrt();
            let spin = f64::from(motion.spin);
            let [friction, _, _] = map.at(f64::from(motion.slip) / (semi_major * spin.abs()));
            drag += FRICTION * force * friction;
        }
        // The stick treatment acts where a contact hardly spins, and there of the order (delta/w)².
        let error = f64::from(state.friction_force) / drag.abs() - 1.0;
        measured::assert_at(
            "drag of the moving groove",
            error,
            format_args!("rho {rho}: {error:e}"),
        );
    }
}

#[test]
fn any_input_gives_a_finite_ball() {
    let odd = [
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::MAX,
        -1.0,
        0.0,
        1e-30,
        0.785,
        100.0,
    ];
    let ball = ball();
    for (first, angle) in odd.into_iter().enumerate() {
        for force in odd {
            let mut angles = [0.785_f32; 4];
            let mut forces = [70.0_f32; 4];
            angles[first % 4] = angle;
            forces[(first + 1) % 4] = force;
            for all in [false, true] {
                if all {
                    (angles, forces) = ([angle; 4], [force; 4]);
                }
                let contacts = ball.contacts(&angles, &forces);
                let mut state = ball.solve(&contacts);
                for axial_force in odd {
                    state = ball.refine(&contacts, &state, axial_force.clamp(-100.0, 100.0), 3);
                    let label = format!("{angles:?} {forces:?} {axial_force}: {state:?}");
                    assert!(state.speed_deviation.is_finite(), "{label}");
                    assert!(
                        state.compliance.is_finite() && state.compliance > 0.0,
                        "{label}"
                    );
                    assert!(state.friction_force.is_finite(), "{label}");
                    assert!(state.friction_force >= 0.0, "{label}");
                    state.speed_deviation = 0.0;
                }
                let formula = analytic().speed_deviation(&angles, &forces);
                assert!(formula.speed_deviation.is_finite() && formula.compliance.is_finite());
            }
        }
    }
}

#[test]
fn two_and_three_contacts() {
    // Two contacts on one diagonal roll without slip; the one that turns with the larger moment does
    // not spin, and the ball moves with half the track speed.
    let (angles, _) = turned(0.0, 0.0);
    for forces in [[100.0, 0.0, 100.0, 0.0], [0.0, 50.0, 0.0, 50.0]] {
        let contacts = contacts((angles, forces));
        let state = ball().solve(&contacts);
        // Nothing is iterated: three roundings of 2^-24 of speeds near one.
        assert!(state.speed_deviation.abs() < 2e-7, "{state:?}");
        let motions = ball().contact_motion(&contacts, &state.motion);
        for (motion, force) in motions.iter().zip(forces) {
            assert!(force == 0.0 || motion.slip.abs() < 2e-7, "{motions:?}");
        }
    }
    // Three contacts leave no slip at all: Lin 2019, eq. (3.41) with zero offsets.
    let (angles, _) = turned(2.0, 0.0);
    let state = ball().solve(&contacts((angles, [70.0, 70.0, 0.0, 70.0])));
    let (motion, _) = exact(angles, [70.0, 70.0, 0.0, 70.0]).solve(0.0);
    // Three roundings of 2^-24 of speeds near one.
    assert!((f64::from(state.speed_deviation) - (2.0 * motion[0] - 1.0)).abs() < 2e-7);
}

#[test]
fn compliance_is_the_derivative_of_the_exact_speed() {
    let (angles, forces) = turned(1.0, 0.3);
    let exact = exact(angles, forces);
    let state = ball().refine(
        &contacts((angles, forces)),
        &ball().solve(&contacts((angles, forces))),
        0.0,
        1,
    );
    let (forward, backward) = (exact.solve(0.1).0[0], exact.solve(-0.1).0[0]);
    let slope = 2.0 * (forward - backward) / 0.2;
    measured::assert_at(
        "compliance, by differences",
        f64::from(state.compliance) / slope - 1.0,
        format_args!("{slope} {state:?}"),
    );
}

#[test]
fn balls_in_a_row_rub_faster_than_the_track_moves() {
    // Eq. (3.52): v/cos(beta_0); 1.406 v by the numerical model of the case study.
    let pair = [contacts(turned(2.0, -0.6)), contacts(turned(2.0, 0.6))];
    let chain = row(&pair, 1.0, 0.1, 3);
    let speed = ball().rubbing_speed(&chain.balls[0].motion, &chain.balls[1].motion);
    // Half a unit of its last digit.
    assert!((speed - 1.406).abs() < 5e-4, "{speed}");
    let loss = ball().ball_friction_force(&chain, 0.1);
    // Three roundings of 2^-24 of half a newton.
    assert!((loss - 0.1 * chain.forces[0] * speed).abs() < 1e-7);
}

#[test]
fn a_parameter_out_of_range_is_named() {
    let good = parameters();
    let with = |change: fn(&mut LinearBallParameters)| {
        let mut parameters = good;
        change(&mut parameters);
        let error = FourPointBall::linear(&parameters).unwrap_err();
        let analytic = AnalyticLinearBall::new(&parameters, PUBLISHED_SLOPE).unwrap_err();
        assert_eq!(error.field(), analytic.field());
        error.field()
    };
    assert_eq!(with(|p| p.ball_radius = 0.0), "ball_radius");
    assert_eq!(with(|p| p.contact_angle = f32::NAN), "contact_angle");
    assert_eq!(with(|p| p.axis_ratio = 2.0), "axis_ratio");
    assert_eq!(
        with(|p| p.semi_major_coefficient = -1.0),
        "semi_major_coefficient"
    );
    assert_eq!(with(|p| p.friction = f32::INFINITY), "friction");
    assert_eq!(
        AnalyticLinearBall::new(&good, 0.0).unwrap_err().field(),
        "slope"
    );
}
