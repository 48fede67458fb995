use epas_design::caged::Block;
use epas_design::{CagedDesign, CagedFold};
use epas_friction::scene::CagedBallScrew;
use epas_friction::{Faults, FrictionModel, Inputs, Limits, RollingResistance};
use epas_reference::promises;

use super::*;

/// The dissertation's smallest screw: 29 x 7 x 4.
const SCREW: Design = Design {
    pitch_radius: 14.5e-3,
    lead: 7e-3,
    ball_radius: 2e-3,
    conformity: 0.54,
    contact_angle: core::f32::consts::FRAC_PI_4,
    preload: 0.0,
};

/// The caged scene's friction torque and efficiency.
fn scene(design: &Design, duty: &Duty) -> (f32, f32) {
    let screw = screw(design).unwrap();
    let fold = CagedFold::of(CagedDesign {
        design: screw,
        friction: duty.friction,
        rolling_resistance: RollingResistance::NONE,
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
    let wrong: [(Design, Duty, &str); 6] = [
        (
            Design {
                lead: f32::NAN,
                ..SCREW
            },
            Duty::DEFAULT,
            "lead",
        ),
        (
            Design {
                conformity: 0.4,
                ..SCREW
            },
            Duty::DEFAULT,
            "conformity",
        ),
        (
            Design {
                preload: -1.0,
                ..SCREW
            },
            Duty::DEFAULT,
            "contact_force",
        ),
        (
            SCREW,
            Duty {
                axial_load: 0.0,
                ..Duty::DEFAULT
            },
            "axial_load",
        ),
        (
            SCREW,
            Duty {
                turns: f32::INFINITY,
                ..Duty::DEFAULT
            },
            "turns",
        ),
        (
            SCREW,
            Duty {
                friction: f32::NAN,
                ..Duty::DEFAULT
            },
            "friction",
        ),
    ];
    for (design, duty, field) in wrong {
        assert_eq!(figures(&design, &duty).unwrap_err().field(), field);
    }
}
