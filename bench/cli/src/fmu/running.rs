//! Models of a unit while it runs: inputs in, outputs out, state as bytes.

use std::f64::consts::{PI, TAU};

use epas_friction::{Inputs, Outputs, Refusal, Regime};

use crate::simulate::memory;
use crate::simulate::nut::{Nut, STEPS};
use crate::simulate::remembering::{Remembers, Use};
use epas_calibrate::mechanism::Mechanism;
use epas_design::caged_scene::CagedModel;

/// What a step is told.
#[derive(Clone, Copy, Debug)]
pub struct Moment<'a> {
    /// Inputs, in the order of `variables::inputs`.
    pub inputs: &'a [f64],
    /// Time at its start, s.
    pub time: f64,
    /// Its length, s.
    pub size: f64,
    /// Ticks in it; 1 without a tick.
    pub ticks: u32,
}

impl Moment<'_> {
    /// An input by its place; NaN where there is none.
    pub fn input(&self, index: usize) -> f64 {
        self.inputs.get(index).copied().unwrap_or(f64::NAN)
    }
}

/// A model that runs.
pub trait Running: Send {
    /// Outputs at the end of a step, in the order of `variables::outputs`.
    ///
    /// # Errors
    /// An input under which there is no motion; nothing has moved.
    fn step(&mut self, moment: &Moment<'_>) -> Result<Vec<f64>, String>;

    /// Its state as bytes.
    ///
    /// # Errors
    /// What the crate refuses.
    fn save(&self) -> Result<Vec<u8>, String>;

    /// Takes a state over.
    ///
    /// # Errors
    /// What is wrong; the state is as it was.
    fn load(&mut self, state: &[u8]) -> Result<(), String>;
}

/// A regime by its number.
pub fn regime(regime: Regime) -> f64 {
    match regime {
        Regime::Standing => 0.0,
        Regime::Driving => 1.0,
        Regime::BackDriving => 2.0,
        Regime::Locked => 3.0,
    }
}

/// Inputs of a screw.
pub fn screw_inputs(moment: &Moment<'_>) -> Inputs {
    Inputs {
        nut_speed: moment.input(0) as f32,
        axial_load: moment.input(1) as f32,
    }
}

/// Outputs of a screw.
pub fn screw_outputs(outputs: &Outputs) -> Vec<f64> {
    vec![
        outputs.friction_torque.into(),
        outputs.load_torque.into(),
        outputs.efficiency.into(),
        regime(outputs.regime),
        outputs.faults.bits().into(),
    ]
}

/// Why a state was refused.
pub fn text(refusal: Refusal) -> String {
    format!("the state is refused: {refusal}")
}

/// Numbers before a model's block.
pub fn joined(numbers: &[f64], block: &[u8]) -> Vec<u8> {
    let mut bytes: Vec<u8> = numbers.iter().flat_map(|n| n.to_le_bytes()).collect();
    bytes.extend_from_slice(block);
    bytes
}

/// The numbers and the block again.
///
/// # Errors
/// Where the state is too short.
pub fn parted<const N: usize>(state: &[u8]) -> Result<([f64; N], &[u8]), String> {
    let mut numbers = [0.0; N];
    let mut rest = state;
    for number in &mut numbers {
        let (bytes, after) = rest
            .split_first_chunk::<8>()
            .ok_or("the state is too short")?;
        *number = f64::from_le_bytes(*bytes);
        rest = after;
    }
    Ok((numbers, rest))
}

impl Running for CagedModel {
    fn step(&mut self, moment: &Moment<'_>) -> Result<Vec<f64>, String> {
        Ok(screw_outputs(&Self::step(self, screw_inputs(moment))))
    }

    fn save(&self) -> Result<Vec<u8>, String> {
        self.export().map_err(text)
    }

