//! Laws that hold for every mechanism, on random ones.

use epas_friction::{
    Clearance, ClosedFormScrew, ClosedFormScrewConfiguration, DeviationMap, FrictionModel, Inputs,
    LinearBearingConfiguration, LinearBearingTrain, LinearLimits, LoadShares, Regime,
    UncagedBallScrew, UncagedBallScrewConfiguration,
};
use epas_testkit::gears::{SCREW_BALLS, UncagedScrew, changed, even};
use epas_testkit::gears::{linear_inputs, screw_inputs};
use epas_testkit::random::Random;
use epas_testkit::random_scenes::{Trial, accepted};
use proptest::prelude::*;

fn closed_form(seed: u64) -> FrictionModel<ClosedFormScrew> {
    closed_form_configuration(seed).1
}

fn closed_form_configuration(
    seed: u64,
) -> (ClosedFormScrewConfiguration, FrictionModel<ClosedFormScrew>) {
    let mut random = Random(seed);
    loop {
        let (configuration, ..) = accepted::<ClosedFormScrew>(&mut random);
        let mut configuration = ClosedFormScrewConfiguration {
            clearance: Clearance::ZERO,
            ..configuration
        };
        configuration.limits.nut_speed = 1e3;
        configuration.limits.axial_load = 1e6;
        configuration.limits.friction_torque = 1e6;
        // From 500 rad/s on the blend is one.
        configuration.reversal_speed = configuration.reversal_speed.min(1e-2);
        if let Ok(model) = FrictionModel::new(&configuration) {
            return (configuration, model);
        }
    }
}

fn uncaged(seed: u64, ball_friction: f32) -> FrictionModel<UncagedBallScrew<7>> {
    static NONE: DeviationMap = DeviationMap::NONE;
    let mut random = Random(seed);
    // Each try leaves a folded ball for as long as the program runs.
    for _ in 0..1_000 {
        let (configuration, ..) = accepted::<UncagedBallScrew<7>>(&mut random);
        let configuration = UncagedBallScrewConfiguration {
            folded: changed(configuration.folded, |folded| {
                folded.limits.friction_torque = 1e6;
            }),
            ball_friction,
            screw_deviation: &NONE,
            nut_deviation: &NONE,
            load_shares: LoadShares::EVEN,
            ..configuration
        };
        if let Ok(model) = FrictionModel::new(&configuration) {
            return model;
        }
    }
    panic!("no screw without cage of a thousand has a model");
}

fn linear(seed: u64, ball_friction: f32) -> (FrictionModel<LinearBearingTrain<5>>, LinearLimits) {
    static NONE: DeviationMap = DeviationMap::NONE;
    let mut random = Random(seed);
    loop {
        let (configuration, ..) = accepted::<LinearBearingTrain<5>>(&mut random);
        let mut configuration = LinearBearingConfiguration {
            ball_friction,
            rail_deviation: &NONE,
            carriage_deviation: &NONE,
            ..configuration
        };
        configuration.limits.friction_force = 1e6;
        if let Ok(model) = FrictionModel::new(&configuration) {
            return (model, configuration.limits);
        }
    }
}

