//! The closed form of a row of balls under one axial load, and the forces between its balls.
//!
//! It does not take contacts: it finds them from the axial load of each ball and from how far the
//! contact angles deviate in either groove. Both are read off the given contacts, and how far those are from
//! the contacts that it then finds stands beside the answer.

use epas_friction::ball::{RowContacts, ScrewRow};
use epas_friction::train::Press;
use epas_friction::{BallScrew, LoadShare};
use serde::Serialize;

use super::super::train::{LARGEST_TRAIN, contact_forces, room_of_a_row};
use super::Row as Found;
use super::contacts::{Given, LARGEST_LOAD_MISMATCH, Row, Ways};

/// Furthest that contact angles, rad, may be from those of the closed form. Stored balls in elastic grooves without play are
/// within 2.1e-4.
const LARGEST_ANGLE_MISMATCH: f32 = 0.01;

/// Steps of the axial load towards the main contacts' load, which is nearly in proportion to it.
const STEPS: usize = 12;

#[derive(Default, Serialize)]
pub struct ClosedRow {
    #[serde(flatten)]
    found: Found,
    /// How far the given loads are from those that the closed form finds, over the main ones.
    load_mismatch: Option<f32>,
    /// How far the given contact angles are, rad.
    angle_mismatch: Option<f32>,
}

impl From<Found> for ClosedRow {
    fn from(found: Found) -> Self {
        Self {
            found,
            ..Self::default()
        }
    }
}

#[derive(Clone, Copy)]
struct State {
    /// Axial load of the screw on the ball, N.
    axial_load: f32,
    screw_deviation: f32,
    nut_deviation: f32,
}

/// What the closed form finds for balls of a screw; none where contacts are further from its own than its errors.
pub fn row(given: &Row, design: &BallScrew, ways: Ways) -> Option<ClosedRow> {
    let Ways {
        friction,
        nut_speed,
    } = ways;
    let row = ScrewRow::new(design, friction, given.fit).ok()?;
    let [main_screw, _] = given.main;
    let mut states = Vec::with_capacity(given.balls.len());
    let (mut load_mismatch, mut angle_mismatch) = (0.0_f32, 0.0_f32);
    for ball in &given.balls {
        let state = state(&row, nut_speed, given, ball)?;
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
    Some(ClosedRow {
        found: run(&row, design, &states, ways)?,
        load_mismatch: Some(load_mismatch),
        angle_mismatch: Some(angle_mismatch),
    })
}

/// Axial load and deviations of a ball, from its main contacts.
fn state(row: &ScrewRow, nut_speed: f32, given: &Row, ball: &Given) -> Option<State> {
    let [(screw_load, _), (nut_load, _)] = given.loaded(ball)?;
    let (screw_deviation, nut_deviation) = given.deviations(ball)?;
    let wanted = 0.5 * (screw_load + nut_load);
    let mut axial_load = if given.is_reversed() { -wanted } else { wanted };
    for _ in 0..STEPS {
        let loads = row.contacts(nut_speed, axial_load, 0.0, 0.0).forces;
        axial_load *= wanted / loads[given.main[0]];
    }
    axial_load.is_finite().then_some(State {
        axial_load,
        screw_deviation,
        nut_deviation,
    })
}

/// The row at the mean load, each ball by its share of it, and what they press.
fn run(
    row: &ScrewRow,
    design: &BallScrew,
    states: &[State],
    Ways {
        friction,
        nut_speed,
    }: Ways,
) -> Option<Found> {
    let count = states.len();
    let mean = states.iter().map(|state| state.axial_load).sum::<f32>() / count as f32;
    let tick = row.at(nut_speed, mean);
    let path = design.pitch_radius() / design.cos_lead_angle();
    // Speeds over that of a nominal ball against the nut.
    let speed = path - tick.nominal_speed();
    let (mut free, mut impedance) = ([0.0; LARGEST_TRAIN], [1.0; LARGEST_TRAIN]);
    let mut groove_torque = 0.0;
    let mut orbital_speed = Vec::with_capacity(count);
    for ((state, free), impedance) in states.iter().zip(&mut free).zip(&mut impedance) {
        let share = LoadShare::new(state.axial_load / mean).ok()?;
        let ball = tick.ball(state.screw_deviation, state.nut_deviation, &share);
        *free = ball.speed_deviation / speed;
        *impedance = speed.abs() / ball.compliance;
        groove_torque += ball.groove_torque;
        let along = tick.nominal_speed() + ball.speed_deviation;
        orbital_speed.push(f64::from(nut_speed) * f64::from(along / path));
    }
    let mut press = Press::<LARGEST_TRAIN>::new();
    if !press.solve(&free, &impedance, &room_of_a_row::<LARGEST_TRAIN>(count)) {
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
    let torque = groove_torque + 2.0 * friction * rubbing;
    let pressing = forces.iter().take(count - 1);
    Some(Found {
        orbital_speed: Some(orbital_speed),
        contact_force: Some(pressing.map(|&force| force.into()).collect()),
        power_loss: Some(f64::from(nut_speed.abs()) * f64::from(torque)),
    })
}
