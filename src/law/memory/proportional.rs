//! Elements whose limits are constant shares of the friction of gross sliding.

use super::backbone::BackboneElement;
use super::state::{MemoryState, held, held_pair, turned};
use super::{BREAKAWAY, Hysteresis, REFERENCE_LIMIT};
use crate::error::{Error, attempt, in_range};
use crate::law::{Elements, SlidingLimits};
use crate::stored::{Fingerprint, Fingerprinted};

/// Fewest elements: `follow` adds up differences from the first one of a pair.
const FEWEST: f32 = 2.0;

/// One mechanism of a mixed one: spin, slip across the path, rolling resistance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part<'a> {
    /// Its backbone's elements, as [`SLIP_8.elements`](super::SLIP_8).
    pub backbone: &'a [BackboneElement],
    /// Its share of the friction of gross sliding: 1e-6 to 1.
    pub share: f32,
    /// Its breakaway angle, rad (m): the turn that the backbone's angles are over.
    pub breakaway_angle: f32,
}

/// `N` elements whose limits are constant shares of the friction of gross sliding.
///
/// `f_i <- clamp(f_i + k_i dtheta, -lambda_i T-, lambda_i T+)`, `T = sum f_i`, with `lambda_i = share w_i` and
/// `k_i = share w_i T_ref / (z_i theta_b)`. Stored are `f_i / lambda_i`, and summed are differences from one of them: in full sliding the friction is
/// `T+` or `T-` to the bit.
///
/// Each part starts with a stiffness of `1.5 share T_ref / theta_b`, of which eight elements have 97 %. The friction is
/// within the error of its [table](super::backbone) where limits are those of the reference. Under a changing load its
/// error is 8 % of the rms friction for loads of 0.5 to 1.6 times the reference, 27 % for 0.1 to 4: choose the reference at the preload. f32
/// against f64: 1e-6 of the limit, also after 200,000 ticks. Finite limits and any turn; a turn that is NaN or from `2^20` on counts as 0. 190
/// cycles for eight elements.
///
/// ```
/// use epas_friction::law::memory::{MemoryState, Part, ProportionalElements, SLIP_8};
/// use epas_friction::law::{Elements, SlidingLimits};
///
/// // Friction of 0.04 N m that slides fully after 2 mrad.
/// const FRICTION: ProportionalElements<8> = match ProportionalElements::new(
///     0.04,
///     &[Part { backbone: &SLIP_8.elements, share: 1.0, breakaway_angle: 2e-3 }],
/// ) {
///     Ok(elements) => elements,
///     Err(_) => panic!(),
/// };
/// let limits = SlidingLimits { forward: 0.05, backward: 0.03, load: 1.0 };
/// let mut state = MemoryState::VIRGIN;
/// assert!(FRICTION.follow(&mut state, 0.5e-3, &limits) < 0.03);
/// assert_eq!(FRICTION.follow(&mut state, 5e-3, &limits), 0.05);
/// assert_eq!(FRICTION.follow(&mut state, -10e-3, &limits), -0.03);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProportionalElements<const N: usize> {
    /// Stiffness over share.
    pub(super) rates: [f32; N],
    /// The largest one first.
    pub(super) shares: [f32; N],
    reference_limit: f32,
}

