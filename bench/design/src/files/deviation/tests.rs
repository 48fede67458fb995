//! Maps of a design file, and whether a scene takes them.

use super::*;
use crate::files::read;
use crate::uncaged::Folded;
use crate::uncaged_scene::{self, ScrewConfiguration};
use epas_friction::{FrictionModel, UncagedBallScrew};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::f64::consts::PI;

const GEAR: &str = "nominal_diameter = 0.033\nlead = 0.02\nball_diameter = 0.005556\nconformity = 0.5857\ncontact_angle = 0.7853982\n\
                    clearance = 0\nfriction = 0.1\n[uncaged]\nballs = 16\nturns = 0.86\n";

/// Whether a scene takes the maps of these keys with a law that is folded for them.
fn runs(keys: &str) -> Result<(), String> {
    let design = read(&format!("{GEAR}{keys}"), "gear")?;
    let row = design.uncaged.unwrap();
    let fold = uncaged_scene::fold_for(&design, &row, (0.1, 0.1), 0.0)?;
    fold.check().map_err(|failure| failure.to_string())?;
    // Any law: what is asked here is whether its domain is that of the maps.
    let lin = "lin-3.6".parse::<crate::files::DesignSource>().unwrap();
    let lin = lin.load().unwrap();
    let words = uncaged_scene::words(&lin, &lin.uncaged.unwrap());
    let Folded::One(law) = uncaged_scene::read(&words.unwrap()).unwrap() else {
        panic!("one friction coefficient is one node");
    };
    let mut law = *law;
    law.law.deviations = fold.gear.deviations;
    let law = Box::leak(Box::new(law));
    let made = ScrewConfiguration {
        tick: 1e-5,
        ..uncaged_scene::configuration_with(&row, Folded::One(law))
    };
    let made = FrictionModel::<UncagedBallScrew<16>>::new(&made.with(law));
    made.map(drop).map_err(|error| error.to_string())
}

fn wave(order: u32, cosine: f64, sine: f64) -> String {
    format!("{{ order = {order}, cosine = {cosine}, sine = {sine} }}")
}

#[test]
fn every_single_wave_runs() {
    for groove in ["screw", "nut"] {
        for order in 1..=8 {
            for (cosine, sine) in [(0.0123, 0.0), (0.0, 0.0123), (-0.0021, 0.0174)] {
                let wave = wave(order, cosine, sine);
                assert_eq!(
                    runs(&format!("{groove}_deviation = [{wave}]\n")),
                    Ok(()),
                    "{groove} {wave}"
                );
            }
        }
    }
}

/// Random maps of up to eight waves, in both grooves.
#[test]
fn every_random_map_runs() {
    for seed in 0..20 {
        let mut random = Pcg64::seed_from_u64(seed);
        let mut map = || {
            let count = random.random_range(1..=8);
            let waves: Vec<_> = (0..count)
                .map(|_| {
                    let order = random.random_range(0..=8);
                    let mut part = || random.random_range(-0.008..0.008);
                    wave(order, part(), part())
                })
                .collect();
            waves.join(", ")
        };
        let keys = format!(
            "screw_deviation = [{}]\nnut_deviation = [{}]\n",
            map(),
            map()
        );
        assert_eq!(runs(&keys), Ok(()), "seed {seed}: {keys}");
    }
}

fn lines(points: impl Iterator<Item = (f64, f64)>) -> String {
    let rows: Vec<_> = points.map(|(x, y)| format!("{x},{y}\n")).collect();
    rows.concat()
}

fn deviation(angle: f64) -> f64 {
    0.02 * (2.0 * angle).sin() - 0.006 * (3.0 * angle).cos()
}

/// By how much straight lines between 64 samples miss a crest: `(pi n/64)^2/2` of the amplitude of each wave.
fn straight() -> f64 {
    let wave = |order: f64, amplitude: f64| amplitude * (order * PI / 64.0).powi(2) / 2.0;
    wave(2.0, 0.02) + wave(3.0, 0.006)
}

/// What a map gives less what was measured, rad: largest and root mean square.
fn apart(samples: [f32; SAMPLES], truth: impl Fn(f64) -> f64) -> (f64, f64) {
    let map = DeviationMap::from_samples(1, &samples).unwrap();
    let errors: Vec<_> = (0..4096_u32)
        .map(|step| f64::from(map.at(step << 20)) - truth(f64::from(step) / 4096.0 * TAU))
        .collect();
    let squares: f64 = errors.iter().map(|error| error * error).sum();
    (
        errors.iter().fold(0.0, |most, error| error.abs().max(most)),
        (squares / 4096.0).sqrt(),
    )
}

/// A chart in degrees and one in radians, with any number of samples, from any angle on, are the same map.
#[test]
fn a_chart_is_its_deviation() {
    let bound = straight();
    for count in [360, 361, 200, 1000] {
        for begin in [0.0, -0.7, 2.0] {
            let angles = (0..count).map(|step| begin + TAU * f64::from(step) / f64::from(count));
            let degrees = angles
                .clone()
                .map(|angle| (angle.to_degrees(), deviation(angle).to_degrees()));
            let in_degrees = format!("angle_deg,deviation_deg\n{}", lines(degrees));
            let closed = angles
                .chain([begin + TAU])
                .map(|angle| (angle, deviation(angle)));
            let in_radians = format!("angle,deviation\n{}", lines(closed));
            for chart in [in_degrees, in_radians] {
                let samples = sampled(chart_points(&chart, 1).unwrap()).unwrap();
                let (largest, rms) = apart(samples, deviation);
                assert!(
                    largest < bound && rms < 0.5 * bound,
                    "{largest} {rms} {bound}"
                );
            }
        }
    }
}

