//! Numbers of one ball under one load: polynomials in the deviations of the two grooves, alone and with neighbours.

use crate::error::{Error, Range, attempt, in_range};
use crate::train::LARGEST_FREE_SPEED;

/// Powers of the two deviations to the second degree: `1, s, n, s^2, s n, n^2`.
pub const POWERS: usize = 6;

/// To the third: these, then `s^3, s^2 n, s n^2, n^3`.
pub const SPEED_POWERS: usize = 10;

/// Least and largest impedance over `mu W`.
pub(super) const IMPEDANCES: Range = Range::new(0.01, 1e3);

/// Largest torque over load, m, and of its change with the speed.
const LARGEST_ARM: f32 = 1.0;

/// Largest loss by a net push over its work.
pub const LARGEST_WORK: f32 = 4.0;

/// Numbers of one ball under a load, all over `mu W` but the free speed and the work.
///
/// With the deviations `s` of the screw's and `n` of the nut's contact angles, each over its largest ([`BallLaw::deviations`](super::BallLaw::deviations)),
/// `x` the ball's speed less its free speed, and the nominal speed `v` against the nut, m per unit of nut speed:
///
/// ```text
/// free speed       u = u_0 + u_1 s + u_2 n + u_3 s^2 + u_4 s n + u_5 n^2 + u_6 s^3 + u_7 s^2 n + u_8 s n^2 + u_9 n^3
/// net push         P = mu W (z_0 + z_1 s + z_2 n) x
/// friction torque  T = mu W (t_0 + ... + t_5 n^2 + c x) + w P x v / 2
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BallNumbers {
    /// Free speed less the nominal one, over the nominal speed against the nut: its powers of the deviations.
    pub free: [f32; SPEED_POWERS],
    /// Impedance: the force that changes the speed by one; powers `1, s, n`.
    pub impedance: [f32; 3],
    /// Friction torque on the nut at the free speed, m.
    pub torque: [f32; POWERS],
    /// Change of the friction torque with the speed at the free speed, m.
    pub slope: f32,
    /// Loss by the net push over its work `P x v / 2`, 0 to 4: 1 where a push is in proportion to the speed, more where it saturates.
    pub work: f32,
}

/// Motion of a ball on its own in a tick.
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
    /// A ball that loses nothing and holds nothing: all bits zero, so that an [empty block](crate::scene::FoldedBall::EMPTY) takes no flash.
    pub const NONE: Self = Self {
        free: [0.0; SPEED_POWERS],
        impedance: [0.0; 3],
        torque: [0.0; POWERS],
        slope: 0.0,
        work: 0.0,
    };

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

    /// Motion with these deviations of both grooves, each over its largest; numbers and answer both over `mu W`, or both not.
    #[inline(always)]
    pub fn at(&self, [screw, nut]: [f32; 2]) -> FreeMotion {
        FreeMotion {
            speed: cubic(&self.free, screw, nut),
            impedance: line(&self.impedance, [screw, nut]),
            torque: powers(&self.torque, screw, nut),
        }
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
    pub fn held_speed(&self) -> f32 {
        // The mean of a square from -1 to 1 is a third, that of an odd power none.
        self.free[0] + (self.free[3] + self.free[5]) * (1.0 / 3.0)
    }

    /// Checks that a train accepts the ball at all deviations.
    pub(super) const fn checked(self) -> Result<Self, Error> {
        let speed = sum_of_sizes(&self.free, 0);
        attempt!(in_range("free", speed, 0.0, LARGEST_FREE_SPEED));
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
    #[inline(always)]
    pub(super) fn towards(&self, other: &Self, fraction: f32) -> Self {
        Self {
            speed: between(self.speed, other.speed, fraction),
            impedance: between(self.impedance, other.impedance, fraction),
            torque: between(self.torque, other.torque, fraction),
        }
    }
}

/// Knots of a branch for [`NeighbourNumbers`].
pub const NEIGHBOUR_KNOTS: usize = 16;

const LARGEST_NUMBER: f32 = 1e3;

/// Friction of both neighbours over `mu W` at which a law has numbers: linear between, zero without friction, beyond the last in proportion.
pub const RUBBINGS: [f32; 3] = [0.08, 0.25, 0.7];

/// Changes of a ball under one load by its neighbours: each a line `1, s, n` over the deviations of both grooves.
///
/// A ball that its neighbours rub on needs and loses more than alone at the same speed `v`; with the friction of both,
/// `m = mu_b (F_behind + F_ahead)/(mu W cos(b))`, and `A`, `H`, `L` linear between the nodes [`RUBBINGS`]:
///
/// ```text
/// net push         P = P_alone + A(m) + H(m) (v - v_h) + g O
/// friction torque  T = T_alone + L(m) + t O,                      O = tan(b) (F_behind + F_ahead),   sin(b) = R_B/R_path
/// ```
///
/// with the mean free speed `v_h` over all deviations and the outward force `O` of neighbours on a curved track. `L` holds the ball's half of the
/// loss between balls. Source: Lin 2019, eqs. (3.70) to (3.77); least squares over exact balls, without a printed formula.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct NeighbourNumbers {
    /// `A`, `H`, `L` at the nodes.
    pub nodes: [RubbedNode; 3],
    /// `g` over `mu`.
    pub outward: [f32; 3],
    /// `t` over `mu`, m.
    pub outward_torque: f32,
}

