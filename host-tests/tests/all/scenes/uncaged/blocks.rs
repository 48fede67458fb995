//! What a host has folded of a ball screw without cage: the law between its knots, numbers that are no law, and blocks that are none.

use crate::refusals::assert_refused;
use epas_friction::Error;
use epas_friction::ball::pressed::{
    BallKnot, BallLaw, BallNumbers, FreeMotion, KNOTS, NeighbourNumbers, SPEED_POWERS,
};
use epas_friction::scene::FoldedBall;

use epas_testkit::gears::{BALL, BALL_NODES, BALL_RANGE};
use epas_testkit::random::Random;

fn all(numbers: &BallNumbers) -> Vec<f32> {
    let BallNumbers {
        free,
        impedance,
        torque,
        slope,
        work,
    } = *numbers;
    [&free[..], &impedance, &torque, &[slope, work]].concat()
}

/// Impedance, torque and slope in proportion to `mu W`; free speed and work without it.
fn over_load(numbers: &BallNumbers, sliding: f32) -> Vec<f32> {
    all(&BallNumbers {
        impedance: numbers.impedance.map(|z| z / sliding),
        torque: numbers.torque.map(|t| t / sliding),
        slope: numbers.slope / sliding,
        ..*numbers
    })
}

/// Whether numbers are the same but for roundings: four of 2^-24 of the largest of their kind.
fn alike(one: &[f32], other: &[f32], sizes: &[f32]) -> bool {
    one.iter()
        .zip(other)
        .zip(sizes)
        .all(|((one, other), size)| (one - other).abs() <= 2.4e-7 * size)
}

/// At a knot a ball has the knot's numbers, halfway to the next the mean of both, below the first and above the last theirs in proportion
/// to the load.
#[test]
fn numbers_are_those_of_the_knots() {
    for node in 0..BALL_NODES {
        let law = &BALL_RANGE.law;
        let friction = law.nodes[node].friction;
        let interval = law.interval(friction);
        for branch in 0..2 {
            let knots = &law.nodes[node].branches[branch];
            let sizes: Vec<f32> = (0..17)
                .map(|at| {
                    let numbers = knots.iter().map(|knot| all(&knot.numbers)[at].abs());
                    numbers.fold(0.0, f32::max)
                })
                .collect();
            let found =
                |load: f32| over_load(&law.numbers(load, branch, interval), friction * load);
            for pair in knots.windows(2) {
                let [below, above] = [&pair[0], &pair[1]];
                assert!(alike(&found(below.load), &all(&below.numbers), &sizes));
                if above.load > below.load {
                    let ends = [all(&below.numbers), all(&above.numbers)];
                    let mean: Vec<f32> = (0..17)
                        .map(|at| 0.5 * (ends[0][at] + ends[1][at]))
                        .collect();
                    let middle = 0.5 * (below.load + above.load);
                    // The share of the way is rounded too, by the load's last digit over the distance of two knots.
                    let share = middle / (above.load - below.load);
                    let sizes: Vec<f32> = sizes.iter().map(|size| size * (1.0 + share)).collect();
                    assert!(alike(&found(middle), &mean, &sizes), "{middle} N");
                }
            }
            let [first, last] = [&knots[0], &knots[KNOTS - 1]];
            for (load, knot) in [(0.1 * first.load, first), (7.0 * last.load, last)] {
                assert!(alike(&found(load), &all(&knot.numbers), &sizes), "{load} N");
            }
        }
    }
}

/// What one ball does is what all balls under its load do, by fewer operations.
#[test]
fn one_ball_is_as_all_under_its_load() {
    fn check<const NODES: usize>(law: &BallLaw<NODES>) {
        let mut random = Random(3);
        let (least, largest) = law.friction_range();
        let heaviest = law.nodes[0].branches[0][KNOTS - 1].load;
        for _ in 0..20_000 {
            let load = random.size(0.1, 2.0 * heaviest);
            let interval = law.interval(random.within(least, largest));
            let branch = random.below(2);
            let deviations = [random.within(-1.0, 1.0), random.within(-1.0, 1.0)];
            let numbers = law.numbers(load, branch, interval);
            let (ball, torque) = law.ball(load, branch, interval, deviations, 1.0);
            let one = FreeMotion {
                speed: ball.speed,
                impedance: ball.sliding * ball.impedance,
                torque,
            };
            let all = numbers.at(deviations);
            let sum = |numbers: &[f32]| numbers.iter().map(|number| number.abs()).sum::<f32>();
            // A dozen roundings of sums of the powers' sizes.
            for (one, all, size) in [
                (one.speed, all.speed, sum(&numbers.free)),
                (one.impedance, all.impedance, sum(&numbers.impedance)),
                (one.torque, all.torque, sum(&numbers.torque)),
            ] {
                assert!((one - all).abs() <= 12.0 * 6e-8 * size, "{one} {all}");
            }
        }
    }
    check(&BALL.law);
    check(&BALL_RANGE.law);
}

