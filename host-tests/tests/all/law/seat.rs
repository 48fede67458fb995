//! The seat, and kinds of elements side by side.

use epas_friction::law::Elements;
use epas_friction::law::memory::{
    Hysteresis, ParallelElements, SLIP_6, SLIP_8, SPIN_4, SPIN_8, SeatElement, SeatState,
};
use epas_reference::presliding::elements::Elements as Exact;
use epas_reference::promises;

use crate::law::elements::{exact_limits, of_backbone, proportional, sliding_limits};
use epas_testkit::errors::Errors;
use epas_testkit::measured;
use epas_testkit::random::Random;

fn virgin<E: Elements>(_: &E) -> E::State {
    E::VIRGIN
}

/// `x <- clamp(x + dtheta)`, `T = ((|x| - g)+)^(3/2) sgn x`.
#[test]
fn friction_is_that_of_the_formula() {
    let seat = SeatElement::new(1.0, 0.5, 1.0).unwrap();
    let (mut random, mut state, mut exact) = (Random(1), SeatElement::VIRGIN, 0.0_f64);
    let mut errors = Errors::default();
    for tick in 0..200_000 {
        let turn = random.between(-2.5, 2.5) as f32;
        let [forward, backward] = [(); 2].map(|()| random.between(0.0, 3.0) as f32);
        let limits = sliding_limits(forward, backward, 1.0);
        let friction = f64::from(seat.follow(&mut state, turn, &limits));
        let end = |limit: f32| 0.5 + f64::from(limit).powf(2.0 / 3.0);
        exact = (exact + f64::from(turn)).clamp(-end(backward), end(forward));
        let true_friction = (exact.abs() - 0.5).max(0.0).powf(1.5) * exact.signum();
        errors.add_case(friction - true_friction, || tick.to_string());
        assert!(friction <= forward.into() && friction >= f64::from(-backward));
    }
    errors.assert_promised(promises::of("memory_seat"));
}

#[test]
fn play_is_free_and_sliding_is_full() {
    let seat = SeatElement::new(0.04, 1e-3, 2e-3).unwrap();
    let limits = sliding_limits(0.04, 0.03, 1.0);
    let mut state = SeatElement::VIRGIN;
    assert_eq!(seat.follow(&mut state, 1e-3, &limits), 0.0);
    assert_eq!(seat.follow(&mut state, -2e-3, &limits), 0.0);
    assert_eq!(seat.follow(&mut state, 1.0, &limits), 0.04);
    let error = state.displacement() / seat.breakaway() - 1.0;
    measured::assert("seat, place of sliding", error);
    assert_eq!(seat.follow(&mut state, -1.0, &limits), -0.03);
    // Formed again from the place: a cube root, a square root and four products. Measured: 1.2e-7.
    for turn in [0.0, f32::NAN, f32::INFINITY, 1e7] {
        assert!((seat.follow(&mut state, turn, &limits) / -0.03 - 1.0).abs() < 3.6e-7);
    }
    assert_eq!(seat.stored_energy(&SeatElement::VIRGIN), 0.0);
    for (turn, friction) in [(1e6, 0.04), (-1e6, -0.03), (1e5, 0.04)] {
        assert_eq!(seat.follow(&mut state, turn, &limits), friction);
    }
    let none = sliding_limits(0.0, 0.0, f32::NAN);
    assert_eq!(seat.follow(&mut state, -1.0, &none), 0.0);
    for limit in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0] {
        let [forward, backward] = [limit; 2];
        for turn in [1.0, -2.0] {
            let load = limit;
            seat.follow(&mut state, turn, &sliding_limits(forward, backward, load));
        }
        assert_eq!(seat.follow(&mut state, 1e3, &limits), 0.04);
    }
}

