//! Laws of the elements: what they are at their limits, over cycles, in the mirror, for any tick and any number.

use std::num::NonZeroUsize;

use epas_friction::Error;
use epas_friction::law::memory::{
    Backbone, BackboneElement, Hysteresis, LoadExactElements, MemoryState, Part, PreloadedElements,
    ProportionalElements, SLIP_4, SLIP_6, SLIP_8, SLIP_10, SPIN_4, SPIN_6, SPIN_8, SPIN_10,
};
use epas_friction::law::{Elements, SlidingLimits};
use epas_reference::presliding::Limits;
use epas_reference::presliding::elements::Elements as Exact;
use epas_reference::promises;

use crate::scenes::preloaded::exact_sum;
use epas_testkit::errors::Errors;
use epas_testkit::measured;
use epas_testkit::random::Random;
use gauss_quad::GaussLegendre;

const LIMITS: SlidingLimits = sliding_limits(0.05, 0.03, 1.0);

pub const fn sliding_limits(forward: f32, backward: f32, load: f32) -> SlidingLimits {
    SlidingLimits {
        forward,
        backward,
        load,
    }
}

pub const fn exact_limits(forward: f64, backward: f64) -> Limits {
    Limits { forward, backward }
}

/// The reference's elements of a backbone, and eight that come into contact with a load of up to four times the reference.
pub fn of_backbone(backbone: &[BackboneElement]) -> Exact {
    let of = |number: fn(&BackboneElement) -> f32| -> Vec<f64> {
        backbone.iter().map(|e| number(e).into()).collect()
    };
    Exact::proportional(&of(|e| e.angle), &of(|e| e.weight))
}

fn exact_by_load() -> Exact {
    Exact::load_exact(NonZeroUsize::new(8).unwrap(), 4.0)
}

pub fn proportional<const N: usize>(
    backbone: &Backbone<N>,
    limit: f32,
    breakaway_angle: f32,
) -> ProportionalElements<N> {
    let part = Part {
        backbone: &backbone.elements,
        share: 1.0,
        breakaway_angle,
    };
    ProportionalElements::new(limit, &[part]).unwrap()
}

fn slip() -> ProportionalElements<8> {
    proportional(&SLIP_8, 0.04, 2e-3)
}

fn by_load() -> LoadExactElements<8> {
    LoadExactElements::new(0.04, 2e-3, 4.0).unwrap()
}

fn mixed() -> ProportionalElements<18> {
    let part = |backbone, share, breakaway_angle| Part {
        backbone,
        share,
        breakaway_angle,
    };
    ProportionalElements::new(
        0.04,
        &[
            part(&SLIP_8.elements, 0.7, 2e-3),
            part(&SPIN_6.elements, 0.2, 0.2e-3),
            part(&SLIP_4.elements, 0.1, 1e-2),
        ],
    )
    .unwrap()
}

macro_rules! each {
    ($check:ident) => {
        $check(&slip());
        $check(&proportional(&SPIN_10, 0.04, 2e-3));
        $check(&by_load());
        $check(&LoadExactElements::<4>::new(0.04, 2e-3, 1.6).unwrap());
        $check(&LoadExactElements::<5>::new(0.04, 2e-3, 1.6).unwrap());
        $check(&mixed());
    };
}

/// The sum of eighteen torques is the limit itself, to the bit.
#[test]
fn steady_sliding_has_the_friction_of_gross_sliding() {
    fn check<E: Hysteresis>(elements: &E) {
        let mut random = Random(1);
        let mut state = E::VIRGIN;
        for _ in 0..20_000 {
            let limits = sliding_limits(
                random.between(0.0, 0.2) as f32,
                random.between(0.0, 0.2) as f32,
                random.between(1e-3, 6.0) as f32,
            );
            let sign = random.sign();
            let friction =
                elements.follow(&mut state, sign * random.between(1.0, 1e3) as f32, &limits);
            let limit = if sign > 0.0 {
                limits.forward
            } else {
                -limits.backward
            };
            assert_eq!(friction, limit, "{limits:?}");
            assert_eq!(elements.hold(&mut state, &limits), limit);
        }
    }
    each!(check);
}

