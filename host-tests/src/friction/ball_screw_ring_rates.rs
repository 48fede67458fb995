//! How speeds, forces and states of a ring of balls change from instant to instant, and what is expected of the next one.

use super::ball_screw_placed::BallState;
use super::ball_screw_ring_solve::Settled;

/// Change of the load over which speeds are not taken to change as they did before.
const SUDDEN: f64 = 0.05;
/// Travel of the nut that tells how speeds change, rad: their rounding over it is 1e-6.
const TELLING: f64 = 1e-7;

pub(crate) struct Last {
    pub settled: Settled,
    pub direction: f64,
    pub axial_load: f64,
    /// Axial load of every ball, N; 0 where it carries none.
    pub loads: Vec<f64>,
    /// Travel of the nut since then, rad.
    pub travel: f64,
}

/// Changes per rad of the nut.
#[derive(Clone)]
pub(crate) struct Rates {
    pub speeds: Vec<f64>,
    pub forces: Vec<f64>,
    pub states: Vec<Option<BallState>>,
}

impl Last {
    pub fn expected(&self, rates: &Rates) -> (Vec<Option<BallState>>, Vec<f64>) {
        let states = self
            .settled
            .states
            .iter()
            .zip(&rates.states)
            .map(|(state, rate)| {
                let state = (*state)?;
                let Some(rate) = rate else { return Some(state) };
                Some(BallState::new(
                    state.place + rate.place * self.travel,
                    state.motion + rate.motion * self.travel,
                    state.force + rate.force * self.travel,
                ))
            })
            .collect();
        let forces = self
            .settled
            .forces
            .iter()
            .zip(&rates.forces)
            .map(|(force, rate)| (force + rate * self.travel).max(0.0))
            .collect();
        (states, forces)
    }

    /// How speeds and forces have changed since the last solution, of balls that still press as they did and carry about the load that
    /// they did. Balls that have met go on with the mean change of those that they join. A ball that has come under load, or out of it, has
    /// another speed at once: how it changes is not known before the next solution.
    pub fn rates(&self, now: &Self, before: &Rates) -> Rates {
        let n = now.loads.len();
        let mut rates = Rates::none(n);
        let sudden = |now: f64, before: f64| (now - before).abs() > SUDDEN * before.abs();
        if self.direction != now.direction
            || sudden(now.axial_load, self.axial_load)
            || !(self.travel > 0.0)
        {
            return rates;
        }
        // On the run-in a load changes with the place, as much as it is of that of the others.
        let largest = now
            .loads
            .iter()
            .fold(0.0, |most: f64, load| most.max(load.abs()));
        let jumps = |ball: &usize| {
            let (now, before) = (now.loads[*ball], self.loads[*ball]);
            (now == 0.0) != (before == 0.0) || (now - before).abs() > SUDDEN * largest
        };
        let kept = |ball: &usize| {
            if jumps(ball) {
                0.0
            } else {
                before.speeds[*ball]
            }
        };
        if self.travel < TELLING {
            rates.clone_from(before);
            for (ball, rate) in rates.speeds.iter_mut().enumerate() {
                *rate = kept(&ball);
            }
            return rates;
        }
        let (now, then) = (&now.settled, &self.settled);
        for cluster in clusters(&now.forces) {
            let pairs = |inside: usize| cluster[..inside].iter();
            let ends = [(cluster[0] + n - 1) % n, cluster[cluster.len() - 1]];
            let pressed = |pair: &usize| then.forces[*pair] > 0.0;
            let alike = cluster.len() == n
                || pairs(cluster.len() - 1).all(pressed) && !ends.iter().any(pressed);
            if alike && !cluster.iter().any(jumps) {
                for ball in &cluster {
                    rates.speeds[*ball] = (now.speeds[*ball] - then.speeds[*ball]) / self.travel;
                    rates.forces[*ball] = (now.forces[*ball] - then.forces[*ball]) / self.travel;
                    rates.states[*ball] =
                        difference(now.states[*ball], then.states[*ball], self.travel);
                }
            } else {
                let sum: f64 = cluster.iter().map(kept).sum();
                for ball in &cluster {
                    rates.speeds[*ball] = sum / cluster.len() as f64;
                }
            }
        }
        rates
    }
}

impl Rates {
    pub fn none(balls: usize) -> Self {
        Self {
            speeds: vec![0.0; balls],
            forces: vec![0.0; balls],
            states: vec![None; balls],
        }
    }
}

fn difference(now: Option<BallState>, before: Option<BallState>, travel: f64) -> Option<BallState> {
    let (now, before) = (now?, before?);
    Some(BallState::new(
        (now.place - before.place) / travel,
        (now.motion - before.motion) / travel,
        (now.force - before.force) / travel,
    ))
}

/// Balls that press on each other, in the order of the track; `forces[j]` acts between ball `j` and the next.
fn clusters(forces: &[f64]) -> Vec<Vec<usize>> {
    let n = forces.len();
    let Some(end) = forces.iter().position(|force| !(*force > 0.0)) else {
        return vec![(0..n).collect()];
    };
    let mut all = Vec::new();
    let mut cluster = Vec::new();
    for place in end + 1..=end + n {
        let ball = place % n;
        cluster.push(ball);
        if !(forces[ball] > 0.0) {
            all.push(std::mem::take(&mut cluster));
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::clusters;

    #[test]
    fn clusters_go_round() {
        assert_eq!(
            clusters(&[1.0, 0.0, 0.0, 2.0]),
            vec![vec![2], vec![3, 0, 1]]
        );
        assert_eq!(clusters(&[1.0; 3]).len(), 1);
    }
}
