//! Scenes whose balls press on each other: laws, limits, reversal, bad input. Against the exact whole screw they stand in the
//! tests of the bench program.

use crate::kit::designs::{SCREW_TRACK, screw as design};
use crate::kit::gears::{self, SCREW_BALLS};
use crate::kit::measured;
use std::f64::consts::{FRAC_PI_4, TAU};

use epas_friction::{
    BallScrew, CATALOGUE, Clearance, Faults, FrictionModel, Inputs, Limits, LoadShare, LoadShares,
    Outputs, Regime, RollingResistance, UncagedBallScrew, UncagedBallScrewConfiguration,
    UncagedOutputs,
};
use epas_reference::friction::ball_screw_closed::{ContactAngles, Support, speed_ratio};

const TICK: f32 = 1e-3;

/// Two waves a turn of so many degrees on the screw.
fn configuration(degrees: f64) -> UncagedBallScrewConfiguration {
    gears::full(gears::wave(1, 2, 0.0, degrees.to_radians() as f32), TICK)
}

type Model = FrictionModel<UncagedBallScrew<37>>;

/// Outputs at the end of every `every`-th tick, the start included as the reference counts it.
fn run(
    degrees: f64,
    axial_load: f64,
    nut_speed: f64,
    ticks: usize,
    every: usize,
) -> Vec<UncagedOutputs> {
    let mut model = Model::new(&configuration(degrees)).unwrap();
    (0..=ticks)
        .map(|_| {
            model.step(Inputs {
                nut_speed: nut_speed as f32,
                axial_load: axial_load as f32,
            })
        })
        .step_by(every)
        .collect()
}

#[test]
fn four_groups_build_up_release_and_build_up_again() {
    // Lin 2019, Figures 3.24 and 3.25; a state every degree.
    let mut model = Model::new(&configuration(2.3)).unwrap();
    let mut torques = Vec::new();
    let mut groups_at_peak = 0;
    for tick in 0..2000 {
        let output = model.step(Inputs {
            nut_speed: TAU as f32,
            axial_load: -1500.0,
        });
        torques.push(output.ball_torque / output.groove_torque);
        let contacts = model.state().circuit.train.contacts();
        assert_eq!(contacts.len(), usize::from(output.contacts));
        if tick == 288 {
            // 103.7 degrees: runs of contacts between neighbours, the last ball's neighbour being ball 0.
            let mut pressed = [false; 37];
            for contact in &contacts {
                pressed[usize::from(contact.ball)] = true;
            }
            groups_at_peak = (0..37)
                .filter(|&j| pressed[j] && !pressed[(j + 36) % 37])
                .count();
        }
    }
    assert_eq!(groups_at_peak, 4);
    let peak = |range: std::ops::Range<usize>| {
        range.fold((0, 0.0), |best: (usize, f32), i| {
            if torques[i] > best.1 {
                (i, torques[i])
            } else {
                best
            }
        })
    };
    let (at, first) = peak(0..700);
    let (again_at, again) = peak(800..1400);
    let degrees = |tick: usize| tick as f64 * 0.36;
    let released = (at..1400).find(|&i| torques[i] == 0.0).unwrap();
    println!(
        "peak {:.1} % at {:.1} deg, released at {:.1} deg, again {:.1} % at {:.1} deg",
        100.0 * first,
        degrees(at),
        degrees(released),
        100.0 * again,
        degrees(again_at)
    );
    // The exact whole screw: 38.8 % at 103.4 degrees, released at 262.5 degrees; the text's 49.6 % takes a deviation of 2.5
    // degrees there. With ticks of 0.36 degrees balls are renewed every seven degrees, and all of it comes that much later.
    // Measured: 1.5 %, 8.2 and 9.3 degrees off.
    assert!((first - 0.388).abs() < 0.02);
    assert!((degrees(at) - 103.4).abs() < 12.0);
    assert!((degrees(released) - 262.5).abs() < 12.0);
    // A second build-up follows, lower than the first. Measured: 0.094.
    assert!(again > 0.03 && again < 0.6 * first);
}

#[test]
fn without_deviation_no_ball_presses() {
    for output in run(0.0, 1500.0, TAU, 3000, 1) {
        assert_eq!((output.contacts, output.ball_torque), (0, 0.0));
        assert!(output.groove_torque > 0.0);
        assert_eq!(output.friction_torque, output.groove_torque);
    }
}

