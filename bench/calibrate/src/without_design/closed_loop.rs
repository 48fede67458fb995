//! The loop of controller and mechanism, closed: how a model does by its motion, and not only by its effort.

use std::collections::VecDeque;

use crate::estimator::fit::rms;
use crate::mechanism::Mechanism;
use crate::trace::KnownEffort;
use crate::trace::Trace;
use crate::without_design::controller::SeenController;
use crate::without_design::slide::SlideResistance;

/// Steps of the mechanism in a tick: a quarter of a millisecond at 1 kHz.
const STEPS: usize = 4;

#[derive(Clone, Debug)]
pub struct Loop<'a> {
    /// The trace: its reference positions, loads, and where it starts.
    pub trace: &'a Trace,
    /// Speed at its start, rad/s or m/s.
    pub speed: f64,
    pub controller: &'a SeenController,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    /// Efforts of the controller, N or N m.
    pub effort: Vec<f64>,
    /// Positions, m or rad.
    pub position: Vec<f64>,
    /// Difference of the efforts over the measured effort, both as root mean squares.
    pub relative_error: f64,
    /// Difference of the positions, rms, m or rad.
    pub position_error: f64,
}

/// A first-order lag between the effort that the controller writes down and the one that acts.
#[derive(Clone, Copy, Debug)]
struct Lag {
    time: f64,
    effort: f64,
}

impl Lag {
    fn mean(&mut self, wanted: f64, step: f64) -> f64 {
        // Below a hundredth of a step the lag is lost in its mean.
        if self.time < 0.01 * step {
            self.effort = wanted;
            return wanted;
        }
        let before = self.effort;
        self.effort = wanted + (before - wanted) * (-step / self.time).exp();
        wanted + (before - self.effort) * self.time / step
    }
}

impl Loop<'_> {
    /// Runs the loop with a mechanism of this inertia and resistance; the effort acts with a delay, s, of which half a tick is the
    /// controller's hold.
    pub fn run(&self, inertia: f64, resistance: SlideResistance<'_>, delay: f64) -> Course {
        let trace = self.trace;
        let tick = trace.step;
        let start = trace.position.first().copied().unwrap_or(0.0);
        let speed = self.speed;
        let mut mechanism = Mechanism {
            inertia,
            position: start,
            speed,
            resistance,
        };
        let mut lag = Lag {
            time: (delay - 0.5 * tick).max(0.0),
            effort: trace.effort.first().copied().unwrap_or(0.0),
        };
        let ticks = self.controller.source.0;
        // Positions of the last ticks, the newest first; before the start it moved as it does there.
        let mut history: VecDeque<f64> = (1..=ticks)
            .map(|back| start - back as f64 * tick * speed)
            .collect();
        let reference = trace
            .reference_position
            .as_deref()
            .unwrap_or(&trace.position);
        let known = trace.known.as_ref().and_then(KnownEffort::beside);
        let mut course = Course {
            effort: Vec::with_capacity(trace.len()),
            position: Vec::with_capacity(trace.len()),
            relative_error: 0.0,
            position_error: 0.0,
        };
        for (sample, (wanted, added)) in reference.iter().zip(&self.controller.added).enumerate() {
            let seen = match history.back() {
                Some(oldest) => (mechanism.position - oldest) / (ticks as f64 * tick),
                None => mechanism.speed,
            };
            let controller = self.controller.controller;
            let effort = controller.effort(*wanted, mechanism.position, seen) + added;
            course.effort.push(effort);
            course.position.push(mechanism.position);
            if history.pop_back().is_some() {
                history.push_front(mechanism.position);
            }
            let load = trace.load.as_ref().map_or(0.0, |load| load[sample]);
            mechanism.resistance.load = load;
            let known = known.map_or(0.0, |known| known[sample]);
            let step = tick / STEPS as f64;
            for _ in 0..STEPS {
                let acting = lag.mean(effort, step) + known;
                mechanism.advance(acting, step);
            }
        }
        course.relative_error = distance(&trace.effort, &course.effort) / rms(&trace.effort);
        course.position_error = distance(&trace.position, &course.position);
        course
    }
}

impl Course {
    pub fn error_after(&self, trace: &Trace, share: f64) -> f64 {
        let start = (trace.len() as f64 * share.clamp(0.0, 1.0)) as usize;
        let [measured, found] = [&trace.effort, &self.effort].map(|effort| &effort[start..]);
        distance(measured, found) / rms(measured)
    }
}

fn distance(one: &[f64], other: &[f64]) -> f64 {
    let pairs = one.iter().zip(other);
    rms(&pairs.map(|(one, other)| one - other).collect::<Vec<_>>())
}
