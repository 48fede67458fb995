//! The contact ellipse: the reference against tabulated values, the crate against the reference.

use crate::refusals::assert_refused;
use epas_friction::geometry::Groove;
use epas_friction::hertz::HertzContact;
use epas_friction::{BallScrew, CATALOGUE, DISSERTATION_DESIGNS, LinearBearing};
use epas_reference::curvature;
use epas_reference::hertz::{self, Hertz};
use epas_testkit::designs::LINEAR_BEARING;
use epas_testkit::given;
use epas_testkit::golden::file;
use epas_testkit::measured;

#[test]
fn reference_equals_tabulated_contacts() {
    for case in file("friction")["hertz"].as_array().unwrap() {
        let field = |name: &str| case[name].as_f64().unwrap();
        let contact = Hertz::new(field("R1"), field("R2"), field("Estar")).unwrap();
        for (computed, name) in [
            (contact.axis_ratio, "k"),
            (contact.semi_major, "Ca"),
            (contact.semi_minor, "Cb"),
            (contact.deflection, "Cd"),
            (contact.max_pressure, "Cp"),
        ] {
            measured::assert_at(
                "tabulated contacts",
                computed / field(name) - 1.0,
                format_args!("{name} of {case}"),
            );
        }
    }
    for case in file("friction")["ellipticity"].as_array().unwrap() {
        let ratio = case["ratio"].as_f64().unwrap();
        let expected = case["k"].as_f64().unwrap();
        measured::assert(
            "tabulated axis ratios",
            hertz::axis_ratio(ratio).unwrap() / expected - 1.0,
        );
    }
}

/// Equal relative radii `R` give a circle, in closed form: `a³ = 3 F R / (4 E*)`, `delta = a² / R`.
#[test]
fn equal_radii_give_a_circle() {
    let (radius, modulus) = (0.01, 1e11);
    let contact = Hertz::new(radius, radius, modulus).unwrap();
    let expected = (3.0 * radius / (4.0 * modulus)).cbrt();
    // A root and a few products: ten roundings of 1.1e-16.
    assert!((contact.axis_ratio - 1.0).abs() < 1.2e-15);
    assert!((contact.semi_major / expected - 1.0).abs() < 1.2e-15);
    assert!((contact.deflection / (expected * expected / radius) - 1.0).abs() < 1.2e-15);
    let fast = HertzContact::checked(radius as f32, radius as f32, modulus as f32).unwrap();
    measured::assert(
        "circle by the fitted axis ratio",
        f64::from(fast.semi_major_coefficient()) / expected - 1.0,
    );
}

#[test]
fn a_lost_contact_has_no_ellipse() {
    let contact = HertzContact::of(&CATALOGUE[15].design().unwrap(), Groove::Nut);
    for lost in [0.0, -0.0, -5.0, f32::NEG_INFINITY, f32::NAN] {
        let ellipse = contact.at(lost);
        assert_eq!(ellipse.semi_major, 0.0);
        assert_eq!(ellipse.max_pressure, 0.0);
    }
}

#[test]
fn designs_give_the_contact_of_their_surface() {
    let dissertation = DISSERTATION_DESIGNS.map(|design| design.parameters);
    let catalogue = CATALOGUE.map(|size| size.parameters());
    for parameters in dissertation.into_iter().chain(catalogue) {
        let design = BallScrew::new(parameters).unwrap();
        for (groove, same) in [
            (Groove::Screw, curvature::Groove::Screw),
            (Groove::Nut, curvature::Groove::Nut),
        ] {
            let exact = given::ball_screw(&parameters).contact(same).unwrap();
            let fast = HertzContact::of(&design, groove);
            let error = f64::from(fast.semi_major_coefficient()) / exact.semi_major - 1.0;
            // 1.13e-5 as above, and a few roundings of the curvatures.
            assert!(error.abs() < 1.2e-5, "{parameters:?} {groove:?}: {error:e}");
        }
    }
}

/// Lin 2019, Table 3.3: a linear bearing with ball radius 5 mm and conformity 0.56 has an axis ratio of 0.2321.
#[test]
fn linear_bearing_of_table_3_3() {
    let design = LinearBearing::new(LINEAR_BEARING).unwrap();
    let contact = HertzContact::of_linear(&design);
    // The fit's 1.02e-5 of it, and half a unit of the last digit.
    assert!((contact.axis_ratio() - 0.232_146_4).abs() < 2.5e-6);
}

#[test]
fn bad_radii_and_moduli_are_refused_by_name() {
    const BAD: &[f32] = &[0.0, -1.0, 1e-30, 1e30];
    assert_refused(
        &(0.01, 0.02, 1e11),
        |&(first, second, modulus)| HertzContact::checked(first, second, modulus),
        &[
            ("relative_radius_1", |p, v| p.0 = v, BAD),
            ("relative_radius_2", |p, v| p.1 = v, BAD),
            ("relative_radius_2", |p, _| (p.0, p.1) = (1e-3, 101.0), &[]),
            ("relative_radius_2", |p, _| (p.0, p.1) = (101.0, 1e-3), &[]),
            ("contact_modulus", |p, v| p.2 = v, BAD),
        ],
    );
    for (first, second) in [(1e-3, 99.0), (99.0, 1e-3)] {
        assert!(HertzContact::checked(first, second, 1e11).is_ok());
    }
    for bad in [f64::NAN, f64::INFINITY, 0.0, -1.0, 1e-30, 1e30] {
        assert!(Hertz::new(bad, 0.01, 1e11).is_err());
    }
}