#[test]
fn breakaway_is_where_all_slides() {
    fn check<E: Hysteresis>(elements: &E) {
        let unit = sliding_limits(0.04, 0.04, 1.0);
        let after = |turn| elements.follow(&mut E::VIRGIN.clone(), turn, &unit);
        let breakaway = elements.breakaway();
        // Past the breakaway by sixteen roundings of 6e-8; and a thousandth before it.
        assert_eq!(after(1.000_001 * breakaway), 0.04);
        assert!(after(0.999 * breakaway) < 0.04);
        let little = 1e-3 * breakaway;
        let stiffness = after(little) / little;
        let error = stiffness / elements.initial_stiffness() - 1.0;
        measured::assert("elements, initial stiffness", error);
    }
    each!(check);
}

/// Until an element slides all of the work is in the springs, `T theta/2`. In full sliding each holds half its friction times the turn to its
/// own sliding, which is no more than the breakaway.
#[test]
fn springs_hold_the_work_until_an_element_slides() {
    fn check<E: Hysteresis>(elements: &E) {
        let unit = sliding_limits(0.04, 0.04, 1.0);
        let mut state = E::VIRGIN;
        let breakaway = elements.breakaway();
        let turn = 1e-3 * breakaway;
        let work = 0.5 * elements.follow(&mut state, turn, &unit) * turn;
        // Derived: ten terms of four roundings of 6e-8 on either side.
        let error = elements.stored_energy(&state) / work - 1.0;
        assert!(error.abs() < 5e-6, "{error}");
        for turn in [1e-3 * breakaway, breakaway] {
            elements.follow(&mut state, turn, &unit);
            let stored = elements.stored_energy(&state);
            assert!(work < stored && stored < 0.5 * 0.04 * breakaway, "{stored}");
        }
        let full = elements.stored_energy(&state);
        elements.follow(&mut state, 10.0 * breakaway, &unit);
        assert_eq!(elements.stored_energy(&state), full);
    }
    each!(check);
    let (plain, preloaded) = (by_load(), PreloadedElements::new(by_load()));
    let mut state = MemoryState::VIRGIN;
    plain.follow(&mut state, 0.3e-3, &LIMITS);
    assert!(plain.stored_energy(&state) > 0.0);
    assert_eq!(preloaded.stored_energy(&state), plain.stored_energy(&state));
    assert_eq!(preloaded.initial_stiffness(), plain.initial_stiffness());
    assert_eq!(preloaded.breakaway(), plain.breakaway());
}

/// Load biased below breakaway, a hundred thousand cycles: nothing creeps. 1e-9 of a breakaway angle a cycle is 1e-9 of friction, too:
/// the stiffness is 1.5 in these units.
#[test]
fn nothing_drifts_below_breakaway() {
    fn check<E: Hysteresis>(elements: &E) {
        let mut state = E::VIRGIN;
        let limits = sliding_limits(0.04, 0.04, 1.0);
        let first = elements.follow(&mut state, 0.6e-3, &limits);
        let mut cycle = |turn: f32| {
            elements.follow(&mut state, -turn, &limits);
            elements.follow(&mut state, turn, &limits)
        };
        let turns = [0.15e-3, 0.3e-3, 0.05e-3];
        // What one loop has rounded stays; a cycle is not to add to it.
        let settled = turns.map(&mut cycle);
        assert!(
            settled
                .iter()
                // Derived: six turns of eight elements, whose roundings of 6e-8 add up at random, and some room.
                .all(|friction| (friction - first).abs() < 1e-6 * first)
        );
        const CYCLES: u32 = 100_000;
        for _ in 0..CYCLES {
            let _ = turns.map(&mut cycle);
        }
        let drift = f64::from(cycle(0.15e-3) - settled[2]).abs() / f64::from(CYCLES) / 0.04;
        // No rounding adds up: what is found is none at all. A hundred thousand cycles at the bound are a ten-thousandth of friction.
        assert!(drift < 1e-9);
    }
    each!(check);
}

#[test]
fn minor_loops_close() {
    fn check<E: Hysteresis>(elements: &E) {
        let mut random = Random(4);
        let mut worst = 0.0_f32;
        for _ in 0..2_000 {
            let mut state = E::VIRGIN;
            let mut turned = |turn: f64| elements.follow(&mut state, turn as f32, &LIMITS);
            turned(random.between(-4e-3, 4e-3));
            let sign = f64::from(random.sign());
            let stroke = random.between(0.1e-3, 2e-3);
            let outer = turned(sign * stroke);
            let mut open = 0.0;
            for _ in 0..4 {
                // Turns of 23 bits, so that the way back is as long as the way out.
                let inner = f64::from(random.between(0.0, stroke) as f32);
                turned(-sign * inner);
                open = turned(sign * inner) - outer;
            }
            worst = worst.max(open.abs());
        }
        // Friction of 0.05 N m: roundings of 2^-24 a tick and element, and the snap to the limit. Measured: 7.5e-9 N m.
        assert!(worst < 2.2e-8);
    }
    each!(check);
}

