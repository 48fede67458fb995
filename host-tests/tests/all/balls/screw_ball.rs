//! The ball of a ball screw: closed form against the exact models.

use epas_friction::ball::{GrooveFit, RowContacts, ScrewRow};
use epas_friction::{BallScrew, BallScrewParameters, LoadShare};
use epas_reference::curvature;
use epas_reference::friction::ball_screw_ball::Groove as Flank;
use epas_reference::friction::ball_screw_closed::{ContactAngles, Support, ThreePointModel};
use epas_reference::friction::ball_screw_elastic::{BallSlip, ElasticBalls, ScrewSupport};
use epas_reference::friction::ball_screw_grooves::ElasticGrooves;
use epas_reference::friction::contact_law::HertzLaw;
use epas_reference::promises;
use epas_testkit::designs::{SCREW_GROOVE_RADIUS, SCREW_TRACK as TRACK, screw as design};
use epas_testkit::errors::Errors;
use epas_testkit::given;
use epas_testkit::measured;
use epas_testkit::random::Random;
use std::f64::consts::FRAC_PI_4;

fn law(design: &BallScrew, groove: curvature::Groove) -> HertzLaw {
    let given = given::ball_screw(design.parameters());
    given.contact(groove).unwrap().into()
}

#[test]
fn row_is_the_closed_form_with_a_third_contact() {
    let mut speeds = Errors::of("row, orbital speed");
    let of = |quantity: &str| {
        ["mean load", "shares 0.1 to 3"]
            .map(|shares| Errors::of(format!("row, {quantity}, {shares}")))
    };
    let mut compliances = of("compliance");
    let mut torques = of("groove torque");
    let mut mains = Errors::of("row, main load");
    let mut thirds = Errors::of("row, third load");
    let mut rubbings = Errors::of("row, rubbing");
    let (mut row_errors, mut ball_errors) = (Errors::default(), Errors::default());
    for (nominal, friction) in [
        (FRAC_PI_4, 0.05),
        (FRAC_PI_4, 0.12),
        (f64::to_radians(38.0), 0.08),
        (f64::to_radians(52.0), 0.08),
    ] {
        let design = BallScrew::new(BallScrewParameters {
            contact_angle: nominal as f32,
            ..*design().parameters()
        })
        .unwrap();
        let row = ScrewRow::new(&design, friction as f32, GrooveFit::Zero).unwrap();
        let model = ThreePointModel {
            track: TRACK,
            screw: law(&design, curvature::Groove::Screw),
            nut: law(&design, curvature::Groove::Nut),
            friction,
            contact_angle: nominal,
        };
        for load in [
            -1000.0, -100.0, -50.0, -10.0, -1.0, -0.1, 0.1, 1.0, 10.0, 50.0, 100.0, 1000.0_f64,
        ] {
            for speed in [1.0, -1.0] {
                let tick = row.at(speed as f32, load as f32);
                for share in [0.1, 0.5, 1.0, 1.5, 3.0] {
                    for theta in [-3.0f64, -1.0, 0.0, 2.0, 3.0] {
                        for eta in [-3.0f64, 0.0, 1.0, 3.0] {
                            // Loads of both signs alike, so that the means are those of the documented sweep.
                            let documented =
                                share == 1.0 && nominal == FRAC_PI_4 && load.abs() != 50.0;
                            let bounded = ![0.1, 10.0, 100.0, 1000.0].contains(&load)
                                && theta % 3.0 == 0.0
                                && eta % 3.0 == 0.0;
                            if !documented && !bounded {
                                continue;
                            }
                            let (t, e) = (theta.to_radians(), eta.to_radians());
                            let support = Support::of(load, speed);
                            let side = if load < 0.0 { 1.0 } else { -1.0 };
                            let angles = ContactAngles {
                                screw: nominal + side * t,
                                nut: nominal - side * e,
                                third: if support == Support::ThirdOnScrew {
                                    nominal - side * t
                                } else {
                                    nominal + side * e
                                },
                            };
                            let exact = model.ball(support, angles, load * share, speed).unwrap();
                            let ball = tick.ball(
                                t as f32,
                                e as f32,
                                &LoadShare::new(share as f32).unwrap(),
                            );
                            let path = TRACK.path_radius();
                            let dev = f64::from(ball.speed_deviation + tick.nominal_speed()) / path
                                - exact.orbital_speed / speed;
                            let y = f64::from(ball.compliance) / exact.compliance - 1.0;
                            let p = f64::from(ball.groove_torque) / exact.groove_loss() - 1.0;
                            let n = f64::from(tick.main_load()) * share / exact.main_load - 1.0;
                            let n3 = f64::from(tick.third_load()) * share / exact.third_load - 1.0;
                            let rub = f64::from(ball.rubbing)
                                / (TRACK.ball_radius
                                    * (exact.spin.abs()
                                        - exact.orbital_speed.abs() * TRACK.lead_angle().1))
                                - 1.0;
                            let case = format!(
                                "{nominal} rad, friction {friction}, {load} N, nut speed {speed}, share {share}, {theta}, {eta} degrees"
                            );
                            if documented {
                                row_errors.add_at(p, &case);
                                ball_errors.add_at(dev, &case);
                            }
                            if !bounded {
                                continue;
                            }
                            speeds.add_at(dev, &case);
                            compliances[usize::from(share != 1.0)].add_at(y, &case);
                            torques[usize::from(share != 1.0)].add_at(p, &case);
                            if share == 1.0 {
                                mains.add_at(n, &case);
                                thirds.add_at(n3, &case);
                            }
                            rubbings.add_at(rub, &case);
                        }
                    }
                }
            }
        }
    }
    for errors in [speeds, mains, thirds, rubbings]
        .iter()
        .chain(&compliances)
        .chain(&torques)
    {
        errors.assert_measured();
    }
    row_errors.assert_promised(promises::of("screw_row"));
    ball_errors.assert_promised(promises::of("screw_ball"));
}

