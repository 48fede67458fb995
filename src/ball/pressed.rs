//! The law of one ball whose neighbours press on it, solved on a host and folded into constants.
//!
//! The control interrupt evaluates it: the numbers of two knots around the load are blended, and a ball's answer is three polynomials in the
//! deviations of the two grooves at its place. Nothing is solved, and no ball has a state of its own but its place.

use super::folded::{FrictionPlace, holds, node_octaves};
use crate::error::{Error, Range, attempt, in_range};
use crate::ranges;
use crate::train::{IMPEDANCE_RANGE, LARGEST_FREE_SPEED};

/// Knots of a branch.
pub const KNOTS: usize = 32;

/// Powers of the two deviations: `1, s, n, s^2, s n, n^2`.
pub const POWERS: usize = 6;

/// Least and largest impedance over `mu W` that count.
const IMPEDANCES: Range = Range::new(0.01, 1e3);

/// Least and largest `mu W` that count, N.
const SLIDING_LOADS: [f32; 2] = [1e-6, 5e5];

/// Largest torque over load, m, and its change with the speed, that count.
const LARGEST_ARM: f32 = 1.0;

/// Largest grip: what is left of a force between balls is positive where friction between balls is at most 0.3.
const LARGEST_GRIP: f32 = 3.0;

/// What one ball does under a load, all over `mu W` but the free speed, the grip and the speed of rubbing.
///
/// With the deviations `s` of the screw's and `n` of the nut's contact angles, each over its largest ([`BallLaw::deviations`]), and `x` the
/// ball's speed less its free speed:
///
/// ```text
/// free speed       u = u_0 + u_1 s + u_2 n + u_3 s^2 + u_4 s n + u_5 n^2
/// net push         P = mu W (z_0 + z_1 s + z_2 n) x
/// friction torque  T = mu W (t_0 + ... + t_5 n^2 + c x) + P x v / 2
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
    /// Net push that a ball needs in addition, over the friction of its neighbours on it, -3 to 3: what friction between balls does to the
    /// speed of a ball.
    pub grip: f32,
    /// Speed with which two balls alike rub against each other, m per unit of nut speed.
    pub rubbing: f32,
}

/// A load with what a ball does under it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BallKnot {
    /// Load `W` of the ball, N, rising from knot to knot.
    pub load: f32,
    /// 1 over the distance to the next knot, 1/N; 0 of the last one.
    pub per_width: f32,
    /// What a ball does.
    pub numbers: BallNumbers,
}

impl BallKnot {
    /// [`Self::per_width`] of a knot with this load, N, and that of the next one.
    #[must_use]
    pub const fn per_width(load: f32, next: f32) -> f32 {
        if next > load {
            1.0 / (next - load)
        } else {
            0.0
        }
    }
}

/// The knots for one friction coefficient.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BallNode {
    /// Friction coefficient of ball and groove, 1e-6 to 0.5.
    pub friction: f32,
    /// Under a load that opposes the motion, and under one that assists it.
    pub branches: [[BallKnot; KNOTS]; 2],
    /// A bit for each knot from which up to the next the forces between balls are not held, of both branches.
    pub unheld: [u32; 2],
}

/// The law of one ball that its neighbours press on, for `NODES` friction coefficients: what `epas-design` folds and a scene evaluates.
///
/// Numbers ([`BallNumbers`]) are linear in the load `W = |F| + F_0` between knots, with the axial load `F` of the ball and the lift-off load
/// `F_0` of its preload; between two friction coefficients linear in their octaves. Below the first knot and above the last one impedance and
/// torque are in proportion to `W`.
///
/// Accuracy: that of the block's certificate. Cost: part of a step of [`UncagedBallScrew`](crate::UncagedBallScrew).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BallLaw<const NODES: usize> {
    /// Nodes by rising friction coefficient.
    pub nodes: [BallNode; NODES],
    /// Largest deviations of the contact angles on the screw and in the nut for which the law holds, rad, above 0.
    pub deviations: [f32; 2],
    /// Axial load of one ball at which the preload's unloaded side lifts off, N, 0 to 1e7; 0 without a preload.
    pub lift_off: f32,
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
    /// All zero.
    pub const NONE: Self = Self {
        free: [0.0; POWERS],
        impedance: [0.0; 3],
        torque: [0.0; POWERS],
        slope: 0.0,
        grip: 0.0,
        rubbing: 0.0,
    };

    /// These numbers, and a share of the way to others.
    #[inline(always)]
    fn towards(&self, others: &Self, share: f32) -> Self {
        #[inline(always)]
        fn all<const M: usize>(from: &[f32; M], to: &[f32; M], share: f32) -> [f32; M] {
            let mut all = *from;
            for (number, to) in all.iter_mut().zip(to) {
                *number += share * (to - *number);
            }
            all
        }
        let one = |from: f32, to: f32| from + share * (to - from);
        Self {
            free: all(&self.free, &others.free, share),
            impedance: all(&self.impedance, &others.impedance, share),
            torque: all(&self.torque, &others.torque, share),
            slope: one(self.slope, others.slope),
            grip: one(self.grip, others.grip),
            rubbing: one(self.rubbing, others.rubbing),
        }
    }

    /// With impedance and torque of a ball under `mu W`, N.
    #[inline(always)]
    fn under(self, load: f32) -> Self {
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
        let [z, z_screw, z_nut] = self.impedance;
        FreeMotion {
            speed: powers(&self.free, screw, nut),
            impedance: z + screw * z_screw + nut * z_nut,
            torque: powers(&self.torque, screw, nut),
        }
    }

    /// Refuses numbers that some deviations make a ball of which a train knows nothing.
    const fn checked(self) -> Result<Self, Error> {
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
        attempt!(in_range("grip", self.grip, -LARGEST_GRIP, LARGEST_GRIP));
        attempt!(in_range("rubbing", self.rubbing, 0.0, LARGEST_ARM));
        Ok(self)
    }
}

