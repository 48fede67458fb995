//! The in-loop kinematics (f32) against the float64 reference.

use crate::reference::kinematics_cases::{self, random_input};
use crate::reference::kinematics_reference::turn;
use crate::refusals::assert_refused;
use epas_friction::geometry::Groove;
use epas_friction::hertz::HertzContact;
use epas_friction::kinematics::{
    ContactKinematics, ContactSlip, EllipticContact, KinematicsParameters,
};
use epas_friction::{BallScrew, CATALOGUE, Error, GrooveSize};
use epas_reference::kinematics::{self as reference, KinematicsInput, Raceway, Revised, operating};
use epas_reference::promises;
use epas_testkit::errors::Errors;
use epas_testkit::random::Random;
use std::f64::consts::TAU;

fn parameters(input: &KinematicsInput) -> KinematicsParameters {
    KinematicsParameters {
        ball_diameter: input.ball_diameter as f32,
        pitch_radius: input.pitch_radius as f32,
        lead_angle: input.lead_angle as f32,
        groove_radius_screw: input.groove_radius_screw as f32,
        groove_radius_nut: input.groove_radius_nut as f32,
        contact_angle_screw: input.contact_angle_screw as f32,
        contact_angle_nut: input.contact_angle_nut as f32,
        pitch_angle: input.pitch_angle as f32,
        yaw_angle: input.yaw_angle as f32,
        rolling_radius_screw: input.rolling_radius_screw as f32,
        rolling_radius_nut: input.rolling_radius_nut as f32,
        semi_major_screw: input.semi_major_screw as f32,
        semi_minor_screw: input.semi_minor_screw as f32,
        semi_major_nut: input.semi_major_nut as f32,
        semi_minor_nut: input.semi_minor_nut as f32,
    }
}

fn updated(given: &KinematicsParameters) -> ContactKinematics {
    let mut kinematics = ContactKinematics::new(&KinematicsParameters {
        contact_angle_screw: 0.99 * given.contact_angle_screw,
        contact_angle_nut: 0.99 * given.contact_angle_nut,
        semi_major_screw: 0.9 * given.semi_major_screw,
        semi_minor_screw: 0.9 * given.semi_minor_screw,
        semi_major_nut: 0.9 * given.semi_major_nut,
        semi_minor_nut: 0.9 * given.semi_minor_nut,
        ..*given
    })
    .unwrap();
    let screw = EllipticContact {
        contact_angle: given.contact_angle_screw,
        semi_major: given.semi_major_screw,
        semi_minor: given.semi_minor_screw,
    };
    let nut = EllipticContact {
        contact_angle: given.contact_angle_nut,
        semi_major: given.semi_major_nut,
        semi_minor: given.semi_minor_nut,
    };
    assert!(kinematics.update(screw, nut));
    kinematics
}

fn slip_of(ball: &epas_friction::kinematics::BallKinematics, raceway: Raceway) -> &ContactSlip {
    match raceway {
        Raceway::Screw => &ball.screw,
        Raceway::Nut => &ball.nut,
    }
}

/// A bias would show as a mean beside which the scatter is small. Tabulated cases share a few angles, and with
/// them the rounding of their sines and cosines, 3e-8.
fn assert_scattered(errors: &Errors, name: &str, bound: f64) {
    print!("{name}: ");
    errors.assert(bound, 0.4 * bound, 0.12 * bound);
}

#[derive(Default)]
struct Sweep {
    orbital: Errors,
    spin_speed: Errors,
    entrainment: Errors,
    rolling: Errors,
    updated: Errors,
    side: Errors,
    spin: Errors,
    point: Errors,
    slide_to_roll: Errors,
    slide_angle: Errors,
    slide_vector: Errors,
    entrainment_angle: Errors,
    spin_to_roll: Errors,
}

