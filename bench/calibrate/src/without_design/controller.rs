//! A controller as a trace shows it: where it has its speed from, and what of the effort is not its own.

use crate::controller::Controller;
use crate::estimator::fit::rms;
use crate::estimator::kernel::Kernel;
use crate::estimator::record::Record;
use crate::trace::KnownEffort;
use crate::trace::Trace;
use crate::trace::channels::median;

/// Where a controller may have its speed from: ticks of a difference of positions, none of a sensor; and what that is in words.
pub const SOURCES: [(usize, &str); 4] = [
    (0, "a sensor of the speed"),
    (1, "the difference of the last two positions"),
    (2, "the difference of positions two ticks apart"),
    (4, "the difference of positions four ticks apart"),
];

#[derive(Clone, Debug, PartialEq)]
pub struct SeenController {
    pub controller: Controller,
    /// Where it has its speed from: what explains the measured effort best.
    pub source: (usize, &'static str),
    /// Effort that is not the controller's, at every sample, N or N m: what is known of it, and what is beyond the noise of the position's
    /// steps.
    pub added: Vec<f64>,
    /// Residual of the measured effort, rms, N or N m.
    pub residual: f64,
    /// The same over the measured effort, rms.
    pub share: f64,
}

/// Half-width of the kernel that smooths the speed of a sensor that is not in the trace, samples.
const SMOOTH: usize = 8;

/// Share of the effort from which on a controller is not the trace's.
const UNEXPLAINED: f64 = 0.5;

impl SeenController {
    fn efforts(
        controller: &Controller,
        trace: &Trace,
        speed: &[f64],
        reference: &[f64],
        ticks: usize,
    ) -> Vec<f64> {
        let speeds = trace.speed.as_deref().unwrap_or(speed);
        (0..trace.len())
            .map(|sample| {
                let position = trace.position[sample];
                let speed = if ticks == 0 {
                    speeds[sample]
                } else if sample < ticks {
                    speed[sample]
                } else {
                    (position - trace.position[sample - ticks]) / (ticks as f64 * trace.step)
                };
                controller.effort(reference[sample], position, speed)
            })
            .collect()
    }

    /// The controller as this trace shows it; `None` without a reference position.
    pub fn of(controller: Controller, trace: &Trace, record: &Record) -> Option<Self> {
        let reference = trace.reference_position.as_ref()?;
        let speed = Kernel::new(SMOOTH, trace.step).along(record.order(1), &record.motion);
        SOURCES
            .into_iter()
            .map(|source| {
                let efforts = Self::efforts(&controller, trace, &speed, reference, source.0);
                let rest: Vec<f64> = trace
                    .effort
                    .iter()
                    .zip(&efforts)
                    .enumerate()
                    .map(|(sample, (measured, wanted))| measured - wanted - within(trace, sample))
                    .collect();
                (source, robust_spread(&rest), rest)
            })
            .min_by(|one, other| one.1.total_cmp(&other.1))
            .map(|(source, spread, rest)| Self::told(controller, trace, source, spread, &rest))
    }

    fn told(
        controller: Controller,
        trace: &Trace,
        source: (usize, &'static str),
        spread: f64,
        rest: &[f64],
    ) -> Self {
        let steps =
            controller.gain_speed * trace.resolution / (source.0.max(1) as f64 * trace.step);
        // Six standard deviations, or two steps of the sensor: what is beyond is no noise.
        let noise = (6.0 * spread).max(2.0 * steps);
        let added = rest
            .iter()
            .enumerate()
            .map(|(sample, rest)| {
                let beyond = if rest.abs() > noise { *rest } else { 0.0 };
                beyond + within(trace, sample)
            })
            .collect();
        let residual = rms(rest);
        Self {
            controller,
            source,
            added,
            residual,
            share: residual / rms(&trace.effort).max(f64::MIN_POSITIVE),
        }
    }

    pub fn doubt(&self) -> Option<String> {
        let Controller {
            gain_position,
            gain_speed,
        } = self.controller;
        (self.share > UNEXPLAINED).then(|| {
            format!(
                "which model closes the loop best: the controller with gain_position = {gain_position} and gain_speed = {gain_speed} leaves {:.0} % of the measured effort; check both gains and their units",
                100.0 * self.share
            )
        })
    }
}

/// What the effort holds at a sample that the controller did not command, as far as it is known.
fn within(trace: &Trace, sample: usize) -> f64 {
    let known = trace.known.as_ref().and_then(KnownEffort::within);
    known
        .and_then(|known| known.get(sample))
        .copied()
        .unwrap_or(0.0)
}

/// Standard deviation of most of the values, by the median of their sizes.
fn robust_spread(values: &[f64]) -> f64 {
    1.4826 * median(values.iter().map(|value| value.abs()).collect())
}
