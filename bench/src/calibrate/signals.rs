//! Smoothed motion, and the rows of a regression.

/// Motion of a trace, smoothed without a shift in time, at every sample.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Position, rad or m.
    pub position: Vec<f64>,
    /// Speed, rad/s or m/s.
    pub speed: Vec<f64>,
    /// Acceleration, rad/s^2 or m/s^2.
    pub acceleration: Vec<f64>,
    /// Standard deviation of the noise of speed and of acceleration.
    pub noise: [f64; 2],
}
