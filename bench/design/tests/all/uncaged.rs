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

/// Regression: a row without friction between balls has 3.4e-5 rms and 9.4e-5 largest relative error of the torque over 20 to 100 N a ball (1.1e-4
/// and 2.9e-4 over 5 to 300 N), and 0.3 % rms of the forces.
#[test]
fn regression_of_rows_without_friction_between_balls() {
    let figures = &FOLDED.certificate.smooth;
    assert!(figures.rows >= 44, "{}", figures.rows);
    // Were what a push loses always half of its work (`BallNumbers::work` 1), they would be 1.5e-4 and 3.7e-4.
    assert!(figures.torque.rms <= 7e-5, "{}", figures.torque.rms);
    assert!(figures.torque.largest <= 2e-4, "{}", figures.torque.largest);
    assert!(figures.forces.rms <= 1e-2, "{}", figures.forces.rms);
}

/// Regression: friction between balls of 0.1 changes forces by more than a law of one ball knows: 1.1 % rms of the torque over 5 to 300 N.
#[test]
fn regression_of_rows_that_rub() {
    let figures = &FOLDED.certificate.rubbing;
    assert!(figures.torque.rms <= 3e-2, "{}", figures.torque.rms);
    assert!(figures.forces.rms <= 6e-2, "{}", figures.forces.rms);
}

/// Regression: in waves rows without friction between balls are as exact as others (4.0e-5 rms and 1.2e-4 largest relative error of the torque).
/// Where friction between them adds up over long waves the torque is held no more (4.7 % rms over 5 to 300 N); these rows are flagged, and
/// the others are as exact as rows of random deviations.
#[test]
fn regression_of_rows_in_waves() {
    let figures = &FOLDED.certificate.waves;
    assert!(figures.rows >= 33, "{}", figures.rows);
    assert!(figures.torque.rms <= 7e-5, "{}", figures.torque.rms);
    assert!(figures.torque.largest <= 2e-4, "{}", figures.torque.largest);
    let rubbing = &FOLDED.certificate.rubbing_waves;
    assert!(rubbing.rows >= 10 && rubbing.flagged <= 0.5, "{rubbing:?}");
    assert!(rubbing.torque.largest > 0.03, "{rubbing:?}");
    assert!(rubbing.unflagged_torque.largest <= 0.02, "{rubbing:?}");
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
