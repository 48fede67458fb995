//! A measured trace of a steering gear's screw, from the exact models, with everything known that a measurement hides.
//!
//! The nut is moved along a [`Course`]; the motor gives the torque
//!
//! `tau = J a + b w + offset + gain (L/2 pi) F + T_f + (S/S_ref) sum (c_k cos k th + s_k sin k th)`
//!
//! `T_f` is friction with a memory: dense elements under the limits of gross sliding, which the exact ball gives for the load, the preload,
//! the rolling resistance and the friction coefficient of the tick. Sensors add noise and count the angle. A [`Trace`] has the measured columns
//! beside the truth. Same seed, same trace, on every machine that rounds sines alike.

// For tests and programs of this workspace: a failure names the parameter.
#![allow(clippy::missing_errors_doc)]

pub mod course;
mod friction;
pub mod parameters;

use std::io::Write;

use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use course::{Course, STREAM};
use epas_reference::closed_loop::ClosedLoop;
use epas_reference::error::{ReferenceError, within};
use friction::{Memory, Sliding, State};
use parameters::Parameters;

/// Standard deviation of the torque's white noise over that of the torque.
const TORQUE_NOISE: f64 = 0.01;

/// Standard deviation of the load's white noise, N.
const LOAD_NOISE: f64 = 8.0;

/// Turn of the nut for one count of the encoder, rad: 14 bits of the motor's turn behind a ratio of 2.5.
const COUNT: f64 = ClosedLoop::COUNT;

/// Measured columns, and the truth behind them; all of one length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    /// Time, s.
    pub time: Vec<f64>,
    /// Counted angle of the nut, rad.
    pub nut_position: Vec<f64>,
    /// Motor torque at the nut, N m.
    pub motor_torque: Vec<f64>,
    /// Axial load, N.
    pub axial_load: Vec<f64>,
    /// Temperature, K.
    pub temperature: Vec<f64>,
    truth: Truth,
}

/// What a measurement does not show: angle of the nut, rad; its speed, rad/s; axial load, N; friction and motor torque, N m.
#[derive(Clone, Debug, Default, PartialEq)]
struct Truth {
    position: Vec<f64>,
    speed: Vec<f64>,
    load: Vec<f64>,
    friction: Vec<f64>,
    torque: Vec<f64>,
}

/// A rig: a screw with its drive and sensors.
#[derive(Clone, Debug, PartialEq)]
pub struct Rig(Sliding);

impl Rig {
    /// Solves the balls of the screw: some hundred, in parallel.
    pub fn new(parameters: Parameters) -> Result<Self, ReferenceError> {
        Ok(Self(Sliding::new(parameters)?))
    }

    /// Runs a course.
    pub fn run(&self, course: &Course, seed: u64) -> Result<Trace, ReferenceError> {
        let mut trace = course.driven(seed)?;
        self.drive(course.tick, &mut trace)?;
        let truth = &trace.truth;
        let mut random = Pcg64::new(seed.into(), STREAM ^ 1);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let size = TORQUE_NOISE * deviation(&truth.torque);
        let torque = truth.torque.iter();
        trace.motor_torque = torque.map(|torque| torque + size * normal()).collect();
        // One draw lies between both noises.
        normal();
        let load = truth.load.iter();
        trace.axial_load = load.map(|load| load + LOAD_NOISE * normal()).collect();
        let counted = |angle: &f64| (angle / COUNT).round() * COUNT;
        trace.nut_position = truth.position.iter().map(counted).collect();
        Ok(trace)
    }

    /// Speed, friction and torque along the motion of a trace.
    fn drive(&self, tick: f64, trace: &mut Trace) -> Result<(), ReferenceError> {
        let parameters = &self.0.parameters;
        let (screw, play) = (&parameters.screw, 0.5 * parameters.backlash);
        let truth = &mut trace.truth;
        truth.speed = slopes(&truth.position, tick);
        let acceleration = slopes(&truth.speed, tick);
        let reference_sum = screw.flank_sum(parameters.reference_axial_load);
        let mut memory = Memory::new(&self.0);
        // In the middle of the play at the start.
        let mut nut = truth.position.first().copied().unwrap_or(0.0);
        for (index, angle) in truth.position.iter().enumerate() {
            let (speed, load) = (truth.speed[index], truth.load[index]);
            within("load", load, -screw.largest_load, screw.largest_load)?;
            let taken = nut.clamp(angle - play, angle + play);
            let resisting = memory.follow(&State {
                turn: taken - nut,
                speed,
                load,
                temperature: trace.temperature[index],
            });
            nut = taken;
            let waves = parameters.waves.iter().map(|wave| {
                let (sin, cos) = (wave.order * angle).sin_cos();
                wave.cosine * cos + wave.sine * sin
            });
            truth.friction.push(resisting);
            truth.torque.push(
                parameters.inertia * acceleration[index]
                    + parameters.viscous * speed
                    + parameters.offset
                    + parameters.load_gain * screw.reduced_lead() * load
                    + resisting
                    + screw.flank_sum(load) / reference_sum * waves.sum::<f64>(),
            );
        }
        Ok(())
    }
}

impl Trace {
    /// Writes the measured columns as comma-separated values: `time,nut_position,motor_torque,axial_load,temperature`, in s, rad,
    /// N m, N and K.
    pub fn write_csv(&self, out: impl Write) -> Result<(), csv::Error> {
        let mut table = csv::Writer::from_writer(out);
        let names = "time,nut_position,motor_torque,axial_load,temperature";
        table.write_record(names.split(','))?;
        for index in 0..self.time.len() {
            table.write_record([
                format!("{:.6}", self.time[index]),
                format!("{:.9}", self.nut_position[index]),
                format!("{:.7}", self.motor_torque[index]),
                format!("{:.3}", self.axial_load[index]),
                format!("{:.3}", self.temperature[index]),
            ])?;
        }
        Ok(table.flush()?)
    }
}

/// Slope at every sample, by its neighbours.
fn slopes(values: &[f64], tick: f64) -> Vec<f64> {
    let last = values.len().saturating_sub(1);
    (0..values.len())
        .map(|index| {
            let (before, after) = (index.saturating_sub(1), (index + 1).min(last));
            (values[after] - values[before]) / ((after - before).max(1) as f64 * tick)
        })
        .collect()
}

/// Standard deviation.
fn deviation(values: &[f64]) -> f64 {
    let count = values.len().max(1) as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares = values.iter().map(|value| (value - mean).powi(2));
    (squares.sum::<f64>() / count).sqrt()
}

#[cfg(test)]
mod tests;
