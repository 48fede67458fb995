//! The ball screw by a closed form in the loop: energy, signs, continuity, bad input.

use super::preloaded::exact_sum;
use crate::refusals::assert_refused;
use epas_friction::efficiency::EfficiencyGeometry;
use epas_friction::{
    BallScrew, CATALOGUE, Clearance, ClosedFormScrew, ClosedFormScrewConfiguration,
    DISSERTATION_DESIGNS, Faults, FrictionBranch, FrictionModel, Limits, Outputs, Regime,
};
use epas_testkit::gears::{self, LIMITS, oversize, screw_inputs};
use epas_testkit::measured;
use proptest::prelude::*;

fn configuration() -> ClosedFormScrewConfiguration {
    ClosedFormScrewConfiguration {
        design: BallScrew::new(DISSERTATION_DESIGNS[2].parameters).unwrap(),
        clearance: Clearance::ZERO,
        loaded_balls: 71,
        reversal_speed: 0.2,
        limits: Limits {
            friction_torque: 50.0,
            ..LIMITS
        },
        ..gears::closed_form(FrictionBranch::Rolling)
    }
}

fn model(configuration: &ClosedFormScrewConfiguration) -> FrictionModel<ClosedFormScrew> {
    FrictionModel::new(configuration).unwrap()
}

fn step(model: &mut FrictionModel<ClosedFormScrew>, nut_speed: f32, axial_load: f32) -> Outputs {
    model.step(screw_inputs(nut_speed, axial_load))
}

prop_compose! {
    fn situation()(
        size in 0..31_usize,
        friction in 0.0..0.3_f32,
        rolling_tangent in prop_oneof![Just(0.0_f32), 0.0..0.01_f32],
        sliding in any::<bool>(),
        preload in prop_oneof![Just(0.0_f32), 1.0..2000.0_f32],
        speed in -300.0..300.0_f32,
        load in -15_000.0..15_000.0_f32,
    ) -> (ClosedFormScrewConfiguration, f32, f32) {
        let branch = if sliding { FrictionBranch::Sliding } else { FrictionBranch::Rolling };
        let design = CATALOGUE[size].design().unwrap();
        let clearance = if preload > 0.0 { oversize(&design, preload, 71) } else { Clearance::ZERO };
        let configuration = ClosedFormScrewConfiguration {
            design, friction, rolling_tangent, branch, clearance,
            ..configuration()
        };
        (configuration, speed, load)
    }
}

proptest! {

    #[test]
    fn continuous_through_zero_speed((configuration, _, load) in situation()) {
        // A torque limit would cut the full torque, but not the slope at standstill.
        let limits = Limits { friction_torque: 1e6, ..configuration.limits };
        let mut model = model(&ClosedFormScrewConfiguration { limits, ..configuration });
        let full = step(&mut model, 300.0, load).friction_torque.abs()
            .max(step(&mut model, -300.0, load).friction_torque.abs());
        let mut last = step(&mut model, -2.0, load).friction_torque;
        for tick in -199..=200_i16 {
            let torque = step(&mut model, f32::from(tick) * 0.01, load).friction_torque;
            // Derived: the torque is `s (A + s B)` with |B| <= A. Its slope, (A + 2 s B) (1 - s²)^(3/2) over the width, is
            // nowhere more than A + |B|, the full torque, over the width; a step is 0.05 of the width. Measured: 0.04993.
            prop_assert!((torque - last).abs() <= 0.0501 * full + 1e-6);
            last = torque;
        }
        prop_assert_eq!(step(&mut model, 0.0, load).friction_torque, 0.0);
    }
}

#[test]
fn a_locked_drive_is_said_and_bounded() {
    // Contact angle 20 degrees, lead angle 60: f R = 0.99 > Sb = 0.34 at f = 0.5.
    let mut parameters = CATALOGUE[30].parameters();
    parameters.contact_angle = 20f32.to_radians();
    parameters.lead = std::f32::consts::TAU * parameters.pitch_radius * 60f32.to_radians().tan();
    let design = BallScrew::new(parameters).unwrap();
    assert!(EfficiencyGeometry::of(&design).locks(epas_friction::efficiency::Drive::Driving, 0.5));
    let mut model = model(&ClosedFormScrewConfiguration {
        design,
        friction: 0.5,
        branch: FrictionBranch::Sliding,
        ..configuration()
    });
    let driven = step(&mut model, 100.0, 1000.0);
    assert_eq!(driven.regime, Regime::Locked);
    assert!(driven.faults.contains(Faults::FRICTION_LIMIT));
    measured::assert(
        "locked drive, friction torque in N m",
        driven.friction_torque - 50.0,
    );
    let load_torque = driven.load_torque;
    assert_eq!(
        driven.efficiency,
        load_torque / (load_torque + driven.friction_torque)
    );
    let lowered = step(&mut model, -100.0, 1000.0);
    assert!(lowered.friction_torque < 0.0 && !lowered.faults.any());
    let still = step(&mut model, 0.0, 1000.0);
    assert!(still.friction_torque == 0.0 && !still.faults.any());
}

/// Two Hertzian flanks: the polynomial sum against the solution of their equations, to 0.8 %.
#[test]
fn preload_is_that_of_two_hertzian_flanks() {
    let preload = 500.0_f32;
    let clearance = oversize(&configuration().design, preload, 71);
    let mut model = model(&ClosedFormScrewConfiguration {
        clearance,
        branch: FrictionBranch::Rolling,
        ..configuration()
    });
    // Torque per load from the two directions beyond lift-off.
    let drive = step(&mut model, 400.0, 10_000.0).friction_torque / 10_000.0;
    let backdrive = step(&mut model, 400.0, -10_000.0).friction_torque / 10_000.0;
    let mut worst = 0.0_f64;
    for tenth in 0..=40 {
        let load = 0.1 * f64::from(tenth) * f64::from(preload);
        // `F1 = F + F2`, and both over twice the preload are the sum.
        let low = f64::from(preload) * exact_sum(load, preload.into()) - 0.5 * load;
        let expected = f64::from(drive) * (load + low) + f64::from(backdrive) * low;
        let computed = f64::from(step(&mut model, 400.0, load as f32).friction_torque);
        worst = worst.max((computed / expected - 1.0).abs());
    }
    measured::assert_at("preload of two flanks", worst, format_args!("{worst:e}"));
}

#[test]
fn every_field_of_the_configuration_is_checked() {
    const BAD: &[f32] = &[-1.0, 1e30];
    #[rustfmt::skip]
    assert_refused(
        &configuration(),
        FrictionModel::<ClosedFormScrew>::new,
        &[
            ("friction", |c, v| c.friction = v, BAD),
            ("rolling_tangent", |c, v| c.rolling_tangent = v, BAD),
            ("reversal_speed", |c, v| c.reversal_speed = v, &[-1.0, 1e30, 0.0, 1e-30]),
            ("nut_speed", |c, v| c.limits.nut_speed = v, BAD),
            ("axial_load", |c, v| c.limits.axial_load = v, BAD),
            ("friction_torque", |c, v| c.limits.friction_torque = v, BAD),
        ],
    );
}
