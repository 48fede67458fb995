//! A low-pass filter without a shift in time: a Butterworth filter that runs over a signal forwards and then backwards.
//!
//! Both runs together have the gain `1 / (1 + (f / cutoff)^(2 order))`: a half at the cut-off.

use std::f64::consts::{PI, TAU};

use sci_rs::signal::filter::design::{
    DigitalFilter, FilterBandType, FilterOutputType, Sos, butter_dyn,
};
use sci_rs::signal::filter::sosfiltfilt_dyn;

/// Highest cut-off, over the sampling rate: beyond it a filter has little left to take away, and differences of
/// neighbouring samples are no derivative any more.
pub const HIGHEST_CUTOFF: f64 = 0.25;

/// Lowest cut-off, over the sampling rate: below it the poles stand so close to 1 that rounding shows.
pub const LOWEST_CUTOFF: f64 = 1e-5;

/// Highest order.
pub const HIGHEST_ORDER: usize = 8;

/// Share of a step that is left where a filter is said to have settled.
const SETTLED: f64 = 1e-3;

/// A zero-phase Butterworth low-pass filter.
#[derive(Clone, Debug)]
pub struct ZeroPhase {
    sections: Vec<Sos<f64>>,
    cutoff: f64,
    order: usize,
}

impl ZeroPhase {
    /// A filter of samples every `step` seconds, of this order (1 to 8) and with this cut-off in hertz (at most a quarter
    /// of the sampling rate).
    ///
    /// # Errors
    /// What is out of its range.
    pub fn new(step: f64, cutoff: f64, order: usize) -> Result<Self, String> {
        if !(1..=HIGHEST_ORDER).contains(&order) {
            return Err(format!(
                "order of a filter = {order} must be within 1..={HIGHEST_ORDER}"
            ));
        }
        if !(step.is_finite() && step > 0.0) {
            return Err(format!("tick = {step} s must be positive"));
        }
        let (rate, share) = (1.0 / step, cutoff * step);
        if !(share <= HIGHEST_CUTOFF) {
            return Err(format!(
                "the sampling rate of {rate:.4} Hz is too low for a cut-off of {cutoff} Hz: at most {:.4} Hz",
                HIGHEST_CUTOFF * rate
            ));
        }
        if !(share >= LOWEST_CUTOFF) {
            return Err(format!(
                "cut-off = {cutoff} Hz is too low for a sampling rate of {rate:.4} Hz: at least {:.4} Hz",
                LOWEST_CUTOFF * rate
            ));
        }
        let design = butter_dyn(
            order,
            vec![2.0 * share],
            Some(FilterBandType::Lowpass),
            Some(false),
            Some(FilterOutputType::Sos),
            None,
        );
        let DigitalFilter::Sos(design) = design else {
            return Err("no filter in sections".into());
        };
        Ok(Self {
            sections: design.sos,
            cutoff,
            order,
        })
    }

    /// Cut-off, Hz.
    pub fn cutoff(&self) -> f64 {
        self.cutoff
    }

    /// Order of the filter that runs twice.
    pub fn order(&self) -> usize {
        self.order
    }

    /// Fewest samples of a signal: more than are mirrored at its ends.
    pub fn shortest(&self) -> usize {
        3 * (2 * self.sections.len() + 1) + 1
    }

    /// Time from an edge within which what lies beyond it shows by more than a thousandth, s: that of the pole which is
    /// slowest to settle.
    pub fn settling(&self) -> f64 {
        let slowest = TAU * self.cutoff * (PI / (2.0 * self.order as f64)).sin();
        -SETTLED.ln() / slowest
    }

    /// Gain of both runs at a frequency in hertz, of a filter that samples fast.
    pub fn gain(&self, frequency: f64) -> f64 {
        1.0 / (1.0 + (frequency / self.cutoff).powi(2 * self.order as i32))
    }

