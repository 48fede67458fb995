//! Screws without cage while they run: reversal, return, loads of the balls, angle, regime, inputs that are none.

use epas_testkit::gears::screw_inputs;
use std::f32::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

use epas_friction::{
    Faults, FrictionModel, Inputs, Limits, LoadShare, LoadShares, Regime, UncagedBallScrew,
    UncagedBallScrewConfiguration,
};

use epas_testkit::gears::{self, SCREW_BALLS, UncagedScrew, changed, loaded_length, screw_wave};
use epas_testkit::measured;

const TICK: f32 = 1e-3;

pub type Model = FrictionModel<UncagedBallScrew<SCREW_BALLS>>;

pub fn configuration(share: f32) -> UncagedBallScrewConfiguration {
    gears::full(screw_wave(share), TICK)
}

pub fn inputs(nut_speed: f32, axial_load: f32) -> Inputs {
    screw_inputs(nut_speed, axial_load)
}

#[test]
fn reversal_turns_friction_and_releases_the_balls() {
    let mut model = Model::new(&configuration(1.0)).unwrap();
    let step = |model: &mut Model, nut_speed: f32| model.step(inputs(nut_speed, -1500.0));
    for _ in 0..290 {
        step(&mut model, 6.0);
    }
    let before = step(&mut model, 6.0);
    assert!(before.contacts > 10 && before.friction_torque > 0.0);
    let positions: Vec<_> = model.state().circuit.train.positions().collect();
    for _ in 0..1000 {
        let rest = step(&mut model, 0.0);
        assert_eq!(
            (rest.friction_torque, rest.regime, rest.faults.faulty()),
            (0.0, Regime::Standing, false)
        );
    }
    let now: Vec<_> = model.state().circuit.train.positions().collect();
    assert_eq!(now, positions);
    // Backwards, the balls that had run up part again: from the first tick on none of those pairs presses.
    let back = step(&mut model, -6.0);
    assert!(back.friction_torque < 0.0);
    assert!(back.contacts < before.contacts / 2, "{back:?}");
    for _ in 0..290 {
        let output = step(&mut model, -6.0);
        assert!(output.groove_torque < 0.0 && output.ball_torque <= 0.0);
    }
}

/// Through the reversal speed friction is smooth: 71 % at it, and odd.
#[test]
fn near_standstill_a_share_of_the_friction_is_left() {
    let mut slow = Model::new(&configuration(0.0)).unwrap();
    let mut blended = |nut_speed: f32| slow.step(inputs(nut_speed, -1500.0)).friction_torque;
    let full = blended(10.0);
    for (speed, share) in [(1e-3, FRAC_1_SQRT_2), (1e-4, 101_f32.sqrt().recip())] {
        for way in [1.0, -1.0] {
            // Backward the load opposes the motion, which is another branch of the law.
            let full = if way > 0.0 { full } else { -blended(-10.0) };
            let error = way * blended(way * speed) / full - share;
            assert!(error.abs() < 3e-7, "{speed} {way}: {error}");
        }
    }
}

#[test]
fn a_return_without_load_takes_its_share_of_the_balls() {
    // Half as long again as the loaded part: every loaded ball carries 1.5 times as much.
    let plain = configuration(0.0);
    let with_return = UncagedBallScrewConfiguration {
        return_length: 0.5 * loaded_length(&plain),
        ..plain
    };
    let mut model = Model::new(&with_return).unwrap();
    let mut plain = Model::new(&plain).unwrap();
    let (mut sum, mut largest_force) = (0.0, 0.0_f32);
    let whole = plain.step(inputs(5.0, 3000.0));
    for _ in 0..20_000 {
        let output = model.step(inputs(5.0, 2000.0));
        sum += f64::from(output.groove_torque) / 20_000.0;
        largest_force = largest_force.max(output.largest_contact_force);
    }
    // Two thirds of the balls carry what all carry under 1.5 times the load; but a ball on the run-in loses less than in proportion to its load: with
    // the power of 7/6, 1/2 - 1/(2 + 1/6) = 0.038 of a ball on each, of 24.7.
    let ratio = sum / (f64::from(whole.groove_torque) / 1.5);
    assert!((ratio - 1.0 + 2.0 * 0.0385 / 24.67).abs() < 1e-3, "{ratio}");
    // Balls in the return have no speed of their own: none presses with more than its impedance. Derived: that is 1e-6 N for a
    // speed as large as that of all.
    assert!(largest_force < 1e-6);
}

