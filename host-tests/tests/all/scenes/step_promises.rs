//! What a step promises, and what it calls: measured against the float64 reference.

use super::stiff::exact_row;
use crate::remembering::{Slip, at, slip_by};
use epas_testkit::errors::Errors;
use epas_testkit::gears::{LIMITS, closed_form, linear, linear_inputs, screw_inputs};
use epas_testkit::random::Random;
use std::f64::consts::{FRAC_PI_4, TAU};

use epas_friction::ball::{AnalyticLinearBall, LinearBallParameters, PUBLISHED_SLOPE};
use epas_friction::law::coefficient::{OneCoefficient, TemperatureFade};
use epas_friction::law::motion::SpeedOverTick;
use epas_friction::scene::{
    CoefficientFor, Freshness, Sliding, WithMemory, WithMemoryConfiguration, WithMemoryInputs,
};
use epas_friction::train::Train;
use epas_friction::{
    BallScrew, CATALOGUE, Clearance, ClosedFormScrew, ClosedFormScrewConfiguration,
    DISSERTATION_DESIGNS, DeviationMap, FrictionBranch, FrictionModel, Limits,
    LinearBearingConfiguration, LinearBearingTrain, LinearLimits, LoadProportionalConfiguration,
    LoadProportionalScrew,
};
use epas_reference::efficiency::Screw;
use epas_reference::friction::chain::solve_chain;
use epas_reference::friction::linear_ball::{EllipseLaw, LinearBall, contact_forces};
use epas_reference::hertz::{Hertz, contact_modulus};
use epas_reference::promises;

/// Torque of both closed forms in all four quadrants by the reference's efficiencies, with the direction that
/// the scene takes near a reversal.
#[test]
fn closed_form_step() {
    let mut errors = Errors::of("step by closed forms");
    let designs = DISSERTATION_DESIGNS.map(|design| design.parameters);
    let sizes = CATALOGUE.map(|size| size.parameters());
    for parameters in designs.into_iter().chain(sizes) {
        for branch in [FrictionBranch::Rolling, FrictionBranch::Sliding] {
            let mut model = FrictionModel::<ClosedFormScrew>::new(&ClosedFormScrewConfiguration {
                design: BallScrew::new(parameters).unwrap(),
                clearance: Clearance::ZERO,
                loaded_balls: 40,
                limits: Limits {
                    friction_torque: 1e3,
                    ..LIMITS
                },
                ..closed_form(branch)
            })
            .unwrap();
            let arm = f64::from(parameters.lead) / TAU;
            let pitch_radius = f64::from(parameters.pitch_radius);
            let screw = Screw {
                lead_angle: (arm / pitch_radius).atan(),
                contact_angle: parameters.contact_angle.into(),
                friction: f64::from(0.075_f32),
                ball_ratio: f64::from(parameters.ball_radius) / pitch_radius,
                rolling_tangent: 0.0,
            };
            let (drive, backdrive) = match branch {
                FrictionBranch::Rolling => (screw.rolling_screw(), screw.rolling_backdrive()),
                FrictionBranch::Sliding => (screw.sliding_drive(), screw.sliding_backdrive()),
            };
            // Torque per load in both directions of power.
            let (drive, backdrive) = (arm * (1.0 / drive - 1.0), arm * (1.0 - backdrive));
            for speed in [-200.0_f32, -3.0, -0.3, 0.3, 3.0, 200.0] {
                for load in [-15_000.0_f32, -900.0, -1.0, 1.0, 900.0, 15_000.0] {
                    let (w, force) = (f64::from(speed), f64::from(load));
                    let direction = w / (w * w + 0.25).sqrt();
                    let (sum, blended) = (force.abs(), direction * force);
                    let exact =
                        0.5 * direction * (drive * (sum + blended) + backdrive * (sum - blended));
                    let found = model.step(screw_inputs(speed, load));
                    errors.add_case(f64::from(found.friction_torque) / exact - 1.0, || {
                        format!("{parameters:?} {branch:?} {speed} {load}")
                    });
                }
            }
        }
    }
    // A dozen roundings of 2^-24, which add up at random.
    errors.assert_promised(promises::of("step_closed_form"));
}