#[test]
fn balls_without_friction_between_them_still_press() {
    let smooth = UncagedBallScrewConfiguration {
        ball_friction: 0.0,
        rolling_resistance: RollingResistance::NONE,
        ..configuration(2.5)
    };
    let mut rough = Model::new(&configuration(2.5)).unwrap();
    let mut smooth = Model::new(&smooth).unwrap();
    let mut pressed = 0;
    let mut largest = (0.0_f32, 0.0_f32);
    for _ in 0..1500 {
        let inputs = Inputs {
            nut_speed: 3.0,
            axial_load: 800.0,
        };
        let (with, without) = (rough.step(inputs), smooth.step(inputs));
        assert_eq!(without.ball_torque, 0.0);
        // Balls that do not rub turn faster: forces between them are larger, friction of the grooves hardly differs. Measured:
        // 1.6e-2.
        assert!((with.groove_torque / without.groove_torque - 1.0).abs() < 0.03);
        largest.0 = largest.0.max(with.largest_contact_force);
        largest.1 = largest.1.max(without.largest_contact_force);
        pressed += u32::from(with.contacts);
    }
    assert!(pressed > 1000 && largest.0 < largest.1);
}

#[test]
fn reversal_turns_friction_and_releases_the_balls() {
    let mut model = Model::new(&configuration(2.5)).unwrap();
    let step = |model: &mut Model, nut_speed: f32| {
        model.step(Inputs {
            nut_speed,
            axial_load: -1500.0,
        })
    };
    for _ in 0..290 {
        step(&mut model, TAU as f32);
    }
    let before = step(&mut model, TAU as f32);
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
    assert!(
        model
            .state()
            .circuit
            .train
            .positions()
            .eq(positions.iter().copied())
    );
    // Backwards, the balls that had run up part again.
    let back = step(&mut model, -TAU as f32);
    assert!(back.friction_torque < 0.0);
    let mut contacts = Vec::new();
    for _ in 0..290 {
        let output = step(&mut model, -TAU as f32);
        assert!(output.groove_torque < 0.0 && output.ball_torque <= 0.0);
        contacts.push(output.contacts);
    }
    assert!(contacts.iter().any(|&c| c < before.contacts / 2));
    // Through the reversal speed friction is smooth: 71 % at it, and odd.
    let mut slow = Model::new(&configuration(0.0)).unwrap();
    let mut blended = |nut_speed: f32| {
        slow.step(Inputs {
            nut_speed,
            axial_load: -1500.0,
        })
        .friction_torque
    };
    let full = blended(10.0);
    // Shares of the full friction at the reversal speed and at a tenth of it; balls are renewed meanwhile.
    for (speed, share) in [
        (1e-3, std::f32::consts::FRAC_1_SQRT_2),
        (1e-4, 101_f32.sqrt().recip()),
    ] {
        let error = blended(speed) / full - share;
        measured::assert("screw without cage, share at a low speed", error);
    }
}

#[test]
fn a_return_without_load_takes_its_share_of_the_balls() {
    // Half as long again as the loaded part: every loaded ball carries 1.5 times as much, and the groove
    // torque rises by the fourth third's power of it on two thirds of the balls.
    let loaded = 2.0 * f64::from(design().pitch_radius() / design().cos_lead_angle()) * TAU;
    let with_return = UncagedBallScrewConfiguration {
        return_length: (0.5 * loaded) as f32,
        ..configuration(0.0)
    };
    let mut model = Model::new(&with_return).unwrap();
    let mut plain = Model::new(&configuration(0.0)).unwrap();
    let inputs = Inputs {
        nut_speed: 5.0,
        axial_load: 2000.0,
    };
    let (mut sum, mut whole) = (0.0, 0.0);
    let mut largest_force: f32 = 0.0;
    for _ in 0..20_000 {
        let output = model.step(inputs);
        sum += f64::from(output.groove_torque) / 20_000.0;
        whole += f64::from(plain.step(inputs).groove_torque) / 20_000.0;
        largest_force = largest_force.max(output.largest_contact_force);
    }
    // Groove torque goes with the load: spin losses with N^(4/3), slip losses with N. The share of the
    // first is between 0 and 1.
    let ratio = sum / whole;
    println!("groove torque with return over without: {ratio:.5}, largest force {largest_force} N");
    assert!(ratio > 1.0 && ratio < 1.5_f64.powf(1.0 / 3.0));
    // Balls in the return have no speed of their own: none presses with more than its impedance. Derived: that is 1e-6 N for a
    // speed as large as that of all. Measured: 0.
    assert!(largest_force < 1e-6);
}

