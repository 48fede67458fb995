//! Elements whose limits are constant shares of the friction of gross sliding.

use super::backbone::BackboneElement;
use super::hysteresis::Hysteresis;
use super::slider::{excess, held, not_negative, turned};
use super::state::MemoryState;
use super::{BREAKAWAY, REFERENCE_LIMIT};
use crate::error::{Error, attempt, in_range};
use crate::law::{Elements, SlidingLimits};

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
/// `f_i <- clamp(f_i + k_i dtheta, -lambda_i T-, lambda_i T+)`, `lambda_i = share w_i`,
/// `k_i = share w_i T_ref / (z_i theta_b)`.
///
/// Each part starts with `1.5 share T_ref / theta_b` (within 4 % for eight elements). The friction is within the error of its
/// [table](super::backbone) where limits are those of the reference load. Under a changing load its error is 8 % of
/// the rms friction for loads of 0.5 to 1.6 times the reference, 27 % for 0.1 to 4: a contact's breakaway angle
/// grows with the power 2/3 of its load, and this one's with the first. Choose the reference at the preload.
///
/// In full sliding the friction is `T+` or `-T-` to the bit. f32 against f64: 2e-6 of the limit over 8,000 ticks.
///
/// 170 cycles for eight elements, 20 for one more. Any turn, stiffness and finite limits; a turn that is no number
/// is none, a negative limit is 0.
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
    pub(super) stiffnesses: [f32; N],
    pub(super) shares: [f32; N],
    reference_limit: f32,
}

impl<const N: usize> ProportionalElements<N> {
    /// Elements of all parts together.
    ///
    /// `reference_limit`: friction of gross sliding, N m (N), at which the parts have their breakaway angles:
    /// mean of both directions at the preload.
    ///
    /// # Errors
    /// `reference_limit`; of a part `share` or `breakaway_angle`, of a backbone `angle` or `weight`, outside their ranges;
    /// `parts` where they have not `N` elements together (the value is their number); `shares` where shares times weights do
    /// not add up to 1 within 1e-3.
    pub const fn new(reference_limit: f32, parts: &[Part<'_>]) -> Result<Self, Error> {
        let reference_limit = attempt!(REFERENCE_LIMIT.checked("reference_limit", reference_limit));
        let mut stiffnesses = [0.0; N];
        let mut shares = [0.0; N];
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
                    shares[count] = share * weight;
                    stiffnesses[count] =
                        share * weight * reference_limit / (angle * breakaway_angle);
                }
                sum += share * weight;
                count += 1;
                index += 1;
            }
            part += 1;
        }
        attempt!(in_range("parts", count as f32, N as f32, N as f32));
        attempt!(in_range("shares", sum, 0.999, 1.001));
        let mut index = 0;
        while index < N {
            shares[index] = shares[index] / sum * excess(N);
            stiffnesses[index] /= sum;
            index += 1;
        }
        Ok(Self {
            stiffnesses,
            shares,
            reference_limit,
        })
    }

    /// Stiffness of each element, N m/rad (N/m).
    #[must_use]
    pub const fn stiffnesses(&self) -> [f32; N] {
        self.stiffnesses
    }
}

impl<const N: usize> Elements for ProportionalElements<N> {
    type State = MemoryState<N>;

    const VIRGIN: Self::State = MemoryState::VIRGIN;

    #[inline]
    fn follow(&self, state: &mut Self::State, turn: f32, limits: &SlidingLimits) -> f32 {
        let turn = turned(turn);
        let forward = not_negative(limits.forward);
        let backward = -not_negative(limits.backward);
        let mut friction = 0.0;
        let constants = self.stiffnesses.iter().zip(&self.shares);
        for (torque, (stiffness, share)) in state.torques.iter_mut().zip(constants) {
            *torque = held(
                *torque + stiffness * turn,
                share * backward,
                share * forward,
            );
            friction += *torque;
        }
        held(friction, backward, forward)
    }
}

impl<const N: usize> Hysteresis for ProportionalElements<N> {
    fn stored_energy(&self, state: &Self::State) -> f32 {
        let springs = state.torques.iter().zip(&self.stiffnesses);
        springs
            .map(|(torque, stiffness)| 0.5 * torque * torque / stiffness)
            .sum()
    }

    fn initial_stiffness(&self) -> f32 {
        self.stiffnesses.iter().sum()
    }

    fn breakaway(&self) -> f32 {
        let springs = self.shares.iter().zip(&self.stiffnesses);
        springs.fold(0.0, |most, (share, stiffness)| {
            let angle = share * self.reference_limit / stiffness;
            if angle > most { angle } else { most }
        })
    }
}