impl<const N: usize> ProportionalElements<N> {
    /// Elements of all parts together, in their order, but for the one with the largest share, which changes places with the first.
    ///
    /// `reference_limit`: friction of gross sliding, N m (N), at which the parts have their breakaway angles: mean of both directions at the preload.
    ///
    /// # Errors
    /// [`Error`] naming `N` (2 or more), `reference_limit`, `share` or `breakaway_angle` of a part, `angle` or `weight` of a backbone, `parts` where
    /// they have not `N` elements together, or `shares` where shares times weights do not add up to 1 within 1e-3.
    pub const fn new(reference_limit: f32, parts: &[Part<'_>]) -> Result<Self, Error> {
        let number = attempt!(in_range("N", N as f32, FEWEST, f32::MAX));
        let reference_limit = attempt!(REFERENCE_LIMIT.checked("reference_limit", reference_limit));
        let mut elements = Self {
            rates: [0.0; N],
            shares: [0.0; N],
            reference_limit,
        };
        let (mut count, mut sum) = (0, 0.0);
        let mut part = 0;
        while part < parts.len() {
            let Part {
                backbone,
                share,
                breakaway_angle,
            } = parts[part];
            attempt!(in_range("share", share, 1e-6, 1.0));
            attempt!(BREAKAWAY.checked("breakaway_angle", breakaway_angle));
            let mut index = 0;
            while index < backbone.len() {
                let BackboneElement { angle, weight } = backbone[index];
                attempt!(in_range("angle", angle, 1e-6, 1e3));
                attempt!(in_range("weight", weight, 1e-9, 1.0));
                if count < N {
                    elements.shares[count] = share * weight;
                    elements.rates[count] = reference_limit / (angle * breakaway_angle);
                }
                sum += share * weight;
                count += 1;
                index += 1;
            }
            part += 1;
        }
        attempt!(in_range("parts", count as f32, number, number));
        attempt!(in_range("shares", sum, 0.999, 1.001));
        let mut index = 0;
        while index < N {
            elements.shares[index] /= sum;
            index += 1;
        }
        Ok(elements.with_largest_first())
    }

    /// Puts the element with the largest share first: `follow` adds up differences from it, and the sum leaves the limits by no more than the
    /// rounding of the rest.
    const fn with_largest_first(mut self) -> Self {
        let (mut largest, mut most) = (0, 0.0);
        let mut index = 0;
        while index < N {
            if self.shares[index] > most {
                (largest, most) = (index, self.shares[index]);
            }
            index += 1;
        }
        // In a walk, whose index the compiler knows to be within the array.
        let (shares, rates) = (self.shares, self.rates);
        index = 0;
        while index < N {
            if index == largest {
                (self.shares[0], self.shares[index]) = (shares[index], shares[0]);
                (self.rates[0], self.rates[index]) = (rates[index], rates[0]);
            }
            index += 1;
        }
        self
    }

    /// Stiffness over share, N m/rad (N/m), and share of each element: what `follow` computes with, for a program in another language.
    #[doc(hidden)]
    #[must_use]
    pub const fn numbers(&self) -> [[f32; N]; 2] {
        [self.rates, self.shares]
    }

    /// Stiffness of each element, N m/rad (N/m): `k_i`.
    pub fn stiffnesses(&self) -> [f32; N] {
        let mut stiffnesses = self.rates;
        for (stiffness, share) in stiffnesses.iter_mut().zip(&self.shares) {
            *stiffness *= share;
        }
        stiffnesses
    }

    /// Friction of each element, N m (N): `f_i`.
    pub fn torques(&self, state: &MemoryState<N>) -> [f32; N] {
        let mut torques = state.held;
        for (torque, share) in torques.iter_mut().zip(&self.shares) {
            *torque *= share;
        }
        torques
    }
}

impl<const N: usize> Elements for ProportionalElements<N> {
    type State = MemoryState<N>;

    const VIRGIN: Self::State = MemoryState::VIRGIN;

    #[inline]
    fn follow(&self, state: &mut Self::State, turn: f32, limits: &SlidingLimits) -> f32 {
        let turn = turned(turn);
        let (low, high) = (-limits.backward, limits.forward);
        let (pairs, last) = state.held.as_chunks_mut::<2>();
        let (rate_pairs, last_rate) = self.rates.as_chunks::<2>();
        let (share_pairs, last_share) = self.shares.as_chunks::<2>();
        let turned = |[f, g]: [f32; 2], [k, l]: &[f32; 2]| {
            let (d, e) = (k * turn, l * turn);
            held_pair([f + d, g + e], [low; 2], [high; 2])
        };
        let mut pairs = pairs.iter_mut().zip(rate_pairs).zip(share_pairs);
        // There is a pair: `FEWEST`.
        let Some(((held_of_pair, rates), [_, share])) = pairs.next() else {
            return 0.0;
        };
        *held_of_pair = turned(*held_of_pair, rates);
        let [base, second] = *held_of_pair;
        let mut friction = share * (second - base);
        for ((held_of_pair, rates), [v, w]) in pairs {
            let [f, g] = turned(*held_of_pair, rates);
            *held_of_pair = [f, g];
            let (d, e) = (f - base, g - base);
            let (d, e) = (v * d, w * e);
            friction += d;
            friction += e;
        }
        for ((element, rate), share) in last.iter_mut().zip(last_rate).zip(last_share) {
            *element = held(*element + rate * turn, low, high);
            friction += share * (*element - base);
        }
        base + friction
    }
}

impl<const N: usize> Hysteresis for ProportionalElements<N> {
    fn stored_energy(&self, state: &Self::State) -> f32 {
        let springs = state.held.iter().zip(&self.rates).zip(&self.shares);
        springs
            .map(|((held, rate), share)| 0.5 * share * (held * held) / rate)
            .sum()
    }

    fn initial_stiffness(&self) -> f32 {
        self.stiffnesses().iter().sum()
    }

    fn breakaway(&self) -> f32 {
        let slowest = self.rates.iter().fold(
            f32::MAX,
            |least, &rate| if rate < least { rate } else { least },
        );
        self.reference_limit / slowest
    }
}

const PROPORTIONAL: u32 = 1;

impl<const N: usize> Fingerprinted for ProportionalElements<N> {
    fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        fingerprint.count(PROPORTIONAL);
        fingerprint.numbers(&self.rates);
        fingerprint.numbers(&self.shares);
    }
}
