//! Noise of an encoder, and of a speed that is none.

use std::f64::consts::TAU;

use epas_reference::presliding::Limits;
use epas_reference::presliding::answers::Tick;
use rand_distr::{Distribution, Normal};
use rand_pcg::Pcg64;

use super::paths::{Course, STREAM};
use super::{Law, torques};
use epas_page::failure::Failure;

/// One count of a motor's encoder of 14 bits behind a ratio of 2.5, rad at the nut.
pub const COUNT: f64 = TAU / 16_384.0 / 2.5;

/// Noise of a speed at rest, rms, rad/s.
pub const SPEED_NOISE: f64 = 0.05;

pub const TICK: f64 = 1e-3;

/// Ticks of the run at rest: 4.9 s.
pub const TICKS: usize = 4900;

/// Rms error of the torque because angles are counts, over the limit: random strokes up to two breakaway angles long.
pub fn error_of_counts(
    make: impl Fn() -> Result<Box<dyn Law>, Failure>,
    breakaway: f64,
) -> Result<f64, Failure> {
    let course = Course::random(3, 2.0, 1.0, None);
    let count = COUNT / breakaway;
    let read = Course {
        angle: course
            .angle
            .iter()
            .map(|angle| (angle / count).round() * count)
            .collect(),
        load: None,
    };
    let found = torques(make()?.as_mut(), &read.path());
    let truth = torques(make()?.as_mut(), &course.path());
    Ok(super::paths::rms(&found, &truth))
}

#[derive(Clone, Debug, PartialEq)]
pub struct AtRest {
    pub changes: usize,
    /// Largest step of the torque from one tick to the next, over the limit.
    pub largest_step: f64,
    /// Torques over the limit, tick by tick.
    pub torques: Vec<f64>,
}

impl AtRest {
    fn new(torques: Vec<f64>, regimes: &[i32]) -> Self {
        let steps = torques.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        Self {
            changes: regimes.windows(2).filter(|pair| pair[0] != pair[1]).count(),
            largest_step: steps.fold(0.0, f64::max),
            torques,
        }
    }
}

fn noise(size: f64) -> Result<Vec<f64>, Failure> {
    let normal = Normal::new(0.0, size)?;
    Ok(normal
        .sample_iter(Pcg64::new(11, STREAM))
        .take(TICKS)
        .collect())
}

/// Friction that follows speed, `w / sqrt(w^2 + w_s^2)`, standing below the reversal speed `w_s`.
pub fn by_speed(reversal_speed: f64) -> Result<AtRest, Failure> {
    let speeds = noise(SPEED_NOISE)?;
    let torques = speeds
        .iter()
        .map(|speed| speed / speed.hypot(reversal_speed))
        .collect();
    let regimes: Vec<i32> = speeds
        .iter()
        .map(|speed| {
            if speed.abs() < reversal_speed {
                0
            } else {
                speed.signum() as i32
            }
        })
        .collect();
    Ok(AtRest::new(torques, &regimes))
}

/// Friction that follows the angle: the nut rests where a count changes, at half of its friction; the same noise is on the angle before it is counted.
/// It stands as long as a share sticks.
pub fn by_angle(law: &mut dyn Law, breakaway: f64) -> Result<AtRest, Failure> {
    let tick = |turn: f64| Tick {
        turn: turn / breakaway,
        limits: Limits::UNIT,
        load: 1.0,
    };
    let mut last = 0.0;
    let mut follow = |angle: f64| {
        let read = (angle / COUNT).round() * COUNT;
        let torque = law.follow(&tick(read - last));
        last = read;
        torque
    };
    // Half of the limit is reached at 0.37 of the breakaway angle.
    let rest = ((0.37 * breakaway / COUNT).round() + 0.5) * COUNT;
    follow(rest);
    // A speed taken from two readings has the noise of both.
    let angles = noise(SPEED_NOISE * TICK / std::f64::consts::SQRT_2)?;
    let torques: Vec<f64> = angles.iter().map(|angle| follow(rest + angle)).collect();
    let regimes: Vec<i32> = torques
        .iter()
        .map(|torque| {
            if torque.abs() < 0.99 {
                0
            } else {
                torque.signum() as i32
            }
        })
        .collect();
    Ok(AtRest::new(torques, &regimes))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::peers::candidates::ours;

    #[test]
    fn noise_changes_no_regime_by_angle() {
        let law = &ours()[2];
        for breakaway in [1e-3, 2e-3, 5e-3] {
            let found = by_angle(law.start().unwrap().as_mut(), breakaway).unwrap();
            assert_eq!(found.changes, 0);
            // At most the encoder's own step: one count times the first stiffness.
            assert!(found.largest_step > 0.0);
            assert!(
                found.largest_step <= 1.5 * COUNT / breakaway,
                "{}",
                found.largest_step
            );
        }
        // By speed, at a reversal speed of twice the noise: 457 changes in this run, and steps from limit to limit.
        let found = by_speed(0.1).unwrap();
        assert!((350..600).contains(&found.changes), "{}", found.changes);
        assert!(found.largest_step > 1.0);
    }

    /// Known: 0.054 to 0.063 at 1 mrad, 0.02 to 0.03 at 2, 0.01 at 5. Over these strokes, which turn more often, 0.097, 0.032 and 0.018.
    #[test]
    fn counts_matter_below_a_breakaway_angle_of_two_milliradians() {
        let law = &ours()[2];
        for (breakaway, low, high) in [(1e-3, 0.05, 0.11), (2e-3, 0.02, 0.04), (5e-3, 0.01, 0.02)] {
            let found = error_of_counts(|| law.start(), breakaway).unwrap();
            assert!((low..high).contains(&found), "{breakaway}: {found}");
        }
    }
}
