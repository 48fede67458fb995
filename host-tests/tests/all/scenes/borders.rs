//! Borders: where one regime ends and the next begins, to the last number on either side.

use epas_friction::ball::{AnalyticLinearBall, LinearBallParameters, PUBLISHED_SLOPE};
use epas_friction::efficiency::{Drive, EfficiencyGeometry};
use epas_friction::{
    BallScrew, CATALOGUE, Clearance, ClosedFormScrew, ClosedFormScrewConfiguration, Faults,
    FrictionBranch, FrictionModel, LinearBearingTrain, Regime, Scene,
};
use epas_testkit::gears::{linear_inputs, screw_inputs};

use epas_testkit::gears;

type Uncaged = gears::UncagedScrew<{ gears::SCREW_BALLS }>;
type Linear = LinearBearingTrain<{ gears::LINEAR_BALLS }>;

fn closed_form(configuration: &ClosedFormScrewConfiguration) -> FrictionModel<ClosedFormScrew> {
    FrictionModel::new(configuration).unwrap()
}

/// The two neighbouring numbers between which `is_beyond` becomes true.
fn border(mut below: f32, mut beyond: f32, is_beyond: impl Fn(f32) -> bool) -> (f32, f32) {
    assert!(!is_beyond(below) && is_beyond(beyond));
    while below.next_up() < beyond {
        let middle = f32::from_bits(u32::midpoint(below.to_bits(), beyond.to_bits()));
        if is_beyond(middle) {
            beyond = middle;
        } else {
            below = middle;
        }
    }
    (below, beyond)
}

fn moves_from<S: Scene>(
    configuration: &S::Configuration,
    speed: f32,
    regime: impl Fn(&mut FrictionModel<S>, f32) -> Regime,
) {
    let mut model = FrictionModel::<S>::new(configuration).unwrap();
    for (speed, expected) in [
        (speed, Regime::Driving),
        (speed.next_down(), Regime::Standing),
        (-speed.next_down(), Regime::Standing),
    ] {
        assert_eq!(regime(&mut model, speed), expected, "{speed}");
    }
}

/// Standing is slower than the reversal speed; at it, the mechanism moves. In all scenes, both ways.
#[test]
fn at_the_reversal_speed_a_mechanism_moves() {
    let caged = gears::caged();
    moves_from::<gears::CagedScrew>(&caged, caged.reversal_speed, |model, speed| {
        model.step(screw_inputs(speed, 1000.0)).regime
    });
    let uncaged = gears::uncaged();
    let speed = uncaged.folded.reversal_speed;
    moves_from::<Uncaged>(&uncaged, speed, |model, speed| {
        model.step(screw_inputs(speed, 1000.0)).regime
    });
    let linear = gears::linear();
    moves_from::<Linear>(&linear, linear.reversal_speed, |model, speed| {
        model.step(linear_inputs(speed, 1000.0, 0.0)).regime
    });
}

#[test]
fn without_a_load_a_screw_drives() {
    let mut model = FrictionModel::<gears::CagedScrew>::new(&gears::caged()).unwrap();
    for nut_speed in [50.0, -50.0] {
        let outputs = model.step(screw_inputs(nut_speed, 0.0));
        assert_eq!((outputs.regime, outputs.efficiency), (Regime::Driving, 0.0));
        assert!(outputs.friction_torque * nut_speed > 0.0);
    }
}

/// A load that turns the nut backwards does so as long as the efficiency is positive, to the last number of the rolling resistance.
#[test]
fn back_driving_ends_where_the_efficiency_does() {
    let mut parameters = CATALOGUE[0].parameters();
    parameters.lead = 0.1e-3;
    let design = BallScrew::new(parameters).unwrap();
    let lowered = |rolling_tangent| {
        let configuration = ClosedFormScrewConfiguration {
            design,
            rolling_tangent,
            clearance: Clearance::ZERO,
            ..gears::closed_form(FrictionBranch::Rolling)
        };
        closed_form(&configuration).step(screw_inputs(-50.0, 1000.0))
    };
    let (turns, holds) = border(1e-6, 0.1, |tangent| {
        lowered(tangent).regime == Regime::Locked
    });
    let (turned, held) = (lowered(turns), lowered(holds));
    assert!(turned.regime == Regime::BackDriving && turned.efficiency > 0.0);
    // The regime is that of the full friction; the output is less by the passage through standstill, w_s^2 / 2 w^2.
    assert!(held.efficiency < 1e-3);
    assert!(
        turned.efficiency - held.efficiency < 3.6e-7,
        "{turned:?} {held:?}"
    );
}

