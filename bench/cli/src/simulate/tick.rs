//! `simulate --tick`: a trace as firmware at another rate sees it.

use super::trace::{Sample, Temperature, Trace};
use epas_page::failure::Failure;

const MOST: f64 = 5e6;

/// A time between two ticks, s.
pub fn tick(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (1e-6..=1.0).contains(&value) => Ok(value),
        _ => Err("a tick is 1e-6 to 1 s".into()),
    }
}

/// The trace at equal steps of a tick, from its first sample on, interpolated linearly between its samples.
pub fn resampled<S: Sample>(
    trace: &Trace<S>,
    temperature: &Temperature,
    tick: f64,
) -> Result<(Trace<S>, Temperature), Failure> {
    let begin = trace.samples.first().map_or(0.0, Sample::time);
    let ticks = (trace.duration() / tick + 1e-9).floor();
    if ticks > MOST {
        return Err(Failure::Data(format!(
            "--tick {tick} makes {ticks} ticks of {} s; at most {MOST:e}",
            trace.duration()
        )));
    }
    let mut above = 1;
    let mut samples = Vec::with_capacity(ticks as usize + 1);
    let mut temperatures = Vec::new();
    for number in 0..=ticks as usize {
        let time = begin + number as f64 * tick;
        while above + 1 < trace.samples.len() && trace.samples[above].time() < time {
            above += 1;
        }
        let last = trace.samples.len() - 1;
        let (below, above) = (above.min(last).saturating_sub(1), above.min(last));
        let [low, high] = [below, above].map(|index| trace.samples[index]);
        let step = high.time() - low.time();
        let share = if step > 0.0 {
            ((time - low.time()) / step).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let blend = |low: f64, high: f64| low + share * (high - low);
        let sample = S::between(&low, &high, &blend);
        samples.push(sample);
        if let (Some(low), Some(high)) = (temperature.at(below), temperature.at(above)) {
            temperatures.push(blend(low.into(), high.into()) as f32);
        }
    }
    let trace = Trace {
        name: trace.name.clone(),
        samples,
    };
    let temperature = match temperature {
        Temperature::Followed(_) => Temperature::Followed(temperatures),
        other => other.clone(),
    };
    Ok((trace, temperature))
}

#[cfg(test)]
mod tests {
    use super::super::samples::ScrewSample;
    use super::*;

    /// Ticks lie on the straight lines between samples, whatever the samples' own steps are, and end with the trace.
    #[test]
    fn ticks_lie_between_samples() {
        let samples = [(0.0, 0.0), (0.01, 10.0), (0.015, 0.0)];
        let trace = Trace {
            name: "steps".into(),
            samples: samples
                .map(|(time, nut_speed)| ScrewSample::new(time, nut_speed, 100.0 * nut_speed))
                .to_vec(),
        };
        let kelvins = Temperature::Followed(vec![300.0, 310.0, 310.0]);
        let (found, kelvins) = resampled(&trace, &kelvins, 2e-3).unwrap();
        let speeds: Vec<f64> = found
            .samples
            .iter()
            .map(|sample| sample.nut_speed)
            .collect();
        let wanted = [0.0, 2.0, 4.0, 6.0, 8.0, 10.0, 6.0, 2.0];
        assert_eq!(speeds.len(), wanted.len());
        for (index, (found, wanted)) in speeds.iter().zip(wanted).enumerate() {
            assert!((found - wanted).abs() < 1e-9, "{index}: {found} {wanted}");
        }
        assert!((found.samples[4].axial_load - 800.0).abs() < 1e-6);
        assert!((kelvins.at(3).unwrap() - 306.0).abs() < 1e-3);
        assert!(resampled(&trace, &Temperature::None, 1e-9).is_err());
    }

    #[test]
    fn a_tick_has_a_range() {
        for (text, allowed) in [("1e-3", true), ("0", false), ("nan", false), ("2", false)] {
            assert_eq!(tick(text).is_ok(), allowed, "{text}");
        }
    }
}
