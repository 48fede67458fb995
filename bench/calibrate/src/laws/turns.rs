//! Directions of a motion that is known: where it turns round.
//!
//! A motion that comes back by no more than a few steps of its sensor has not turned. One that comes back by more has turned at its
//! farthest place, and not where it was seen to: friction that turns a few steps late pushes where the acceleration is largest, and after a
//! stop it is missing for longer the slower the drive sets off. It counts as inertia and takes from the viscous friction.

use std::ops::Range;

/// Direction at every sample, -1 to 1: that of the speed at a turning point itself. What comes back by less than `dead` is no turn; 0 where
/// nothing moves that far.
pub fn directions(position: &[f64], speed: &[f64], dead: f64) -> Vec<f64> {
    let mut directions = vec![0.0; position.len()];
    let Some(first) = position.first() else {
        return directions;
    };
    let (mut low, mut high) = ((0, *first), (0, *first));
    // The farthest place in the present direction; that direction; where it began.
    let (mut far, mut direction, mut begin) = ((0, *first), 0.0, 0);
    for (sample, place) in position.iter().copied().enumerate() {
        if direction == 0.0 {
            if place < low.1 {
                low = (sample, place);
            }
            if place > high.1 {
                high = (sample, place);
            }
            if place - low.1 > dead {
                (direction, far) = (1.0, (sample, place));
            } else if high.1 - place > dead {
                (direction, far) = (-1.0, (sample, place));
            }
        } else if (place - far.1) * direction >= 0.0 {
            far = (sample, place);
        } else if (far.1 - place) * direction > dead {
            fill(&mut directions, begin..far.0, direction);
            directions[far.0] = speed.get(far.0).map_or(0.0, |speed| sign(*speed));
            (begin, direction) = (far.0 + 1, -direction);
            far = (sample, place);
        }
    }
    fill(&mut directions, begin..position.len(), direction);
    directions
}

/// Stretches in which a motion has not come farther than `reach` since it turned round, in order.
pub fn near_turns(directions: &[f64], position: &[f64], reach: f64) -> Vec<Range<usize>> {
    let mut stretches = Vec::new();
    let mut begin = 0;
    for same in directions.chunk_by(|one, other| one == other) {
        let places = position.get(begin..begin + same.len()).unwrap_or_default();
        let first = places.first().copied().unwrap_or(0.0);
        let near = places
            .iter()
            .position(|place| (place - first).abs() > reach);
        stretches.push(begin..begin + near.unwrap_or(same.len()));
        begin += same.len();
    }
    stretches
}

fn fill(directions: &mut [f64], samples: Range<usize>, direction: f64) {
    if let Some(directions) = directions.get_mut(samples) {
        directions.fill(direction);
    }
}

fn sign(value: f64) -> f64 {
    if value == 0.0 { 0.0 } else { value.signum() }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// Of a sine with rounding the direction is the sine's, at every sample: no step of the sensor turns it round.
    #[test]
    fn rounding_turns_nothing_round() {
        let time = |sample: usize| 1e-3 * sample as f64 + 2.5e-4;
        let step = 1e-2;
        let [position, speed]: [Vec<f64>; 2] = [f64::sin as fn(f64) -> f64, f64::cos]
            .map(|wave| (0..4000).map(|k| wave(TAU * time(k))).collect());
        let exact = directions(&position, &speed, 2.0 * step);
        for (found, speed) in exact.iter().zip(&speed) {
            assert_eq!(*found, speed.signum());
        }
        let rounded: Vec<f64> = position
            .iter()
            .map(|place| (place / step).round() * step)
            .collect();
        let found = directions(&rounded, &speed, 2.0 * step);
        // A step lasts for 45 ms at the turn: half of it is the uncertainty of each of eight turns.
        let wrong = found.iter().zip(&exact).filter(|(one, other)| one != other);
        assert!(wrong.count() <= 8 * 23);
        assert_eq!(
            directions(&[0.0, 0.1, 0.0], &[1.0, 0.0, -1.0], 0.2),
            [0.0; 3]
        );
        assert!(directions(&[], &[], 0.2).is_empty());
    }

    #[test]
    fn what_is_near_a_turn_is_found() {
        let position = [0.0, 1.0, 2.0, 3.0, 4.0, 3.0, 2.0, 1.0, 0.0];
        let speed = [1.0, 1.0, 1.0, 1.0, 0.0, -1.0, -1.0, -1.0, -1.0];
        let directions = directions(&position, &speed, 0.5);
        assert_eq!(
            directions,
            [1.0, 1.0, 1.0, 1.0, 0.0, -1.0, -1.0, -1.0, -1.0]
        );
        assert_eq!(near_turns(&directions, &position, 1.5), [0..2, 4..5, 5..7]);
        // A motion that never comes so far is near its turns throughout.
        assert_eq!(near_turns(&directions, &position, 9.0), [0..4, 4..5, 5..9]);
    }
}
