//! A caged screw without memory whose friction coefficient follows speed and temperature: in every tick the law is asked, and the block told, as
//! firmware does it.

use epas_design::caged::Block;
use epas_design::caged_scene::CagedScene;
use epas_design::files::Design;
use epas_friction::Faults;
use epas_friction::law::coefficient::{CoefficientLaw, CoefficientParameters};
use epas_page::failure::Failure;

use super::reference::Moving;
use super::remembering::scene;
use crate::model::{self, Model, TickInputs, TickOutputs};

pub struct Lawful {
    model: Box<dyn Model>,
    law: CoefficientLaw,
    /// Load at which the unloaded flank of a preload lifts off, N.
    lift_off: f32,
    largest_friction: f32,
    reversal_speed: f32,
}

impl Lawful {
    pub fn new(design: &Design, law: &CoefficientParameters) -> Result<Self, Failure> {
        let scene = scene(design)?;
        let balls = f32::from(design.caged.loaded_balls);
        let lift_off = match &scene {
            CagedScene::Folded(Block::One(block)) => balls * block.law.lift_off,
            CagedScene::Folded(Block::Range(block)) => balls * block.law.lift_off,
            CagedScene::ClosedForm(_) => 0.0,
        };
        Ok(Self {
            model: model::caged(&scene)?,
            law: CoefficientLaw::new(law)?,
            lift_off,
            largest_friction: design.caged.limits.friction_torque,
            reversal_speed: design.caged.reversal_speed,
        })
    }

    /// One tick at a temperature, K: friction by the coefficient of speed and temperature, and the lubricant's drag.
    pub fn step(&mut self, inputs: &TickInputs) -> TickOutputs {
        let now = self.law.at_temperature(inputs.temperature);
        let known = self.model.set_friction(now.at(inputs.speed));
        let mut outputs = self.model.step(inputs);
        let drag = now.drag_torque(inputs.speed, inputs.load.abs(), self.lift_off);
        let friction = outputs.friction + drag;
        let limited = friction.clamp(-self.largest_friction, self.largest_friction);
        let moving = Moving {
            load_torque: outputs.load_torque.into(),
            stands: inputs.speed.abs() < self.reversal_speed,
        };
        outputs.friction = limited;
        outputs.efficiency = moving.friction(limited.into()).efficiency as f32;
        if known.is_err() {
            outputs.faults |= Faults::BEYOND_MODEL;
        }
        if limited != friction {
            outputs.faults |= Faults::FRICTION_LIMIT;
        }
        outputs
    }
}
