//! What a caged screw promises: certificates of blocks that `epas-design` folds, each of 2,048 states that were not fitted; and laws that
//! hold for all of them.

use epas_testkit::gears::screw_inputs;
use std::sync::LazyLock;

use epas_design::{CagedDesign, CagedFold, Failure, Figure, Folded};
use epas_friction::geometry::{FINE_LEAD_SIZES, STEERING_SIZES};
use epas_friction::scene::{CagedBallScrew, CagedBallScrewConfiguration};
use epas_friction::{
    BallScrew, BallScrewParameters, CATALOGUE, Clearance, DISSERTATION_DESIGNS, FrictionModel,
    Limits, Outputs, Regime, defaults,
};
use epas_reference::promises;
use epas_testkit::errors::Errors;
use epas_testkit::folded;

/// Friction coefficients and clearances, m, that the designs take in turn.
const FRICTIONS: [f32; 3] = [0.05, 0.1, 0.15];
const CLEARANCES: [f32; 7] = [-5e-6, -1e-6, 0.0, 2e-6, 5e-6, 10e-6, 20e-6];

fn designs(step: usize) -> impl Iterator<Item = (&'static str, BallScrewParameters)> {
    let sizes = CATALOGUE
        .iter()
        .chain(&FINE_LEAD_SIZES)
        .chain(&STEERING_SIZES)
        .map(|size| (size.name, size.parameters()));
    let designs = DISSERTATION_DESIGNS
        .iter()
        .map(|design| (design.name, design.parameters));
    sizes
        .chain(designs)
        .filter(|(_, parameters)| parameters.pitch_radius < 35e-3)
        .step_by(step)
}

fn fold(parameters: BallScrewParameters, clearance: f32, friction: f32) -> CagedFold {
    let design = BallScrew::new(parameters).unwrap();
    CagedFold::of(CagedDesign {
        design,
        friction,
        rolling_resistance: defaults::ROLLING_RESISTANCE,
        clearance: Clearance::new(clearance).unwrap().checked(&design).unwrap(),
        loaded_balls: 37,
        reversal_speed: 0.5,
        limits: Limits {
            nut_speed: 1e3,
            axial_load: 1e5,
            friction_torque: 100.0,
        },
    })
}

/// Errors of a block's certificate: every state has an exact answer, and none is flagged.
fn certified(folded: &Folded, errors: &mut Errors, line: &str) {
    let [torque] = &folded.certificate.figures;
    let Figure {
        largest,
        rms,
        mean,
        states,
        flagged,
        unsolved,
        worst_load,
        worst_friction,
        ..
    } = *torque;
    assert_eq!((flagged, unsolved), (0.0, 0), "{line}");
    errors.add_figures([largest, rms, mean], states as f64, || {
        format!("{line}, {worst_load} N, {worst_friction}")
    });
}

fn folded_steps(taken: impl Fn(usize) -> bool) {
    let mut errors = Errors::of("folded step");
    for (place, (name, parameters)) in designs(2).enumerate().filter(|(place, _)| taken(*place)) {
        let clearance = CLEARANCES[place % CLEARANCES.len()];
        let friction = FRICTIONS[place % FRICTIONS.len()];
        let line = format!("{name}, {clearance} m, {friction}");
        let folded = fold(parameters, clearance, friction).folded().unwrap();
        certified(&folded, &mut errors, &line);
    }
    errors.assert_promised(promises::of("step_caged"));
}

/// Four designs: preload, neither preload nor play, little play and much; the flattest lead and the steepest; a steering gear. All twenty in
/// `folded_step_whole`.
#[test]
fn folded_step() {
    folded_steps(|place| [0, 9, 13, 17].contains(&place));
}

#[test]
#[ignore = "whole sweep: cargo test -p epas-reference --test all -- --ignored _whole"]
fn folded_step_whole() {
    folded_steps(|_| true);
}

/// A block for a range of friction coefficients, in and between its nodes, of some of every sixth design; a range that it cannot hold to 3 %
/// is refused.
fn folded_steps_between_nodes(taken: impl Fn(usize) -> bool) {
    let mut errors = Errors::of("folded step, friction between nodes");
    let (mut blocks, mut refused) = (0, 0);
    for (place, (name, parameters)) in designs(6).enumerate().filter(|(place, _)| taken(*place)) {
        let clearance = CLEARANCES[place % CLEARANCES.len()];
        let line = format!("{name}, {clearance} m");
        let range = CagedFold {
            friction: Some([0.05, 0.15]),
            ..fold(parameters, clearance, 0.1)
        };
        match range.folded() {
            Ok(folded) => certified(&folded, &mut errors, &line),
            Err(Failure::Domain(reason)) => {
                refused += 1;
                println!("{line}: {reason}");
            }
            Err(failure) => panic!("{line}: {failure}"),
        }
        blocks += 1;
    }
    assert!(2 * refused <= blocks, "{refused} of {blocks} refused");
    errors.assert_promised(promises::of("step_caged_range"));
}

/// One design; all seven in `folded_step_between_nodes_whole`.
#[test]
fn folded_step_between_nodes() {
    folded_steps_between_nodes(|place| place == 1);
}

#[test]
#[ignore = "whole sweep: cargo test -p epas-reference --test all -- --ignored _whole"]
fn folded_step_between_nodes_whole() {
    folded_steps_between_nodes(|_| true);
}

