//! What one ball does under one load: polynomials in the deviations of the two grooves.

use crate::error::{Error, Range, attempt, in_range};
use crate::train::LARGEST_FREE_SPEED;

/// Powers of the two deviations: `1, s, n, s^2, s n, n^2`.
pub const POWERS: usize = 6;

/// Least and largest impedance over `mu W` that count.
pub(super) const IMPEDANCES: Range = Range::new(0.01, 1e3);

/// Largest torque over load, m, and its change with the speed, that count.
const LARGEST_ARM: f32 = 1.0;

/// Largest loss by a net push over its work.
pub const LARGEST_WORK: f32 = 4.0;

/// What one ball does under a load, all over `mu W` but the free speed and the work.
///
/// With the deviations `s` of the screw's and `n` of the nut's contact angles, each over its largest ([`BallLaw::deviations`](super::BallLaw::deviations)), and `x` the
/// ball's speed less its free speed:
///
/// ```text
/// free speed       u = u_0 + u_1 s + u_2 n + u_3 s^2 + u_4 s n + u_5 n^2
/// net push         P = mu W (z_0 + z_1 s + z_2 n) x
/// friction torque  T = mu W (t_0 + ... + t_5 n^2 + c x) + w P x v / 2
/// ```
///
/// with the nominal speed `v` against the nut, m per unit of nut speed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BallNumbers {
    /// Free speed less the nominal one, over the nominal speed against the nut: its powers of the deviations.
    pub free: [f32; POWERS],
    /// Impedance: the force that changes the speed by one; powers `1, s, n`.
    pub impedance: [f32; 3],
    /// Friction torque on the nut at the free speed, m.
    pub torque: [f32; POWERS],
    /// Change of the friction torque with the speed at the free speed, m.
    pub slope: f32,
    /// Loss by the net push over its work `P x v / 2`, 0 to 4: 1 where a push is in proportion to the speed, more where it saturates.
    pub work: f32,
}

/// What a ball does on its own in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct FreeMotion {
    /// Free speed less the nominal one, over the nominal speed against the nut.
    pub speed: f32,
    /// Impedance, N.
    pub impedance: f32,
    /// Friction torque on the nut at the free speed, N m per unit.
    pub torque: f32,
}

impl BallNumbers {
    /// A ball that loses nothing and holds nothing.
    pub const NONE: Self = Self {
        free: [0.0; POWERS],
        impedance: [0.0; 3],
        torque: [0.0; POWERS],
        slope: 0.0,
        work: 1.0,
    };

    /// These numbers, interpolated towards others by a fraction, 0 to 1.
    #[inline(always)]
    pub(super) fn towards(&self, others: &Self, fraction: f32) -> Self {
        Self {
            free: blended(&self.free, &others.free, fraction),
            impedance: blended(&self.impedance, &others.impedance, fraction),
            torque: blended(&self.torque, &others.torque, fraction),
            slope: between(self.slope, others.slope, fraction),
            work: between(self.work, others.work, fraction),
        }
    }

    /// With impedance and torque of a ball under `mu W`, N.
    #[inline(always)]
    pub(super) fn under(self, load: f32) -> Self {
        Self {
            impedance: self.impedance.map(|number| number * load),
            torque: self.torque.map(|number| number * load),
            slope: self.slope * load,
            ..self
        }
    }

    /// What a ball does with these deviations of both grooves, each over its largest; numbers and answer both over `mu W`, or both not.
    #[inline(always)]
    #[must_use]
    pub fn at(&self, [screw, nut]: [f32; 2]) -> FreeMotion {
        FreeMotion {
            speed: powers(&self.free, screw, nut),
            impedance: line(&self.impedance, [screw, nut]),
            torque: powers(&self.torque, screw, nut),
        }
    }

    /// Free speed with these deviations.
    #[inline(always)]
    pub(crate) fn speed(&self, [screw, nut]: [f32; 2]) -> f32 {
        powers(&self.free, screw, nut)
    }

