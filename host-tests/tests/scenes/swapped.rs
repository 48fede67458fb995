//! Constants that are swapped while a model runs: friction is then that of a model which has had them from the first tick, and
//! what does not fit is refused.

use epas_friction::law::motion::{CountSensor, CountSensorParameters, Steady};
use epas_friction::scene::{WithMemory, WithMemoryConfiguration};
use epas_friction::{
    CagedBallScrew, CagedBallScrewConfiguration, Clearance, Faults, FrictionBranch, FrictionModel,
    Inputs, LinearBearingConfiguration, LinearBearingTrain, LinearInputs,
};

use crate::kit::gears::{LINEAR_BALLS, caged, linear, linear_of_smaller_balls};
use crate::kit::remembering::{
    CagedByAngle, Slip, TEMPERATURE, at, caged_by_angle, slip, with_memory,
};

type Caged = FrictionModel<CagedBallScrew>;
type Linear = FrictionModel<LinearBearingTrain<LINEAR_BALLS>>;

const INPUTS: Inputs = Inputs {
    nut_speed: 5.0,
    axial_load: 3000.0,
};

/// Friction torque once it no longer changes.
fn settled(model: &mut Caged) -> f32 {
    for _ in 0..400 {
        model.step(INPUTS);
    }
    model.step(INPUTS).friction_torque
}

/// Balls of other constants are renewed in every tick, those of a fresh model follow their law, which is within 2.5e-4 of them.
#[test]
fn a_caged_screw_takes_friction_and_clearance_of_its_new_constants() {
    for other in [
        CagedBallScrewConfiguration {
            friction: 0.12,
            ..caged()
        },
        CagedBallScrewConfiguration {
            clearance: Clearance::new(2e-6).unwrap(),
            ..caged()
        },
    ] {
        let mut model = Caged::new(&caged()).unwrap();
        let before = settled(&mut model);
        let mut fresh = Caged::new(&other).unwrap();
        let old = model.swap_constants(*fresh.constants()).unwrap();
        assert_eq!(old, *Caged::new(&caged()).unwrap().constants());
        let (found, expected) = (settled(&mut model), settled(&mut fresh));
        assert!(
            (before / expected - 1.0).abs() > 0.05,
            "{before} {expected}"
        );
        assert!(
            (found / expected - 1.0).abs() < 2.5e-4,
            "{found} {expected}"
        );
    }
}

/// The law over the load is that of the first constants: neither a reset nor a block of a model that follows its law brings it back.
#[test]
fn no_law_of_other_constants_comes_back() {
    let other = CagedBallScrewConfiguration {
        friction: 0.12,
        ..caged()
    };
    let mut fresh = Caged::new(&other).unwrap();
    let mut block = [0; Caged::STATE_BYTES];
    fresh.export(&mut block).unwrap();
    let expected = settled(&mut fresh);
    for back in [
        |model: &mut Caged, _: &[u8]| model.reset(),
        |model: &mut Caged, block: &[u8]| model.import(block).unwrap(),
    ] {
        let mut model = Caged::new(&caged()).unwrap();
        settled(&mut model);
        model.swap_constants(*fresh.constants()).unwrap();
        settled(&mut model);
        back(&mut model, &block);
        assert!(model.step(INPUTS).faults.contains(Faults::SETTLING));
        let found = settled(&mut model);
        // As above.
        assert!(
            (found / expected - 1.0).abs() < 2.5e-4,
            "{found} {expected}"
        );
    }
}

/// Where a play becomes narrower, and a counter shorter, nothing turns.
#[test]
fn a_swap_turns_nothing() {
    type Counted = FrictionModel<WithMemory<CagedBallScrew, Slip, Steady<CountSensor>>>;
    let with = |period: u32, half_width: f32, play: f32| {
        let counts = CountSensor::new(CountSensorParameters {
            period,
            turn_per_count: 1e-3,
            largest_turn: 0.4,
        })
        .unwrap();
        let sensor = Steady::new(counts, half_width).unwrap();
        // Its friction is the same before and after.
        let scene = CagedBallScrewConfiguration {
            branch: FrictionBranch::Rolling,
            ..caged()
        };
        let whole = with_memory(scene, slip(0.05), sensor);
        Counted::new(&WithMemoryConfiguration { play, ..whole }).unwrap()
    };
    for (period, half_width, play) in [
        (16_384, 1e-3, 2e-3),
        (1000, 5e-3, 2e-3),
        (16_384, 5e-3, 1e-4),
    ] {
        let mut model = with(16_384, 5e-3, 2e-3);
        let mut count = 2000;
        for _ in 0..100 {
            count += 1;
            model.step(at(INPUTS, count, TEMPERATURE));
        }
        let before = model.state().remembered.elements;
        let other = with(period, half_width, play);
        model.swap_constants(*other.constants()).unwrap();
        for _ in 0..3 {
            let outputs = model.step(at(INPUTS, count % period, TEMPERATURE));
            assert!(!outputs.faults.faulty(), "{:?}", outputs.faults);
        }
        assert_eq!(model.state().remembered.elements, before);
    }
}

