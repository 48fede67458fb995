//! A control loop: every scene stepped once a tick over a recorded manoeuvre, and one of them from an angle
//! sensor to the duty of a bridge.

use epas_friction::hal::{
    EncoderConfiguration, FaultReaction, FeedForwardConfiguration, FrictionFeedForward,
    MagneticEncoder,
};
use epas_friction::scene::UncagedBallScrew;
use epas_friction::scene::{CagedBallScrew, CagedConstants};
use epas_friction::{Error, FrictionModel, Inputs, LinearBearingTrain, LinearInputs};

use crate::cases::Reader;
use crate::devices::{BIT_LOST, Bridge, GEAR_RATIO, Sensor, TICK};
use crate::gears::GEAR_33X20;
use crate::numbers::{linear_outputs, outputs, uncaged_outputs};
use crate::scenes::{BALLS, CARRIAGE, Digest, ROW, UNCAGED_SCREW};

/// The recorded manoeuvre: how many ticks, the digest that a host found, and for each tick the nut speed,
/// rad/s, and the axial load, N; words of 32 bits, little endian.
pub static RECORDED: &[u8] = include_bytes!("../manoeuvre.bin");

/// A gear with a cage, whose constants stand in flash.
type Caged = FrictionModel<CagedBallScrew, &'static CagedConstants>;

/// What the interrupt works with.
pub struct ControlLoop {
    /// Gear with a cage.
    caged: Caged,
    /// Gear without.
    uncaged: FrictionModel<UncagedBallScrew<BALLS>>,
    /// Bearing of the rack.
    linear: FrictionModel<LinearBearingTrain<ROW>>,
    /// The gear with a cage once more, between devices.
    driven: Caged,
    encoder: MagneticEncoder<Sensor>,
    stage: FrictionFeedForward<Bridge>,
    /// Ticks without a speed, and whether the bridge was neutral in all of them and in no other tick.
    blind: u32,
    safe: bool,
    ticks: u32,
    inputs: Reader<'static>,
    left: u32,
    expected: u32,
    digest: Digest,
}

impl ControlLoop {
    /// Sets everything up, before the first interrupt.
    pub fn new(recorded: &'static [u8]) -> Result<Self, Error> {
        let mut inputs = Reader::new(recorded);
        let left = inputs.word().unwrap_or(0);
        let expected = inputs.word().unwrap_or(0);
        let encoder = EncoderConfiguration {
            tick: TICK,
            gear_ratio: GEAR_RATIO,
            largest_nut_speed: 700.0,
            smoothing_time: 2.0 * TICK,
            stuck_ticks: 1000,
        };
        let stage = FeedForwardConfiguration {
            full_torque: 8.0,
            largest_torque: 4.0,
            share: 0.8,
            reaction: FaultReaction::default(),
        };
        Ok(Self {
            driven: FrictionModel::of(&GEAR_33X20),
            encoder: MagneticEncoder::new(Sensor::new(inputs), &encoder)?,
            stage: FrictionFeedForward::new(Bridge::default(), &stage)?,
            blind: 0,
            safe: true,
            ticks: 0,
            caged: FrictionModel::of(&GEAR_33X20),
            uncaged: FrictionModel::new(&UNCAGED_SCREW)?,
            linear: FrictionModel::new(&CARRIAGE)?,
            left,
            expected,
            inputs,
            digest: Digest::default(),
        })
    }

    /// One tick; false where the manoeuvre is over.
    #[inline]
    pub fn tick(&mut self) -> bool {
        let mut input = [0.0; 2];
        if self.left == 0 || self.inputs.numbers(&mut input).is_none() {
            return false;
        }
        self.left -= 1;
        let [nut_speed, axial_load] = input;
        let inputs = Inputs {
            nut_speed,
            axial_load,
        };
        self.digest.take(&outputs(&self.caged.step(inputs)));
        self.digest
            .take(&uncaged_outputs(&self.uncaged.step(inputs)));
        let rack = LinearInputs {
            speed: nut_speed * (20e-3 / core::f32::consts::TAU),
            normal_load: 1500.0,
            side_load: 0.02 * axial_load,
        };
        self.digest.take(&linear_outputs(&self.linear.step(rack)));
        self.drive(axial_load);
        true
    }

    /// From the sensor's angle to the bridge's duty: a speed that is not known leaves the bridge neutral.
    fn drive(&mut self, axial_load: f32) {
        let nut_speed = match self.encoder.tick(false) {
            Ok(motion) => motion.nut_speed,
            Err(_) => f32::NAN,
        };
        let friction = self.driven.step(Inputs {
            nut_speed,
            axial_load,
        });
        let Ok(applied) = self.stage.apply(&friction);
        self.ticks += 1;
        self.blind += u32::from(nut_speed.is_nan());
        self.safe &= applied.neutral == nut_speed.is_nan();
        self.digest.take(&[
            friction.friction_torque,
            f32::from(applied.duty),
            f32::from(u8::from(applied.saturated)),
        ]);
    }

    /// What all outputs up to now come to.
    #[must_use]
    pub const fn digest(&self) -> u32 {
        self.digest.0
    }

    /// Whether the manoeuvre is over and gave what the host found.
    #[must_use]
    pub const fn passed(&self) -> bool {
        // The first reading has none before it, and a lost bit costs the tick and the one after.
        let blind = 1 + 2 * (self.ticks / BIT_LOST);
        self.left == 0 && self.digest.0 == self.expected && self.safe && self.blind == blind
    }
}
