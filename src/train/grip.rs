//! What friction between balls takes off the forces from ball to ball.

/// `r`: the net push that a ball needs in addition because its neighbours rub on it, over the sum of their forces.
///
/// ```text
/// F_behind - F_ahead = Z (v - u) + r (F_behind + F_ahead)
/// ```
///
/// With `k = (1 - r)/(1 + r)` and the impedance `Z' = Z/(1 + r)` that is `k F_behind - F_ahead = Z' (v - u)`: the train of balls that do not rub,
/// but for a factor from ball to ball. Weighed by the product of the factors of all balls ahead, the net pushes on a cluster add up to
/// zero as without friction, so that clusters are joined as ever.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grip {
    transmitted: f32,
    per_growth: f32,
}

/// Largest size of `r`: with it a force falls or grows by 1.9 from ball to ball.
const LARGEST_GRIP: f32 = 0.3;

impl Grip {
    /// Of this `r`, limited to [`LARGEST_GRIP`] in size.
    #[inline(always)]
    pub(super) fn within(grip: f32) -> Self {
        let grip = limited_grip(grip);
        let per_growth = 1.0 / (1.0 + grip);
        Self {
            transmitted: (1.0 - grip) * per_growth,
            per_growth,
        }
    }

    /// `k`: part of the force behind the ball that the ball in front feels.
    #[inline(always)]
    pub(super) const fn transmitted(&self) -> f32 {
        self.transmitted
    }

    /// Factor of the impedance of a ball on which its neighbours rub.
    #[inline(always)]
    pub(super) const fn of_impedance(&self) -> f32 {
        self.per_growth
    }
}

/// This `r`, or the largest in its direction. Not `clamp`, which keeps a panic for bounds that are not ordered.
#[inline(always)]
pub(crate) fn limited_grip(grip: f32) -> f32 {
    if grip > LARGEST_GRIP {
        LARGEST_GRIP
    } else if grip > -LARGEST_GRIP {
        grip
    } else {
        -LARGEST_GRIP
    }
}

#[cfg(test)]
mod tests {
    use super::super::losses::{Losses, RubbedBall};
    use super::super::press::Press;

    const BALLS: usize = 9;

    /// Numbers between 0 and 1, the same in every run.
    fn random(seed: &mut u32) -> f32 {
        *seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (*seed >> 8) as f32 / 16_777_216.0
    }

    /// What was solved meets its conditions: each ball's push, no pull, none that overtakes, and no force where balls part.
    #[test]
    fn rubbing_balls_are_in_balance() {
        // An interpreter takes its time.
        let rounds = if cfg!(miri) { 20 } else { 2_000 };
        let mut seed = 1;
        let mut pressing = 0;
        for round in 0..rounds {
            let free: [f32; BALLS] = core::array::from_fn(|_| 0.1 * random(&mut seed) - 0.05);
            let impedance: [f32; BALLS] =
                core::array::from_fn(|_| 200.0 + 800.0 * random(&mut seed));
            let mut room: [f32; BALLS] = core::array::from_fn(|_| {
                let room = 0.03 * random(&mut seed) - 0.02;
                if room > 0.0 { room } else { 0.0 }
            });
            // A ring keeps a gap somewhere, and so does a row.
            room[round % BALLS] = if round % 2 == 0 { f32::INFINITY } else { 0.08 };
            let grip: [f32; BALLS] = core::array::from_fn(|_| 0.6 * random(&mut seed) - 0.3);
            let mut press = Press::<BALLS>::new();
            let balls: [RubbedBall; BALLS] = core::array::from_fn(|j| RubbedBall {
                speed: free[j],
                impedance: impedance[j],
                grip: grip[j],
                ..RubbedBall::default()
            });
            assert!(
                press
                    .solve_rubbing(&balls, &room, &Losses::default())
                    .is_some()
            );
            let forces: [f32; BALLS] = core::array::from_fn(|j| press.forces().nth(j).unwrap());
            let speeds: [f32; BALLS] = core::array::from_fn(|j| press.speeds().nth(j).unwrap());
            let largest = forces.iter().copied().fold(0.0, f32::max);
            for j in 0..BALLS {
                let behind = forces[(j + BALLS - 1) % BALLS];
                let push = behind - forces[j];
                let needed = impedance[j] * (speeds[j] - free[j]) + grip[j] * (behind + forces[j]);
                // Roundings of the forces, 1e-6 of the largest, and of the speeds, 1e-8 of up to 0.1 times 1000 N.
                let left = (push - needed).abs();
                assert!(
                    left <= 1e-5 * largest + 2e-5,
                    "{round} {j}: {push} {needed}"
                );
                let parts = speeds[(j + 1) % BALLS] - speeds[j] + room[j];
                assert!(forces[j] >= 0.0 && parts > -1e-7, "{round} {j}: {parts}");
                assert!(
                    forces[j] <= 1e-6 * largest || parts < 1e-7,
                    "{round} {j}: {parts}"
                );
                pressing += usize::from(forces[j] > 0.0);
            }
        }
        assert!(pressing > rounds * BALLS / 3, "{pressing}");
    }

    /// Without friction between balls the answer is that of balls that do not rub, to the bit but for one rounding of each number.
    #[test]
    fn no_grip_is_no_friction() {
        let free = [0.02, 0.01, 0.03, -0.01, 0.0, 0.02, -0.03, 0.01, -0.02];
        let (mut smooth, mut rubbing) = (Press::<BALLS>::new(), Press::<BALLS>::new());
        let room = [0.0, 0.0, 1e-3, 0.0, 0.0, 0.0, 0.0, 2e-3, f32::INFINITY];
        assert!(smooth.solve(&free, &[500.0; BALLS], &room));
        let balls = free.map(|speed| RubbedBall {
            speed,
            impedance: 500.0,
            ..RubbedBall::default()
        });
        let found = rubbing.solve_rubbing(&balls, &room, &Losses::default());
        assert!(found.is_some());
        for (one, other) in smooth.forces().zip(rubbing.forces()) {
            assert!((one - other).abs() < 1e-5, "{one} {other}");
        }
    }
}
