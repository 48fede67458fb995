//! A level in a model whose friction remembers: limits are scaled, stiffness is not.

use epas_testkit::gears::screw_inputs;
use std::f32::consts::TAU;

use epas_friction::adaptation::Estimates;
use epas_friction::law::FrictionLevel;
use epas_friction::law::coefficient::OneCoefficient;
use epas_friction::law::memory::ProportionalElements;
use epas_friction::law::motion::SpeedOverTick;
use epas_friction::scene::{Sliding, WithMemory, WithMemoryConfiguration};
use epas_friction::{FrictionModel, Inputs, Outputs};

use crate::remembering::{at, slip};
use epas_testkit::gears::{CagedScrew, SCREW_BALLS, UncagedScrew, caged, uncaged};

const TICK: f32 = 1e-4;

type Model<S> =
    FrictionModel<WithMemory<S, ProportionalElements<8>, SpeedOverTick, OneCoefficient>>;

fn model<S>(scene: S::Configuration) -> Model<S>
where
    S: Sliding<Constants: Copy, Configuration: Copy>,
{
    let elements = slip(0.05);
    let sensor = SpeedOverTick::new(TICK, 1.0).unwrap();
    let configuration = WithMemoryConfiguration::new(scene, 0.1, elements, sensor, 1000.0).unwrap();
    FrictionModel::new(&configuration).unwrap()
}

fn step<S>(model: &mut Model<S>, nut_speed: f32) -> Outputs
where
    S: Sliding<Constants: Copy, Inputs = Inputs, Outputs: Into<Outputs>>,
{
    let scene = screw_inputs(nut_speed, 1000.0);
    let inputs = at(scene, nut_speed, 313.0);
    model.step(inputs).into()
}

const LEVEL: FrictionLevel = FrictionLevel {
    forward: 1.5,
    backward: 0.7,
};

fn levels_scale_sliding<S>(scene: S::Configuration)
where
    S: Sliding<Constants: Copy, Configuration: Copy, Inputs = Inputs, Outputs: Into<Outputs>>,
{
    let (mut plain, mut scaled, mut one) =
        (model::<S>(scene), model::<S>(scene), model::<S>(scene));
    one.set_level(FrictionLevel::ONE).unwrap();
    scaled.set_level(LEVEL).unwrap();
    let mut sliding = 0;
    for tick in 0..4000 {
        let speed = 8.0 * (TAU * tick as f32 / 1000.0).sin();
        let (plain, scaled) = (step(&mut plain, speed), step(&mut scaled, speed));
        assert_eq!(step(&mut one, speed), plain);
        if tick > 100 && (100..400).contains(&(tick % 500)) {
            let level = LEVEL.of(plain.friction_torque);
            let wanted = level * plain.friction_torque;
            assert!(
                (scaled.friction_torque / wanted - 1.0).abs() < 1.2e-7,
                "{tick}"
            );
            assert_eq!(scaled.regime, plain.regime);
            sliding += 1;
        }
    }
    assert!(sliding > 2000);
    scaled.reset();
    plain.reset();
    for _ in 0..100 {
        assert_eq!(step(&mut scaled, 3.0), step(&mut plain, 3.0));
    }
}

#[test]
fn a_level_scales_sliding_friction_in_its_direction() {
    levels_scale_sliding::<CagedScrew>(caged());
    levels_scale_sliding::<UncagedScrew<SCREW_BALLS>>(uncaged());
}

/// A turn back by a tenth of the breakaway angle slides no element: friction falls by stiffness times turn, whatever the level. A level that
/// changes at rest and is not below what the elements hold changes nothing.
#[test]
fn stiffness_stays() {
    let fall = |level: FrictionLevel| {
        let mut model = model::<CagedScrew>(caged());
        model.set_level(level).unwrap();
        for _ in 0..200 {
            step(&mut model, 8.0);
        }
        let before = step(&mut model, 8.0).friction_torque;
        // 0.1 mrad in a tick.
        before - step(&mut model, -1.0).friction_torque
    };
    let (plain, scaled) = (fall(FrictionLevel::ONE), fall(LEVEL));
    // The torque itself, half as large again, is rounded. Measured: 4.1e-6 of a fall of 3.7e-3 N m.
    assert!((scaled / plain - 1.0).abs() < 1.2e-5, "{scaled} {plain}");
    let mut model = model::<CagedScrew>(caged());
    step(&mut model, 0.0);
    let held = step(&mut model, 1.0).friction_torque;
    assert!(held > 0.0);
    for forward in [1.0, 1.7, 10.0] {
        model
            .set_level(FrictionLevel {
                forward,
                backward: 1.0,
            })
            .unwrap();
        let still = step(&mut model, 0.0).friction_torque;
        assert!((still / held - 1.0).abs() < 1.2e-7, "{still} {held}");
    }
}

/// Estimates as a torque, of a model without memory: the level of the direction times the model's friction, and the drag. All numbers
/// are exact in f32.
#[test]
fn estimates_scale_a_friction_and_add_the_drag() {
    let estimates = Estimates {
        forward: 1.5,
        backward: 0.75,
        drag: 0.015625,
        offset: 0.25,
        load_error: 0.0625,
    };
    assert_eq!(estimates.friction(0.5, 8.0), 0.75 + 0.125);
    assert_eq!(estimates.friction(-0.5, -8.0), -0.375 - 0.125);
}

#[test]
fn levels_out_of_range_are_refused() {
    let mut model = model::<CagedScrew>(caged());
    let before = model;
    for wrong in [0.09, 10.1, f32::NAN, f32::INFINITY] {
        let forward = FrictionLevel {
            forward: wrong,
            backward: 1.0,
        };
        let backward = FrictionLevel {
            forward: 1.0,
            backward: wrong,
        };
        assert_eq!(model.set_level(forward).unwrap_err().field(), "forward");
        assert_eq!(model.set_level(backward).unwrap_err().field(), "backward");
    }
    assert_eq!(model, before);
}

/// Cold grease at speed: drag is a third of friction and more. A level of 1.3 is found to the same 1 % with and without, where it was set before and
/// where it never is.
#[test]
fn lubricant_drag_is_not_scaled() {
    use epas_friction::adaptation::{Adaptation, AdaptationConfiguration, AdaptationInputs};
    use epas_friction::{Faults, Regime};

    for lubricant_drag in [0.0, 0.02, 0.08] {
        for level in [1.0, 1.3] {
            let level = FrictionLevel {
                forward: level,
                backward: level,
            };
            let mut adaptation = Adaptation::new(&AdaptationConfiguration::every(0.01)).unwrap();
            for tick in 0..4000 {
                let way = if tick / 100 % 2 == 0 { 1.0 } else { -1.0 };
                adaptation.update(&AdaptationInputs {
                    observed: way * (1.3 * 0.04 + lubricant_drag),
                    modelled: way * (level.forward * 0.04 + lubricant_drag),
                    lubricant_drag: way * lubricant_drag,
                    level,
                    nut_speed: 8.0 * way,
                    load_torque: 0.0,
                    regime: Regime::Driving,
                    faults: Faults::NONE,
                    saturated: false,
                });
            }
            let Estimates {
                forward, backward, ..
            } = adaptation.estimates();
            for found in [forward, backward] {
                assert!(
                    (found - 1.3).abs() < 0.013,
                    "{lubricant_drag} {level:?}: {found}"
                );
            }
        }
    }
}
