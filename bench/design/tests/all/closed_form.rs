//! How far the papers' closed forms are from the exact ball.

use epas_design::files::{self, Design};
use epas_friction::{BallScrew, FrictionBranch, FrictionModel, Inputs};
use rayon::prelude::*;

/// Loads of a ball, N, of either sign.
const LOADS: [f64; 4] = [300.0, 75.0, 20.0, 5.0];

/// Least and largest torque of a closed form over the exact one of the same screw and state.
fn ratios(design: &Design, branch: FrictionBranch) -> (f64, f64) {
    let caged = &design.caged;
    let balls = f32::from(caged.loaded_balls);
    let mut form = design.in_closed_form(branch);
    form.reversal_speed = 1e-6;
    let mut model = FrictionModel::<epas_friction::ClosedFormScrew>::new(&form).unwrap();
    let (mut least, mut largest) = (f64::INFINITY, 0.0_f64);
    for side in [1.0, -1.0] {
        let loads = LOADS.map(|load| side * load);
        let solved = caged.exact_ball(caged.friction).along(&loads).unwrap();
        for exact in solved.into_iter().flatten() {
            let inputs = Inputs {
                nut_speed: 1.0,
                axial_load: balls * exact.axial_load as f32,
            };
            let torque = f64::from(model.step(inputs).friction_torque) / f64::from(balls);
            let ratio = torque / exact.torque;
            least = least.min(ratio);
            largest = largest.max(ratio);
        }
    }
    (least, largest)
}

/// Over all built-in designs, with the papers' numbers and with the defaults, 5 to 300 N a ball of both signs: as the scene, README and `simulate` say.
#[test]
fn closed_forms_are_a_first_look() {
    let designs: Vec<Design> = files::built_in()
        .flat_map(|(name, parameters, balls)| {
            let own: files::DesignSource = name.parse().unwrap();
            let screw = BallScrew::new(parameters).unwrap();
            [own.load().unwrap(), Design::usual(screw, balls)]
        })
        .collect();
    for (branch, said) in [
        (FrictionBranch::Rolling, (0.024, 1.11)),
        (FrictionBranch::Sliding, (0.586, 13.77)),
    ] {
        let (least, largest) = designs
            .par_iter()
            .map(|design| ratios(design, branch))
            .reduce(
                || (f64::INFINITY, 0.0),
                |one, other| (one.0.min(other.0), one.1.max(other.1)),
            );
        println!("{branch:?}: {least:.3} to {largest:.3}");
        assert!((least / said.0 - 1.0).abs() < 0.1, "{branch:?}: {least}");
        assert!(
            (largest / said.1 - 1.0).abs() < 0.1,
            "{branch:?}: {largest}"
        );
    }
}
