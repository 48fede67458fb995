//! A nut that friction holds stands still.

use super::*;
use crate::designs::DesignSource;

/// A nut of 4e-4 kg m^2 under 3 kN and a motor torque that rises within two seconds to what holds the load and 0.18 N m beyond: below the
/// friction of the built-in steering gear.
fn held(tick: f64, samples: u32) -> Vec<Row> {
    let design = "lin-4.1".parse::<DesignSource>().unwrap().load().unwrap();
    let load_torque = 3000.0 * f64::from(design.screw().lead()) / TAU;
    let acting: Vec<Acting> = (0..samples)
        .map(|sample| {
            let time = tick * f64::from(sample);
            Acting {
                time,
                command: load_torque + 0.18 * (0.5 * time).min(1.0),
                axial_load: 3000.0,
            }
        })
        .collect();
    let course = Course {
        design: &design,
        acting: &acting,
        temperature: &Temperature::None,
        inertia: 4e-4,
        controller: None,
        tick,
    };
    moved(course).unwrap().0
}

/// At ticks from a millisecond on the elements come into balance, and from then on the nut stands where it is, to the last bit.
#[test]
fn below_breakaway_nothing_creeps() {
    for (tick, samples) in [(1e-3, 30_000), (2e-3, 30_000), (1e-2, 6_000)] {
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

/// A day of it.
#[test]
fn a_day_below_breakaway_is_a_day_at_rest() {
    let rows = held(1.0, 86_400);
    let (middle, last) = (&rows[100], rows.last().unwrap());
    assert_eq!([middle.speed, last.speed], [0.0; 2]);
    assert_eq!(middle.angle, last.angle);
}
