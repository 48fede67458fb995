//! Rows with play, whose balls touch in two contacts, against exact balls.

use epas_testkit::designs::{SCREW_TRACK as TRACK, screw};
use epas_testkit::given;
use epas_testkit::measured;
use std::f64::consts::FRAC_PI_4;

use epas_friction::ball::{GrooveFit, ScrewRow};
use epas_friction::{BallScrew, BallScrewParameters, GrooveSize, LoadShare};
use epas_reference::friction::ball_screw_ball::{
    Groove as Flank, ScrewContact, motion_with_contacts,
};

const FRICTION: f64 = 0.1;

fn orbital_speed(design: &BallScrew, angles: &[f32; 4], forces: &[f32; 4]) -> f64 {
    let numbers = given::ball_screw(design.parameters());
    let contacts: Vec<_> = Flank::ALL
        .into_iter()
        .zip(angles.iter().zip(forces))
        .filter(|(_, (_, force))| **force > 0.0)
        .map(|(flank, (angle, force))| ScrewContact {
            groove: flank,
            load: f64::from(*force),
            contact_angle: f64::from(*angle),
            ellipse: numbers
                .contact_at(flank.part(), f64::from(*angle))
                .unwrap()
                .into(),
        })
        .collect();
    motion_with_contacts(&TRACK, &contacts, FRICTION, 1.0)
        .unwrap()
        .orbital_speed
}

#[test]
fn a_row_with_play_has_the_mean_speed_of_two_contacts() {
    // Its speed is that between a ball that sticks to the screw and one that sticks to the nut: what
    // `ScrewRow` documents for deviations of up to 3 degrees in both grooves.
    const DOCUMENTED: f64 = 4.6e-3;
    let design = screw();
    let row = ScrewRow::new(&design, FRICTION as f32, GrooveFit::Play).unwrap();
    let path = design.pitch_radius() / design.cos_lead_angle();
    let mut worst = 0.0_f64;
    for (screw, nut, load) in [
        (0.0, 0.0, -50.0_f32),
        (3.0, -3.0, -50.0),
        (-3.0, -3.0, -50.0),
        (3.0, 3.0, -50.0),
        (-3.0, -3.0, 50.0),
        (3.0, 3.0, 50.0),
    ] {
        let [turn_screw, turn_nut] = [screw, nut].map(|degrees: f32| degrees.to_radians());
        let tick = row.at(1.0, load);
        let ball = tick.ball(turn_screw, turn_nut, &LoadShare::MEAN);
        let speed = f64::from((tick.nominal_speed() + ball.speed_deviation) / path);
        // Two contacts of N = F / (sin(beta) cos(alpha)), each at the angle of its own flank.
        let normal = (f64::from(load).abs() / (FRAC_PI_4.sin() * TRACK.lead_angle().1)) as f32;
        let nominal = FRAC_PI_4 as f32;
        let angles = [
            nominal - turn_screw,
            nominal + turn_screw,
            nominal - turn_nut,
            nominal + turn_nut,
        ];
        let forces = if load < 0.0 {
            [0.0, normal, normal, 0.0]
        } else {
            [normal, 0.0, 0.0, normal]
        };
        let error = speed - orbital_speed(&design, &angles, &forces);
        worst = worst.max(error.abs());
        // Equal angles on screw and nut: both races give the same speed.
        if angles[1] == angles[2] && load < 0.0 || angles[0] == angles[3] && load > 0.0 {
            measured::assert_at(
                "row with play, equal angles",
                error,
                format_args!("{error}"),
            );
        }
    }
    assert!((0.9 * DOCUMENTED..DOCUMENTED).contains(&worst), "{worst}");
}

/// Balls alike that stick to the groove with the longer ellipse rub with the speed of their surface that the exact ball has.
#[test]
fn balls_in_two_contacts_rub_as_they_turn() {
    for [on_screw, in_nut] in [[3.0e-3, 3.4e-3], [3.4e-3, 3.0e-3]] {
        let design = BallScrew::new(BallScrewParameters {
            screw_groove: GrooveSize::Radius(on_screw),
            nut_groove: GrooveSize::Radius(in_nut),
            ..*screw().parameters()
        })
        .unwrap();
        let row = ScrewRow::new(&design, FRICTION as f32, GrooveFit::Play).unwrap();
        for load in [-50.0_f32, 50.0] {
            let normal = 50.0 / (FRAC_PI_4.sin() * TRACK.lead_angle().1);
            let flanks = if load < 0.0 {
                [Flank::ScrewRight, Flank::NutLeft]
            } else {
                [Flank::ScrewLeft, Flank::NutRight]
            };
            let numbers = given::ball_screw(design.parameters());
            let contacts = flanks.map(|flank| ScrewContact {
                groove: flank,
                load: normal,
                contact_angle: FRAC_PI_4,
                ellipse: numbers.contact_at(flank.part(), FRAC_PI_4).unwrap().into(),
            });
            let exact = motion_with_contacts(&TRACK, &contacts, FRICTION, 1.0).unwrap();
            // Neighbours touch along the track, y: their surfaces turn across it, and the orbit turns with the balls.
            let (_, cos) = TRACK.lead_angle();
            let [x, _, z] = exact.spin;
            let turn = x.hypot(z - exact.orbital_speed * cos);
            let found = f64::from(row.at(1.0, load).rubbing()) / TRACK.ball_radius;
            measured::assert_at("row with play, rubbing", found / turn - 1.0, load);
        }
    }
}
