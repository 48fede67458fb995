//! Elements that come into contact with the load, as the springs of an elastic contact do.

use super::state::{MemoryState, held, held_pair, not_negative, turned};
use super::{BREAKAWAY, Hysteresis, REFERENCE_LIMIT};
use crate::error::{Error, Range, attempt, in_range};
use crate::law::{Elements, SlidingLimits};
use crate::math::{constant, inverse_cube_roots};
use crate::stored::{Fingerprint, Fingerprinted};

/// Largest load of load-exact elements over the reference load: 1e-3 to 1e6.
const LARGEST_LOAD: Range = Range::new(1e-3, 1e6);

/// Load over the reference from which on all elements are in contact; keeps NaN out.
const BOUNDLESS: f32 = 1e12;

/// `N` elements, each in contact from a load of its own on: friction across the path under any load.
///
/// `f_i <- clamp(f_i + k_i dtheta, -lambda_i T-, lambda_i T+)`, `lambda_i = b_i / sum b_j`, `b_i = k_i (d - c_i)` where
/// positive, else 0, with the approach `d = (F/F_ref)^(2/3)` under a load `F` over that under the reference load `F_ref`;
/// `c_i = x_i²`, `k_i = 1.5 g_i T_ref/theta_b`; `x_i`, `g_i` are nodes and weights of Gauss and Legendre on 0 to
/// `(F_max/F_ref)^(1/3)`.
///
/// A Hertzian contact is a row of springs of constant stiffness that come into contact one after the other (Jaeger 1993,
/// Ciavarella 1998, Popov and Hess 2015): `x` is the distance from its centre, `d` its approach. Stiffness then grows with the power 1/3 of the load
/// and breakaway with 2/3, though no spring's stiffness changes, so that the elements stay passive.
///
/// Error against 3000 springs over random load and angle, percent of the rms friction, eight elements, by amplitude in
/// breakaway angles:
///
/// | load over the reference | 0.3 | 1 | 3 |
/// |---|---|---|---|
/// | 0.5 to 1.6 | 8.1 | 3.8 | 1.3 |
/// | 0.1 to 4 | 19 | 5.8 | 2.2 |
///
/// Within 10 % of one load, amplitude 1: 10, 3.8, 2.5 and 1.8 % with four, six, eight and ten elements; with
/// [`ProportionalElements`](super::ProportionalElements) 1.2 %. In full sliding the friction is `T+` or `-T-` to the bit; below a load of 8e-6 of
/// the largest no element of eight is in contact. f32 against f64: 8e-7 of the limit. Finite limits and any turn; a turn that is NaN or
/// from `2^20` on counts as 0. 371 cycles for eight elements with the cube root.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadExactElements<const N: usize> {
    pub(super) stiffnesses: [f32; N],
    /// Approach at which an element comes into contact, over that at the reference load.
    pub(super) onsets: [f32; N],
    reference_limit: f32,
}

impl<const N: usize> LoadExactElements<N> {
    /// Elements of a mechanism that slides with `reference_limit`, N m (N), after `breakaway_angle`, rad (m), at the reference load, for loads up
    /// to `largest_load` times that; under larger ones they come closer to those in proportion.
    ///
    /// # Errors
    /// [`Error`] naming `N` (1 or more) or the field that is wrong ([`REFERENCE_LIMIT`], [`BREAKAWAY`], `largest_load` 1e-3 to 1e6).
    pub const fn new(
        reference_limit: f32,
        breakaway_angle: f32,
        largest_load: f32,
    ) -> Result<Self, Error> {
        attempt!(in_range("N", N as f32, 1.0, f32::MAX));
        let reference_limit = attempt!(REFERENCE_LIMIT.checked("reference_limit", reference_limit));
        attempt!(BREAKAWAY.checked("breakaway_angle", breakaway_angle));
        attempt!(LARGEST_LOAD.checked("largest_load", largest_load));
        let half = 0.5 * constant::cbrt(largest_load);
        let mut stiffnesses = [0.0; N];
        let mut onsets = [0.0; N];
        let mut index = 0;
        while index < N {
            let (node, weight) = Rule::<N>::NODES[index];
            let point = half + half * node;
            onsets[index] = point * point;
            stiffnesses[index] = 1.5 * half * weight * (reference_limit / breakaway_angle);
            index += 1;
        }
        Ok(Self {
            stiffnesses,
            onsets,
            reference_limit,
        })
    }

