//! Constants that are swapped while a model runs: friction is then that of a model which has had them from the first tick, and
//! what does not fit is refused.

use epas_friction::law::coefficient::{OneCoefficient, TemperatureFade};
use epas_friction::law::motion::WrappedAngle;
use epas_friction::law::motion::{CountSensor, Deadband};
use epas_friction::scene::{
    CagedBallScrew, CagedBallScrewConfiguration, Freshness, WithMemory, WithMemoryConfiguration,
};
use epas_friction::{
    ClosedFormScrew, FrictionBranch, FrictionModel, Inputs, LinearBearingConfiguration,
    LinearBearingTrain,
};
use epas_testkit::gears::{linear_inputs, screw_inputs};

use crate::remembering::{Slip, TEMPERATURE, at, caged_by_angle, counter, slip, with_memory};
use epas_testkit::gears::{
    CagedConfiguration, CagedScrew, LINEAR_BALLS, caged, closed_form, linear,
    linear_of_smaller_balls, preloaded, worn,
};

type Caged = FrictionModel<CagedScrew>;
type Linear = FrictionModel<LinearBearingTrain<LINEAR_BALLS>>;

const INPUTS: Inputs = screw_inputs(5.0, 3000.0);

/// Constants count from the next step on, to the bit as in a model that has had them always: friction coefficient, limits, clearance.
#[test]
fn a_caged_screw_is_that_of_its_new_constants() {
    let mut limits = caged().limits;
    limits.friction_torque = 0.1;
    for other in [
        CagedConfiguration {
            friction: 0.12,
            ..caged()
        },
        CagedConfiguration { limits, ..caged() },
    ] {
        let mut model = Caged::new(&caged()).unwrap();
        model.set_friction(0.09).unwrap();
        let before = model.step(INPUTS).friction_torque;
        let mut fresh = Caged::new(&other).unwrap();
        let old = model.swap_constants(*fresh.constants()).unwrap();
        assert_eq!(old, *Caged::new(&caged()).unwrap().constants());
        let (found, expected) = (model.step(INPUTS), fresh.step(INPUTS));
        assert_eq!(found, expected);
        assert!((before / expected.friction_torque - 1.0).abs() > 0.05);
        assert_eq!(model.state(), fresh.state());
    }
}

/// Where a play becomes narrower, and a counter shorter, nothing turns.
#[test]
fn a_swap_turns_nothing() {
    type Counted = FrictionModel<WithMemory<CagedScrew, Slip, Deadband<CountSensor>>>;
    let with = |period: u32, half_width: f32, play: f32| {
        let sensor = Deadband::new(counter(period, 1e-3, 0.4), half_width).unwrap();
        let whole = with_memory(caged(), slip(0.05), sensor);
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

#[test]
fn a_closed_form_is_swapped_for_another_one() {
    let of = |branch| FrictionModel::<ClosedFormScrew>::new(&closed_form(branch)).unwrap();
    let (mut model, mut other) = (of(FrictionBranch::Rolling), of(FrictionBranch::Sliding));
    let before = model.step(INPUTS);
    model.swap_constants(*other.constants()).unwrap();
    assert_eq!(model.step(INPUTS), other.step(INPUTS));
    assert_ne!(model.step(INPUTS), before);
}

#[test]
fn a_bearing_takes_the_friction_of_its_new_constants() {
    let inputs = linear_inputs(0.5, 2000.0, 300.0);
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

/// Another clearance under a memory is another block: the memory stays, and friction of sliding is that of the new screw.
#[test]
fn a_clearance_is_swapped_under_a_memory() {
    type Scene = WithMemory<CagedBallScrew, Slip, WrappedAngle, OneCoefficient>;
    let angle = caged_by_angle().angle;
    let coefficient = OneCoefficient::new(worn().friction).unwrap();
    let of = |scene: CagedBallScrewConfiguration| {
        let configuration = WithMemoryConfiguration {
            scene,
            elements: slip(0.05),
            angle,
            reference_load: 1000.0,
            play: 2e-3,
            coefficient,
            temperature: TemperatureFade::DEFAULT,
            freshness: Freshness::DEFAULT,
        };
        FrictionModel::<Scene>::new(&configuration).unwrap()
    };
    let slides = |model: &mut FrictionModel<Scene>, from: u16| {
        let mut torque = 0.0;
        for tick in from..from + 1000 {
            let angle = (5e-4 * f32::from(tick)).rem_euclid(std::f32::consts::TAU);
            torque = model.step(at(INPUTS, angle, TEMPERATURE)).friction_torque;
        }
        torque
    };
    let (mut model, mut fresh) = (of(preloaded()), of(worn()));
    let (before, expected) = (slides(&mut model, 0), slides(&mut fresh, 0));
    assert!(
        (before / expected - 1.0).abs() > 0.05,
        "{before} {expected}"
    );
    let remembered = model.state().remembered.elements;
    model.swap_constants(*fresh.constants()).unwrap();
    assert_eq!(model.state().remembered.elements, remembered);
    assert_eq!(slides(&mut model, 1000), slides(&mut fresh, 1000));
}
