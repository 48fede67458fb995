//! What a trace of a screw can tell, before anything is fitted.

use crate::estimator::fit::rms;
use crate::estimator::record::Smoothed;
use crate::estimator::stretches::of_position;
use crate::trace::Trace;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evidence {
    /// Samples of motion forward and backward over all.
    pub directions: [f64; 2],
    /// Speed that a tenth of the moving samples stay below, and the one that a tenth exceed, rad/s.
    pub speeds: [f64; 2],
    pub reversals: usize,
    /// Distance between the outermost angles, rad.
    pub range: f64,
    /// Acceleration, rms, over its noise.
    pub acceleration: f64,
    /// Least and largest load, N; none where it was not measured.
    pub load: Option<[f64; 2]>,
    /// Coldest and warmest temperature, K; none where it was not measured.
    pub temperature: Option<[f64; 2]>,
}

/// Speeds that count as motion, over the noise of the speed.
const MOVES: f64 = 4.0;

impl Evidence {
    pub fn of(trace: &Trace, motion: &Smoothed) -> Self {
        let [speed_noise, acceleration_noise] = motion.noise;
        let samples = motion.speed.len().max(1) as f64;
        let share = |direction: f64| {
            let speeds = motion.speed.iter();
            let moving = speeds.filter(|&speed| direction * speed > MOVES * speed_noise);
            moving.count() as f64 / samples
        };
        let sizes = motion.speed.iter().map(|speed| speed.abs());
        let mut sizes: Vec<f64> = sizes.filter(|size| *size > MOVES * speed_noise).collect();
        sizes.sort_by(f64::total_cmp);
        let tenth = |place: usize| sizes.get(sizes.len() * place / 10).copied().unwrap_or(0.0);
        Self {
            directions: [share(1.0), share(-1.0)],
            speeds: [tenth(1), tenth(9)],
            // Back by some steps of the sensor.
            reversals: reversals(&motion.position, 3.0 * trace.resolution),
            range: ends(&motion.position).map_or(0.0, |[low, high]| high - low),
            acceleration: rms(&motion.acceleration) / acceleration_noise.max(f64::MIN_POSITIVE),
            load: trace.load.as_deref().and_then(ends),
            temperature: trace.temperature.as_deref().and_then(ends),
        }
    }

    pub fn both_ways(&self) -> bool {
        self.directions.iter().all(|share| *share > 0.05)
    }

    pub fn largest_load(&self) -> f64 {
        self.load.map_or(0.0, |[low, high]| high.max(-low))
    }

    /// Range of the load's size over its largest.
    pub fn load_variation(&self) -> f64 {
        match self.load {
            Some([low, high]) if high.max(-low) > 0.0 => {
                let least = if low * high <= 0.0 {
                    0.0
                } else {
                    low.abs().min(high.abs())
                };
                1.0 - least / high.max(-low)
            }
            _ => 0.0,
        }
    }

    pub fn temperature_range(&self) -> f64 {
        self.temperature.map_or(0.0, |[low, high]| high - low)
    }
}

fn ends(list: &[f64]) -> Option<[f64; 2]> {
    let first = *list.first()?;
    Some(list.iter().fold([first; 2], |[low, high], &value| {
        [low.min(value), high.max(value)]
    }))
}

fn reversals(path: &[f64], distance: f64) -> usize {
    let stretches = of_position(path, distance, path.len());
    let turns = stretches
        .windows(2)
        .filter(|pair| pair[0].turn != pair[1].turn);
    turns.count()
}
