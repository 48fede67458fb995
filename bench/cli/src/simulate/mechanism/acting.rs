//! What acts on a mechanism: motor torque or wanted angle, load, and an effort that is known.

use std::f64::consts::TAU;

use crate::simulate::trace::{Follows, Sample, Temperature, read};
use epas_page::failure::Failure;
use epas_traces::mdf4::Mapping;
use epas_traces::source::Source;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Acting {
    /// Time, s.
    pub time: f64,
    /// Motor torque, N m, or wanted angle, rad.
    pub command: f64,
    /// Axial load, N.
    pub axial_load: f64,
    /// Torque on the nut that the motor does not make, N m, in the direction of positive motion; 0 without.
    pub known_torque: f64,
    /// Force on what travels, N, in the direction of positive motion; 0 without. As in `calibrate` it drives the nut as a motor's force would:
    /// what loads the screw, and its friction, is the axial load.
    pub known_force: f64,
}

impl Acting {
    /// Torque of the known effort at the nut, N m, on a screw with this lead, m.
    pub fn known(&self, lead: f64) -> f64 {
        self.known_torque + self.known_force * lead / TAU
    }
}

/// A moment of a motor torque, or of a wanted angle where the loop is closed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Commanded<const CLOSED: bool>(pub Acting);

impl<const CLOSED: bool> Sample for Commanded<CLOSED> {
    const COLUMNS: &'static [&'static str] = if CLOSED {
        &["time", "reference_position", "axial_load"]
    } else {
        &["time", "motor_torque", "axial_load"]
    };

    const OPTIONAL: &'static [&'static str] = &["known_torque", "known_force"];

    fn of(mut next: impl FnMut() -> f64) -> Self {
        Self(Acting {
            time: next(),
            command: next(),
            axial_load: next(),
            known_torque: next(),
            known_force: next(),
        })
    }

    fn numbers(&self) -> Vec<f64> {
        let Acting {
            time,
            command,
            axial_load,
            known_torque,
            known_force,
        } = self.0;
        vec![time, command, axial_load, known_torque, known_force]
    }

    fn time(&self) -> f64 {
        self.0.time
    }

    fn speed(&self) -> f64 {
        0.0
    }

    fn load(&self) -> f64 {
        self.0.axial_load
    }
}

/// What acts over a trace: its name, its moments, its temperatures.
pub fn moments<const CLOSED: bool>(
    source: &Source<'_>,
    channels: Option<&Mapping>,
    follows: Follows,
) -> Result<(String, Vec<Acting>, Temperature), Failure> {
    let (trace, temperature) = read::<Commanded<CLOSED>>(source, channels, follows)?;
    let moments = trace.samples.iter().map(|sample| sample.0).collect();
    Ok((trace.name, moments, temperature))
}

/// The tick of a trace of equal steps of time, s.
pub fn tick(acting: &[Acting]) -> Result<f64, Failure> {
    let refused = |message: &str| Err(Failure::Data(message.into()));
    let [first, .., last] = acting else {
        return refused("a mechanism needs two samples or more");
    };
    let tick = (last.time - first.time) / (acting.len() - 1) as f64;
    if !(1e-6..=1.0).contains(&tick) {
        return refused("the tick of the trace is out of range; allowed: 1e-6 to 1 s");
    }
    let uneven = acting
        .windows(2)
        .any(|pair| (pair[1].time - pair[0].time - tick).abs() > 0.01 * tick);
    if uneven {
        return refused("a mechanism needs a trace of equal steps of time");
    }
    Ok(tick)
}
