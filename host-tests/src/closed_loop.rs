//! A motor that turns a screw against friction with a memory, behind an encoder and a delay: what a compensation of friction
//! has to live with.
//!
//! `J d²theta/dt² = u(t - delay) - T(theta)`, with the exact friction of slip across the path ([`Masing`]). Nothing else damps.

use crate::presliding::Limits;
use crate::presliding::backbone::Backbone;
use crate::presliding::masing::Masing;

/// What a compensation is tried on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosedLoop {
    /// Inertia about the nut's axis, kg m².
    pub inertia: f64,
    /// Friction of gross sliding, N m.
    pub friction: f64,
    /// Turn from rest to gross sliding, rad.
    pub breakaway: f64,
    /// Turn of the nut for one count of the encoder, rad.
    pub count: f64,
    /// Time between two readings, s.
    pub tick: f64,
    /// Ticks from a reading to the torque that answers it, which then stays for a tick.
    pub delay: usize,
    /// Nut speed at the start, rad/s.
    pub kick: f64,
    /// Amplitude of a torque that swings with [`Self::PUSHES`] for the first half second, N m.
    pub push: f64,
    /// Time that transients are given, s, and time in which the nut is watched.
    pub settling: f64,
    /// See `settling`.
    pub watched: f64,
}

/// What the nut does while it is watched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swing {
    /// Difference between the furthest angles, counts of the encoder.
    pub counts: f64,
    /// Largest speed, rad/s.
    pub speed: f64,
}

impl ClosedLoop {
    /// Counts of a turn of a rotor with an encoder of 14 bits behind a belt of ratio 2.5: 0.153 mrad of the nut.
    pub const COUNT: f64 = std::f64::consts::TAU / 16384.0 / 2.5;

    /// Frequency of the push, Hz: that of a steering wheel that shakes.
    pub const PUSHES: f64 = 25.0;

    const LONGEST_STEP: f64 = 2e-5;

    /// Runs a compensation: torque of a count that the encoder gives. `noise` is added to the angle before it is counted, in counts.
    pub fn run(
        &self,
        mut noise: impl FnMut() -> f64,
        mut compensation: impl FnMut(i64) -> f64,
    ) -> Swing {
        let mut friction = Masing::new(Backbone::Slip, Limits::UNIT);
        let mut torques = vec![0.0; self.delay + 1];
        let (mut angle, mut speed) = (0.0, self.kick);
        let steps = (self.tick / Self::LONGEST_STEP).ceil();
        let step = self.tick / steps;
        let (mut low, mut high, mut fastest) = (f64::INFINITY, f64::NEG_INFINITY, 0.0_f64);
        let settled = (self.settling / self.tick).round() as usize;
        let ticks = settled + (self.watched / self.tick).round() as usize;
        for tick in 0..ticks {
            let count = (angle / self.count + noise()).floor();
            torques.rotate_right(1);
            torques[0] = compensation(count as i64);
            let time = tick as f64 * self.tick;
            let push = if time < 0.5 { self.push } else { 0.0 };
            let push = push * (std::f64::consts::TAU * Self::PUSHES * time).sin();
            let torque = torques[self.delay] + push;
            for _ in 0..steps as usize {
                // Half a step of the angle before the speed and half after it: no energy comes from the steps.
                angle += 0.5 * step * speed;
                let against = self.friction * friction.follow(angle / self.breakaway);
                speed += step * (torque - against) / self.inertia;
                angle += 0.5 * step * speed;
                if tick >= settled {
                    low = low.min(angle);
                    high = high.max(angle);
                    fastest = fastest.max(speed.abs());
                }
            }
        }
        Swing {
            counts: (high - low) / self.count,
            speed: fastest,
        }
    }
}
