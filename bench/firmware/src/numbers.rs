//! What functions and models give, as numbers: to be stored, compared and digested.

use epas_friction::adaptation::Adapted;
use epas_friction::ball::ScrewTickBall;
use epas_friction::kinematics::{BallKinematics, ContactSlip};
use epas_friction::{Faults, LinearOutputs, Outputs, Regime, UncagedOutputs};

/// Slip of a contact.
fn slip(slip: &ContactSlip) -> [f32; 4] {
    [
        slip.rolling_slip,
        slip.side_slip,
        slip.spin,
        slip.entrainment_speed,
    ]
}

/// Motion of a ball and slip of its contacts.
pub fn motion(ball: &BallKinematics) -> [f32; 10] {
    let [a, b, c, d] = slip(&ball.screw);
    let [e, f, g, h] = slip(&ball.nut);
    [ball.orbital_speed, ball.spin_speed, a, b, c, d, e, f, g, h]
}

/// Regime and flags as one number.
fn condition(regime: Regime, faults: Faults) -> f32 {
    let regime = match regime {
        Regime::Standing => 0,
        Regime::Driving => 1,
        Regime::BackDriving => 2,
        Regime::Locked => 3,
    };
    f32::from(regime + 4 * faults.bits())
}

/// What an adaptation gives, as numbers.
pub fn adapted(adapted: &Adapted) -> [f32; 8] {
    let Adapted {
        estimates,
        flags,
        health,
    } = adapted;
    [
        estimates.forward,
        estimates.backward,
        estimates.drag,
        estimates.offset,
        estimates.load_error,
        f32::from(flags.bits()),
        health.drift,
        f32::from(u8::from(health.fallen) + 2 * u8::from(health.risen)),
    ]
}

/// Outputs of a caged ball screw, as numbers.
pub fn outputs(outputs: &Outputs) -> [f32; 4] {
    [
        outputs.friction_torque,
        outputs.load_torque,
        outputs.efficiency,
        condition(outputs.regime, outputs.faults),
    ]
}

/// Outputs of a ball screw without cage, as numbers.
pub fn uncaged_outputs(outputs: &UncagedOutputs) -> [f32; 7] {
    [
        outputs.friction_torque,
        outputs.groove_torque,
        outputs.ball_torque,
        outputs.load_torque,
        f32::from(outputs.contacts),
        outputs.largest_contact_force,
        condition(outputs.regime, outputs.faults),
    ]
}

/// Outputs of a linear bearing, as numbers.
pub fn linear_outputs(outputs: &LinearOutputs) -> [f32; 7] {
    [
        outputs.friction_force,
        outputs.groove_force,
        outputs.ball_force,
        0.0,
        f32::from(outputs.contacts),
        outputs.largest_contact_force,
        condition(outputs.regime, outputs.faults),
    ]
}

/// A ball of a ball screw, and one number more.
pub fn screw_ball(ball: &ScrewTickBall, more: f32) -> [f32; 5] {
    [
        ball.speed_deviation,
        ball.compliance,
        ball.groove_torque,
        ball.rubbing,
        more,
    ]
}

/// One number for each ball.
pub fn all<const N: usize>(values: impl Iterator<Item = f32>) -> [f32; N] {
    let mut all = [0.0; N];
    for (place, value) in all.iter_mut().zip(values) {
        *place = value;
    }
    all
}

/// A pair.
pub fn two((first, second): (f32, f32)) -> [f32; 2] {
    [first, second]
}
