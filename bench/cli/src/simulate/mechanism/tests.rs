//! A nut that friction holds stands still; an effort that is known drives it as the motor does.

use std::f64::consts::TAU;

use super::*;
use epas_design::files::DesignSource;

fn design() -> Design {
    "lin-4.1".parse::<DesignSource>().unwrap().load().unwrap()
}

const fn at(time: f64, command: f64, axial_load: f64) -> Acting {
    Acting {
        time,
        command,
        axial_load,
        known_torque: 0.0,
        known_force: 0.0,
    }
}

fn moved_by(acting: &[Acting], controller: Option<Controller>, tick: f64) -> Vec<Row> {
    let course = Course {
        design: &design(),
        acting,
        temperature: &Temperature::None,
        memory: MemorySettings::default(),
        inertia: 4e-4,
        controller,
        tick,
    };
    moved(&course).unwrap().0
}

/// A nut of 4e-4 kg m^2 under 3 kN and a motor torque that rises within two seconds to what holds the load and 0.18 N m beyond: below the
/// friction of the built-in steering gear.
fn held(tick: f64, samples: u32) -> Vec<Row> {
    let load_torque = 3000.0 * f64::from(design().screw().lead()) / TAU;
    let acting: Vec<Acting> = (0..samples)
        .map(|sample| {
            let time = tick * f64::from(sample);
            at(time, load_torque + 0.18 * (0.5 * time).min(1.0), 3000.0)
        })
        .collect();
    moved_by(&acting, None, tick)
}

/// The elements come into balance, and from then on the nut stands where it is, to the last bit, at every tick.
#[test]
fn below_breakaway_nothing_creeps() {
    for (tick, samples) in [
        (1e-4, 45_000),
        (2e-4, 25_000),
        (5e-4, 10_000),
        (1e-3, 10_000),
        (2e-3, 10_000),
        (1e-2, 6_000),
    ] {
        let rows = held(tick, samples);
        let last = rows.last().unwrap();
        let still = rows.iter().rev().take_while(|row| row.speed == 0.0).count();
        let from = rows.len() - still;
        println!("tick {tick}: at rest from {:.3} s on", tick * from as f64);
        assert!(2 * still > rows.len(), "tick {tick}: {} rad/s", last.speed);
        assert!(last.angle > 0.0 && last.angle < 0.01, "{}", last.angle);
        let at_rest = &rows[from + 1..];
        assert!(at_rest.iter().all(|row| row.angle == last.angle));
        assert!(at_rest.iter().all(|row| row.friction == last.friction));
    }
}

/// After a torque beyond the load's is taken away again the nut rests on what its elements hold against each other, at a friction of nearly
/// nothing.
#[test]
fn released_a_nut_comes_to_rest() {
    let load_torque = 3000.0 * f64::from(design().screw().lead()) / TAU;
    for tick in [2e-4, 1e-3] {
        let samples = (4.0 / tick) as u32;
        let acting: Vec<Acting> = (0..samples)
            .map(|sample| {
                let time = tick * f64::from(sample);
                let torque = (0.1 * time).min(0.1 - 0.1 * (time - 1.0)).max(0.0);
                at(time, load_torque + torque, 3000.0)
            })
            .collect();
        let rows = moved_by(&acting, None, tick);
        let (rested, last) = (&rows[3 * rows.len() / 4], rows.last().unwrap());
        assert_eq!([rested.speed, last.speed], [0.0; 2], "{tick}");
        assert_eq!(rested.angle, last.angle, "{tick}");
    }
}

#[test]
fn a_day_below_breakaway_is_a_day_at_rest() {
    let rows = held(1.0, 86_400);
    let (middle, last) = (&rows[100], rows.last().unwrap());
    assert_eq!([middle.speed, last.speed], [0.0; 2]);
    assert_eq!(middle.angle, last.angle);
}

/// Moments of 0.3 s at 1 kHz: a command, and a pulse of 0.1 s that this makes of them.
fn pulsed(command: f64, pulse: impl Fn(&mut Acting)) -> Vec<Acting> {
    let moments = (0..300_u16).map(|sample| {
        let mut acting = at(1e-3 * f64::from(sample), command, 500.0);
        if (100..200).contains(&sample) {
            pulse(&mut acting);
        }
        acting
    });
    moments.collect()
}

/// A known torque moves the nut as the same torque of the motor does, to the last bit, a known force as its torque on the lead.
#[test]
fn a_known_effort_drives_as_the_motor_does() {
    let lead = f64::from(design().screw().lead());
    let torque = 2.0_f64;
    let by_motor = moved_by(&pulsed(1.0, |acting| acting.command += torque), None, 1e-3);
    let without = moved_by(&pulsed(1.0, |_| {}), None, 1e-3);
    let fastest = |rows: &[Row]| rows.iter().map(|row| row.speed).fold(0.0, f64::max);
    assert!(fastest(&by_motor) > 2.0 * fastest(&without));

    let by_torque = moved_by(
        &pulsed(1.0, |acting| acting.known_torque = torque),
        None,
        1e-3,
    );
    for (one, other) in by_torque.iter().zip(&by_motor) {
        assert_eq!(
            [one.angle, one.speed, one.friction],
            [other.angle, other.speed, other.friction]
        );
    }
    assert_eq!(by_torque[150].known, torque);
    assert_eq!(by_torque[150].torque, 1.0);

    // The force is one rounding off the torque: what is left of it after a product and a quotient.
    let force = torque * TAU / lead;
    let by_force = moved_by(
        &pulsed(1.0, |acting| acting.known_force = force),
        None,
        1e-3,
    );
    for (one, other) in by_force.iter().zip(&by_motor) {
        assert!((one.speed - other.speed).abs() <= 1e-6 * fastest(&by_motor));
    }
}

/// In a closed loop the known effort acts beside the controller's, which answers to it: at rest they cancel but for friction.
#[test]
fn a_controller_answers_to_a_known_effort() {
    let controller = "gain_position=100,gain_speed=0.5".parse().unwrap();
    let pulse = 2.0;
    let rows = moved_by(
        &pulsed(0.0, |acting| acting.known_torque = pulse),
        Some(controller),
        1e-3,
    );
    let before = &rows[99];
    let at_end = &rows[199];
    let change = at_end.torque - before.torque;
    // Friction takes up at most its breakaway torque, both before and after.
    let friction = rows
        .iter()
        .map(|row| row.friction.abs())
        .fold(0.0, f64::max);
    assert!(at_end.speed.abs() < 1e-2, "{}", at_end.speed);
    assert!(
        (change + pulse).abs() <= 2.0 * friction,
        "{change} {friction}"
    );
    assert!(change < -0.5 * pulse, "{change} {friction}");
}