#[test]
fn beyond_the_model_is_flagged_until_every_ball_has_passed_the_return() {
    const SLOW: f32 = 5.0;
    // A round of 38 renewals, one in a tick, turns the nut by 0.019 rad when slow; from 0.12 rad on it is too far.
    const FAST: f32 = 60.0;
    let tick = 1e-4;
    let design = design();
    let path = f64::from(design.pitch_radius() / design.cos_lead_angle());
    let loaded = 2.0 * path * TAU;
    let mut model = Model::new(&UncagedBallScrewConfiguration {
        return_length: (0.5 * loaded) as f32,
        tick,
        ..configuration(1.0)
    })
    .unwrap();
    let mut run = |nut_speed: f32, ticks: usize| -> Vec<bool> {
        (0..ticks)
            .map(|_| {
                let outputs = model.step(Inputs {
                    nut_speed,
                    axial_load: 2000.0,
                });
                outputs.faults.contains(Faults::BEYOND_MODEL)
            })
            .collect()
    };
    assert!(run(SLOW, 2000).iter().all(|flagged| !flagged));
    // A short excess is over with its round.
    assert!(run(FAST, 76).ends_with(&[true; 38]));
    assert!(run(SLOW, 76).ends_with(&[false]));
    assert!(run(FAST, 5 * 38).ends_with(&[true; 38]));

    // The nut's turn in which a nominal ball goes once round the whole track.
    let rolling = f64::from(design.ball_radius() * design.cos_lead_angle());
    let against = 0.5 * (path - rolling * FRAC_PI_4.cos());
    let circuit = 1.5 * loaded / against;
    let ticks = (circuit / f64::from(SLOW * tick)) as usize;
    let flags = run(SLOW, 2 * ticks);
    let fell = flags.iter().position(|flagged| !flagged).unwrap();
    assert!(flags[fell..].iter().all(|flagged| !flagged));
    // All balls but those that come under load in the round that is still counted as fast; a deviation of a degree makes balls
    // 2 % faster or slower.
    let share = fell as f64 / ticks as f64;
    println!("flagged for {share:.4} of a way round the track");
    assert!((0.93..1.02).contains(&share), "{share}");

    // On the way back the count begins anew.
    run(FAST, 5 * 38);
    run(SLOW, ticks / 2);
    assert!(run(-SLOW, ticks * 3 / 4).iter().all(|flagged| *flagged));
}

#[test]
fn shares_of_the_load_go_to_their_balls() {
    let half = [LoadShare::new(1.99).unwrap(), LoadShare::new(0.01).unwrap()];
    let uneven = UncagedBallScrewConfiguration {
        load_shares: LoadShares::same(Box::leak(Box::new(half))),
        ..configuration(0.0)
    };
    let mut uneven = Model::new(&uneven).unwrap();
    let mut even = Model::new(&configuration(0.0)).unwrap();
    let step = |model: &mut Model, axial_load: f32| {
        let inputs = Inputs {
            nut_speed: 5.0,
            axial_load,
        };
        for _ in 0..100 {
            model.step(inputs);
        }
        model.step(inputs).groove_torque
    };
    // 37 balls, an odd number: 18 or 19 in the first half (1/37 of the torque), which carries 99.5 % of
    // the load. Twice the load on half of the balls is what
    // twice the axial load makes on all, halved.
    let expected = 0.5 * step(&mut even, 2000.0);
    let found = step(&mut uneven, 1000.0);
    assert!(
        (found / expected - 1.0).abs() < 1.5 / 37.0,
        "{found} {expected}"
    );
    // Friction rises a little faster than the load: by 2^(1/6) for twice of it, less a ball's part.
    let plain = step(&mut even, 1000.0);
    assert!(found > plain * (1.0 - 1.0 / 37.0), "{found} {plain}");
}