impl Sweep {
    /// Compares one case; the reference takes the numbers before they are rounded to f32.
    fn add(&mut self, input: &KinematicsInput, tag: &str) {
        let exact = Revised::new(input).unwrap();
        let wanted = exact.evaluate();
        let kinematics = ContactKinematics::new(&parameters(input))
            .unwrap_or_else(|error| panic!("{tag}: {error} {input:?}"));
        let ball = kinematics.tick(input.speed as f32);
        let updated = updated(&parameters(input)).tick(input.speed as f32);
        let case = || format!("{tag} {input:?}");
        if input.speed != 0.0 {
            let relative = |found: f32, wanted: f64| f64::from(found) / wanted - 1.0;
            self.orbital
                .add_case(relative(ball.orbital_speed, wanted.orbital_speed), case);
            self.spin_speed
                .add_case(relative(ball.spin_speed, wanted.spin_speed), case);
        }
        for raceway in Raceway::BOTH {
            let (found, wanted) = (slip_of(&ball, raceway), wanted.contact(raceway));
            let coefficients = match raceway {
                Raceway::Screw => kinematics.screw(),
                Raceway::Nut => kinematics.nut(),
            };
            let contact = input.contact(raceway);
            let scale = wanted.entrainment_speed;
            let radius = 0.5 * input.ball_diameter;
            if input.speed != 0.0 {
                let scaled = |found: f32, wanted: f64| (f64::from(found) - wanted) / scale;
                self.entrainment
                    .add_case(scaled(found.entrainment_speed, scale), case);
                self.rolling
                    .add_case(scaled(found.rolling_slip, wanted.rolling_slip), case);
                let updated = slip_of(&updated, raceway).rolling_slip;
                self.updated
                    .add_case(scaled(updated, wanted.rolling_slip), case);
                self.side
                    .add_case(scaled(found.side_slip, wanted.side_slip), case);
                // Spin as the speed that it makes on the ball's radius, which no ellipse reaches.
                self.spin
                    .add_case(radius * scaled(found.spin, wanted.spin), case);
                for (u, v) in [(0.5, -0.8), (-0.6, 0.7)] {
                    let (x, y) = (u * contact.semi_minor, v * contact.semi_major);
                    let slip = coefficients.slip_at(input.speed as f32, x as f32, y as f32);
                    let exact = exact.slip(raceway, x, y);
                    self.point.add_case(scaled(slip.rolling, exact[0]), case);
                    self.point.add_case(scaled(slip.side, exact[1]), case);
                }
            }
            let ratios = coefficients.ratios();
            let difference = |found: f32, wanted: f64| f64::from(found) - wanted;
            let srr = wanted.slide_to_roll;
            self.slide_to_roll
                .add_case(difference(ratios.slide_to_roll, srr), case);
            let angle = wanted
                .slide_angle
                .map_or(0.0, |wanted| turn(ratios.slide_angle.into(), wanted));
            self.slide_vector.add_case(angle * srr, case);
            if srr > 0.01 {
                self.slide_angle.add_case(angle, case);
            }
            self.entrainment_angle.add_case(
                difference(ratios.entrainment_angle, wanted.entrainment_angle),
                case,
            );
            self.spin_to_roll
                .add_case(difference(ratios.spin_to_roll, wanted.spin_to_roll), case);
        }
    }

    fn assert(&self) {
        assert_scattered(&self.orbital, "orbital speed, relative", 5e-7);
        assert_scattered(&self.spin_speed, "spin speed, relative", 5e-7);
        assert_scattered(&self.entrainment, "entrainment speed, relative", 5e-7);
        assert_scattered(&self.rolling, "rolling slip / v_e", 4e-7);
        assert_scattered(&self.side, "side slip / v_e", 2e-7);
        assert_scattered(&self.spin, "spin D/2 / v_e", 4e-7);
        assert_scattered(&self.point, "slip at a point / v_e", 4e-7);
        assert_scattered(&self.slide_to_roll, "slide-to-roll, absolute", 4e-7);
        assert_scattered(&self.slide_angle, "slide angle where SRR > 1 %, rad", 2e-5);
        assert_scattered(&self.slide_vector, "slide angle times slide-to-roll", 4e-7);
        assert_scattered(&self.entrainment_angle, "entrainment angle, rad", 1e-7);
        assert_scattered(&self.spin_to_roll, "spin-to-roll, absolute", 1e-7);
    }
}

