//! What the scene of a ball screw without cage computes for a row of balls: the closed form of a row under
//! one axial load, and the forces between its balls.
//!
//! The scene does not take contacts: it finds them from the axial load of each ball and from how far the
//! contact angles deviate in either groove. Both are read off the given contacts, and how far those are from
//! the contacts that the scene then finds stands beside the answer.

use epas_friction::ball::{GrooveFit, LoopSums, RowContacts, ScrewRow};
use epas_friction::train::Press;
use epas_friction::{BallScrew, Error, LoadShare};
use serde::Serialize;

use super::train::{LARGEST_TRAIN, contact_forces, room_of_a_row};

/// Places of the flanks in a list of contacts.
const SL: usize = 0;
const SR: usize = 1;
const NL: usize = 2;
const NR: usize = 3;

/// Furthest that loads, over the main ones, and contact angles, rad, may be from those of the scene. Stored
/// balls in elastic grooves without play are within 0.048 and 2.1e-4; twice that and more is let pass.
const LARGEST_LOAD_MISMATCH: f32 = 0.1;
const LARGEST_ANGLE_MISMATCH: f32 = 0.01;

/// Steps of the axial load towards the main contacts' load, which is nearly in proportion to it.
const STEPS: usize = 12;

/// Contacts of a ball as they are given: load, N, and contact angle, rad, in the order SL, SR, NL, NR.
pub type Given = [Option<(f32, f32)>; 4];

/// What the scene computes.
#[derive(Serialize)]
pub struct SceneRow {
    orbital_speed: Vec<f64>,
    contact_force: Vec<f64>,
    power_loss: f64,
    /// How far the given loads are from those that the scene finds, over the main ones.
    load_mismatch: f32,
    /// How far the given contact angles are, rad.
    angle_mismatch: f32,
}

/// A ball as the scene takes it.
#[derive(Clone, Copy)]
struct State {
    /// Axial load of the screw on the ball, N.
    axial_load: f32,
    screw_deviation: f32,
    nut_deviation: f32,
}

/// What the scene computes for balls that turn with a screw of the given friction; none where they are not
/// of one screw: some ball has four loaded contacts, loads have different directions, or contacts are
/// further from the scene's than its own errors.
pub fn scene(
    balls: &[Given],
    friction: f32,
    nut_speed: f32,
    design: impl FnOnce(f32) -> Result<BallScrew, Error>,
) -> Option<SceneRow> {
    let loaded: Vec<Given> = balls
        .iter()
        .map(|ball| ball.map(|contact| contact.filter(|(load, _)| *load > 0.0)))
        .collect();
    let count = |ball: &Given| ball.iter().flatten().count();
    let fit = if loaded.iter().all(|ball| count(ball) == 2) {
        GrooveFit::Play
    } else if loaded.iter().all(|ball| count(ball) == 3) {
        GrooveFit::Zero
    } else {
        return None;
    };
    let [main_screw, main_nut] = main_flanks(&loaded)?;
    let nominal = nominal_angle(&loaded);
    let design = design(nominal).ok()?;
    let row = ScrewRow::new(&design, friction, fit).ok()?;

    let mut states = Vec::with_capacity(loaded.len());
    let (mut load_mismatch, mut angle_mismatch) = (0.0_f32, 0.0_f32);
    for ball in &loaded {
        let state = state(&row, nut_speed, nominal, ball, [main_screw, main_nut])?;
        let RowContacts {
            angles,
            forces: loads,
        } = row.contacts(
            nut_speed,
            state.axial_load,
            state.screw_deviation,
            state.nut_deviation,
        );
        let main = loads[main_screw];
        for (place, contact) in ball.iter().enumerate() {
            let (load, angle) = contact.unwrap_or((0.0, angles[place]));
            load_mismatch = load_mismatch.max((load - loads[place]).abs() / main);
            angle_mismatch = angle_mismatch.max((angle - angles[place]).abs());
        }
        states.push(state);
    }
    // False for NaN too.
    if !(load_mismatch <= LARGEST_LOAD_MISMATCH && angle_mismatch <= LARGEST_ANGLE_MISMATCH) {
        return None;
    }
    run(&row, &design, &states, friction, nut_speed).map(|answer| SceneRow {
        load_mismatch,
        angle_mismatch,
        ..answer
    })
}