/// A pair of tables is the table of each load's sign, to the bit; a load of zero, of either sign, has that of positive
/// loads. After the load has changed its sign, each ball has the other share as soon as it was renewed.
#[test]
fn each_sign_of_the_load_has_its_shares() {
    let table = |shares: [f32; 3]| -> &'static [LoadShare] {
        Box::leak(Box::new(shares.map(|share| LoadShare::new(share).unwrap())))
    };
    let (positive, negative) = (table([1.6, 1.0, 0.4]), table([0.3, 0.5, 2.2]));
    let model = |load_shares| {
        Model::new(&UncagedBallScrewConfiguration {
            load_shares,
            ..configuration(0.0)
        })
        .unwrap()
    };
    let step = |model: &mut Model, axial_load: f32| {
        let inputs = Inputs {
            nut_speed: 5.0,
            axial_load,
        };
        model.step(inputs).groove_torque
    };
    let mut torques = Vec::new();
    for (axial_load, alone) in [
        (1000.0, positive),
        (-1000.0, negative),
        (0.0, positive),
        (-0.0, positive),
    ] {
        let mut pair = model(LoadShares { positive, negative });
        let mut alone = model(LoadShares::same(alone));
        let mut torque = 0.0;
        for tick in 0..200 {
            torque = step(&mut pair, axial_load);
            let expected = step(&mut alone, axial_load);
            assert_eq!(
                torque.to_bits(),
                expected.to_bits(),
                "{axial_load} N, tick {tick}"
            );
        }
        torques.push(torque);
    }
    // Friction of spin goes as share^(4/3), whose sums are 3.17 and 3.46; that of slip across the track as the share.
    let mut other = model(LoadShares::same(positive));
    let other = (0..200).map(|_| step(&mut other, -1000.0)).last().unwrap();
    assert!(torques[1] / other > 1.02, "{torques:?} {other}");
    let mut pair = model(LoadShares { positive, negative });
    for _ in 0..200 {
        step(&mut pair, 1000.0);
    }
    let mut after = 0.0;
    for _ in 0..200 {
        after = step(&mut pair, -1000.0);
    }
    // A ball that moves on from the least share to the largest changes the sum by (2.2^(4/3) - 0.3^(4/3))/37 of its mean
    // of 1.15: 6.3 %.
    assert!(
        (after / torques[1] - 1.0).abs() < 0.065,
        "{after} {torques:?}"
    );
}

#[test]
fn power_goes_into_grooves_and_rubbing_alone() {
    // Normal forces between balls do no work: pairs that press move alike. So the motor's power is what
    // the grooves and the rubbing pairs dissipate, and the latter is friction times force times slip.
    let mut model = Model::new(&configuration(2.5)).unwrap();
    let nut_speed = 2.0 * TAU;
    // Third contact on the screw: both balls of a pair spin with w_B Lp/(R_B cos b) about z, and turn about
    // the screw's axis with w_B, which their common normal follows: (3.73) without that part. Balls whose third contact
    // slides spin slower.
    let track = SCREW_TRACK;
    let nominal = ContactAngles {
        screw: FRAC_PI_4,
        nut: FRAC_PI_4,
        third: FRAC_PI_4,
    };
    let ratio = speed_ratio(&track, Support::ThirdOnScrew, nominal);
    let (_, cos_lead) = track.lead_angle();
    let slip = |deviation: f64| {
        let orbital = nut_speed * (ratio + deviation * (1.0 - ratio));
        let spin = orbital * track.path_radius() / (track.ball_radius * FRAC_PI_4.cos());
        2.0 * track.ball_radius * (spin - orbital * cos_lead)
    };
    let (mut work, mut friction) = (0.0, 0.0);
    let mut worst_rubbing: f64 = 0.0;
    for _ in 0..1500 {
        let output = model.step(Inputs {
            nut_speed: nut_speed as f32,
            axial_load: -1500.0,
        });
        let train = &model.state().circuit.train;
        let forces: Vec<f64> = train.forces().map(f64::from).collect();
        // Deviations of the speeds of the balls along the nut, over its nominal size; the balls run
        // backwards along the nut.
        let speeds: Vec<f64> = train.speeds().map(f64::from).collect();
        let pairs = (0..37).map(|j| (forces[j], speeds[j], speeds[(j + 1) % 37]));
        let forces_work: f64 = pairs
            .clone()
            .map(|(force, rear, front)| force * (rear - front))
            .sum();
        work += forces_work * (1.0 - ratio) * track.path_radius();
        friction += f64::from(output.friction_torque);
        if output.contacts == 0 {
            assert_eq!(output.ball_torque, 0.0);
            continue;
        }
        let rubbing: f64 = pairs
            .map(|(force, deviation, _)| 0.1 * force * slip(deviation))
            .sum();
        let found = f64::from(output.ball_torque) * nut_speed;
        worst_rubbing = worst_rubbing.max((found / rubbing - 1.0).abs());
    }
    // Only a pair that closes its gap within the tick has moved apart from the other: a fraction of a tick.
    measured::assert(
        "whole screw, work of normal forces over friction",
        work / friction,
    );
    measured::assert("whole screw, rubbing of the pairs", worst_rubbing);
}