/// Numbers outside the law's ranges are refused by name, wherever they stand; at the border they are taken.
#[test]
fn numbers_out_of_range_are_refused_by_name() {
    fn knot(law: &mut BallLaw<BALL_NODES>) -> &mut BallKnot {
        &mut law.nodes[1].branches[1][7]
    }
    fn numbers(law: &mut BallLaw<BALL_NODES>) -> &mut BallNumbers {
        &mut knot(law).numbers
    }
    fn neighbours(law: &mut BallLaw<BALL_NODES>) -> &mut NeighbourNumbers {
        &mut law.nodes[0].neighbours[1][3].numbers
    }
    #[rustfmt::skip]
    assert_refused(
        &BALL_RANGE.law,
        BallLaw::checked,
        &[
            ("deviations", |law, x| law.deviations[0] = x, &[9e-7, 1.01]),
            ("deviations", |law, x| law.deviations[1] = x, &[0.0, -0.1]),
            ("lift_off", |law, x| law.lift_off = x, &[-1e-6, 1.1e7]),
            ("friction", |law, x| law.nodes[0].friction = x, &[9e-7, 0.51]),
            ("friction", |law, x| law.nodes[2].friction = x, &[0.0, 0.51]),
            ("free", |law, x| numbers(law).free[0] = x, &[1.01, -1.01]),
            ("free", |law, x| numbers(law).free = [x; SPEED_POWERS], &[0.101, -0.101]),
            ("impedance", |law, x| numbers(law).impedance[0] = x, &[0.0, -1.0, 1.1e3]),
            ("impedance", |law, x| numbers(law).impedance = [1.0, x, -x], &[0.5, -0.5, 600.0]),
            ("torque", |law, x| numbers(law).torque[5] = x, &[1.01, -1.01]),
            ("slope", |law, x| numbers(law).slope = x, &[1.01, -1.01]),
            ("work", |law, x| numbers(law).work = x, &[-0.01, 4.01]),
            ("push", |law, x| neighbours(law).nodes[1].push[2] = x, &[1.1e3, -1.1e3]),
            ("rubbed_impedance", |law, x| neighbours(law).nodes[2].impedance[0] = x, &[1.1e3]),
            ("rubbed_torque", |law, x| neighbours(law).nodes[0].torque[1] = x, &[-1.1e3]),
            ("outward", |law, x| neighbours(law).outward[2] = x, &[1.1e3]),
            ("outward_torque", |law, x| neighbours(law).outward_torque = x, &[-1.1e3]),
            ("load", |law, x| law.nodes[1].neighbours[0][2].load = x, &[9e-7, 1.1e7]),
            ("load", |law, x| knot(law).load = x, &[9e-7, 1.1e7]),
            ("per_width", |law, x| knot(law).per_width *= x, &[0.0, 0.999, 1.001, -1.0]),
            ("load", |law, _| law.nodes[2].branches[0][4].load = law.nodes[2].branches[0][2].load, &[]),
            ("friction", |law, _| law.nodes[1].friction = 1.009 * law.nodes[0].friction, &[]),
        ],
    );
    let taken: [fn(&mut BallLaw<BALL_NODES>); 5] = [
        |law| law.deviations = [1e-6, 1.0],
        |law| law.lift_off = 1e7,
        |law| numbers(law).free = std::array::from_fn(|power| if power == 9 { 1.0 } else { 0.0 }),
        |law| neighbours(law).nodes[2].push = [-1e3, 1e3, 0.0],
        |law| numbers(law).slope = -1.0,
    ];
    for change in taken {
        let mut law = BALL_RANGE.law;
        change(&mut law);
        assert_eq!(law.checked(), Ok(()));
    }
}

