//! Makers' rules, judged by friction torque: an efficiency of 0.98 where a rule has 0.99 is twice the friction.

use std::f64::consts::{SQRT_2, TAU};

use super::catalogue;
use super::figure::{Found, Size, Standing, Usual, fixed};
use super::rows::{PRELOADED, range, torque, widened};
use super::studies::{BALL_LOADS, FIT_LOAD, SCREWS};
use epas_reference::error::ReferenceError;
use epas_reference::friction::ball_screw_efficiency::LoadedScrew;

/// Every screw of [`SCREWS`] under every load of [`BALL_LOADS`]: above zero it opposes the nut (driving), below zero it drives it.
fn cases(usual: &Usual, direction: f64) -> impl Iterator<Item = (Size, LoadedScrew)> {
    SCREWS.iter().flat_map(move |size| {
        BALL_LOADS.map(|load| (*size, size.under(direction * load * size.balls, usual)))
    })
}

fn spread(values: &[f64]) -> String {
    let [low, high] = range(values.iter().copied());
    let mean = values.iter().map(|value| value.ln()).sum::<f64>() / values.len() as f64;
    format!("{low:.2} to {high:.2} (geometric mean {:.2})", mean.exp())
}

pub(super) fn chart(usual: &Usual) -> Result<Found, ReferenceError> {
    let mut frictions = Vec::new();
    for (size, screw) in cases(usual, 1.0) {
        let angle = size.design().lead_angle();
        if (1.0..=9.0).contains(&angle.to_degrees()) {
            let efficiency = screw.solve()?.efficiency();
            frictions.push(catalogue::chart_friction(angle, efficiency));
        }
    }
    let found = range(frictions);
    let standing = Standing::of(found, widened(catalogue::CHART_FRICTION));
    Ok(Found::new(
        standing,
        found.map(|friction| fixed(friction, 4)),
    ))
}

/// Friction torque of a screw by the rule of efficiency, N m: in theory, and in practice.
fn torques_by_rule(size: &Size, screw: &LoadedScrew) -> [f64; 2] {
    let ideal = screw.axial_load.abs() * screw.design.lead / TAU;
    let theory = catalogue::efficiency(size.diameter, size.lead);
    [theory, catalogue::PRACTICE * theory].map(|efficiency| ideal * (1.0 / efficiency - 1.0))
}

/// The rule of efficiency in one direction. Its efficiencies of driving, `T/(T + friction)`, and of back-driving, `1 - friction/T = 2 - 1/driving`,
/// mean one friction torque.
pub(super) fn efficiency(usual: &Usual, direction: f64) -> Result<Found, ReferenceError> {
    let (mut shares, mut within, mut needed) = (Vec::new(), 0, Vec::new());
    for (size, screw) in cases(usual, direction) {
        let [theory, practice] = torques_by_rule(&size, &screw);
        let found = torque(&screw)?;
        shares.push(found / theory);
        let [least, _] = widened([theory; 2]);
        let [_, most] = widened([practice; 2]);
        within += usize::from((least..=most).contains(&found));
        if screw.axial_load.abs() == FIT_LOAD * size.balls {
            needed.extend(screw.friction_for(theory, torque));
        }
    }
    let standing = if within == shares.len() {
        Standing::Within
    } else {
        Standing::Apart
    };
    let counts = [within, shares.len()].map(|count| count.to_string());
    let computed = std::iter::once(spread(&shares)).chain(counts);
    let needed = range(needed).map(|friction| fixed(friction, 3));
    Ok(Found::new(standing, computed).needs(needed))
}

const SOLD: [[f64; 3]; 4] = [
    [25.0, 8.0, 4.762],
    [32.0, 10.0, 6.35],
    [40.0, 8.0, 6.35],
    [40.0, 10.0, 6.35],
];

/// Axial preloads of a ball, N. The default friction coefficient was fitted at the third.
const PRELOADS: [f64; 4] = [4.0, 10.0, 25.0, 100.0];

/// Preloaded screws with the rule's coefficient of each.
fn preloaded(usual: &Usual) -> impl Iterator<Item = (LoadedScrew, f64)> {
    let usual = Usual {
        clearance: 0.0,
        ..*usual
    };
    SOLD.iter().flat_map(move |&[diameter, lead, ball]| {
        let size = Size {
            diameter,
            lead,
            ball,
            ..PRELOADED
        };
        let rule = catalogue::drag_coefficient(diameter, lead);
        PRELOADS.map(|preload| (size.under(preload * size.balls, &usual), rule))
    })
}

/// `preload lead/2 pi`, N m.
fn unit(screw: &LoadedScrew) -> f64 {
    screw.axial_load * screw.design.lead / TAU
}

fn preloads() -> String {
    let [least, .., most] = PRELOADS.map(|preload| SQRT_2 * preload);
    format!("25x8, 32x10, 40x8, 40x10; {least:.0} to {most:.0} N a contact")
}

pub(super) fn drag_of_two_nuts(usual: &Usual) -> Result<Found, ReferenceError> {
    let (mut shares, mut driven, mut fitted) = (Vec::new(), Vec::new(), Vec::new());
    for (screw, rule) in preloaded(usual) {
        let back = LoadedScrew {
            axial_load: -screw.axial_load,
            ..screw
        };
        let [driving, driven_nut] = [torque(&screw)?, torque(&back)?];
        let share = (driving + driven_nut) / (unit(&screw) * rule);
        shares.push(share);
        driven.push(driven_nut / (driving + driven_nut));
        if screw.axial_load == PRELOADS[2] * screw.balls {
            fitted.push(share);
        }
    }
    let [low, high] = range(driven).map(|share| fixed(share, 2));
    let standing = Standing::of(range(shares.iter().copied()), widened([1.0, 1.0]));
    let needed = range(fitted).map(|share| fixed(share, 2));
    Ok(Found::new(standing, [spread(&shares), low, high, preloads()]).needs(needed))
}

pub(super) fn drag_of_oversize(usual: &Usual) -> Result<Found, ReferenceError> {
    let mut shares = Vec::new();
    for (screw, rule) in preloaded(usual) {
        shares.push(torque(&screw.braced_by_oversize()?)? / (unit(&screw) * rule));
    }
    let standing = Standing::of(range(shares.iter().copied()), widened([1.0, 1.0]));
    Ok(Found::new(standing, [spread(&shares), preloads()]))
}

pub(super) fn drag_range(usual: &Usual) -> Result<Found, ReferenceError> {
    let mut coefficients = Vec::new();
    for (screw, _) in preloaded(usual) {
        coefficients.push(screw.double_nut_torque()? / unit(&screw));
    }
    let found = range(coefficients);
    let [low, high] = found.map(|coefficient| fixed(coefficient, 3));
    let standing = Standing::of(found, widened(catalogue::DRAG_RANGE));
    Ok(Found::new(standing, [low, high, preloads()]))
}
