//! Models of a unit while it runs: inputs in, outputs out, state as bytes.

use epas_friction::{Refusal, Regime};

use crate::model::{Model, TickInputs, TickOutputs};
use crate::simulate::caged::wrapped;
use crate::simulate::nut::{Nut, STEPS};
use epas_calibrate::mechanism::Mechanism;

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
    /// The first two inputs, of a tick whose sensor reads the speed.
    fn tick(&self) -> TickInputs {
        TickInputs::new(self.input(0) as f32, self.input(1) as f32)
    }

    /// An input by its place; NaN where there is none.
    pub fn input(&self, index: usize) -> f64 {
        self.inputs.get(index).copied().unwrap_or(f64::NAN)
    }
}

/// A model that runs.
pub trait Running: Send {
    /// Outputs at the end of a step, in the order of `variables::outputs`.
    fn step(&mut self, moment: &Moment<'_>) -> Result<Vec<f64>, String>;

    /// Its state as bytes.
    fn save(&self) -> Result<Vec<u8>, String>;

    /// Takes a state over.
    fn load(&mut self, state: &[u8]) -> Result<(), String>;
}

fn regime(regime: Regime) -> f64 {
    match regime {
        Regime::Standing => 0.0,
        Regime::Driving => 1.0,
        Regime::BackDriving => 2.0,
        Regime::Locked => 3.0,
    }
}

fn screw_outputs(outputs: &TickOutputs) -> Vec<f64> {
    vec![
        outputs.friction.into(),
        outputs.load_torque.into(),
        outputs.efficiency.into(),
        regime(outputs.regime),
        outputs.faults.bits().into(),
    ]
}

fn text(refusal: Refusal) -> String {
    format!("the state is refused: {refusal}")
}

fn joined(numbers: &[f64], block: &[u8]) -> Vec<u8> {
    let mut bytes: Vec<u8> = numbers.iter().flat_map(|n| n.to_le_bytes()).collect();
    bytes.extend_from_slice(block);
    bytes
}

fn parted<const N: usize>(state: &[u8]) -> Result<([f64; N], &[u8]), String> {
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

pub struct Caged(pub Box<dyn Model>);

impl Running for Caged {
    fn step(&mut self, moment: &Moment<'_>) -> Result<Vec<f64>, String> {
        Ok(screw_outputs(&self.0.step(&moment.tick())))
    }

    fn save(&self) -> Result<Vec<u8>, String> {
        self.0.export().map_err(text)
    }

    fn load(&mut self, state: &[u8]) -> Result<(), String> {
        self.0.import(state).map_err(text)
    }
}

/// A caged screw that remembers: its angle is the integral of its speed by the trapezoidal rule.
pub struct ByAngle {
    model: Box<dyn Model>,
    /// Angle of the nut, rad; time, s, and speed, rad/s, of the last step, NaN before the first one.
    angle: f64,
    last: [f64; 2],
}

impl ByAngle {
    pub fn new(model: Box<dyn Model>) -> Self {
        Self {
            model,
            angle: 0.0,
            last: [f64::NAN; 2],
        }
    }
}

impl Running for ByAngle {
    fn step(&mut self, moment: &Moment<'_>) -> Result<Vec<f64>, String> {
        let speed = moment.input(0);
        if speed.is_finite() {
            let [time, before] = self.last;
            if !time.is_nan() {
                self.angle += 0.5 * (before + speed) * (moment.time - time);
            }
            self.last = [moment.time, speed];
        }
        let inputs = TickInputs {
            reading: wrapped(self.angle),
            temperature: moment.input(2) as f32,
            ..moment.tick()
        };
        Ok(screw_outputs(&self.model.step(&inputs)))
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

/// A row of balls with the motion that it has made: angle of the nut, rad, or travel of the carriage, m.
pub struct Row {
    pub model: Box<dyn Model>,
    pub linear: bool,
    pub motion: f64,
}

impl Running for Row {
    fn step(&mut self, moment: &Moment<'_>) -> Result<Vec<f64>, String> {
        let mut inputs = moment.tick();
        if self.linear {
            inputs.side_load = moment.input(2) as f32;
        }
        // Behind the loads; without memory nothing follows it.
        inputs.temperature = moment.input(2 + usize::from(self.linear)) as f32;
        let mut made = self.model.step(&inputs);
        for _ in 1..moment.ticks {
            made = self.model.step(&inputs);
        }
        let speed = moment.input(0);
        if speed.is_finite() {
            self.motion += speed * moment.size;
        }
        let mut outputs = screw_outputs(&made);
        if self.linear {
            // A bearing has neither load torque nor efficiency.
            outputs.drain(1..3);
        }
        outputs.push(self.motion);
        outputs.extend([made.groove, made.ball].map(f64::from));
        outputs.push(made.contacts.into());
        outputs.push(made.largest_contact_force.into());
        Ok(outputs)
    }

    fn save(&self) -> Result<Vec<u8>, String> {
        Ok(joined(&[self.motion], &self.model.export().map_err(text)?))
    }

    fn load(&mut self, state: &[u8]) -> Result<(), String> {
        let ([motion], block) = parted(state)?;
        self.model.import(block).map_err(text)?;
        self.motion = motion;
        Ok(())
    }
}

pub struct Motion {
    pub mechanism: Mechanism<Nut<Box<dyn Model>>>,
    /// Tick, s.
    pub tick: f64,
}

impl Running for Motion {
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
