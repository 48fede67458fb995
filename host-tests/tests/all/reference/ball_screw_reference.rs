//! Ball of a ball screw: stored single balls and pairs, given contacts, and the laws of the model.

use epas_reference::ReferenceError;
use epas_reference::friction::ball_screw_ball::{
    Groove, ScrewContact, ScrewMotion, ScrewTrack, motion_from, motion_with_contacts,
};
use epas_reference::friction::ball_screw_closed::{
    ContactAngles, Support, ThreePointModel, speed_ratio,
};
use epas_reference::friction::ball_screw_elastic::{
    BallSlip, ElasticBalls, ElasticMotion, ScrewSupport,
};
use epas_reference::friction::ball_screw_grooves::ElasticGrooves;
use epas_reference::friction::ball_screw_train::{ScrewTrain, solve_screw_train};
use epas_reference::friction::contact_law::HertzLaw;
use epas_reference::friction::linear_ball::EllipseLaw;
use epas_testkit::designs::SCREW_TRACK as TRACK;
use epas_testkit::golden::file as golden;
use epas_testkit::measured;
use nalgebra::Vector3;
use serde_json::Value;
use std::f64::consts::{FRAC_PI_4, TAU};

pub(super) fn law(side: &str, groove_radius: &str) -> HertzLaw {
    let all = golden("ballscrew");
    let stored = &all["hertz"][format!("{side}_rG{groove_radius}")]["correct"];
    let value = |key: &str| stored[key].as_f64().unwrap() * 1e-3;
    HertzLaw {
        ellipse: EllipseLaw {
            semi_major_constant: value("Ca"),
            axis_ratio: value("Cb") / value("Ca"),
        },
        compliance: value("C"),
    }
}

