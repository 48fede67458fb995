//! Balls on a ring that push each other, each answering a force in proportion: the ring falls into rows at its open gaps.

use super::isotonic::pool_adjacent_violators;

/// Speeds, and forces between each ball and the next one ahead, the last with the first.
///
/// Balls stand rear to front; `open[j]` says that ball `j` has a gap ahead. A ball pushed by `F` from behind and by `F'` from ahead moves at
/// `unforced + compliance (F - F')`. Where no gap is left, all balls have one speed, and the forces are those of which the least is zero.
pub(crate) fn pool_ring(
    unforced: &[f64],
    compliance: &[f64],
    open: &[bool],
) -> (Vec<f64>, Vec<f64>) {
    let n = unforced.len();
    let Some(break_after) = open.iter().position(|open| *open) else {
        return closed(unforced, compliance);
    };
    let (mut speeds, mut forces) = (vec![0.0; n], vec![0.0; n]);
    let mut row: Vec<usize> = Vec::with_capacity(n);
    for place in break_after + 1..=break_after + n {
        let ball = place % n;
        row.push(ball);
        if open[ball] {
            let of = |values: &[f64]| row.iter().map(|j| values[*j]).collect::<Vec<_>>();
            let (row_speeds, row_forces) = pool_adjacent_violators(&of(unforced), &of(compliance));
            for (j, speed) in row.iter().zip(&row_speeds) {
                speeds[*j] = *speed;
            }
            for (j, force) in row.iter().zip(&row_forces) {
                forces[*j] = *force;
            }
            row.clear();
        }
    }
    (speeds, forces)
}

fn closed(unforced: &[f64], compliance: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let weight: f64 = compliance.iter().map(|y| 1.0 / y).sum();
    let moment: f64 = unforced.iter().zip(compliance).map(|(v, y)| v / y).sum();
    let speed = moment / weight;
    let mut force = 0.0;
    let sums: Vec<f64> = unforced
        .iter()
        .zip(compliance)
        .map(|(v, y)| {
            force += (v - speed) / y;
            force
        })
        .collect();
    let least = sums.iter().copied().fold(f64::INFINITY, f64::min);
    let forces = sums.iter().map(|force| force - least).collect();
    (vec![speed; unforced.len()], forces)
}

#[cfg(test)]
mod tests {
    use super::pool_ring;

    #[test]
    fn any_gap_breaks_the_ring() {
        let unforced = [0.3, 0.1, 0.5, 0.2, 0.4];
        let compliance = [1.0, 2.0, 0.5, 1.0, 3.0];
        let open = [false, false, true, false, true];
        let (speeds, forces) = pool_ring(&unforced, &compliance, &open);
        for turn in 0..5 {
            let of = |values: [f64; 5]| std::array::from_fn::<_, 5, _>(|j| values[(j + turn) % 5]);
            let turned = std::array::from_fn::<_, 5, _>(|j| open[(j + turn) % 5]);
            let (there, pushes) = pool_ring(&of(unforced), &of(compliance), &turned);
            for j in 0..5 {
                assert_eq!(there[j], speeds[(j + turn) % 5]);
                assert_eq!(pushes[j], forces[(j + turn) % 5]);
            }
        }
        assert!(forces[0] > 0.0 && speeds[0] == speeds[1] && forces[2..] == [0.0; 3]);
        for j in 0..5 {
            let net = forces[(j + 4) % 5] - forces[j];
            assert!((unforced[j] + compliance[j] * net - speeds[j]).abs() < 1e-15);
        }
    }

    #[test]
    fn without_a_gap_all_balls_have_one_speed() {
        let (unforced, compliance) = ([0.3, 0.1, 0.5], [1.0, 2.0, 0.5]);
        let (speeds, forces) = pool_ring(&unforced, &compliance, &[false; 3]);
        assert_eq!(forces.iter().copied().fold(f64::INFINITY, f64::min), 0.0);
        for j in 0..3 {
            let net = forces[(j + 2) % 3] - forces[j];
            assert!((unforced[j] + compliance[j] * net - speeds[j]).abs() < 1e-15);
        }
    }
}
