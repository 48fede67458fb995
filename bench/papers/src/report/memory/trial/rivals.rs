//! Models in use today, fitted to the same trace in the same way.

use std::f64::consts::TAU;

use epas_design::CagedDesign;
use epas_friction::Clearance;

use super::gear::Gear;
use epas_calibrate::bristle::{bristle, stribeck};
use epas_calibrate::fit::problem::{Evaluation, LinearParameter, Model, Parameter, Scale};
use epas_calibrate::fit::search::fit;
use epas_calibrate::screw::exact::{Grid, Spacing};
use epas_calibrate::trace::Trace;
use epas_page::failure::Failure;

/// Nut speed over which friction changes its direction in the model of today, rad/s.
const REVERSAL_SPEED: f64 = 0.2;

/// Force of a contact without a load at which a fit begins, N.
const FIRST_PRELOAD: f32 = 10.0;

/// A model with its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rival {
    /// This crate's caged screw without memory: friction turns with the speed; coefficient and preload are fitted.
    BySpeed,
    /// LuGre times the sum of both flanks' loads, as tyre models have it: stiffness, friction at rest and in motion, Stribeck's speed are
    /// fitted; the preload is given.
    LuGre,
    /// The same times what the crate's contacts say of the load: as good as LuGre can be made.
    LuGreOnContacts,
}

impl Rival {
    /// Name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::BySpeed => "by speed, coefficient and preload fitted",
            Self::LuGre => "LuGre times the load, preload given, 4 parameters fitted",
            Self::LuGreOnContacts => {
                "LuGre times this crate's friction of the load, preload given, 4 parameters fitted"
            }
        }
    }

    fn parameters(self) -> Vec<Parameter> {
        let positive = |name, unit, start, low, high| Parameter {
            name,
            unit,
            start,
            low,
            high,
            scale: Scale::Logarithmic,
        };
        match self {
            Self::BySpeed => vec![
                positive("friction", "", 0.08, 0.01, 0.3),
                positive("preload", "N", 10.0, 0.5, 100.0),
            ],
            Self::LuGre | Self::LuGreOnContacts => vec![
                positive("stiffness", "N m/rad", 80.0, 1.0, 1e4),
                positive("friction_in_motion", "N m", 0.08, 0.005, 1.0),
                positive("friction_at_rest", "N m", 0.12, 0.005, 1.0),
                positive("stribeck_speed", "rad/s", 5.0, 0.05, 500.0),
            ],
        }
    }

    /// What LuGre is multiplied by, at every sample of a trace, over that without a load.
    fn factors(self, gear: &Gear, trace: &Trace) -> Result<Vec<f64>, Failure> {
        let load = trace.load.as_deref().unwrap_or(&[]);
        let screw = &gear.parameters.screw;
        match self {
            Self::BySpeed => Ok(Vec::new()),
            Self::LuGre => {
                let reference = screw.flank_sum(0.0);
                Ok(load
                    .iter()
                    .map(|load| screw.flank_sum(*load) / reference)
                    .collect())
            }
            Self::LuGreOnContacts => {
                // Sliding forward, under every load and under none.
                let loads: Vec<f64> = load.iter().copied().chain([0.0]).collect();
                let speeds = vec![1e3 * REVERSAL_SPEED; loads.len()];
                let preload = screw.contact_force(screw.axial_preload);
                let values = [gear.parameters.boundary, preload];
                let mut torques = by_speed(&gear.design.caged, values, &speeds, &loads)?;
                let without = torques.pop().unwrap_or(1.0);
                Ok(torques.iter().map(|torque| torque / without).collect())
            }
        }
    }

    /// Friction along a trace, N m; NaN where a parameter is out of range.
    fn torque(self, gear: &Gear, values: &[f64], course: &Course<'_>) -> Vec<f64> {
        let Course {
            trace,
            position,
            speed,
            factors,
        } = course;
        match (self, values) {
            (Self::BySpeed, [friction, preload]) => {
                let load = trace.load.as_deref().unwrap_or(&[]);
                let values = [*friction, *preload];
                by_speed(&gear.design.caged, values, speed, load)
                    .unwrap_or_else(|_| vec![f64::NAN; trace.len()])
            }
            (_, [stiffness, in_motion, at_rest, stribeck_speed]) => {
                let mut held = 0.0;
                let mut last = position.first().copied().unwrap_or(0.0);
                let moments = position.iter().zip(*speed).zip(factors);
                moments
                    .map(|((angle, speed), factor)| {
                        let pull = stiffness * (angle - last);
                        last = *angle;
                        let level = stribeck(*speed, [*at_rest, *in_motion], *stribeck_speed);
                        held = bristle(held, pull, level);
                        factor * held
                    })
                    .collect()
            }
            _ => vec![f64::NAN; trace.len()],
        }
    }

    /// The model, fitted, over the trace that was not: friction at every tick, N m.
    pub fn tried(self, gear: &Gear) -> Result<Vec<f64>, Failure> {
        let fit = fit(&problem(self, gear)?)?;
        let (trace, speed) = &gear.in_loop;
        let course = Course {
            trace,
            position: &trace.position,
            speed,
            factors: self.factors(gear, trace)?,
        };
        Ok(self.torque(gear, &fit.nonlinear, &course))
    }
}

