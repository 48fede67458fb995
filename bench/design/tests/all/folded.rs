//! Caged screws: how exact they are, what a block holds, and what a model of one does.

use std::sync::LazyLock;

use epas_design::caged::{Block, NODES};
use epas_design::{CagedDesign, CagedFold, Failure, Folded};
use epas_friction::law::coefficient::{OneCoefficient, TemperatureFade};
use epas_friction::law::memory::LoadExactElements;
use epas_friction::law::motion::SpeedOverTick;
use epas_friction::scene::{
    CagedBallScrew, CagedBallScrewConfiguration, CagedConstants, Freshness, WithMemory,
    WithMemoryConfiguration, WithMemoryInputs,
};
use epas_friction::{
    BallScrew, CATALOGUE, Clearance, DISSERTATION_DESIGNS, Faults, FrictionModel, Inputs, Limits,
    Regime, RollingResistance,
};
use epas_reference::friction::ball_screw_efficiency::LoadedScrew;

type One = FrictionModel<CagedBallScrew>;
type Range = FrictionModel<CagedBallScrew<NODES>>;

const LIMITS: Limits = Limits {
    nut_speed: 500.0,
    axial_load: 50_000.0,
    friction_torque: 50.0,
};

fn screw(size: &str) -> BallScrew {
    let catalogue = CATALOGUE.iter().map(|size| (size.name, size.parameters()));
    let designs = DISSERTATION_DESIGNS.iter();
    let (_, parameters) = catalogue
        .chain(designs.map(|design| (design.name, design.parameters)))
        .find(|(name, _)| *name == size)
        .unwrap();
    BallScrew::new(parameters).unwrap()
}

fn gear(size: &str, clearance: f32, friction: f32) -> CagedDesign {
    CagedDesign {
        design: screw(size),
        friction,
        rolling_resistance: RollingResistance::STEEL,
        clearance: Clearance::new(clearance).unwrap(),
        loaded_balls: 71,
        reversal_speed: 0.5,
        limits: LIMITS,
    }
}

fn folded(size: &str, clearance: f32, friction: f32) -> Folded {
    CagedFold::of(gear(size, clearance, friction))
        .folded()
        .unwrap()
}

/// A steering gear with preload, for one friction coefficient.
static STEERING: LazyLock<Folded> = LazyLock::new(|| folded("lin-4.1", -1e-6, 0.1));

static STEERING_RANGE: LazyLock<Folded> = LazyLock::new(|| {
    CagedFold {
        friction: Some([0.05, 0.15]),
        ..CagedFold::of(gear("lin-4.1", -1e-6, 0.1))
    }
    .folded()
    .unwrap()
});

fn one(folded: &Folded) -> CagedBallScrewConfiguration {
    match folded.block {
        Block::One(block) => block,
        Block::Range(_) => panic!("a block for one friction coefficient"),
    }
}

fn range(folded: &Folded) -> CagedBallScrewConfiguration<NODES> {
    match folded.block {
        Block::Range(block) => block,
        Block::One(_) => panic!("a block for a range of friction coefficients"),
    }
}

fn sliding(axial_load: f32) -> Inputs {
    Inputs {
        nut_speed: 400.0,
        axial_load,
    }
}

/// The goal for every design: largest 0.6 %, rms 0.2 %, on states that were not fitted, no state flagged or left out.
fn holds_its_accuracy(folded: &Folded, line: &str) {
    let [torque] = &folded.certificate.figures;
    println!("{line}: {torque:?}");
    assert!(torque.largest <= 6e-3, "{line}: {}", torque.largest);
    assert!(torque.rms <= 2e-3, "{line}: {}", torque.rms);
    assert!(torque.mean.abs() <= 5e-4, "{line}: {}", torque.mean);
    assert_eq!((torque.states, torque.unsolved), (2048, 0), "{line}");
    assert_eq!(torque.flagged, 0.0, "{line}");
}

/// A steering gear. Others in `blocks_hold_their_accuracy_whole`, and by the table of promises in `scenes::caged::folded_step` of epas-reference.
#[test]
fn blocks_hold_their_accuracy() {
    holds_its_accuracy(&STEERING, "lin-4.1");
}

/// Small and large balls, steep and flat leads, preload, play and two contacts.
#[test]
#[ignore = "whole sweep: cargo test -p epas-design --test all -- --ignored _whole"]
fn blocks_hold_their_accuracy_whole() {
    for (size, clearance, friction) in [
        ("lin-2.1", 0.0, 0.05),
        ("20x50x3.5", 5e-6, 0.15),
        ("63x25x9.525", 20e-6, 0.1),
        ("160x25x12.7", -5e-6, 0.05),
    ] {
        holds_its_accuracy(&folded(size, clearance, friction), size);
    }
}