/// Noise of single samples is averaged: 360 of them leave less than the root of 64/360 of it.
#[test]
fn noise_of_a_chart_is_averaged() {
    let mut random = Pcg64::seed_from_u64(7);
    let noise: Vec<f64> = (0..360).map(|_| random.random_range(-1e-3..1e-3)).collect();
    let points = (0..360).map(|step| {
        let angle = f64::from(step) / 360.0;
        (angle, deviation(angle * TAU) + noise[step as usize])
    });
    let (_, rms) = apart(sampled(points.collect()).unwrap(), deviation);
    let own = 1e-3 / 3.0_f64.sqrt();
    assert!(rms < 0.5 * own, "{rms} of {own}");
}

/// Sixty-four samples at equal distances are the map's own.
#[test]
fn samples_of_a_map_are_kept() {
    let mut random = Pcg64::seed_from_u64(3);
    let given: Vec<f32> = (0..64).map(|_| random.random_range(-0.03..0.03)).collect();
    let own: [f32; SAMPLES] = given.clone().try_into().unwrap();
    assert_eq!(
        Given::Samples(given).map("nut_deviation", 1).unwrap(),
        &DeviationMap::from_samples(1, &own).unwrap()
    );
}

#[test]
fn a_chart_beside_a_design_file_runs() {
    let folder = std::env::temp_dir().join(format!("epas-chart-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let angles = (0..360).map(|step| (f64::from(step), deviation(f64::from(step).to_radians())));
    let chart = format!("angle_deg;deviation\n{}", lines(angles).replace(',', ";"));
    std::fs::write(folder.join("screw.csv"), chart.replace('.', ",")).unwrap();
    let file = folder.join("gear.toml");
    std::fs::write(
        &file,
        format!(
            "{GEAR}screw_deviation = \"screw.csv\" # a chart\nnut_deviation = \"missing.csv\"\n"
        ),
    )
    .unwrap();
    let source = crate::files::DesignSource::File(file.clone());
    let refused = source.load().unwrap_err().to_string();
    assert!(refused.contains("missing.csv"), "{refused}");
    std::fs::write(
        &file,
        format!("{GEAR}screw_deviation = \"screw.csv\" # a chart\n"),
    )
    .unwrap();
    let text = source.text().unwrap().unwrap();
    std::fs::remove_dir_all(&folder).unwrap();
    // The text stands for itself, and says the rest as the file does.
    assert!(
        text.starts_with(GEAR) && text.ends_with("] # a chart\n"),
        "{text}"
    );
    let design = read(&text, "gear").unwrap();
    let [screw, nut] = design.uncaged.unwrap().deviations();
    let crest = (0..4096).map(|step| deviation(TAU * f64::from(step) / 4096.0).abs());
    let crest = crest.fold(0.0, f64::max);
    assert!(
        (f64::from(screw) - crest).abs() < straight() && nut < 1e-8,
        "{screw} {nut} {crest}"
    );
    assert_eq!(runs(text.strip_prefix(GEAR).unwrap()), Ok(()));
}

#[test]
fn what_is_wrong_with_a_chart_is_said() {
    let degrees = lines((0..360).map(|step| (f64::from(step), 0.01)));
    for (chart, said) in [
        (format!("angle,deviation\n{degrees}"), "are they degrees"),
        (
            format!("angle_deg,height\n{degrees}"),
            "no column deviation",
        ),
        (
            format!("angle_deg,angle,deviation\n{degrees}"),
            "more than one",
        ),
        ("angle,deviation\n0,x\n".into(), "row 1: \"x\""),
        ("angle,deviation\n0,inf\n".into(), "not finite"),
        ("angle,deviation\n0,0.1\n".into(), "fewer than two"),
        (
            format!(
                "angle_deg,deviation\n{}",
                lines((0..300).map(|step| (f64::from(step), 0.0)))
            ),
            "no sample between 0.8306 and 1.0000",
        ),
    ] {
        let found = chart_points(&chart, 1).and_then(sampled);
        let message = found.unwrap_err();
        assert!(message.contains(said), "{message}");
    }
    let alone = read(&format!("{GEAR}screw_deviation = \"screw.csv\"\n"), "gear").unwrap_err();
    assert!(alone.contains("beside a design file"), "{alone}");
    let mixed = read(
        &format!("{GEAR}nut_deviation = [0.1, {{ order = 2 }}]\n"),
        "gear",
    )
    .unwrap_err();
    assert!(mixed.contains("one of waves"), "{mixed}");
    let large = read(
        &format!("{GEAR}nut_deviation = [{}]\n", ["0.3"; 64].join(", ")),
        "gear",
    )
    .unwrap_err();
    assert!(large.contains("deviation = 0.3"), "{large}");
}