    /// Stiffness of each element, N m/rad (N/m).
    pub const fn stiffnesses(&self) -> [f32; N] {
        self.stiffnesses
    }

    /// Stiffness of each element, N m/rad (N/m), and its onset: what `follow` computes with, for a program in another language.
    #[doc(hidden)]
    #[must_use]
    pub const fn numbers(&self) -> [[f32; N]; 2] {
        [self.stiffnesses, self.onsets]
    }

    /// `b_i` at an approach `d`, N m/rad (N/m), and their sum.
    #[inline(always)]
    fn borne(&self, approach: f32) -> ([f32; N], f32) {
        let mut borne = [0.0; N];
        let mut sum = 0.0;
        let (pairs, last) = borne.as_chunks_mut::<2>();
        let (stiffness_pairs, last_stiffness) = self.stiffnesses.as_chunks::<2>();
        let (onset_pairs, last_onset) = self.onsets.as_chunks::<2>();
        for ((borne, [k, l]), [c, d]) in pairs.iter_mut().zip(stiffness_pairs).zip(onset_pairs) {
            let (c, d) = (approach - c, approach - d);
            let (c, d) = (not_negative(c), not_negative(d));
            let (c, d) = (k * c, l * d);
            sum += c;
            *borne = [c, d];
            sum += d;
        }
        for ((borne, stiffness), onset) in last.iter_mut().zip(last_stiffness).zip(last_onset) {
            *borne = stiffness * not_negative(approach - onset);
            sum += *borne;
        }
        (borne, sum)
    }
}

/// `load^(2/3)`: a power of five digits, and one Newton step that leaves an error of 2e-9 before rounding.
#[inline(always)]
fn approach(load: f32) -> f32 {
    const THIRD: f32 = 1.0 / 3.0;
    let load = load.abs();
    // False for NaN.
    let load = if load < BOUNDLESS { load } else { BOUNDLESS };
    let [inverse, _] = inverse_cube_roots([load, 1.0]);
    let root = load * inverse;
    let off = 1.0 - root * (inverse * inverse);
    root + root * (THIRD * off)
}

/// Friction by the sum of elements, or the limit itself where all of them slide: rounding takes from the sum at most `2^-24` for each addition,
/// and five for the roundings of a limit and of the comparison.
#[inline(always)]
fn summed(friction: f32, count: usize, low: f32, high: f32) -> f32 {
    let almost = 1.0 - 0.5 * f32::EPSILON * (count as f32 + 4.0);
    let friction = if friction > almost * high {
        high
    } else {
        friction
    };
    if friction < almost * low {
        low
    } else {
        friction
    }
}

impl<const N: usize> Elements for LoadExactElements<N> {
    type State = MemoryState<N>;

    const VIRGIN: Self::State = MemoryState::VIRGIN;

