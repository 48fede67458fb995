//! The table of promises: measured.

use epas_testkit::errors::Errors;
use epas_testkit::given;
use std::path::Path;

use epas_friction::curvature::{
    CircularGrooveCurvature, FittedCurvature, GothicArch, LiteratureCurvature,
};
use epas_friction::efficiency::EfficiencyGeometry;
use epas_friction::geometry::{ContactAngle, Groove};
use epas_friction::hertz::HertzContact;
use epas_friction::{CATALOGUE, DeviationMap, Harmonic};
use epas_reference::curvature;
use epas_reference::efficiency::Screw;
use epas_reference::hertz::Hertz;
use epas_reference::promises::{self, PROMISES};
use epas_testkit::random::Random;

const INPUTS: u32 = 400_000;

#[test]
fn curvatures() {
    let mut random = Random(22);
    let (mut exact, mut fitted) = (Errors::default(), Errors::default());
    let (mut literature, mut circular) = (Errors::default(), Errors::default());
    for _ in 0..INPUTS / 4 {
        let size = random.of(&CATALOGUE);
        let design = size.design().unwrap();
        let (groove, side) = random.of(&[
            (Groove::Screw, curvature::Groove::Screw),
            (Groove::Nut, curvature::Groove::Nut),
        ]);
        let angle = random.within(0.0, 80_f32.to_radians());
        let surface = given::ball_screw(design.parameters()).surface(side);
        let truth = surface.principal(f64::from(angle)).kappa1;
        let at = ContactAngle::new(angle);
        let line = || format!("{} {groove:?} {angle}", size.name);
        let found = GothicArch::of(&design, groove).principal(at).kappa1;
        exact.add_case(f64::from(found) / truth - 1.0, line);
        if angle <= 1.256 {
            let found = FittedCurvature::of(&design, groove).first(at);
            fitted.add_case(f64::from(found) / truth - 1.0, line);
        }
        if angle <= 70_f32.to_radians() {
            let found = LiteratureCurvature::of(&design, groove).first(at);
            literature.add_case(f64::from(found) / truth - 1.0, line);
            let found = CircularGrooveCurvature::of(&design, groove).first(at);
            circular.add_case(f64::from(found) / truth - 1.0, line);
        }
    }
    literature.assert_promised(promises::of("literature_curvature"));
    circular.assert_promised(promises::of("circular_curvature"));
    exact.assert_promised(promises::of("gothic_arch"));
    fitted.assert_promised(promises::of("fitted_curvature"));
}

#[test]
fn contact_ellipses() {
    let mut random = Random(23);
    let mut errors = Errors::default();
    for _ in 0..INPUTS / 10 {
        let first = random.size(1e-4, 1e-2);
        let second = first * random.size(1.0, 9.9e4);
        let (modulus, load) = (random.size(1e10, 1e12), random.size(1e-3, 1e6));
        let found = HertzContact::checked(first, second, modulus)
            .unwrap()
            .at(load);
        let exact = Hertz::new(first.into(), second.into(), modulus.into())
            .unwrap()
            .at(load.into());
        for (found, exact) in [
            (found.semi_major, exact.semi_major),
            (found.semi_minor, exact.semi_minor),
            (found.deflection, exact.deflection),
            (found.max_pressure, exact.max_pressure),
        ] {
            let error = f64::from(found) / exact - 1.0;
            errors.add_case(error, || format!("{first} {second} {modulus} {load}"));
        }
    }
    errors.assert_promised(promises::of("hertz"));
}

#[test]
fn efficiencies() {
    let mut random = Random(24);
    let mut sliding = Errors::default();
    let (mut rolling, mut backdrive) = (Errors::default(), Errors::default());
    let mut driven = Errors::default();
    for _ in 0..INPUTS {
        let lead_angle = random.within(0.5_f32.to_radians(), 60_f32.to_radians());
        let contact_angle = random.within(5_f32.to_radians(), 85_f32.to_radians());
        let friction = random.size(1e-3, 0.3);
        let tangent = random.of(&[0.0, 0.01]);
        let found = EfficiencyGeometry::new(lead_angle, contact_angle, 0.2).unwrap();
        let exact = Screw {
            lead_angle: lead_angle.into(),
            contact_angle: contact_angle.into(),
            friction: friction.into(),
            ball_ratio: f64::from(0.2_f32),
            rolling_tangent: tangent.into(),
        };
        let line = || format!("{lead_angle} {contact_angle} {friction} {tangent}");
        if !exact.locked_drive() {
            let error = f64::from(found.sliding_efficiency(friction)) - exact.sliding_drive();
            sliding.add_case(error, line);
            let found = f64::from(found.rolling_efficiency(friction, tangent));
            rolling.add_case(found - exact.rolling_screw(), line);
        }
        if !exact.locked_backdrive() {
            let found = f64::from(found.sliding_backdrive_efficiency(friction));
            backdrive.add_case(found - exact.sliding_backdrive(), line);
        }
        let found = f64::from(found.rolling_backdrive_efficiency(friction, 0.0));
        driven.add_case(found - exact.rolling_backdrive(), line);
    }
    sliding.assert_promised(promises::of("efficiency"));
    rolling.assert_promised(promises::of("rolling_efficiency"));
    backdrive.assert_promised(promises::of("backdrive_efficiency"));
    driven.assert_promised(promises::of("rolling_backdrive_efficiency"));
}

#[test]
fn deviations() {
    let mut random = Random(26);
    let mut errors = Errors::default();
    for _ in 0..300 {
        let amplitude = random.within(0.001, 0.14);
        let angle = random.within(0.0, std::f32::consts::TAU);
        let (sine, cosine) = (amplitude * angle.sin(), amplitude * angle.cos());
        let wave = Harmonic {
            order: 1,
            cosine,
            sine,
        };
        let map = DeviationMap::from_harmonics(1, &[wave]).unwrap();
        for _ in 0..200 {
            let phase = random.bits() as u32;
            let (s, c) = (std::f64::consts::TAU * f64::from(phase) / 2_f64.powi(32)).sin_cos();
            let exact = f64::from(cosine) * c + f64::from(sine) * s;
            let error = (f64::from(map.at(phase)) - exact) / f64::from(amplitude);
            errors.add_case(error, || format!("{amplitude} {angle} {phase}"));
        }
    }
    errors.assert_promised(promises::of("deviation_map"));
}

/// All of a folder's sources without their comments and white space.
fn sources(folder: &Path) -> String {
    let mut text = String::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            text += &sources(&path);
        } else if path.extension().is_some_and(|kind| kind == "rs") {
            for line in std::fs::read_to_string(path).unwrap().lines() {
                let code = line.split("//").next().unwrap_or_default();
                text.extend(code.split_whitespace());
            }
        }
    }
    text
}

/// Errors that nothing is compared with would be words: some test of these programs finds each of them against the reference,
/// and names the entry.
#[test]
fn every_error_is_asserted_by_its_name() {
    let tests = sources(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/tests")));
    let missing: Vec<&str> = PROMISES
        .all()
        .filter(|promise| !promise.error.starts_with("none"))
        .map(|promise| &*promise.name)
        .filter(|name| !tests.contains(&format!(".assert_promised(promises::of(\"{name}\")")))
        .collect();
    assert!(missing.is_empty(), "{missing:?}");
}
