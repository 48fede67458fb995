//! Closed-form efficiency: the reference against 17-digit values, the crate against both, and the laws
//! that bind efficiency, torque and self-locking.

use crate::refusals::assert_refused;
use epas_design::efficiency::{
    DesignRequest, Duty, DynamicCorrection, optimum_contact_angle, optimum_efficiency,
};
use epas_friction::efficiency::{Drive, EfficiencyGeometry};
use epas_friction::{CATALOGUE, Material};
use epas_reference::efficiency::{self as reference, Screw};
use epas_testkit::designs::SCREW_TRACK;
use epas_testkit::golden::cases;
use epas_testkit::measured;
use serde_json::Value;

fn number(case: &Value, name: &str) -> f64 {
    case[name].as_str().unwrap().parse().unwrap()
}

fn maybe(case: &Value, name: &str) -> Option<f64> {
    case[name].as_str().map(|text| text.parse().unwrap())
}

fn screw(case: &Value) -> Screw {
    Screw {
        lead_angle: number(case, "alpha"),
        contact_angle: number(case, "beta"),
        friction: number(case, "f"),
        ball_ratio: number(case, "a"),
        rolling_tangent: number(case, "t_rho"),
    }
}

#[test]
fn reference_equals_17_digit_values() {
    for case in cases("efficiency", "closed_form") {
        let screw = screw(&case);
        let (alpha, f) = (screw.lead_angle, screw.friction);
        for (computed, name) in [
            (screw.root(), "R"),
            (screw.sliding_drive(), "eta14"),
            (screw.loss_drive(), "loss14"),
            (screw.sliding_backdrive(), "eta17"),
            (screw.loss_backdrive(), "loss17"),
            (screw.rolling_screw(), "eta3"),
            (screw.rolling_nut(), "eta4"),
            (reference::optimum_efficiency(f), "optimum_eta"),
            (
                reference::normal_per_axial_load(alpha, screw.contact_angle),
                "Q_per_Fa_20",
            ),
            (
                reference::normal_per_torque(alpha, screw.contact_angle),
                "Q_rm_per_M_21",
            ),
        ] {
            let expected = number(&case, name);
            // A dozen roundings of 1.1e-16, next to a lock border on a sum that cancels: absolute there.
            let allowed = 1.4e-15 * expected.abs().max(1.0) * (1.0 + expected.abs());
            assert!(
                (computed - expected).abs() < allowed,
                "{name} of {case}: {computed}"
            );
        }
        for (computed, name) in [
            (reference::optimum_drive(alpha, f), "optimum_beta_15"),
            (reference::optimum_backdrive(alpha, f), "optimum_beta_18"),
            (
                reference::locking_border_drive(alpha, f),
                "critical_beta_16",
            ),
            (
                reference::locking_border_backdrive(alpha, f),
                "critical_beta_19",
            ),
        ] {
            match (computed, maybe(&case, name)) {
                (Some(computed), Some(expected)) => {
                    measured::assert_at(
                        "optimum and locking angles in rad",
                        computed - expected,
                        format_args!("{name} of {case}"),
                    );
                }
                (computed, expected) => assert_eq!(computed, expected, "{name} of {case}"),
            }
        }
        assert_eq!(
            screw.locked_drive(),
            case["self_braking_16"].as_bool().unwrap()
        );
        assert_eq!(
            screw.locked_backdrive(),
            case["self_braking_19"].as_bool().unwrap()
        );
    }
}

