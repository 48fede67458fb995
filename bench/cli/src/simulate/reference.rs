//! The same scene in float64: what stands beside the in-loop model, by scene.
//!
//! | scene | `--reference` | which model of the reference |
//! |---|---|---|
//! | caged, and `--reference=exact` | [`super::caged_exact`] | `LoadedScrew`: one ball in elastic balance, exact, solved at 160 loads of each sign; also of a design that follows a paper's closed form |
//! | caged, `--reference=closed-form` | [`CagedReference`] | `Screw`: a paper's closed form in float64; of a design that follows it, it proves the arithmetic, not the form |
//! | uncaged, and `--reference=exact` | [`super::exact_screw`] | `ElasticRing`: every ball in elastic balance by contact integrals, and the forces between them |
//! | uncaged, `--reference=closed-form` | [`whole_screw`] | `WholeScrew` with the `ThreePointModel` of each ball: not exact, for comparison with the dissertation |
//! | linear | refused | `eval` compares rows of balls |

use std::f64::consts::{SQRT_2, TAU};

use epas_design::drawing::drawing;
use epas_friction::{Clearance, ClosedFormScrewConfiguration, FrictionBranch, Limits};
use epas_reference::curvature::Groove;
use epas_reference::efficiency::Screw;
use epas_reference::friction::ball_screw_closed::ThreePointModel;
use epas_reference::friction::ball_screw_elastic::BallSlip;
use epas_reference::friction::contact_law::HertzLaw;
use epas_reference::friction::whole_screw::WholeScrew;

use super::samples::ScrewSample;
use super::trace::Trace;
use epas_design::files::train::UncagedDesign;
use epas_page::failure::Failure;

/// What runs beside an uncaged ball screw.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum ReferenceModel {
    /// Every ball in elastic grooves with exact contact integrals; at 10,000 states of the trace at most, within two minutes
    Exact,
    /// Closed form of each ball (Lin 2019), which is not exact, at every sample: one speed, one load, one sine on the
    /// screw, no play, preload or return
    ClosedForm,
}

/// The whole screw of Lin 2019, Section 3.4.4, which knows one speed, one load and one sine.
pub fn whole_screw(
    design: &UncagedDesign,
    trace: &Trace<ScrewSample>,
) -> Result<Vec<Friction>, Failure> {
    let limited = |what: &str| {
        Failure::Data(format!(
            "--reference=closed-form follows an uncaged ball screw at one speed and load, with one sine on the screw, no \
             play, preload or return: {what}"
        ))
    };
    let wave = design
        .wave
        .ok_or_else(|| limited("this deviation or these load shares are others"))?;
    if design.gear.clearance != Clearance::ZERO || design.return_length > 0.0 {
        return Err(limited("this circuit is another"));
    }
    let [first, .., last] = trace.samples.as_slice() else {
        return Err(limited("this trace is too short"));
    };
    let same = |sample: &ScrewSample| {
        sample.nut_speed == first.nut_speed && sample.axial_load == first.axial_load
    };
    if !trace.samples.iter().all(same) || first.nut_speed == 0.0 {
        return Err(limited("this trace is another"));
    }

    let refused =
        |error: &dyn std::fmt::Display| Failure::Data(format!("--reference=closed-form: {error}"));
    let parameters = design.gear.design.parameters();
    let drawing = drawing(parameters);
    let law = |groove| -> Result<HertzLaw, Failure> {
        let contact = drawing.contact(groove).map_err(|error| refused(&error))?;
        Ok(contact.into())
    };
    let screw = WholeScrew {
        model: ThreePointModel {
            track: (&drawing).into(),
            screw: law(Groove::Screw)?,
            nut: law(Groove::Nut)?,
            friction: design.gear.friction.into(),
            contact_angle: drawing.contact_angle,
        },
        balls: design.balls.into(),
        turns: design.turns.into(),
        axial_load: first.axial_load,
        nut_speed: first.nut_speed,
        deviation: wave.amplitude.into(),
        cycles: wave.order.into(),
        ball_friction: design.ball_friction.into(),
        ball_slip: BallSlip::Orbiting,
    };
    let angle = ((last.time - first.time) * first.nut_speed).abs();
    let states = screw
        .simulate(angle, trace.samples.len() - 1, 1)
        .map_err(|error| refused(&error))?;
    let load_torque = first.axial_load * drawing.lead / TAU;
    Ok(states
        .iter()
        .map(|state| {
            let size = state.groove_torque().abs() + state.ball_torque.abs();
            let moving = Moving {
                load_torque,
                stands: false,
            };
            moving.friction(size * first.nut_speed.signum())
        })
        .collect())
}

/// Friction of one sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    /// Torque that overcomes friction, N m.
    pub friction_torque: f64,
    /// Work out over work in.
    pub efficiency: f64,
}

/// Least efficiency, as in the loop.
const LEAST_EFFICIENCY: f64 = -1e6;

/// What moves under a load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moving {
    /// Torque that holds the load without friction, N m, with its sign.
    pub load_torque: f64,
    /// Whether it stands, or is slower than the reversal speed.
    pub stands: bool,
}

