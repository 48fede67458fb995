//! Power spectral density of a residual by Welch's method.
//!
//! The transform is `rustfft`'s. Welch's average of windowed segments stands here: crate `welch-sde` has had one version, with
//! no change since, and its windows and means cannot be chosen.

use std::f64::consts::TAU;

use rustfft::algorithm::Radix4;
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftDirection};

/// Largest number of samples of a segment.
const LARGEST: usize = 4096;

/// Segments that a trace is cut into at the least, half of each over the next one's: their mean is within a third of the
/// density.
const SEGMENTS: usize = 8;

/// Power spectral density, one-sided, at every frequency, Hz, above zero: its integral over the frequency is the variance.
///
/// Segments that overlap by half, each less its mean, under Hann's window. None of fewer than 64 samples, or where the step is
/// not above 0.
pub fn welch(samples: &[f64], step: f64) -> Vec<(f64, f64)> {
    let room = 2 * samples.len() / (SEGMENTS + 1);
    if samples.len() < 64 || !(step > 0.0) {
        return Vec::new();
    }
    // The largest power of two that has room.
    let length = 1 << room.clamp(8, LARGEST).ilog2();
    let window: Vec<f64> = (0..length)
        .map(|index| 0.5 - 0.5 * (TAU * index as f64 / length as f64).cos())
        .collect();
    let power: f64 = window.iter().map(|weight| weight * weight).sum();

    let transform = Radix4::new(length, FftDirection::Forward);
    let mut places = vec![Complex::default(); length];
    let mut scratch = vec![Complex::default(); transform.get_inplace_scratch_len()];
    // Lines above the highest repeat those below it.
    let mut sums = vec![0.0; length / 2 + 1];
    let mut count = 0.0;
    for start in (0..=samples.len() - length).step_by(length / 2) {
        let segment = &samples[start..start + length];
        let mean = segment.iter().sum::<f64>() / length as f64;
        for ((place, sample), weight) in places.iter_mut().zip(segment).zip(&window) {
            *place = ((sample - mean) * weight).into();
        }
        transform.process_with_scratch(&mut places, &mut scratch);
        for (sum, line) in sums.iter_mut().zip(&places) {
            *sum += line.norm_sqr();
        }
        count += 1.0;
    }
    let highest = sums.len() - 1;
    let scale = step / (power * count);
    sums.into_iter()
        .enumerate()
        .skip(1)
        .map(|(line, sum)| {
            // Half of the power stands at the negative frequency; the highest one has none.
            let sides = if line == highest { 1.0 } else { 2.0 };
            (line as f64 / (length as f64 * step), sides * scale * sum)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    use super::*;

    /// 8192 samples of 1 ms: segments of 1024, with lines every 0.977 Hz; 12.5 Hz stands between two of them.
    #[test]
    fn a_sine_has_its_power_at_its_frequency() {
        let amplitude = 3.0;
        let samples: Vec<f64> = (0..8192)
            .map(|index| 7.0 + amplitude * (TAU * 12.5 * f64::from(index) * 1e-3).sin())
            .collect();
        let spectrum = welch(&samples, 1e-3);
        let peak = spectrum
            .iter()
            .max_by(|one, other| one.1.total_cmp(&other.1))
            .unwrap();
        let width = spectrum[0].0;
        assert!((peak.0 - 12.5).abs() <= 0.5 * width + 1e-12, "{peak:?}");
        let integral: f64 = spectrum.iter().map(|(_, density)| density * width).sum();
        // By Parseval's theorem, but for the line at 0 Hz and for the window's own weights, both below 1/(2 x 12.8)^2 of it: a
        // segment holds 12.8 waves.
        assert!(
            (integral / (0.5 * amplitude * amplitude) - 1.0).abs() < 1.5e-3,
            "{integral}"
        );
    }

    #[test]
    fn white_noise_is_flat() {
        let mut random = Pcg64Mcg::seed_from_u64(7);
        let samples: Vec<f64> = (0..1 << 16)
            .map(|_| random.random_range(-1.0..1.0))
            .collect();
        let spectrum = welch(&samples, 0.01);
        // Variance 1/3 over a band of 50 Hz.
        let wanted = 1.0 / 3.0 / 50.0;
        let (low, high) = spectrum.split_at(spectrum.len() / 2);
        for half in [low, high] {
            let mean = half.iter().map(|(_, density)| density).sum::<f64>() / half.len() as f64;
            // 2^16 values, half the band: a relative spread of 1/sqrt(2^15), 0.6 %; four times that.
            assert!((mean / wanted - 1.0).abs() < 0.022, "{mean} {wanted}");
        }
    }

    #[test]
    fn too_little_has_no_spectrum() {
        assert!(welch(&[1.0; 63], 1e-3).is_empty());
        assert!(welch(&[1.0; 1000], 0.0).is_empty());
        assert!(welch(&[1.0; 1000], f64::NAN).is_empty());
        assert_eq!(welch(&[1.0; 64], 1.0).len(), 4);
    }
}
