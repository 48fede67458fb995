//! Balls in a row in a linear bearing, up to 64 of them: the in-loop steps with the pooling pass against
//! the exact chain, and where the power goes.

use crate::kit::measured;
use crate::kit::random::Random;
use std::f64::consts::FRAC_PI_4;

use epas_friction::ball::LinearBallParameters;
use epas_friction::contact::FrictionMap;
use epas_friction::refined::{BallChain, FourPointBall};
use epas_reference::friction::chain::solve_chain;
use epas_reference::friction::linear_ball::{EllipseLaw, LinearBall, contact_forces};

/// The ball of Lin 2019, Table 3.3.
const BALL_RADIUS: f64 = 0.005;
const FRICTION: f64 = 0.1;
const ELLIPSE: EllipseLaw = EllipseLaw {
    semi_major_constant: 9.075_285e-5,
    axis_ratio: 0.232_146_373,
};

/// Steps that a row takes to settle from the start: friction between balls lags one step behind, and what
/// is left of its error falls by some per cent of itself a step.
const STEPS: usize = 10;

/// Spin below which the steps count a contact as sticking, in units of track speed over ball radius.
const STICK_SPIN: f32 = 0.01;

fn ball() -> FourPointBall {
    FourPointBall::linear(&LinearBallParameters {
        ball_radius: BALL_RADIUS as f32,
        contact_angle: std::f32::consts::FRAC_PI_4,
        axis_ratio: ELLIPSE.axis_ratio as f32,
        semi_major_coefficient: ELLIPSE.semi_major_constant as f32,
        friction: FRICTION as f32,
    })
    .unwrap()
}

/// Balls whose four contact angles deviate by up to 3 degrees each, 100 N across the track and up to 60 N
/// along the other axis.
fn random_row<const N: usize>(random: &mut Random) -> [LinearBall; N] {
    std::array::from_fn(|_| {
        let contact_angles = [0; 4].map(|_| FRAC_PI_4 + 3_f64.to_radians() * random.signed());
        LinearBall {
            ball_radius: BALL_RADIUS,
            friction: FRICTION,
            contact_angles,
            contact_forces: contact_forces(contact_angles, 60.0 * random.signed(), 100.0),
            ellipse: ELLIPSE,
        }
    })
}

struct Settled<const N: usize> {
    chain: BallChain<N>,
    /// Power that goes in over power lost, less one.
    missing: f64,
    /// Power lost as the crate puts it out, over the track speed, N.
    loss: f64,
}

fn settled<const N: usize>(row: &[LinearBall; N], ball_friction: f64) -> Settled<N> {
    let ball = ball();
    let contacts = row.map(|exact| {
        ball.contacts(
            &exact.contact_angles.map(|angle| angle as f32),
            &exact.contact_forces.map(|force| force as f32),
        )
    });
    let mut room = [0.0; N];
    room[N - 1] = f32::INFINITY;
    let mut chain = BallChain::new();
    chain.balls = contacts.map(|contacts| ball.start(&contacts));
    for _ in 0..STEPS {
        assert!(ball.refine_chain(&contacts, &mut chain, &room, 1.0, ball_friction as f32));
    }

    // The moving groove puts power in through the friction of its two contacts, by the steps' own law of
    // friction: what is left over is what the last step leaves out of balance.
    let map = FrictionMap::new(ELLIPSE.axis_ratio as f32).unwrap();
    let (mut input, mut loss) = (0.0, 0.0);
    for ((exact, state), contacts) in row.iter().zip(&chain.balls).zip(&contacts) {
        let motions = ball.contact_motion(contacts, &state.motion);
        let ellipses = motions.iter().zip(contacts.semi_major());
        for (index, ((motion, semi_major), load)) in ellipses.zip(exact.contact_forces).enumerate()
        {
            let friction = map.dissipation(motion.slip, motion.spin, semi_major, STICK_SPIN);
            loss += FRICTION * load * f64::from(friction.power);
            if index >= 2 {
                input -= FRICTION * load * f64::from(friction.force);
            }
        }
    }
    let rubbing = f64::from(ball.ball_friction_force(&chain, ball_friction as f32));
    loss += rubbing;
    let drag: f64 = chain
        .balls
        .iter()
        .map(|state| f64::from(state.friction_force))
        .sum();
    Settled {
        missing: input / loss - 1.0,
        loss: drag + rubbing,
        chain,
    }
}

/// Errors of one row: speed, force, power, loss; an error beyond its bound is named.
///
/// Speeds within 5e-4 of half the track speed and forces within 0.1 N of the exact chain. Power that goes
/// in is lost in the grooves and between the balls, to 1e-4: a slip in f32, 3e-9 of the track speed off,
/// moves the velocity centre by 1e-7 of a semi-axis, and what the last step leaves out of balance is of
/// that order too. The stick treatment makes the loss small by (delta/w)² of the spin's share.
fn errors<const N: usize>(row: &[LinearBall; N], ball_friction: f64) -> Result<[f64; 4], String> {
    const NAMES: [&str; 4] = ["speed", "force", "power", "loss"];
    let exact = solve_chain(row, ball_friction, 1.0).map_err(|error| error.to_string())?;
    let Settled {
        chain,
        missing,
        loss,
    } = settled(row, ball_friction);
    let speeds = chain.balls.iter().zip(&exact.balls);
    let speed = speeds
        .map(|(found, exact)| (f64::from(found.speed_deviation) - exact.speed_deviation).abs());
    let forces = chain.forces.iter().zip(&exact.contact_forces);
    let force = forces.map(|(found, exact)| (f64::from(*found) - exact).abs());
    let errors = [
        speed.fold(0.0, f64::max),
        force.fold(0.0, f64::max),
        missing.abs(),
        (loss / exact.power_loss() - 1.0).abs(),
    ];
    for (error, name) in errors.into_iter().zip(NAMES) {
        let [bound, ..] = measured::of(&format!("rows of balls, {name}")).accepted;
        // False for NaN too.
        if !(error < bound) {
            return Err(format!("{name} off by {error}"));
        }
    }
    Ok(errors)
}

/// Every one of so many random rows, without and with friction between the balls; at most `unsettled` of the latter
/// may miss a bound.
fn check<const N: usize>(rows: usize, unsettled: usize) {
    let mut random = Random(N as u64);
    let mut worst = [0.0_f64; 4];
    let mut missed = Vec::new();
    for trial in 0..rows {
        let row = random_row::<N>(&mut random);
        for ball_friction in [0.0, 0.1] {
            match errors(&row, ball_friction) {
                Ok(errors) => {
                    for (worst, error) in worst.iter_mut().zip(errors) {
                        *worst = worst.max(error);
                    }
                }
                Err(error) if ball_friction > 0.0 => missed.push((trial, error)),
                Err(error) => panic!("N = {N}, row {trial}, no ball friction: {error}"),
            }
        }
    }
    println!("N = {N}: {worst:?}; with ball friction {missed:?}");
    assert!(missed.len() <= unsettled, "N = {N}: {missed:?}");
}

/// A limit: where balls rub on each other, a long row is not always settled after the steps taken here, because that
/// friction lags a step behind. How many rows may miss a bound is measured; without friction between the balls none
/// does.
#[test]
fn rows_settle_to_the_exact_chain_and_lose_what_goes_in() {
    check::<1>(20, 0);
    check::<2>(20, 0);
    check::<8>(8, 0);
    check::<37>(12, 2);
    check::<64>(12, 7);
}
