//! The turn between two readings of a nut angle, exactly: a speed with white noise of 0.05 rad/s at 1 kHz is off by 1.6 mrad after a second, a
//! whole breakaway angle; a difference of angles is never off by more than the sensor.
//!
//! | type | reading | difference |
//! |---|---|---|
//! | [`CountSensor`] | counts of an encoder, wrapped | exact, in integers; one rounding to radians |
//! | [`WrappedAngle`] | radians, wrapped | one rounding, relative to the turn |
//! | [`SpeedOverTick`] | speed, rad/s | one rounding |
//! | [`Deadband`] | a sensor's reading | the turn beyond the sensor's noise |
//! | [`Play`] | turns | the turns behind a backlash |

mod play;
mod sensors;

pub use play::{Deadband, DeadbandReading, Moved, Play, PlayState};
pub use sensors::{
    AngleReading, CountReading, CountSensor, CountSensorParameters, LARGEST_TURN, NutAngle,
    SpeedOverTick, Turn, WrappedAngle, WrappedAngleParameters,
};
