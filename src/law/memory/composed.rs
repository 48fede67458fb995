//! Elements made of others: at the load that two preloaded flanks share, and two kinds side by side.

use super::Hysteresis;
use crate::ball::PreloadSum;
use crate::error::{Error, attempt, in_range};
use crate::law::{Elements, SlidingLimits};
use crate::stored::{Fingerprint, Fingerprinted, Port, Refusal, Stored};

/// Preload over the load that a screw tells its elements without an axial load: `1/(2 sqrt(2))`.
const PRELOAD: f32 = 0.353_553_4;

/// Load-exact elements of a screw with a preload `F_0` of each flank, whose reference load is that without an axial load.
///
/// Every scene of a screw tells its elements the load `2 sqrt(2) F_0 + |F|` under an axial load `F`. Its contacts carry the sum of both flanks:
/// `2 F_0` without a load, hardly more up to `F = F_0`, and `F` once one flank is lost, from `2 sqrt(2) F_0` on. The difference is 41 % of the load
/// there, and 19 % of the breakaway angle. 30 cycles beyond the elements'. A bearing's load holds its preload already; with these elements its
/// memory does not compile:
///
/// ```compile_fail,E0080
/// # use epas_friction::law::coefficient::OneCoefficient;
/// # use epas_friction::law::memory::{LoadExactElements, PreloadedElements};
/// # use epas_friction::law::motion::SpeedOverTick;
/// # use epas_friction::{FrictionModel, LinearBearingTrain, scene::WithMemory};
/// type Elements = PreloadedElements<LoadExactElements<8>>;
/// type Bearing = WithMemory<LinearBearingTrain<12>, Elements, SpeedOverTick, OneCoefficient>;
/// let set_up: fn(&_) -> _ = FrictionModel::<Bearing>::new;
/// ```
///
/// ```
/// use epas_friction::law::memory::{LoadExactElements, MemoryState, PreloadedElements};
/// use epas_friction::law::{Elements, SlidingLimits};
///
/// let elements = PreloadedElements::new(LoadExactElements::<8>::new(0.04, 2e-3, 4.0)?);
/// let limits = SlidingLimits { forward: 0.05, backward: 0.03, load: 1.3 };
/// let mut state = MemoryState::VIRGIN;
/// assert_eq!(elements.follow(&mut state, 0.1, &limits), 0.05);
/// # Ok::<(), epas_friction::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreloadedElements<E> {
    pub(super) elements: E,
    flanks: PreloadSum,
}

impl<E: Copy> PreloadedElements<E> {
    /// These elements at the sum of both flanks ([`Self::shared`]).
    pub const fn new(elements: E) -> Self {
        Self {
            elements,
            flanks: PreloadSum::new(PRELOAD),
        }
    }

    /// The elements at the sum of both flanks, for a program in another language; [`Self::numbers`] are those of the sum.
    #[doc(hidden)]
    #[must_use]
    pub const fn elements(&self) -> E {
        self.elements
    }
}

impl<E> PreloadedElements<E> {
    /// Inverse of the sum without an axial load, `2 F_0`.
    const PER_SUM: f32 = 0.5 / PRELOAD;

    /// What [`Self::shared`] computes with: load at which a flank lifts off, sum without a load, its two coefficients, and the sum's inverse.
    #[doc(hidden)]
    #[must_use]
    pub const fn numbers(&self) -> [f32; 5] {
        let [lift_off, constant, square, quartic] = self.flanks.numbers();
        [lift_off, constant, square, quartic, Self::PER_SUM]
    }

    /// Sum of both flanks' loads from the load that a screw tells its elements, each over that without an axial load, 1 or more.
    #[inline]
    pub fn shared(&self, load: f32) -> f32 {
        Self::PER_SUM * self.flanks.under(load - 1.0)
    }
}

impl<E: Elements> Elements for PreloadedElements<E> {
    type State = E::State;

    const VIRGIN: Self::State = E::VIRGIN;

    const PRELOADED: bool = true;

