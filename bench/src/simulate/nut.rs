//! What turns with the nut of a mechanism, with the friction of the model.

use epas_friction::{Inputs, Outputs};

use super::memory;
use super::remembering::Remembers;
use crate::designs::Design;
use crate::mechanism::{Resistance, Step};

/// Steps in a tick.
pub const STEPS: usize = 4;

/// A nut with the model's friction.
#[derive(Clone)]
pub struct Nut<M> {
    /// The screw.
    pub model: M,
    /// Torque of the load, over that of a screw without friction.
    pub gain: f64,
    /// Drag over the speed, N m s/rad.
    pub drag: f64,
    /// Torque without motion or load, N m.
    pub offset: f64,
    /// Axial load, N.
    pub axial_load: f64,
    /// Temperature, K.
    pub temperature: f32,
    /// What the screw said last.
    pub outputs: Option<Outputs>,
}

impl<M> Nut<M> {
    /// The nut of a design, with what a trace has told of it.
    pub fn of(design: &Design, model: M) -> Self {
        let told = |value: Option<f32>, without: f64| value.map_or(without, f64::from);
        let calibrated = design.calibrated.as_ref();
        Self {
            model,
            gain: told(calibrated.and_then(|found| found.gain), 1.0),
            drag: told(calibrated.and_then(|found| found.drag), 0.0),
            offset: told(calibrated.and_then(|found| found.offset), 0.0),
            axial_load: 0.0,
            temperature: memory::TEMPERATURE,
            outputs: None,
        }
    }
}

impl<M: Remembers> Nut<M> {
    fn step(&mut self, step: &Step) -> f64 {
        let inputs = Inputs {
            nut_speed: step.speed as f32,
            axial_load: self.axial_load as f32,
        };
        let speed = step.end_speed;
        let outputs = self.model.step_at(inputs, speed as f32, self.temperature);
        self.outputs = Some(outputs);
        self.gain * f64::from(outputs.load_torque)
            + f64::from(outputs.friction_torque)
            + self.drag * speed
            + self.offset
    }
}

impl<M: Remembers> Resistance for Nut<M> {
    fn against(&self, step: &Step) -> f64 {
        self.clone().step(step)
    }

    fn follow(&mut self, step: &Step) -> f64 {
        self.step(step)
    }
}
