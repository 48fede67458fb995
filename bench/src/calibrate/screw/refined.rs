//! What the crate's three laws over the load leave out between their friction coefficients.
//!
//! In the loop full friction is a parabola of the coefficient through three of them. Where a ball's third contact just closes the exact
//! friction has a bend there, and the parabola is off by up to 0.4 % of it. A fit would take that for a speed at which films form (3 % of
//! the half-share speed). So the fit's friction is corrected by more laws of the same kind, each exact at its own coefficient.

use epas_friction::law::coefficient::CoefficientLaw;
use epas_friction::scene::SlidingFriction;
use epas_friction::{CagedBallScrewConfiguration, Error};

use super::folded::Folded;
use super::friction::{Course, Screw};
use super::quantities::Values;

/// Laws between the least and the largest coefficient.
const LAWS: usize = 9;

/// Loads between none and the largest.
const LOADS: usize = 96;

/// Full friction over load and coefficient, by many laws over by three.
struct Table {
    /// For each load the ratio at each coefficient: of a load that opposes the motion, then of one that assists it.
    ratios: Vec<[[f64; 2]; LAWS]>,
    least: f64,
    coefficient_step: f64,
    load_step: f64,
}

impl Table {
    fn new(screw: &Screw, values: &Values) -> Result<Option<Self>, Error> {
        let law = CoefficientLaw::new(&screw.coefficient(values))?;
        let (least, largest) = law.extremes();
        if !(largest > least) || !(screw.largest_load > 0.0) {
            return Ok(None);
        }
        let configuration = screw.scene(values)?;
        let three = Folded::new(&configuration)?.between(least, largest);
        let coefficient_step = (largest - least) / (LAWS - 1) as f32;
        let load_step = screw.largest_load / (LOADS - 1) as f64;
        let mut ratios = vec![[[1.0; 2]; LAWS]; LOADS];
        for place in 0..LAWS {
            let friction = least + coefficient_step * place as f32;
            let exact = Folded::new(&CagedBallScrewConfiguration {
                friction,
                ..configuration
            })?;
            for (index, row) in ratios.iter_mut().enumerate() {
                let load = (load_step * index as f64) as f32;
                let exact = sides(exact.limits(load, friction));
                let three = sides(three.limits(load, friction));
                if let Some(ratio) = row.get_mut(place) {
                    *ratio = [0, 1].map(|side: usize| {
                        let ratio = exact[side] / three[side];
                        // Without a load there may be no friction at all.
                        if ratio.is_finite() { ratio } else { 1.0 }
                    });
                }
            }
        }
        Ok(Some(Self {
            ratios,
            least: least.into(),
            coefficient_step: coefficient_step.into(),
            load_step,
        }))
    }

    /// The ratio at a load that opposes the motion (above zero) or assists it, and a coefficient: linear in both.
    fn at(&self, opposing: f64, coefficient: f64) -> f64 {
        let side = usize::from(opposing < 0.0);
        let (load, part) = place(opposing.abs() / self.load_step, LOADS);
        let (low, share) = place((coefficient - self.least) / self.coefficient_step, LAWS);
        let along =
            |row: &[[f64; 2]; LAWS]| row[low][side] + share * (row[low + 1][side] - row[low][side]);
        let (one, other) = (along(&self.ratios[load]), along(&self.ratios[load + 1]));
        one + part * (other - one)
    }
}

/// Friction under a load that opposes the motion, and under one that assists it.
fn sides(limits: SlidingFriction) -> [f64; 2] {
    [limits.forward.into(), limits.backward.into()]
}

/// Place below a number on a grid of so many, and the part beyond it.
fn place(number: f64, count: usize) -> (usize, f64) {
    let number = number.max(0.0).min((count - 1) as f64);
    let place = (number as usize).min(count - 2);
    (place, number - place as f64)
}

/// Factor of the friction at every sample, for values that are about right; `friction` tells which way it acts.
///
/// # Errors
/// [`Error`] naming a value out of range.
pub fn correction(
    screw: &Screw,
    values: &Values,
    course: &Course,
    friction: &[f64],
) -> Result<Vec<f64>, Error> {
    let Some(table) = Table::new(screw, values)? else {
        return Ok(vec![1.0; friction.len()]);
    };
    let law = CoefficientLaw::new(&screw.coefficient(values))?;
    let moments = course.inputs().iter().zip(friction);
    Ok(moments
        .map(|(inputs, friction)| {
            let at = law.at_temperature(inputs.temperature);
            let both = at.both(inputs.scene.nut_speed);
            let load = f64::from(inputs.scene.axial_load);
            if *friction < 0.0 {
                table.at(-load, both.backward.into())
            } else {
                table.at(load, both.forward.into())
            }
        })
        .collect())
}