/// Orbital and spin speed within 5e-7, slip within 4e-7 of the entrainment speed (2e-6 would do), ratios
/// likewise (5e-6 would do). Some twenty roundings of 6e-8, those of the inputs among them, add up like
/// a random walk to 3e-7; slip is formed without cancellation and is a small share of the speed.
#[test]
fn golden_cases_within_the_promise() {
    let mut sweep = Sweep::default();
    for case in kinematics_cases::cases() {
        let tag = case["tag"].as_str().unwrap().to_owned();
        let input = kinematics_cases::input_in(&case, 1e-3);
        sweep.add(&input, &tag);
        sweep.add(
            &KinematicsInput {
                lead_angle: 0.0,
                ..input
            },
            &tag,
        );
        sweep.add(
            &KinematicsInput {
                speed: 0.0,
                ..input
            },
            &tag,
        );
        for raceway in Raceway::BOTH {
            if let Ok(yaw_angle) = reference::yaw_without_side_slip(&input, raceway) {
                sweep.add(&KinematicsInput { yaw_angle, ..input }, &tag);
            }
        }
    }
    sweep.assert();
}

#[test]
fn random_geometries() {
    let mut sweep = Sweep::default();
    let mut random = Random(0x5EED_1001);
    for step in 0..200_000 {
        sweep.add(&random_input(&mut random), &format!("random {step}"));
    }
    sweep.assert();
    sweep.rolling.assert_promised(promises::of("kinematics"));
    sweep
        .updated
        .assert_promised(promises::of("kinematics_update"));
    sweep
        .slide_to_roll
        .assert_promised(promises::of("slip_ratios"));
}

#[test]
fn a_contact_may_be_a_point() {
    let given = parameters(&random_input(&mut Random(0x5EED_100A)));
    let mut kinematics = ContactKinematics::new(&given).unwrap();
    let point = |semi_major, semi_minor| EllipticContact {
        contact_angle: given.contact_angle_screw,
        semi_major,
        semi_minor,
    };
    let minor = 0.2 * given.semi_major_nut;
    let whole = point(given.semi_major_nut, minor);
    for (contact, is_taken) in [
        (point(0.0, -0.0), true),
        (point(-0.0, 0.0), true),
        (point(given.semi_major_screw, -0.0), true),
        (point(given.semi_major_screw, -1e-9), false),
        (point(-1e-9, -1e-9), false),
    ] {
        assert_eq!(kinematics.update(contact, whole), is_taken, "{contact:?}");
    }
}

type Field = fn(&mut KinematicsParameters) -> &mut f32;

const FIELDS: [(&str, Field); 15] = [
    ("ball_diameter", |p| &mut p.ball_diameter),
    ("pitch_radius", |p| &mut p.pitch_radius),
    ("lead_angle", |p| &mut p.lead_angle),
    ("groove_radius_screw", |p| &mut p.groove_radius_screw),
    ("groove_radius_nut", |p| &mut p.groove_radius_nut),
    ("contact_angle_screw", |p| &mut p.contact_angle_screw),
    ("contact_angle_nut", |p| &mut p.contact_angle_nut),
    ("pitch_angle", |p| &mut p.pitch_angle),
    ("yaw_angle", |p| &mut p.yaw_angle),
    ("rolling_radius_screw", |p| &mut p.rolling_radius_screw),
    ("rolling_radius_nut", |p| &mut p.rolling_radius_nut),
    ("semi_major_screw", |p| &mut p.semi_major_screw),
    ("semi_minor_screw", |p| &mut p.semi_minor_screw),
    ("semi_major_nut", |p| &mut p.semi_major_nut),
    ("semi_minor_nut", |p| &mut p.semi_minor_nut),
];

#[test]
fn parameters_that_are_not_finite_are_refused_by_name() {
    let good = parameters(&operating::table_two().unwrap());
    for (name, field) in FIELDS {
        for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let mut given = good;
            *field(&mut given) = value;
            let error = ContactKinematics::new(&given).unwrap_err();
            assert_eq!(error.field(), name);
            assert!(matches!(error, Error::NotFinite { .. }));
        }
    }
}

