//! A control loop: every scene stepped once a tick over a recorded manoeuvre.

use epas_friction::{
    CagedBallScrew, Error, FrictionModel, Inputs, LinearBearingTrain, LinearInputs,
    UncagedBallScrew,
};

use crate::cases::Reader;
use crate::scenes::{
    Digest, ROW, caged_configuration, linear_configuration, uncaged_configuration,
};
use crate::subjects::{BALLS, outputs, train_outputs};

/// The recorded manoeuvre: how many ticks, the digest that a host found, and for each tick the nut speed,
/// rad/s, and the axial load, N; words of 32 bits, little endian.
pub static RECORDED: &[u8] = include_bytes!("../manoeuvre.bin");

/// What the interrupt works with.
pub struct ControlLoop {
    /// Gear with a cage.
    caged: FrictionModel<CagedBallScrew>,
    /// Gear without.
    uncaged: FrictionModel<UncagedBallScrew<BALLS>>,
    /// Bearing of the rack.
    linear: FrictionModel<LinearBearingTrain<ROW>>,
    inputs: Reader<'static>,
    left: u32,
    expected: u32,
    digest: Digest,
}

impl ControlLoop {
    /// Sets everything up, before the first interrupt.
    ///
    /// # Errors
    /// None with the designs used here.
    pub fn new(recorded: &'static [u8]) -> Result<Self, Error> {
        let mut inputs = Reader::new(recorded);
        Ok(Self {
            caged: FrictionModel::new(&caged_configuration()?)?,
            uncaged: FrictionModel::new(&uncaged_configuration()?)?,
            linear: FrictionModel::new(&linear_configuration()?)?,
            left: inputs.word().unwrap_or(0),
            expected: inputs.word().unwrap_or(0),
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
        self.digest.take(&train_outputs(&self.uncaged.step(inputs)));
        let rack = LinearInputs {
            speed: nut_speed * (20e-3 / core::f32::consts::TAU),
            normal_load: 1500.0,
            side_load: 0.02 * axial_load,
        };
        self.digest.take(&train_outputs(&self.linear.step(rack)));
        true
    }

    /// What all outputs up to now come to.
    #[must_use]
    pub const fn digest(&self) -> u32 {
        self.digest.0
    }

    /// Whether the manoeuvre is over and gave what the host found.
    #[must_use]
    pub const fn passed(&self) -> bool {
        self.left == 0 && self.digest.0 == self.expected
    }
}
