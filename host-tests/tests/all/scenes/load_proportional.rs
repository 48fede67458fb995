//! A drive without a drawing in the loop: four quadrants, energy, continuity, symmetry, bad input.

use crate::refusals::assert_refused;
use epas_friction::{
    Faults, FrictionModel, Limits, LoadProportionalConfiguration, LoadProportionalConstants,
    LoadProportionalScrew, Outputs, Regime,
};
use epas_testkit::gears::screw_inputs;
use proptest::prelude::*;

const DRIVE: LoadProportionalConfiguration = LoadProportionalConfiguration {
    load_lever: 0.004,
    coulomb_friction: 0.05,
    viscous_friction: 1e-3,
    driving_loss: 0.10,
    back_driving_loss: 0.13,
    reversal_speed: 0.05,
    limits: Limits {
        nut_speed: 500.0,
        axial_load: 20_000.0,
        friction_torque: 50.0,
    },
};

fn step(configuration: &LoadProportionalConfiguration, nut_speed: f32, axial_load: f32) -> Outputs {
    let mut model = FrictionModel::<LoadProportionalScrew>::new(configuration).unwrap();
    model.step(screw_inputs(nut_speed, axial_load))
}

/// `T = T_C + eta |tau| + b |w|` against the motion; the efficiency is work out over work in.
#[test]
fn each_direction_of_power_has_its_loss() {
    let close = |found: f32, expected: f32| (found / expected - 1.0).abs() < 5e-6;
    for sign in [1.0, -1.0] {
        let driving = step(&DRIVE, sign * 20.0, sign * 500.0);
        let loss = 0.05 + 0.10 * 2.0 + 0.02;
        assert!(close(driving.friction_torque, sign * loss), "{driving:?}");
        assert!(close(driving.load_torque, sign * 2.0), "{driving:?}");
        assert!(close(driving.efficiency, 2.0 / (2.0 + loss)), "{driving:?}");
        assert_eq!(driving.regime, Regime::Driving);
        let driven = step(&DRIVE, sign * 20.0, -sign * 500.0);
        let loss = 0.05 + 0.13 * 2.0 + 0.02;
        assert!(close(driven.friction_torque, sign * loss), "{driven:?}");
        assert!(close(driven.efficiency, 1.0 - 0.5 * loss), "{driven:?}");
        assert_eq!(driven.regime, Regime::BackDriving);
    }
    let worm = LoadProportionalConfiguration {
        back_driving_loss: 1.2,
        ..DRIVE
    };
    assert_eq!(step(&worm, 20.0, -500.0).regime, Regime::Locked);
    assert_eq!(step(&worm, 0.01, 500.0).regime, Regime::Standing);
}

proptest! {
    /// Friction takes power, changes by little where the speed does, and is odd under reversal of speed and load together.
    #[test]
    fn friction_never_drives_and_never_jumps(
        losses in prop::array::uniform2(0.0..1.5_f32),
        speed in -300.0..300.0_f32,
        slow in -0.2..0.2_f32,
        load in -15_000.0..15_000.0_f32,
    ) {
        let drive = LoadProportionalConfiguration {
            driving_loss: losses[0],
            back_driving_loss: losses[1],
            limits: Limits { friction_torque: 500.0, ..DRIVE.limits },
            ..DRIVE
        };
        for speed in [speed, slow] {
            let found = step(&drive, speed, load);
            prop_assert!(found.friction_torque * speed >= 0.0);
            prop_assert_eq!(step(&drive, -speed, -load).friction_torque, -found.friction_torque);
            prop_assert_eq!(found.faults, Faults::NONE);
        }
        let near = step(&drive, slow + 1e-4, load).friction_torque - step(&drive, slow, load).friction_torque;
        // Slope of the passage at most 1/w_s, of at most 0.05 + 1.5 x 60 N m, and some roundings of it.
        prop_assert!(near.abs() < (1e-4 / 0.05) * 90.05 * 1.01 + 1e-4, "{}", near);
    }
}

#[test]
fn a_field_out_of_range_and_a_bad_input_are_named() {
    #[rustfmt::skip]
    assert_refused(
        &DRIVE,
        LoadProportionalConstants::new,
        &[
            ("load_lever", |drive, v| drive.load_lever = v, &[0.0]),
            ("coulomb_friction", |drive, v| drive.coulomb_friction = v, &[-1e-3]),
            ("viscous_friction", |drive, v| drive.viscous_friction = v, &[]),
            ("driving_loss", |drive, v| drive.driving_loss = v, &[-0.01]),
            ("back_driving_loss", |drive, v| drive.back_driving_loss = v, &[11.0]),
            ("reversal_speed", |drive, v| drive.reversal_speed = v, &[0.0]),
        ],
    );
    let beyond = step(&DRIVE, 20.0, 30_000.0);
    assert_eq!(beyond.faults, Faults::LOAD_RANGE);
    assert_eq!(beyond.load_torque, 0.004 * 20_000.0);
    let none = step(&DRIVE, f32::NAN, 500.0);
    assert_eq!(none.friction_torque, 0.0);
    assert_eq!(none.faults, Faults::SPEED_NOT_FINITE);
    let lossy = LoadProportionalConfiguration {
        driving_loss: 5.0,
        ..DRIVE
    };
    let cut = step(&lossy, 20.0, 15_000.0);
    assert_eq!(
        (cut.friction_torque, cut.faults),
        (50.0, Faults::FRICTION_LIMIT)
    );
}