/// Balls in grooves without play that give way, the second one in a screw groove that deviates by `theta`.
fn elastic(deviations: &[f64], nut_speed: f64) -> ElasticBalls {
    let [screw, nut] =
        [curvature::Groove::Screw, curvature::Groove::Nut].map(|groove| law(&design(), groove));
    let grooves = deviations
        .iter()
        .map(|theta| ElasticGrooves {
            track: TRACK,
            screw_groove_radius: SCREW_GROOVE_RADIUS,
            nut_groove_radius: SCREW_GROOVE_RADIUS,
            arc_angles: [FRAC_PI_4 - theta, FRAC_PI_4 + theta, FRAC_PI_4, FRAC_PI_4],
            screw,
            nut,
            oversize: 0.0,
        })
        .collect();
    ElasticBalls {
        grooves,
        friction: 0.1,
        ball_friction: 0.1,
        nut_speed,
        ball_slip: BallSlip::Orbiting,
    }
}

#[test]
fn the_third_contact_follows_load_and_direction() {
    let row = ScrewRow::new(&design(), 0.1, GrooveFit::Zero).unwrap();
    let mut main = Errors::of("load of the main contacts");
    let mut third = Errors::of("load of the third contact");
    for load in [-100.0_f64, -50.0, -10.0, 10.0, 50.0, 100.0] {
        for speed in [1.0_f64, -1.0] {
            let case = format!("{load} N, {speed} rad/s");
            let solved = elastic(&[0.0], speed)
                .solve(ScrewSupport::Load(load))
                .unwrap();
            let forces = row.contacts(speed as f32, load as f32, 0.0, 0.0).forces;
            let contacts = &solved.balls[0].contacts;
            assert_eq!(contacts.len(), 3, "{case}");
            let least = contacts
                .iter()
                .map(|contact| contact.contact.load)
                .fold(f64::INFINITY, f64::min);
            for (flank, force) in Flank::ALL.iter().zip(forces) {
                let exact = contacts
                    .iter()
                    .find(|contact| contact.contact.groove == *flank)
                    .map(|contact| contact.contact.load);
                match exact {
                    None => assert!(force == 0.0, "{case}: {flank:?}"),
                    Some(exact) => {
                        let errors = if exact > least { &mut main } else { &mut third };
                        errors.add_at(f64::from(force) / exact - 1.0, &case);
                    }
                }
            }
        }
    }
    // The third contact takes part of its force from friction along its own track; friction also shifts all angles.
    main.assert_measured();
    third.assert_measured();
}

#[test]
fn contact_angles_deviate_with_their_groove() {
    let row = ScrewRow::new(&design(), 0.1, GrooveFit::Zero).unwrap();
    let nominal = FRAC_PI_4 as f32;
    assert_eq!(
        row.contacts(1.0, 50.0, 0.02, 0.03).angles,
        [
            nominal - 0.02,
            nominal + 0.02,
            nominal - 0.03,
            nominal + 0.03
        ]
    );
}

