//! Angular speed from the differences of a 14-bit angle.

use core::f32::consts::{FRAC_PI_2, TAU};

use super::encoder::{EncoderConfiguration, EncoderError};
use crate::error::{Error, in_range};

const COUNTS: f32 = 16384.0;

/// Longest gap, in ticks, over which a difference may be taken.
const LONGEST_GAP: f32 = 1000.0;

#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct NutSpeed {
    /// Nut speed per count and tick, rad/s.
    speed_per_count: f32,
    /// Counts in one tick at the largest speed, and one for the rounding of the angle.
    largest_step: f32,
    /// Ticks after which a difference is no longer taken.
    longest_gap: u32,
    /// Weight of a new speed in the smoothed one, above 0 to 1.
    gain: f32,
    stuck_ticks: u32,
    last: Option<u16>,
    gap: u32,
    /// Ticks of a rotor that is known to turn since the angle has changed.
    unchanged: u32,
    speed: Option<f32>,
}

impl NutSpeed {
    pub(super) fn new(configuration: &EncoderConfiguration) -> Result<Self, Error> {
        let EncoderConfiguration {
            tick,
            gear_ratio,
            largest_nut_speed,
            smoothing_time,
            stuck_ticks,
        } = *configuration;
        in_range("tick", tick, 1e-6, 1.0)?;
        in_range("gear_ratio", gear_ratio, -100.0, 100.0)?;
        let ratio = gear_ratio.abs();
        // The sign is the direction in which the sensor counts; the size may not vanish.
        in_range("gear_ratio", ratio, 0.01, 100.0)?;
        let quarter_turn_speed = FRAC_PI_2 / (ratio * tick);
        let speed = largest_nut_speed;
        in_range("largest_nut_speed", speed, 1e-3, quarter_turn_speed)?;
        in_range("smoothing_time", smoothing_time, 0.0, 10.0)?;
        let gap = quarter_turn_speed / largest_nut_speed;
        Ok(Self {
            speed_per_count: TAU / (COUNTS * gear_ratio * tick),
            largest_step: largest_nut_speed * ratio * tick * (COUNTS / TAU) + 1.0,
            longest_gap: gap.min(LONGEST_GAP) as u32,
            gain: tick / (smoothing_time + tick),
            stuck_ticks: stuck_ticks.max(1),
            last: None,
            gap: 0,
            unchanged: 0,
            speed: None,
        })
    }

    #[inline]
    pub(super) fn miss(&mut self, turning: bool) {
        self.gap = self.gap.saturating_add(1);
        self.wait(turning);
    }

    /// A tick without a change of the angle; it does not count at standstill.
    #[inline]
    const fn wait(&mut self, turning: bool) {
        self.unchanged = if turning {
            self.unchanged.saturating_add(1)
        } else {
            0
        };
    }

    /// A tick with an angle, counts: the smoothed nut speed, rad/s.
    #[inline]
    pub(super) fn take<E>(&mut self, angle: u16, turning: bool) -> Result<f32, EncoderError<E>> {
        let gap = self.gap.saturating_add(1);
        let last = self.last.replace(angle);
        self.gap = 0;
        let Some(last) = last.filter(|_| gap <= self.longest_gap) else {
            self.unchanged = 0;
            self.speed = None;
            return Err(EncoderError::NoEarlierReading);
        };
        if angle == last {
            self.wait(turning);
        } else {
            self.unchanged = 0;
        }
        if self.unchanged >= self.stuck_ticks {
            self.speed = None;
            return Err(EncoderError::Stuck {
                ticks: self.unchanged,
            });
        }
        let step = f32::from(wrapped_step(last, angle));
        let ticks = gap as f32;
        if step.abs() > self.largest_step * ticks {
            self.speed = None;
            return Err(EncoderError::TooFast);
        }
        let speed = if gap == 1 {
            step * self.speed_per_count
        } else {
            step * self.speed_per_count / ticks
        };
        let before = self.speed.unwrap_or(speed);
        let smoothed = before + self.gain * (speed - before);
        self.speed = Some(smoothed);
        Ok(smoothed)
    }

    /// Angle of the rotor, rad, 0 up to 2 pi, of a 14-bit angle in counts.
    #[inline]
    pub(super) fn rotor_angle(angle: u16) -> f32 {
        f32::from(angle) * (TAU / COUNTS)
    }

    pub(super) fn resolution(&self) -> f32 {
        self.speed_per_count.abs()
    }
}

/// The shorter way from one 14-bit angle to another, counts, -8192 to 8191.
#[inline]
const fn wrapped_step(from: u16, to: u16) -> i16 {
    // The two unused bits are shifted out, so that bit 13 of the difference becomes the sign.
    (to.wrapping_sub(from) << 2).cast_signed() >> 2
}
