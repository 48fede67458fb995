//! A caged ball screw in float64 by the exact balance of one of its balls.

use epas_design::CagedDesign;
use epas_design::drawing::drawing;
use epas_friction::Limits;
use epas_reference::friction::ball_screw_efficiency::LoadedScrew;
use epas_reference::friction::rolling_resistance::RollingResistance;
use std::f64::consts::TAU;

use super::reference::{Friction, Moving};
use super::samples::ScrewSample;
use super::summary::Lines;
use super::trace::Trace;
use crate::failure::Failure;

/// Loads of each sign for which a ball is solved, and how far the smallest lies below the largest.
const LOADS: u32 = 160;
const SPAN: f64 = 1e4;

/// Friction torque over the load, between loads for which one ball is solved exactly: within 2e-4 where no contact opens
/// between two of them. Where a load has no solution, friction is no number from the load below it to the one above.
pub struct ExactCaged {
    /// Loads, N, from the smallest, with the friction torque, N m, of one that opposes the motion and of one that assists it; no number
    /// where the solver does not converge.
    laws: [Vec<(f64, f64)>; 2],
    preloaded: bool,
    reduced_lead: f64,
    reversal_speed: f64,
    limits: Limits,
}

impl ExactCaged {
    /// That of a design, for the loads of a trace.
    pub fn new(caged: &CagedDesign, trace: &Trace<ScrewSample>) -> Result<Self, Failure> {
        let largest = trace
            .samples
            .iter()
            .map(|sample| sample.axial_load.abs())
            .fold(1.0, f64::max)
            .min(caged.limits.axial_load.into());
        let resistance = caged.rolling_resistance;
        let law = |side: f64| {
            let screws: Vec<LoadedScrew> = (0..LOADS)
                .map(|number| LoadedScrew {
                    design: drawing(caged.design.parameters()),
                    clearance: caged.clearance.gap().into(),
                    friction: caged.friction.into(),
                    rolling: RollingResistance {
                        hysteresis_loss: resistance.hysteresis_loss.into(),
                        lubricant_drag: resistance.lubricant_drag.into(),
                    },
                    balls: caged.loaded_balls.into(),
                    axial_load: side
                        * largest
                        * SPAN.powf(f64::from(number) / f64::from(LOADS - 1) - 1.0),
                })
                .collect();
            LoadedScrew::solve_all(&screws, &|| ())
                .into_iter()
                .zip(&screws)
                .map(|(friction, screw)| {
                    let torque = friction.map_or(f64::NAN, |friction| friction.torque());
                    (screw.axial_load.abs(), torque)
                })
                .collect::<Vec<_>>()
        };
        let laws = [law(1.0), law(-1.0)];
        if laws.iter().flatten().all(|(_, torque)| torque.is_nan()) {
            return Err(Failure::Data(
                "--reference: no load of this trace has a solution".into(),
            ));
        }
        Ok(Self {
            laws,
            preloaded: caged.clearance.gap() < 0.0,
            reduced_lead: f64::from(caged.design.lead()) / TAU,
            reversal_speed: caged.reversal_speed.into(),
            limits: caged.limits,
        })
    }

    /// Friction of one sample, within the same limits as in the loop.
    pub fn friction(&self, sample: &ScrewSample) -> Friction {
        let within = |value: f64, limit: f32| value.clamp(-f64::from(limit), limit.into());
        let speed = within(sample.nut_speed, self.limits.nut_speed);
        let load = within(sample.axial_load, self.limits.axial_load);
        let opposing = if speed < 0.0 { -load } else { load };
        let full = self.torque(opposing);
        let largest = self.limits.friction_torque;
        let torque = speed / speed.hypot(self.reversal_speed) * full;
        let moving = Moving {
            load_torque: load * self.reduced_lead,
            stands: speed.abs() < self.reversal_speed,
        };
        moving.friction(if torque.is_nan() {
            torque
        } else {
            within(torque, largest)
        })
    }

    /// How many loads have no solution, if any.
    pub fn told(&self) -> Lines {
        let mut lines = Lines::default();
        let solved = self.laws.iter().flatten();
        let failed = solved.clone().filter(|(_, torque)| torque.is_nan()).count();
        if failed > 0 {
            lines.add(
                "reference",
                format!(
                    "{failed} of {} loads without a solution; samples beside them are left open",
                    solved.count()
                ),
            );
        }
        lines
    }

    /// Friction torque away from the reversal, N m.
    fn torque(&self, opposing: f64) -> f64 {
        let [drive, backdrive] = &self.laws;
        let law = if opposing < 0.0 { backdrive } else { drive };
        let load = opposing.abs();
        let above = law.partition_point(|(known, _)| *known < load);
        match (
            above.checked_sub(1).and_then(|below| law.get(below)),
            law.get(above),
        ) {
            (Some((below, low)), Some((above, high))) => {
                low + (high - low) * (load - below) / (above - below)
            }
            // In proportion to a load below the smallest, but for the friction of a preload.
            (None, Some((_, torque))) if self.preloaded => *torque,
            (None, Some((smallest, torque))) => torque * load / smallest,
            (Some((_, torque)), None) => *torque,
            (None, None) => 0.0,
        }
    }
}
