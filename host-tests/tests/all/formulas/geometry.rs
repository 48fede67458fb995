//! Designs: every field of every constructor with every kind of bad number; derived constants.

use crate::refusals::assert_refused;

use epas_friction::geometry::{Groove, HelixPath};
use epas_friction::{BallScrew, BallScrewParameters, CATALOGUE, Error, GrooveSize, LinearBearing};
use epas_testkit::designs::{LINEAR_BEARING, SCREW_GROOVE_RADIUS, SCREW_TRACK, screw};

fn good() -> BallScrewParameters {
    *screw().parameters()
}

const BAD: &[f32] = &[-1.0, f32::MAX, f32::MIN, -1e-40];
/// Zeros too, and what is next to them.
const NOT_POSITIVE: &[f32] = &[-1.0, f32::MAX, f32::MIN, -1e-40, 0.0, -0.0, 1e-30];

#[test]
fn every_field_of_a_ball_screw_is_checked() {
    #[rustfmt::skip]
    assert_refused(
        &good(),
        |parameters| BallScrew::new(*parameters),
        &[
            ("pitch_radius", |p, v| p.pitch_radius = v, NOT_POSITIVE),
            ("lead", |p, v| p.lead = v, BAD),
            ("ball_radius", |p, v| p.ball_radius = v, NOT_POSITIVE),
            ("contact_angle", |p, v| p.contact_angle = v, NOT_POSITIVE),
            ("conformity", |p, v| p.screw_groove = GrooveSize::Conformity(v), BAD),
            ("conformity", |p, v| p.nut_groove = GrooveSize::Conformity(v), BAD),
            ("conformity", |p, v| p.nut_groove = GrooveSize::Conformity(v), &[0.5, 0.49, 0.500_4, 1.01]),
            ("groove_radius", |p, v| p.screw_groove = GrooveSize::Radius(v), BAD),
            ("groove_radius", |p, v| p.nut_groove = GrooveSize::Radius(v), BAD),
            ("youngs_modulus", |p, v| p.ball_material.youngs_modulus = v, BAD),
            ("poisson_ratio", |p, v| p.ball_material.poisson_ratio = v, BAD),
            ("density", |p, v| p.ball_material.density = v, BAD),
            ("youngs_modulus", |p, v| p.groove_material.youngs_modulus = v, BAD),
            ("poisson_ratio", |p, v| p.groove_material.poisson_ratio = v, BAD),
            ("density", |p, v| p.groove_material.density = v, BAD),
        ],
    );
}

#[test]
fn every_field_of_a_linear_bearing_is_checked() {
    #[rustfmt::skip]
    assert_refused(
        &LINEAR_BEARING,
        |parameters| LinearBearing::new(*parameters),
        &[
            ("ball_radius", |p, v| p.ball_radius = v, BAD),
            ("contact_angle", |p, v| p.contact_angle = v, BAD),
            ("conformity", |p, v| p.groove = GrooveSize::Conformity(v), BAD),
        ],
    );
}

/// A thick ball in a wide groove on a thin screw: the groove reaches the axis.
#[test]
fn a_folded_screw_is_refused() {
    let parameters = BallScrewParameters {
        pitch_radius: 3e-3,
        lead: 0.0,
        ball_radius: 2.6e-3,
        screw_groove: GrooveSize::Conformity(0.9),
        contact_angle: 1.5,
        ..good()
    };
    let error = BallScrew::new(parameters).unwrap_err();
    assert!(matches!(error, Error::FoldedGroove { .. }));
    assert_eq!(error.field(), "groove_radius");
    assert!(!error.allowed().contains(error.value()));
    assert!(
        BallScrew::new(BallScrewParameters {
            lead: 50e-3,
            ..parameters
        })
        .is_ok()
    );
}

#[test]
fn conformity_and_groove_radius_agree() {
    let by_radius = BallScrew::new(good()).unwrap();
    let conformity = (SCREW_GROOVE_RADIUS / (2.0 * SCREW_TRACK.ball_radius)) as f32;
    let groove = GrooveSize::Conformity(conformity);
    let by_conformity = BallScrew::new(BallScrewParameters {
        screw_groove: groove,
        nut_groove: groove,
        ..good()
    })
    .unwrap();
    for groove in [Groove::Screw, Groove::Nut] {
        let (a, b) = (by_radius.clearance(groove), by_conformity.clearance(groove));
        // The difference of radii keeps the two roundings of the radius, 2^-24 each: 7 times larger than itself here.
        assert!((a / b - 1.0).abs() < 8.4e-7, "{a} {b}");
    }
}

#[test]
fn path_from_lead_equals_path_from_lead_angle() {
    for size in CATALOGUE {
        let parameters = size.parameters();
        let tan = f64::from(parameters.lead)
            / (std::f64::consts::TAU * f64::from(parameters.pitch_radius));
        let path = HelixPath::from_lead(parameters.pitch_radius, parameters.lead);
        let curvature = 1.0 / (f64::from(parameters.pitch_radius) * (1.0 + tan * tan));
        // Six roundings.
        assert!((f64::from(path.curvature) / curvature - 1.0).abs() < 4e-7);
        assert!((f64::from(path.torsion) / (curvature * tan) - 1.0).abs() < 4e-7);
    }
}

#[test]
fn mass_of_a_ball_is_its_volume_times_density() {
    let design = BallScrew::new(good()).unwrap();
    let expected = 7800.0 * 4.0 / 3.0 * std::f64::consts::PI * SCREW_TRACK.ball_radius.powi(3);
    assert!((f64::from(design.ball_mass()) / expected - 1.0).abs() < 3e-7);
}