#[test]
fn what_cannot_roll_is_refused() {
    let good = parameters(&operating::table_two().unwrap());
    let refused = |given: KinematicsParameters| ContactKinematics::new(&given).unwrap_err();
    #[rustfmt::skip]
    assert_refused(
        &good,
        ContactKinematics::new,
        &[
            ("contact_angle_screw", |p, v| p.contact_angle_screw = v, &[-0.8]),
            ("contact_angle_nut", |p, v| p.contact_angle_nut = v, &[-0.8]),
            ("ball_diameter", |p, v| p.ball_diameter = v, &[2.1]),
            ("semi_major_nut", |p, v| p.semi_major_nut = v, &[1.192e-3]),
            ("semi_minor_screw", |p, v| p.semi_minor_screw = v, &[0.7e-3]),
            ("groove_radius_nut", |p, v| p.groove_radius_nut = v, &[3.9e-3]),
        ],
    );
    let is_taken = |given: KinematicsParameters| ContactKinematics::new(&given).is_ok();
    assert!(is_taken(KinematicsParameters {
        semi_major_nut: 1.19e-3,
        ..good
    }));
    let range = refused(KinematicsParameters {
        ball_diameter: 2.1,
        ..good
    })
    .allowed();
    assert_eq!((range.minimum, range.maximum), (2e-5, 2.0));
    // The grip ends where the range says, but for the last of 24 halvings of less than half a turn (2e-7 rad)
    // and the rounding of the angle (6e-8 rad).
    let with = |contact_angle_screw| KinematicsParameters {
        contact_angle_screw,
        ..good
    };
    let end = refused(with(-0.8)).allowed().minimum;
    assert!(is_taken(with(end)) && !is_taken(with(end - 4e-7)));

    let with = |rolling_radius_screw| KinematicsParameters {
        pitch_radius: 4e-3,
        rolling_radius_screw,
        ..good
    };
    let error = refused(with(6e-3));
    assert!(matches!(error, Error::FoldedGroove { .. }));
    assert_eq!(error.field(), "rolling_radius_screw");
    assert_eq!(error.allowed().minimum, 0.25 * good.ball_diameter);
    let limit = error.allowed().maximum;
    let path_radius = f64::from(4e-3_f32) * (1.0 + f64::from(good.lead_angle).tan().powi(2));
    let border = 0.9 * path_radius / f64::from(good.contact_angle_screw).cos();
    assert!(
        (f64::from(limit) / border - 1.0).abs() < 6e-7,
        "{limit} {border}"
    );
    assert!(is_taken(with(0.9999 * limit)) && !is_taken(with(1.0001 * limit)));
}

/// Slip along the direction of rolling has the angle 0 or pi, whatever the sign of a side slip of zero, on both raceways.
#[test]
fn slip_along_the_direction_of_rolling_has_an_angle_of_zero_or_pi() {
    use std::f32::consts::PI;
    let good = parameters(&operating::table_two().unwrap());
    let mut against = 0;
    for semi_major in [0.2e-3, 0.9e-3] {
        for yaw_angle in [0.0, -0.0] {
            let kinematics = ContactKinematics::new(&KinematicsParameters {
                lead_angle: 0.0,
                yaw_angle,
                semi_major_screw: semi_major,
                semi_major_nut: semi_major,
                ..good
            })
            .unwrap();
            for contact in [kinematics.screw(), kinematics.nut()] {
                let angle = contact.ratios().slide_angle;
                assert!(angle == 0.0 || angle == PI, "{angle}");
                against += i32::from(angle == PI);
            }
        }
    }
    assert!(against > 0);
}

#[test]
fn wrong_numbers_in_the_loop_count_as_zero() {
    let kinematics = ContactKinematics::new(&parameters(&operating::table_two().unwrap())).unwrap();
    let still = kinematics.tick(0.0);
    assert_eq!(still.screw.entrainment_speed, 0.0);
    for speed in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1.1e6, f32::MIN] {
        assert_eq!(kinematics.tick(speed), still);
    }
    assert_eq!(
        kinematics.tick(1e6).screw.entrainment_speed,
        1e6 * kinematics.per_speed().screw.entrainment_speed
    );
    let screw = kinematics.screw();
    for (x, y) in [
        (f32::NAN, 0.0),
        (0.0, f32::INFINITY),
        (1e-3, 0.0),
        (0.0, -1e-3),
    ] {
        let slip = screw.slip_at(100.0, x, y);
        assert_eq!((slip.rolling, slip.side), (0.0, 0.0));
    }
}

#[test]
fn unloaded_contact() {
    let input = KinematicsInput {
        semi_major_screw: 0.0,
        semi_minor_screw: 0.0,
        ..operating::table_two().unwrap()
    };
    let kinematics = ContactKinematics::new(&parameters(&input)).unwrap();
    assert_eq!(kinematics.per_speed().screw.rolling_slip, 0.0);
    assert_eq!(kinematics.screw().ratios().spin_to_roll, 0.0);
}

