//! Screws without cage while they run: reversal, return, loads of their own, what is set, flags, inputs that are none.

use std::f32::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

use epas_friction::{
    Faults, FrictionModel, Inputs, Limits, LoadShare, LoadShares, Outputs, Regime,
    UncagedBallScrew, UncagedBallScrewConfiguration,
};

use crate::kit::gears::{
    self, BALL, BALL_RANGE, SCREW_BALLS, UncagedScrew, changed, loaded_length, screw_wave,
};
use crate::kit::measured;

const TICK: f32 = 1e-3;

type Model = FrictionModel<UncagedBallScrew<SCREW_BALLS>>;

/// Two waves a turn on the screw, as a share of the largest.
fn configuration(share: f32) -> UncagedBallScrewConfiguration {
    gears::full(screw_wave(share), TICK)
}

fn inputs(nut_speed: f32, axial_load: f32) -> Inputs {
    Inputs {
        nut_speed,
        axial_load,
    }
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
    // At rest nothing rubs; the train stays where it is.
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
            // A reciprocal root and two products.
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
    // Two thirds of the balls carry what all carry under 1.5 times the load; in the mean, to a ball that comes or goes of 20 000 ticks.
    let ratio = sum / (f64::from(whole.groove_torque) / 1.5);
    println!(
        "groove torque with return over two thirds: {ratio:.5}, largest force {largest_force} N"
    );
    assert!((ratio - 1.0).abs() < 2e-3, "{ratio}");
    // Balls in the return have no speed of their own: none presses with more than its impedance. Derived: that is 1e-6 N for a
    // speed as large as that of all.
    assert!(largest_force < 1e-6);
}

/// A track so long behind its loaded part that at times no ball is loaded: those that come under load carry it all the same.
#[test]
fn a_zone_that_was_empty_is_loaded_again() {
    let configuration = UncagedBallScrewConfiguration {
        turns: 1.0,
        return_length: 0.5,
        ..gears::even()
    };
    let mut model = FrictionModel::<UncagedScrew<4>>::new(&configuration).unwrap();
    let friction: Vec<f32> = (0..60_000)
        .map(|_| model.step(inputs(20.0, 3000.0)).groove_torque)
        .collect();
    // One ball of four is loaded, for two thirds of the time.
    for minute in friction.chunks(20_000) {
        let loaded = minute.iter().filter(|torque| **torque > 0.0).count();
        assert!((10_000..20_000).contains(&loaded), "{loaded}");
    }
}

fn table<const M: usize>(shares: [f32; M]) -> &'static [LoadShare] {
    Box::leak(Box::new(shares.map(|share| LoadShare::new(share).unwrap())))
}