/// A loss has no subtraction: it takes at most 5 roundings of 2^-24 beside those of sine, cosine and root, relative to itself.
/// Efficiencies are measured in `scenes::promises`.
#[test]
fn crate_holds_over_all_cases() {
    for case in cases("efficiency", "closed_form") {
        let exact = screw(&case);
        let fast = EfficiencyGeometry::new(
            exact.lead_angle as f32,
            exact.contact_angle as f32,
            exact.ball_ratio as f32,
        )
        .unwrap();
        let f = exact.friction as f32;
        // The rounding of an angle near 90 degrees alone moves a value by more than the formula does.
        let rounded = Screw {
            lead_angle: f64::from(exact.lead_angle as f32),
            contact_angle: f64::from(exact.contact_angle as f32),
            friction: f64::from(f),
            ball_ratio: f64::from(exact.ball_ratio as f32),
            ..exact
        };
        for (computed, expected) in [
            (fast.sliding_loss(f), rounded.loss_drive()),
            (fast.sliding_backdrive_loss(f), rounded.loss_backdrive()),
        ] {
            let error = (f64::from(computed) - expected).abs() / expected.max(f64::MIN_POSITIVE);
            assert!(error < 6e-7, "loss of {case}: {error:e}");
        }
        assert_eq!(
            fast.locks(Drive::Driving, f),
            case["self_braking_16"].as_bool().unwrap()
        );
        assert_eq!(
            fast.locks(Drive::BackDriving, f),
            case["self_braking_19"].as_bool().unwrap()
        );
        for (drive, name) in [
            (Drive::Driving, "optimum_beta_15"),
            (Drive::BackDriving, "optimum_beta_18"),
        ] {
            let best = optimum_contact_angle(drive, exact.lead_angle as f32, f).unwrap();
            match (best.contact_angle, maybe(&case, name)) {
                (Some(computed), Some(expected)) => {
                    // Three roundings of 2^-24 of the angle, and three of its sine, which near 90 degrees count by
                    // the inverse of its cosine.
                    let steep = 2e-7 / (std::f64::consts::FRAC_PI_2 - expected).max(1e-3);
                    assert!(
                        (f64::from(computed) - expected).abs() < 2e-7 + steep,
                        "{case}"
                    );
                }
                (computed, expected) => {
                    assert_eq!(computed.is_some(), expected.is_some(), "{name} of {case}");
                }
            }
        }
        let best = f64::from(optimum_efficiency(f));
        // Five roundings of 2^-24.
        assert!((best - number(&case, "optimum_eta")).abs() < 3e-7);
        let per_load = f64::from(fast.normal_per_axial_load()) / number(&case, "Q_per_Fa_20");
        let per_torque = f64::from(fast.normal_per_torque()) / number(&case, "Q_rm_per_M_21");
        // Six roundings of 2^-24.
        assert!(
            (per_load - 1.0).abs() < 3.6e-7 && (per_torque - 1.0).abs() < 3.6e-7,
            "{case}"
        );
    }
}

/// The first-order dynamic correction is the crate's `k1` to f32, and brings the closed form to the
/// exact steady state: the part of second order in the dynamic number is left.
#[test]
fn dynamic_correction_reaches_the_exact_steady_state() {
    for case in cases("efficiency", "exact") {
        let fast = EfficiencyGeometry::new(
            number(&case, "alpha") as f32,
            number(&case, "beta") as f32,
            (number(&case, "r_b") / number(&case, "r_m")) as f32,
        )
        .unwrap();
        let correction = DynamicCorrection::new(&fast, number(&case, "f") as f32);
        let expected = number(&case, "k1");
        let error = f64::from(correction.coefficient()) - expected;
        // The bracket of k1 cancels to some hundredths of its terms: beside a thirtieth, relative.
        measured::assert_at(
            "coefficient of the dynamic correction",
            error / (expected.abs() + 1.0 / 30.0),
            format_args!("{case}: {error:e}"),
        );
        let dynamic_number =
            number(&case, "mass") * number(&case, "r_m") * number(&case, "omega").powi(2)
                / number(&case, "f_a");
        let corrected = f64::from(correction.efficiency(dynamic_number as f32));
        let first_order = number(&case, "eta_dyn1");
        measured::assert_at(
            "corrected efficiency",
            corrected - first_order,
            format_args!("{case}: {corrected}"),
        );
        let left = (first_order - number(&case, "eta")).abs();
        measured::assert_at(
            "corrected efficiency",
            ((corrected - number(&case, "eta")).abs() - left).max(0.0),
            format_args!("{case}"),
        );
    }
}