/// The parameters of a design are those that an engineer would type: angles and radii from the catalogue, the lead
/// angle by the arc tangent, ellipses by Hertz.
#[test]
fn parameters_of_a_design_are_those_typed_in() {
    const DESIGN: BallScrew = match CATALOGUE[15].design() {
        Ok(design) => design,
        Err(_) => panic!("the design is out of range"),
    };
    const FOLDED: Result<KinematicsParameters, Error> =
        KinematicsParameters::of(&DESIGN, 120.0, 110.0);
    assert_eq!(FOLDED, KinematicsParameters::of(&DESIGN, 120.0, 110.0));

    for size in &CATALOGUE {
        let design = size.design().unwrap();
        let given = design.parameters();
        let found = KinematicsParameters::of(&design, 120.0, 110.0).unwrap();
        let ellipse = |groove, load| HertzContact::of(&design, groove).at(load);
        let (screw, nut) = (ellipse(Groove::Screw, 120.0), ellipse(Groove::Nut, 110.0));
        let conformity = |size| match size {
            GrooveSize::Conformity(conformity) => conformity,
            GrooveSize::Radius(radius) => radius / (2.0 * given.ball_radius),
        };
        let typed = KinematicsParameters {
            ball_diameter: 2.0 * given.ball_radius,
            pitch_radius: given.pitch_radius,
            lead_angle: given.lead.atan2(TAU as f32 * given.pitch_radius),
            groove_radius_screw: conformity(given.screw_groove) * 2.0 * given.ball_radius,
            groove_radius_nut: conformity(given.nut_groove) * 2.0 * given.ball_radius,
            contact_angle_screw: given.contact_angle,
            contact_angle_nut: given.contact_angle,
            pitch_angle: given.contact_angle,
            yaw_angle: 0.0,
            rolling_radius_screw: given.ball_radius,
            rolling_radius_nut: given.ball_radius,
            semi_major_screw: screw.semi_major,
            semi_minor_screw: screw.semi_minor,
            semi_major_nut: nut.semi_major,
            semi_minor_nut: nut.semi_minor,
        };
        // Each number within three roundings, 3 x 2^-24, the lead angle within 1.5e-7 rad.
        for (name, field) in FIELDS {
            let [found, typed] = [found, typed].map(|mut given| *field(&mut given));
            let bound = 2e-7 * typed.abs() + if name == "lead_angle" { 1.5e-7 } else { 0.0 };
            assert!((found - typed).abs() <= bound, "{name} {found} {typed}");
        }
        assert!(ContactKinematics::new(&found).is_ok());

        for load in [-1.0, 1.01e7, f32::NAN] {
            let error = KinematicsParameters::of(&design, load, 1.0).unwrap_err();
            assert_eq!(error.field(), "load_screw");
            let error = KinematicsParameters::of(&design, 1.0, load).unwrap_err();
            assert_eq!(error.field(), "load_nut");
        }
        let crushed = KinematicsParameters::of(&design, 1e7, 1.0).unwrap();
        let error = ContactKinematics::new(&crushed).unwrap_err();
        assert_eq!(error.field(), "semi_major_screw");
    }
}

/// The lead angle of a design against the arc tangent in f64, from no lead to the steepest helix, of 88.2 degrees: the
/// longest lead on the smallest pitch radius.
#[test]
fn lead_angle_of_a_design() {
    let mut worst = 0.0_f64;
    for step in 0..=2000 {
        let mut given = *CATALOGUE[15].design().unwrap().parameters();
        given.pitch_radius = 1e-3;
        given.ball_radius = 2e-4;
        let angle = f64::from(step) / 2000.0 * 1.54;
        given.lead = (TAU * f64::from(given.pitch_radius) * angle.tan()) as f32;
        let Ok(design) = BallScrew::new(given) else {
            assert!(given.lead > 0.2);
            continue;
        };
        let truth = (f64::from(given.lead) / (TAU * f64::from(given.pitch_radius))).atan();
        worst = worst.max((f64::from(design.lead_angle()) - truth).abs());
    }
    // Two roundings of the angle above 1 rad, 6e-8 each, two of the smaller of sine and cosine, up to 0.71: 3e-8 each over
    // a cosine of 0.71. Measured: 1.9e-7.
    assert!(worst < 2.1e-7, "{worst:e}");
}