impl Moving {
    /// Friction with this torque, N m, with the sign of the motion: its efficiency is that of the two torques, as in the loop.
    pub fn friction(&self, friction_torque: f64) -> Friction {
        let load = self.load_torque;
        let efficiency = if load == 0.0 || self.stands {
            0.0
        } else if (load < 0.0) == (friction_torque < 0.0) {
            load / (load + friction_torque)
        } else if friction_torque.is_nan() {
            friction_torque
        } else {
            (1.0 + friction_torque / load).max(LEAST_EFFICIENCY)
        };
        Friction {
            friction_torque,
            efficiency,
        }
    }
}

/// Axial load on each flank of the nut without a load, N: oversized balls press on all four contacts, whose deflections in
/// screw and nut are twice the oversize together.
fn flank_preload(configuration: &ClosedFormScrewConfiguration) -> Result<f64, Failure> {
    let oversize = (-f64::from(configuration.clearance.gap())).max(0.0);
    let drawing = drawing(configuration.design.parameters());
    let mut deflection = 0.0;
    for groove in [Groove::Screw, Groove::Nut] {
        let contact = drawing
            .contact(groove)
            .map_err(|error| Failure::Data(format!("--reference: {error}")))?;
        deflection += contact.deflection;
    }
    let contact_force = (2.0 * oversize / deflection).powf(1.5);
    let slope = drawing.contact_angle.sin() * drawing.lead_angle().cos();
    Ok(f64::from(configuration.loaded_balls) * contact_force * slope)
}

/// A caged ball screw in float64, by the closed form of its configuration.
pub struct CagedReference {
    /// Friction torque per load of a driven flank, m; none where driving locks.
    drive: Option<f64>,
    /// Friction torque per load of a back-driven flank, m.
    backdrive: f64,
    reduced_lead: f64,
    reversal_speed: f64,
    /// Axial load of each flank without a load between them, N.
    preload: f64,
    limits: Limits,
}

impl CagedReference {
    pub fn new(configuration: &ClosedFormScrewConfiguration) -> Result<Self, Failure> {
        let design = configuration.design.parameters();
        let pitch_radius = f64::from(design.pitch_radius);
        let reduced_lead = f64::from(design.lead) / TAU;
        if reduced_lead <= 0.0 {
            return Err(Failure::Data(
                "--reference works with efficiencies, and a design without lead has none".into(),
            ));
        }
        let screw = Screw {
            lead_angle: (reduced_lead / pitch_radius).atan(),
            contact_angle: design.contact_angle.into(),
            friction: configuration.friction.into(),
            ball_ratio: f64::from(design.ball_radius) / pitch_radius,
            rolling_tangent: configuration.rolling_tangent.into(),
        };
        let (drive, backdrive) = match configuration.branch {
            // Back-driving is driving with every friction turned round, and input and output changed.
            FrictionBranch::Sliding => (screw.sliding_drive(), screw.sliding_backdrive()),
            FrictionBranch::Rolling => {
                let turned = Screw {
                    friction: -screw.friction,
                    rolling_tangent: -screw.rolling_tangent,
                    ..screw
                };
                (screw.rolling_screw(), 1.0 / turned.rolling_screw())
            }
        };
        Ok(Self {
            drive: (drive > 0.0).then(|| reduced_lead * (1.0 - drive) / drive),
            backdrive: reduced_lead * (1.0 - backdrive),
            reduced_lead,
            reversal_speed: configuration.reversal_speed.into(),
            preload: flank_preload(configuration)?,
            limits: configuration.limits,
        })
    }

    pub fn friction(&self, sample: &ScrewSample) -> Friction {
        let within = |value: f64, limit: f32| value.clamp(-f64::from(limit), limit.into());
        let speed = within(sample.nut_speed, self.limits.nut_speed);
        let load = within(sample.axial_load, self.limits.axial_load);
        let direction = speed / speed.hypot(self.reversal_speed);
        let opposing = if speed < 0.0 { -load } else { load };
        let moving = Moving {
            load_torque: load * self.reduced_lead,
            stands: speed.abs() < self.reversal_speed,
        };
        let largest = f64::from(self.limits.friction_torque);

        let drive = match self.drive {
            Some(drive) => drive,
            // Nothing moves a load that is driven, and no load leaves nothing to be locked.
            None if opposing > 0.0 => return moving.friction(direction * largest),
            None => self.backdrive,
        };
        let sum = self.flank_sum(load);
        let torque = |difference: f64| {
            0.5 * (drive * (sum + difference) + self.backdrive * (sum - difference))
        };
        moving.friction((direction * torque(direction * load)).clamp(-largest, largest))
    }

    /// Sum of the two flanks' loads, whose difference is the load: Hertzian flanks that share one
    /// deflection, `F1^(2/3) + F2^(2/3) = 2 Fp^(2/3)`, solved by bisection for the lighter one.
    fn flank_sum(&self, load: f64) -> f64 {
        let load = load.abs();
        if load >= 2.0 * SQRT_2 * self.preload {
            return load;
        }
        let power = |force: f64| force.cbrt().powi(2);
        let target = 2.0 * power(self.preload);
        let (mut low, mut high) = (0.0, self.preload);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if power(middle) + power(middle + load) < target {
                low = middle;
            } else {
                high = middle;
            }
        }
        low + high + load
    }
}