#[test]
fn rolling_efficiency_is_where_the_equations_of_motion_lead() {
    for case in cases("efficiency", "rolling") {
        let fast = EfficiencyGeometry::new(
            number(&case, "alpha") as f32,
            number(&case, "beta") as f32,
            (4.37 / 24.3) as f32,
        )
        .unwrap();
        let computed = f64::from(fast.rolling_efficiency(number(&case, "f") as f32, 0.0));
        // 1.1e-7 of the integration and its regularised friction, and three roundings of 2^-24.
        assert!(
            (computed - number(&case, "eta")).abs() < 3e-7,
            "{case}: {computed}"
        );
    }
}

/// With rolling resistance the load back-drives with as much as it takes to drive with all friction reversed,
/// `eta_B(f, t) = 1 / eta_D(-f, -t)`; a tangent that is negative or NaN counts as 0.
#[test]
fn back_driving_is_driving_with_all_friction_reversed() {
    for lead_angle in [0.02_f32, 0.1, 0.5] {
        for contact_angle in [0.5_f32, 0.8, 1.2] {
            let fast = EfficiencyGeometry::new(lead_angle, contact_angle, 0.125).unwrap();
            for friction in [0.01_f32, 0.1, 0.3] {
                for rolling_tangent in [0.0_f32, 5e-4, 5e-3, 0.05] {
                    let reversed = Screw {
                        lead_angle: lead_angle.into(),
                        contact_angle: contact_angle.into(),
                        friction: -f64::from(friction),
                        ball_ratio: 0.125,
                        rolling_tangent: -f64::from(rolling_tangent),
                    };
                    let exact = 1.0 / reversed.rolling_screw();
                    let found = fast.rolling_backdrive_efficiency(friction, rolling_tangent);
                    // Derived: twelve roundings of 6e-8 in the loss, one of the difference.
                    let bound = 6e-8 * (1.0 + 12.0 * (1.0 - exact).abs());
                    let error = f64::from(found) - exact;
                    assert!(error.abs() < bound, "{error:e} {reversed:?}");
                }
                let without = fast.rolling_efficiency(friction, 0.0);
                for tangent in [-1e-3, -1.0, f32::NAN] {
                    let error = fast.rolling_efficiency(friction, tangent) - without;
                    // Derived: four roundings in either of the two.
                    assert!(error.abs() < 8.0 * 6e-8, "{tangent} {error:e}");
                }
            }
        }
    }
}

/// Without lead a load moves nothing where rolling resists, and gives up what slip takes where it does not.
#[test]
fn back_driving_without_lead() {
    for contact_angle in [0.5_f32, 0.8, 1.2] {
        let fast = EfficiencyGeometry::new(0.0, contact_angle, 0.125).unwrap();
        for friction in [0.01_f32, 0.1, 0.3] {
            let exact = Screw {
                lead_angle: 0.0,
                contact_angle: contact_angle.into(),
                friction: friction.into(),
                ball_ratio: 0.125,
                rolling_tangent: 0.0,
            };
            let found = f64::from(fast.rolling_backdrive_efficiency(friction, 0.0));
            let error = found - exact.rolling_backdrive();
            assert!(error.abs() < 1.2e-7, "{error:e}");
            assert_eq!(
                fast.rolling_backdrive_efficiency(friction, 1e-3),
                f32::NEG_INFINITY
            );
        }
    }
}

