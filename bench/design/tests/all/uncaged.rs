//! Screws without cage: how exact a law of one ball is, and what a fold refuses.

use std::sync::LazyLock;

use epas_design::uncaged::UncagedBlock;
use epas_design::{CagedDesign, Failure, FoldedUncaged, UncagedDesign, UncagedFold};
use epas_friction::scene::FoldedBall;
use epas_friction::{BallScrew, Clearance, DISSERTATION_DESIGNS, Limits, RollingResistance};

fn fold() -> UncagedFold {
    let [design, ..] = DISSERTATION_DESIGNS;
    UncagedFold {
        axial_load: [20.0, 100.0],
        ..UncagedFold::of(UncagedDesign {
            gear: CagedDesign {
                design: BallScrew::new(design.parameters).unwrap(),
                friction: 0.1,
                rolling_resistance: RollingResistance::STEEL,
                clearance: Clearance::new(0.0).unwrap(),
                loaded_balls: 32,
                reversal_speed: 0.5,
                limits: Limits {
                    nut_speed: 500.0,
                    axial_load: 50_000.0,
                    friction_torque: 50.0,
                },
            },
            deviations: [1.0_f32.to_radians(), 0.5_f32.to_radians()],
        })
    }
}

static FOLDED: LazyLock<FoldedUncaged> = LazyLock::new(|| fold().folded().unwrap());

fn one(folded: &FoldedUncaged) -> FoldedBall<1> {
    match folded.block {
        UncagedBlock::One(block) => block,
        UncagedBlock::Range(_) => panic!("a block for one friction coefficient"),
    }
}

/// Regression, half as much again as found: a row without friction between balls, which press each other outward, has 7.8e-5 rms and 1.8e-4 largest
/// relative error of the torque over 20 to 100 N a ball, and 0.3 % rms of the forces.
#[test]
fn regression_of_rows_without_friction_between_balls() {
    let figures = &FOLDED.certificate.smooth;
    assert!(figures.rows >= 30, "{}", figures.rows);
    assert!(figures.torque.rms <= 1.2e-4, "{}", figures.torque.rms);
    assert!(
        figures.torque.largest <= 2.8e-4,
        "{}",
        figures.torque.largest
    );
    assert!(figures.forces.rms <= 5e-3, "{}", figures.forces.rms);
}

/// Regression: with friction of 0.1 between balls 0.45 % rms of the torque and 1.1 % of the forces.
#[test]
fn regression_of_rows_that_rub() {
    let figures = &FOLDED.certificate.rubbing;
    assert!(figures.rows >= 30, "{}", figures.rows);
    assert!(figures.torque.rms <= 7e-3, "{}", figures.torque.rms);
    assert!(figures.forces.rms <= 1.7e-2, "{}", figures.forces.rms);
}

/// Regression: in waves 3.7e-4 rms and 1.7e-3 largest relative error of the torque without friction between balls, 1.5 % rms with it; of rows that
/// are not flagged 0.6 % rms and 2.2 % largest.
#[test]
fn regression_of_rows_in_waves() {
    let figures = &FOLDED.certificate.waves;
    assert!(figures.rows >= 22, "{}", figures.rows);
    assert!(figures.torque.rms <= 5.6e-4, "{}", figures.torque.rms);
    assert!(
        figures.torque.largest <= 2.6e-3,
        "{}",
        figures.torque.largest
    );
    let rubbing = &FOLDED.certificate.rubbing_waves;
    assert!(rubbing.rows >= 20 && rubbing.flagged <= 0.5, "{rubbing:?}");
    assert!(rubbing.torque.rms <= 2.3e-2, "{rubbing:?}");
    assert!(rubbing.unflagged_torque.rms <= 1e-2, "{rubbing:?}");
    assert!(rubbing.unflagged_torque.largest <= 3.3e-2, "{rubbing:?}");
}

#[test]
fn the_same_inputs_give_the_same_bits() {
    let again = fold().block().unwrap();
    assert_eq!(again.words(FOLDED.digest).unwrap(), FOLDED.words().unwrap());
}

/// Knots reach from a tenth of the least load to the largest one, of both branches, and the crate takes the law and its words.
#[test]
fn knots_cover_the_domain() {
    let block = one(&FOLDED);
    block.law.checked().unwrap();
    for branch in &block.law.nodes[0].branches {
        assert!(branch[0].load <= 2.001, "{}", branch[0].load);
        assert!((branch[branch.len() - 1].load - 100.0).abs() < 1e-3);
    }
    let read = FoldedBall::<1>::read(&FOLDED.words().unwrap()).unwrap();
    assert_eq!(read, block);
}

#[test]
fn refused_numbers_are_named() {
    let wrong = |change: fn(&mut UncagedFold)| {
        let mut fold = fold();
        change(&mut fold);
        match fold.block() {
            Err(Failure::Field(error)) => error.field(),
            other => panic!("{:?}", other.map(|_| ())),
        }
    };
    assert_eq!(wrong(|fold| fold.gear.deviations[0] = 0.0), "deviations");
    assert_eq!(
        wrong(|fold| fold.gear.deviations[1] = f32::NAN),
        "deviations"
    );
    assert_eq!(wrong(|fold| fold.axial_load = [0.0, 10.0]), "axial_load");
    assert_eq!(wrong(|fold| fold.axial_load = [10.0, 10.5]), "axial_load");
    assert_eq!(wrong(|fold| fold.friction = Some([0.2, 0.3])), "friction");
    assert_eq!(wrong(|fold| fold.gear.gear.friction = 1.0), "friction");
}
