//! Friction makes no energy: work less what is stored never falls, whatever limits and loads do.

use std::f64::consts::LN_10;

use epas_friction::law::SlidingLimits;
use epas_friction::law::memory::{
    Hysteresis, LoadExactElements, MemoryState, ParallelElements, ParallelElementsState,
    ProportionalElements, SLIP_8, SPIN_8, SeatElement, SeatState,
};

use crate::law::elements::proportional;
use epas_testkit::random::Random;

const TICKS: u64 = 1_000_000;

/// A random tick: turns from 1e-4 to 10 breakaway angles, and rarely far beyond; limits and load from 0 to three times the
/// reference, that jump or hold.
struct Ticks {
    random: Random,
    limits: SlidingLimits,
}

impl Ticks {
    const fn new(seed: u64) -> Self {
        Self {
            random: Random(seed),
            limits: SlidingLimits {
                forward: 1.0,
                backward: 1.0,
                load: 1.0,
            },
        }
    }

    fn next(&mut self) -> (f32, SlidingLimits) {
        let random = &mut self.random;
        if random.one_in(3) {
            let load = random.between(0.0, 3.0);
            self.limits = SlidingLimits {
                forward: (load * random.between(0.3, 1.7)) as f32,
                backward: (load * random.between(0.3, 1.7)) as f32,
                load: load as f32,
            };
            if random.one_in(50) {
                self.limits = SlidingLimits {
                    forward: 0.0,
                    backward: 0.0,
                    load: 0.0,
                };
            }
        }
        let turn = if random.one_in(1000) {
            1e3
        } else {
            (LN_10 * random.between(-4.0, 1.0)).exp()
        };
        (random.sign() * turn as f32, self.limits)
    }
}

/// Least of work less the growth of stored energy in a tick, over the reference limit times the breakaway angle. Their sum from
/// the start on is never below -1e-6.
fn least<E: Hysteresis>(
    elements: &E,
    stored: impl Fn(&E::State) -> f64,
    seed: u64,
    count: u64,
) -> f64 {
    let mut ticks = Ticks::new(seed);
    let mut state = E::VIRGIN;
    let (mut least, mut before, mut balance) = (0.0_f64, 0.0, 0.0_f64);
    let mut least_balance = 0.0_f64;
    for _ in 0..count {
        let (turn, limits) = ticks.next();
        let friction = elements.follow(&mut state, turn, &limits);
        let after = stored(&state);
        let lost = f64::from(friction) * f64::from(turn) - (after - before);
        before = after;
        least = least.min(lost);
        balance = (balance + lost).min(1e6);
        least_balance = least_balance.min(balance);
    }
    assert!(least_balance >= -1e-6, "{least_balance:e}");
    least
}

fn energy(torques: &[f32], stiffnesses: &[f32]) -> f64 {
    let springs = torques.iter().zip(stiffnesses);
    springs
        .map(|(&f, &k)| f64::from(f).powi(2) / (2.0 * f64::from(k)))
        .sum()
}

fn every_kind(count: u64) {
    // Of the scale: the largest limit, 5.1 times the reference, over a breakaway angle. Half an ulp of such a friction times a
    // turn of up to a few breakaway angles that stick is 3e-7 of it times 3.
    const ACCEPTED: f64 = -1e-6 * 5.1;
    let check = |name: &str, found: f64| {
        assert!(found >= ACCEPTED, "{name}: {found:e}");
    };
    let of = |elements: &ProportionalElements<8>, seed| {
        let stiffnesses = elements.stiffnesses();
        least(
            elements,
            |state| energy(&elements.torques(state), &stiffnesses),
            seed,
            count,
        )
    };
    check("slip", of(&proportional(&SLIP_8, 1.0, 1.0), 1));
    check("spin", of(&proportional(&SPIN_8, 1.0, 1.0), 2));
    let by_load = LoadExactElements::<8>::new(1.0, 1.0, 3.0).unwrap();
    let stiffnesses = by_load.stiffnesses();
    check(
        "load-exact",
        least(
            &by_load,
            |state| energy(&state.held(), &stiffnesses),
            3,
            count,
        ),
    );
    let seat = SeatElement::new(1.0, 0.5, 1.0).unwrap();
    let seated = |place: f32| 0.4 * (f64::from(place).abs() - 0.5).max(0.0).powf(2.5);
    check(
        "seat",
        least(&seat, |state| seated(state.displacement()), 4, count),
    );
    let spin = proportional(&SPIN_8, 0.3, 0.2);
    let stiffnesses = spin.stiffnesses();
    let seat = SeatElement::new(0.7, 0.5, 1.0).unwrap();
    let both = ParallelElements::new(spin, seat, 0.3).unwrap();
    let stored = |state: &ParallelElementsState<MemoryState<8>, SeatState>| {
        energy(&spin.torques(&state.first), &stiffnesses)
            + 0.7 * seated(state.second.displacement())
    };
    check("spin beside the seat", least(&both, stored, 5, count));
}

#[test]
fn friction_makes_no_energy() {
    every_kind(TICKS);
}

#[test]
#[ignore = "1e9 ticks"]
fn friction_makes_no_energy_in_a_long_run() {
    every_kind(200_000_000);
}
