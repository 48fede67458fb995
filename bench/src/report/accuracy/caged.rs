//! Caged screws: errors over the certificates of twenty folds.

use epas_design::gears::{TESTED_CLEARANCES, TESTED_FRICTIONS, tested};
use epas_design::{CagedFold, Figure};
use epas_friction::BallScrewParameters;
use rayon::prelude::*;

use super::Accuracy;
use epas_design::files::built_in;
use epas_page::failure::Failure;

const PITCH_RADIUS: f32 = 35e-3;

fn designs() -> impl Iterator<Item = BallScrewParameters> {
    let all = built_in().map(|(_, parameters, _)| parameters);
    all.filter(|parameters| parameters.pitch_radius < PITCH_RADIUS)
        .step_by(2)
}

fn fold(parameters: BallScrewParameters, place: usize) -> Result<CagedFold, Failure> {
    let clearance = TESTED_CLEARANCES[place % TESTED_CLEARANCES.len()];
    let friction = TESTED_FRICTIONS[place % TESTED_FRICTIONS.len()];
    Ok(tested(parameters, clearance, friction)?)
}

pub fn step(quick: bool) -> Result<Accuracy, Failure> {
    let (skip, stride) = if quick { (2, 5) } else { (0, 1) };
    let designs: Vec<_> = designs().enumerate().skip(skip).step_by(stride).collect();
    let figures = designs
        .into_par_iter()
        .map(|(place, parameters)| {
            let [torque] = fold(parameters, place)?.folded()?.certificate.figures;
            Ok(torque)
        })
        .collect::<Result<Vec<Figure>, Failure>>()?;
    let states: usize = figures.iter().map(|figure| figure.states).sum();
    let mean = |of: fn(&Figure) -> f64| {
        let sum: f64 = figures.iter().map(|one| of(one) * one.states as f64).sum();
        sum / states as f64
    };
    Ok(Accuracy {
        name: "caged_step".into(),
        error: format!(
            "friction torque, relative: {} designs to 63 mm, clearance -5 to 20 um, friction 0.05 to 0.15, 5 to 300 N a ball",
            figures.len()
        ),
        largest: figures.iter().fold(0.0, |most, one| one.largest.max(most)),
        rms: mean(|figure| figure.rms.powi(2)).sqrt(),
        flagged: mean(|figure| figure.flagged),
        states: states as u64,
    })
}