/// Ticks in between change nothing: the clamp is exact for a steady turn.
#[test]
fn halved_ticks_have_the_same_friction() {
    fn check<E: Hysteresis>(elements: &E) {
        let mut random = Random(5);
        let (mut whole, mut parts) = (E::VIRGIN, E::VIRGIN);
        let mut worst = 0.0_f32;
        for _ in 0..5_000 {
            let turn = random.between(-3e-3, 3e-3) as f32;
            let friction = elements.follow(&mut whole, turn, &LIMITS);
            let ticks = 1 << random.below(5);
            let mut last = 0.0;
            for _ in 0..ticks {
                last = elements.follow(&mut parts, turn / ticks as f32, &LIMITS);
            }
            worst = worst.max((friction - last).abs());
        }
        // Up to sixteen times as many roundings of 2^-24 of 0.05 N m. Measured: 2.2e-8 N m.
        assert!(worst < 6.6e-8);
    }
    each!(check);
}

#[test]
fn the_mirror_image_is_the_same_to_the_bit() {
    fn check<E: Hysteresis>(elements: &E) {
        let mut random = Random(6);
        let (mut state, mut image) = (E::VIRGIN, E::VIRGIN);
        for _ in 0..5_000 {
            let turn = random.between(-2e-3, 2e-3) as f32;
            let limits = sliding_limits(
                random.between(0.01, 0.06) as f32,
                random.between(0.01, 0.06) as f32,
                random.between(0.0, 4.0) as f32,
            );
            let mirrored = sliding_limits(limits.backward, limits.forward, limits.load);
            let friction = elements.follow(&mut state, turn, &limits);
            assert_eq!(elements.follow(&mut image, -turn, &mirrored), -friction);
        }
    }
    each!(check);
}

/// A turn from 1e-6 to 1e9 breakaway angles, any stiffness that a set-up takes: friction is within its limits.
#[test]
fn any_turn_and_any_stiffness() {
    let mut random = Random(7);
    for breakaway_angle in [1e-9, 1e-6, 1e-3, 1.0, 1e3] {
        for limit in [1e-9, 1e-3, 1.0, 1e9] {
            let part = proportional(&SLIP_10, limit, breakaway_angle);
            let by_load = LoadExactElements::<10>::new(limit, breakaway_angle, 10.0).unwrap();
            let (mut first, mut second) = (MemoryState::VIRGIN, MemoryState::VIRGIN);
            for _ in 0..2_000 {
                let size = f64::from(breakaway_angle) * 10_f64.powf(random.between(-6.0, 9.0));
                let turn = random.sign() * size as f32;
                let limits = sliding_limits(
                    limit * random.unit(),
                    limit * random.unit(),
                    20.0 * random.unit(),
                );
                for friction in [
                    part.follow(&mut first, turn, &limits),
                    by_load.follow(&mut second, turn, &limits),
                ] {
                    assert!(friction <= limits.forward && friction >= -limits.backward);
                }
            }
        }
    }
}

#[test]
fn nan_and_infinity_do_no_harm() {
    fn check<E: Hysteresis>(elements: &E) {
        let numbers = [
            f32::NAN,
            f32::INFINITY,
            f32::NEG_INFINITY,
            0.0,
            -0.0,
            1e-40,
            -1.0,
            f32::MAX,
        ];
        for turn in numbers {
            for forward in numbers {
                for backward in numbers {
                    for load in numbers {
                        let mut state = E::VIRGIN;
                        elements.follow(&mut state, 1e-3, &LIMITS);
                        let limits = sliding_limits(forward, backward, load);
                        let friction = elements.follow(&mut state, turn, &limits);
                        let is_sound = [forward, backward]
                            .iter()
                            .all(|limit| limit.abs() <= f32::MAX);
                        assert!(
                            !is_sound || friction.is_finite(),
                            "{turn} {limits:?}: {friction}"
                        );
                        // An infinite limit may have been taken for friction: it takes a tick more.
                        let friction = elements.follow(&mut state, 0.1, &LIMITS);
                        assert!((-LIMITS.backward..=LIMITS.forward).contains(&friction));
                        let friction = elements.follow(&mut state, 0.1, &LIMITS);
                        assert_eq!(friction, LIMITS.forward, "{turn} {limits:?}");
                    }
                }
            }
        }
        let mut state = E::VIRGIN;
        let held = elements.follow(&mut state, 0.3e-3, &LIMITS);
        for turn in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e7] {
            assert_eq!(elements.follow(&mut state, turn, &LIMITS), held);
        }
        let none = sliding_limits(0.0, 0.0, 0.0);
        assert_eq!(elements.follow(&mut state, 1.0, &none), 0.0);
        assert_eq!(elements.stored_energy(&state), 0.0);
    }
    each!(check);
    let mut state = MemoryState::VIRGIN;
    let unloaded = SlidingLimits {
        load: 0.0,
        ..LIMITS
    };
    assert_eq!(by_load().follow(&mut state, 1e-3, &unloaded), 0.0);
    assert_eq!(state, MemoryState::VIRGIN);
}