    /// Impedance with these deviations.
    #[inline(always)]
    pub(crate) fn impedance(&self, deviations: [f32; 2]) -> f32 {
        line(&self.impedance, deviations)
    }

    /// Friction torque at their free speeds of balls whose deviations have these sums of powers.
    #[inline(always)]
    pub(crate) fn torque_of(&self, sums: &PowerSums) -> f32 {
        let mut torque = 0.0;
        for (number, sum) in self.torque.iter().zip(&sums.0) {
            torque += number * sum;
        }
        torque
    }

    /// Mean free speed over all deviations.
    #[inline(always)]
    #[must_use]
    pub fn held_speed(&self) -> f32 {
        // The mean of a square from -1 to 1 is a third.
        self.free[0] + (self.free[3] + self.free[5]) * (1.0 / 3.0)
    }

    /// Refuses numbers that some deviations make a ball that a train does not accept.
    pub(super) const fn checked(self) -> Result<Self, Error> {
        attempt!(in_range(
            "free",
            sum_of_sizes(&self.free, 0),
            0.0,
            LARGEST_FREE_SPEED
        ));
        let least = self.impedance[0] - sum_of_sizes(&self.impedance, 1);
        attempt!(IMPEDANCES.checked("impedance", least));
        let most = sum_of_sizes(&self.impedance, 0);
        attempt!(IMPEDANCES.checked("impedance", most));
        let torque = sum_of_sizes(&self.torque, 0);
        attempt!(in_range("torque", torque, 0.0, LARGEST_ARM));
        attempt!(in_range("slope", self.slope, -LARGEST_ARM, LARGEST_ARM));
        attempt!(in_range("work", self.work, 0.0, LARGEST_WORK));
        Ok(self)
    }
}

/// Sums of the powers of some balls' deviations, in the order of the numbers.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PowerSums([f32; POWERS]);

impl PowerSums {
    /// Adds a ball.
    #[inline(always)]
    pub(crate) fn add(&mut self, [screw, nut]: [f32; 2]) {
        let [count, s, n, ss, sn, nn] = &mut self.0;
        *count += 1.0;
        *s += screw;
        *n += nut;
        *ss += screw * screw;
        *sn += screw * nut;
        *nn += nut * nut;
    }
}

impl FreeMotion {
    /// This motion, interpolated towards another by a fraction, 0 to 1.
    #[inline(always)]
    pub(super) fn towards(self, other: Self, fraction: f32) -> Self {
        Self {
            speed: between(self.speed, other.speed, fraction),
            impedance: between(self.impedance, other.impedance, fraction),
            torque: between(self.torque, other.torque, fraction),
        }
    }
}

/// A number, interpolated towards another by a fraction.
#[inline(always)]
pub(super) fn between(from: f32, to: f32, fraction: f32) -> f32 {
    from + fraction * (to - from)
}

/// Numbers, each interpolated towards another.
#[inline(always)]
pub(super) fn blended<const M: usize>(from: &[f32; M], to: &[f32; M], fraction: f32) -> [f32; M] {
    let mut all = *from;
    for (number, &to) in all.iter_mut().zip(to) {
        *number = between(*number, to, fraction);
    }
    all
}

/// A polynomial of two deviations.
#[inline(always)]
fn powers([a, s, n, ss, sn, nn]: &[f32; POWERS], screw: f32, nut: f32) -> f32 {
    a + screw * (s + screw * ss + nut * sn) + nut * (n + nut * nn)
}

/// A straight line over two deviations.
#[inline(always)]
pub(super) fn line([a, s, n]: &[f32; 3], [screw, nut]: [f32; 2]) -> f32 {
    a + screw * s + nut * n
}

/// Sum of the sizes of numbers, from one of them on.
const fn sum_of_sizes(numbers: &[f32], from: usize) -> f32 {
    let mut sum = 0.0;
    let mut number = from;
    while number < numbers.len() {
        sum += numbers[number].abs();
        number += 1;
    }
    sum
}
