//! The table of promises: measured, and printed where it says.

use crate::kit::errors::Errors;
use crate::kit::given;
use std::fmt::Write;
use std::path::Path;

use crate::kit::random::Random;
use epas_friction::contact::FrictionMap;
use epas_friction::curvature::{
    CircularGrooveCurvature, FittedCurvature, GothicArch, LiteratureCurvature,
};
use epas_friction::efficiency::EfficiencyGeometry;
use epas_friction::geometry::{ContactAngle, Groove};
use epas_friction::hertz::HertzContact;
use epas_friction::promises::{self, Footprint, Promise};
use epas_friction::{CATALOGUE, DeviationMap, Harmonic, math};
use epas_reference::curvature;
use epas_reference::efficiency::Screw;
use epas_reference::friction::maps;
use epas_reference::hertz::Hertz;

/// Error of `found` in units of the last place of the exact value.
fn ulps(found: f32, exact: f64) -> f64 {
    let rounded = (exact as f32).abs();
    let ulp = f64::from(f32::from_bits(rounded.to_bits() + 1)) - f64::from(rounded);
    (f64::from(found) - exact) / ulp
}

const INPUTS: u32 = 400_000;

#[test]
fn scalar_kernels() {
    let mut random = Random(21);
    let (mut sqrt, mut cbrt, mut squared, mut both, mut angles) = (
        Errors::default(),
        Errors::default(),
        Errors::default(),
        Errors::default(),
        Errors::default(),
    );
    for _ in 0..INPUTS {
        let x = f32::from_bits(random.below(0x7f80_0000) as u32);
        let exact = f64::from(x);
        let line = || format!("{x:e}");
        sqrt.add_case(ulps(math::sqrt(x), exact.sqrt()), line);
        cbrt.add_case(ulps(math::cbrt(x), exact.cbrt()), line);
        // Twice the cube root's rounding in f64 is far below an f32's.
        squared.add_case(ulps(math::cbrt_squared(x), exact.cbrt().powi(2)), line);
        let (root, square) = math::cbrt_and_squared(x);
        both.add_case(ulps(root, exact.cbrt()), line);
        both.add_case(ulps(square, exact.cbrt().powi(2)), line);
        let angle = std::f32::consts::TAU * (2.0 * random.unit() - 1.0);
        let (sin, cos) = math::sin_cos(angle);
        let line = || format!("{angle:e}");
        angles.add_case(f64::from(sin) - f64::from(angle).sin(), line);
        angles.add_case(f64::from(cos) - f64::from(angle).cos(), line);
    }
    sqrt.assert_promised(&promises::SQRT);
    cbrt.assert_promised(&promises::CBRT);
    squared.assert_promised(&promises::CBRT_SQUARED);
    both.assert_promised(&promises::CBRT_AND_SQUARED);
    angles.assert_promised(&promises::SIN_COS);
}

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
    literature.assert_promised(&promises::LITERATURE_CURVATURE);
    circular.assert_promised(&promises::CIRCULAR_CURVATURE);
    exact.assert_promised(&promises::GOTHIC_ARCH);
    fitted.assert_promised(&promises::FITTED_CURVATURE);
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
    errors.assert_promised(&promises::HERTZ);
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
        // The reference leaves rolling resistance out.
        let found = f64::from(found.rolling_backdrive_efficiency(friction, 0.0));
        driven.add_case(found - exact.rolling_backdrive(), line);
    }
    sliding.assert_promised(&promises::EFFICIENCY);
    rolling.assert_promised(&promises::ROLLING_EFFICIENCY);
    backdrive.assert_promised(&promises::BACKDRIVE_EFFICIENCY);
    driven.assert_promised(&promises::ROLLING_BACKDRIVE_EFFICIENCY);
}

#[test]
fn friction_maps() {
    let mut random = Random(25);
    let mut errors = Errors::default();
    for _ in 0..300 {
        let axis_ratio = random.within(0.05, 1.0);
        let fast = FrictionMap::new(axis_ratio).unwrap();
        let exact = maps::FrictionMap::new(axis_ratio.into()).unwrap();
        for _ in 0..20 {
            let offset = random.sign() * random.size(1e-2, 1e3);
            let wanted = exact.at(offset.into()).force;
            let line = || format!("{axis_ratio} {offset}");
            errors.add_case(f64::from(fast.force(offset)) - wanted, line);
        }
    }
    errors.assert_promised(&promises::FRICTION_MAP);
}