    /// The filtered signal, as long as the signal; empty where that is too short.
    pub fn apply(&self, signal: &[f64]) -> Vec<f64> {
        if signal.len() < self.shortest() {
            return Vec::new();
        }
        sosfiltfilt_dyn(signal.iter(), &self.sections)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A signal with content at every frequency, and a trend that the mirrored ends must carry on.
    fn signal() -> Vec<f64> {
        (0..40)
            .map(|k| f64::from((7 * k * k + 3 * k) % 23) / 23.0 + 0.1 * f64::from(k))
            .collect()
    }

    /// `scipy.signal.sosfiltfilt(butter(order, cutoff, fs=rate, output="sos"), x)`, SciPy's numbers at six places of
    /// `x = [((7*k*k + 3*k) % 23)/23 + 0.1*k for k in range(40)]`.
    #[test]
    fn scipys_numbers() {
        let golden = [
            (
                1,
                100.0,
                [
                    0.001144799664384799,
                    0.2731306120693148,
                    1.3181034270028649,
                    2.4724613941718974,
                    3.9726153780839035,
                    3.9001335960318135,
                ],
            ),
            (
                2,
                40.0,
                [
                    -0.021815975199052418,
                    0.16894022582866056,
                    1.1555724267268002,
                    2.4256344937551115,
                    3.9250131920684477,
                    3.9357602431476417,
                ],
            ),
            (
                3,
                25.0,
                [
                    -0.0817448363215666,
                    0.06638708662757825,
                    0.9572256585637364,
                    2.5640991599986007,
                    3.819238519952365,
                    3.842859046232339,
                ],
            ),
            (
                4,
                40.0,
                [
                    0.007395474855157682,
                    0.19658921764656975,
                    1.176447014428097,
                    2.3956706557429084,
                    3.9627275346812576,
                    3.9827033433287733,
                ],
            ),
            (
                4,
                100.0,
                [
                    -0.0012610996735625546,
                    0.21799964610047526,
                    1.3659454368171768,
                    2.487689921851512,
                    3.918886747176633,
                    3.894833923226754,
                ],
            ),
        ];
        for (order, cutoff, numbers) in golden {
            let filter = ZeroPhase::new(1e-3, cutoff, order).unwrap();
            let filtered = filter.apply(&signal());
            for (place, number) in [0, 1, 7, 20, 38, 39].into_iter().zip(numbers) {
                // The poles stand at least 0.03 from 1, so that roundings of numbers up to 4 (4.4e-16 each) grow by
                // 1/0.03 a section and run: two sections, two runs, some ten roundings each.
                assert!(
                    (filtered[place] - number).abs() < 1e-11,
                    "order {order}, {cutoff} Hz, {place}: {} for {number}",
                    filtered[place]
                );
            }
        }
    }

    #[test]
    fn a_sine_keeps_its_phase_and_loses_what_the_gain_says() {
        let step = 1e-4;
        let filter = ZeroPhase::new(step, 40.0, 4).unwrap();
        for frequency in [5.0, 30.0, 40.0, 60.0] {
            let sine: Vec<f64> = (0..20000)
                .map(|k| (TAU * frequency * step * f64::from(k)).sin())
                .collect();
            let filtered = filter.apply(&sine);
            let worst = (5000..15000)
                .map(|k| (filtered[k] - filter.gain(frequency) * sine[k]).abs())
                .fold(0.0, f64::max);
            // The gain is that of the analogue filter; the bilinear transform bends frequencies by
            // (pi f step)^2 / 3 < 1.2e-4 of their value, and the gain by 8 times that times f / cutoff.
            assert!(worst < 8.0 * 1.2e-4, "{frequency} Hz: {worst}");
        }
    }

    #[test]
    fn a_step_settles_in_its_time() {
        for order in 1..=HIGHEST_ORDER {
            let step = 1e-3;
            let filter = ZeroPhase::new(step, 25.0, order).unwrap();
            let edge: Vec<f64> = (0..4000).map(|k| f64::from(u8::from(k >= 2000))).collect();
            let filtered = filter.apply(&edge);
            let settled = 2000 + (filter.settling() / step) as usize;
            let worst = filtered[settled..]
                .iter()
                .map(|x| (x - 1.0).abs())
                .fold(0.0, f64::max);
            // A thousandth of the slowest pole's share of the step; that share is below 3 in these orders.
            assert!(worst < 3e-3, "order {order}: {worst}");
        }
    }

    #[test]
    fn bad_settings_and_short_signals_are_refused() {
        for (step, cutoff, order, word) in [
            (1e-3, 40.0, 0, "order"),
            (1e-3, 40.0, 9, "order"),
            (
                1e-3,
                251.0,
                4,
                "too low for a cut-off of 251 Hz: at most 250.0000 Hz",
            ),
            (1e-3, f64::NAN, 4, "too low"),
            (1e-3, 1e-3, 4, "at least"),
            (0.0, 40.0, 4, "tick"),
            (f64::NAN, 40.0, 4, "tick"),
        ] {
            let message = ZeroPhase::new(step, cutoff, order).unwrap_err();
            assert!(message.contains(word), "{message}");
        }
        let filter = ZeroPhase::new(1e-3, 40.0, 4).unwrap();
        assert!(filter.apply(&vec![1.0; filter.shortest() - 1]).is_empty());
        let constant = filter.apply(&vec![1.0; filter.shortest()]);
        assert_eq!(constant.len(), filter.shortest());
        assert!(constant.iter().all(|x| (x - 1.0).abs() < 1e-12));
        assert!(filter.apply(&[f64::NAN; 100]).iter().all(|x| x.is_nan()));
    }
}