#[test]
fn design_procedure_returns_every_step_consistently() {
    let request = DesignRequest {
        duty: Duty::MoveAxialLoad(14_500.0),
        lead_angle: 5f32.to_radians(),
        friction: 0.075,
        screw_length: 0.75,
        pitch_radius: 14.5e-3,
        ball_ratio: 0.14,
        osculation: 0.96,
        loaded_balls: 71,
        rotation: 10.0,
        material: Material::STEEL,
    };
    let figures = request.figures().unwrap();
    let alpha = f64::from(request.lead_angle);
    let beta = reference::optimum_drive(alpha, f64::from(0.075_f32)).unwrap();
    let close = |computed: f32, exact: f64| {
        measured::assert_at(
            "design procedure",
            f64::from(computed) / exact - 1.0,
            format_args!("{computed} for {exact}"),
        );
    };
    close(figures.contact_angle, beta);
    close(figures.ball_radius, 0.14 * 14.5e-3);
    close(figures.groove_radius, 0.14 * 14.5e-3 / 0.96);
    close(
        figures.contact_force,
        14_500.0 / 71.0 * reference::normal_per_axial_load(alpha, beta),
    );
    close(figures.advance, 14.5e-3 * alpha.tan() * 10.0);
    close(figures.lead, std::f64::consts::TAU * 14.5e-3 * alpha.tan());
    close(
        figures.sliding_efficiency,
        reference::optimum_efficiency(f64::from(0.075_f32)),
    );
    assert!(figures.max_pressure_screw > figures.max_pressure_nut);
    assert!(
        (2e9..3e9).contains(&figures.max_pressure_nut),
        "{figures:?}"
    );

    let torque = DesignRequest {
        duty: Duty::DeliverTorque(16.0),
        ..request
    };
    let delivered = torque.figures().unwrap();
    let beta = reference::optimum_backdrive(alpha, f64::from(0.075_f32)).unwrap();
    close(
        delivered.contact_force,
        16.0 / 71.0 / 14.5e-3 * reference::normal_per_torque(alpha, beta),
    );
}

const BAD: &[f32] = &[-1.0, 1e30];

#[test]
fn bad_requests_are_refused_by_name() {
    assert_refused(
        &(0.1, 0.7, 0.1),
        |&(lead, contact, ratio)| EfficiencyGeometry::new(lead, contact, ratio),
        &[
            ("lead_angle", |p, v| p.0 = v, BAD),
            ("contact_angle", |p, v| p.1 = v, BAD),
            ("ball_ratio", |p, v| p.2 = v, BAD),
        ],
    );
    assert_refused(
        &(0.1, 0.1),
        |&(lead, friction)| optimum_contact_angle(Drive::Driving, lead, friction),
        &[
            ("lead_angle", |p, v| p.0 = v, BAD),
            ("friction", |p, v| p.1 = v, BAD),
        ],
    );
    let good = DesignRequest {
        duty: Duty::MoveAxialLoad(1000.0),
        lead_angle: 0.1,
        friction: 0.075,
        screw_length: 0.5,
        pitch_radius: SCREW_TRACK.pitch_radius as f32,
        ball_ratio: (SCREW_TRACK.ball_radius / SCREW_TRACK.pitch_radius) as f32,
        osculation: 0.95,
        loaded_balls: 30,
        rotation: 1.0,
        material: Material::STEEL,
    };
    assert_refused(
        &good,
        DesignRequest::figures,
        &[
            ("axial_load", |p, v| p.duty = Duty::MoveAxialLoad(v), BAD),
            ("torque", |p, v| p.duty = Duty::DeliverTorque(v), BAD),
            ("lead_angle", |p, v| p.lead_angle = v, BAD),
            ("friction", |p, v| p.friction = v, BAD),
            ("screw_length", |p, v| p.screw_length = v, BAD),
            ("pitch_radius", |p, v| p.pitch_radius = v, BAD),
            ("ball_ratio", |p, v| p.ball_ratio = v, BAD),
            ("osculation", |p, v| p.osculation = v, BAD),
            ("rotation", |p, v| p.rotation = v, &[-1e30, 1e30]),
            ("loaded_balls", |p, _| p.loaded_balls = 0, &[]),
        ],
    );
    assert!(EfficiencyGeometry::new(0.0, 0.7, 0.1).is_ok());
    assert_eq!(
        EfficiencyGeometry::of(&CATALOGUE[0].design().unwrap()).ball_ratio(),
        7.144 / 125.0
    );
}
