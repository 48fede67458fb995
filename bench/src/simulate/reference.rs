//! The same scene in float64, from the efficiencies of the reference.

use std::f64::consts::{SQRT_2, TAU};

use epas_friction::{CagedBallScrewConfiguration, FrictionBranch, Limits};
use epas_reference::efficiency::Screw;

use super::trace::Sample;
use crate::failure::Failure;

/// Friction of one sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    /// Torque that overcomes friction, N m.
    pub friction_torque: f64,
    /// Efficiency in the present direction.
    pub efficiency: f64,
}

/// A caged ball screw in float64.
pub struct ReferenceScene {
    /// Friction torque per load of a driven flank, m; none where driving locks.
    drive: Option<f64>,
    /// Friction torque per load of a back-driven flank, m.
    backdrive: f64,
    reduced_lead: f64,
    reversal_speed: f64,
    preload: f64,
    limits: Limits,
}

impl ReferenceScene {
    /// The scene of a configuration that the in-loop model has accepted.
    pub fn new(configuration: &CagedBallScrewConfiguration) -> Result<Self, Failure> {
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
            FrictionBranch::Rolling => {
                let turned = Screw {
                    friction: -screw.friction,
                    rolling_tangent: -screw.rolling_tangent,
                    ..screw
                };
                (screw.rolling_screw(), 1.0 / turned.rolling_screw())
            }
            FrictionBranch::Sliding => (screw.sliding_drive(), screw.sliding_backdrive()),
        };
        Ok(Self {
            drive: (drive > 0.0).then(|| reduced_lead * (1.0 - drive) / drive),
            backdrive: reduced_lead * (1.0 - backdrive),
            reduced_lead,
            reversal_speed: configuration.reversal_speed.into(),
            preload: configuration.preload.into(),
            limits: configuration.limits,
        })
    }

    /// Friction of one sample, within the same limits as in the loop.
    pub fn friction(&self, sample: &Sample) -> Friction {
        let within = |value: f64, limit: f32| value.clamp(-f64::from(limit), limit.into());
        let speed = within(sample.nut_speed, self.limits.nut_speed);
        let load = within(sample.axial_load, self.limits.axial_load);
        let direction = speed / speed.hypot(self.reversal_speed);
        let opposing = if speed < 0.0 { -load } else { load };
        let load_work = opposing * self.reduced_lead;
        let largest = f64::from(self.limits.friction_torque);

        let drive = match self.drive {
            Some(drive) => drive,
            // Nothing moves a load that is driven, and no load leaves nothing to be locked.
            None if opposing > 0.0 => {
                return Friction {
                    friction_torque: direction * largest,
                    efficiency: 0.0,
                };
            }
            None => self.backdrive,
        };
        let sum = self.flank_sum(load);
        let torque = |difference: f64| {
            0.5 * (drive * (sum + difference) + self.backdrive * (sum - difference))
        };
        let full = torque(opposing);
        Friction {
            friction_torque: (direction * torque(direction * load)).clamp(-largest, largest),
            efficiency: if load_work > 0.0 {
                load_work / (load_work + full)
            } else if load_work < 0.0 {
                1.0 + full / load_work
            } else {
                0.0
            },
        }
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
