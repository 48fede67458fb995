//! Screws without cage: loads of their own by the sign of the load, what is set, what is beyond the folded law, and what is refused.

use crate::refusals::assert_refused;
use epas_friction::{
    Faults, FrictionModel, LoadShare, LoadShares, UncagedBallScrew, UncagedBallScrewConfiguration,
};

use super::running::{Model, configuration, inputs, table};
use epas_testkit::gears::{self, BALL, BALL_RANGE, SCREW_BALLS, UncagedScrew, changed, screw_wave};
use epas_testkit::measured;

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
    let flagged_as =
        |flag, configuration: &UncagedBallScrewConfiguration, loads: &[f32]| -> Vec<bool> {
            let mut model = Model::new(configuration).unwrap();
            loads
                .iter()
                .map(|&load| {
                    let outputs = model.step(inputs(250.0, load));
                    assert!(!outputs.faults.faulty());
                    assert!(outputs.friction_torque > 0.0 || load == 0.0);
                    outputs.faults.contains(flag)
                })
                .collect()
        };
    let flagged =
        |configuration: &_, loads: &[f32]| flagged_as(Faults::BEYOND_MODEL, configuration, loads);
    let loads = [0.99, 1.01, -0.99, -1.01, 0.5, 0.0].map(|share| share * whole);
    let plain = configuration(1.0);
    let beyond = [false, true, false, true, false, false];
    assert_eq!(flagged(&plain, &loads), beyond);
    let uneven = UncagedBallScrewConfiguration {
        load_shares: LoadShares {
            positive: table([1.25, 1.25, 0.75, 0.75]),
            negative: table([0.75, 0.75, 1.25, 1.25]),
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
            folded.law.nodes[0].unheld = [0, 1 << 3];
        }),
        ..plain
    };
    let (fourth, fifth) = (knots[3].load, knots[4].load);
    let ends = [1.001 * fourth, 0.999 * fifth, 1.001 * fifth, 0.999 * fourth];
    let law = &unheld.folded.law;
    let held =
        |branch| ends.map(|load| law.holds_forces(load, branch, law.interval(BALL.friction)));
    assert_eq!([held(0), held(1)], [[true; 4], [false, false, true, true]]);
    let [first, last, above, below] = ends;
    let loads = [-first, -last, -above, -below, 0.5 * (fourth + fifth)]
        .map(|load| load * SCREW_BALLS as f32);
    assert_eq!(flagged(&unheld, &loads), [false; 5]);
    // Not in the first tick, whose balls stand apart.
    let loads: Vec<f32> = loads.into_iter().flat_map(|load| [load; 400]).collect();
    let found = flagged_as(Faults::FORCES_NOT_HELD, &unheld, &loads);
    let of = |load: usize| found[400 * load + 399];
    assert_eq!(
        [of(0), of(1), of(2), of(3), of(4)],
        [true, true, false, false, false]
    );
    assert!(!found[0]);
}

#[test]
fn bad_configurations_are_refused_by_name() {
    const BAD: &[f32] = &[-1.0, 1e30];
    let good = configuration(0.9);
    #[rustfmt::skip]
    assert_refused(
        &good,
        Model::new,
        &[
            ("ball_friction", |c, v| c.ball_friction = v, BAD),
            ("turns", |c, v| c.turns = v, BAD),
            ("return_length", |c, v| c.return_length = v, BAD),
            // Balls may move by 3 % of the track in a tick.
            ("tick", |c, v| c.tick = v, &[-1.0, 1e30, 0.05, 0.0, -0.0, 1e-45, 1e9]),
            ("load_shares", |c, _| c.load_shares = LoadShares::same(&[]), &[]),
            ("load_shares", |c, _| c.load_shares.negative = &[LoadShare::MEAN; 2], &[]),
            ("screw_deviation", |c, _| c.screw_deviation = screw_wave(1.01), &[]),
            (
                "nut_deviation",
                |c, _| c.nut_deviation = gears::wave(1, 1, 0.0, 1.01 * BALL.law.deviations[1]),
                &[],
            ),
            ("pitch", |c, _| c.turns = 1.0, &[]),
        ],
    );
    assert_refused(
        good.folded,
        |folded| {
            Model::new(&UncagedBallScrewConfiguration {
                folded: changed(folded, |_| ()),
                ..good
            })
        },
        &[
            ("friction", |f, v| f.friction = v, BAD),
            // A friction coefficient that is not the block's.
            ("friction", |f, _| f.friction *= 1.01, &[]),
            ("lead", |f, v| f.lead = v, BAD),
            ("ball_radius", |f, v| f.ball_radius = v, BAD),
            ("path_radius", |f, v| f.path_radius = v, BAD),
            ("speed", |f, v| f.speed = v, BAD),
            // A speed that no ball has against the nut.
            ("speed", |f, _| f.speed = 1.01 * f.path_radius, &[]),
            ("reversal_speed", |f, v| f.reversal_speed = v, BAD),
            ("nut_speed", |f, v| f.limits.nut_speed = v, BAD),
            ("lift_off", |f, v| f.law.lift_off = v, BAD),
        ],
    );
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
            balls: whole.balls,
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