/// A closed form has no state: it is the other one at once. Contacts do not become a closed form, nor the other way.
#[test]
fn a_closed_form_is_swapped_for_another_one_alone() {
    let of = |branch, friction| {
        Caged::new(&CagedBallScrewConfiguration {
            branch,
            friction,
            ..caged()
        })
        .unwrap()
    };
    let mut model = of(FrictionBranch::Rolling, 0.075);
    let mut other = of(FrictionBranch::Sliding, 0.12);
    model.step(INPUTS);
    model.swap_constants(*other.constants()).unwrap();
    assert_eq!(model.step(INPUTS), other.step(INPUTS));
    let mut contacts = of(FrictionBranch::Contacts, 0.075);
    let before = (*contacts.state(), *contacts.constants());
    let refused = contacts.swap_constants(*other.constants()).unwrap_err();
    assert_eq!(refused.field(), "branch");
    assert_eq!((*contacts.state(), *contacts.constants()), before);
    let refused = other.swap_constants(*contacts.constants()).unwrap_err();
    assert_eq!(refused.field(), "branch");
}

/// Balls of a bearing go on from their places; the friction that was set before counts no more.
#[test]
fn a_bearing_takes_the_friction_of_its_new_constants() {
    let inputs = LinearInputs {
        speed: 0.5,
        normal_load: 2000.0,
        side_load: 300.0,
    };
    let other = LinearBearingConfiguration {
        friction: 0.15,
        ..linear()
    };
    let mut model = Linear::new(&linear()).unwrap();
    let mut fresh = Linear::new(&other).unwrap();
    for _ in 0..100 {
        model.step(inputs);
        fresh.step(inputs);
    }
    model.set_friction(0.06).unwrap();
    model.swap_constants(*fresh.constants()).unwrap();
    let [found, expected] = [&mut model, &mut fresh].map(|model| model.step(inputs).groove_force);
    assert_eq!(found, expected);
    let smaller = Linear::new(&linear_of_smaller_balls()).unwrap();
    assert_eq!(
        model
            .swap_constants(*smaller.constants())
            .unwrap_err()
            .field(),
        "pitch"
    );
}

/// A clearance set under a memory is the scene's: friction of sliding is that of a screw that has it from the first tick.
#[test]
fn a_clearance_is_set_under_a_memory() {
    let clearance = Clearance::new(2e-6).unwrap();
    let whole = caged_by_angle();
    let other = WithMemoryConfiguration {
        scene: CagedBallScrewConfiguration {
            clearance,
            ..whole.scene
        },
        ..whole
    };
    let slides = |model: &mut FrictionModel<CagedByAngle>| {
        let mut torque = 0.0;
        for tick in 0..2000_u16 {
            let angle = (5e-4 * f32::from(tick)).rem_euclid(std::f32::consts::TAU);
            torque = model.step(at(INPUTS, angle, TEMPERATURE)).friction_torque;
        }
        torque
    };
    let mut model = FrictionModel::new(&whole).unwrap();
    let mut fresh = FrictionModel::new(&other).unwrap();
    let before = slides(&mut model);
    model.set_clearance(clearance).unwrap();
    let (found, expected) = (slides(&mut model), slides(&mut fresh));
    assert!(
        (before / expected - 1.0).abs() > 0.05,
        "{before} {expected}"
    );
    // Balls against their law between three coefficients. Measured: 1.2 %.
    assert!((found / expected - 1.0).abs() < 0.02, "{found} {expected}");
}