#[test]
fn shares_of_the_load_go_to_their_balls() {
    let uneven = UncagedBallScrewConfiguration {
        load_shares: LoadShares::same(table([1.99, 0.01])),
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

/// A pair of tables is the table of each load's sign, to the bit; a load of zero, of either sign, has that of positive loads. In the tick in
/// which the load changes its sign every ball has its other share.
#[test]
fn each_sign_of_the_load_has_its_shares() {
    let (positive, negative) = (table([1.6, 1.0, 0.4]), table([0.3, 0.5, 2.2]));
    let model = |load_shares| {
        Model::new(&UncagedBallScrewConfiguration {
            load_shares,
            ..configuration(0.0)
        })
        .unwrap()
    };
    for (axial_load, alone) in [
        (1000.0, positive),
        (-1000.0, negative),
        (0.0, positive),
        (-0.0, positive),
    ] {
        let mut pair = model(LoadShares { positive, negative });
        let mut alone = model(LoadShares::same(alone));
        for tick in 0..200 {
            let outputs = pair.step(inputs(5.0, axial_load));
            assert_eq!(
                outputs,
                alone.step(inputs(5.0, axial_load)),
                "{axial_load} N, tick {tick}"
            );
        }
    }
    let mut pair = model(LoadShares { positive, negative });
    let mut other = model(LoadShares::same(positive));
    for _ in 0..200 {
        pair.step(inputs(5.0, 1000.0));
        other.step(inputs(5.0, 1000.0));
    }
    let mut alone = model(LoadShares::same(negative));
    alone.import(&exported(&pair)).unwrap();
    let after = pair.step(inputs(5.0, -1000.0));
    assert_eq!(after, alone.step(inputs(5.0, -1000.0)));
    assert_ne!(after, other.step(inputs(5.0, -1000.0)));
}

fn exported<const N: usize, const NODES: usize>(
    model: &FrictionModel<UncagedBallScrew<N, NODES>>,
) -> Vec<u8> {
    let mut block = vec![0; FrictionModel::<UncagedBallScrew<N, NODES>>::STATE_BYTES];
    model.export(&mut block).unwrap();
    block
}

/// A friction coefficient that is set, and constants that are swapped, count in the next tick: it is that of a model that has had them always
/// and whose balls stand at the same places.
#[test]
fn what_is_set_counts_in_the_next_tick() {
    type Range = FrictionModel<UncagedScrew<SCREW_BALLS>>;
    let (least, largest) = BALL_RANGE.law.friction_range();
    let of = |friction: f32| {
        let folded = changed(&BALL_RANGE, |folded| folded.friction = friction);
        Range::new(&gears::UncagedConfiguration {
            folded,
            ..gears::uncaged()
        })
        .unwrap()
    };
    let (first, second) = (1.01 * least, 0.99 * largest);
    for swaps in [false, true] {
        let (mut model, mut other, mut always) = (of(first), of(second), of(first));
        for _ in 0..1500 {
            model.step(inputs(50.0, 3000.0));
        }
        always.import(&exported(&model)).unwrap();
        if swaps {
            model.swap_constants(*other.constants()).unwrap();
        } else {
            model.set_friction(second).unwrap();
        }
        other.import(&exported(&model)).unwrap();
        for tick in 0..200 {
            let found = model.step(inputs(50.0, 3000.0));
            assert_eq!(found, other.step(inputs(50.0, 3000.0)), "{tick}");
            let before = always.step(inputs(50.0, 3000.0));
            let grown = found.groove_torque / before.groove_torque;
            // In proportion but for how the contacts turn.
            let expected = second / first;
            assert!((0.8 * expected..1.2 * expected).contains(&grown), "{grown}");
            assert!(!found.faults.any());
        }
    }
    let mut model = of(first);
    for refused in [0.99 * least, 1.01 * largest, 0.0, f32::NAN, f32::INFINITY] {
        let before = *model.state();
        assert_eq!(model.set_friction(refused).unwrap_err().field(), "friction");
        assert_eq!(*model.state(), before);
    }
    for node in BALL_RANGE.law.frictions() {
        model.set_friction(node).unwrap();
    }
}

/// The flag of what was not folded stands in the tick of such a load alone: of one beyond the last knot, of a ball that carries more than the
/// mean, and where the forces between balls are not held. No speed raises it.
#[test]
fn beyond_the_model_is_flagged_in_its_tick() {
    let last = BALL.law.nodes[0].branches[0].last().unwrap().load;
    let whole = last * SCREW_BALLS as f32;
    let flagged = |configuration: &UncagedBallScrewConfiguration, loads: &[f32]| -> Vec<bool> {
        let mut model = Model::new(configuration).unwrap();
        loads
            .iter()
            .map(|&load| {
                let outputs = model.step(inputs(250.0, load));
                assert!(!outputs.faults.faulty());
                assert!(outputs.friction_torque > 0.0 || load == 0.0);
                outputs.faults.contains(Faults::BEYOND_MODEL)
            })
            .collect()
    };
    let loads = [0.99, 1.01, -0.99, -1.01, 0.5, 0.0].map(|share| share * whole);
    let plain = configuration(1.0);
    let beyond = [false, true, false, true, false, false];
    assert_eq!(flagged(&plain, &loads), beyond);
    let uneven = UncagedBallScrewConfiguration {
        load_shares: LoadShares {
            positive: table([1.25, 0.75]),
            negative: table([0.75, 1.25]),
        },
        ..plain
    };
    let shared: Vec<f32> = loads.iter().map(|load| load / 1.25).collect();
    assert_eq!(flagged(&uneven, &shared), beyond);
    let preloaded = UncagedBallScrewConfiguration {
        folded: changed(plain.folded, |folded| folded.law.lift_off = 0.5 * last),
        ..plain
    };
    let loads = [0.49, 0.51, -0.51, 0.0].map(|share| share * whole);
    assert_eq!(flagged(&preloaded, &loads), [false, true, true, false]);
    // From the fourth knot to the fifth, of loads that assist the motion alone.
    let knots = &plain.folded.law.nodes[0].branches[1];
    let unheld = UncagedBallScrewConfiguration {
        folded: changed(plain.folded, |folded| {
            folded.law.nodes[0].unheld = [0, 1 << 3]
        }),
        ..plain
    };
    let loads = [
        -1.001 * knots[3].load,
        -0.999 * knots[4].load,
        -1.001 * knots[4].load,
        -0.999 * knots[3].load,
        0.5 * (knots[3].load + knots[4].load),
    ]
    .map(|load| load * SCREW_BALLS as f32);
    assert_eq!(flagged(&unheld, &loads), [true, true, false, false, false]);
}

#[test]
fn absurd_inputs_are_flagged_and_leave_no_trace() {
    let sound = inputs(4.0, 900.0);
    let mut model = Model::new(&configuration(1.0)).unwrap();
    let mut untouched = Model::new(&configuration(1.0)).unwrap();
    for _ in 0..300 {
        model.step(sound);
        untouched.step(sound);
    }
    let cases = [
        (f32::NAN, 0.0, Faults::SPEED_NOT_FINITE),
        (f32::INFINITY, 0.0, Faults::SPEED_NOT_FINITE),
        (1.0, f32::NAN, Faults::LOAD_NOT_FINITE),
        (
            f32::NEG_INFINITY,
            f32::NAN,
            Faults::SPEED_NOT_FINITE | Faults::LOAD_NOT_FINITE,
        ),
    ];
    for (tick, (nut_speed, axial_load, faults)) in cases.into_iter().enumerate() {
        let output = model.step(inputs(nut_speed, axial_load));
        assert_eq!(output.faults, faults);
        assert_eq!(
            (output.friction_torque, output.largest_contact_force),
            (0.0, 0.0)
        );
        assert_eq!(model.faulted_ticks(), tick as u32 + 1);
    }
    // The state is as if those ticks had not been.
    assert_eq!(model.step(sound), untouched.step(sound));
    assert_eq!(model.faulted_ticks(), 0);

    for (nut_speed, axial_load, faults) in [
        (1e9, 100.0, Faults::SPEED_RANGE),
        (-3.4e38, 100.0, Faults::SPEED_RANGE),
        (1.0, 3.4e38, Faults::LOAD_RANGE),
        (1.0, -1e7, Faults::LOAD_RANGE),
    ] {
        let output = model.step(inputs(nut_speed, axial_load));
        assert!(
            output.faults.contains(faults),
            "{nut_speed} {axial_load}: {output:?}"
        );
        assert!(output.friction_torque.abs() <= 50.0 && output.largest_contact_force.is_finite());
    }
    // The torque limit holds and says so; parts are put out as they are.
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
    let output = Model::new(&tight).unwrap().step(sound);
    assert_eq!(output.friction_torque, 0.01);
    assert!(output.faults.contains(Faults::FRICTION_LIMIT));
    assert!(output.groove_torque > 0.01);
}

/// A quarter of a turn of a deviation with two waves a turn turns its sign.
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

#[test]
fn every_scene_of_a_screw_has_the_common_outputs() {
    let mut model = Model::new(&configuration(0.0)).unwrap();
    let output = model.step(inputs(5.0, 1500.0));
    let common = Outputs::from(output);
    let power_out = f64::from(output.load_torque);
    let expected = power_out / (power_out + f64::from(output.friction_torque));
    let error = f64::from(common.efficiency) - expected;
    measured::assert("screw without cage, efficiency", error);
    assert_eq!(common.regime, Regime::Driving);
    // The load drives: what friction leaves of its power.
    let output = model.step(inputs(-5.0, 1500.0));
    let common = Outputs::from(output);
    assert_eq!(common.regime, Regime::BackDriving);
    let expected = 1.0 - f64::from(output.friction_torque.abs()) / power_out;
    let error = f64::from(common.efficiency) - expected;
    measured::assert("screw without cage, efficiency", error);
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

#[test]
fn bad_configurations_are_refused_by_name() {
    type Changed<'a> = &'a dyn Fn(&mut UncagedBallScrewConfiguration);
    let good = configuration(0.9);
    let with = |change: Changed<'_>| {
        let mut bad = good;
        change(&mut bad);
        Model::new(&bad).map(|_| ()).unwrap_err().field()
    };
    let folded = |change: &dyn Fn(&mut epas_friction::scene::FoldedBall)| {
        with(&|c| c.folded = changed(c.folded, change))
    };
    for value in [f32::NAN, f32::INFINITY, -1.0, 1e30] {
        assert_eq!(with(&|c| c.ball_friction = value), "ball_friction");
        assert_eq!(with(&|c| c.turns = value), "turns");
        assert_eq!(with(&|c| c.return_length = value), "return_length");
        assert_eq!(with(&|c| c.tick = value), "tick");
        assert_eq!(folded(&|f| f.friction = value), "friction");
        assert_eq!(folded(&|f| f.lead = value), "lead");
        assert_eq!(folded(&|f| f.ball_radius = value), "ball_radius");
        assert_eq!(folded(&|f| f.path_radius = value), "path_radius");
        assert_eq!(folded(&|f| f.speed = value), "speed");
        assert_eq!(folded(&|f| f.reversal_speed = value), "reversal_speed");
        assert_eq!(folded(&|f| f.limits.nut_speed = value), "nut_speed");
        assert_eq!(folded(&|f| f.law.lift_off = value), "lift_off");
    }
    // A speed that no ball has against the nut, a friction coefficient that is not the block's.
    assert_eq!(folded(&|f| f.speed = 1.01 * f.path_radius), "speed");
    assert_eq!(folded(&|f| f.friction *= 1.01), "friction");
    // Friction between balls that would take more than 0.3 of their forces.
    let largest = 0.3 / good.folded.law.largest_grip();
    assert_eq!(with(&|c| c.ball_friction = 1.01 * largest), "ball_friction");
    let most = UncagedBallScrewConfiguration {
        ball_friction: (0.999 * largest).min(1.0),
        ..good
    };
    assert!(Model::new(&most).is_ok());
    // Balls may move by 3 % of the track in a tick.
    assert_eq!(with(&|c| c.tick = 0.05), "tick");
    let none = LoadShares::same(&[]);
    assert_eq!(with(&|c| c.load_shares = none), "load_shares");
    let longer = &[LoadShare::MEAN; 2];
    assert_eq!(with(&|c| c.load_shares.negative = longer), "load_shares");
    // Grooves that deviate by more than was folded.
    let wide = screw_wave(1.01);
    assert_eq!(with(&|c| c.screw_deviation = wide), "screw_deviation");
    let wide = gears::wave(1, 1, 0.0, 1.01 * BALL.law.deviations[1]);
    assert_eq!(with(&|c| c.nut_deviation = wide), "nut_deviation");
    // 37 balls do not go into one turn.
    assert_eq!(with(&|c| c.turns = 1.0), "pitch");
}

/// At a node a range of coefficients is the block of that one, to the bit but for the last node, whose share of the way is 1: roundings of 18
/// numbers.
#[test]
fn at_a_node_a_range_is_the_block_of_one() {
    for (place, node) in BALL_RANGE.law.nodes.iter().enumerate() {
        let whole = gears::uncaged();
        let mut range = FrictionModel::<UncagedScrew<SCREW_BALLS>>::new(&whole).unwrap();
        range.set_friction(node.friction).unwrap();
        let mut folded = BALL;
        folded.law.nodes = [*node];
        folded.law.deviations = BALL_RANGE.law.deviations;
        folded.law.lift_off = BALL_RANGE.law.lift_off;
        folded.friction = node.friction;
        let mut one = Model::new(&UncagedBallScrewConfiguration {
            folded: changed(&folded, |_| ()),
            ball_friction: whole.ball_friction,
            turns: whole.turns,
            return_length: whole.return_length,
            screw_deviation: whole.screw_deviation,
            nut_deviation: whole.nut_deviation,
            load_shares: whole.load_shares,
            tick: whole.tick,
        })
        .unwrap();
        for tick in 0..2000 {
            let load = if tick % 500 < 250 { 4000.0 } else { -7000.0 };
            let (found, expected) = (
                range.step(inputs(100.0, load)),
                one.step(inputs(100.0, load)),
            );
            if place + 1 < gears::BALL_NODES {
                assert_eq!(found, expected, "node {place}, tick {tick}");
            } else {
                let error = found.friction_torque / expected.friction_torque - 1.0;
                measured::assert("range at its last node", error);
            }
        }
    }
}
