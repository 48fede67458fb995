//! The load that every scene of a screw tells the elements of its memory, and what both flanks carry by it.

use epas_testkit::gears::screw_inputs;
use std::f32::consts::SQRT_2;

use epas_friction::law::coefficient::DirectionalCoefficient;
use epas_friction::law::memory::PreloadedElements;
use epas_friction::scene::Sliding;
use epas_friction::{
    Clearance, ClosedFormScrew, ClosedFormScrewConfiguration, FrictionBranch, Inputs,
};

use epas_testkit::gears::{
    CAGED_PRELOAD, CagedScrew, SCREW_BALLS, UncagedScrew, caged, changed, closed_form,
    loaded_length, uncaged,
};

const PRELOAD: f32 = 300.0;

/// Sum of both flanks under an axial load, over that without: they share one Hertzian deflection,
/// `F1^(2/3) + F2^(2/3) = 2 P^(2/3)` with `F1 - F2 = F`, until one of them is lost.
pub fn exact_sum(load: f64, preload: f64) -> f64 {
    if load > 8.0_f64.sqrt() * preload {
        return load / (2.0 * preload);
    }
    let deflection = |force: f64| (force / preload).powf(2.0 / 3.0);
    let (mut low, mut high) = (load, load + 2.0 * preload);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if deflection(middle) + deflection(middle - load) < 2.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    (2.0 * low - load) / (2.0 * preload)
}

fn told<S: Sliding<Inputs = Inputs>>(configuration: &S::Configuration, axial_load: f32) -> f32 {
    let constants = S::constants(configuration).unwrap();
    let mut state = S::initial_state(&constants);
    let friction = DirectionalCoefficient {
        forward: 0.075,
        backward: 0.075,
    };
    let inputs = screw_inputs(1.0, axial_load);
    S::by_direction(&S::sliding_friction(
        &constants, &mut state, inputs, friction,
    ))
    .load
}

/// Elements of a preloaded screw know the sum of both flanks, whatever the scene is: within the 0.84 % of its series.
fn flanks_share<S: Sliding<Inputs = Inputs>>(configuration: &S::Configuration, preload: f32) {
    let alone = told::<S>(configuration, 0.0);
    let counted = 2.0 * SQRT_2 * preload;
    assert!((alone / counted - 1.0).abs() < 1e-4, "{alone} {counted}");
    let elements = PreloadedElements::new(());
    for step in 0..60_u8 {
        let load = 0.1 * f32::from(step) * preload;
        for load in [load, -load] {
            let found = f64::from(elements.shared(told::<S>(configuration, load) / alone));
            let exact = exact_sum(load.abs().into(), preload.into());
            assert!(
                (found / exact - 1.0).abs() < 0.0085,
                "{load}: {found} {exact}"
            );
        }
    }
}

#[test]
fn a_caged_screw_tells_what_its_flanks_share() {
    flanks_share::<CagedScrew>(&caged(), CAGED_PRELOAD);
    for branch in [FrictionBranch::Rolling, FrictionBranch::Sliding] {
        flanks_share::<ClosedFormScrew>(&closed_form(branch), PRELOAD);
    }
}

#[test]
fn a_preload_that_is_none_is_none() {
    let closed = closed_form(FrictionBranch::Rolling);
    let least = Clearance::of_preload(&closed.design, 1e-3).unwrap();
    let clearance = Clearance::new(0.5 * least.gap()).unwrap();
    assert_eq!(clearance.preload(&closed.design), 0.0);
    let screw = ClosedFormScrewConfiguration {
        clearance,
        ..closed
    };
    assert_eq!(told::<ClosedFormScrew>(&screw, 0.0), 0.0);
}

/// Each flank of a preloaded ball loses its load where the axial load is `2 sqrt 2` of the preload, which is what the folded ball says.
#[test]
fn a_screw_without_cage_tells_what_its_flanks_share() {
    let mut configuration = uncaged();
    let loaded = loaded_length(&configuration);
    let share = loaded / (loaded + configuration.return_length);
    // As many balls carry the preload as are in the loaded zone in the mean, which is no whole number.
    let balls = share * SCREW_BALLS as f32;
    configuration.folded = changed(configuration.folded, |folded| {
        folded.law.lift_off = 2.0 * SQRT_2 * PRELOAD / balls;
    });
    flanks_share::<UncagedScrew<SCREW_BALLS>>(&configuration, PRELOAD);
}
