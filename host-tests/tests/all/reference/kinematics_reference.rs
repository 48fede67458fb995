//! The reference kinematics against first principles, the published numbers and golden cases.

use super::kinematics_cases::{cases, input, number, random_input, side_of};
use crate::refusals::assert_refused;
use epas_reference::kinematics::{KinematicsInput, Raceway, Revised, operating};
use epas_testkit::measured;
use epas_testkit::random::Random;
use std::f64::consts::{PI, TAU};

const DEGREE: f64 = PI / 180.0;

/// Difference of two angles, -pi and pi being one.
pub fn turn(left: f64, right: f64) -> f64 {
    (left - right + PI).rem_euclid(TAU) - PI
}

/// The golden cases are correct to one unit in the last place; twelve digits remain after some twenty
/// operations in float64, slip counted against the entrainment speed.
#[test]
fn golden_cases_within_1e_12() {
    for case in cases() {
        let tag = case["tag"].as_str().unwrap();
        let revised = Revised::new(&input(&case)).unwrap();
        let ball = revised.evaluate();
        let check = |name: &str, found: f64, wanted: f64, scale: f64| {
            let error = (found - wanted).abs() / scale;
            measured::assert_at(
                "golden kinematics",
                error,
                format_args!("{tag}: {name} {found} for {wanted}: {error:e}"),
            );
        };
        let orbital = number(&case, &["omega_m_over_omega"]);
        let spin = number(&case, &["omega_R_over_omega"]);
        check("omega_m", revised.orbital_ratio(), orbital, orbital);
        check("omega_R", revised.spin_ratio(), spin, spin);
        for raceway in Raceway::BOTH {
            let golden = |key| number(&case, &[side_of(raceway), key]);
            let contact = ball.contact(raceway);
            let entrainment = golden("ve");
            let radius = 0.5 * revised.input().ball_diameter;
            check("v_e", contact.entrainment_speed, entrainment, entrainment);
            check("roll", contact.rolling_slip, golden("roll"), entrainment);
            check("side", contact.side_slip, golden("side"), entrainment);
            let (spin, wanted) = (contact.spin * radius, golden("spin") * radius);
            check("spin", spin, wanted, entrainment);
            let [v_x, v_y] = revised.entrainment(raceway);
            let speed = revised.input().speed;
            check("v_e,x", speed * v_x, golden("ve_x"), entrainment);
            check("v_e,y", speed * v_y, golden("ve_y"), entrainment);
            check("SRR", contact.slide_to_roll, golden("SRR"), 1.0);
            let wanted = golden("gamma_atan2");
            check("gamma", contact.entrainment_angle, wanted, 1.0);
            check("S_p", contact.spin_to_roll, golden("S_p"), 1.0);
            let phi = turn(contact.slide_angle.unwrap(), golden("phi_atan2"));
            check("phi", phi * golden("SRR"), 0.0, 1.0);
            let deficit = radius - revised.distance(raceway, 0.0);
            check("D/2 - S", deficit, golden("S0_deficit"), radius);
            let [slip_x, slip_y] = revised.slip(raceway, golden("x"), golden("y"));
            check("slip x", slip_x, golden("slip_x"), entrainment);
            check("slip y", slip_y, golden("slip_y"), entrainment);
        }
    }
}

/// Rolling slip is small beside the speeds that (31) subtracts. From its zero it keeps its digits: 1e-12
/// of itself wherever it is not itself a cancellation of rolling radius and sagitta.
#[test]
fn rolling_slip_keeps_its_own_digits() {
    for case in cases() {
        let revised = Revised::new(&input(&case)).unwrap();
        for raceway in Raceway::BOTH {
            let golden = number(&case, &[side_of(raceway), "roll_over_omega"]);
            let contact = revised.input().contact(raceway);
            let excess = (contact.rolling_radius - 0.5 * revised.input().ball_diameter).abs();
            if excess < 1e-9 {
                let error = (revised.rolling_slip(raceway, 0.0) / golden - 1.0).abs();
                measured::assert_at("rolling slip, its own digits", error, &case["tag"]);
            }
        }
    }
}

/// Harris' kinematics of an angular-contact ball bearing with its inner ring turning, in the form of
/// speeds: the helix of no lead is a bearing.
#[test]
fn zero_lead_is_a_bearing() {
    let mut random = Random(0x5EED_0003);
    for _ in 0..2000 {
        let mut input = random_input(&mut random);
        input.lead_angle = 0.0;
        input.yaw_angle = 0.0;
        input.rolling_radius_screw = 0.5 * input.ball_diameter;
        input.rolling_radius_nut = 0.5 * input.ball_diameter;
        let ball = Revised::new(&input).unwrap().evaluate();
        let gamma = 0.5 * input.ball_diameter / input.pitch_radius;
        let (inner, outer) = (input.contact_angle_screw, input.contact_angle_nut);
        let beta = input.pitch_angle;
        // omega_m / omega = [1 + (1 + g cos ao) cos(ai - b) / ((1 - g cos ai) cos(ao - b))]^-1
        let ratio = (1.0 + gamma * outer.cos()) * (inner - beta).cos()
            / ((1.0 - gamma * inner.cos()) * (outer - beta).cos());
        let orbital = input.speed / (1.0 + ratio);
        let near = measured::of_case("bearing of zero lead", format!("{input:?}"));
        near("speeds", ball.orbital_speed / orbital - 1.0);
        let spin_speed = orbital * (1.0 + gamma * outer.cos()) / (gamma * (outer - beta).cos());
        near("speeds", ball.spin_speed / spin_speed - 1.0);
        // Spin: relative rotation of ring and ball about the contact normal.
        let inner_spin = (orbital - input.speed) * inner.sin() + spin_speed * (beta - inner).sin();
        let outer_spin = -orbital * outer.sin() - spin_speed * (beta - outer).sin();
        for (spin, wanted) in [(ball.screw.spin, inner_spin), (ball.nut.spin, outer_spin)] {
            near("spin", (spin - wanted) / spin_speed);
        }
        assert_eq!((ball.screw.side_slip, ball.nut.side_slip), (0.0, 0.0));
        let straight_back = ball.screw.slide_angle.unwrap();
        assert!(straight_back == 0.0 || straight_back == PI);
    }
}