#[test]
fn absurd_inputs_are_flagged_and_leave_no_trace() {
    let sound = Inputs {
        nut_speed: 4.0,
        axial_load: 900.0,
    };
    let mut model = Model::new(&configuration(2.5)).unwrap();
    let mut untouched = Model::new(&configuration(2.5)).unwrap();
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
        let output = model.step(Inputs {
            nut_speed,
            axial_load,
        });
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
        let output = model.step(Inputs {
            nut_speed,
            axial_load,
        });
        assert!(
            output.faults.contains(faults),
            "{nut_speed} {axial_load}: {output:?}"
        );
        assert!(output.friction_torque.abs() <= 10.0 && output.largest_contact_force.is_finite());
    }
    // The torque limit holds and says so; parts are put out as they are.
    let tight = UncagedBallScrewConfiguration {
        limits: Limits {
            friction_torque: 0.01,
            ..configuration(0.0).limits
        },
        ..configuration(2.5)
    };
    let output = Model::new(&tight).unwrap().step(sound);
    assert_eq!(output.friction_torque, 0.01);
    assert!(output.faults.contains(Faults::FRICTION_LIMIT));
}

#[test]
fn bad_configurations_are_refused_by_name() {
    let good = configuration(2.0);
    let with = |change: &dyn Fn(&mut UncagedBallScrewConfiguration)| {
        let mut bad = good;
        change(&mut bad);
        Model::new(&bad).map(|_| ()).unwrap_err().field()
    };
    for value in [f32::NAN, f32::INFINITY, -1.0, 1e30] {
        assert_eq!(with(&|c| c.friction = value), "friction");
        assert_eq!(with(&|c| c.ball_friction = value), "ball_friction");
        assert_eq!(with(&|c| c.turns = value), "turns");
        assert_eq!(with(&|c| c.return_length = value), "return_length");
        assert_eq!(with(&|c| c.reversal_speed = value), "reversal_speed");
        assert_eq!(with(&|c| c.tick = value), "tick");
        assert_eq!(with(&|c| c.limits.nut_speed = value), "nut_speed");
    }
    // Balls may move by 3 % of the track in a tick.
    assert_eq!(with(&|c| c.tick = 0.05), "tick");
    assert_eq!(
        with(&|c| c.load_shares = LoadShares::same(&[])),
        "load_shares"
    );
    assert_eq!(
        with(&|c| c.load_shares.negative = &[LoadShare::MEAN; 2]),
        "load_shares"
    );
    // 37 balls do not go into one turn.
    assert_eq!(with(&|c| c.turns = 1.0), "pitch");
}

#[test]
fn the_nut_angle_moves_the_screw_under_the_balls() {
    // A quarter of a turn of a deviation with two cycles a turn turns its sign.
    let mut there = Model::new(&configuration(2.0)).unwrap();
    let mut opposite = Model::new(&configuration(-2.0)).unwrap();
    there.set_nut_angle(std::f32::consts::FRAC_PI_2);
    let inputs = Inputs {
        nut_speed: 6.0,
        axial_load: -1500.0,
    };
    for _ in 0..500 {
        let (a, b) = (there.step(inputs), opposite.step(inputs));
        assert_eq!(a.contacts, b.contacts);
        let difference = a.ball_torque - b.ball_torque;
        measured::assert("quarter of a turn, ball torque in N m", difference);
    }
    there.set_nut_angle(f32::NAN);
    assert!(there.step(inputs).friction_torque.is_finite());
}