/// Changes of a ball by friction of its neighbours at a node, over `mu W`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct RubbedNode {
    /// `A`.
    pub push: [f32; 3],
    /// `H`.
    pub impedance: [f32; 3],
    /// `L`, m.
    pub torque: [f32; 3],
}

impl RubbedNode {
    pub(super) const NONE: Self = Self {
        push: [0.0; 3],
        impedance: [0.0; 3],
        torque: [0.0; 3],
    };
}

impl NeighbourNumbers {
    /// A ball in which neighbours change nothing.
    pub const NONE: Self = Self {
        nodes: [RubbedNode::NONE; 3],
        outward: [0.0; 3],
        outward_torque: 0.0,
    };

    #[inline(always)]
    pub(super) fn towards(&self, others: &Self, fraction: f32) -> Self {
        let node = |one: &RubbedNode, other: &RubbedNode| RubbedNode {
            push: blended(&one.push, &other.push, fraction),
            impedance: blended(&one.impedance, &other.impedance, fraction),
            torque: blended(&one.torque, &other.torque, fraction),
        };
        let [first, second, third] = &self.nodes;
        let [other_first, other_second, other_third] = &others.nodes;
        Self {
            nodes: [
                node(first, other_first),
                node(second, other_second),
                node(third, other_third),
            ],
            outward: blended(&self.outward, &others.outward, fraction),
            outward_torque: between(self.outward_torque, others.outward_torque, fraction),
        }
    }

    pub(super) const fn checked(&self) -> Result<(), Error> {
        let mut node = 0;
        while node < 3 {
            attempt!(check("push", &self.nodes[node].push));
            attempt!(check("rubbed_impedance", &self.nodes[node].impedance));
            attempt!(check("rubbed_torque", &self.nodes[node].torque));
            node += 1;
        }
        attempt!(check("outward", &self.outward));
        attempt!(check("outward_torque", &[self.outward_torque]));
        Ok(())
    }
}

const fn check(field: &'static str, numbers: &[f32]) -> Result<(), Error> {
    let (mut number, most) = (0, LARGEST_NUMBER);
    while number < numbers.len() {
        attempt!(in_range(field, numbers[number], -most, most));
        number += 1;
    }
    Ok(())
}

#[inline(always)]
fn between(from: f32, to: f32, fraction: f32) -> f32 {
    from + fraction * (to - from)
}

#[inline(always)]
fn blended<const M: usize>(from: &[f32; M], to: &[f32; M], fraction: f32) -> [f32; M] {
    let mut all = *from;
    for (number, &to) in all.iter_mut().zip(to) {
        *number = between(*number, to, fraction);
    }
    all
}

#[inline(always)]
fn powers([a, s, n, ss, sn, nn]: &[f32; POWERS], screw: f32, nut: f32) -> f32 {
    a + screw * (s + screw * ss + nut * sn) + nut * (n + nut * nn)
}

#[inline(always)]
fn cubic(
    [a, s, n, ss, sn, nn, sss, ssn, snn, nnn]: &[f32; SPEED_POWERS],
    screw: f32,
    nut: f32,
) -> f32 {
    let by_screw = s + screw * (ss + screw * sss + nut * ssn) + nut * sn;
    let by_nut = n + nut * (nn + nut * nnn + screw * snn);
    a + screw * by_screw + nut * by_nut
}

#[inline(always)]
pub(super) fn line([a, s, n]: &[f32; 3], [screw, nut]: [f32; 2]) -> f32 {
    a + screw * s + nut * n
}

const fn sum_of_sizes(numbers: &[f32], from: usize) -> f32 {
    let mut sum = 0.0;
    let mut number = from;
    while number < numbers.len() {
        sum += numbers[number].abs();
        number += 1;
    }
    sum
}