    #[inline]
    fn follow(&self, state: &mut Self::State, turn: f32, limits: &SlidingLimits) -> f32 {
        let load = self.shared(limits.load);
        self.elements
            .follow(state, turn, &SlidingLimits { load, ..*limits })
    }
}

impl<E: Hysteresis> Hysteresis for PreloadedElements<E> {
    fn stored_energy(&self, state: &Self::State) -> f32 {
        self.elements.stored_energy(state)
    }

    fn initial_stiffness(&self) -> f32 {
        self.elements.initial_stiffness()
    }

    fn breakaway(&self) -> f32 {
        self.elements.breakaway()
    }
}

const PRELOADED: u32 = 5;

impl<E: Fingerprinted> Fingerprinted for PreloadedElements<E> {
    fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        fingerprint.count(PRELOADED);
        self.elements.fingerprint(fingerprint);
    }
}

/// Two kinds of elements that turn together and share the friction, `T = A(share T±) + B((1 - share) T±)`: spin beside the seat, as with
/// clearance. Passive as both are. Cost: both, and 6 cycles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParallelElements<A, B> {
    pub(super) first: A,
    pub(super) second: B,
    pub(super) share: f32,
}

/// State of two kinds of elements.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ParallelElementsState<A, B> {
    /// State of the first ones.
    pub first: A,
    /// State of the second ones.
    pub second: B,
}

impl<A: Copy, B: Copy> ParallelElements<A, B> {
    /// Both; the first ones' reference limits are `share` (0 to 1) of the whole, the second ones' the rest.
    pub const fn new(first: A, second: B, share: f32) -> Result<Self, Error> {
        let share = attempt!(in_range("share", share, 0.0, 1.0));
        Ok(Self {
            first,
            second,
            share,
        })
    }
}

impl<A: Elements, B: Elements> Elements for ParallelElements<A, B> {
    type State = ParallelElementsState<A::State, B::State>;

    const VIRGIN: Self::State = ParallelElementsState {
        first: A::VIRGIN,
        second: B::VIRGIN,
    };

    const PRELOADED: bool = A::PRELOADED || B::PRELOADED;

    #[inline]
    fn follow(&self, state: &mut Self::State, turn: f32, limits: &SlidingLimits) -> f32 {
        let first = SlidingLimits {
            forward: self.share * limits.forward,
            backward: self.share * limits.backward,
            load: limits.load,
        };
        // Differences, so that both add up to the whole.
        let second = SlidingLimits {
            forward: limits.forward - first.forward,
            backward: limits.backward - first.backward,
            load: limits.load,
        };
        self.first.follow(&mut state.first, turn, &first)
            + self.second.follow(&mut state.second, turn, &second)
    }
}

impl<A: Hysteresis, B: Hysteresis> Hysteresis for ParallelElements<A, B> {
    fn stored_energy(&self, state: &Self::State) -> f32 {
        self.first.stored_energy(&state.first) + self.second.stored_energy(&state.second)
    }

    fn initial_stiffness(&self) -> f32 {
        self.first.initial_stiffness() + self.second.initial_stiffness()
    }

    fn breakaway(&self) -> f32 {
        let (first, second) = (self.first.breakaway(), self.second.breakaway());
        if first > second { first } else { second }
    }
}

const PARALLEL: u32 = 4;

impl<A: Stored, B: Stored> Stored for ParallelElementsState<A, B> {
    const BYTES: usize = A::BYTES + B::BYTES;

    fn exchange<P: Port>(&mut self, port: &mut P) -> Result<(), Refusal> {
        self.first.exchange(port)?;
        self.second.exchange(port)
    }
}

impl<A: Fingerprinted, B: Fingerprinted> Fingerprinted for ParallelElements<A, B> {
    fn fingerprint(&self, fingerprint: &mut Fingerprint) {
        fingerprint.count(PARALLEL);
        self.first.fingerprint(fingerprint);
        self.second.fingerprint(fingerprint);
        fingerprint.number(self.share);
    }
}
