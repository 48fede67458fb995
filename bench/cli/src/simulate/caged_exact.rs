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
use epas_page::failure::Failure;

/// Loads of each sign for which a ball is solved, and how far the smallest lies below the largest.
const LOADS: u32 = 160;
const SPAN: f64 = 1e4;

/// Loads without a solution that are named.
const NAMED: usize = 3;

/// Friction torque over the load, between loads for which one ball is solved exactly: within 2e-4 where no contact opens
/// between two of them. Where a load has no solution, friction is NaN or infinite from the load below it to the one above.
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

    pub fn told(&self, samples: &[ScrewSample]) -> Lines {
        let mut lines = Lines::default();
        let named = self.laws.iter().zip(["against the motion", "with it"]);
        let unsolved: Vec<String> = named
            .flat_map(|(law, side)| {
                let open = law.iter().filter(|(_, torque)| torque.is_nan());
                open.map(move |(load, _)| format!("{load:.1} N {side}"))
            })
            .collect();
        if unsolved.is_empty() {
            return lines;
        }
        let open = |sample: &&ScrewSample| self.friction(sample).friction_torque.is_nan();
        let first = samples.iter().find(open);
        let more = if unsolved.len() > NAMED { ", ..." } else { "" };
        lines.add(
            "reference",
            format!(
                "{} of {} loads without a solution ({}{more}); {} samples beside them are left open{}",
                unsolved.len(),
                self.laws.iter().map(Vec::len).sum::<usize>(),
                unsolved.iter().take(NAMED).cloned().collect::<Vec<_>>().join(", "),
                samples.iter().filter(open).count(),
                first.map_or_else(String::new, |first| format!(", the first at {} s", first.time)),
            ),
        );
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A load without a solution costs the samples beside it, and no other; it is named.
    #[test]
    fn an_unsolved_load_costs_its_samples() {
        let loads = [10.0, 20.0, 40.0, 80.0];
        let law = |unsolved: f64| {
            let torque = |load: f64| {
                if load == unsolved {
                    f64::NAN
                } else {
                    1e-3 * load
                }
            };
            loads.map(|load| (load, torque(load))).to_vec()
        };
        let exact = ExactCaged {
            laws: [law(20.0), law(f64::INFINITY)],
            preloaded: false,
            reduced_lead: 1e-3,
            reversal_speed: 0.0,
            limits: Limits {
                nut_speed: 100.0,
                axial_load: 1e3,
                friction_torque: 1.0,
            },
        };
        // 15 and 30 N stand beside 20 N, where the load is against the motion.
        let samples: Vec<ScrewSample> = [5.0, 15.0, 30.0, 60.0, -15.0]
            .into_iter()
            .enumerate()
            .map(|(place, axial_load)| ScrewSample::new(0.5 * place as f64, 10.0, axial_load))
            .collect();
        let torques: Vec<f64> = samples
            .iter()
            .map(|sample| exact.friction(sample).friction_torque)
            .collect();
        assert_eq!(
            torques
                .iter()
                .map(|torque| torque.is_nan())
                .collect::<Vec<_>>(),
            [false, true, true, false, false]
        );
        // Linear between the loads: the torque of 60 N is that of 60 N within roundings.
        assert!((torques[3] - 0.06).abs() < 1e-15, "{torques:?}");
        let told = format!("{:?}", exact.told(&samples));
        assert!(
            told.contains("1 of 8 loads without a solution (20.0 N against the motion); 2 samples beside them are left open, the first at 0.5 s"),
            "{told}"
        );
    }
}
