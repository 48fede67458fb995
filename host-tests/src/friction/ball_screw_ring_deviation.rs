//! How the contact angles of a ball screw deviate along its grooves.

use std::f64::consts::TAU;

use crate::error::{ReferenceError, within};

/// Largest deviation of the arc centres, rad.
const LARGEST_DEVIATION: f64 = 0.2;
/// One wave of a deviation along a groove: `cosine cos(order p) + sine sin(order p)` at the phase `p` of its period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeviationWave {
    /// Waves in a period; 0 for a constant.
    pub order: f64,
    /// Amplitude of the cosine, rad.
    pub cosine: f64,
    /// Amplitude of the sine, rad.
    pub sine: f64,
}

/// How far the arc centres of a groove are turned along it, rad: contact angles `beta + deviation` on the right flank, `beta - deviation` on
/// the left.
#[derive(Clone, Debug, PartialEq)]
pub enum GrooveDeviation {
    /// A sum of waves over a period of so many turns.
    Waves {
        /// Turns of a period, above zero.
        turns: f64,
        /// Waves; none for a groove without deviation.
        waves: Vec<DeviationWave>,
    },
    /// Values at equal distances from the start of a period, linear in between.
    Samples {
        /// Turns of a period, above zero.
        turns: f64,
        /// Values, rad; at least one.
        values: Vec<f64>,
    },
}

impl GrooveDeviation {
    /// No deviation.
    pub const NONE: Self = Self::Waves {
        turns: 1.0,
        waves: Vec::new(),
    };

    /// One wave of `sine sin(order phi)` in every turn.
    pub fn sine(order: f64, sine: f64) -> Self {
        Self::Waves {
            turns: 1.0,
            waves: vec![DeviationWave {
                order,
                cosine: 0.0,
                sine,
            }],
        }
    }

    /// Deviation at an azimuth along the groove, rad.
    pub fn at(&self, azimuth: f64) -> f64 {
        match self {
            Self::Waves { turns, waves } => {
                let phase = azimuth / turns;
                waves
                    .iter()
                    .map(|wave| {
                        let (sin, cos) = (wave.order * phase).sin_cos();
                        wave.cosine * cos + wave.sine * sin
                    })
                    .sum()
            }
            Self::Samples { turns, values } => {
                let count = values.len();
                let at = (azimuth / (TAU * turns)).rem_euclid(1.0) * count as f64;
                let low = at as usize % count;
                let part = at - at.floor();
                values[low] * (1.0 - part) + values[(low + 1) % count] * part
            }
        }
    }

    pub(crate) fn check(&self, field: &'static str) -> Result<(), ReferenceError> {
        let largest = match self {
            Self::Waves { turns, waves } => {
                within(field, *turns, 1e-3, 1e3)?;
                for wave in waves {
                    within(field, wave.order, 0.0, 1e3)?;
                }
                waves.iter().map(|w| w.cosine.abs() + w.sine.abs()).sum()
            }
            Self::Samples { turns, values } => {
                within(field, *turns, 1e-3, 1e3)?;
                if values.is_empty() {
                    return Err(ReferenceError::input(field, "has no values"));
                }
                values.iter().try_fold(0.0_f64, |largest, value| {
                    within(field, *value, -LARGEST_DEVIATION, LARGEST_DEVIATION)
                        .map(|value| largest.max(value.abs()))
                })?
            }
        };
        within(field, largest, 0.0, LARGEST_DEVIATION)?;
        Ok(())
    }
}