#[test]
fn every_scene_of_a_screw_has_the_common_outputs() {
    let mut model = Model::new(&configuration(0.0)).unwrap();
    let output = model.step(Inputs {
        nut_speed: 5.0,
        axial_load: 1500.0,
    });
    let common = Outputs::from(output);
    let power_out = f64::from(output.load_torque);
    let expected = power_out / (power_out + f64::from(output.friction_torque));
    let error = f64::from(common.efficiency) - expected;
    measured::assert("screw without cage, efficiency", error);
    assert_eq!(common.regime, Regime::Driving);
    // The load drives: what friction leaves of its power.
    let output = model.step(Inputs {
        nut_speed: -5.0,
        axial_load: 1500.0,
    });
    let common = Outputs::from(output);
    assert_eq!(common.regime, Regime::BackDriving);
    let expected = 1.0 - f64::from(output.friction_torque.abs()) / power_out;
    let error = f64::from(common.efficiency) - expected;
    measured::assert("screw without cage, efficiency", error);
}

/// Balls that have settled at one speed under one load, and how many of the next ticks say that they settle again.
fn unsettled_by(change: impl FnOnce(&mut Model)) -> usize {
    let configuration = UncagedBallScrewConfiguration {
        clearance: Clearance::new(-2e-6).unwrap(),
        ..gears::even()
    };
    let mut model = Model::new(&configuration).unwrap();
    let inputs = Inputs {
        nut_speed: 5.0,
        axial_load: 3000.0,
    };
    let settles = |model: &mut Model| {
        let outputs = model.step(inputs);
        outputs.faults.contains(Faults::SETTLING)
    };
    for _ in 0..2000 {
        settles(&mut model);
    }
    assert!(!settles(&mut model));
    change(&mut model);
    (0..1000).filter(|_| settles(&mut model)).count()
}

/// Small changes of friction coefficient and clearance are followed, larger ones settle for three rounds of renewals.
#[test]
fn small_changes_are_followed_and_large_ones_settle() {
    let clearance = |gap: f32| Clearance::new(gap).unwrap();
    assert_eq!(unsettled_by(|model| model.set_friction(0.0755).unwrap()), 0);
    assert_eq!(
        unsettled_by(|model| model.set_clearance(clearance(-2.005e-6)).unwrap()),
        0
    );
    // A ball a tick, and the nominal one after all others: it counts as well.
    let rounds = 3 * SCREW_BALLS;
    let close = |ticks: usize| ticks.abs_diff(rounds) <= 6;
    let friction = unsettled_by(|model| model.set_friction(0.077).unwrap());
    assert!(close(friction), "{friction}");
    let gap = unsettled_by(|model| model.set_clearance(clearance(-2.05e-6)).unwrap());
    assert!(close(gap), "{gap}");
}

/// Constants that are swapped: balls settle, and then rub as those of a model that has had them from the first tick.
#[test]
fn balls_settle_under_swapped_constants() {
    let with = |friction| {
        Model::new(&UncagedBallScrewConfiguration {
            friction,
            ..gears::even()
        })
        .unwrap()
    };
    let same = unsettled_by(|model| {
        let own = *model.constants();
        model.swap_constants(own).unwrap();
    });
    assert!(same.abs_diff(3 * SCREW_BALLS) <= 6, "{same}");
    let (mut swapped, mut fresh) = (with(0.075), with(0.12));
    let inputs = Inputs {
        nut_speed: 5.0,
        axial_load: 3000.0,
    };
    for _ in 0..1000 {
        swapped.step(inputs);
        fresh.step(inputs);
    }
    swapped.swap_constants(*fresh.constants()).unwrap();
    let mut torques = [0.0_f32; 2];
    for _ in 0..1500 {
        torques = [&mut swapped, &mut fresh].map(|model| model.step(inputs).groove_torque);
    }
    let [swapped, fresh] = torques;
    // Settled balls stay where Newton's method leaves them, within 1e-4 of their friction. Measured: 0.
    assert!((swapped / fresh - 1.0).abs() < 1e-4, "{swapped} {fresh}");
}