fn screws() -> impl Iterator<Item = CagedFold> {
    let sizes = [10_usize, 15, 22, 30].map(|size| CATALOGUE[size].parameters());
    let steering = [DISSERTATION_DESIGNS[2].parameters];
    sizes
        .into_iter()
        .chain(steering)
        .zip(
            [-5e-6, 0.0, 5e-6, -1e-6, 1e-6]
                .into_iter()
                .zip([0.05, 0.15, 0.1, 0.15, 0.1]),
        )
        .map(|(parameters, (clearance, friction))| fold(parameters, clearance, friction))
}

static SCREWS: LazyLock<Vec<CagedBallScrewConfiguration>> =
    LazyLock::new(|| screws().map(|fold| one(&fold)).collect());

fn bearing() -> CagedFold {
    let flat = BallScrewParameters {
        lead: 0.0,
        ..CATALOGUE[15].parameters()
    };
    fold(flat, 0.0, 0.1)
}

/// Leads, m, and clearances, m, of one diameter.
const LEADS: [f32; 5] = [4e-3, 6e-3, 10e-3, 20e-3, 40e-3];
const GAPS: [f32; 2] = [-1e-6, 0.0];

fn of_lead(gap: f32, lead: f32) -> CagedFold {
    let parameters = BallScrewParameters {
        lead,
        ..DISSERTATION_DESIGNS[1].parameters
    };
    fold(parameters, gap, 0.1)
}

pub fn folds() -> Vec<CagedFold> {
    let leads = GAPS.map(|gap| LEADS.map(|lead| of_lead(gap, lead)));
    screws()
        .chain([bearing()])
        .chain(leads.into_iter().flatten())
        .collect()
}

fn one(fold: &CagedFold) -> CagedBallScrewConfiguration {
    CagedBallScrewConfiguration {
        reversal_speed: 1e-6,
        ..folded::caged(fold)
    }
}

fn step(model: &mut FrictionModel<CagedBallScrew>, nut_speed: f32, load_per_ball: f32) -> Outputs {
    model.step(screw_inputs(nut_speed, 37.0 * load_per_ball))
}

/// What the motor gives is what the load takes and what friction takes; a load that friction holds does not turn the nut.
#[test]
fn power_balances() {
    for screw in SCREWS.iter() {
        let mut model = FrictionModel::new(screw).unwrap();
        for load in [-300.0_f32, -3.0, 3.0, 300.0] {
            let outputs = step(&mut model, 20.0, load);
            let friction = f64::from(outputs.friction_torque);
            let work = f64::from(outputs.load_torque);
            let expected = if load > 0.0 {
                work / (work + friction)
            } else {
                1.0 + friction / work
            };
            // Derived: five roundings of 2^-24 of numbers up to the efficiency's own size or 1.
            let allowed = 3e-7 * expected.abs().max(1.0);
            assert!((f64::from(outputs.efficiency) - expected).abs() < allowed);
            let regime = match (load > 0.0, expected > 0.0) {
                (true, _) => Regime::Driving,
                (false, true) => Regime::BackDriving,
                (false, false) => Regime::Locked,
            };
            assert_eq!(outputs.regime, regime);
        }
    }
}

/// Without a load friction is that of the preload, which a load of a hundredth of a newton hardly changes; without a preload there is none.
#[test]
fn without_a_load_friction_is_that_of_the_preload() {
    for screw in SCREWS.iter() {
        let mut model = FrictionModel::new(screw).unwrap();
        let idle = step(&mut model, 20.0, 0.0).friction_torque;
        if screw.law.lift_off > 0.0 {
            for load in [0.01, -0.01] {
                let little = step(&mut model, 20.0, load).friction_torque;
                assert!((little / idle - 1.0).abs() < 1e-2, "{idle} {little}");
            }
            assert!(idle > 0.0);
        } else {
            assert_eq!(idle, 0.0);
        }
    }
}

#[test]
fn friction_is_continuous() {
    for screw in SCREWS.iter() {
        let mut model = FrictionModel::new(&CagedBallScrewConfiguration {
            reversal_speed: 0.2,
            ..*screw
        })
        .unwrap();
        let full = step(&mut model, 300.0, 100.0).friction_torque;
        let mut last = step(&mut model, 300.0, -100.0).friction_torque;
        for place in -999..=1000_i16 {
            let torque = step(&mut model, 300.0, 0.1 * f32::from(place)).friction_torque;
            // The load's own step is 1e-3 of the whole.
            assert!(
                (torque - last).abs() < 4e-3 * full,
                "{place} {torque} {last} {full}"
            );
            last = torque;
        }
        assert_eq!(step(&mut model, 0.0, 100.0).friction_torque, 0.0);
    }
}

#[test]
fn zero_lead_is_a_bearing() {
    let mut model = FrictionModel::new(&one(&bearing())).unwrap();
    for load in [50.0, -50.0] {
        let outputs = step(&mut model, 10.0, load);
        assert_eq!((outputs.load_torque, outputs.efficiency), (0.0, 0.0));
        assert!(outputs.friction_torque > 0.0 && outputs.friction_torque < 0.1);
        assert_eq!(outputs.regime, Regime::Driving);
    }
}

/// At one diameter the efficiency rises with the lead, driving and driven, as makers print it.
#[test]
fn efficiency_rises_with_the_lead() {
    for gap in GAPS {
        let mut last = [f32::MIN; 3];
        for lead in LEADS {
            let mut model = FrictionModel::new(&one(&of_lead(gap, lead))).unwrap();
            for (load, last) in [50.0, -50.0, 150.0].into_iter().zip(&mut last) {
                let efficiency = step(&mut model, 10.0, load).efficiency;
                assert!(
                    efficiency > *last,
                    "{gap} {load} {lead}: {efficiency} {last}"
                );
                *last = efficiency;
            }
        }
        assert!(last.into_iter().all(|efficiency| efficiency > 0.9));
    }
}