/// Two kinds with 0.3 and 0.7 of the limits: four elements beside six, and eight beside a seat. The sum of both in f64, from the same
/// place of the seat.
#[test]
fn together_they_are_the_sum_of_both() {
    let share = 0.3_f32;
    let of_tables = ParallelElements::new(
        proportional(&SPIN_4, share, 1.0),
        proportional(&SLIP_6, 1.0 - share, 1.0),
        share,
    )
    .unwrap();
    let seat = SeatElement::new(1.0 - share, 0.5, 1.0).unwrap();
    let seated = ParallelElements::new(proportional(&SLIP_8, share, 1.0), seat, share).unwrap();
    let [mut four, mut six, mut eight] =
        [&SPIN_4.elements[..], &SLIP_6.elements, &SLIP_8.elements].map(of_backbone);
    let (mut of_tables_state, mut seated_state) = (virgin(&of_tables), virgin(&seated));
    let (mut random, mut place) = (Random(11), 0.0_f64);
    let mut errors = Errors::default();
    let share = f64::from(share);
    for tick in 0..200_000 {
        let size = 10_f64.powf(random.between(-6.0, 1.0));
        let turn = random.sign() * size as f32;
        let [forward, backward] = [(); 2].map(|()| random.between(0.0, 3.0) as f32);
        let limits = sliding_limits(forward, backward, 1.0);
        let found = of_tables.follow(&mut of_tables_state, turn, &limits);
        let found_seated = seated.follow(&mut seated_state, turn, &limits);
        let [turn, forward, backward] = [turn, forward, backward].map(f64::from);
        let exact = exact_limits(forward, backward);
        let followed = |elements: &mut Exact| elements.follow(turn, exact, 1.0);
        let wanted = share * followed(&mut four) + (1.0 - share) * followed(&mut six);
        errors.add_case(f64::from(found) - wanted, || format!("{tick}: tables"));
        let end = |limit: f64| 0.5 + limit.powf(2.0 / 3.0);
        place = (place + turn).clamp(-end(backward), end(forward));
        let pressed = (place.abs() - 0.5).max(0.0).powf(1.5) * place.signum();
        let wanted = share * followed(&mut eight) + (1.0 - share) * pressed;
        errors.add_case(f64::from(found_seated) - wanted, || format!("{tick}: seat"));
        place = f64::from(seated_state.second.displacement());
    }
    errors.assert_promised(promises::of("memory_together"));
}

#[test]
fn together_they_share_the_limit() {
    let spin = proportional(&SPIN_8, 0.012, 0.1e-3);
    let seat = SeatElement::new(0.028, 1e-3, 2e-3).unwrap();
    let both = ParallelElements::new(spin, seat, 0.3).unwrap();
    let limits = sliding_limits(0.04, 0.03, 1.0);
    let mut state = virgin(&both);
    let friction = both.follow(&mut state, 0.9e-3, &limits);
    measured::assert("spin in the seat's play", friction / 0.012 - 1.0);
    for (turn, limit) in [(1.0, 0.04), (-1.0, -0.03)] {
        let friction = both.follow(&mut state, turn, &limits);
        measured::assert("spin beside the seat, limit", friction / limit - 1.0);
    }
    let parts = [
        spin.stored_energy(&state.first),
        seat.stored_energy(&state.second),
    ];
    assert!(parts.iter().all(|&part| part > 0.0));
    assert_eq!(both.stored_energy(&state), parts[0] + parts[1]);
    assert_eq!(both.breakaway(), seat.breakaway());
    assert_eq!(both.initial_stiffness(), spin.initial_stiffness());
    assert_eq!(
        ParallelElements::new(spin, seat, 1.5).unwrap_err().field(),
        "share"
    );
    assert_eq!(
        ParallelElements::new(spin, seat, f32::NAN)
            .unwrap_err()
            .field(),
        "share"
    );
    let half = ParallelElements::new(
        proportional(&SLIP_8, 0.5, 1.0),
        proportional(&SLIP_8, 0.5, 1.0),
        0.5,
    );
    let (half, whole) = (half.unwrap(), proportional(&SLIP_8, 1.0, 1.0));
    let unit = sliding_limits(1.0, 1.0, 1.0);
    let mut halves = virgin(&half);
    let mut state = epas_friction::law::memory::MemoryState::VIRGIN;
    for turn in [0.3, -0.4, 0.9, -2.0, 0.1] {
        let difference =
            half.follow(&mut halves, turn, &unit) - whole.follow(&mut state, turn, &unit);
        measured::assert("two halves of elements", difference);
    }
}

#[test]
fn set_ups_and_states_are_refused_by_field() {
    let field = |limit, play, angle| SeatElement::new(limit, play, angle).unwrap_err().field();
    assert_eq!(field(0.0, 0.0, 1.0), "reference_limit");
    assert_eq!(field(1.0, -1e-3, 1.0), "free_play");
    assert_eq!(field(1.0, 0.0, f32::NAN), "breakaway_angle");
    assert_eq!(
        SeatState::from_displacement(f32::NAN).unwrap_err().field(),
        "displacement"
    );
    assert_eq!(
        SeatState::from_displacement(1e-3).unwrap().displacement(),
        1e-3
    );
}
