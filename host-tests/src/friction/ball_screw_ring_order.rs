//! Who stands ahead of whom on a ring of balls.

/// Balls on a ring, numbered along the track; pair `j` is ball `j` and the next one, the last with the first.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Neighbours {
    pub balls: usize,
    /// 1 where they orbit along the track's numbers, -1 against them.
    pub direction: f64,
}

impl Neighbours {
    /// Balls in the order of motion, rear to front.
    pub fn order(&self) -> Vec<usize> {
        let n = self.balls;
        if self.direction > 0.0 {
            (0..n).collect()
        } else {
            (0..n).rev().collect()
        }
    }

    pub fn pair_ahead(&self, ball: usize) -> usize {
        let n = self.balls;
        if self.direction > 0.0 {
            ball
        } else {
            (ball + n - 1) % n
        }
    }

    pub fn ahead(&self, ball: usize) -> usize {
        let n = self.balls;
        if self.direction > 0.0 {
            (ball + 1) % n
        } else {
            (ball + n - 1) % n
        }
    }

    pub fn net(&self, forces: &[f64]) -> Vec<f64> {
        let mut nets = vec![0.0; forces.len()];
        for j in 0..forces.len() {
            let force = forces[self.pair_ahead(j)];
            nets[j] -= force;
            nets[self.ahead(j)] += force;
        }
        nets
    }

    /// Rows of balls that press, rear to front. A ring of which all pairs press is cut at its first ball.
    pub fn rows_of(&self, pressing: &[bool]) -> Vec<Vec<usize>> {
        let order = self.order();
        let n = order.len();
        let presses = |ball: usize| pressing[self.pair_ahead(ball)];
        let end = order
            .iter()
            .position(|ball| !presses(*ball))
            .unwrap_or(n - 1);
        let mut rows = Vec::new();
        let mut row = Vec::new();
        for at in end + 1..=end + n {
            let ball = order[at % n];
            row.push(ball);
            if !presses(ball) || at == end + n {
                rows.push(std::mem::take(&mut row));
            }
        }
        rows
    }
}