#[test]
fn a_drive_locks_at_a_thousand_pitch_radii() {
    let mut parameters = CATALOGUE[30].parameters();
    parameters.contact_angle = 20_f32.to_radians();
    parameters.lead = std::f32::consts::TAU * parameters.pitch_radius * 60_f32.to_radians().tan();
    let design = BallScrew::new(parameters).unwrap();
    let (geometry, radius) = (EfficiencyGeometry::of(&design), design.pitch_radius());
    let torque =
        |friction| geometry.sliding_torque_per_load(Drive::Driving, radius, friction) / radius;
    let stepped = |friction, nut_speed, axial_load| {
        let configuration = ClosedFormScrewConfiguration {
            design,
            friction,
            ..gears::closed_form(FrictionBranch::Sliding)
        };
        closed_form(&configuration).step(screw_inputs(nut_speed, axial_load))
    };
    let driven = |friction| stepped(friction, 50.0, 1000.0);
    let (moves, locked) = border(1e-3, 0.5, |friction| {
        driven(friction).regime == Regime::Locked
    });
    assert!((0.0..1e3).contains(&torque(moves)), "{}", torque(moves));
    assert!(!(0.0..1e3).contains(&torque(locked)), "{}", torque(locked));
    assert!(driven(locked).faults.contains(Faults::FRICTION_LIMIT));
    for nut_speed in [50.0, -50.0] {
        assert_eq!(stepped(locked, nut_speed, 0.0).regime, Regime::Driving);
    }
}

/// A ball screw without cage is locked where friction takes more than the load gives.
#[test]
fn an_uncaged_screw_is_locked_by_its_own_friction() {
    let configuration = gears::uncaged();
    let mut model = FrictionModel::<Uncaged>::new(&configuration).unwrap();
    for step in 0..400_u16 {
        let axial_load = -2.0 * f32::from(step);
        let outputs = model.step(screw_inputs(20.0, axial_load));
        let sustains = outputs.friction_torque.abs() < -outputs.load_torque;
        let expected = if outputs.load_torque >= 0.0 {
            Regime::Driving
        } else if sustains {
            Regime::BackDriving
        } else {
            Regime::Locked
        };
        assert_eq!(outputs.regime, expected, "{axial_load} N: {outputs:?}");
    }
}

#[test]
fn every_scene_counts_its_faults() {
    let mut screw = FrictionModel::<Uncaged>::new(&gears::uncaged()).unwrap();
    let mut bearing = FrictionModel::<Linear>::new(&gears::linear()).unwrap();
    for tick in 1..=3 {
        let _ = screw.step(screw_inputs(f32::NAN, 1.0));
        let _ = bearing.step(linear_inputs(0.1, f32::NAN, 1.0));
        assert_eq!(
            (screw.faulted_ticks(), bearing.faulted_ticks()),
            (tick, tick)
        );
    }
    let _ = screw.step(screw_inputs(1.0, 1.0));
    let _ = bearing.step(linear_inputs(0.1, 1.0, 0.0));
    assert_eq!((screw.faulted_ticks(), bearing.faulted_ticks()), (0, 0));
    let mut faults = Faults::LOAD_RANGE;
    faults |= Faults::LOAD_RANGE;
    assert_eq!(faults, Faults::LOAD_RANGE);
}

#[test]
fn a_speed_deviation_of_one_counts() {
    let ball = AnalyticLinearBall::new(
        &LinearBallParameters {
            ball_radius: 0.005,
            contact_angle: std::f32::consts::FRAC_PI_4,
            axis_ratio: 0.25,
            semi_major_coefficient: 1e-4,
            friction: 0.1,
        },
        PUBLISHED_SLOPE,
    )
    .unwrap();
    let deviation = |turn: f32| {
        let angles = [-turn, 0.0, 0.0, 0.0];
        ball.speed_deviation(&angles, &[50.0, 0.0, 50.0, 0.0])
            .speed_deviation
    };
    let (counts, does_not) = border(1.0, 4.0, |turn| deviation(turn) == 0.0);
    assert!(deviation(counts) <= 1.0 && deviation(counts) > 1.0 - 1e-6);
    assert_eq!(deviation(does_not), 0.0);
}
