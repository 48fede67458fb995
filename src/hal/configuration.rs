//! What the engineer sets for the speed from an angle sensor.

/// How a rotor's angle becomes the nut's speed; unchecked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct EncoderConfiguration {
    /// Time between two calls of [`MagneticEncoder::tick`](super::MagneticEncoder::tick), s, 1e-6 to 1.
    pub tick: f32,
    /// Turns of the rotor in one turn of the nut, of magnitude 0.01 to 100: 1 on the nut itself, the
    /// ratio of the pulleys with a belt between. Negative where the sensor counts down while the nut
    /// turns forward.
    pub gear_ratio: f32,
    /// Largest nut speed, rad/s: 1e-3 up to a quarter of a turn of the rotor in one
    /// tick, `pi / (2 gear_ratio tick)`.
    pub largest_nut_speed: f32,
    /// Time constant of the first-order smoothing of the speed, s, 0 (none) to 10.
    pub smoothing_time: f32,
    /// Number of ticks without a change of the angle, while the rotor is known to turn, after which
    /// the sensor counts as stuck; 0 counts as 1 would.
    pub stuck_ticks: u32,
}