/// The formula in float64, over losses, friction, speeds and loads of all signs.
#[test]
fn load_proportional() {
    let mut errors = Errors::of("step of a drive without a drawing");
    let lever = 0.02 / std::f32::consts::TAU;
    for [driving_loss, back_driving_loss] in [[0.1_f32, 0.13], [0.0, 0.5], [0.37, 0.0]] {
        for [coulomb_friction, viscous_friction] in [[0.0_f32, 0.0], [0.05, 1e-3], [1.0, 1e-2]] {
            let mut model =
                FrictionModel::<LoadProportionalScrew>::new(&LoadProportionalConfiguration {
                    load_lever: lever,
                    coulomb_friction,
                    viscous_friction,
                    driving_loss,
                    back_driving_loss,
                    reversal_speed: 0.5,
                    limits: Limits {
                        nut_speed: 500.0,
                        axial_load: 20_000.0,
                        friction_torque: 50.0,
                    },
                })
                .unwrap();
            for speed in [-200.0_f32, -3.0, -0.3, 0.3, 3.0, 200.0] {
                for load in [-15_000.0_f32, -900.0, -1.0, 0.0, 1.0, 900.0, 15_000.0] {
                    let (w, torque) = (f64::from(speed), f64::from(lever) * f64::from(load));
                    let loss = f64::from(if w * torque < 0.0 {
                        back_driving_loss
                    } else {
                        driving_loss
                    });
                    let exact = w / w.hypot(0.5)
                        * (f64::from(coulomb_friction) + loss * torque.abs())
                        + f64::from(viscous_friction) * w;
                    let found = model.step(screw_inputs(speed, load));
                    let found = f64::from(found.friction_torque);
                    let error = if exact == 0.0 {
                        found
                    } else {
                        found / exact - 1.0
                    };
                    errors.add_case(error, || {
                        format!("{driving_loss} {coulomb_friction} {speed} {load}")
                    });
                }
            }
        }
    }
    // Seven roundings of 2^-24, which add up at random.
    errors.assert_promised(promises::of("step_load_proportional"));
}

/// A scene with a memory whose elements slide fully within a tick of the motions here, and whose balls follow every turn: in steady
/// motion its friction is that of the scene. The breakaway angle, rad (m), is that under 1 N m (1 N).
pub type Remembering<S, L> = FrictionModel<WithMemory<S, Slip, SpeedOverTick, L>>;

pub fn remembering<S: Sliding<Constants: Copy>, L: CoefficientFor<S::Inputs>>(
    scene: S::Configuration,
    coefficient: L,
    (breakaway_angle, tick): (f32, f32),
) -> Remembering<S, L> {
    FrictionModel::new(&WithMemoryConfiguration {
        scene,
        elements: slip_by(1.0, breakaway_angle),
        angle: SpeedOverTick::new(tick, 1.0).unwrap(),
        reference_load: 1000.0,
        play: 0.0,
        coefficient,
        temperature: TemperatureFade::DEFAULT,
        freshness: Freshness::DEFAULT,
    })
    .unwrap()
}

const TEMPERATURE: f32 = 313.15;

pub fn sound<I>(scene: I, reading: f32) -> WithMemoryInputs<I, f32> {
    at(scene, reading, TEMPERATURE)
}

/// Reading between two steps over that of a step: friction is asked for at an angle hardly beyond the step's.
pub const BETWEEN: f32 = 1e-3;

/// Forces of a row of touching balls on a track that is long enough for an open end.
#[test]
fn train() {
    let mut random = Random(1);
    let mut errors = Errors::default();
    for _ in 0..300 {
        let free: [f32; 37] = std::array::from_fn(|_| (0.02 * random.signed()) as f32);
        let impedance: [f32; 37] =
            std::array::from_fn(|_| 10_f64.powf(3.0 * random.signed()) as f32);
        let mut train = Train::<37>::new(1.0, 0.005, &[0.0; 37]).unwrap();
        train.step(&free, &impedance, 1e-6);
        let exact = |numbers: &[f32]| numbers.iter().map(|&x| f64::from(x)).collect::<Vec<_>>();
        let (_, forces) = exact_row(&exact(&free), &exact(&impedance));
        let largest = forces
            .iter()
            .fold(1e-30, |most: f64, force| most.max(*force));
        for (found, exact) in train.forces().zip(&forces) {
            let error = (f64::from(found) - exact) / largest;
            errors.add_case(error, || format!("{free:?} {impedance:?}"));
        }
    }
    errors.assert_promised(promises::of("train"));
}

const BALL_RADIUS: f64 = 0.005;
const CONFORMITY: f64 = 0.56;

