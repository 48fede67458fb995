//! `caged_torque`: friction torque of one ball that no other ball presses, over its axial load.
//!
//! The reference solves its elastic balance with Coulomb friction, from the largest load down; in the loop runs the scene `CagedBallScrew` with a
//! block that is folded for the request ([`epas_design`]), whose errors `design` certifies.

use epas_design::caged::{AXIAL_LOAD, Block};
use epas_design::{CagedDesign, CagedFold, Failure};
use epas_friction::scene::{CagedBallScrew, CagedBallScrewConfiguration};
use epas_friction::{Clearance, FrictionModel, Inputs, Limits, RollingResistance};
use epas_reference::friction::held_ball::HeldBall;
use epas_reference::friction::patch::Integration;
use epas_reference::friction::rolling_resistance::RollingResistance as Rolling;
use serde::Serialize;

use super::fields::{BadField, Fields, in_range, request};
use super::model::{Both, Model};
use super::train::{ScrewNumbers, of_contact};
use epas_design::caged_scene::unchecked;

/// Most loads of a request.
const LONGEST: usize = 1_000;

/// Largest load of a ball, N.
const LARGEST_LOAD: f64 = 1e5;

/// Load that stands for none, N: the friction of a preload has no direction of its own, and a balance needs one.
const SMALLEST_LOAD: f64 = 1e-3;

/// Least load that a law can be folded for, N; below it the torque is in proportion to the load.
const LEAST_FOLDED: f32 = 0.01;

request! {
    /// One ball of a screw with a cage.
    #[derive(Clone, Debug, Serialize)]
    pub struct Request {
        /// The screw.
        #[serde(flatten)]
        screw: ScrewNumbers = ScrewNumbers::read,
        /// Nominal contact angle, rad, 0.25 to 1.3.
        contact_angle: f64,
        /// Friction coefficient, 1e-3 to 0.5.
        friction: f64,
        /// Radial gap of every contact at the centred ball, m, -0.05 to 0.2 ball radii.
        clearance: f64,
        /// Axial loads, N, 1 to 1000 of them, up to 1e5 either way; above 0 they oppose the travel of a nut that turns forward.
        axial_load: Vec<f64> = |fields: &mut Fields| fields.list("axial_load", LONGEST),
        /// 1 where the nut turns forward, or -1.
        direction: f64,
    }
}

/// Friction torques of one ball on the nut.
#[derive(Clone, Debug, Serialize)]
pub struct Torques {
    /// One for each load, N m, none where it was not found; none at all where there is no law.
    pub torque: Option<Vec<Option<f64>>>,
}

impl Model for Request {
    const NAME: &'static str = "caged_torque";
    type InLoop = Torques;
    type Reference = Torques;

    fn evaluate(&self) -> Result<Both<Torques, Torques>, BadField> {
        self.check()?;
        let reference = self.reference()?;
        let in_loop = self.in_loop()?;
        Ok(Both { in_loop, reference })
    }
}

impl Request {
    fn check(&self) -> Result<(), BadField> {
        self.screw.check()?;
        in_range("contact_angle", self.contact_angle, 0.25, 1.3)?;
        in_range("friction", self.friction, 1e-3, 0.5)?;
        let radius = self.screw.ball_radius;
        in_range("clearance", self.clearance, -0.05 * radius, 0.2 * radius)?;
        for &load in &self.axial_load {
            in_range("axial_load", load, -LARGEST_LOAD, LARGEST_LOAD)?;
        }
        if self.direction.abs() == 1.0 {
            Ok(())
        } else {
            let message = format!("direction = {} is neither 1 nor -1", self.direction);
            Err(BadField::new("direction", message))
        }
    }

    /// The exact torque under each load.
    ///
    /// A screw that turns backward is its own mirror image: the load changes its sign.
    fn reference(&self) -> Result<Torques, BadField> {
        let preloaded = self.clearance < 0.0;
        let mut torque = vec![None; self.axial_load.len()];
        for side in [1.0, -1.0] {
            // Largest first, so that each balance starts from its neighbour's.
            let mut asked: Vec<(f64, usize)> = Vec::new();
            for (place, load) in self.axial_load.iter().enumerate() {
                let opposing = self.direction * load;
                if opposing == 0.0 && !preloaded {
                    torque[place] = Some(0.0);
                } else if (opposing < 0.0) == (side < 0.0) {
                    asked.push((side * opposing.abs().max(SMALLEST_LOAD), place));
                }
            }
            asked.sort_by(|(one, _), (other, _)| other.abs().total_cmp(&one.abs()));
            let loads: Vec<f64> = asked.iter().map(|(load, _)| *load).collect();
            let found = self.ball().along(&loads).map_err(of_contact)?;
            for ((load, place), found) in asked.into_iter().zip(found) {
                // Without a preload the torque ends with the load, in proportion.
                let share = if preloaded {
                    1.0
                } else {
                    self.axial_load[place].abs() / load.abs()
                };
                torque[place] = found.ok().map(|found| share * found.torque);
            }
        }
        Ok(Torques {
            torque: Some(torque),
        })
    }

    fn ball(&self) -> HeldBall {
        HeldBall {
            design: self.screw.exact(self.contact_angle),
            clearance: self.clearance,
            friction: self.friction,
            rolling: Rolling::NONE,
            integration: Integration::Full,
        }
    }

    /// Outputs of a step under each load; none where the clearance is not one of the crate's, or the design cannot be folded.
    fn in_loop(&self) -> Result<Torques, BadField> {
        const NONE: Torques = Torques { torque: None };
        let design = self
            .screw
            .design(self.contact_angle as f32)
            .map_err(|error| BadField::from(error).renamed("axis_ratio", "groove_radius"))?;
        let Ok(clearance) =
            Clearance::new(self.clearance as f32).and_then(|clearance| clearance.checked(&design))
        else {
            return Ok(NONE);
        };
        let sizes = || {
            let sizes = self.axial_load.iter().map(|load| load.abs() as f32);
            sizes.filter(|size| *size > 0.0)
        };
        let [least, most] = AXIAL_LOAD;
        let mut fold = CagedFold::of(CagedDesign {
            design,
            friction: self.friction as f32,
            rolling_resistance: RollingResistance::NONE,
            clearance,
            loaded_balls: 1,
            // Far below the speed of the step, whose friction is full.
            reversal_speed: 1e-6,
            limits: Limits {
                nut_speed: 10.0,
                axial_load: 1e6,
                friction_torque: 1e6,
            },
        });
        fold.axial_load = [
            sizes().fold(least, f32::min).max(LEAST_FOLDED),
            sizes().fold(most, f32::max),
        ];
        let block = match unchecked(&fold) {
            Ok(Block::One(block)) => block,
            Ok(Block::Range(_)) | Err(Failure::Domain(_) | Failure::Reference(_)) => {
                return Ok(NONE);
            }
            // Beyond what is folded, though the exact solver may have an answer.
            Err(Failure::Field(error)) if ["friction", "axial_load"].contains(&error.field()) => {
                return Ok(NONE);
            }
            Err(error) => return Err(BadField::request(error.to_string())),
        };
        self.stepped(&block)
    }

    fn stepped(&self, block: &CagedBallScrewConfiguration) -> Result<Torques, BadField> {
        let mut model = FrictionModel::<CagedBallScrew>::new(block)?;
        let torque = self.axial_load.iter().map(|&load| {
            let outputs = model.step(Inputs {
                nut_speed: self.direction as f32,
                axial_load: load as f32,
            });
            Some(f64::from(outputs.friction_torque.abs()))
        });
        Ok(Torques {
            torque: Some(torque.collect()),
        })
    }
}