    fn load(&mut self, state: &[u8]) -> Result<(), String> {
        self.import(state).map_err(text)
    }
}

/// Boxes a caged screw that remembers: its angle is the integral of its speed by the trapezoidal rule.
pub struct ByAngle;

/// A caged screw that remembers.
struct Caged<M> {
    model: M,
    /// Angle of the nut, rad; time, s, and speed, rad/s, of the last step, NaN before the first one.
    angle: f64,
    last: [f64; 2],
}

impl Use for ByAngle {
    type Made = Box<dyn Running>;

    fn with(self, model: impl Remembers + 'static) -> Self::Made {
        Box::new(Caged {
            model,
            angle: 0.0,
            last: [f64::NAN; 2],
        })
    }
}

impl<M: Remembers> Running for Caged<M> {
    fn step(&mut self, moment: &Moment<'_>) -> Result<Vec<f64>, String> {
        let speed = moment.input(0);
        if speed.is_finite() {
            let [time, before] = self.last;
            if !time.is_nan() {
                self.angle += 0.5 * (before + speed) * (moment.time - time);
            }
            self.last = [moment.time, speed];
        }
        let reading = ((self.angle + PI).rem_euclid(TAU) - PI) as f32;
        let temperature = moment.input(2) as f32;
        Ok(screw_outputs(&self.model.step_at(
            screw_inputs(moment),
            reading,
            temperature,
        )))
    }

    fn save(&self) -> Result<Vec<u8>, String> {
        let [time, speed] = self.last;
        Ok(joined(
            &[self.angle, time, speed],
            &self.model.export().map_err(text)?,
        ))
    }

    fn load(&mut self, state: &[u8]) -> Result<(), String> {
        let ([angle, time, speed], block) = parted(state)?;
        self.model.import(block).map_err(text)?;
        self.angle = angle;
        self.last = [time, speed];
        Ok(())
    }
}

/// Boxes a mechanism.
pub struct Moving {
    /// Its design's gain, drag and offset.
    pub told: [f64; 3],
    /// Inertia, kg m².
    pub inertia: f64,
    /// Tick, s.
    pub tick: f64,
}

/// A mechanism.
struct Motion<M> {
    mechanism: Mechanism<Nut<M>>,
    tick: f64,
}

impl Use for Moving {
    type Made = Box<dyn Running>;

    fn with(self, model: impl Remembers + 'static) -> Self::Made {
        let [gain, drag, offset] = self.told;
        Box::new(Motion {
            mechanism: Mechanism {
                inertia: self.inertia,
                position: 0.0,
                speed: 0.0,
                resistance: Nut {
                    model,
                    gain,
                    drag,
                    offset,
                    axial_load: 0.0,
                    temperature: memory::TEMPERATURE,
                    outputs: None,
                },
            },
            tick: self.tick,
        })
    }
}

impl<M: Remembers> Running for Motion<M> {
    fn step(&mut self, moment: &Moment<'_>) -> Result<Vec<f64>, String> {
        let torque = moment.input(0);
        if !torque.is_finite() {
            return Err(format!(
                "motor_torque = {torque} is no torque that moves something; allowed: finite numbers"
            ));
        }
        let mechanism = &mut self.mechanism;
        mechanism.resistance.axial_load = moment.input(1);
        mechanism.resistance.temperature = moment.input(2) as f32;
        for _ in 0..moment.ticks as usize * STEPS {
            mechanism.advance(torque, self.tick / STEPS as f64);
        }
        let mut outputs = match &mechanism.resistance.outputs {
            Some(outputs) => screw_outputs(outputs),
            None => vec![0.0; 5],
        };
        outputs.extend([mechanism.position, mechanism.speed]);
        Ok(outputs)
    }

    fn save(&self) -> Result<Vec<u8>, String> {
        let block = self.mechanism.resistance.model.export().map_err(text)?;
        Ok(joined(
            &[self.mechanism.position, self.mechanism.speed],
            &block,
        ))
    }

    fn load(&mut self, state: &[u8]) -> Result<(), String> {
        let ([position, speed], block) = parted(state)?;
        self.mechanism
            .resistance
            .model
            .import(block)
            .map_err(text)?;
        self.mechanism.position = position;
        self.mechanism.speed = speed;
        Ok(())
    }
}
