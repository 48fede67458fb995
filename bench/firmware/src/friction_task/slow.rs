//! The friction task: load, temperature, balls and adaptation, every millisecond; and a new calibration where there is one.

use epas_friction::adaptation::{Adaptation, AdaptationConfiguration, AdaptationInputs};
use epas_friction::law::FrictionLevel;
use epas_friction::law::motion::{CountReading, CountSensor, NutAngle, Turn};
use epas_friction::scene::WithMemoryInputs;
use epas_friction::{Error, Inputs, Outputs};

use super::gear::{self, Gear, NO_READING};
use super::measured::Measured;
use super::page::{Calibration, Refused};
use super::watch::{Offer, PageReport};
use super::{FAST_TICK, SLOW_TICK};

/// A number that comes by message, with its age when it was sent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Message {
    /// The number.
    pub value: f32,
    /// How old it was already, s.
    pub age: f32,
}

/// The last of such numbers, and how old it is now.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Aged(Message);

impl Aged {
    /// A tick, with or without a message. A value that is NaN or infinite is no message.
    fn tick(&mut self, message: Option<Message>) -> Message {
        match message {
            Some(message) if message.value.is_finite() => self.0 = message,
            // In f32 it stops at some hours: older than anything that counts.
            _ => self.0.age += SLOW_TICK,
        }
        self.0
    }
}

/// A reading of the encoder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reading {
    /// Its counts.
    pub counts: u32,
    /// The tick of the current loop that read it: the friction task comes when it can, so that its own ticks are no measure.
    pub tick: u32,
}

impl Reading {
    /// Before the first one.
    pub const NONE: Self = Self {
        counts: NO_READING,
        tick: 0,
    };
}

/// Nut speed from the encoder's counts, smoothed over two ticks.
#[derive(Clone, Copy, Debug)]
struct NutSpeed {
    counter: CountSensor,
    last: CountReading,
    tick: u32,
    speed: f32,
}

impl NutSpeed {
    /// The speed, rad/s; that of the last sound reading while there is none.
    fn tick(&mut self, reading: Reading) -> f32 {
        let ticks = reading.tick.wrapping_sub(self.tick);
        if ticks > 0
            && let Turn::Measured(turn) = self.counter.turn(&mut self.last, reading.counts)
        {
            let speed = turn / (FAST_TICK * ticks as f32);
            self.speed += 0.5 * (speed - self.speed);
            self.tick = reading.tick;
        }
        self.speed
    }
}

/// What the task is told at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlowInputs {
    /// Axial load of the rack, N, where a message came.
    pub load: Option<Message>,
    /// Temperature of the screw, K, where a message came.
    pub temperature: Option<Message>,
}

/// What the friction task's interrupt has for itself.
#[derive(Clone, Copy, Debug)]
pub struct SlowTask {
    calibration: Calibration,
    load: Aged,
    temperature: Aged,
    speed: NutSpeed,
    adaptation: Adaptation,
    level: FrictionLevel,
    /// In the last step's friction torque, N m.
    lubricant_drag: f32,
    measured: Measured,
}

/// Ticks between two updates of the adaptation.
const ADAPTATION_TICKS: u32 = 10;

impl SlowTask {
    /// The task and the gear's model, before the first interrupt.
    ///
    /// # Errors
    /// [`Error`] naming what the model does not take.
    pub fn new(calibration: &Calibration) -> Result<(Self, Gear), Error> {
        let gear = Gear::of(gear::constants(calibration)?);
        let nothing = Aged(Message {
            value: 0.0,
            age: 1e3,
        });
        let task = Self {
            calibration: *calibration,
            load: nothing,
            temperature: nothing,
            speed: NutSpeed {
                counter: gear::counter()?,
                last: CountSensor::FRESH,
                tick: 0,
                speed: 0.0,
            },
            adaptation: Adaptation::new(&AdaptationConfiguration::every(
                ADAPTATION_TICKS as f32 * SLOW_TICK,
            ))?,
            level: FrictionLevel::ONE,
            lubricant_drag: 0.0,
            measured: Measured::NONE,
        };
        Ok((task, gear))
    }

    /// The numbers in use.
    #[must_use]
    pub const fn calibration(&self) -> &Calibration {
        &self.calibration
    }

    /// One tick of the model, which the task has for itself as long as this takes.
    #[inline]
    pub fn step(
        &mut self,
        gear: &mut Gear,
        offer: Option<Offer>,
        reading: Reading,
        inputs: &SlowInputs,
    ) -> Outputs {
        if let Some(offer) = offer
            && gear.swap_constants(offer.constants).is_ok()
        {
            self.calibration = offer.calibration;
            self.measured.pages_taken = self.measured.pages_taken.wrapping_add(1);
        }
        let _ = gear.set_level(gear::bounded(self.level, &self.calibration));
        let load = self.load.tick(inputs.load);
        let temperature = self.temperature.tick(inputs.temperature);
        let nut_speed = self.speed.tick(reading);
        let outputs = gear.step(WithMemoryInputs {
            scene: Inputs {
                nut_speed,
                axial_load: load.value,
            },
            reading: reading.counts,
            load_age: load.age,
            temperature: temperature.value,
            temperature_age: temperature.age,
        });
        self.lubricant_drag = gear.drag_torque();
        self.measured = Measured {
            friction_torque: outputs.friction_torque,
            load_torque: outputs.load_torque,
            nut_speed,
            axial_load: load.value,
            load_age: load.age,
            temperature: temperature.value,
            temperature_age: temperature.age,
            regime: outputs.regime as u32,
            faults: u32::from(outputs.faults.bits()),
            steps: self.measured.steps.wrapping_add(1),
            ..self.measured
        };
        outputs
    }

    /// Friction level of the motion's direction that is in use.
    #[must_use]
    pub fn level(&self) -> f32 {
        gear::bounded(self.level, &self.calibration).of(self.measured.nut_speed)
    }

    /// What may wait until the model is free again: the adaptation. `observed` is the torque that the motor had to add to overcome
    /// friction, N m.
    pub fn adapt(&mut self, outputs: &Outputs, observed: f32) {
        if !self.measured.steps.is_multiple_of(ADAPTATION_TICKS) {
            return;
        }
        let adapted = self.adaptation.update(&AdaptationInputs {
            observed,
            modelled: outputs.friction_torque,
            lubricant_drag: self.lubricant_drag,
            level: gear::bounded(self.level, &self.calibration),
            nut_speed: self.measured.nut_speed,
            load_torque: outputs.load_torque,
            regime: outputs.regime,
            faults: outputs.faults,
            saturated: false,
        });
        self.level = adapted.estimates.level();
    }

    /// What the task shows to a tool, with the torque output and what was found of the calibration page.
    #[must_use]
    pub fn measured(&self, torque: f32, page: &PageReport) -> Measured {
        let level = gear::bounded(self.level, &self.calibration);
        let (page_state, page_field) = match page.refused {
            None => (0, 0),
            Some(Refused::Layout) => (1, 0),
            Some(Refused::Checksum) => (2, 0),
            Some(Refused::Range(field)) => (3, field),
            Some(Refused::Together) => (4, 0),
        };
        Measured {
            torque,
            level_forward: level.forward,
            level_backward: level.backward,
            page_state,
            page_field,
            pages_refused: page.pages_refused,
            ..self.measured
        }
    }
}