/// One wave in a period, between the table's samples as well as on them.
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
    errors.assert_promised(&promises::DEVIATION_MAP);
}

/// A number with an exponent where it is small.
fn shown(number: f64) -> String {
    if number < 0.1 {
        format!("{number:e}")
    } else {
        number.to_string()
    }
}

/// A table as Markdown, as it stands in `src/promises.md`.
fn table(title: &str, promises: &[Promise]) -> String {
    let mut text = format!(
        "\n# {title}\n\n\
         | function | domain | error | largest | rms | mean | outside | NaN, infinities | zeros, subnormals | cycles | \
         counted as |\n|---|---|---|---|---|---|---|---|---|---|---|\n",
    );
    for &Promise {
        function,
        domain,
        error,
        largest,
        rms,
        mean,
        outside,
        not_finite,
        tiny,
        cycles,
        counted,
    } in promises
    {
        let counted = counted
            .iter()
            .map(|name| format!("`{name}`"))
            .collect::<Vec<_>>()
            .join(", ");
        let _ = writeln!(
            text,
            "| `{function}` | {domain} | {error} | {} | {} | {} | {outside} | {not_finite} | {tiny} | {cycles} | {counted} |",
            shown(largest),
            shown(rms),
            shown(mean),
        );
    }
    text
}

/// The size of the programs with one scene each, as it stands there.
fn sizes() -> String {
    let mut text = String::from(
        "\n# Programs with one scene each, bytes\n\n\
         | scene | flash | flash, built for size | RAM | stack of a step | stack of the set-up |\n|---|---|---|---|---|---|\n",
    );
    for Footprint {
        scene,
        flash,
        flash_small,
        ram,
        stack,
        stack_set_up,
    } in promises::FOOTPRINTS
    {
        let _ = writeln!(
            text,
            "| `{scene}` | {flash} | {flash_small} | {ram} | {stack} | {stack_set_up} |"
        );
    }
    text
}

#[test]
fn the_page_shows_the_table() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../src/promises.md");
    let tables = table("Steps, and what they call", &promises::STEPS)
        + &table("Functions of which a step runs the parts", &promises::PARTS)
        + &table(
            "Functions that firmware calls by their names",
            &promises::DIRECT,
        )
        + &sizes();
    let page = std::fs::read_to_string(path).unwrap();
    assert!(
        page == tables,
        "src/promises.md has to hold exactly:\n{tables}"
    );
}

/// The names in the lists of `src/promises.rs`, in the order of [`promises::ALL`].
fn names() -> Vec<String> {
    let source = include_str!("../../../src/promises.rs");
    ["STEPS", "PARTS", "DIRECT"]
        .iter()
        .flat_map(|list| {
            let (_, rest) = source.split_once(&format!("pub const {list}: ")).unwrap();
            let (_, rest) = rest.split_once("= [").unwrap();
            let (entries, _) = rest.split_once(']').unwrap();
            entries.split(',').map(str::trim).map(str::to_owned)
        })
        .filter(|name| !name.is_empty())
        .collect()
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
    let names = names();
    assert_eq!(names.len(), promises::ALL.len());
    let tests = sources(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/tests")));
    let missing: Vec<&String> = names
        .iter()
        .zip(promises::ALL)
        .filter(|(_, promise)| !promise.error.starts_with("none"))
        .map(|(name, _)| name)
        .filter(|name| !tests.contains(&format!(".assert_promised(&promises::{name})")))
        .collect();
    assert!(missing.is_empty(), "{missing:?}");
}

/// Every constant of a promise stands in one of the lists, once: none is left out of the page and of what is counted.
#[test]
fn every_promise_stands_in_a_list() {
    let declared = sources(Path::new(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../src/promises"
    )));
    let mut declared: Vec<String> = declared
        .split("pubconst")
        .filter_map(|part| part.split_once(":Promise="))
        .map(|(name, _)| name.to_owned())
        .collect();
    let mut listed = names();
    declared.sort();
    listed.sort();
    assert_eq!(declared, listed);
}

/// A promise without an error has none in any column.
#[test]
fn no_error_is_zero() {
    for promise in promises::ALL {
        let zero = [promise.largest, promise.rms, promise.mean] == [0.0; 3];
        assert_eq!(
            zero,
            promise.error.starts_with("none"),
            "{}",
            promise.function
        );
    }
}