impl FreeMotion {
    /// This motion, and a share of the way to another.
    #[inline(always)]
    fn towards(self, other: Self, share: f32) -> Self {
        let one = |from: f32, to: f32| from + share * (to - from);
        Self {
            speed: one(self.speed, other.speed),
            impedance: one(self.impedance, other.impedance),
            torque: one(self.torque, other.torque),
        }
    }
}

/// Friction coefficient times load, N, within what keeps impedances within those of a train.
#[inline(always)]
fn sliding_load(friction: FrictionPlace, load: f32) -> f32 {
    let [least, most] = SLIDING_LOADS;
    let sliding = friction.friction() * load;
    if sliding > most {
        most
    } else if sliding > least {
        sliding
    } else {
        least
    }
}

/// A polynomial of two deviations.
#[inline(always)]
fn powers([a, s, n, ss, sn, nn]: &[f32; POWERS], screw: f32, nut: f32) -> f32 {
    a + screw * (s + screw * ss + nut * sn) + nut * (n + nut * nn)
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

/// A load between knots.
#[derive(Clone, Copy)]
struct KnotPlace {
    knot: usize,
    share: f32,
}

impl BallNode {
    /// The knot below a load and its share of the way to the next, 0 to 1.
    #[inline(always)]
    fn place(&self, branch: usize, load: f32) -> KnotPlace {
        let knots = &self.branches[branch & 1];
        // Loads are not negative: integers compare their bits.
        let bits = load.to_bits().cast_signed();
        let mut knot = 0;
        let mut step = KNOTS / 2;
        while step > 0 {
            // The mask tells the compiler what the halving ensures.
            if bits >= knots[(knot + step) % KNOTS].load.to_bits().cast_signed() {
                knot += step;
            }
            step /= 2;
        }
        let below = &knots[knot % KNOTS];
        let share = (load - below.load) * below.per_width;
        KnotPlace {
            knot,
            share: if share > 0.0 { share } else { 0.0 },
        }
    }

    /// What a ball does under a load, over `mu W`.
    #[inline(always)]
    fn motion(&self, branch: usize, load: f32, deviations: [f32; 2]) -> FreeMotion {
        let knots = &self.branches[branch & 1];
        let KnotPlace { knot, share } = self.place(branch, load);
        let [below, above] =
            [knot, knot + 1].map(|knot| knots[knot % KNOTS].numbers.at(deviations));
        below.towards(above, share)
    }

    /// Numbers at a place.
    #[inline(always)]
    fn numbers(&self, branch: usize, place: KnotPlace) -> BallNumbers {
        let knots = &self.branches[branch & 1];
        let below = &knots[place.knot % KNOTS].numbers;
        let above = &knots[(place.knot + 1) % KNOTS].numbers;
        below.towards(above, place.share)
    }

    /// Refuses numbers that are no law.
    const fn checked(&self) -> Result<(), Error> {
        attempt!(ranges::FRICTION_OF_A_ROW.checked("friction", self.friction));
        let mut branch = 0;
        while branch < 2 {
            let knots = &self.branches[branch];
            let mut number = 0;
            while number < KNOTS {
                let BallKnot {
                    load,
                    per_width,
                    numbers,
                } = knots[number];
                attempt!(in_range("load", load, 1e-6, 1e7));
                attempt!(numbers.checked());
                let width = if number + 1 < KNOTS {
                    knots[number + 1].load - load
                } else {
                    0.0
                };
                attempt!(in_range("load", width, 0.0, 1e7));
                // A share of 1 at the next knot but for roundings; knots that are not needed stand at the last one's load.
                let share = width * per_width;
                let (least, most) = if width > 0.0 {
                    (1.0 - 1e-5, 1.0 + 1e-5)
                } else {
                    (0.0, 0.0)
                };
                attempt!(in_range("per_width", share, least, most));
                attempt!(in_range("per_width", per_width, 0.0, 1e9));
                number += 1;
            }
            branch += 1;
        }
        Ok(())
    }
}

impl<const NODES: usize> BallLaw<NODES> {
    /// Refuses numbers that are no law.
    ///
    /// # Errors
    /// [`Error`] naming `friction`, `load`, `per_width`, `free`, `impedance`, `torque`, `slope`, `grip`, `rubbing`, `deviations` or
    /// `lift_off`.
    pub const fn checked(&self) -> Result<(), Error> {
        const { assert!(NODES > 0) };
        let [screw, nut] = self.deviations;
        attempt!(in_range("deviations", screw, 1e-6, 1.0));
        attempt!(in_range("deviations", nut, 1e-6, 1.0));
        attempt!(in_range("lift_off", self.lift_off, 0.0, 1e7));
        let mut number = 0;
        while number < NODES {
            let node = &self.nodes[number];
            if number > 0 {
                let least = 1.01 * self.nodes[number - 1].friction;
                attempt!(in_range("friction", node.friction, least, 0.5));
            }
            attempt!(node.checked());
            number += 1;
        }
        Ok(())
    }

    /// Friction coefficients of the nodes.
    #[must_use]
    pub const fn frictions(&self) -> [f32; NODES] {
        let mut all = [0.0; NODES];
        let mut number = 0;
        while number < NODES {
            all[number] = self.nodes[number].friction;
            number += 1;
        }
        all
    }

    /// Least and largest friction coefficient.
    #[must_use]
    pub const fn friction_range(&self) -> (f32, f32) {
        (self.nodes[0].friction, self.nodes[NODES - 1].friction)
    }

    /// Whether a friction coefficient is one of those that the law is folded for.
    #[inline(always)]
    pub(crate) const fn holds(&self, friction: f32) -> bool {
        holds(self.friction_range(), friction)
    }

    /// The place of a friction coefficient among the nodes; beyond them impedance and torque are in proportion to it.
    #[must_use]
    pub const fn place(&self, friction: f32) -> FrictionPlace {
        let frictions = self.frictions();
        FrictionPlace::among(&frictions, &node_octaves(&frictions), friction)
    }

    /// Load `W` of a ball, N, under an axial load, N, of either sign.
    #[inline(always)]
    #[must_use]
    pub const fn load_of(&self, axial_load: f32) -> f32 {
        axial_load.abs() + self.lift_off
    }

    /// What balls do under a load `W`, N, with a friction coefficient, in newtons and metres; `branch` 0 under a load that opposes the motion,
    /// 1 under one that assists it.
    #[inline(always)]
    #[must_use]
    pub fn numbers(&self, load: f32, branch: usize, friction: FrictionPlace) -> BallNumbers {
        let below = &self.nodes[friction.node() % NODES];
        let numbers = below.numbers(branch, below.place(branch, load));
        let numbers = if NODES == 1 {
            numbers
        } else {
            let above = &self.nodes[(friction.node() + 1) % NODES];
            let others = above.numbers(branch, above.place(branch, load));
            numbers.towards(&others, friction.share())
        };
        numbers.under(sliding_load(friction, load))
    }

    /// What a ball does under a load `W`, N, with deviations of both grooves, each over its largest: [`BallNumbers::at`] of [`Self::numbers`],
    /// of fewer operations.
    #[inline(always)]
    #[must_use]
    pub fn at(
        &self,
        load: f32,
        branch: usize,
        friction: FrictionPlace,
        deviations: [f32; 2],
    ) -> FreeMotion {
        let below = &self.nodes[friction.node() % NODES];
        let motion = below.motion(branch, load, deviations);
        let motion = if NODES == 1 {
            motion
        } else {
            let above = &self.nodes[(friction.node() + 1) % NODES];
            motion.towards(above.motion(branch, load, deviations), friction.share())
        };
        let load = sliding_load(friction, load);
        FreeMotion {
            speed: motion.speed,
            impedance: motion.impedance * load,
            torque: motion.torque * load,
        }
    }

    /// Whether a load `W`, N, is not above the largest for which the law was folded.
    #[inline(always)]
    #[must_use]
    pub fn holds_load(&self, load: f32) -> bool {
        load <= self.nodes[0].branches[0][KNOTS - 1].load
    }

    /// Largest grip of a ball, of any load, at least 0.01.
    #[must_use]
    pub const fn largest_grip(&self) -> f32 {
        let mut largest = 0.01;
        let mut number = 0;
        while number < NODES * 2 * KNOTS {
            let knot =
                &self.nodes[number / (2 * KNOTS)].branches[number / KNOTS % 2][number % KNOTS];
            let grip = knot.numbers.grip.abs();
            if grip > largest {
                largest = grip;
            }
            number += 1;
        }
        largest
    }

    /// Whether the forces between balls are held under a load `W`, N.
    #[inline(always)]
    #[must_use]
    pub fn holds_forces(&self, load: f32, branch: usize, friction: FrictionPlace) -> bool {
        let node = &self.nodes[friction.node() % NODES];
        let KnotPlace { knot, .. } = node.place(branch, load);
        node.unheld[branch & 1] >> (knot % KNOTS) & 1 == 0
    }
}

/// A train takes what a ball may have, with what friction between balls makes of it: a factor of 0.77 to 1.43.
const _: () = assert!(
    0.77 * IMPEDANCES.minimum * SLIDING_LOADS[0] >= IMPEDANCE_RANGE.0
        && 1.43 * IMPEDANCES.maximum * SLIDING_LOADS[1] <= IMPEDANCE_RANGE.1
);
