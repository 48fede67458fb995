//! Where a motion has one direction, as its sensor tells it.

/// A stretch of one direction, in samples: from the first that is a step beyond the turn to the last a step before the next one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    pub first: usize,
    pub last: usize,
    /// 1 or -1.
    pub direction: f64,
    /// Place of the turn before it, rad or m.
    pub turn: f64,
}

/// A sample at which the position has gained another step.
struct Mark {
    sample: usize,
    direction: f64,
    after_turn: bool,
    turn: f64,
}

/// Stretches of a position. Progress of `step` must come within `longest` samples: between two steps that come later the drive may stand.
pub fn of_position(position: &[f64], step: f64, longest: usize) -> Vec<Stretch> {
    let marks = marks(position, step);
    let mut found = Vec::new();
    let mut from = 0;
    while from < marks.len() {
        let mut to = from;
        while to + 1 < marks.len()
            && !marks[to + 1].after_turn
            && marks[to + 1].sample - marks[to].sample <= longest
        {
            to += 1;
        }
        if to > from {
            found.push(Stretch {
                first: marks[from].sample,
                last: marks[to].sample,
                direction: marks[from].direction,
                turn: marks[from].turn,
            });
        }
        from = to + 1;
    }
    found
}

fn marks(position: &[f64], step: f64) -> Vec<Mark> {
    let mut marks = Vec::new();
    let Some(&start) = position.first() else {
        return marks;
    };
    // Outermost places before the first direction is known; last mark, farthest place and last turn.
    let (mut low, mut high) = (start, start);
    let (mut last, mut farthest, mut turn) = (start, start, start);
    let mut direction = 0.0;
    for (sample, &place) in position.iter().enumerate().skip(1) {
        let mut mark = |direction: f64, after_turn: bool, turn: f64| {
            marks.push(Mark {
                sample,
                direction,
                after_turn,
                turn,
            });
        };
        if direction == 0.0 {
            (low, high) = (low.min(place), high.max(place));
            if place - low >= step && place > low {
                (direction, turn) = (1.0, low);
            } else if high - place >= step && place < high {
                (direction, turn) = (-1.0, high);
            } else {
                continue;
            }
            (last, farthest) = (place, place);
            mark(direction, true, turn);
        } else if direction * (place - last) >= step && place != last {
            (last, farthest) = (place, place);
            mark(direction, false, turn);
        } else {
            if direction * (place - farthest) > 0.0 {
                farthest = place;
            }
            if direction * (farthest - place) >= step && place != farthest {
                direction = -direction;
                turn = farthest;
                (last, farthest) = (place, place);
                mark(direction, true, turn);
            }
        }
    }
    marks
}

/// Stretches of a measured speed that is beyond `least`, with the places of its integral `path`. Its sign is that of a short mean, `smoothed`.
pub fn of_speed(speed: &[f64], smoothed: &[f64], path: &[f64], least: f64) -> Vec<Stretch> {
    let sign = |sample: usize| {
        if speed[sample].abs() > least && smoothed[sample] * speed[sample] > 0.0 {
            speed[sample].signum()
        } else {
            0.0
        }
    };
    let mut found = Vec::new();
    let mut from = 0;
    while from < speed.len() {
        let direction = sign(from);
        let mut to = from;
        while to + 1 < speed.len() && sign(to + 1) == direction {
            to += 1;
        }
        if direction != 0.0 && to > from {
            found.push(Stretch {
                first: from,
                last: to,
                direction,
                turn: path[from],
            });
        }
        from = to + 1;
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rests_and_turns_end_a_stretch() {
        let mut position: Vec<f64> = (0..50).map(f64::from).collect();
        position.extend([49.0; 30]);
        position.extend((50..100).map(f64::from));
        position.extend((0..100).rev().map(f64::from));
        let found = of_position(&position, 2.0, 5);
        let ends: Vec<_> = found
            .iter()
            .map(|s| (s.first, s.last, s.direction))
            .collect();
        assert_eq!(ends, [(2, 48, 1.0), (80, 128, 1.0), (132, 228, -1.0)]);
        assert_eq!(found[2].turn, 99.0);
        // Noise within a step has no direction.
        let noise: Vec<f64> = (0..100).map(|k| f64::from(k % 2)).collect();
        assert!(of_position(&noise, 2.0, 5).is_empty());
        assert!(of_position(&[], 2.0, 5).is_empty());
        // A signal that never changes, with no step of its own.
        assert!(of_position(&[1.0; 9], 0.0, 5).is_empty());
    }
}