/// Against balls that are each solved from nothing, by the reference's own entry for a loaded screw: another path than the fold and its
/// certificate take.
#[test]
fn a_step_is_the_torque_of_a_loaded_screw() {
    let gear = gear("lin-4.1", -1e-6, 0.1);
    let mut model = One::new(&one(&STEERING)).unwrap();
    for load_per_ball in [7.0_f32, 23.0, 24.0, 26.0, 61.0, 140.0, 299.0] {
        for side in [1.0, -1.0] {
            let axial_load = side * 71.0 * load_per_ball;
            let exact = LoadedScrew {
                design: epas_design::drawing::drawing(gear.design.parameters()),
                clearance: (-1e-6_f32).into(),
                friction: 0.1_f32.into(),
                rolling: epas_reference::friction::rolling_resistance::RollingResistance::STEEL,
                balls: 71.0,
                axial_load: axial_load.into(),
            }
            .solve()
            .unwrap();
            let outputs = model.step(sliding(axial_load));
            let error = f64::from(outputs.friction_torque) / exact.torque() - 1.0;
            assert!(error.abs() < 6e-3, "{axial_load} N: {error:e}");
            let efficiency = if side > 0.0 {
                exact.efficiency()
            } else {
                exact.backdrive_efficiency()
            };
            assert!((f64::from(outputs.efficiency) - efficiency).abs() < 6e-3);
            assert_eq!(outputs.faults, Faults::NONE);
        }
    }
}

/// Odd under reversal of speed and load together; none at standstill; with a preload, some without a load.
#[test]
fn friction_opposes_motion() {
    let mut model = One::new(&one(&STEERING)).unwrap();
    for axial_load in [0.0, 10.0, 800.0, -3000.0, 20_000.0] {
        for nut_speed in [0.1, 3.0, 400.0] {
            let there = model.step(Inputs {
                nut_speed,
                axial_load,
            });
            let back = model.step(Inputs {
                nut_speed: -nut_speed,
                axial_load: -axial_load,
            });
            assert_eq!(there.friction_torque, -back.friction_torque);
            assert!(there.friction_torque > 0.0, "{axial_load} {nut_speed}");
            assert_eq!(there.regime, back.regime);
        }
        let still = model.step(Inputs {
            nut_speed: 0.0,
            axial_load,
        });
        assert_eq!(
            (still.friction_torque, still.regime),
            (0.0, Regime::Standing)
        );
    }
}

/// A load beyond the block's, within the limit: the law's end, flagged, without a step. (The reference's tests of every scene hold other extreme
/// inputs.)
#[test]
fn loads_beyond_the_block_are_flagged() {
    let mut model = One::new(&one(&STEERING)).unwrap();
    let border = 71.0 * 300.0;
    let [within, beyond] = [0.9999, 1.0002].map(|part| model.step(sliding(part * border)));
    assert_eq!(within.faults, Faults::NONE);
    assert_eq!(beyond.faults, Faults::BEYOND_MODEL);
    assert!(!beyond.faults.faulty());
    assert!((beyond.friction_torque / within.friction_torque - 1.0).abs() < 1e-3);
}

/// Between nodes the torque rises with the friction coefficient, at nodes the block's own; beyond them the coefficient is refused.
#[test]
fn friction_is_set_within_the_nodes() {
    let [torque] = &STEERING_RANGE.certificate.figures;
    println!("{torque:?}");
    // Regression: the largest error of a blend where a contact opens, 1.9 % found, and its rms of 3.4e-3.
    assert!(torque.largest < 2.5e-2 && torque.rms < 5e-3);
    let block = range(&STEERING_RANGE);
    let mut model = Range::new(&block).unwrap();
    let mut last = 0.0;
    for step in 0..=100_u8 {
        let friction = (0.05 + 0.001 * f32::from(step)).min(0.15);
        model.set_friction(friction).unwrap();
        let torque = model.step(sliding(2_000.0)).friction_torque;
        assert!(torque > last, "{friction}");
        last = torque;
    }
    for wrong in [0.049, 0.151, f32::NAN, -0.1] {
        assert_eq!(model.set_friction(wrong).unwrap_err().field(), "friction");
        assert_eq!(model.step(sliding(2_000.0)).friction_torque, last);
    }
    model.reset();
    let fresh = Range::new(&block).unwrap().step(sliding(2_000.0));
    assert_eq!(model.step(sliding(2_000.0)), fresh);
    // A block for one coefficient has that one alone.
    let mut single = One::new(&one(&STEERING)).unwrap();
    assert_eq!(single.set_friction(0.1), Ok(()));
    assert_eq!(single.set_friction(0.11).unwrap_err().field(), "friction");
}

