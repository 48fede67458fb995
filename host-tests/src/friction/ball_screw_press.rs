//! Which balls of a row press on each other: the regression of their free speeds by a rising sequence, every ball with its own law of speed
//! and force.

use std::ops::Range;

use super::ball_screw_placed::{Drive, PlacedBall, Solved};
use super::ball_screw_settle::settle;
use super::isotonic::pool_adjacent_violators;
use super::newton::root_between;
use crate::error::ReferenceError;

/// Change of the speeds over the nut's speed at which the row has settled: rounding of a speed a hundred times.
const SETTLED: f64 = 1e-14;
/// Newton's method on all forces at once takes a few steps, or does not end.
const STEPS: usize = 12;

/// Balls at the speeds and forces at which they press, from where they are `now`.
///
/// Newton's method: laws replaced by their tangents, tangents pooled. Where a ball's law bends too much for that (a race that sticks), by
/// pooling of the laws themselves, every cluster's speed found by false position between the speeds of the two that joined.
pub(crate) fn pressed(
    balls: &[PlacedBall<'_>],
    now: &[Solved],
) -> Result<Vec<Solved>, ReferenceError> {
    if let Some(found) = by_tangents(balls, now) {
        return Ok(found);
    }
    by_laws(balls, now)
}

fn by_tangents(balls: &[PlacedBall<'_>], now: &[Solved]) -> Option<Vec<Solved>> {
    let mut now = now.to_vec();
    for _ in 0..STEPS {
        let compliance: Vec<f64> = now.iter().map(|b| 1.0 / b.stiffness).collect();
        if compliance.iter().any(|y| !(*y > 0.0)) {
            return None;
        }
        let unforced: Vec<f64> = now
            .iter()
            .zip(&compliance)
            .map(|(b, y)| b.state.motion[0] - b.state.force * y)
            .collect();
        let (wanted, _) = pool_adjacent_violators(&unforced, &compliance);
        let mut change = 0.0_f64;
        for (index, (ball, solved)) in balls.iter().zip(&mut now).enumerate() {
            let with = |other: Option<usize>| {
                other.and_then(|other| wanted.get(other)) == Some(&wanted[index])
            };
            let drive = if with(index.checked_sub(1)) || with(Some(index + 1)) {
                Drive::Speed(wanted[index])
            } else {
                Drive::Force(0.0)
            };
            let before = solved.state.motion[0];
            *solved = settle(ball, drive, Some(&solved.state)).ok()?;
            change = change.max((solved.state.motion[0] - before).abs());
        }
        if change <= SETTLED {
            return Some(now);
        }
    }
    None
}

struct Cluster {
    balls: Range<usize>,
    speed: f64,
}

fn by_laws(balls: &[PlacedBall<'_>], now: &[Solved]) -> Result<Vec<Solved>, ReferenceError> {
    let mut now = now.to_vec();
    let mut clusters: Vec<Cluster> = Vec::with_capacity(balls.len());
    for (index, ball) in balls.iter().enumerate() {
        let start = now[index].state;
        now[index] = settle(ball, Drive::Force(0.0), Some(&start))?;
        clusters.push(Cluster {
            balls: index..index + 1,
            speed: now[index].state.motion[0],
        });
        while let [.., rear, front] = clusters.as_slice() {
            if rear.speed <= front.speed + SETTLED {
                break;
            }
            let range = rear.balls.start..front.balls.end;
            let between = (front.speed, rear.speed);
            let speed = joined(&balls[range.clone()], &mut now[range.clone()], between)?;
            clusters.truncate(clusters.len() - 2);
            clusters.push(Cluster {
                balls: range,
                speed,
            });
        }
    }
    Ok(now)
}

/// Speed at which the forces on a cluster add up to nothing.
fn joined(
    balls: &[PlacedBall<'_>],
    now: &mut [Solved],
    (slow, fast): (f64, f64),
) -> Result<f64, ReferenceError> {
    let load: f64 = balls.iter().map(|ball| ball.axial_load.abs()).sum();
    let mut failed = None;
    let root = root_between((slow, fast), (SETTLED, 1e-11 * load), |speed| {
        let mut sum = 0.0;
        for (ball, solved) in balls.iter().zip(now.iter_mut()) {
            match settle(ball, Drive::Speed(speed), Some(&solved.state)) {
                Ok(found) => {
                    sum += found.state.force;
                    *solved = found;
                }
                Err(error) => {
                    failed = Some(error);
                    return None;
                }
            }
        }
        Some(sum)
    });
    root.ok_or_else(|| failed.unwrap_or_else(|| ReferenceError::unbalanced(f64::NAN)))
}
