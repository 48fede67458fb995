//! What is timed.

use std::f32::consts::TAU;
use std::hint::black_box;

use epas_design::caged::Block;
use epas_design::efficiency::DynamicCorrection;
use epas_design::{CagedDesign, CagedFold};
use epas_friction::curvature::{
    CircularGrooveCurvature, FittedCurvature, GothicArch, LiteratureCurvature,
};
use epas_friction::efficiency::EfficiencyGeometry;
use epas_friction::geometry::{ContactAngle, Groove};
use epas_friction::hertz::HertzContact;
use epas_friction::scene::CagedBallScrew;
use epas_friction::{
    BallScrew, CATALOGUE, Clearance, FrictionModel, Inputs, Limits, RollingResistance, math,
};
use epas_reference::curvature as reference;

use crate::report::curvature::surface;
use crate::study;

use super::group::{Group, List};
use super::kernels::{libm, micromath, own};
use super::measure::{Measure, Ratio};
use super::race::{Mode, Race};
use super::trains::trains;
use epas_design::caged_scene::block;
use epas_page::failure::Failure;
use epas_page::progress::Progress;

/// One function with its times.
#[derive(Clone, Debug)]
pub struct Competition {
    /// Short name, the same from one report to the next.
    pub key: &'static str,
    /// Time where each call waits for the one before.
    pub latency: Measure,
    /// Time where calls are independent.
    pub throughput: Measure,
    /// Latency and throughput over those of the first of its group.
    pub ratios: (Ratio, Ratio),
}

/// The times of a function by its key.
pub fn times<'a>(competition: &'a [Competition], key: &str) -> Result<&'a Competition, Failure> {
    competition
        .iter()
        .find(|entry| entry.key == key)
        .ok_or_else(|| Failure::Data(format!("nothing was timed as {key}")))
}

/// Times everything.
pub fn compete(rounds: usize) -> Result<Vec<Competition>, Failure> {
    // Through `black_box`, or the constants would be folded into the loops.
    let design = black_box(CATALOGUE[15].design()?);
    let mut race = Race::default();
    let mut list = List::new();
    curvatures(&mut race, &mut list, &design);
    curvatures_in_double(&mut race, &mut list, &design);
    efficiencies(&mut race, &mut list, &design);
    ellipses(&mut race, &mut list, &design);
    caged_step(&mut race, &mut list, design)?;
    trains(&mut race, &mut list)?;
    kernels(&mut race, &mut list);

    let progress = Progress::new("times on this machine", rounds);
    race.run(rounds, &|| progress.step());
    let measure = |place| {
        (
            race.measure(place, Mode::Latency),
            race.measure(place, Mode::Throughput),
        )
    };
    Ok(list
        .into_iter()
        .map(|(key, place, unit)| {
            let ((latency, throughput), unit) = (measure(place), measure(unit));
            let ratios = (latency.over(&unit.0), throughput.over(&unit.1));
            Competition {
                key,
                latency,
                throughput,
                ratios,
            }
        })
        .collect())
}

fn angle(share: f64) -> f64 {
    (70.0 * share).to_radians()
}

fn curvatures(race: &mut Race, list: &mut List, design: &BallScrew) {
    let literature = LiteratureCurvature::of(design, Groove::Screw);
    let circular = CircularGrooveCurvature::of(design, Groove::Screw);
    let fitted = FittedCurvature::of(design, Groove::Screw);
    let exact = GothicArch::of(design, Groove::Screw);

    Group::new(
        race,
        list,
        |share| ContactAngle::new(angle(share) as f32),
        |angle: ContactAngle| angle.cos,
    )
    .time("literature", move |a| literature.first(a))
    .time("circular_groove", move |a| circular.first(a))
    .time("fitted", move |a| fitted.first(a))
    .time("exact", move |a| exact.principal(a));

    Group::new(race, list, |share| angle(share) as f32, |angle: f32| angle)
        .time("literature_angle", move |a| {
            literature.first(ContactAngle::new(a))
        })
        .time("circular_groove_angle", move |a| {
            circular.first(ContactAngle::new(a))
        })
        .time("fitted_angle", move |a| fitted.first(ContactAngle::new(a)))
        .time("exact_angle", move |a| {
            exact.principal(ContactAngle::new(a))
        });
}