/// The same inputs give the same bits; what was written is read; what is damaged is refused, whatever word it is.
#[test]
fn a_block_is_read_as_it_was_written() {
    let again = folded("lin-4.1", -1e-6, 0.1);
    let words = STEERING.words().unwrap();
    assert_eq!(words, again.words().unwrap());
    assert_eq!(
        CagedBallScrewConfiguration::read(&words),
        Ok(one(&STEERING))
    );
    let constants = CagedConstants::<1>::from_block(&words).unwrap();
    assert_eq!(constants, CagedConstants::new(&one(&STEERING)).unwrap());
    let bytes = STEERING.bytes().unwrap();
    let of_bytes: Vec<u32> = bytes
        .chunks_exact(4)
        .map(|word| u32::from_le_bytes(word.try_into().unwrap()))
        .collect();
    assert_eq!(of_bytes, words);
    for number in 0..words.len() {
        let mut damaged = words.clone();
        damaged[number] ^= 1 << (number % 32);
        let field = CagedConstants::<1>::from_block(&damaged)
            .unwrap_err()
            .field();
        let expected = match number {
            0 => "magic",
            1 => "version",
            2 => "words",
            3 => "nodes",
            _ => "checksum",
        };
        assert_eq!(field, expected, "{number}");
    }
    let short = CagedConstants::<1>::from_block(&words[1..]).unwrap_err();
    assert_eq!(short.field(), "words");
    let nodes = CagedConstants::<NODES>::from_block(&STEERING.words().unwrap()).unwrap_err();
    assert_eq!(nodes.field(), "words");
    let range = STEERING_RANGE.words().unwrap();
    assert_eq!(
        CagedConstants::<1>::from_block(&range).unwrap_err().field(),
        "nodes"
    );
    assert!(CagedConstants::<NODES>::from_block(&range).is_ok());
    // Another seed draws other states and folds the same law.
    let other = CagedFold {
        seed: 2,
        ..STEERING.fold
    };
    let other = other.folded().unwrap();
    assert_eq!(one(&other), one(&STEERING));
    assert_ne!(
        (other.digest, &other.certificate),
        (STEERING.digest, &STEERING.certificate)
    );
}

/// In steady sliding a memory has the friction of the scene; a coefficient that the block does not hold is flagged.
#[test]
fn a_memory_slides_as_the_scene() {
    type Remembering<const N: usize> = FrictionModel<
        WithMemory<CagedBallScrew<N>, LoadExactElements<8>, SpeedOverTick, OneCoefficient>,
    >;
    fn slide<const N: usize>(
        block: CagedBallScrewConfiguration<N>,
        friction: f32,
    ) -> epas_friction::Outputs {
        let mut model = Remembering::<N>::new(&WithMemoryConfiguration {
            scene: block,
            elements: LoadExactElements::new(0.2, 0.002, 4.0).unwrap(),
            angle: SpeedOverTick::new(1e-3, 500.0).unwrap(),
            reference_load: 2_000.0,
            play: 0.0,
            coefficient: OneCoefficient::new(friction).unwrap(),
            temperature: TemperatureFade::new(303.15, 1.0, 1.0).unwrap(),
            freshness: Freshness::DEFAULT,
        })
        .unwrap();
        let mut outputs = None;
        for _ in 0..50 {
            outputs = Some(model.step(WithMemoryInputs {
                scene: sliding(2_000.0),
                reading: 400.0,
                load_age: 0.0,
                temperature: 303.15,
                temperature_age: 0.0,
            }));
        }
        outputs.unwrap()
    }
    let scene = One::new(&one(&STEERING)).unwrap().step(sliding(2_000.0));
    let memory = slide(one(&STEERING), 0.1);
    // The reversal's share at 800 times its speed is 8e-7 below 1.
    assert!((memory.friction_torque / scene.friction_torque - 1.0).abs() < 2e-6);
    assert_eq!(memory.faults, Faults::NONE);
    assert_eq!(slide(one(&STEERING), 0.12).faults, Faults::BEYOND_MODEL);
    assert_eq!(slide(range(&STEERING_RANGE), 0.12).faults, Faults::NONE);
}

#[test]
fn what_cannot_be_folded_is_refused() {
    let refused = |change: fn(&mut CagedFold)| {
        let mut fold = CagedFold::of(gear("lin-4.1", -1e-6, 0.1));
        change(&mut fold);
        fold.folded().unwrap_err().to_string()
    };
    assert!(
        refused(|fold| {
            let gap = -0.021 * fold.gear.design.ball_radius();
            fold.gear.clearance = Clearance::new(gap).unwrap();
        })
        .contains("clearance")
    );
    assert!(refused(|fold| fold.gear.reversal_speed = 0.0).contains("reversal_speed"));
    assert!(refused(|fold| fold.gear.limits.axial_load = 0.0).contains("axial_load"));
    assert!(
        refused(|fold| fold.gear.rolling_resistance.hysteresis_loss = 0.3).contains("hysteresis")
    );
    assert!(refused(|fold| fold.gear.friction = 0.6).contains("friction"));
    assert!(refused(|fold| fold.gear.loaded_balls = 0).contains("loaded_balls"));
    assert!(refused(|fold| fold.axial_load = [300.0, 5.0]).contains("axial_load"));
    assert!(refused(|fold| fold.axial_load = [f32::NAN, 5.0]).contains("axial_load"));
    assert!(refused(|fold| fold.friction = Some([0.11, 0.15])).contains("friction"));
    assert!(refused(|fold| fold.friction = Some([0.15, 0.05])).contains("friction"));
    let error = CagedFold {
        friction: Some([1e-4, 0.15]),
        ..CagedFold::of(gear("lin-4.1", -1e-6, 0.1))
    }
    .folded();
    assert!(matches!(error, Err(Failure::Field(_))));
}