/// Between 2^-9 and four times the reference in limits and load, turns from 1e-6 of a breakaway angle on: f32 against f64,
/// of the reference limit.
#[test]
fn rounding_is_as_promised() {
    fn compare<E: Elements>(elements: &E, exact: &mut Exact, errors: &mut Errors) {
        let mut random = Random(8);
        let mut state = E::VIRGIN;
        for tick in 0..200_000 {
            let turn = f64::from(random.sign()) * 10_f64.powf(random.between(-6.0, 1.0));
            let [forward, backward, load] = [(); 3].map(|()| random.between(0.0, 4.0) as f32);
            let turn = turn as f32;
            let friction =
                elements.follow(&mut state, turn, &sliding_limits(forward, backward, load));
            let [t, f, b, l] = [turn, forward, backward, load].map(f64::from);
            errors.add_case(
                f64::from(friction) - exact.follow(t, exact_limits(f, b), l),
                || tick.to_string(),
            );
        }
    }
    fn in_proportion<const N: usize>(backbone: &Backbone<N>, errors: &mut Errors) {
        let mut exact = of_backbone(&backbone.elements);
        compare(&proportional(backbone, 1.0, 1.0), &mut exact, errors);
    }
    let mut proportional_errors = Errors::default();
    in_proportion(&SLIP_8, &mut proportional_errors);
    in_proportion(&SPIN_8, &mut proportional_errors);
    in_proportion(&SLIP_6, &mut proportional_errors);
    in_proportion(&SPIN_4, &mut proportional_errors);
    proportional_errors.assert_promised(promises::of("memory"));
    let mut errors = Errors::default();
    compare(
        &LoadExactElements::<8>::new(1.0, 1.0, 4.0).unwrap(),
        &mut exact_by_load(),
        &mut errors,
    );
    errors.assert_promised(promises::of("memory_load_exact"));
}

/// Elements of a preloaded screw against elements in f64 under the exact load of both flanks; a caged screw tells `1 + F/(2 sqrt(2) P)`.
#[test]
fn flanks_share_as_promised() {
    let elements = PreloadedElements::new(LoadExactElements::<8>::new(1.0, 1.0, 4.0).unwrap());
    let mut exact = exact_by_load();
    let (mut random, mut state) = (Random(9), LoadExactElements::<8>::VIRGIN);
    let mut errors = Errors::default();
    for tick in 0..100_000 {
        let turn = random.sign() * 10_f64.powf(random.between(-6.0, 1.0)) as f32;
        let [forward, backward] = [(); 2].map(|()| random.between(0.0, 4.0) as f32);
        let load = random.between(1.0, 4.0) as f32;
        let limits = sliding_limits(forward, backward, load);
        let found = f64::from(elements.follow(&mut state, turn, &limits));
        let [turn, forward, backward, load] = [turn, forward, backward, load].map(f64::from);
        let wanted = exact.follow(
            turn,
            exact_limits(forward, backward),
            exact_sum(8_f64.sqrt() * (load - 1.0), 1.0),
        );
        errors.add_case(found - wanted, || format!("{tick}: {load}"));
    }
    errors.assert_promised(promises::of("memory_preloaded"));
}

#[test]
fn states_are_taken_out_and_put_back() {
    let elements = slip();
    let mut state = MemoryState::VIRGIN;
    elements.follow(&mut state, 1e-3, &LIMITS);
    assert_eq!(MemoryState::from_held(state.held()), Ok(state));
    for bad in [f32::NAN, f32::INFINITY, 1e13] {
        let mut held = state.held();
        held[3] = bad;
        assert_eq!(MemoryState::from_held(held).unwrap_err().field(), "held");
    }
}

