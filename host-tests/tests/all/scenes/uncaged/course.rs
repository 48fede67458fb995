//! A screw without cage beside the exact ring in time, from the same start: not at the same state, but over the same course. And with a
//! memory, which in steady sliding has the friction of the scene.

use epas_friction::law::coefficient::{
    CoefficientLaw, CoefficientParameters, OneCoefficient, RollingDrag, Viscosity,
};
use epas_friction::{Clearance, Inputs, UncagedBallScrew};
use epas_reference::friction::ball_screw_ring::{RingState, steady_samples};
use epas_reference::promises;
use epas_testkit::gears::screw_inputs;

use super::exact::{BALLS, Beside, PLAIN, TICK, screw};
use crate::remembering::TEMPERATURE;
use crate::scenes::step_promises::{BETWEEN, remembering, sound};
use epas_testkit::errors::Errors;

const SPEED: f32 = 20.0;
const TICKS: usize = 80;

fn inputs() -> Inputs {
    screw_inputs(SPEED, -110.0 * BALLS as f32)
}

/// The exact ring from the start on, by so many steps a tick: a state for each tick.
fn exact(beside: &Beside<1>, steps: usize) -> Vec<RingState> {
    let Inputs {
        nut_speed,
        axial_load,
    } = inputs();
    let turn = f64::from(nut_speed * TICK) * TICKS as f64;
    let samples = steady_samples(nut_speed.into(), axial_load.into(), turn, steps * TICKS);
    let states = beside.started().simulate(&samples, |_, _| ()).unwrap();
    states.into_iter().step_by(steps).collect()
}

/// Over a course of 1.6 rad from the start, in ticks of 0.02 rad. The reference changes by little where its step is halved: what is left of the
/// difference is the crate's, whose balls meet at the end of a tick and not within it.
#[test]
fn a_course_from_the_start_regression() {
    let mut beside = Beside::new(screw(&PLAIN, 0.1), Clearance::ZERO);
    let (coarse, fine) = (exact(&beside, 1), exact(&beside, 2));
    let mut converged = Errors::of("ring in time, half the step");
    let mut found = Errors::of("screw without cage in time");
    let mean = fine.iter().map(RingState::torque).sum::<f64>() / fine.len() as f64;
    let mut pressing = 0;
    for (tick, (coarse, fine)) in coarse.iter().zip(&fine).enumerate() {
        assert!(coarse.solved() && fine.solved());
        let line = || format!("tick {tick}");
        converged.add_case((coarse.torque() - fine.torque()) / mean, line);
        let torque = f64::from(beside.model.step(inputs()).friction_torque);
        found.add_case((torque - fine.torque()) / mean, line);
        pressing += usize::from(fine.pressing() > 0);
    }
    assert!(pressing > TICKS / 2, "{pressing}");
    converged.assert_measured();
    found.assert_measured();
}

/// A law that gives a friction coefficient at a speed: a fifth more at standstill, a fifth less far beyond.
fn law_through(friction: f32, speed: f32) -> CoefficientLaw {
    CoefficientLaw::new(&CoefficientParameters {
        boundary: 1.2 * friction,
        full_film: 0.8 * friction,
        half_share_speed: speed,
        reference_temperature: TEMPERATURE,
        viscosity: Viscosity::through((313.15, 0.1), (373.15, 0.01), 233.15).unwrap(),
        forward: 1.0,
        backward: 1.0,
        churning: 0.0,
        drag: RollingDrag::NONE,
    })
    .unwrap()
}

/// With a memory, by one coefficient and by a law, in steps and between two: from the second tick on, in which its elements slide fully, but for
/// ticks in which balls meet.
#[test]
fn memory_in_steady_sliding_regression() {
    type Scene = UncagedBallScrew<BALLS>;
    let configuration = screw(&PLAIN, 0.1);
    let mut beside = Beside::new(configuration, Clearance::ZERO);
    let friction = configuration.folded.friction;
    // The breakaway angle under 1 N m, rad, and the time of a tick, s.
    let scale = (6e-5, TICK);
    let one = OneCoefficient::new(friction).unwrap();
    let mut remembers = remembering::<Scene, _>(configuration, one, scale);
    let law = law_through(friction, SPEED);
    let mut by_law = remembering::<Scene, _>(configuration, law, scale);
    let (mut steps, mut between) = (Errors::default(), Errors::default());
    let known = sound(inputs(), SPEED);
    for tick in 0..TICKS {
        let pair = beside.step(inputs());
        let exact = pair.exact.torque();
        let torques = [
            remembers.step(known).friction_torque,
            by_law.step(known).friction_torque,
        ];
        let asked = [
            remembers.between(BETWEEN * SPEED).friction_torque,
            by_law.between(BETWEEN * SPEED).friction_torque,
        ];
        for (errors, torques) in [(&mut steps, torques), (&mut between, asked)] {
            for torque in torques.into_iter().filter(|_| tick > 0 && !pair.meeting) {
                errors.add_case(f64::from(torque) / exact - 1.0, || format!("tick {tick}"));
            }
        }
    }
    steps.assert_promised(promises::of("step_uncaged_memory"));
    between.assert_promised(promises::of("between_uncaged"));
}
