//! The scene against the exact whole screw over designs and settings.

use std::f64::consts::FRAC_PI_4;

use rayon::prelude::*;

use crate::exact_ring::{Case, Comparison, Off, compare};
use crate::report::draw::{self, table};
use epas_design::uncaged_scene::MARGIN;
use epas_page::document::{Block, Cell};
use epas_reference::design::BallScrewDesign;

const BALLS: usize = 16;

const LIN: Case = Case::LIN;

/// A screw of pitch radius, lead, ball radius and groove radius, m.
const fn screw([pitch_radius, lead, ball_radius, groove_radius]: [f64; 4]) -> Case {
    Case {
        design: BallScrewDesign {
            pitch_radius,
            lead,
            ball_radius,
            screw_groove_radius: groove_radius,
            nut_groove_radius: groove_radius,
            ..BallScrewDesign::LIN
        },
        ..LIN
    }
}

const SMALL: Case = screw([8.15e-3, 5e-3, 1.5875e-3, 1.06 * 1.5875e-3]);
const LARGE: Case = screw([32.5e-3, 20e-3, 4.7625e-3, 1.07 * 4.7625e-3]);
/// Of steering gears; the first is met at 48 degrees.
const STEERING: Case = {
    let mut case = screw([13e-3, 10e-3, 1.984_375e-3, 2.143_125e-3]);
    case.design.contact_angle = FRAC_PI_4 * 48.0 / 45.0;
    case
};
const SLIM: Case = screw([10.5e-3, 7e-3, 1.5e-3, 1.08 * 1.5e-3]);
const RACK: Case = screw([14.5e-3, 7e-3, 2e-3, 2.16e-3]);

const DEGREE: f64 = std::f64::consts::PI / 180.0;

type Setting = (&'static str, &'static str, Case, fn(&mut Case));

const SCREW: &str = "33 x 20 x 5.556";

#[rustfmt::skip]
const CASES: [Setting; 31] = [
    (SCREW, "50 N", LIN, |_| ()),
    (SCREW, "-50 N", LIN, |case| case.load_per_ball = -50.0),
    ("16 x 5 x 3.175", "50 N", SMALL, |_| ()),
    ("63 x 20 x 9.525", "300 N", LARGE, |case| case.load_per_ball = 300.0),
    ("26 x 10 x 3.969", "30 N, 5 turns/s", STEERING, |case| (case.load_per_ball, case.speed) = (30.0, 5.0)),
    ("21 x 7 x 3", "20 N, 5 turns/s", SLIM, |case| (case.load_per_ball, case.speed) = (20.0, 5.0)),
    (SCREW, "50 N, balls do not rub", LIN, |case| case.ball_friction = 0.0),
    (SCREW, "50 N, no return", LIN, |case| case.loaded = 1.0),
    (SCREW, "5 N", LIN, |case| case.load_per_ball = 5.0),
    (SCREW, "300 N", LIN, |case| case.load_per_ball = 300.0),
    (SCREW, "100 N, backward", LIN, |case| (case.load_per_ball, case.speed) = (100.0, -1.0)),
    (SCREW, "-100 N, backward", LIN, |case| (case.load_per_ball, case.speed) = (-100.0, -1.0)),
    (SCREW, "50 N, 5 turns/s", LIN, |case| case.speed = 5.0),
    (SCREW, "50 N, 20 turns/s, ticks of 1 ms", LIN, |case| (case.speed, case.states) = (20.0, 100)),
    (SCREW, "50 N, ticks of 50 us", LIN, |case| case.tick = 50e-6),
    (SCREW, "friction 0.075", LIN, |case| case.friction = 0.075),
    (SCREW, "friction 0.15", LIN, |case| case.friction = 0.15),
    (SCREW, "oversize 5 um", LIN, |case| case.clearance = -5e-6),
    (SCREW, "play 5 um", LIN, |case| case.clearance = 5e-6),
    (SCREW, "play 10 um", LIN, |case| case.clearance = 10e-6),
    ("29 x 7 x 4", "5 N, play 5 um", RACK, |case| (case.load_per_ball, case.clearance) = (5.0, 5e-6)),
    (SCREW, "deviations of 2.3 and 0.7 degrees", LIN, |case| (case.screw.largest, case.nut.largest) = (2.3 * DEGREE, 0.7 * DEGREE)),
    (SCREW, "deviations of 3 degrees in both grooves", LIN, |case| (case.screw.largest, case.nut.largest) = (3.0 * DEGREE, 3.0 * DEGREE)),
    ("16 x 5 x 3.175", "5 N, play 2 um", SMALL, |case| (case.load_per_ball, case.clearance) = (5.0, 2e-6)),
    ("16 x 5 x 3.175", "-50 N, friction 0.08", SMALL, |case| (case.load_per_ball, case.friction) = (-50.0, 0.08)),
    ("63 x 20 x 9.525", "-100 N, oversize 3 um", LARGE, |case| (case.load_per_ball, case.clearance) = (-100.0, -3e-6)),
    ("63 x 20 x 9.525", "50 N, 5 turns/s", LARGE, |case| case.speed = 5.0),
    ("26 x 10 x 3.969", "-60 N, backward", STEERING, |case| (case.load_per_ball, case.speed) = (-60.0, -1.0)),
    ("26 x 10 x 3.969", "60 N", STEERING, |case| case.load_per_ball = 60.0),
    ("21 x 7 x 3", "60 N, friction 0.07", SLIM, |case| (case.load_per_ball, case.friction) = (60.0, 0.07)),
    ("21 x 7 x 3", "-40 N, oversize 2 um", SLIM, |case| (case.load_per_ball, case.clearance) = (-40.0, -2e-6)),
];