fn block<const NODES: usize>(folded: &FoldedBall<NODES>) -> Vec<u32> {
    let mut words = vec![0xA5A5_A5A5; FoldedBall::<NODES>::WORDS];
    folded.write(0x0123_4567_89AB_CDEF, &mut words).unwrap();
    words
}

fn refusal<const NODES: usize>(words: &[u32]) -> &'static str {
    FoldedBall::<NODES>::read(words)
        .map(|_| ())
        .unwrap_err()
        .field()
}

#[test]
fn a_block_gives_back_what_was_folded() {
    let mut preloaded = BALL;
    preloaded.law.lift_off = 47.1;
    preloaded.law.nodes[0].unheld = [0x8000_0001, 0x7FFF_FFFE];
    for folded in [&BALL, &preloaded] {
        assert_eq!(FoldedBall::read(&block(folded)).as_ref(), Ok(folded));
    }
    let words = block(&BALL_RANGE);
    assert_eq!(FoldedBall::read(&words), Ok(BALL_RANGE));
    assert_eq!(words[4..6], [0x89AB_CDEF, 0x0123_4567]);
    let mut roomy = vec![7; words.len() + 3];
    BALL_RANGE.write(0x0123_4567_89AB_CDEF, &mut roomy).unwrap();
    assert_eq!(roomy[..words.len()], words);
    assert_eq!(roomy[words.len()..], [7; 3]);
    assert_eq!(FoldedBall::read(&roomy), Ok(BALL_RANGE));
    let mut short = vec![7; words.len() - 1];
    let refused = BALL_RANGE.write(0, &mut short).unwrap_err();
    assert_eq!(refused.field(), "words");
    assert!(short.iter().all(|&word| word == 7));
}

#[test]
fn every_flipped_bit_is_found() {
    let words = block(&BALL);
    let mut random = Random(9);
    let header = (0..6 * 32).map(|bit| (bit / 32, bit % 32));
    let one_each = (6..words.len()).map(|word| (word, random.below(32)));
    for (word, bit) in header.chain(one_each) {
        let mut flipped = words.clone();
        flipped[word] ^= 1 << bit;
        let expected = match word {
            0 => "magic",
            1 => "version",
            2 => "words",
            3 => "nodes",
            _ => "checksum",
        };
        assert_eq!(refusal::<1>(&flipped), expected, "bit {bit} of word {word}");
    }
}

#[test]
fn other_blocks_are_refused_by_name() {
    let (one, range) = (block(&BALL), block(&BALL_RANGE));
    assert_eq!(refusal::<1>(&range), "nodes");
    assert_eq!(refusal::<BALL_NODES>(&one), "words");
    let mut long = one.clone();
    long.resize(FoldedBall::<BALL_NODES>::WORDS, 0);
    assert_eq!(refusal::<BALL_NODES>(&long), "nodes");
    for length in [0, 1, 6, one.len() - 1] {
        assert_eq!(refusal::<1>(&one[..length]), "words");
    }
    let sealed = |word: usize, value: u32| {
        let mut words = one.clone();
        words[word] = value;
        let last = words.len() - 1;
        let bytes: Vec<u8> = words[..last]
            .iter()
            .flat_map(|word| word.to_le_bytes())
            .collect();
        words[last] = crc32fast::hash(&bytes);
        words
    };
    // What fits a checksum of another crate is taken.
    assert_eq!(FoldedBall::read(&sealed(4, 1)), Ok(BALL));
    assert_eq!(refusal::<1>(&sealed(1, 4)), "version");
    assert_eq!(
        refusal::<1>(&sealed(0, u32::from_le_bytes(*b"EPAS"))),
        "magic"
    );
    assert_eq!(refusal::<1>(&vec![0; one.len()]), "magic");
    assert_eq!(refusal::<1>(&vec![u32::MAX; one.len()]), "magic");
    // Its numbers are read unchecked: what uses them refuses them.
    let bad: Result<FoldedBall<1>, Error> = FoldedBall::read(&sealed(6 + 9, f32::NAN.to_bits()));
    assert_eq!(
        bad.unwrap().law.checked().unwrap_err().field(),
        "deviations"
    );
}