/// A track so long behind its loaded part that at times no ball is loaded: those that come under load carry it all the same.
#[test]
fn a_zone_that_was_empty_is_loaded_again() {
    let configuration = UncagedBallScrewConfiguration {
        balls: 4,
        turns: 1.0,
        return_length: 0.5,
        ..gears::even()
    };
    let mut model = FrictionModel::<UncagedScrew<4>>::new(&configuration).unwrap();
    let friction: Vec<f32> = (0..60_000)
        .map(|_| model.step(inputs(20.0, 3000.0)).groove_torque)
        .collect();
    for minute in friction.chunks(20_000) {
        let loaded = minute.iter().filter(|torque| **torque > 0.0).count();
        assert!((10_000..20_000).contains(&loaded), "{loaded}");
    }
}

pub fn table<const M: usize>(shares: [f32; M]) -> &'static [LoadShare] {
    Box::leak(Box::new(shares.map(|share| LoadShare::new(share).unwrap())))
}

#[test]
fn shares_of_the_load_go_to_their_balls() {
    let uneven = UncagedBallScrewConfiguration {
        load_shares: LoadShares::same(table(std::array::from_fn::<_, 32, _>(|part| {
            if part < 16 { 1.99 } else { 0.01 }
        }))),
        ..configuration(0.0)
    };
    let step = |configuration: &UncagedBallScrewConfiguration, axial_load: f32| {
        let mut model = Model::new(configuration).unwrap();
        model.step(inputs(5.0, axial_load)).groove_torque
    };
    // 37 balls, an odd number: 18 or 19 in the first half (1/37 of the torque), which carries 99.5 % of the load. Twice the load on half
    // of the balls is what twice the axial load makes on all, halved.
    let expected = 0.5 * step(&configuration(0.0), 2000.0);
    let found = step(&uneven, 1000.0);
    assert!(
        (found / expected - 1.0).abs() < 1.5 / 37.0,
        "{found} {expected}"
    );
}

/// The torque limit holds and says so; parts are output as they are.
#[test]
fn the_torque_is_limited() {
    let full = configuration(1.0);
    let tight = UncagedBallScrewConfiguration {
        folded: changed(full.folded, |folded| {
            folded.limits = Limits {
                friction_torque: 0.01,
                ..folded.limits
            };
        }),
        ..full
    };
    let output = Model::new(&tight).unwrap().step(inputs(4.0, 900.0));
    assert_eq!(output.friction_torque, 0.01);
    assert!(output.faults.contains(Faults::FRICTION_LIMIT));
    assert!(output.groove_torque > 0.01);
}

#[test]
fn the_nut_angle_moves_the_screw_under_the_balls() {
    let mut there = Model::new(&configuration(0.9)).unwrap();
    let mut opposite = Model::new(&configuration(-0.9)).unwrap();
    there.set_nut_angle(FRAC_PI_2);
    let mut pressing = 0;
    for _ in 0..500 {
        let (a, b) = (
            there.step(inputs(6.0, -1500.0)),
            opposite.step(inputs(6.0, -1500.0)),
        );
        assert_eq!(a.contacts, b.contacts);
        pressing += u32::from(a.contacts);
        let difference = a.ball_torque - b.ball_torque;
        measured::assert("quarter of a turn, ball torque in N m", difference);
    }
    assert!(pressing > 1000, "{pressing}");
    there.set_nut_angle(f32::NAN);
    let outputs = there.step(inputs(6.0, -1500.0));
    assert!(outputs.friction_torque.is_finite() && !outputs.faults.any());
}

/// What a screw does follows from its full friction, however little of it passes near the reversal.
#[test]
fn the_regime_is_that_of_full_friction() {
    let even = gears::even();
    let flat = gears::UncagedConfiguration {
        folded: changed(even.folded, |folded| folded.lead = 0.07e-3),
        ..even
    };
    let mut model = FrictionModel::<UncagedScrew<SCREW_BALLS>>::new(&flat).unwrap();
    let mut small = 0;
    let reversal_speed = flat.folded.reversal_speed;
    for share in [0.02_f32, 1.2, 2.0, 10.0, 600.0] {
        let found = model.step(inputs(-share * reversal_speed, 1000.0));
        small += i32::from(found.friction_torque.abs() < found.load_torque);
        let expected = if share < 1.0 {
            Regime::Standing
        } else {
            Regime::Locked
        };
        assert_eq!(found.regime, expected, "{share}");
    }
    assert!((1..5).contains(&small), "{small}");
}