/// A load takes the preload off one contact after the other; none of them pulls, and the third one never carries less than a
/// millionth of the main one.
#[test]
fn contacts_of_a_preloaded_ball_only_press() {
    let preload = GrooveFit::Preload {
        contact_force: 30.0,
    };
    let row = ScrewRow::new(&design(), 0.1, preload).unwrap();
    let mut lost = 0;
    for step in 1..=400 {
        let load = 0.5 * step as f32;
        let [third, main, other_main, fourth] = row.contacts(1.0, -load, 0.0, 0.0).forces;
        assert!(
            fourth >= 0.0 && fourth < third && main > 0.0 && main == other_main,
            "{load} N"
        );
        lost += i32::from(fourth == 0.0);
    }
    // Lost from about 2 sqrt(2) times the preload's axial part on: 30 N sin(45 degrees) 2 sqrt(2) = 60 N at the most.
    assert!((280..350).contains(&lost), "{lost}");
    let slippery = ScrewRow::new(&design(), 1e-6, GrooveFit::Zero).unwrap();
    for load in [10.0, 1e3, 1e5] {
        let tick = slippery.at(1.0, load);
        let part = tick.third_load() / tick.main_load();
        assert!((0.99e-6..2e-6).contains(&part), "{load} N: {part:e}");
    }
}

/// Force between two balls, loads and all, against the exact model of balls in elastic grooves.
///
/// A deviation that loads the third contact pins it; the opposite one lets it slide, and the closed form, which
/// takes it for pinned, is too large.
#[test]
fn force_between_two_balls_in_elastic_grooves() {
    let design = design();
    let row = ScrewRow::new(&design, 0.1, GrooveFit::Zero).unwrap();
    for per_ball in [10.0_f64, 25.0, 50.0, 100.0] {
        for sign in [-1.0, 1.0] {
            for pinning in [true, false] {
                let name = format!(
                    "{per_ball} N, {}, {}",
                    if sign < 0.0 { "SR-NL" } else { "SL-NR" },
                    if pinning { "pinning" } else { "opposite" }
                );
                let mut closed = Errors::of(format!("{name}: closed form"));
                for degrees in [0.5_f64, 1.0, 2.0, 3.0] {
                    let theta = degrees.to_radians() * if pinning { 1.0 } else { -1.0 };
                    let load = sign * per_ball;
                    let tick = row.at(1.0, load as f32);
                    let states =
                        [0.0, theta].map(|theta| tick.ball(theta as f32, 0.0, &LoadShare::MEAN));
                    let difference = states[0].speed_deviation - states[1].speed_deviation;
                    let order = if difference > 0.0 {
                        [0.0, theta]
                    } else {
                        [theta, 0.0]
                    };
                    let exact = elastic(&order, 1.0)
                        .solve(ScrewSupport::Load(2.0 * load))
                        .unwrap()
                        .contact_force;
                    let force = difference.abs() / (states[0].compliance + states[1].compliance);
                    closed.add_at(f64::from(force) / exact - 1.0, &name);
                }
                closed.assert_measured();
            }
        }
    }
}

/// Lin 2019, Table 3.7, under the reading that reproduces it: 50 N on each of the two balls, three contacts, the
/// groove radius of Table 2.1 (3.254 mm), SR-NL load, SL and SR of the second ball turned by theta: 1.92 and 2.89 N.
#[test]
fn table_3_7() {
    let design = design();
    let row = ScrewRow::new(&design, 0.1, GrooveFit::Zero).unwrap();
    for (degrees, published) in [(2.0_f64, 1.92), (3.0, 2.89)] {
        let tick = row.at(1.0, -50.0);
        let states =
            [0.0, degrees.to_radians()].map(|theta| tick.ball(theta as f32, 0.0, &LoadShare::MEAN));
        let difference = states[0].speed_deviation - states[1].speed_deviation;
        let force = f64::from(difference / (states[0].compliance + states[1].compliance));
        // Speeds and compliances in closed form are a few per cent off.
        measured::assert("Table 3.7, row", force / published - 1.0);
    }
}

#[test]
fn invalid_input_gives_finite_contacts() {
    let odd = [
        0.0,
        -1.0,
        1e-38,
        1e-6,
        75.0,
        1e7,
        1e30,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
    ];
    let mut random = Random(5);
    let row = ScrewRow::new(&design(), 0.1, GrooveFit::Zero).unwrap();
    for _ in 0..3000 {
        let mut pick = || random.of(&odd);
        let RowContacts { angles, forces } = row.contacts(pick(), pick(), pick(), pick());
        assert!(angles.iter().chain(&forces).all(|x| x.is_finite()));
    }
}