/// The same by the reference.
fn curvatures_in_double(race: &mut Race, list: &mut List, design: &BallScrew) {
    let screw = surface(design, Groove::Screw, reference::Groove::Screw);
    let surface = black_box(screw);
    let ball_radius = black_box(f64::from(design.ball_radius()));
    Group::new(race, list, angle, |angle: f64| angle)
        .time("literature_f64", move |a| {
            reference::literature(surface.groove, surface.pitch_radius, ball_radius, a)
        })
        .time("circular_groove_f64", move |a| surface.circular_groove(a))
        .time("weingarten_f64", move |a| surface.principal(a))
        .time("weingarten_printed_f64", move |a| {
            surface.principal_cartesian(a)
        })
        .time("appendix_b_f64", move |a| surface.appendix_b(a));
}

fn efficiencies(race: &mut Race, list: &mut List, design: &BallScrew) {
    let screw = EfficiencyGeometry::of(design);
    let correction = DynamicCorrection::new(&screw, black_box(0.075));
    Group::new(
        race,
        list,
        |share| (0.02 + 0.2 * share) as f32,
        |friction: f32| friction,
    )
    .time("efficiency_rolling", move |f| {
        screw.rolling_efficiency(f, 0.0)
    })
    .time("efficiency_sliding", move |f| screw.sliding_efficiency(f))
    .time("efficiency_sliding_backdrive", move |f| {
        screw.sliding_backdrive_efficiency(f)
    })
    .time("efficiency_dynamic", move |number| {
        correction.efficiency(number)
    });
}

fn ellipses(race: &mut Race, list: &mut List, design: &BallScrew) {
    let exact = GothicArch::of(design, Groove::Screw);
    let contact = HertzContact::of(design, Groove::Screw);
    let modulus = black_box(113.9e9);
    let clearance = design.clearance(Groove::Screw);
    Group::new(
        race,
        list,
        |share| (10.0 + 500.0 * share) as f32,
        |load: f32| load,
    )
    .time("hertz_ellipse", move |load| contact.at(load))
    .time("hertz_setup", move |load| {
        let angle = ContactAngle {
            cos: 0.7 + 1e-4 * load,
            sin: 0.7 - 1e-4 * load,
        };
        HertzContact::new(exact.relative(angle, clearance), modulus)
    });
}

fn caged_step(race: &mut Race, list: &mut List, design: BallScrew) -> Result<(), Failure> {
    let caged = CagedDesign {
        design,
        friction: 0.075,
        rolling_resistance: RollingResistance::STEEL,
        clearance: black_box(Clearance::new(-1e-6)?),
        loaded_balls: 40,
        reversal_speed: 0.5,
        limits: Limits {
            nut_speed: 500.0,
            axial_load: 20e3,
            friction_torque: 10.0,
        },
    };
    let Block::One(folded) = block(&CagedFold::of(caged))? else {
        return Err(Failure::Data("one friction coefficient is one node".into()));
    };
    let folded = black_box(folded);
    let mut model = FrictionModel::<CagedBallScrew>::new(&folded)?;
    let mut remembering = study::remembering::<CagedBallScrew>(&caged, folded, 1000.0)?;
    let mut angle = 0.0;
    Group::new(
        race,
        list,
        |share| Inputs {
            nut_speed: (80.0 * share - 40.0) as f32,
            axial_load: (8e3 * (7.0 * share).fract() - 4e3) as f32,
        },
        |inputs: Inputs| inputs.nut_speed,
    )
    .time("step_caged", move |inputs| model.step(inputs))
    .time("step_caged_memory", move |inputs| {
        angle += 1e-3 * inputs.nut_speed;
        remembering.step(study::fresh(inputs, angle % TAU))
    });
    Ok(())
}

fn kernels(race: &mut Race, list: &mut List) {
    let positive = |share: f64| (1e-3 + 100.0 * share) as f32;
    Group::new(race, list, positive, |x: f32| x)
        .time("sqrt", math::sqrt)
        .time("sqrt_libm", ::libm::sqrtf)
        .time("sqrt_micromath", micromath::sqrt);
    Group::new(race, list, positive, |x: f32| x)
        .time("cbrt", own::cbrt)
        .time("cbrt_libm", libm::cbrt)
        .time("cbrt_micromath", micromath::cbrt);
    Group::new(race, list, positive, |x: f32| x)
        .time("cbrt_and_squared", own::cbrt_and_squared)
        .time("cbrt_and_squared_libm", libm::cbrt_and_squared)
        .time("cbrt_and_squared_micromath", micromath::cbrt_and_squared);
    let turn = |share: f64| (std::f64::consts::TAU * (2.0 * share - 1.0)) as f32;
    Group::new(race, list, turn, |x: f32| x)
        .time("sin_cos", own::sin_cos)
        .time("sin_cos_libm", libm::sin_cos)
        .time("sin_cos_micromath", micromath::sin_cos);
}