#[test]
fn set_ups_are_refused_by_field() {
    let part = |share, breakaway_angle| Part {
        backbone: &SLIP_8.elements,
        share,
        breakaway_angle,
    };
    let field = |limit, parts: &[Part]| {
        ProportionalElements::<8>::new(limit, parts)
            .unwrap_err()
            .field()
    };
    assert_eq!(field(0.0, &[part(1.0, 1e-3)]), "reference_limit");
    assert_eq!(field(f32::NAN, &[part(1.0, 1e-3)]), "reference_limit");
    assert_eq!(field(1.0, &[part(1.0, 0.0)]), "breakaway_angle");
    assert_eq!(field(1.0, &[part(0.0, 1e-3)]), "share");
    assert_eq!(field(1.0, &[part(0.9, 1e-3)]), "shares");
    assert_eq!(field(1.0, &[part(0.5, 1e-3), part(0.5, 1e-3)]), "parts");
    assert_eq!(field(1.0, &[]), "parts");
    let with = |angle, weight| {
        let mut backbone = SLIP_8.elements;
        backbone[2] = BackboneElement { angle, weight };
        let part = Part {
            backbone: &backbone,
            share: 1.0,
            breakaway_angle: 1e-3,
        };
        field(1.0, &[part])
    };
    assert_eq!(with(0.0, 0.1), "angle");
    assert_eq!(with(0.5, f32::NAN), "weight");
    let by_load = |limit, angle, load| {
        LoadExactElements::<8>::new(limit, angle, load)
            .unwrap_err()
            .field()
    };
    assert_eq!(by_load(-1.0, 1e-3, 1.0), "reference_limit");
    assert_eq!(by_load(1.0, f32::INFINITY, 1.0), "breakaway_angle");
    assert_eq!(by_load(1.0, 1e-3, 0.0), "largest_load");
}

#[test]
fn too_few_elements_are_refused() {
    fn slides<E: Elements>(elements: &E) -> f32 {
        let mut state = E::VIRGIN;
        elements.follow(&mut state, 1.0, &LIMITS)
    }
    fn in_proportion<const N: usize>() -> Result<f32, Error> {
        let half = BackboneElement {
            angle: 1.0,
            weight: 0.5,
        };
        let part = Part {
            backbone: &[half; 2],
            share: 1.0,
            breakaway_angle: 1e-3,
        };
        ProportionalElements::<N>::new(0.04, &[part]).map(|elements| slides(&elements))
    }
    fn by_load<const N: usize>() -> Result<f32, Error> {
        LoadExactElements::<N>::new(0.04, 1e-3, 1.0).map(|elements| slides(&elements))
    }
    for (error, number, least) in [
        (in_proportion::<0>().unwrap_err(), 0.0, 2.0),
        (in_proportion::<1>().unwrap_err(), 1.0, 2.0),
        (by_load::<0>().unwrap_err(), 0.0, 1.0),
    ] {
        assert_eq!((error.field(), error.value()), ("N", number));
        assert_eq!(error.allowed().minimum, least);
    }
    assert_eq!(in_proportion::<2>(), Ok(LIMITS.forward));
    assert_eq!(by_load::<1>(), Ok(LIMITS.forward));
}

/// The compiler's nodes are those of another program, for any number of them.
#[test]
fn springs_stand_at_the_nodes_of_gauss() {
    fn check<const N: usize>() {
        let stiffnesses = LoadExactElements::<N>::new(1.0, 1.0, 1.0)
            .unwrap()
            .stiffnesses();
        let rule = GaussLegendre::new(N.try_into().unwrap());
        let weights = rule.as_node_weight_pairs().iter();
        let mut exact: Vec<f64> = weights.map(|(_, weight)| 0.75 * weight).collect();
        let mut found = stiffnesses.map(f64::from).to_vec();
        exact.sort_by(f64::total_cmp);
        found.sort_by(f64::total_cmp);
        for (found, exact) in found.into_iter().zip(exact) {
            // Five roundings: of the weight, half the width and their products.
            assert!((found / exact - 1.0).abs() < 5.0 * 6e-8, "{N}");
        }
    }
    check::<1>();
    check::<4>();
    check::<6>();
    check::<8>();
    check::<10>();
    check::<33>();
}
