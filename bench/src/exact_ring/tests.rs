use rand::RngExt as _;
use rand_pcg::Pcg64;
use rayon::prelude::*;

use super::*;

#[test]
fn a_law_is_shared() {
    let law = Case::LIN.law().unwrap();
    let other = Case {
        load_per_ball: -200.0,
        speed: 20.0,
        loaded: 1.0,
        ..Case::LIN
    };
    assert!(std::ptr::eq(law, other.law().unwrap()));
    let wrong = Case {
        clearance: 1.0,
        ..Case::LIN
    };
    let refused = compare::<4>(&wrong).unwrap_err();
    assert!(refused.contains("clearance"), "{refused}");
}

#[test]
fn the_scene_is_near_the_exact_screw() {
    let found = compare::<4>(&Case {
        turns: 0.05,
        states: 10,
        ..Case::LIN
    })
    .unwrap();
    assert_eq!((found.compared, found.failed), (11, 0));
    assert_eq!(found.course.len(), 11);
    let [largest, rms, _] = found.torque.relative();
    assert!(rms <= largest && largest < 0.02, "{largest} {rms}");
}

/// Waves of orders 1 to 8 at random over four turns.
fn random(largest: f64, seed: u128) -> Deviation {
    let mut random = Pcg64::new(seed, 13);
    let mut deviation = Deviation {
        largest,
        turns: 4,
        orders: std::array::from_fn(|_| std::array::from_fn(|_| random.random_range(-1.0..=1.0))),
    };
    let most = deviation
        .samples()
        .map(f64::abs)
        .into_iter()
        .fold(0.0, f64::max);
    for amplitude in deviation.orders.as_flattened_mut() {
        *amplitude *= largest / most;
    }
    deviation
}

/// Errors of all states, of those without a flag, and of those of them beside which no pair begins or ends to press.
fn followed(balls: usize, case: &Case) -> [Errors; 3] {
    let found = match balls {
        28 => compare::<28>(case),
        _ => compare::<37>(case),
    };
    let course = found.unwrap().course;
    let apart = course.windows(3).filter(|around| {
        let mut pairs = around.iter().map(|moment| moment.pressing);
        pairs.all(|pairs| pairs == around[1].pressing)
    });
    let held = |moment: &&Moment| !moment.flagged;
    let error = |moment: &Moment| Some(moment.error).filter(|error| error.is_finite());
    [
        course.iter().filter_map(error).collect(),
        course.iter().filter(held).filter_map(error).collect(),
        apart
            .map(|around| &around[1])
            .filter(held)
            .filter_map(error)
            .collect(),
    ]
}

/// Waves on the screw and half as high in the nut, so many in some turns.
fn waves(order: usize, turns: u16) -> [Deviation; 2] {
    [TAU / 360.0, 0.5 * TAU / 360.0].map(|largest| Deviation {
        turns,
        ..Deviation::wave(largest, order)
    })
}

/// A turn of a screw filled but for a tenth of a ball.
fn turn(load_per_ball: f64, [screw, nut]: [Deviation; 2], states: usize) -> Case {
    Case {
        load_per_ball,
        screw,
        nut,
        turns: 1.0,
        states,
        ..Case::LIN
    }
}

/// Small differences of speed bring the balls together over a turn. Regression: 1.0 % rms, 3.0 % where free speeds are parabolas of the deviations.
#[test]
fn balls_in_a_long_wave_join_in_time() {
    let [all, ..] = followed(28, &turn(100.0, waves(1, 4), 90));
    assert_eq!(all.count(), 91.0);
    assert!(all.rms() < 0.015, "{}", all.rms());
}

/// In time over a turn at 1 kHz, 64 screws: torque at the same instant. Regression, of what README and `bench/accuracy.md` say.
#[test]
#[ignore = "two minutes: cargo test --release -p epas-bench --lib filled_screws -- --ignored --nocapture"]
fn filled_screws() {
    let random = |seed| {
        [
            random(TAU / 360.0, seed),
            random(0.5 * TAU / 360.0, seed + 1),
        ]
    };
    let maps = [
        ("4 a turn", waves(4, 1)),
        ("2 a turn", waves(2, 1)),
        ("1 a turn", waves(1, 1)),
        ("of 2 turns", waves(1, 2)),
        ("of 4 turns", waves(1, 4)),
        ("random, 1", random(1)),
        ("random, 2", random(3)),
        ("random, 3", random(5)),
    ];
    let mut cases = Vec::new();
    for load in [50.0, -50.0, 100.0, -100.0] {
        for (name, maps) in maps {
            let case = turn(load, maps, 360);
            case.law().unwrap();
            cases.extend([28, 37].map(|balls| (balls, name, case)));
        }
    }
    println!(
        "balls, N a ball, waves: largest, rms (%), states of all; without a flag; where no pair begins or ends to press"
    );
    cases.par_iter().for_each(|(balls, name, case)| {
        let found = followed(*balls, case);
        let told = found.map(|of| {
            format!(
                "{:4.1} {:.2} {}",
                100.0 * of.largest,
                100.0 * of.rms(),
                of.count()
            )
        });
        println!(
            "{balls} {:4} {name:10}: {}",
            case.load_per_ball,
            told.join("; ")
        );
        let [all, held, apart] = found;
        assert!(all.largest < 0.3 && all.rms() < 0.023);
        assert!(held.rms() < 0.019 && apart.largest < 0.06);
    });
}
