//! Moments of traces: one type for screws, one for bearings.

use std::f64::consts::TAU;

use crate::model::TickInputs;

use super::trace::{Sample, SceneSample};

/// One moment of a ball screw's trace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScrewSample {
    /// Time, s.
    pub time: f64,
    /// Speed of the nut, rad/s.
    pub nut_speed: f64,
    /// Axial load, N.
    pub axial_load: f64,
    /// Angle of the nut as its encoder reads it, rad, joined or from turn to turn; 0 at every moment of a trace without.
    pub nut_position: f64,
}

/// One moment of a linear bearing's trace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearSample {
    /// Time, s.
    pub time: f64,
    /// Speed of the carriage, m/s.
    pub speed: f64,
    /// Load that presses the carriage on the rail, N.
    pub normal_load: f64,
    /// Load across the rail, N.
    pub side_load: f64,
}

impl ScrewSample {
    /// A moment of a trace without a position.
    pub const fn new(time: f64, nut_speed: f64, axial_load: f64) -> Self {
        Self {
            time,
            nut_speed,
            axial_load,
            nut_position: 0.0,
        }
    }
}

impl Sample for ScrewSample {
    const COLUMNS: &'static [&'static str] = &["time", "nut_speed", "axial_load"];

    const OPTIONAL: &'static [&'static str] = &["nut_position"];

    fn of(mut next: impl FnMut() -> f64) -> Self {
        Self {
            time: next(),
            nut_speed: next(),
            axial_load: next(),
            nut_position: next(),
        }
    }

    fn numbers(&self) -> Vec<f64> {
        vec![
            self.time,
            self.nut_speed,
            self.axial_load,
            self.nut_position,
        ]
    }

    fn between(low: &Self, high: &Self, of: &dyn Fn(f64, f64) -> f64) -> Self {
        // The shorter way round: an angle may start again after a turn.
        let turn = high.nut_position - low.nut_position;
        let turn = turn - TAU * (turn / TAU).round();
        Self {
            time: of(low.time, high.time),
            nut_speed: of(low.nut_speed, high.nut_speed),
            axial_load: of(low.axial_load, high.axial_load),
            nut_position: of(low.nut_position, low.nut_position + turn),
        }
    }

    fn time(&self) -> f64 {
        self.time
    }

    fn speed(&self) -> f64 {
        self.nut_speed
    }

    fn load(&self) -> f64 {
        self.axial_load
    }
}

impl Sample for LinearSample {
    const COLUMNS: &'static [&'static str] = &["time", "speed", "normal_load", "side_load"];

    fn of(mut next: impl FnMut() -> f64) -> Self {
        Self {
            time: next(),
            speed: next(),
            normal_load: next(),
            side_load: next(),
        }
    }

    fn numbers(&self) -> Vec<f64> {
        vec![self.time, self.speed, self.normal_load, self.side_load]
    }

    fn time(&self) -> f64 {
        self.time
    }

    fn speed(&self) -> f64 {
        self.speed
    }

    fn load(&self) -> f64 {
        self.normal_load
    }
}

impl SceneSample for ScrewSample {
    fn inputs(&self) -> TickInputs {
        TickInputs::new(self.nut_speed as f32, self.axial_load as f32)
    }

    fn position(&self) -> f64 {
        self.nut_position
    }
}

impl SceneSample for LinearSample {
    fn inputs(&self) -> TickInputs {
        TickInputs {
            side_load: self.side_load as f32,
            ..TickInputs::new(self.speed as f32, self.normal_load as f32)
        }
    }
}
