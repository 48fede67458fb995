//! A whole gear folded by the compiler is the gear that a program would set up, to the bit, and runs like it.

use crate::formulas::constants::same_bits;
use epas_testkit::gears::{linear_inputs, screw_inputs};
use std::fmt::Debug;
use std::hint::black_box;

use epas_friction::ball::pressed::BallLaw;
use epas_friction::ball::{
    AnalyticLinearBall, GrooveFit, LinearBallParameters, PUBLISHED_SLOPE, ScrewRow,
};
use epas_friction::contact::FrictionMap;
use epas_friction::scene::FoldedBall;
use epas_friction::{
    BallScrew, Clearance, ClosedFormScrew, ClosedFormScrewConfiguration, ClosedFormScrewConstants,
    DISSERTATION_DESIGNS, Error, FrictionBranch, FrictionModel, Inputs, LinearBearingConfiguration,
    LinearBearingTrain, LinearConstants, LinearLimits, LoadShare, LoadShares, Outputs, Scene,
    UncagedBallScrew, UncagedBallScrewConfiguration, UncagedConstants, UncagedOutputs,
};

use epas_testkit::gears::{
    self, BALL, BALL_NODES, BALL_NUT_MAP, BALL_RANGE, BALL_SCREW_MAP, LINEAR_BALLS, UncagedScrew,
    folded,
};

static SHARES: [LoadShare; 3] = [
    folded(LoadShare::new(0.4)),
    LoadShare::MEAN,
    folded(LoadShare::new(1.6)),
];
static REVERSED: [LoadShare; 3] = [SHARES[2], SHARES[1], SHARES[0]];

const fn closed_form(branch: FrictionBranch, clearance: Clearance) -> ClosedFormScrewConfiguration {
    ClosedFormScrewConfiguration {
        rolling_tangent: 1e-3,
        clearance,
        ..gears::closed_form(branch)
    }
}

const fn uncaged<const NODES: usize>(
    folded: &'static FoldedBall<NODES>,
    balls: u16,
) -> UncagedBallScrewConfiguration<NODES> {
    UncagedBallScrewConfiguration {
        folded,
        ball_friction: 0.1,
        balls,
        turns: 2.0,
        return_length: 0.03,
        screw_deviation: &BALL_SCREW_MAP,
        nut_deviation: &BALL_NUT_MAP,
        load_shares: LoadShares {
            positive: &SHARES,
            negative: &REVERSED,
        },
        tick: 1e-4,
    }
}

const fn linear() -> LinearBearingConfiguration {
    LinearBearingConfiguration {
        return_length: 0.09,
        load_shares: &SHARES,
        ..gears::linear()
    }
}

const PRELOAD: GrooveFit = GrooveFit::Preload {
    contact_force: 20.0,
};

const OVERSIZE: Clearance = folded(Clearance::new(-2e-6));

static ROLLING: ClosedFormScrewConstants = folded(ClosedFormScrewConstants::new(&closed_form(
    FrictionBranch::Rolling,
    OVERSIZE,
)));
static SLIDING: ClosedFormScrewConstants = folded(ClosedFormScrewConstants::new(&closed_form(
    FrictionBranch::Sliding,
    Clearance::ZERO,
)));
static PRELOADED_BALL: FoldedBall = FoldedBall {
    law: BallLaw {
        lift_off: 60.0,
        ..BALL.law
    },
    ..BALL
};
static ONE: UncagedConstants<37> = folded(UncagedConstants::new(&uncaged(&BALL, 37)));
static RANGE: UncagedConstants<37, BALL_NODES> =
    folded(UncagedConstants::new(&uncaged(&BALL_RANGE, 37)));
static PRELOADED: UncagedConstants<24> =
    folded(UncagedConstants::new(&uncaged(&PRELOADED_BALL, 24)));
static CARRIAGE: LinearConstants<LINEAR_BALLS> = folded(LinearConstants::new(&linear()));

fn manoeuvre() -> impl Iterator<Item = (f32, f32)> {
    (0..4000_i16).map(|tick| {
        let phase = f32::from(tick) * 0.01;
        let speed = 200.0 * phase.sin();
        let load = 12_000.0 * (0.37 * phase).cos();
        match tick % 501 {
            100 => (f32::NAN, load),
            200 => (speed, f32::INFINITY),
            300 => (1e9, load),
            _ => (speed, load),
        }
    })
}

fn same_gear<S>(
    constants: &'static S::Constants,
    configuration: &S::Configuration,
    inputs: fn(f32, f32) -> S::Inputs,
) where
    S: Scene<Constants: Clone + Debug, State: Debug, Outputs: Debug>,
{
    same_bits(
        constants,
        &S::constants(black_box(configuration)).ok().unwrap(),
    );
    let mut referring = FrictionModel::<S, _>::of(constants);
    let mut owning = FrictionModel::<S>::new(black_box(configuration)).unwrap();
    for (speed, load) in manoeuvre() {
        same_bits(
            &referring.step(inputs(speed, load)),
            &owning.step(inputs(speed, load)),
        );
    }
    same_bits(referring.state(), owning.state());
    assert!(std::ptr::eq(referring.constants(), constants));

    referring.reset();
    same_bits(
        referring.state(),
        FrictionModel::<S>::of(constants.clone()).state(),
    );
}

