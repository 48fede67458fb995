//! The exact ball of a design, at the loads from which a curve is fitted.

use epas_friction::ball::folded::log2_biased;
use epas_reference::curvature::Groove;
use epas_reference::friction::held_ball::HeldBall;

use super::design::CagedDesign;
use crate::Failure;
use crate::curve::Sample;

/// Weight of a curve's errors below the least load: a torque that small matters less.
const WEIGHT_BELOW: f64 = 0.25;

/// States that may be left without an exact answer, as a share.
const UNSOLVED: f64 = 0.01;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Exact {
    ball: HeldBall,
    /// Axial load of a ball at which the unloaded side lifts off, N.
    pub lift_off: f64,
}

impl Exact {
    pub fn of(gear: &CagedDesign) -> Result<Self, Failure> {
        let ball = gear.exact_ball(gear.friction);
        let design = &ball.design;
        let deflection =
            design.contact(Groove::Screw)?.deflection + design.contact(Groove::Nut)?.deflection;
        let preload = (-2.0 * ball.clearance / deflection).max(0.0).powf(1.5);
        let per_normal = design.contact_angle.sin() * design.lead_angle().cos();
        Ok(Self {
            lift_off: 8f64.sqrt() * preload * per_normal,
            ball,
        })
    }

    pub fn ball(&self, friction: f32) -> HeldBall {
        HeldBall {
            friction: friction.into(),
            ..self.ball
        }
    }

    /// Torque over load and friction coefficient under falling loads, at rising octaves; loads without an answer are left out.
    pub fn samples(
        &self,
        friction: f32,
        side: f64,
        loads: &[f64],
        least: f64,
    ) -> Result<Vec<Sample>, Failure> {
        let signed: Vec<f64> = loads.iter().map(|load| side * load).collect();
        let solved = self.ball(friction).along(&signed)?;
        let unsolved = solved.iter().filter(|found| found.is_err()).count();
        if unsolved as f64 > UNSOLVED * loads.len() as f64 {
            return Err(Failure::Domain(format!(
                "the exact balance of a ball is not found under {unsolved} of {} loads, friction coefficient {friction}{}",
                loads.len(),
                unusual(self.ball.design.contact_angle)
            )));
        }
        let mut samples: Vec<Sample> = solved
            .into_iter()
            .flatten()
            .map(|found| {
                let load = found.axial_load.abs();
                let whole = load + self.lift_off;
                Sample {
                    at: log2_biased(whole as f32).into(),
                    value: found.torque / (whole * f64::from(friction)),
                    weight: if load < least { WEIGHT_BELOW } else { 1.0 },
                }
            })
            .collect();
        samples.reverse();
        samples.dedup_by(|later, earlier| later.at <= earlier.at);
        Ok(samples)
    }
}

/// A word for a contact angle, rad, under which a ball hardly leans on its grooves, or on one side alone.
fn unusual(contact_angle: f64) -> String {
    if (0.25..=1.3).contains(&contact_angle) {
        return String::new();
    }
    format!(
        "; contact_angle = {contact_angle:.4} rad is {:.0} degrees, and 30 to 60 are usual",
        contact_angle.to_degrees()
    )
}