    #[inline]
    fn follow(&self, state: &mut Self::State, turn: f32, limits: &SlidingLimits) -> f32 {
        let turn = turned(turn);
        let (backward, forward) = (-limits.backward, limits.forward);
        let (borne, whole) = self.borne(approach(limits.load));
        let share = if whole > 0.0 { 1.0 / whole } else { 0.0 };
        let (low, high) = (share * backward, share * forward);
        let mut friction = -0.0;
        let (pairs, last) = state.held.as_chunks_mut::<2>();
        let (stiffness_pairs, last_stiffness) = self.stiffnesses.as_chunks::<2>();
        let (borne_pairs, last_borne) = borne.as_chunks::<2>();
        for ((held, [k, l]), [v, w]) in pairs.iter_mut().zip(stiffness_pairs).zip(borne_pairs) {
            let [f, g] = *held;
            let (d, e) = (k * turn, l * turn);
            let (f, g) = (f + d, g + e);
            let [f, g] = held_pair([f, g], [v * low, w * low], [v * high, w * high]);
            friction += f;
            *held = [f, g];
            friction += g;
        }
        for ((element, stiffness), borne) in last.iter_mut().zip(last_stiffness).zip(last_borne) {
            *element = held(*element + stiffness * turn, borne * low, borne * high);
            friction += *element;
        }
        summed(friction, N, backward, forward)
    }
}

impl<const N: usize> Hysteresis for LoadExactElements<N> {
    fn stored_energy(&self, state: &Self::State) -> f32 {
        let springs = state.held.iter().zip(&self.stiffnesses);
        springs
            .map(|(torque, stiffness)| 0.5 * torque * torque / stiffness)
            .sum()
    }

    fn initial_stiffness(&self) -> f32 {
        let springs = self.stiffnesses.iter().zip(&self.onsets);
        springs.fold(
            0.0,
            |sum, (stiffness, &onset)| if onset < 1.0 { sum + stiffness } else { sum },
        )
    }

    fn breakaway(&self) -> f32 {
        // The element that touched first is the last one to slide.
        let first = self.onsets.iter().fold(
            1.0,
            |least, &onset| if onset < least { onset } else { least },
        );
        let (_, sum) = self.borne(1.0);
        if sum > 0.0 {
            (1.0 - first) * self.reference_limit / sum
        } else {
            0.0
        }
    }
}

/// Nodes and weights of Gauss and Legendre, found by the compiler in double precision.
struct Rule<const N: usize>;

impl<const N: usize> Rule<N> {
    /// Nodes on -1 to 1 from the left, each with its weight.
    const NODES: [(f32, f32); N] = nodes();
}

/// Zeros of the Legendre polynomial of degree `N`, by Newton's method beside those found already (Maehly), from outside.
const fn nodes<const N: usize>() -> [(f32, f32); N] {
    let mut found = [0.0; N];
    let mut nodes = [(0.0, 0.0); N];
    let mut index = 0;
    while index < N {
        let mut x = 1.0_f64;
        let mut steps = 0;
        while steps < 60 {
            let (value, slope) = legendre(N, x);
            let mut removed = 0.0;
            let mut other = 0;
            while other < index {
                removed += 1.0 / (x - found[other]);
                other += 1;
            }
            x -= value / (slope - value * removed);
            steps += 1;
        }
        let (_, slope) = legendre(N, x);
        found[index] = x;
        nodes[N - 1 - index] = (x as f32, (2.0 / ((1.0 - x * x) * slope * slope)) as f32);
        index += 1;
    }
    nodes
}

const fn legendre(degree: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (0.0, 1.0);
    let (mut slope_before, mut slope) = (0.0, 0.0);
    let mut index = 0;
    while index < degree {
        // (n+1) P_{n+1} = (2n+1) x P_n - n P_{n-1}, and its derivative.
        let n = index as f64;
        let next = ((2.0 * n + 1.0) * x * value - n * before) / (n + 1.0);
        let slope_next = ((2.0 * n + 1.0) * (value + x * slope) - n * slope_before) / (n + 1.0);
        (before, value) = (value, next);
        (slope_before, slope) = (slope, slope_next);
        index += 1;
    }
    (value, slope)
}

const LOAD_EXACT: u32 = 2;

impl<const N: usize> Fingerprinted for LoadExactElements<N> {
    fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        fingerprint.count(LOAD_EXACT);
        fingerprint.numbers(&self.stiffnesses);
        fingerprint.numbers(&self.onsets);
    }
}