fn inputs(nut_speed: f32, axial_load: f32) -> Inputs {
    screw_inputs(nut_speed, axial_load)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn friction_reverses_with_speed_and_load(seed: u64, speed in -1e3_f32..1e3, load in -1e6_f32..1e6) {
        let mut model = closed_form(seed);
        let (there, back) = (model.step(inputs(speed, load)), model.step(inputs(-speed, -load)));
        prop_assert_eq!(there.friction_torque, -back.friction_torque);
        prop_assert_eq!(there.load_torque, -back.load_torque);

        let mut model = uncaged(seed, 0.1);
        let there = model.step(inputs(0.01 * speed, 0.01 * load));
        model.reset();
        let back = model.step(inputs(-0.01 * speed, -0.01 * load));
        prop_assert_eq!(there.friction_torque, -back.friction_torque);
    }

    #[test]
    fn friction_grows_with_load(seed: u64, speed in -1e3_f32..1e3, load in 0.0_f32..9e5, more in 1.0_f32..2.0) {
        let mut model = closed_form(seed);
        for sign in [1.0, -1.0] {
            let light = model.step(inputs(speed, sign * load));
            let heavy = model.step(inputs(speed, sign * load * more));
            prop_assert!(heavy.friction_torque.abs() >= light.friction_torque.abs());
        }
        // A gear that a host has folded, within its loads: random numbers need not grow.
        let closed = UncagedBallScrewConfiguration { return_length: 0.0, ..even() };
        let mut model = FrictionModel::<UncagedScrew<SCREW_BALLS>>::new(&closed).unwrap();
        for sign in [1.0, -1.0] {
            let light = model.step(inputs(0.01 * speed, 5e-3 * sign * load));
            let heavy = model.step(inputs(0.01 * speed, 5e-3 * sign * load * more));
            prop_assert!(heavy.friction_torque.abs() >= light.friction_torque.abs());
        }
    }

    #[test]
    fn work_in_is_work_out_and_loss(seed: u64, speed in 5e2_f32..1e3, load in 1.0_f32..1e6) {
        let mut model = closed_form(seed);
        let driving = model.step(inputs(speed, load));
        if driving.regime == Regime::Driving && !driving.faults.any() && driving.load_torque > 0.0 {
            let (load, loss) = (f64::from(driving.load_torque), f64::from(driving.friction_torque));
            // Some thirty roundings of 2^-24: near its lock a screw magnifies those of the loss.
            prop_assert!((f64::from(driving.efficiency) * (load + loss) - load).abs() <= 2e-6 * (load + loss));
        }
        let back = model.step(inputs(speed, -load));
        if back.regime == Regime::BackDriving && !back.faults.any() {
            let (load, loss) = (-f64::from(back.load_torque), f64::from(back.friction_torque));
            prop_assert!((f64::from(back.efficiency) * load - (load - loss)).abs() <= 2e-6 * load);
        }
    }

    #[test]
    fn a_linear_bearing_reverses_and_grows_with_load(
        seed: u64, speed in -1.0_f32..1.0, normal in 0.0_f32..0.5, side in -1.0_f32..1.0, more in 1.0_f32..2.0,
    ) {
        let (mut model, limits) = linear(seed, 0.3);
        let inputs = |speed: f32, more: f32, side: f32| linear_inputs(speed * limits.speed, more * normal * limits.load, more * side * normal * limits.load);
        let there = model.step(inputs(speed, 1.0, side));
        model.reset();
        let back = model.step(inputs(-speed, 1.0, side));
        prop_assert_eq!(there.friction_force, -back.friction_force);
        model.reset();
        let mirrored = model.step(inputs(speed, 1.0, -side));
        // Three roundings of 2^-24: sums in another order.
        prop_assert!((there.friction_force - mirrored.friction_force).abs() <= 2e-7 * there.friction_force.abs());
        model.reset();
        let heavy = model.step(inputs(speed, more, side));
        prop_assert!(heavy.friction_force.abs() >= there.friction_force.abs() * (1.0 - 1e-5));
        // Of balls alike none presses; what there is comes from the grooves.
        prop_assert_eq!((there.contacts, there.ball_force), (0, 0.0));
        prop_assert!(there.faults.any() || there.friction_force == there.groove_force);
    }

    #[test]
    fn no_size_of_a_screw_is_special(
        seed: u64, speed in -1e3_f32..1e3, load in -1e3_f32..1e3, power in -1_i32..2,
    ) {
        // Eight times the length: under the same load torques of a folded ball grow as its lengths do, to the bit.
        let scale = 8.0_f32.powi(power);
        let mut random = Random(seed);
        let (configuration, ..) = accepted::<UncagedBallScrew<7>>(&mut random);
        let of_size = |scale: f32| {
            let folded = changed(configuration.folded, |folded| {
                folded.limits.axial_load = 1e6;
                folded.limits.friction_torque = 1e6;
                for length in [
                    &mut folded.lead, &mut folded.ball_radius, &mut folded.path_radius, &mut folded.speed,
                ] {
                    *length *= scale;
                }
                for knot in folded.law.nodes.iter_mut().flat_map(|node| node.branches.as_flattened_mut()) {
                    let numbers = &mut knot.numbers;
                    numbers.torque = numbers.torque.map(|arm| arm * scale);
                    numbers.slope *= scale;
                }
                for knot in folded.law.nodes.iter_mut().flat_map(|node| node.neighbours.as_flattened_mut()) {
                    let numbers = &mut knot.numbers;
                    for node in &mut numbers.nodes {
                        node.torque = node.torque.map(|arm| arm * scale);
                    }
                    numbers.outward_torque *= scale;
                }
            });
            FrictionModel::<UncagedBallScrew<7>>::new(&UncagedBallScrewConfiguration {
                folded,
                return_length: configuration.return_length * scale,
                ..configuration
            })
        };
        if let (Ok(mut small), Ok(mut large)) = (of_size(1.0), of_size(scale)) {
            let nut_speed = 1e-3 * speed * configuration.folded.limits.nut_speed;
            for _ in 0..20 {
                let (one, other) = [&mut small, &mut large].map(|model| model.step(inputs(nut_speed, load))).into();
                prop_assert_eq!(one.groove_torque * scale, other.groove_torque);
                prop_assert_eq!(one.ball_torque * scale, other.ball_torque);
                prop_assert_eq!(one.largest_contact_force, other.largest_contact_force);
            }
        }
    }

    #[test]
    fn scenes_reduce_to_simpler_ones(seed: u64, speed in -10.0_f32..10.0, load in -1e4_f32..1e4) {
        // Without friction between balls nothing is lost there.
        let outputs = uncaged(seed, 0.0).step(inputs(speed, load));
        prop_assert_eq!(outputs.ball_torque, 0.0);
        // Balls that are alike do not press on each other, with as much friction between them as every ball of the lot takes.
        let outputs = uncaged(seed, 0.1).step(inputs(speed, load));
        prop_assert_eq!(outputs.contacts, 0);
        prop_assert!(outputs.faults.any() || outputs.friction_torque == outputs.groove_torque);
        let mut random = Random(seed);
        let (configuration, mut model, _) = accepted::<UncagedBallScrew<1>>(&mut random);
        let limits = configuration.folded.limits;
        let sensors = [
            speed.clamp(-limits.nut_speed, limits.nut_speed),
            load.clamp(-limits.axial_load, limits.axial_load),
            0.0,
        ];
        let outputs = model.step(UncagedBallScrew::<1>::inputs(sensors));
        prop_assert_eq!((outputs.contacts, outputs.ball_torque), (0, 0.0));
        let (_, mut model, _) = accepted::<LinearBearingTrain<1>>(&mut random);
        let outputs = model.step(LinearBearingTrain::<1>::inputs([1e-7, 1.0, 0.0]));
        prop_assert_eq!((outputs.contacts, outputs.ball_force), (0, 0.0));
    }
}