fn ellipse() -> EllipseLaw {
    let steel = (206e9, 0.3);
    let across = 1.0 / BALL_RADIUS - 1.0 / (2.0 * CONFORMITY * BALL_RADIUS);
    let hertz = Hertz::new(BALL_RADIUS, 1.0 / across, contact_modulus(steel, steel)).unwrap();
    EllipseLaw {
        semi_major_constant: hertz.semi_major,
        axis_ratio: hertz.axis_ratio,
    }
}

fn ball(turn: f64, side: f64) -> LinearBall {
    let contact_angles = [FRAC_PI_4 - turn, FRAC_PI_4 + turn, FRAC_PI_4, FRAC_PI_4];
    LinearBall {
        ball_radius: BALL_RADIUS,
        friction: 0.1,
        contact_angles,
        contact_forces: contact_forces(contact_angles, 100.0 * side, 100.0),
        ellipse: ellipse(),
    }
}

#[test]
fn pairs_in_a_linear_bearing() {
    let ellipse = ellipse();
    let parameters = LinearBallParameters {
        ball_radius: BALL_RADIUS as f32,
        contact_angle: FRAC_PI_4 as f32,
        axis_ratio: ellipse.axis_ratio as f32,
        semi_major_coefficient: ellipse.semi_major_constant as f32,
        friction: 0.1,
    };
    let analytic = AnalyticLinearBall::new(&parameters, PUBLISHED_SLOPE).unwrap();
    let mut closed = Errors::default();
    for degrees in [-2.0, -1.0, 0.5, 1.0, 2.0_f64] {
        for side in [-0.8, -0.6, -0.3, 0.1, 0.4, 0.7, 0.8] {
            let balls = [-side, side].map(|side| ball(degrees.to_radians(), side));
            let exact = solve_chain(&balls, 0.0, 1.0).unwrap().contact_forces[0];
            if exact == 0.0 {
                continue;
            }
            let given = balls.map(|ball| {
                (
                    ball.contact_angles.map(|angle| angle as f32),
                    ball.contact_forces.map(|force| force as f32),
                )
            });
            let line = || format!("{degrees} {side}: {exact} N");
            let [rear, front] =
                given.map(|(angles, forces)| analytic.speed_deviation(&angles, &forces));
            closed.add_case(f64::from(rear.contact_force(&front)) - exact, line);
        }
    }
    closed.assert_promised(promises::of("analytic_pair"));
}

/// Straight grooves: friction of the grooves is the power that all balls lose over the speed; without memory, with it, and
/// between two steps.
#[test]
fn linear_step() {
    let configuration = LinearBearingConfiguration {
        balls: 24,
        loaded_length: 0.26,
        return_length: 0.0,
        wavelength: 0.1,
        rail_deviation: &DeviationMap::NONE,
        carriage_deviation: &DeviationMap::NONE,
        tick: 1e-3,
        limits: LinearLimits {
            speed: 2.0,
            load: 1e5,
            friction_force: 1e3,
        },
        ..linear()
    };
    let mut model = FrictionModel::<LinearBearingTrain<24>>::new(&configuration).unwrap();
    let one = OneCoefficient::new(0.1).unwrap();
    let mut remembers =
        remembering::<LinearBearingTrain<24>, _>(configuration, one, (1e-6, configuration.tick));
    let mut errors = Errors::default();
    let (mut with_memory, mut between) = (Errors::default(), Errors::default());
    for per_ball in [1.0, 10.0, 100.0, 300.0] {
        for side in [-0.5, -0.3, -0.1, 0.0, 0.2, 0.4, 0.5] {
            for speed in [-1.0, 1.0] {
                let exact = LinearBall {
                    contact_forces: contact_forces([FRAC_PI_4; 4], per_ball * side, per_ball),
                    ..ball(0.0, 0.0)
                }
                .solve(1.0)
                .unwrap()
                .power_loss;
                let inputs = linear_inputs(
                    speed as f32,
                    (24.0 * per_ball) as f32,
                    (24.0 * per_ball * side) as f32,
                );
                let known = sound(inputs, inputs.speed);
                for (found, errors) in [
                    (model.step(inputs), &mut errors),
                    (remembers.step(known), &mut with_memory),
                    (remembers.between(BETWEEN * inputs.speed), &mut between),
                ] {
                    let error = speed * f64::from(found.groove_force) / (24.0 * exact) - 1.0;
                    errors.add_case(error, || format!("{per_ball} {side} {speed}"));
                }
            }
        }
    }
    with_memory.assert_promised(promises::of("step_linear_memory"));
    between.assert_promised(promises::of("between_linear"));
    errors.assert_promised(promises::of("step_linear"));
}