fn grooves(groove_radius: &str, theta_degrees: f64, oversize: f64) -> ElasticGrooves {
    let theta = theta_degrees.to_radians();
    ElasticGrooves {
        track: TRACK,
        screw_groove_radius: groove_radius.parse::<f64>().unwrap() * 1e-3,
        nut_groove_radius: groove_radius.parse::<f64>().unwrap() * 1e-3,
        arc_angles: [FRAC_PI_4 - theta, FRAC_PI_4 + theta, FRAC_PI_4, FRAC_PI_4],
        screw: law("S", groove_radius),
        nut: law("N", groove_radius),
        oversize,
    }
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn groove_named(name: &str) -> Groove {
    match name {
        "SL" => Groove::ScrewLeft,
        "SR" => Groove::ScrewRight,
        "NL" => Groove::NutLeft,
        "NR" => Groove::NutRight,
        other => panic!("{other}"),
    }
}

fn single(groove_radius: &str, friction: f64, nut_speed: f64) -> ElasticBalls {
    ElasticBalls {
        grooves: vec![grooves(groove_radius, 0.0, 0.0)],
        friction,
        ball_friction: 0.0,
        nut_speed,
        ball_slip: BallSlip::Orbiting,
    }
}

fn pair(
    groove_radius: &str,
    theta_degrees: f64,
    oversize: f64,
    ball_slip: BallSlip,
) -> ElasticBalls {
    ElasticBalls {
        grooves: vec![
            grooves(groove_radius, 0.0, oversize),
            grooves(groove_radius, theta_degrees, oversize),
        ],
        friction: 0.1,
        ball_friction: 0.1,
        nut_speed: TAU,
        ball_slip,
    }
}

fn stored_contacts(value: &Value) -> Vec<ScrewContact> {
    let contacts = value.as_object().unwrap();
    contacts
        .iter()
        .map(|(name, c)| {
            let groove = groove_named(name);
            let side = if groove.on_nut() { "N" } else { "S" };
            ScrewContact {
                groove,
                load: number(&c[0]),
                contact_angle: number(&c[1]),
                ellipse: law(side, "3.254").ellipse,
            }
        })
        .collect()
}
/// Directions of a contact in CS3: normal from the ball into the groove, and the tangent across the track.
fn directions(contact: &ScrewContact) -> [Vector3<f64>; 2] {
    let (sx, sz) = match contact.groove {
        Groove::ScrewLeft => (-1.0, -1.0),
        Groove::ScrewRight => (-1.0, 1.0),
        Groove::NutLeft => (1.0, -1.0),
        Groove::NutRight => (1.0, 1.0),
    };
    let (sin, cos) = contact.contact_angle.sin_cos();
    let normal = Vector3::new(sx * cos, 0.0, sz * sin);
    [normal, Vector3::new(normal.z, 0.0, -normal.x)]
}

/// Force and moment of the groove friction on a ball, and the power that the nut puts in through friction.
fn friction_sums(motion: &ScrewMotion, nut_speed: f64) -> (Vector3<f64>, Vector3<f64>, f64) {
    let (sin_a, cos_a) = TRACK.lead_angle();
    let axis = Vector3::new(0.0, sin_a, cos_a);
    let (mut force, mut moment, mut input) = (Vector3::zeros(), Vector3::zeros(), 0.0);
    for c in &motion.contacts {
        let [n, across] = directions(&c.contact);
        let f = c.force[0] * across + c.force[1] * Vector3::y();
        let arm = TRACK.ball_radius * n;
        force += f;
        moment += arm.cross(&f) + c.moment * n;
        if c.contact.groove.on_nut() {
            let surface = axis.cross(&arm);
            input +=
                nut_speed * (f.y * TRACK.path_radius() + f.dot(&surface) + c.moment * n.dot(&axis));
        }
    }
    (force, moment, input)
}

#[test]
fn stored_single_balls() {
    for case in golden("ballscrew")["single_ball"].as_array().unwrap() {
        let radius = number(&case["rG"]).to_string();
        let mu = number(&case["mu"]);
        let load = number(&case["Fax"]) * if case["pair"] == "SRNL" { -1.0 } else { 1.0 };
        let name = format!("{} r_G {radius} mm, {load} N, friction {mu}", case["pair"]);
        let solved = single(&radius, mu, TAU)
            .solve(ScrewSupport::Load(load))
            .unwrap();
        let motion = &solved.balls[0];
        let near = measured::of_case("single balls of a screw", &name);
        // The stored values come from a 48-point rule, which is off by up to 2e-7 of the forces.
        near(
            "speed ratio",
            motion.orbital_speed / TAU - number(&case["wB_over_wN"]),
        );
        for i in 0..2 {
            near(
                "positions in um",
                solved.positions[0][i] * 1e6 - number(&case["p_um"][i]),
            );
        }
        near(
            "positions in um",
            solved.screw_displacement * 1e6 - number(&case["uz_um"]),
        );
        for i in 0..3 {
            near("spin in rad/s", motion.spin[i] - number(&case["Om"][i]));
        }
        near(
            "loss",
            motion.power_loss * 1e3 / number(&case["P_mW"]) - 1.0,
        );
        assert_eq!(motion.contacts.len(), 3, "{name}: a third contact closes");
        for (flank, stored) in case["contacts"].as_object().unwrap() {
            let c = motion
                .contacts
                .iter()
                .find(|c| c.contact.groove == groove_named(flank))
                .unwrap();
            for (value, key) in [
                (c.contact.load, "N"),
                (c.contact.contact_angle.to_degrees(), "angle"),
                (c.velocity.spin, "w"),
                (c.velocity.slip_major * 1e3, "V1"),
                (c.velocity.slip_minor * 1e3, "V2"),
                (c.force[0], "f1"),
                (c.force[1], "f2"),
                (c.moment * 1e3, "M"),
                (c.power * 1e3, "P"),
            ] {
                near("contacts", value - number(&stored[key]));
            }
        }
        // Balance in six directions and of power, from the contact forces themselves.
        let (mut force, moment, input) = friction_sums(motion, TAU);
        for c in &motion.contacts {
            force -= c.contact.load * directions(&c.contact)[0];
        }
        for (force, moment) in force.iter().zip(&moment) {
            near("balance over the load", force / load);
            near("balance over the load", moment / (load * TRACK.ball_radius));
        }
        near("power balance", input / motion.power_loss - 1.0);
    }
}

fn pair_input(motion: &ElasticMotion) -> f64 {
    motion
        .balls
        .iter()
        .map(|ball| friction_sums(ball, TAU).2)
        .sum()
}

#[test]
fn stored_pairs() {
    for (key, case) in golden("ballscrew")["b2b"].as_object().unwrap() {
        if key.starts_with("closed") {
            continue;
        }
        let radius = if key.starts_with("conf") {
            "3.11136"
        } else {
            "3.254"
        };
        let load = if key.contains("25N") { -50.0 } else { -100.0 };
        // The stored pairs take the slip between balls with the total spin.
        let balls = pair(radius, 2.0, 0.0, BallSlip::Total);
        let support = if key.contains("uzfixed") {
            ScrewSupport::Displacement(number(&case["y0"][12]) * 1e-6)
        } else {
            ScrewSupport::Load(load)
        };
        let apart = balls.solve_apart(support).unwrap();
        let solved = balls.solve(support).unwrap();
        let near = measured::of_case("pairs of a screw", key);
        near(
            "contact force in N",
            solved.contact_force - number(&case["F"]),
        );
        for (value, stored) in [
            (apart.groove_loss(), number(&case["P0"])),
            (solved.groove_loss(), number(&case["P1"])),
            (solved.ball_loss, number(&case["Pb"])),
        ] {
            near("losses", value * 1e3 / stored - 1.0);
        }
        for (state, stored) in [(&apart, &case["y0"]), (&solved, &case["y1"])] {
            for (ball, motion) in state.balls.iter().enumerate() {
                let stored = |index: usize| number(&stored[6 * ball + index]);
                for i in 0..2 {
                    near(
                        "positions in um",
                        state.positions[ball][i] * 1e6 - stored(i),
                    );
                }
                near("orbital speed in rad/s", motion.orbital_speed - stored(2));
                for i in 0..3 {
                    near("spin in rad/s", motion.spin[i] - stored(3 + i));
                }
            }
            near(
                "positions in um",
                state.screw_displacement * 1e6 - number(&stored[12]),
            );
        }
        // Power: the balance holds with the relative slip, up to cos a against one in the friction along the track (0.3 per
        // cent of the ball-to-ball loss); the total spin overstates the loss. Measured: by 11.87 to 12.01 per cent.
        let relative = pair(radius, 2.0, 0.0, BallSlip::Orbiting)
            .solve(support)
            .unwrap();
        let missing =
            |m: &ElasticMotion| (m.groove_loss() + m.ball_loss - pair_input(m)) / m.ball_loss;
        near("missing power", missing(&relative));
        let overstated = missing(&solved);
        assert!(
            overstated > 0.117 && overstated < 0.122,
            "{key}: {overstated}"
        );
        let ratio = relative.contact_force / solved.contact_force;
        near("contact force by the other slip", ratio - 1.0);
    }
}

#[test]
fn given_contacts_decide_the_orbital_speed() {
    for case in golden("ballscrew")["impedance"].as_array().unwrap() {
        let contacts = [
            stored_contacts(&case["contacts1"]),
            stored_contacts(&case["contacts2"]),
        ];
        let train = solve_screw_train(&TRACK, &contacts, 0.1, 0.1, 1.0).unwrap();
        let near = measured::of_case("given contacts", &case["F"]);
        for (ball, key) in [(0, "wB1"), (1, "wB2")] {
            let speed = train.free_speeds[ball];
            near("orbital speed", speed - number(&case[key]));
            let iterated = number(&case[format!("{key}_imp")]);
            near("orbital speed by impedances", speed - iterated);
        }
        let theta = number(&case["theta"]);
        let oversize = number(&case["over_mm"]) * 1e-3;
        let full = pair("3.254", theta, oversize, BallSlip::Total)
            .solve(ScrewSupport::Load(-2.0 * number(&case["Fax"])))
            .unwrap();
        let force = number(&case["F"]);
        measured::assert(
            "elastic pair, contact force in N",
            full.contact_force - force,
        );
        near("contact force", train.contact_forces[0] / force - 1.0);
        check_train(&train, 1.0);
    }
}

/// Along the track and in rotation every ball is balanced by the forces of its neighbours; power in = power lost.
fn check_train(train: &ScrewTrain, nut_speed: f64) {
    let (sin_b, cos_b) = TRACK.ball_contact_angle();
    let mut input = 0.0;
    for (j, motion) in train.balls.iter().enumerate() {
        let (force, _, power) = friction_sums(motion, nut_speed);
        input += power;
        let behind = if j > 0 {
            train.contact_forces[j - 1]
        } else {
            0.0
        };
        let ahead = train.contact_forces.get(j).copied().unwrap_or(0.0);
        let net = force[1] * nut_speed.signum() + cos_b * (behind - ahead);
        // Derived: what is left is the friction between balls along the track, at most 0.1 F sin b of each contact.
        assert!(
            net.abs() <= 0.1 * sin_b * (behind + ahead),
            "ball {j}: {net}"
        );
    }
    let balance = input / train.power_loss() - 1.0;
    measured::assert("train of a screw, power balance", balance);
    for (j, force) in train.contact_forces.iter().enumerate() {
        let parting =
            (train.balls[j + 1].orbital_speed - train.balls[j].orbital_speed) * nut_speed.signum();
        assert!(parting > -1e-12 * nut_speed.abs() && *force >= 0.0);
        assert!((parting * force).abs() < 1e-15 * nut_speed.abs());
    }
}

#[test]
fn longer_trains_balance_and_reverse() {
    let case = &golden("ballscrew")["impedance"][4];
    let (one, two) = (
        stored_contacts(&case["contacts1"]),
        stored_contacts(&case["contacts2"]),
    );
    let train: Vec<_> = [&one, &two, &one, &one, &two, &two, &one, &two]
        .iter()
        .map(|c| (*c).clone())
        .collect();
    let forward = solve_screw_train(&TRACK, &train, 0.1, 0.1, TAU).unwrap();
    check_train(&forward, TAU);
    let backward = solve_screw_train(&TRACK, &train, 0.1, 0.1, -TAU).unwrap();
    check_train(&backward, -TAU);
    // Given contacts do not know the direction, but for the term with the sine of the ball-to-ball angle.
    for (f, b) in forward.contact_forces.iter().zip(&backward.contact_forces) {
        measured::assert("reversed train of a screw", (f - b) / f.max(0.1));
    }
    let pair = [two, one];
    assert_eq!(
        solve_screw_train(&TRACK, &pair, 0.1, 0.1, TAU)
            .unwrap()
            .contact_forces,
        vec![0.0]
    );
}

#[test]
fn any_start_gives_the_same_motion() {
    let contacts = stored_contacts(&golden("ballscrew")["impedance"][3]["contacts1"]);
    let first = motion_with_contacts(&TRACK, &contacts, 0.1, TAU).unwrap();
    for start in [
        [0.0; 4],
        [1.0, 0.0, 0.0, 0.0],
        [-5.0, 30.0, -20.0, 10.0],
        [0.5, 1e4, 0.0, -1e4],
        [0.55, 0.0, 0.19, 0.0],
    ] {
        let other = motion_from(&TRACK, &contacts, 0.1, TAU, start).unwrap();
        assert!(
            (first.orbital_speed - other.orbital_speed).abs() < 1e-14,
            "{start:?}: {}",
            other.orbital_speed
        );
        assert!(
            (first.power_loss / other.power_loss - 1.0).abs() < 1e-14,
            "{start:?}"
        );
    }
    let (force, moment, input) = friction_sums(&first, TAU);
    measured::assert("given contacts, balance in N", force[1]);
    for moment in moment.iter() {
        measured::assert("given contacts, moment in N m", *moment);
    }
    let balance = input / first.power_loss - 1.0;
    measured::assert("given contacts, power balance", balance);
}

/// Two-point contact: one race sticks and the other slides across the track at `R_B w_N sin a` = 3.306 mm/s; the orbital speed is
/// that of rolling.
#[test]
fn two_point_contact_sticks_on_one_race() {
    let contacts: Vec<_> = [(Groove::ScrewRight, "S"), (Groove::NutLeft, "N")]
        .map(|(groove, side)| ScrewContact {
            groove,
            load: 75.0,
            contact_angle: FRAC_PI_4,
            ellipse: law(side, "3.254").ellipse,
        })
        .to_vec();
    let motion = motion_with_contacts(&TRACK, &contacts, 0.1, TAU).unwrap();
    let across: Vec<_> = motion
        .contacts
        .iter()
        .map(|c| c.velocity.slip_major.abs() * 1e3)
        .collect();
    assert!(
        (across[0] - across[1]).abs() > 3.3055 && across.iter().sum::<f64>() < 3.3065,
        "{across:?}"
    );
    let rolling = speed_ratio(&TRACK, Support::TwoPoint, angles(0.0));
    // Rolling is exact but for the smoothing of friction. Measured: 0.0.
    assert!(
        (motion.orbital_speed / TAU - rolling).abs() < 4e-16,
        "{} {rolling}",
        motion.orbital_speed / TAU
    );
    let gap = motion.gap / motion.power_loss;
    measured::assert("two contacts of a screw, gap over loss", gap);
}

#[test]
fn stored_closed_forms() {
    for (key, case) in golden("ballscrew")["b2b"]
        .as_object()
        .unwrap()
        .iter()
        .filter(|(key, _)| key.starts_with("closed"))
    {
        let radius = if key.contains("conf") {
            "3.11136"
        } else {
            "3.254"
        };
        let load = if key.contains("25N") { -25.0 } else { -50.0 };
        let model = ThreePointModel {
            track: TRACK,
            screw: law("S", radius),
            nut: law("N", radius),
            friction: 0.1,
            contact_angle: FRAC_PI_4,
        };
        assert_eq!(Support::of(load, TAU), Support::ThirdOnScrew);
        let [one, two] = [0.0, 2.0].map(|degrees| {
            model
                .ball(Support::ThirdOnScrew, angles(degrees), load, TAU)
                .unwrap()
        });
        let value = |name: &str| number(&case[name]);
        for (one, stored, bound) in [
            (one.orbital_speed / TAU, value("w1"), 1e-12),
            (two.orbital_speed / TAU, value("w2"), 1e-12),
            // Orbital speeds are closed forms here and there: 1e-15 and the digits stored. Loads are stored with fewer.
            // mm/(s N); the stored slopes are finite differences of a 48-point rule.
            (one.compliance * 1e3, value("Y1"), 3e-6),
            (two.compliance * 1e3, value("Y2"), 3e-6),
            (one.main_load, value("N"), 1e-6),
            (one.third_load, value("N3"), 1e-6),
            (model.contact_force(&one, &two), value("F"), 3e-6),
        ] {
            assert!(
                (one / stored - 1.0).abs() < bound,
                "{key}: {one} stored {stored}"
            );
        }
        assert_eq!(model.contact_force(&two, &one), 0.0);
        let numerical = pair(radius, 2.0, 0.0, BallSlip::Orbiting)
            .solve(ScrewSupport::Load(2.0 * load))
            .unwrap();
        let off = model.contact_force(&one, &two) / numerical.contact_force - 1.0;
        let loss = one.groove_loss() / numerical_single(radius, load) - 1.0;
        let near = measured::of_case("closed forms of a screw", key);
        near("contact force", off);
        near("groove loss", loss);
    }
}

/// Contact angles with the arc centres of the screw deviating by an angle.
fn angles(degrees: f64) -> ContactAngles {
    let theta = degrees.to_radians();
    ContactAngles {
        screw: FRAC_PI_4 + theta,
        nut: FRAC_PI_4,
        third: FRAC_PI_4 - theta,
    }
}

fn numerical_single(radius: &str, load: f64) -> f64 {
    single(radius, 0.1, TAU)
        .solve(ScrewSupport::Load(load))
        .unwrap()
        .groove_loss()
}

/// Closed-form orbital speeds against the numerical model: 0.2 to 0.8 % off, and the rule which contact closes third.
#[test]
fn closed_speed_and_third_contact_against_the_numerical_model() {
    for (load, speed) in [(-25.0, TAU), (25.0, TAU), (-25.0, -TAU), (25.0, -TAU)] {
        let solved = single("3.254", 0.1, speed)
            .solve(ScrewSupport::Load(load))
            .unwrap();
        let contacts = &solved.balls[0].contacts;
        assert_eq!(contacts.len(), 3);
        let third = contacts
            .iter()
            .min_by(|a, b| a.contact.load.total_cmp(&b.contact.load))
            .unwrap()
            .contact
            .groove;
        let support = Support::of(load, speed);
        assert_eq!(third.on_nut(), support == Support::ThirdOnNut);
        let ratio = solved.balls[0].orbital_speed / speed;
        let off = ratio / speed_ratio(&TRACK, support, angles(0.0)) - 1.0;
        measured::assert("closed forms of a screw, orbital speed", off);
        assert!(solved.balls[0].power_loss > 0.0);
    }
}

#[test]
fn extreme_input_converges_or_is_named() {
    let contacts = stored_contacts(&golden("ballscrew")["impedance"][3]["contacts1"]);
    assert_eq!(
        motion_with_contacts(&TRACK, &contacts, 0.1, 0.0),
        Err(ReferenceError::Standstill)
    );
    assert_eq!(
        motion_with_contacts(&TRACK, &[], 0.1, 1.0),
        Err(ReferenceError::Undriven)
    );
    let lost: Vec<_> = contacts
        .iter()
        .map(|c| ScrewContact { load: 0.0, ..*c })
        .collect();
    assert_eq!(
        motion_with_contacts(&TRACK, &lost, 0.1, 1.0),
        Err(ReferenceError::Undriven)
    );
    let large = ScrewTrack {
        ball_radius: 0.1,
        ..TRACK
    };
    assert!(motion_with_contacts(&TRACK, &contacts, f64::NAN, 1.0).is_err());
    assert!(motion_with_contacts(&large, &contacts, 0.1, 1.0).is_err());
    let smooth = motion_with_contacts(&TRACK, &contacts, 0.0, 1.0).unwrap();
    assert_eq!(smooth.power_loss, 0.0);
    let rough = motion_with_contacts(&TRACK, &contacts, 0.3, 1.0).unwrap();
    assert!((smooth.orbital_speed - rough.orbital_speed).abs() < 4e-16);
    assert!(solve_screw_train(&TRACK, &[], 0.1, 0.1, 1.0).is_err());

    // A millinewton with 30 micrometres of play: solved to the solver's 1e-6 of the load, or refused with the force left over,
    // which is no more than the load. Measured: refused, with 1.2e-4 N.
    let loose = ElasticBalls {
        grooves: vec![grooves("3.254", 0.0, -30e-6)],
        ..single("3.254", 0.1, 1.0)
    };
    match loose.solve(ScrewSupport::Load(-1e-3)) {
        Ok(motion) => assert!(motion.residual < 1e-9),
        Err(ReferenceError::NotConverged { residual, .. }) => {
            assert!(residual.is_finite() && residual < 1e-3);
        }
        Err(other) => panic!("{other}"),
    }
    let solve = |friction, speed, load| {
        let balls = single("3.254", friction, speed);
        balls.solve(ScrewSupport::Load(load))
    };
    assert_eq!(solve(0.1, 0.0, 1.0), Err(ReferenceError::Standstill));
    for (friction, load) in [(0.0, 1.0), (0.1, 0.0), (0.1, f64::NAN)] {
        assert!(solve(friction, 1.0, load).is_err(), "{friction}, {load}");
    }
}

#[test]
fn extreme_loads_are_solved() {
    solve_extreme_loads(&[-1e-2, -1000.0, 1e4], &[0.01, 0.3]);
}

#[test]
#[ignore = "ninety balls"]
fn extreme_loads_are_solved_whole() {
    solve_extreme_loads(
        &[-1e-2, -1.0, -100.0, -1000.0, 30.0, 1e4],
        &[0.01, 0.05, 0.1, 0.2, 0.3],
    );
}

fn solve_extreme_loads(loads: &[f64], frictions: &[f64]) {
    let mut solved = 0;
    let mut refused = Vec::new();
    for &load in loads {
        for &friction in frictions {
            for oversize in [-30e-6, 0.0, 5e-6] {
                let balls = ElasticBalls {
                    grooves: vec![grooves("3.254", 0.0, oversize)],
                    ..single("3.254", friction, 1.0)
                };
                match balls.solve(ScrewSupport::Load(load)) {
                    Ok(motion) => {
                        solved += 1;
                        let ball = &motion.balls[0];
                        let (_, _, input) = friction_sums(ball, 1.0);
                        assert!(ball.power_loss > 0.0);
                        let balance = input / ball.power_loss - 1.0;
                        measured::assert("balls under extreme loads, power balance", balance);
                    }
                    Err(error) => refused.push(format!(
                        "{load} N, friction {friction}, oversize {oversize}: {error}"
                    )),
                }
            }
        }
    }
    assert!(
        refused.is_empty() && solved == 3 * loads.len() * frictions.len(),
        "{solved} solved, refused: {refused:#?}"
    );
}
