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

/// Part of the torques within which friction and effort are near each other: far more than a step of single precision, so that it
/// decides nothing but whether it is worth looking.
const NEAR: f64 = 1e-3;

/// Speed from which on a reading is looked for that friction feels, rad/s: far below any that it does.
const LEAST: f64 = 1e-12;

impl<M: Remembers> Nut<M> {
    /// Torque that the nut holds at rest after a reading of its speed, N m: without what a speed adds.
    fn at_rest(&self, reading: f64) -> f64 {
        let mut model = self.model.clone();
        let inputs = Inputs {
            nut_speed: 0.0,
            axial_load: self.axial_load as f32,
        };
        let outputs = model.step_at(inputs, reading as f32, self.temperature);
        self.gain * f64::from(outputs.load_torque)
            + f64::from(outputs.friction_torque)
            + self.offset
    }

    /// The same after the first of the readings `from`, twice that, and so on, that makes a difference to `rest`.
    fn first_felt(&self, from: f64, rest: f64) -> f64 {
        let readings = std::iter::successors(Some(from), |reading| Some(2.0 * reading));
        readings
            .take_while(|reading| reading.abs() < 1e3)
            .map(|reading| self.at_rest(reading))
            .find(|torque| *torque != rest)
            .unwrap_or(rest)
    }
}

impl<M: Remembers> Resistance for Nut<M> {
    fn against(&self, step: &Step) -> f64 {
        self.clone().step(step)
    }

    fn follow(&mut self, step: &Step) -> f64 {
        self.step(step)
    }

    fn holds(&self, step: &Step, effort: f64) -> bool {
        let rest = self.at_rest(0.0);
        if (effort - rest).abs() > NEAR * (effort.abs() + rest.abs())
            || self.at_rest(step.end_speed) != rest
        {
            return false;
        }
        let least = step.end_speed.abs().max(LEAST);
        let (back, on) = (self.first_felt(-least, rest), self.first_felt(least, rest));
        back < rest && rest < on && (back..=on).contains(&effort)
    }
}