pub fn blocks(quick: bool) -> Vec<Block> {
    // The first two have the law of the 37 balls.
    let cases: Vec<_> = CASES
        .into_iter()
        .take(if quick { 2 } else { CASES.len() })
        .map(|(design, setting, mut case, change)| {
            change(&mut case);
            (design, setting, case)
        })
        .collect();
    // One after the other: a fold takes all cores, and cases share laws. What is not folded is told in its row.
    for (_, _, case) in &cases {
        let _ = case.law();
    }
    let rows = cases
        .par_iter()
        .map(|(design, setting, case)| match compare::<BALLS>(case) {
            Ok(found) => row(design, setting, &found),
            Err(reason) => draw::told(COLUMNS, [design, setting], &reason),
        })
        .collect();
    vec![Block::Table(table(
        "whole_screws",
        format!(
            "The scene against the exact whole screw: {BALLS} balls over two turns, errors at the same state in per cent, of torque and groove torque over their own exact value, of the others over \
             the largest exact one; 45 degrees contact angle \
             (26 x 10: 48), friction 0.1 and 0.1 between balls, no clearance, deviations of 1 degree on the screw and 0.5 degrees in the nut, the track filled but for a tenth of a ball, 5 % of it a \
             return, one turn a second, ticks of at most 1 ms unless said otherwise. \
             Each law is folded for the deviations of its row and for 5 to 300 N a ball, or up to the power of two above {MARGIN} times the row's load where that is more. States \
             that the scene flags are compared like all others; a state without an exact solution is not. The last column says why a screw is not folded"
        ),
        COLUMNS,
        rows,
    ))]
}

const COLUMNS: &str = "screw | setting | largest force (N) | force: largest error (%) | rms | mean | torque (%) | \
     rms | mean | groove torque (%) | ball torque (%) | speed (%) | pairs that press (%) | \
     states compared | flagged | no exact solution | not folded";

fn row(design: &str, setting: &str, found: &Comparison) -> Vec<Cell> {
    let percent = |off: &Off| off.relative().map(|error| Cell::fixed(100.0 * error, 3));
    let largest = |off: &Off| {
        let [largest, ..] = percent(off);
        largest
    };
    let mut row = vec![
        Cell::from(design),
        setting.into(),
        Cell::fixed(found.largest_force, 2),
    ];
    row.extend(percent(&found.force));
    row.extend(percent(&found.torque));
    row.extend([&found.groove, &found.ball, &found.speed, &found.pairs].map(largest));
    row.extend(
        [found.compared, found.flagged, found.failed].map(|states| Cell::fixed(states as f64, 0)),
    );
    row.push("".into());
    row
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_as_long_as_the_headings() {
        let compared = row("33 x 20", "50 N", &Comparison::default());
        let refused = draw::told(COLUMNS, ["33 x 20", "50 N"], "no balance");
        assert_eq!([compared.len(), refused.len()], [draw::width(COLUMNS); 2]);
        assert_eq!(refused.last().map(Cell::shown), Some("no balance"));
    }
}