const fn nut(nut_speed: f32, axial_load: f32) -> Inputs {
    screw_inputs(nut_speed, axial_load)
}

#[test]
fn a_folded_closed_form_is_the_one_set_up_at_run_time() {
    same_gear::<ClosedFormScrew>(
        &ROLLING,
        &closed_form(FrictionBranch::Rolling, OVERSIZE),
        nut,
    );
    same_gear::<ClosedFormScrew>(
        &SLIDING,
        &closed_form(FrictionBranch::Sliding, Clearance::ZERO),
        nut,
    );
}

#[test]
fn a_folded_ball_screw_without_cage_is_the_one_set_up_at_run_time() {
    same_gear::<UncagedBallScrew<37>>(&ONE, &uncaged(&BALL, 37), nut);
    same_gear::<UncagedScrew<37>>(&RANGE, &uncaged(&BALL_RANGE, 37), nut);
    same_gear::<UncagedBallScrew<24>>(&PRELOADED, &uncaged(&PRELOADED_BALL, 24), nut);
}

#[test]
fn a_folded_linear_bearing_is_the_one_set_up_at_run_time() {
    same_gear::<LinearBearingTrain<LINEAR_BALLS>>(&CARRIAGE, &linear(), |speed, load| {
        linear_inputs(0.01 * speed, 2_000.0, 0.1 * load)
    });
}

#[test]
fn a_model_of_a_reference_takes_the_nut_angle() {
    let mut referring = FrictionModel::<UncagedBallScrew<37>, _>::of(&ONE);
    let mut owning = FrictionModel::<UncagedBallScrew<37>>::of(ONE);
    let at_rest: UncagedOutputs = referring.step(nut(50.0, 3_000.0));
    same_bits(&at_rest, &owning.step(nut(50.0, 3_000.0)));
    referring.set_nut_angle(0.8);
    owning.set_nut_angle(0.8);
    let turned = referring.step(nut(50.0, 3_000.0));
    same_bits(&turned, &owning.step(nut(50.0, 3_000.0)));
    assert_ne!(Outputs::from(turned), Outputs::from(at_rest));
}

#[test]
fn a_refused_gear_names_its_field() {
    const BAD: Result<UncagedConstants<37>, Error> =
        UncagedConstants::new(&UncagedBallScrewConfiguration {
            tick: 0.1,
            ..uncaged(&BALL, 37)
        });
    const CROWDED: Result<UncagedConstants<60>, Error> = UncagedConstants::new(&uncaged(&BALL, 60));
    const HASTY: Result<LinearConstants<LINEAR_BALLS>, Error> =
        LinearConstants::new(&LinearBearingConfiguration {
            limits: LinearLimits {
                speed: f32::NAN,
                ..linear().limits
            },
            ..linear()
        });
    const SLIPPERY: Result<ClosedFormScrewConstants, Error> =
        ClosedFormScrewConstants::new(&ClosedFormScrewConfiguration {
            friction: -0.1,
            ..closed_form(FrictionBranch::Rolling, Clearance::ZERO)
        });
    let fields = [
        BAD.unwrap_err(),
        CROWDED.unwrap_err(),
        HASTY.unwrap_err(),
        SLIPPERY.unwrap_err(),
    ]
    .map(|error| error.field());
    assert_eq!(fields, ["tick", "pitch", "speed", "friction"]);
}

#[derive(Debug)]
#[allow(dead_code)] // Read through `Debug`.
struct Parts {
    map: FrictionMap,
    published: AnalyticLinearBall,
    row: ScrewRow,
}

const RATIOS: [f32; 5] = [0.02, 0.0811, 0.2321, 0.7, 0.95];

const fn parts(axis_ratio: f32, contact_angle: f32) -> Parts {
    let design = folded(BallScrew::new(DISSERTATION_DESIGNS[2].parameters));
    let ball = LinearBallParameters {
        ball_radius: 0.005,
        contact_angle,
        axis_ratio,
        semi_major_coefficient: 9.075e-5,
        friction: 0.1,
    };
    let published = AnalyticLinearBall::new(&ball, PUBLISHED_SLOPE);
    Parts {
        map: folded(FrictionMap::new(axis_ratio)),
        published: folded(published),
        row: folded(ScrewRow::new(&design, 0.1, PRELOAD)),
    }
}

#[test]
fn folded_balls_and_contacts_have_the_bits_of_those_made_at_run_time() {
    const FOLDED: [Parts; 5] = [
        parts(RATIOS[0], 0.3),
        parts(RATIOS[1], 0.6),
        parts(RATIOS[2], 0.785),
        parts(RATIOS[3], 1.0),
        parts(RATIOS[4], 1.4),
    ];
    let angles = [0.3, 0.6, 0.785, 1.0, 1.4];
    for ((folded, ratio), angle) in FOLDED.iter().zip(RATIOS).zip(angles) {
        same_bits(folded, &parts(black_box(ratio), black_box(angle)));
    }
}
