//! Rows of balls of a unit while it runs.

use epas_friction::scene::WithMemoryInputs;
use epas_friction::{
    FrictionModel, LinearBearingTrain, LinearInputs, LinearOutputs, Refusal, UncagedBallScrew,
    UncagedOutputs,
};

use super::running::{Moment, Running, joined, parted, regime, screw_inputs, screw_outputs, text};
use crate::simulate::memory::{self, Remembering};

/// A row of balls with the motion that it has made: angle of the nut, rad, or travel of the carriage, m.
pub struct Row<M> {
    /// The model.
    pub model: M,
    /// The motion.
    pub motion: f64,
}

/// A row of balls for one tick.
pub trait Balls: Send {
    /// Outputs before the motion, and after it.
    fn tick(&mut self, moment: &Moment<'_>) -> (Vec<f64>, [f64; 4]);
    /// As [`Running::save`].
    ///
    /// # Errors
    /// What the crate refuses.
    fn export(&self) -> Result<Vec<u8>, Refusal>;
    /// As [`Running::load`].
    ///
    /// # Errors
    /// What the crate refuses.
    fn import(&mut self, block: &[u8]) -> Result<(), Refusal>;
}

impl<M: Balls> Running for Row<M> {
    fn step(&mut self, moment: &Moment<'_>) -> Result<Vec<f64>, String> {
        let mut made = self.model.tick(moment);
        for _ in 1..moment.ticks {
            made = self.model.tick(moment);
        }
        let speed = moment.input(0);
        if speed.is_finite() {
            self.motion += speed * moment.size;
        }
        let (mut outputs, parts) = made;
        outputs.push(self.motion);
        outputs.extend(parts);
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

fn of_screw(outputs: UncagedOutputs) -> (Vec<f64>, [f64; 4]) {
    let parts = [
        outputs.groove_torque.into(),
        outputs.ball_torque.into(),
        outputs.contacts.into(),
        outputs.largest_contact_force.into(),
    ];
    (screw_outputs(&outputs.into()), parts)
}

fn of_bearing(outputs: LinearOutputs) -> (Vec<f64>, [f64; 4]) {
    let parts = [
        outputs.groove_force.into(),
        outputs.ball_force.into(),
        outputs.contacts.into(),
        outputs.largest_contact_force.into(),
    ];
    let common = vec![
        outputs.friction_force.into(),
        regime(outputs.regime),
        outputs.faults.bits().into(),
    ];
    (common, parts)
}

fn bearing_inputs(moment: &Moment<'_>) -> LinearInputs {
    LinearInputs {
        speed: moment.input(0) as f32,
        normal_load: moment.input(1) as f32,
        side_load: moment.input(2) as f32,
    }
}

/// Inputs of a scene with memory that follows a speed.
fn remembered<I>(moment: &Moment<'_>, scene: I, temperature: usize) -> WithMemoryInputs<I, f32> {
    WithMemoryInputs {
        temperature: moment.input(temperature) as f32,
        ..memory::fresh(scene, moment.input(0) as f32)
    }
}

macro_rules! balls {
    ([$($generics:tt)*] $scene:ty, $inputs:ident, $outputs:ident, $temperature:literal) => {
        impl<$($generics)*> Balls for FrictionModel<$scene> {
            fn tick(&mut self, moment: &Moment<'_>) -> (Vec<f64>, [f64; 4]) {
                $outputs(self.step($inputs(moment)))
            }

            fn export(&self) -> Result<Vec<u8>, Refusal> {
                let mut block = vec![0; Self::STATE_BYTES];
                let length = Self::export(self, &mut block)?;
                block.truncate(length);
                Ok(block)
            }

            fn import(&mut self, block: &[u8]) -> Result<(), Refusal> {
                Self::import(self, block)
            }
        }

        impl<$($generics)*> Balls for FrictionModel<Remembering<$scene>> {
            fn tick(&mut self, moment: &Moment<'_>) -> (Vec<f64>, [f64; 4]) {
                $outputs(self.step(remembered(moment, $inputs(moment), $temperature)))
            }

            fn export(&self) -> Result<Vec<u8>, Refusal> {
                let mut block = vec![0; Self::STATE_BYTES];
                let length = Self::export(self, &mut block)?;
                block.truncate(length);
                Ok(block)
            }

            fn import(&mut self, block: &[u8]) -> Result<(), Refusal> {
                self.import_with_reading(block)
            }
        }
    };
}

balls!([const N: usize, const K: usize] UncagedBallScrew<N, K>, screw_inputs, of_screw, 2);
balls!([const N: usize] LinearBearingTrain<N>, bearing_inputs, of_bearing, 3);
