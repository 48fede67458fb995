//! What turns with the nut of a mechanism, with the friction of the model.

use crate::model::{Model, TEMPERATURE, TickInputs, TickOutputs};
use epas_calibrate::mechanism::{Resistance, Step};
use epas_design::files::Design;

pub const STEPS: usize = 4;

/// A nut with the model's friction.
#[derive(Clone)]
pub struct Nut<M> {
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
    pub outputs: Option<TickOutputs>,
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
            temperature: TEMPERATURE,
            outputs: None,
        }
    }
}

impl Nut<Box<dyn Model>> {
    fn step(&mut self, step: &Step) -> f64 {
        let speed = step.end_speed;
        let outputs = self.model.step(&self.inputs(step.speed, speed));
        self.outputs = Some(outputs);
        self.gain * f64::from(outputs.load_torque)
            + f64::from(outputs.friction)
            + self.drag * speed
            + self.offset
    }

    /// Inputs at a speed with a reading of the speed, rad/s.
    fn inputs(&self, speed: f64, reading: f64) -> TickInputs {
        TickInputs {
            reading: reading as f32,
            temperature: self.temperature,
            ..TickInputs::new(speed as f32, self.axial_load as f32)
        }
    }
}

/// Part of the torques within which friction and effort are near each other: far more than a step of single precision, so that it
/// decides nothing but whether it is worth looking. Torques below 1e-3 N m count as that.
const NEAR: f64 = 1e-3;

/// Turn from which on one is looked for that friction feels, rad: far below any that it does. A last digit of 0.2 N m is 1.5e-8 N m, which a
/// stiffness of 150 N m/rad reaches after 1e-10 rad.
const LEAST: f64 = 1e-14;

/// So many steps of friction may be missing to the balance: elements round each by itself, so that their sum may fall by a step or two where
/// it should rise, and a balance within that is not found.
const STEPS_OFF: f64 = 4.0;

impl Nut<Box<dyn Model>> {
    /// Torque that the nut holds at rest after a reading of its speed, N m: without what a speed adds.
    fn at_rest(&self, reading: f64) -> f64 {
        let mut model = self.model.clone();
        let outputs = model.step(&self.inputs(0.0, reading));
        self.gain * f64::from(outputs.load_torque) + f64::from(outputs.friction) + self.offset
    }

    /// The difference that the first of the readings `from`, twice that, and so on, makes to `rest`, N m; 0 where none does.
    fn first_felt(&self, from: f64, rest: f64) -> f64 {
        let readings = std::iter::successors(Some(from), |reading| Some(2.0 * reading));
        readings
            .take_while(|reading| reading.abs() < 1e3)
            .map(|reading| (self.at_rest(reading) - rest).abs())
            .find(|difference| *difference != 0.0)
            .unwrap_or(0.0)
    }

    /// Step of the friction around rest, N m: the larger one of both directions. None where it feels no motion in one of them, because it slides.
    fn resolution(&self, rest: f64, time: f64) -> Option<f64> {
        let least = LEAST / time;
        let both = [-least, least].map(|from| self.first_felt(from, rest));
        let [back, on] = both;
        both.iter().all(|step| *step > 0.0).then(|| back.max(on))
    }
}

impl Resistance for Nut<Box<dyn Model>> {
    fn against(&self, step: &Step) -> f64 {
        self.clone().step(step)
    }

    fn follow(&mut self, step: &Step) -> f64 {
        self.step(step)
    }

    fn holds(&self, step: &Step, effort: f64, inertial: f64) -> bool {
        let rest = self.at_rest(0.0);
        let missing = (effort - rest).abs();
        if missing > NEAR * (effort.abs() + rest.abs()).max(1e-3) {
            return false;
        }
        let felt = self.at_rest(step.end_speed) != rest;
        self.resolution(rest, step.time).is_some_and(|resolution| {
            let least = STEPS_OFF * resolution;
            missing <= least && (!felt || inertial <= least)
        })
    }
}
