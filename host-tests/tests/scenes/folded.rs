//! What a folded screw promises: certificates of blocks that `epas-design` folds, each of 2,048 states that were not fitted.

use crate::kit::absurd::soak;
use crate::kit::errors::Errors;

use epas_design::{CagedFold, Failure, Figure, Folded};
use epas_friction::geometry::{FINE_LEAD_SIZES, STEERING_SIZES};
use epas_friction::promises;
use epas_friction::scene::FoldedScrew;
use epas_friction::{
    BallScrew, BallScrewParameters, CATALOGUE, CagedBallScrewConfiguration, Clearance,
    DISSERTATION_DESIGNS, FrictionBranch, Limits, defaults,
};

/// Friction coefficients and clearances, m, that the designs take in turn.
const FRICTIONS: [f32; 3] = [0.05, 0.1, 0.15];
const CLEARANCES: [f32; 7] = [-5e-6, -1e-6, 0.0, 2e-6, 5e-6, 10e-6, 20e-6];

/// Every `step`-th design to a diameter of 63 mm, with its name.
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
    CagedFold::of(CagedBallScrewConfiguration {
        design,
        friction,
        rolling_resistance: defaults::ROLLING_RESISTANCE,
        rolling_tangent: 0.0,
        branch: FrictionBranch::Contacts,
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
    println!("{line}: {largest:.1e} {rms:.1e} {mean:+.1e}, {worst_load} N, {worst_friction}");
    errors.add_figures([largest, rms, mean], states as f64, || {
        format!("{line}, {worst_load} N, {worst_friction}")
    });
}

/// A block for one friction coefficient.
#[test]
fn folded_step() {
    let mut errors = Errors::of("folded step");
    for (place, (name, parameters)) in designs(2).enumerate() {
        let clearance = CLEARANCES[place % CLEARANCES.len()];
        let friction = FRICTIONS[place % FRICTIONS.len()];
        let line = format!("{name}, {clearance} m, {friction}");
        let folded = fold(parameters, clearance, friction).folded().unwrap();
        certified(&folded, &mut errors, &line);
    }
    errors.assert_promised(&promises::STEP_FOLDED);
}

/// A block for a range of friction coefficients, in and between its nodes; a range that it cannot hold to 3 % is refused.
#[test]
fn folded_step_between_nodes() {
    let mut errors = Errors::of("folded step, friction between nodes");
    let (mut blocks, mut refused) = (0, 0);
    for (place, (name, parameters)) in designs(6).enumerate() {
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
    errors.assert_promised(&promises::STEP_FOLDED_RANGE);
}

/// Whatever numbers a law is made of, and whatever comes in: finite, within the limits, flagged.
#[test]
fn absurd_laws_and_inputs_give_finite_flagged_bounded_outputs() {
    let ticks = soak::<FoldedScrew<1>>(1, 400, 1000)
        + soak::<FoldedScrew<2>>(1, 400, 1000)
        + soak::<FoldedScrew<5>>(1, 400, 1000);
    println!("{ticks} random ticks");
}