/// Side slip at both contacts adds up to `-omega sin psi` whatever the axis of rotation: a rearrangement of
/// sums of products, so a few roundings. Spin likewise for equal contact angles.
#[test]
fn neither_side_slip_nor_spin_can_vanish_at_both_contacts() {
    let mut random = Random(0x5EED_0004);
    for _ in 0..5000 {
        let mut input = random_input(&mut random);
        let revised = Revised::new(&input).unwrap();
        let ball = revised.evaluate();
        let sum: f64 = Raceway::BOTH
            .map(|raceway| ball.contact(raceway).side_slip / revised.distance(raceway, 0.0))
            .iter()
            .sum();
        let wanted = -input.speed * input.lead_angle.sin();
        let (error, case) = ((sum - wanted) / input.speed, format!("{input:?}"));
        measured::assert_at("sum of both side slips", error, case);

        input.contact_angle_nut = input.contact_angle_screw;
        let ball = Revised::new(&input).unwrap().evaluate();
        let wanted = -input.speed * input.lead_angle.cos() * input.contact_angle_screw.sin();
        let sum = ball.screw.spin + ball.nut.spin;
        let (error, case) = ((sum - wanted) / ball.spin_speed, format!("{input:?}"));
        measured::assert_at("sum of both spins", error, case);
    }
}

/// Contact ellipses of the golden cases are those of exact Hertz theory with (9) and (10).
#[test]
fn contact_ellipse_of_the_published_screw() {
    let cosine = operating::LEAD_ANGLE.cos();
    for (raceway, a, b) in [
        (Raceway::Screw, 0.601080947980393e-3, 0.08288466900521317e-3),
        (Raceway::Nut, 0.5858084960826777e-3, 0.09748010125556548e-3),
    ] {
        let (angle, load) = (operating::CONTACT_ANGLE, operating::CONTACT_LOAD);
        let ellipse = operating::ellipse(raceway, angle, cosine * cosine, load).unwrap();
        for error in [ellipse.semi_major / a - 1.0, ellipse.semi_minor / b - 1.0] {
            measured::assert_at(
                "ellipses of the published screw",
                error,
                format!("{raceway:?}"),
            );
        }
    }
    let ball = operating::loaded_ball(1500.0, operating::SPEED).unwrap();
    measured::assert(
        "contact angle of the published screw in degrees",
        ball.input.contact_angle_screw / DEGREE - 41.02,
    );
    assert!((ball.load_screw - 154.7).abs() < 0.05, "{ball:?}");
    assert_eq!(operating::ellipse(Raceway::Nut, 0.7, 1.0, 0.0), None);
}

#[test]
fn wrong_input_is_refused_by_name() {
    let good = operating::table_two().unwrap();
    #[rustfmt::skip]
    assert_refused(
        &good,
        Revised::new,
        &[
            ("ball_diameter", |i, v| i.ball_diameter = v, &[]),
            ("pitch_radius", |i, v| i.pitch_radius = v, &[]),
            ("lead_angle", |i, v| i.lead_angle = v, &[]),
            ("groove_radius_screw", |i, v| i.groove_radius_screw = v, &[]),
            ("groove_radius_nut", |i, v| i.groove_radius_nut = v, &[]),
            ("contact_angle_screw", |i, v| i.contact_angle_screw = v, &[]),
            ("contact_angle_nut", |i, v| i.contact_angle_nut = v, &[-1.0]),
            ("pitch_angle", |i, v| i.pitch_angle = v, &[]),
            ("yaw_angle", |i, v| i.yaw_angle = v, &[]),
            ("rolling_radius_screw", |i, v| i.rolling_radius_screw = v, &[30e-3]),
            ("rolling_radius_nut", |i, v| i.rolling_radius_nut = v, &[]),
            ("speed", |i, v| i.speed = v, &[]),
            ("semi_major_screw", |i, v| i.semi_major_screw = v, &[]),
            ("semi_minor_screw", |i, v| i.semi_minor_screw = v, &[]),
            ("semi_major_nut", |i, v| i.semi_major_nut = v, &[]),
            ("semi_minor_nut", |i, v| i.semi_minor_nut = v, &[]),
        ],
    );
    let far = KinematicsInput {
        contact_angle_nut: -1.0,
        ..good
    };
    let message = Revised::new(&far).unwrap_err().to_string();
    assert!(message.starts_with("contact_angle_nut: -1 must be"));
}

#[test]
fn standstill_has_ratios() {
    let moving = operating::table_two().unwrap();
    let still = KinematicsInput {
        speed: 0.0,
        ..moving
    };
    let (moving, still) = (
        Revised::new(&moving).unwrap(),
        Revised::new(&still).unwrap(),
    );
    for raceway in Raceway::BOTH {
        let (ball, at_rest) = (moving.evaluate(), still.evaluate());
        let (running, resting) = (ball.contact(raceway), at_rest.contact(raceway));
        assert_eq!(resting.slide_to_roll, running.slide_to_roll);
        assert_eq!(resting.slide_angle, running.slide_angle);
        assert_eq!(resting.entrainment_angle, running.entrainment_angle);
        assert_eq!(resting.spin_to_roll, running.spin_to_roll);
        assert_eq!(resting.entrainment_speed, 0.0);
    }
}
