//! Noise of smoothed motion: what a sensor's step and its noise become after the filter and the derivatives.

use std::f64::consts::PI;

use crate::signals::filter::ZeroPhase;
use crate::trace::channels::resolution;

/// Most samples that noise is found from: more tell no more.
const MOST: usize = 200_000;

/// Derivative at every sample: of the parabola through three neighbours.
pub fn derivative(signal: &[f64], step: f64) -> Vec<f64> {
    let ([first, second, third, ..], [.., before, last_but_one, last]) = (signal, signal) else {
        return vec![0.0; signal.len()];
    };
    let half = 0.5 / step;
    let mut slope = Vec::with_capacity(signal.len());
    slope.push((4.0 * second - 3.0 * first - third) * half);
    slope.extend(signal.windows(3).map(|near| match near {
        [left, _, right] => (right - left) * half,
        _ => 0.0,
    }));
    slope.push((3.0 * last - 4.0 * last_but_one + before) * half);
    slope
}

/// Standard deviation of the noise of the `orders`-th derivatives of a filtered signal: what rounding to the sensor's step
/// does to this motion, or what the white noise becomes that the samples show, whichever is more.
pub fn of_derivatives(
    signal: &[f64],
    smoothed: &[f64],
    step: f64,
    filter: &ZeroPhase,
    orders: [u8; 2],
) -> [f64; 2] {
    /// White noise beyond this share of the sensor's step is no rounding, whose deviation is `1/sqrt(12)` of the step.
    const ROUNDING: f64 = 0.4;
    let (white, resolution) = (white_noise(signal), resolution(signal));
    let rounded = rounding(smoothed, resolution, step, filter, orders);
    if white <= ROUNDING * resolution {
        return rounded;
    }
    [0, 1].map(|place| {
        let seen = white * gain(step, filter, orders[place]);
        if seen > rounded[place] {
            seen
        } else {
            rounded[place]
        }
    })
}

/// Error of the derivatives of a signal that is rounded to this step.
fn rounding(
    smoothed: &[f64],
    resolution: f64,
    step: f64,
    filter: &ZeroPhase,
    orders: [u8; 2],
) -> [f64; 2] {
    /// Moments at which the error is taken: where a whole number of steps passes in a tick, the error is large for a short
    /// time.
    const MOMENTS: usize = 20_000;
    if !(resolution > 0.0) {
        return [0.0; 2];
    }
    let slopes: Vec<f64> = smoothed
        .windows(2)
        .step_by(smoothed.len() / MOMENTS + 1)
        .map(|pair| match pair {
            [a, b] => ((b - a) / (resolution * step)).abs(),
            _ => 0.0,
        })
        .collect();
    orders.map(|order| {
        let band = (order > 0).then(|| gain(step, filter, order - 1));
        let white = gain(step, filter, order);
        let sum: f64 = slopes
            .iter()
            .map(|steps| sawtooth(*steps, step, filter, order, [band.unwrap_or(0.0), white]))
            .sum();
        resolution * (sum / slopes.len().max(1) as f64).sqrt()
    })
}

/// Variance that a derivative of the rounding error has, over the square of the sensor's step, while so many steps pass in
/// a second. The error is a sawtooth, whose harmonics `k` have the amplitude `1 / (pi k)`; they are not white: those of a
/// slow motion all lie within what the filter lets pass.
fn sawtooth(steps: f64, step: f64, filter: &ZeroPhase, order: u8, [band, white]: [f64; 2]) -> f64 {
    /// Harmonics that are taken one by one.
    const HARMONICS: u32 = 64;
    if steps < 4.0 * filter.cutoff() / f64::from(HARMONICS) {
        // So dense that their sum is an integral over the frequency; without a derivative, all of the error.
        let nyquist = 0.5 / step;
        return if order == 0 {
            1.0 / 12.0
        } else {
            2.0 * steps * nyquist * band * band
        };
    }
    let one_by_one: f64 = (1..=HARMONICS)
        .map(|harmonic| {
            let share = steps * step * f64::from(harmonic);
            let folded = (share - share.round()).abs() / step;
            let derivative = ((2.0 * PI * folded * step).sin() / step).powi(i32::from(order));
            let size = filter.gain(folded) * derivative / (PI * f64::from(harmonic));
            0.5 * size * size
        })
        .sum();
    // The others lie anywhere below half the sampling rate.
    let rest = 1.0 / (2.0 * PI * PI * f64::from(HARMONICS));
    one_by_one + rest * white * white
}

/// Standard deviation of white noise, found from fourth differences: motion, which is slow against the sampling, hardly
/// shows in them. A twentieth of them, the largest, may be jolts and is left out.
pub fn white_noise(signal: &[f64]) -> f64 {
    /// Root of the sum of squares of 1, 4, 6, 4, 1.
    const GAIN: f64 = 8.366_600_265_340_756;
    /// Mean square of the inner 95 % of a normal distribution of unit variance: `1 - 2 1.960 0.05845 / 0.95`.
    const INNER: f64 = 0.7588;
    let stride = signal.len() / MOST + 1;
    let mut differences: Vec<f64> = signal
        .windows(5)
        .step_by(stride)
        .map(|near| match near {
            [a, b, c, d, e] => (a + e - 4.0 * (b + d) + 6.0 * c).abs(),
            _ => 0.0,
        })
        .collect();
    differences.sort_by(f64::total_cmp);
    let kept = differences.len() - differences.len() / 20;
    if kept == 0 {
        return 0.0;
    }
    let sum: f64 = differences.iter().take(kept).map(|x| x * x).sum();
    (sum / (kept as f64 * INNER)).sqrt() / GAIN
}

/// What white noise of unit variance has after the filter and so many central differences.
fn gain(step: f64, filter: &ZeroPhase, order: u8) -> f64 {
    /// Frequencies of the sum up to half the sampling rate; a cut-off of a thousandth of the rate is still 8 of them.
    const PIECES: usize = 4096;
    // The bilinear transform bends the frequencies; the cut-off is where it was asked for.
    let bend = |angle: f64| (0.5 * angle).tan();
    let cutoff = bend(2.0 * PI * filter.cutoff() * step);
    let sum: f64 = (0..PIECES)
        .map(|piece| {
            let angle = PI * (piece as f64 + 0.5) / PIECES as f64;
            let low_pass = filter.gain(filter.cutoff() * bend(angle) / cutoff);
            let gain = low_pass * (angle.sin() / step).powi(i32::from(order));
            gain * gain
        })
        .sum();
    (sum / PIECES as f64).sqrt()
}