/// The flanks on screw and nut that carry the axial load, the same of every ball.
fn main_flanks(balls: &[Given]) -> Option<[usize; 2]> {
    let load = |ball: &Given, place: usize| ball[place].map_or(0.0, |(load, _)| load);
    let carries = |[screw, nut]: [usize; 2]| {
        balls.iter().all(|ball| {
            let other = if [screw, nut] == [SR, NL] {
                [SL, NR]
            } else {
                [SR, NL]
            };
            load(ball, screw).min(load(ball, nut)) > load(ball, other[0]).max(load(ball, other[1]))
        })
    };
    [[SR, NL], [SL, NR]].into_iter().find(|pair| carries(*pair))
}

/// Grooves turn both of their contacts by the same angle, to either side: where a ball has both of one groove,
/// the nominal angle is their mean. Two contacts on different grooves do not tell it: their mean stands in.
fn nominal_angle(balls: &[Given]) -> f32 {
    let mut sum = 0.0;
    let mut count = 0.0_f32;
    for ball in balls {
        let pairs = match *ball {
            [Some((_, left)), Some((_, right)), ..] | [_, _, Some((_, left)), Some((_, right))] => {
                [left, right]
            }
            _ => {
                let mut angles = ball.iter().flatten().map(|(_, angle)| *angle);
                [angles.next(), angles.next()].map(Option::unwrap_or_default)
            }
        };
        sum += pairs.iter().sum::<f32>();
        count += 2.0;
    }
    sum / count
}

/// Axial load and deviations of a ball, from its main contacts.
fn state(
    row: &ScrewRow,
    nut_speed: f32,
    nominal: f32,
    ball: &Given,
    main: [usize; 2],
) -> Option<State> {
    let [screw, nut] = main.map(|place| ball[place]);
    let ((screw_load, screw_angle), (nut_load, nut_angle)) = (screw?, nut?);
    let reversed = main == [SR, NL];
    let (screw_deviation, nut_deviation) = if reversed {
        (screw_angle - nominal, nominal - nut_angle)
    } else {
        (nominal - screw_angle, nut_angle - nominal)
    };
    let wanted = 0.5 * (screw_load + nut_load);
    let mut axial_load = if reversed { -wanted } else { wanted };
    for _ in 0..STEPS {
        let loads = row.contacts(nut_speed, axial_load, 0.0, 0.0).forces;
        axial_load *= wanted / loads[main[0]];
    }
    axial_load.is_finite().then_some(State {
        axial_load,
        screw_deviation,
        nut_deviation,
    })
}

/// The step's own functions: the row at the mean load, each ball by its share of it, and what they press.
fn run(
    row: &ScrewRow,
    design: &BallScrew,
    states: &[State],
    friction: f32,
    nut_speed: f32,
) -> Option<SceneRow> {
    let count = states.len();
    let mean = states.iter().map(|state| state.axial_load).sum::<f32>() / count as f32;
    let tick = row.at(nut_speed, mean);
    let path = design.pitch_radius() / design.cos_lead_angle();
    // Speeds over that of a nominal ball against the nut, as in the scene.
    let speed = path - tick.nominal_speed();
    let balls = tick.per_speed(speed, 1.0 / speed, (1.0, 1.0));
    let (mut free, mut impedance) = ([0.0; LARGEST_TRAIN], [1.0; LARGEST_TRAIN]);
    let mut sums = LoopSums::NONE;
    let mut orbital_speed = Vec::with_capacity(count);
    for ((state, free), impedance) in states.iter().zip(&mut free).zip(&mut impedance) {
        let share = LoadShare::new(state.axial_load / mean).ok()?;
        let ball = balls.ball(
            state.screw_deviation,
            state.nut_deviation,
            &share,
            &mut sums,
        );
        (*free, *impedance) = (ball.speed, ball.impedance);
        let along = tick.nominal_speed() + speed * ball.speed;
        orbital_speed.push(f64::from(nut_speed) * f64::from(along / path));
    }
    let mut press = Press::new();
    if !press.solve(&free, &impedance, &room_of_a_row(count)) {
        return None;
    }
    let forces = contact_forces(&press);
    let force: f32 = forces.iter().sum();
    let power: f32 = forces
        .iter()
        .zip(press.speeds())
        .map(|(force, speed)| force * speed)
        .sum();
    let rubbing = tick.rubbing() * force + tick.rubbing_slope() * speed * power;
    let torque = balls.groove_torque(&sums) + 2.0 * friction * rubbing;
    Some(SceneRow {
        orbital_speed,
        contact_force: forces
            .iter()
            .take(count - 1)
            .map(|&force| force.into())
            .collect(),
        power_loss: f64::from(nut_speed.abs()) * f64::from(torque),
        load_mismatch: 0.0,
        angle_mismatch: 0.0,
    })
}
