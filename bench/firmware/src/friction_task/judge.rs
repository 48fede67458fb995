//! What the run has to show: a torque without a jump, whatever the sensors do, and the flag of each event.

use epas_friction::Faults;

use super::page::Calibration;
use super::vehicle::{EVENTS, Event, event};

/// What was seen during an event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Largest change of the torque from tick to tick, N m.
    pub largest_step: f32,
    /// Least size of the torque, N m.
    pub least: f32,
    /// Largest size of the torque, N m.
    pub largest: f32,
    /// Flags of the friction task.
    pub faults: Faults,
}

/// The whole run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judge {
    torque: f32,
    seen: [Seen; EVENTS.len()],
    /// Torque before the load passed its limit, and the least while it was beyond, N m.
    before_limit: f32,
    least_beyond_limit: f32,
    /// Torque when the long gap began, and the largest change in the time in which it is held, N m.
    before_gap: f32,
    moved_in_hold: f32,
}

/// Time of the long gap's first tick without an angle, ms, and of the last one in which the torque is held.
const GAP: u32 = 2350;
const HELD: u32 = 2359;

impl Judge {
    /// Before the first tick.
    pub const START: Self = Self {
        torque: 0.0,
        seen: [Seen {
            largest_step: 0.0,
            least: f32::MAX,
            largest: 0.0,
            faults: Faults::NONE,
        }; EVENTS.len()],
        before_limit: 0.0,
        least_beyond_limit: f32::MAX,
        before_gap: 0.0,
        moved_in_hold: 0.0,
    };

    /// A tick of the current loop, at a time, ms.
    pub fn fast(&mut self, time: u32, torque: f32) {
        let step = (torque - self.torque).abs();
        self.torque = torque;
        if time < GAP {
            self.before_gap = torque;
        } else if time <= HELD {
            raise(&mut self.moved_in_hold, (torque - self.before_gap).abs());
        }
        if let Some(seen) = self.seen.get_mut(event(time)) {
            raise(&mut seen.largest_step, step);
            raise(&mut seen.largest, torque.abs());
            if torque.abs() < seen.least {
                seen.least = torque.abs();
            }
        }
    }

    /// A tick of the friction task, with its flags.
    pub fn slow(&mut self, time: u32, faults: Faults) {
        let place = event(time);
        if let Some(seen) = self.seen.get_mut(place) {
            seen.faults |= faults;
        }
        if EVENTS.get(place).map(|event| event.1) != Some(Event::BeyondLimit) {
            return;
        }
        let torque = self.torque.abs();
        if !faults.contains(Faults::LOAD_RANGE) {
            raise(&mut self.before_limit, torque);
        } else if torque < self.least_beyond_limit {
            self.least_beyond_limit = torque;
        }
    }

    /// What was seen during each event.
    #[must_use]
    pub const fn seen(&self) -> &[Seen; EVENTS.len()] {
        &self.seen
    }

    /// Part of the torque that is left while the load is beyond its limit.
    #[must_use]
    pub fn left_beyond_limit(&self) -> f32 {
        self.least_beyond_limit / self.before_limit
    }

    /// Whether the run was as it should be.
    #[must_use]
    pub fn passed(&self, calibration: &Calibration) -> bool {
        // A step is the difference of two torques below 4 N m, each rounded once: 2^-22 N m.
        let largest_step = calibration.torque_slew * super::FAST_TICK + 2.4e-7;
        // While it is held the torque follows what changes beside the angle: the load, the friction coefficient.
        let mut passed =
            self.left_beyond_limit() > 0.95 && self.moved_in_hold < 0.01 * self.before_gap.abs();
        for (seen, (_, event, _)) in self.seen.iter().zip(&EVENTS) {
            let flag = match event {
                Event::Sound => Faults::NONE,
                Event::BeyondLimit => Faults::LOAD_RANGE,
                Event::NoLoad => Faults::LOAD_STALE,
                Event::ShortGap | Event::LongGap | Event::Broken => Faults::ANGLE_NOT_VALID,
                Event::NoTemperature => Faults::TEMPERATURE_STALE,
            };
            passed &= seen.faults.contains(flag) && seen.largest_step <= largest_step;
            passed &= match event {
                Event::Sound => !seen.faults.faulty(),
                // Gone after hold and fade.
                Event::LongGap => seen.least == 0.0,
                // What the preload makes is left without a load; an event shorter than the hold takes nothing away.
                Event::NoLoad | Event::ShortGap | Event::BeyondLimit => seen.least > 0.05,
                Event::NoTemperature | Event::Broken => true,
            };
        }
        passed
    }
}

fn raise(largest: &mut f32, value: f32) {
    if value > *largest {
        *largest = value;
    }
}