/// Friction that creeps by less than a jump in each tick, and by more in a round, is flagged all the same.
#[test]
fn a_creep_of_many_small_changes_settles() {
    let mut model = Model::new(&gears::even()).unwrap();
    let inputs = Inputs {
        nut_speed: 5.0,
        axial_load: 3000.0,
    };
    for _ in 0..2000 {
        model.step(inputs);
    }
    let mut creep = |per_tick: f32| {
        let mut friction = 0.075;
        (0..60)
            .filter(|_| {
                friction *= per_tick;
                model.set_friction(friction).unwrap();
                model.step(inputs).faults.contains(Faults::SETTLING)
            })
            .count()
    };
    // A round of 38 ticks changes 0.4 %.
    assert_eq!(creep(1.0001), 0);
    assert!(creep(1.009) >= 58);
}

/// A track so long behind its loaded part that at times no ball is loaded: those that come under load carry it all the same.
#[test]
fn a_zone_that_was_empty_is_loaded_again() {
    let configuration = UncagedBallScrewConfiguration {
        turns: 1.0,
        return_length: 0.5,
        ..gears::even()
    };
    let mut model = FrictionModel::<UncagedBallScrew<4>>::new(&configuration).unwrap();
    let mut friction = Vec::new();
    for _ in 0..60_000 {
        let outputs = model.step(Inputs {
            nut_speed: 20.0,
            axial_load: 3000.0,
        });
        friction.push(outputs.groove_torque);
    }
    // One ball of four is loaded, for two thirds of the time.
    for minute in friction.chunks(20_000) {
        let loaded = minute.iter().filter(|torque| **torque > 0.0).count();
        assert!((10_000..20_000).contains(&loaded), "{loaded}");
    }
}

/// What a screw does follows from its full friction, however little of it passes near the reversal.
#[test]
fn the_regime_is_that_of_full_friction() {
    let mut parameters = CATALOGUE[0].parameters();
    parameters.lead = 0.07e-3;
    let design = BallScrew::new(parameters).unwrap();
    let uncaged = UncagedBallScrewConfiguration {
        design,
        ..gears::even()
    };
    let mut uncaged = Model::new(&uncaged).unwrap();
    let mut small = 0;
    for speed in [-0.5_f32, -0.6, -1.0, -5.0, -300.0] {
        let inputs = Inputs {
            nut_speed: speed,
            axial_load: 1000.0,
        };
        let found = (0..2000).map(|_| uncaged.step(inputs)).last().unwrap();
        small += i32::from(found.friction_torque.abs() < found.load_torque);
        assert_eq!(found.regime, Regime::Locked, "{speed}");
    }
    assert!((1..5).contains(&small), "{small}");
}

/// A screw of seven balls, spread so widely and so evenly that none presses.
fn spread(friction: f32, clearance: f32) -> FrictionModel<UncagedBallScrew<7>> {
    let design = CATALOGUE[15].design().unwrap();
    let path = design.pitch_radius() / design.cos_lead_angle();
    let touching = 14.0 * (design.ball_radius() / path).asin() / std::f32::consts::TAU;
    FrictionModel::new(&UncagedBallScrewConfiguration {
        friction,
        clearance: Clearance::new(clearance).unwrap(),
        turns: 3.0 * touching,
        return_length: 0.0,
        reversal_speed: 1e-6,
        tick: 1e-3,
        limits: Limits {
            nut_speed: 50.0,
            ..gears::LIMITS
        },
        ..gears::even()
    })
    .unwrap()
}

/// Friction and clearance that are set end where a screw ends that is set up with them.
#[test]
fn friction_and_clearance_change_while_running() {
    let inputs = Inputs {
        nut_speed: 10.0,
        axial_load: 210.0,
    };
    let (mut free, mut other) = (spread(0.1, 0.0), spread(0.12, 1e-6));
    for _ in 0..200 {
        free.step(inputs);
        other.step(inputs);
    }
    assert!(!free.step(inputs).faults.any());
    free.set_friction(0.12).unwrap();
    free.set_clearance(Clearance::new(1e-6).unwrap()).unwrap();
    assert!(free.step(inputs).faults.contains(Faults::SETTLING));
    for _ in 0..200 {
        free.step(inputs);
    }
    let (found, expected) = (free.step(inputs), other.step(inputs));
    assert!(!found.faults.any());
    let error = f64::from(found.groove_torque) / f64::from(expected.groove_torque) - 1.0;
    measured::assert("friction set in a screw without cage", error);
    assert_eq!(free.set_friction(0.6).unwrap_err().field(), "friction");
    let wide = Clearance::new(2e-3).unwrap();
    assert_eq!(free.set_clearance(wide).unwrap_err().field(), "clearance");
}
