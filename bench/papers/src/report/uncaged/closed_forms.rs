//! Torque of one ball over lead, load and friction: the papers' closed forms, a folded block and the exact model.

use std::f64::consts::FRAC_PI_4;

use epas_friction::LoadShare;
use epas_friction::ball::{GrooveFit, ScrewRow};
use epas_friction::efficiency::{Drive, EfficiencyGeometry};
use epas_friction::{BallScrew, BallScrewParameters};
use rayon::prelude::*;

use epas_bench::report::draw::{chart, figure};
use epas_bench::study;
use epas_eval::caged_torque::{Request, Torques};
use epas_eval::{Model, ScrewNumbers};
use epas_page::document::Block;
use epas_page::failure::Failure;
use epas_page::plot::{Axis, Mark, Series};

/// Load, N, friction and lead, m, of the ball of Table 3.6.
const LOAD: f64 = 50.0;
const FRICTION: f64 = 0.1;
const LEAD: f64 = 20e-3;

const MODELS: [(&str, Mark); 5] = [
    ("exact", Mark::Line),
    ("folded", Mark::Circles),
    ("three-point closed form, no play", Mark::Dashed),
    ("two-point closed form, play", Mark::Dashed),
    ("rolling ball, eq. (3)", Mark::Dashed),
];

fn design(lead: f64) -> Result<BallScrew, Failure> {
    Ok(BallScrew::new(BallScrewParameters {
        lead: lead as f32,
        ..*study::ball_screw()?.parameters()
    })?)
}

/// Torque of a ball on the nut over its axial load, mm, by every model; no number where one has none.
fn torques(lead: f64, load: f64, friction: f64) -> Result<[f64; 5], Failure> {
    let design = design(lead)?;
    let request = Request {
        screw: ScrewNumbers {
            lead,
            ..ScrewNumbers::LIN_2_1
        },
        contact_angle: FRAC_PI_4,
        friction,
        clearance: 0.0,
        axial_load: vec![load],
        direction: 1.0,
    };
    let both = request.evaluate()?;
    let of = |torques: &Torques| {
        let torque = torques.torque.as_ref().and_then(|torques| torques[0]);
        torque.map_or(f64::NAN, |torque| torque / load)
    };
    let closed = |fit: GrooveFit| -> Result<f64, Failure> {
        let row = ScrewRow::new(&design, friction as f32, fit)?;
        let ball = row.at(1.0, load as f32).ball(0.0, 0.0, &LoadShare::MEAN);
        Ok(f64::from(ball.groove_torque) / load)
    };
    let rolling = EfficiencyGeometry::of(&design).rolling_torque_per_load(
        Drive::Driving,
        design.pitch_radius(),
        friction as f32,
        0.0,
    );
    Ok([
        of(&both.reference),
        of(&both.in_loop),
        closed(GrooveFit::Zero)?,
        closed(GrooveFit::Play)?,
        rolling.into(),
    ]
    .map(|torque| 1e3 * torque))
}

/// Quantities of a panel: heading, first and last value, and the arguments of [`torques`] at a value.
type Sweep = (&'static str, f64, f64, fn(f64) -> [f64; 3]);

const SWEEPS: [Sweep; 3] = [
    ("lead (mm)", 2.0, 50.0, |lead| [1e-3 * lead, LOAD, FRICTION]),
    ("axial load of a ball (N)", 5.0, 300.0, |load| {
        [LEAD, load, FRICTION]
    }),
    ("friction coefficient", 0.02, 0.15, |friction| {
        [LEAD, LOAD, friction]
    }),
];

pub fn picture(quick: bool) -> Result<Block, Failure> {
    let parts = if quick { 6 } else { 24 };
    let mut panels = Vec::new();
    for (label, first, last, arguments) in SWEEPS {
        let points = (0..=parts)
            .into_par_iter()
            .map(|part| {
                let value = first + (last - first) * f64::from(part) / f64::from(parts);
                let [lead, load, friction] = arguments(value);
                Ok((value, torques(lead, load, friction)?))
            })
            .collect::<Result<Vec<_>, Failure>>()?;
        let series = MODELS
            .into_iter()
            .enumerate()
            .map(|(model, (name, mark))| {
                let points = points
                    .iter()
                    .map(|(value, torques)| (*value, torques[model]))
                    .collect();
                Series::new(name, model, mark, points)
            })
            .collect();
        let x = Axis::linear(label).between(first.min(0.0), last);
        let y = Axis::linear("torque over axial load (mm)");
        panels.push(chart("", x, y, series));
    }
    let caption = format!(
        "Friction torque of one ball of Table 3.6's screw over its axial load, without deviations: over the lead ({LOAD} N, friction \
         {FRICTION}), over the load (lead {} mm) and over the friction coefficient. The rolling ball leaves spin out; the three-point closed form \
         takes the third contact's load from friction alone and spins as geometry has it; the two-point one has no third contact.",
        1e3 * LEAD
    );
    Ok(figure(
        "closed_forms_of_a_ball",
        caption,
        (1, 1080, 400),
        panels,
    ))
}