/// What a model is told along a trace.
struct Course<'a> {
    trace: &'a Trace,
    position: &'a [f64],
    speed: &'a [f64],
    /// See [`Rival::factors`].
    factors: Vec<f64>,
}

/// Friction of the screw without memory, N m.
fn by_speed(
    caged: &CagedDesign,
    [friction, preload]: [f64; 2],
    speeds: &[f64],
    load: &[f64],
) -> Result<Vec<f64>, Failure> {
    let with = |preload: f32| {
        Ok::<_, Failure>(CagedDesign {
            clearance: Clearance::of_preload(&caged.design, preload)?,
            ..*caged
        })
    };
    let largest = load
        .iter()
        .fold(0.0, |most: f64, load| most.max(load.abs()));
    let grid = Grid::of(&with(FIRST_PRELOAD)?, largest, Spacing::FINE)?;
    let friction = friction as f32;
    let law = grid.law(&with(preload as f32)?, (friction, friction))?;
    let moments = speeds.iter().zip(load);
    Ok(moments
        .map(|(speed, load)| {
            let full = law.sliding(*load, 1_f64.copysign(*speed), friction.into());
            speed / speed.hypot(REVERSAL_SPEED) * full
        })
        .collect())
}

/// A rival on the measured trace, with the same linear parameters as the crate's calibration.
fn problem(rival: Rival, gear: &Gear) -> Result<Model<'_>, Failure> {
    let Gear {
        trace,
        record,
        speed,
        rows,
        ..
    } = gear;
    let target = rows.sums(0, &trace.effort);
    let reduced_lead = f64::from(gear.design.caged.design.lead()) / TAU;
    let load: Vec<f64> = trace
        .load
        .iter()
        .flatten()
        .map(|load| reduced_lead * load)
        .collect();
    let wave = |of: fn(f64) -> f64, order: f64| {
        let angles = record.motion.iter();
        let wave: Vec<f64> = angles.map(|angle| of(order * angle)).collect();
        rows.sums(0, &wave)
    };
    let columns = vec![
        ("inertia", rows.sums(2, &record.motion)),
        ("drag", rows.sums(1, &record.motion)),
        ("offset", vec![1.0; target.len()]),
        ("gain", rows.sums(0, &load)),
        ("harmonic_1_cosine", wave(f64::cos, 1.0)),
        ("harmonic_1_sine", wave(f64::sin, 1.0)),
        ("harmonic_2_cosine", wave(f64::cos, 2.0)),
        ("harmonic_2_sine", wave(f64::sin, 2.0)),
    ];
    let course = Course {
        trace,
        position: &record.motion,
        speed,
        factors: rival.factors(gear, trace)?,
    };
    let (linear, columns): (Vec<_>, Vec<_>) = columns
        .into_iter()
        .map(|(name, column)| {
            let parameter = LinearParameter {
                name,
                unit: "",
                // Friction must not hide behind a drag that drives.
                low: if matches!(name, "inertia" | "drag") {
                    0.0
                } else {
                    f64::NEG_INFINITY
                },
                high: f64::INFINITY,
            };
            (parameter, column)
        })
        .unzip();
    Ok(Model {
        nonlinear: rival.parameters(),
        linear,
        target,
        evaluate: Box::new(move |values| {
            let torque = rival.torque(gear, values, &course);
            Evaluation {
                fixed: rows.sums(0, &torque),
                columns: columns.clone(),
            }
        }),
    })
}
