//! Paths over which laws are compared; angles over the breakaway angle.

use epas_reference::presliding::Limits;
use epas_reference::presliding::answers::Path;
use epas_reference::presliding::backbone::Backbone;
use epas_reference::presliding::masing::Masing;
use rand::RngExt;
use rand_pcg::Pcg64;

/// Stream of the generator: its numbers are the same on every machine and in every version.
pub const STREAM: u128 = 0xa02_bdbf_7bb3_c0a7;

#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    pub angle: Vec<f64>,
    /// Loads, over the reference load.
    pub load: Option<Vec<f64>>,
}

impl Course {
    /// The path, limits in both directions the load.
    pub fn path(&self) -> Path<'_> {
        Path {
            angle: &self.angle,
            load: self.load.as_deref(),
            ratio: Limits::UNIT,
        }
    }

    /// Straight strokes from one value to the next, in `ticks` each.
    pub fn strokes(points: &[f64], ticks: usize) -> Self {
        Self {
            angle: straight(points, ticks),
            load: None,
        }
    }

    /// A first stroke to `amplitude`, then whole cycles between both ends, a quarter in `ticks`.
    pub fn cycles(amplitude: f64, cycles: usize, ticks: usize) -> Self {
        let mut points = vec![0.0, amplitude];
        for _ in 0..cycles {
            points.extend([0.0, -amplitude, 0.0, amplitude]);
        }
        Self::strokes(&points, ticks)
    }

    /// Strokes to and fro of random length up to `longest`, kept within `bound` on both sides; where `loads` are given, the load goes straight between random
    /// values of that range, each for ten strokes.
    pub fn random(seed: u64, longest: f64, bound: f64, loads: Option<(f64, f64)>) -> Self {
        const STROKES: usize = 200;
        const TICKS: usize = 40;
        let mut random = Pcg64::new(seed.into(), STREAM);
        let mut points = vec![0.0];
        let (mut place, mut direction) = (0.0_f64, 1.0);
        for _ in 0..STROKES {
            place += direction * random.random_range(0.0..=longest);
            place = place.clamp(-bound, bound);
            points.push(place);
            direction = -direction;
        }
        let angle = straight(&points, TICKS);
        let load = loads.map(|(least, most)| {
            const EVERY: usize = 10 * TICKS;
            let count = angle.len().div_ceil(EVERY) + 1;
            let points: Vec<f64> = (0..count)
                .map(|_| random.random_range(least..=most))
                .collect();
            let mut load = straight(&points, EVERY);
            load.truncate(angle.len());
            load
        });
        Self { angle, load }
    }
}

fn straight(points: &[f64], ticks: usize) -> Vec<f64> {
    let mut values: Vec<f64> = points.iter().take(1).copied().collect();
    for (from, to) in points.iter().zip(points.iter().skip(1)) {
        let part = |tick: usize| from + (to - from) * tick as f64 / ticks as f64;
        values.extend((1..ticks).map(part));
        values.push(*to);
    }
    values
}

/// Amplitudes of the loops, over the breakaway angle.
pub const AMPLITUDES: [f64; 4] = [0.3, 0.7, 1.0, 3.0];

/// Exact torques of slip across over a path under constant limits.
pub fn exact(angle: &[f64]) -> Vec<f64> {
    let mut exact = Masing::new(Backbone::Slip, Limits::UNIT);
    angle.iter().map(|angle| exact.follow(*angle)).collect()
}

pub fn rms(found: &[f64], exact: &[f64]) -> f64 {
    let squares = found
        .iter()
        .zip(exact)
        .map(|(one, other)| (one - other).powi(2));
    (squares.sum::<f64>() / exact.len() as f64).sqrt()
}
