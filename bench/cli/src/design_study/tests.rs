use epas_design::caged::Block;
use epas_design::{CagedDesign, CagedFold};
use epas_friction::scene::CagedBallScrew;
use epas_friction::{Faults, FrictionModel, Inputs, Limits, RollingResistance as Rolling};
use epas_reference::friction::ball_screw_row::{ElasticRow, RowBall};
use epas_reference::promises;

use super::*;

const SCREW: Design = Design {
    pitch_radius: 14.5e-3,
    lead: 7e-3,
    ball_radius: 2e-3,
    conformity: 0.54,
    contact_angle: core::f32::consts::FRAC_PI_4,
    preload: 0.0,
};

fn scene(design: &Design, duty: &Duty) -> (f32, f32) {
    let screw = screw(design).unwrap();
    let fold = CagedFold::of(CagedDesign {
        design: screw,
        friction: duty.friction,
        rolling_resistance: Rolling::NONE,
        clearance: clearance(&screw, design.preload).unwrap(),
        loaded_balls: duty.loaded_balls(&screw),
        reversal_speed: 1e-6,
        limits: Limits {
            nut_speed: 100.0,
            axial_load: 2e4,
            friction_torque: 100.0,
        },
    });
    let Block::One(block) = fold.block().unwrap() else {
        panic!("one friction coefficient is one node");
    };
    let mut model = FrictionModel::<CagedBallScrew>::new(&block).unwrap();
    let inputs = Inputs {
        nut_speed: 6.0,
        axial_load: duty.axial_load,
    };
    let found = model.step(inputs);
    assert!(found.faults == Faults::NONE);
    (found.friction_torque, found.efficiency)
}

/// A study has the exact balls that the caged scene is folded from, with and without preload: they differ by the error of the fold, of which
/// `step_caged` promises the largest, and the efficiency by no more than that part of the friction's share.
#[test]
fn a_study_has_the_friction_of_the_caged_scene() {
    for (preload, lead) in [(0.0, 7e-3), (30.0, 7e-3), (0.0, 20e-3), (100.0, 10e-3)] {
        let design = Design {
            lead,
            preload,
            ..SCREW
        };
        let found = figures(&design, &Duty::DEFAULT).unwrap();
        let (torque, efficiency) = scene(&design, &Duty::DEFAULT);
        println!(
            "{:e} {:e}",
            found.friction_torque / torque - 1.0,
            found.efficiency - efficiency
        );
        let error = promises::of("step_caged").largest as f32;
        assert!(
            (found.friction_torque / torque - 1.0).abs() < error,
            "{found:?} {torque}"
        );
        assert!(
            (found.efficiency - efficiency).abs() < error * (1.0 - efficiency),
            "{found:?} {efficiency}"
        );
    }
}

/// The force in a row of two balls by the reference, all of the friction between them included.
fn force_in_a_row(design: &Design, duty: &Duty) -> f64 {
    let screw = screw(design).unwrap();
    let axial_load = f64::from(duty.axial_load) / f64::from(duty.loaded_balls(&screw));
    let ball = |nut_deviation| RowBall {
        screw_deviation: 0.0,
        nut_deviation,
        axial_load,
    };
    let force = |balls: [RowBall; 2]| {
        let row = ElasticRow {
            design: drawing(screw.parameters()),
            clearance: clearance(&screw, design.preload).unwrap().gap().into(),
            friction: duty.friction.into(),
            ball_friction: duty.ball_friction.into(),
            nut_speed: 1.0,
            balls: balls.into(),
            chord: true,
            integration: Integration::Full,
        };
        row.solve().unwrap().contact_forces[0]
    };
    let mut largest = 0.0;
    for way in [1.0, -1.0] {
        let (off, nominal) = (ball(way * f64::from(duty.deviation)), ball(0.0));
        largest = f64::max(largest, force([off, nominal]));
        largest = f64::max(largest, force([nominal, off]));
    }
    largest
}

/// Without friction between balls a study has the force of a row, to the 1e-4 at which it ends and the 1e-5 of a contact's friction limit that
/// 32 nodes leave. With friction the law of one ball takes a neighbour's motion for the ball's own. Measured: 4.1e-4, a tenth of what friction
/// between balls does to the force; half as much again is accepted.
#[test]
fn balls_press_as_in_a_row() {
    let designs = [(0.0, 7e-3), (30.0, 7e-3), (0.0, 20e-3), (100.0, 10e-3)];
    let mut forces = Vec::new();
    for (preload, lead) in designs {
        let design = Design {
            lead,
            preload,
            ..SCREW
        };
        for (ball_friction, allowed) in [(0.0, 2e-4), (0.1, 6e-4)] {
            let duty = Duty {
                ball_friction,
                ..Duty::DEFAULT
            };
            let found = f64::from(figures(&design, &duty).unwrap().contact_force);
            let expected = force_in_a_row(&design, &duty);
            println!(
                "{preload} {lead} {ball_friction}: {found} {:e}",
                found / expected - 1.0
            );
            assert!(
                (found / expected - 1.0).abs() < allowed,
                "{design:?} {ball_friction}: {found} {expected}"
            );
            forces.push(found);
        }
    }
    assert!((forces[0] / forces[1] - 1.0).abs() > 1e-3, "{forces:?}");
}

/// Neighbours without a deviation run at one speed, and press on nothing.
#[test]
fn balls_of_a_screw_without_deviation_do_not_press() {
    let duty = Duty {
        deviation: 0.0,
        ..Duty::DEFAULT
    };
    let found = figures(&SCREW, &duty).unwrap();
    assert!(found.contact_force.abs() < 1e-6, "{found:?}");
    assert!(figures(&SCREW, &Duty::DEFAULT).unwrap().contact_force > 0.1);
}

#[test]
fn any_partition_has_the_same_answers_to_the_bit() {
    let designs: Vec<_> = (0..24)
        .map(|index| Design {
            lead: 5e-3 + 1e-3 * index as f32,
            preload: (index % 3) as f32 * 20.0,
            ..SCREW
        })
        .collect();
    let whole = format!("{:?}", columns(&designs, &Duty::DEFAULT));
    for size in [1, 5, 23] {
        let parts: Vec<_> = designs
            .chunks(size)
            .flat_map(|part| columns(part, &Duty::DEFAULT))
            .collect();
        assert_eq!(format!("{parts:?}"), whole, "{size}");
    }
}

#[test]
fn what_is_out_of_range_is_named() {
    type Change = fn(&mut Design, &mut Duty);
    let wrong: [(Change, &str); 6] = [
        (|design, _| design.lead = f32::NAN, "lead"),
        (|design, _| design.conformity = 0.4, "conformity"),
        (|design, _| design.preload = -1.0, "contact_force"),
        (|_, duty| duty.axial_load = 0.0, "axial_load"),
        (|_, duty| duty.turns = f32::INFINITY, "turns"),
        (|_, duty| duty.friction = f32::NAN, "friction"),
    ];
    for (change, field) in wrong {
        let (mut design, mut duty) = (SCREW, Duty::DEFAULT);
        change(&mut design, &mut duty);
        assert_eq!(figures(&design, &duty).unwrap_err().field(), field);
    }
}
