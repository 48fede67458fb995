//! Bounds that are measured, not derived: what was found, and what is accepted, with room for another compiler or
//! other rounding: about half as much again, and up to three times as much where only roundings and the last step of an iteration
//! are left. All sweeps give the same numbers in every run.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::sync::Mutex;

/// One measured quantity.
pub struct Measured {
    /// What was measured.
    pub name: &'static str,
    /// Largest, root-mean-square and mean error that a test accepts.
    pub accepted: [f64; 3],
    /// What was found, mean by its size.
    pub found: [f64; 3],
}

const fn row(name: &'static str, accepted: [f64; 3], found: [f64; 3]) -> Measured {
    Measured {
        name,
        accepted,
        found,
    }
}

/// A row of which only the largest error is bounded.
const fn largest(name: &'static str, accepted: f64, found: f64) -> Measured {
    const OPEN: f64 = f64::INFINITY;
    row(name, [accepted, OPEN, OPEN], [found, 0.0, 0.0])
}

/// Largest error of each name so far, so that only a larger one is printed.
static LARGEST: Mutex<BTreeMap<String, f64>> = Mutex::new(BTreeMap::new());

/// Asserts that an error is at most what the row of its name accepts.
pub fn assert(name: &str, error: impl Into<f64>) {
    assert_at(name, error, "");
}

/// The same, with the case for the message.
pub fn assert_at(name: &str, error: impl Into<f64>, case: impl Display) {
    let error = error.into().abs();
    let [accepted, ..] = of(name).accepted;
    assert!(
        error <= accepted,
        "{name}: {error:e}; accepted is {accepted:e}; {case}"
    );
    let mut largest = LARGEST.lock().unwrap();
    let before = largest.entry(name.to_owned()).or_insert(-1.0);
    if error > *before {
        *before = error;
        println!("{name}: {error:.2e}");
    }
}

/// The row of a name.
///
/// # Panics
/// Where there is none or more than one, or less is accepted than was found, or far more.
pub fn of(name: &str) -> &'static Measured {
    let mut rows = TABLES
        .iter()
        .flat_map(|table| table.iter())
        .filter(|row| row.name == name);
    let row = rows
        .next()
        .unwrap_or_else(|| panic!("{name} is not in testkit/src/measured.rs"));
    assert!(rows.next().is_none(), "{name} stands twice");
    for (accepted, found) in row.accepted.iter().zip(row.found) {
        assert!(found <= *accepted, "{name}: {found:e} above {accepted:e}");
    }
    for (accepted, found) in row.accepted.iter().zip(row.found).take(2) {
        // Three times, rounded up to two digits.
        let far = found > 0.0 && accepted.is_finite() && *accepted > 3.3 * found;
        assert!(!far, "{name}: {accepted:e} far above {found:e}");
    }
    row
}

const TABLES: &[&[Measured]] = &[
    SCREW_BALL,
    FRICTION_MAP,
    UNCAGED_TICKS,
    LINEAR_BALL,
    ROTARY_BEARING,
    TRAIN,
    TWO_POINT,
    CURVATURE,
    EFFICIENCY,
    HERTZ,
    KINEMATICS,
    SCENES,
    SCREW_REFERENCE,
    CHAIN_REFERENCE,
    LINEAR_REFERENCE,
    ROTARY_REFERENCE,
    MAPS_REFERENCE,
    CURVATURE_REFERENCE,
    KINEMATICS_REFERENCE,
    ROLLING_BALL,
    STATICS,
    STATICS_STUDIES,
    STEADY_STATE,
    WHOLE_SCREW_REFERENCE,
    SINES,
    STIFFNESS,
    ROLLING,
    FRICTION_TORQUE,
    LOOPS,
    RING_REFERENCE,
    ROW_REFERENCE,
    LINEAR_MIRRORED,
    MAP_ROUNDINGS,
    ELEMENTS,
    UNCAGED_SCENE,
];

/// `scenes/uncaged`: torques relative, or over their mean; forces over the largest of a state, and balances over the same.
#[rustfmt::skip]
const UNCAGED_TICKS: &[Measured] = &[
    row("even loads, smooth balls: torque", [6.1e-4, 3.0e-4, 1.8e-4], [4.1e-4, 2.0e-4, 1.2e-4]),
    row("even loads, smooth balls: torque of an event", [6.1e-4, 4.0e-4, 3.7e-4], [4.1e-4, 2.7e-4, 2.4e-4]),
    row("even loads, smooth balls: torque, ticks with a meeting too", [2.1e-3, 3.7e-4, 1.7e-4], [1.4e-3, 2.5e-4, 1.2e-4]),
    row("even loads, smooth balls: forces", [3.6e-2, 5.7e-3, 3.4e-4], [2.4e-2, 3.8e-3, 2.3e-4]),
    row("even loads, smooth balls: forces of an event", [3.6e-2, 8.3e-3, 7.4e-4], [2.4e-2, 5.5e-3, 4.9e-4]),
    row("even loads, rubbing balls: torque", [4.3e-3, 1.1e-3, 3.2e-5], [2.9e-3, 7.5e-4, 2.2e-5]),
    row("even loads, rubbing balls: torque of an event", [4.3e-3, 1.4e-3, 1.0e-3], [2.9e-3, 9.6e-4, 6.7e-4]),
    row("even loads, rubbing balls: torque, ticks with a meeting too", [1.1e-1, 1.5e-2, 4.5e-3], [7.1e-2, 9.5e-3, 3.0e-3]),
    row("even loads, rubbing balls: forces", [6.1e-2, 7.9e-3, 1.5e-3], [4.1e-2, 5.3e-3, 9.8e-4]),
    row("even loads, rubbing balls: forces of an event", [6.1e-2, 1.1e-2, 3.6e-3], [4.1e-2, 7.4e-3, 2.4e-3]),
    row("own loads, smooth balls: torque", [9.3e-4, 4.0e-4, 1.9e-5], [6.2e-4, 2.7e-4, 1.3e-5]),
    row("own loads, smooth balls: torque of an event", [9.3e-4, 4.9e-4, 3.3e-4], [6.2e-4, 3.3e-4, 2.2e-4]),
    row("own loads, smooth balls: torque, ticks with a meeting too", [3.9e-3, 4.9e-4, 4.7e-5], [2.6e-3, 3.3e-4, 3.1e-5]),
    row("own loads, smooth balls: forces", [6.2e-2, 1.0e-2, 1.4e-4], [4.2e-2, 6.8e-3, 9.2e-5]),
    row("own loads, smooth balls: forces of an event", [6.2e-2, 1.5e-2, 1.5e-3], [4.2e-2, 9.9e-3, 1.0e-3]),
    row("own loads, rubbing balls: torque", [1.4e-2, 3.7e-3, 6.6e-4], [9.5e-3, 2.4e-3, 4.4e-4]),
    row("own loads, rubbing balls: torque of an event", [1.4e-2, 5.6e-3, 4.4e-3], [9.5e-3, 3.7e-3, 3.0e-3]),
    row("own loads, rubbing balls: torque, ticks with a meeting too", [2.4e-1, 3.0e-2, 8.4e-3], [1.6e-1, 2.0e-2, 5.6e-3]),
    row("own loads, rubbing balls: forces", [7.6e-2, 1.8e-2, 1.1e-3], [5.1e-2, 1.2e-2, 7.5e-4]),
    row("own loads, rubbing balls: forces of an event", [7.6e-2, 2.2e-2, 9.0e-3], [5.1e-2, 1.5e-2, 6.0e-3]),
    row("preload, rubbing balls: torque", [3.9e-3, 1.4e-3, 4.3e-4], [2.6e-3, 9.5e-4, 2.9e-4]),
    row("preload, rubbing balls: torque of an event", [3.9e-3, 2.0e-3, 1.6e-3], [2.6e-3, 1.3e-3, 1.1e-3]),
    row("preload, rubbing balls: torque, ticks with a meeting too", [1.1e-1, 1.5e-2, 3.7e-3], [7.1e-2, 9.5e-3, 2.5e-3]),
    row("preload, rubbing balls: forces", [6.6e-2, 8.6e-3, 1.2e-3], [4.4e-2, 5.7e-3, 8.2e-4]),
    row("preload, rubbing balls: forces of an event", [6.6e-2, 1.3e-2, 5.0e-3], [4.4e-2, 8.6e-3, 3.3e-3]),
    row("between nodes: torque", [1.3e-2, 5.9e-3, 2.4e-3], [8.7e-3, 4.0e-3, 1.6e-3]),
    row("between nodes: torque of an event", [1.3e-2, 6.7e-3, 5.6e-3], [8.7e-3, 4.5e-3, 3.7e-3]),
    row("between nodes: torque, ticks with a meeting too", [1.0e-1, 1.6e-2, 1.6e-3], [6.8e-2, 1.1e-2, 1.1e-3]),
    row("between nodes: forces", [1.3e-1, 3.2e-2, 1.7e-2], [8.9e-2, 2.2e-2, 1.2e-2]),
    row("between nodes: forces of an event", [1.3e-1, 3.9e-2, 2.3e-2], [8.9e-2, 2.6e-2, 1.5e-2]),
    row("ring in time, half the step", [4.6e-2, 5.6e-3, 8.0e-4], [3.1e-2, 3.7e-3, 5.3e-4]),
    row("screw without cage in time", [6.2e-2, 1.4e-2, 4.7e-3], [4.1e-2, 9.3e-3, 3.1e-3]),
    largest("screw without cage, balance of a ball", 6.5e-5, 4.3e-5),
    largest("screw without cage, balance of a rubbed ball", 1.1e-4, 7.2e-5),
    largest("screw without cage, losses of all balls", 2.4e-4, 1.6e-4),
    largest("screw without cage, counted from another ball", 1.3e-6, 4.2e-7),
    largest("range at its last node", 1.2e-7, 0.0),
];

/// `balls/screw_ball.rs`: orbital speeds over the nut's, the rest relative.
#[rustfmt::skip]
const SCREW_BALL: &[Measured] = &[
    row("10 N, SR-NL, pinning: closed form", [0.018, 0.012, 8.4e-3], [6e-3, 4e-3, 3.5e-3]),
    row("10 N, SR-NL, opposite: closed form", [0.13, 0.104, 0.073], [0.1, 0.057, 0.045]),
    row("10 N, SL-NR, pinning: closed form", [0.035, 0.028, 0.0245], [0.031, 0.021, 0.018]),
    row("10 N, SL-NR, opposite: closed form", [0.13, 0.104, 0.080], [0.11, 0.063, 0.053]),
    row("25 N, SR-NL, pinning: closed form", [0.035, 0.024, 0.017], [0.013, 8e-3, 4.7e-3]),
    row("25 N, SR-NL, opposite: closed form", [0.25, 0.2, 0.14], [0.21, 0.11, 0.078]),
    row("25 N, SL-NR, pinning: closed form", [0.035, 0.028, 0.020], [0.032, 0.019, 0.012]),
    row("25 N, SL-NR, opposite: closed form", [0.25, 0.2, 0.14], [0.18, 0.099, 0.08]),
    row("50 N, SR-NL, pinning: closed form", [0.03, 0.024, 0.017], [0.015, 0.011, 9.5e-5]),
    row("50 N, SR-NL, opposite: closed form", [0.5, 0.4, 0.28], [0.44, 0.24, 0.17]),
    row("50 N, SL-NR, pinning: closed form", [0.03, 0.024, 0.017], [0.026, 0.019, 3.4e-4]),
    row("50 N, SL-NR, opposite: closed form", [0.5, 0.4, 0.28], [0.42, 0.23, 0.17]),
    row("100 N, SR-NL, pinning: closed form", [0.08, 0.064, 0.045], [0.048, 0.037, 6.5e-3]),
    row("100 N, SR-NL, opposite: closed form", [1.1, 0.88, 0.74], [0.94, 0.58, 0.49]),
    row("100 N, SL-NR, pinning: closed form", [0.08, 0.064, 0.045], [0.071, 0.048, 0.019]),
    row("100 N, SL-NR, opposite: closed form", [1.1, 0.88, 0.77], [1.0, 0.62, 0.54]),
    row("row, orbital speed", [4e-7, 1e-7, 7e-8], [1.7e-7, 5.7e-8, 2.7e-8]),
    row("row, compliance, mean load", [0.01, 3e-3, 2.1e-3], [3.8e-3, 9.9e-4, 5.9e-4]),
    row("row, compliance, shares 0.1 to 3", [0.08, 0.03, 0.021], [0.056, 0.019, 0.012]),
    row("row, groove torque, mean load", [0.01, 3e-3, 2.1e-3], [6.2e-3, 1.6e-3, 3.6e-4]),
    row("row, groove torque, shares 0.1 to 3", [0.15, 0.05, 0.035], [0.12, 0.036, 0.015]),
    row("row, main load", [5e-3, 2e-3, 2e-4], [2.9e-3, 7.8e-4, 5.3e-5]),
    row("row, third load", [0.11, 0.03, 3e-3], [0.075, 0.017, 1.3e-3]),
    row("row, rubbing", [6e-7, 2e-7, 1e-7], [4.1e-7, 1.4e-7, 3.1e-8]),
    row("load of the main contacts", [0.03, 0.02, 0.02], [0.025, 0.017, 0.015]),
    row("load of the third contact", [0.3, 0.2, 0.2], [0.24, 0.16, 0.15]),
    largest("Table 3.7, row", 0.035, 0.03),
];

/// `formulas/friction_map.rs`: force over its limit, moment over that of spin alone, power over the largest of offset and
/// semi-major axis.
#[rustfmt::skip]
const FRICTION_MAP: &[Measured] = &[
    row("friction map, force", [8.2e-4, 1.4e-4, 1e-6], [7.8e-4, 1.3e-4, 0.0]),
    row("friction map, moment", [1.8e-3, 3.5e-4, 8e-5], [1.7e-3, 3.5e-4, 5.6e-5]),
    row("friction map, power", [2.5e-4, 3.1e-5, 1e-5], [2.4e-4, 3.0e-5, 2.5e-6]),
];

/// `balls/linear_ball.rs`: speed deviations in units of half the track speed, forces of pairs in N, losses relative.
#[rustfmt::skip]
const LINEAR_BALL: &[Measured] = &[
    largest("four-point, (3.43)", 4.2e-3, 4.1e-3),
    largest("next to the two-point switch, (3.43)", 2.5e-2, 2.1e-2),
    largest("exact ball, speed deviation", 8e-11, 2.7e-11),
    largest("exact ball, loss", 1.5e-6, 8.8e-7),
    largest("side force to 0.6, (3.43)", 4.2e-3, 4.1e-3),
    row("pairs, (3.51)", [1.0, 0.4, 0.2], [0.62, 0.24, 0.12]),
    row("pairs near the switch, (3.51)", [2.0, 1.2, 0.8], [1.3, 0.72, 0.47]),
];

/// `balls/rotary_bearing.rs`: residuals of the iterations over the largest force where no unit is given. A tilted ring: the two
/// programs take displacements at different points.
#[rustfmt::skip]
const ROTARY_BEARING: &[Measured] = &[
    largest("axial load, force on one ball in N", 8.7e-12, 2.9e-12),
    largest("Stribeck number", 2e-5, 1.2e-5),
    largest("deflection over load", 2.5e-5, 1.5e-5),
    largest("bearing balance of a ball in N", 5.7e-11, 1.9e-11),
    largest("turned load, forces in N", 5.4e-12, 1.8e-12),
    largest("reciprocal displacements", 2.1e-10, 6.8e-11),
    largest("double row, variation", 1.6, 1.6),
    largest("extreme loads, residual", 5e-8, 3.2e-8),
    largest("bearing balance of the ring in N", 3.6e-10, 1.2e-10),
    largest("ball screw of zero lead, Held", 9.9e-12, 3.3e-12),
    largest("ball screw of zero lead, Free", 0.06, 0.027),
];

/// `balls/train.rs`: forces over the largest one of the row.
#[rustfmt::skip]
const TRAIN: &[Measured] = &[
    largest("press, exhaustive search", 4e-6, 2.5e-6),
    largest("press, relaxation", 1.2e-6, 7.7e-7),
    largest("press, isotonic regression", 2e-6, 1.1e-6),
];

/// `balls/two_point.rs`: speed deviations of the linear ball in units of half the track speed; orbital speeds over the nut's.
#[rustfmt::skip]
const TWO_POINT: &[Measured] = &[
    largest("row with play, rubbing", 0.013, 8.6e-3),
    largest("linear jump, load of the weak diagonal", 0.04, 0.02),
    largest("linear jump, speed after it per degree", 4e-4, 2.5e-4),
    largest("before the linear jump, closed form per degree", 2e-3, 2e-3),
    largest("around the linear jump, closed form per degree", 9.5e-3, 8.6e-3),
    largest("row with play, equal angles", 8e-8, 4.9e-8),
];

/// `formulas/curvature.rs`, relative.
#[rustfmt::skip]
const CURVATURE: &[Measured] = &[
    largest("bias of kappa1", 6.6e-10, 2.2e-10),
    largest("bias of kappa2", 2.5e-8, 1.5e-8),
    largest("fitted curvature on tabulated cases", 1.5e-6, 5.3e-7),
    largest("fitted curvature, rms", 3e-7, 1.7e-7),
    largest("fitted curvature, mean", 9e-9, 6e-9),
    largest("relative curvature along", 2.5e-7, 1.6e-7),
    largest("relative curvature across", 2e-7, 1.2e-7),
];

/// `formulas/efficiency.rs`; the coefficient of the dynamic correction beside a thirtieth.
#[rustfmt::skip]
const EFFICIENCY: &[Measured] = &[
    largest("optimum and locking angles in rad", 4.5e-13, 1.5e-13),
    largest("coefficient of the dynamic correction", 9e-7, 5.6e-7),
    largest("corrected efficiency", 9e-8, 5.8e-8),
    largest("rolling back-drive efficiency", 6e-8, 3.4e-8),
    largest("design procedure", 1.2e-7, 7.5e-8),
];

/// `formulas/hertz.rs`, relative.
#[rustfmt::skip]
const HERTZ: &[Measured] = &[
    largest("tabulated contacts", 4.8e-15, 1.6e-15),
    largest("tabulated axis ratios", 8e-15, 2.7e-15),
    largest("circle by the fitted axis ratio", 1e-5, 5.1e-6),
    largest("contact constants, mean", 2.5e-7, 1.6e-7),
];

/// `formulas/kinematics.rs`: powers relative to the reference's, slips over the entrainment speed.
#[rustfmt::skip]
const KINEMATICS: &[Measured] = &[
    largest("published entrainment angle of the nut in degrees", 0.01, 7.7e-3),
    largest("published slide-to-roll ratio in per cent", 0.011, 7.7e-3),
    largest("published yaw angles, side slip", 5e-6, 3.3e-6),
];

/// `scenes/caged.rs`, `faults.rs`, `linear_scene.rs`, `stiff.rs`: forces of rows over the largest one.
#[rustfmt::skip]
const SCENES: &[Measured] = &[
    largest("locked drive, friction torque in N m", 1.5e-4, 1e-4),
    largest("preload of two flanks", 8e-3, 7.8e-3),
    largest("groove friction after a failure", 1.4e-1, 9.1e-2),
    largest("lifted off, friction in N", 6.6e-10, 2.2e-10),
    largest("stiff rows, speeds", 6e-8, 3.6e-8),
    largest("full track, sum of gaps in m", 1.2e-8, 7.5e-9),
    largest("linear scene, bias of v/2", 1e-6, 3.3e-7),
    largest("two-point rolling, ball alone, flagged before", 3e-2, 2.5e-2),
    largest("two-point rolling, rows, flagged before", 0.1, 8.4e-2),
    largest("row before two-point rolling, friction", 0.26, 0.23),
    largest("row near two-point rolling, friction", 0.4, 0.33),
    largest("speed of a ball alone without a flag, 1 N", 1.6e-2, 1.47e-2),
    largest("speed of a ball alone without a flag, 10 N", 1e-2, 9.3e-3),
    largest("speed of a ball alone without a flag, 100 N", 7.5e-3, 7.2e-3),
    largest("row before two-point rolling, grooves", 0.13, 0.11),
    largest("linear scene through two-point rolling, groove force", 4e-2, 3.3e-2),
    largest("stiff rows beyond a ratio of 1e6, force", 1e-5, 6.6e-6),
];

/// `reference/ball_screw_reference.rs`: against another program's stored states (rules of 48 points), relative where no unit is
/// given; contacts in N, degrees, rad/s, mm/s, N mm and mW.
#[rustfmt::skip]
const SCREW_REFERENCE: &[Measured] = &[
    largest("single balls of a screw, speed ratio", 1.9e-9, 6.3e-10),
    largest("single balls of a screw, positions in um", 2.4e-9, 7.9e-10),
    largest("single balls of a screw, spin in rad/s", 5e-8, 3.2e-8),
    largest("single balls of a screw, loss", 5e-10, 1.7e-10),
    largest("single balls of a screw, contacts", 2e-7, 1.3e-7),
    largest("single balls of a screw, power balance", 1.4e-11, 4.4e-12),
    largest("pairs of a screw, contact force in N", 3.5e-8, 2.3e-8),
    largest("pairs of a screw, losses", 2.5e-8, 1.4e-8),
    largest("pairs of a screw, positions in um", 1.2e-8, 7.8e-9),
    largest("pairs of a screw, orbital speed in rad/s", 8e-9, 5e-9),
    largest("pairs of a screw, spin in rad/s", 7e-8, 4.6e-8),
    largest("pairs of a screw, missing power", 5e-3, 2.5e-3),
    largest("pairs of a screw, contact force by the other slip", 1.5e-5, 8.4e-6),
    largest("given contacts, orbital speed", 9.3e-10, 3.1e-10),
    largest("given contacts, orbital speed by impedances", 1e-6, 3.5e-7),
    largest("elastic pair, contact force in N", 3e-7, 1.8e-7),
    largest("given contacts, contact force", 7e-3, 4.1e-3),
    largest("train of a screw, power balance", 1.7e-13, 5.4e-14),
    largest("reversed train of a screw", 9e-3, 6e-3),
    largest("given contacts, balance in N", 9.3e-14, 3.1e-14),
    largest("given contacts, power balance", 2.7e-13, 8.9e-14),
    largest("two contacts of a screw, gap over loss", 1.3e-10, 4.1e-11),
    largest("closed forms of a screw, contact force", 0.02, 7.1e-3),
    largest("closed forms of a screw, groove loss", 0.05, 0.043),
    largest("closed forms of a screw, orbital speed", 8e-3, 3.7e-3),
    largest("hostile balls of a screw, power balance", 2.5e-9, 1.5e-9),
    largest("single balls of a screw, balance over the load", 6e-13, 2e-13),
    largest("given contacts, moment in N m", 2.2e-16, 7.1e-17),
];

/// `reference/chain_reference.rs`: speed deviations in units of half the track speed.
#[rustfmt::skip]
const CHAIN_REFERENCE: &[Measured] = &[
    largest("stored chains, contact force in N", 6.3e-10, 2.1e-10),
    largest("stored chains, speed deviation", 3.9e-13, 1.3e-13),
    largest("stored chains, closed form", 5.4e-15, 1.8e-15),
    largest("chains three ways, speed", 2.7e-14, 9e-15),
    largest("chains three ways, force", 4.8e-14, 1.6e-14),
    largest("stored pairs, stuck true, contact force in N", 2e-4, 8e-5),
    largest("stored pairs, stuck true, speed deviation", 3e-7, 1.8e-7),
    largest("stored pairs, stuck false, contact force in N", 5e-9, 1.9e-9),
    largest("stored pairs, stuck false, speed deviation", 1e-11, 5.3e-12),
    largest("balance of stored chains in N", 1.2e-12, 3.9e-13),
    largest("balance of stored pairs in N", 1.6e-12, 5.2e-13),
    largest("balance of sticking pairs in N", 1.5e-6, 9.5e-7),
    largest("balance of reversed pairs in N", 8.1e-14, 2.7e-14),
    largest("balance of rough pairs in N", 3.6e-13, 1.2e-13),
    largest("balance of long chains in N", 7.8e-13, 2.6e-13),
    largest("balance of chains at the switch in N", 3.5e-6, 2.2e-6),
];

/// `reference/linear_ball_reference.rs`: speed deviations in units of half the track speed.
#[rustfmt::skip]
const LINEAR_REFERENCE: &[Measured] = &[
    largest("stored linear balls, load in N", 1.3e-13, 4.3e-14),
    largest("stored sticking balls, speed deviation", 5e-8, 3e-8),
    largest("stored linear balls, speed deviation", 1.8e-13, 5.7e-14),
    largest("stored linear balls, loss in N", 3.3e-12, 1.1e-12),
    largest("stored linear balls, offset", 1.3e-11, 4.2e-12),
    largest("stored linear balls, friction in N", 5.4e-11, 1.8e-11),
    largest("stored linear balls, moment in N m", 5.1e-15, 1.7e-15),
    largest("stored linear balls, closed form", 5.4e-17, 1.8e-17),
    largest("closed form with the exact slope, contact force in N", 8e-4, 5.1e-4),
    largest("factor of the contact angle", 9e-3, 5.9e-3),
    largest("two-point contact, gap in W", 5e-9, 3.1e-9),
    largest("switch to rolling", 1e-5, 6.5e-6),
    largest("balance of slipping linear balls", 1.3e-12, 4.1e-13),
    largest("balance of sticking linear balls", 2.5e-7, 1.4e-7),
];

/// `reference/rotary_reference.rs`, relative where no unit is given.
#[rustfmt::skip]
const ROTARY_REFERENCE: &[Measured] = &[
    largest("stored Hertz constants", 4.8e-15, 1.6e-15),
    largest("stored rotary cases, torque", 1.2e-13, 3.9e-14),
    largest("rotary torque from its own loads", 4.5e-14, 1.5e-14),
    largest("rotary torque by the physical radii", 1e-3, 9.2e-4),
    largest("rotary ball, force along the track in N", 1.5e-6, 8.9e-7),
    largest("rotary ball, power balance", 7.8e-11, 2.6e-11),
    largest("rotary ball, axial load", 5e-9, 3.1e-9),
];

/// `reference/friction_maps_reference.rs`: forces over their limit, moments over that and the semi-major axis.
#[rustfmt::skip]
const MAPS_REFERENCE: &[Measured] = &[
    largest("friction maps, coefficients", 6.9e-16, 2.3e-16),
    largest("line integral, force", 6.9e-15, 2.3e-15),
    largest("line integral, moment", 2e-14, 6.7e-15),
    largest("line integral, power", 9.6e-15, 3.2e-15),
    largest("line integral, slope", 6.9e-15, 2.3e-15),
    largest("area quadrature, maps", 8.7e-13, 2.9e-13),
    largest("area quadrature, any direction", 1.1e-12, 3.6e-13),
    largest("reduction and maps", 3.3e-15, 1.1e-15),
    largest("friction of the contacts of a screw", 2e-7, 1.1e-7),
    largest("power of a contact, homogeneous", 4.8e-15, 1.6e-15),
    largest("Hessian of a contact along its velocity", 1.9e-15, 6.3e-16),
    largest("Hessian of a contact by differences", 3e-9, 2e-9),
    largest("friction maps, force", 6e-16, 2e-16),
    largest("friction maps, moment", 1.5e-14, 4.7e-15),
    largest("friction maps, power", 2.6e-15, 8.5e-16),
    largest("friction maps, slope", 1.4e-15, 4.5e-16),
];

/// `reference/curvature_reference.rs`, relative.
#[rustfmt::skip]
const CURVATURE_REFERENCE: &[Measured] = &[
    largest("Appendix B as printed", 6.9e-16, 2.3e-16),
    largest("Appendix B as corrected", 8.7e-15, 2.9e-15),
];

/// `reference/kinematics_reference.rs`: slips over the entrainment speed, the rest relative.
#[rustfmt::skip]
const KINEMATICS_REFERENCE: &[Measured] = &[
    largest("golden kinematics", 2.3e-15, 7.6e-16),
    largest("rolling slip, its own digits", 1e-12, 3.6e-13),
    largest("bearing of zero lead, speeds", 2.4e-15, 7.8e-16),
    largest("bearing of zero lead, spin", 8.7e-16, 2.9e-16),
    largest("sum of both side slips", 9e-16, 3e-16),
    largest("sum of both spins", 3.9e-16, 1.3e-16),
    largest("equal contact angles, orbital speed", 6.9e-16, 2.3e-16),
    largest("equal contact angles, rolling speed", 2e-15, 6.7e-16),
    largest("equal contact angles, side slip", 2.5e-16, 8.4e-17),
    largest("traditional formula, slip", 1.4e-15, 4.6e-16),
    largest("traditional formula, spin", 5.1e-16, 1.7e-16),
    largest("golden mean slip", 1e-4, 5.4e-5),
    largest("moments of the Hertz weight", 1.8e-14, 5.8e-15),
    largest("mean slip of pure spin", 1.5e-7, 9.2e-8),
    largest("loss of the published screw in W", 2e-5, 9.6e-6),
    largest("parts of the mean slip", 2.4e-15, 7.8e-16),
    largest("loss over the pitch angle", 0.035, 0.033),
    largest("golden raceway controls in rad", 1.4e-15, 4.5e-16),
    largest("ellipses of the published screw", 1e-15, 3.4e-16),
    largest("contact angle of the published screw in degrees", 0.01, 7.2e-3),
    largest("entrainment speed over the rolling radius", 2e-3, 1.2e-3),
    largest("material points", 1.1e-14, 3.5e-15),
];

/// `reference/rolling_ball.rs`: what the integration and the smoothing of friction leave.
#[rustfmt::skip]
const ROLLING_BALL: &[Measured] = &[
    largest("rolling ball, tabulated", 6.9e-11, 2.3e-11),
    largest("rolling ball, drift", 1.3e-10, 4.1e-11),
    largest("rolling ball, smoothing of 1e-3", 1.2e-7, 8.3e-8),
    largest("driven nut, efficiency", 2e-8, 1.1e-8),
];

/// `reference/statics.rs`: residuals of the iterations, and another program's loads.
#[rustfmt::skip]
const STATICS: &[Measured] = &[
    largest("independent statics, forces over the load", 3.3e-12, 1.1e-12),
    largest("independent statics, axial displacement", 3.5e-10, 1.2e-10),
    largest("independent statics, contact angle in rad", 6e-12, 2e-12),
    largest("independent statics, geometric errors in N", 5e-5, 2.7e-5),
    largest("golden Hertz constants", 6.9e-12, 2.3e-12),
    largest("loads by the printed curvatures", 1.1e-3, 5.9e-4),
    largest("energy by differences, nodes", 8e-7, 5.2e-7),
    largest("energy by differences, balls", 1.5e-7, 8.3e-8),
    largest("balance of the case studies, residual in N", 1.5e-12, 4.9e-13),
    largest("screw of twice the size, forces in N", 6e-11, 2e-11),
    largest("ring of zero lead, forces", 3e-15, 1e-15),
    largest("two-point statics in closed form", 2.2e-13, 7.3e-14),
    largest("loads of every kind, residual in N", 1.2e-11, 3.9e-12),
    largest("profile offset, forces in N", 1.7e-12, 5.6e-13),
];

/// `reference/statics_studies.rs`.
#[rustfmt::skip]
const STATICS_STUDIES: &[Measured] = &[
    largest("lash of an independent solver", 4e-3, 3.2e-3),
    largest("tie rod, residual over the load", 9e-9, 5.7e-9),
    largest("tie rod, forces in N", 1.5e-4, 8.3e-5),
    largest("tie rod, rack load", 8.4e-12, 2.8e-12),
    largest("long nuts, residual in N", 1.5e-12, 4.9e-13),
];

/// `reference/steady_state.rs`: efficiencies, absolute.
#[rustfmt::skip]
const STEADY_STATE: &[Measured] = &[
    largest("steady state, closed form", 8e-6, 5.1e-6),
    largest("steady state, error over the square of the speed", 4e-3, 2.5e-3),
    largest("stored coefficient of inertia", 6.9e-16, 2.3e-16),
    largest("steady state, 2000 rpm, 2113 N, closed form", 1.5e-5, 1.4e-5),
    largest("steady state, 2000 rpm, 2113 N, corrected", 7e-9, 6.3e-9),
    largest("steady state, 10000 rpm, 2113 N, closed form", 3.6e-4, 3.5e-4),
    largest("steady state, 10000 rpm, 2113 N, corrected", 6.5e-6, 5.9e-6),
    largest("steady state, 2000 rpm, 21.13 N, closed form", 1.5e-3, 1.4e-3),
    largest("steady state, 2000 rpm, 21.13 N, corrected", 1.1e-4, 6.4e-5),
    largest("steady state, 10000 rpm, 211.3 N, closed form", 3.5e-3, 3.3e-3),
    largest("steady state, 10000 rpm, 211.3 N, corrected", 6e-4, 4.8e-4),
    largest("steady state, 10000 rpm, 21.13 N, closed form", 0.034, 0.026),
    largest("steady state, 10000 rpm, 21.13 N, corrected", 0.016, 0.014),
    largest("steady state, eta", 1.4e-15, 4.5e-16),
    largest("steady state, torque", 1.4e-15, 4.5e-16),
    largest("steady state, Q_A", 1.4e-15, 4.5e-16),
    largest("steady state, Q_B", 1.7e-15, 5.6e-16),
    largest("steady state, Q_Ap", 5.4e-15, 1.8e-15),
    largest("steady state, omega_n", 2.7e-15, 8.9e-16),
    largest("steady state, omega_t", 1.9e-14, 6.3e-15),
    largest("steady state, psi_A", 6.9e-16, 2.3e-16),
    largest("steady state, psi_B", 6e-15, 2e-15),
    largest("steady state, slip_A", 1.9e-14, 6.3e-15),
    largest("steady state, slip_B", 6e-15, 2e-15),
];

/// `reference/whole_screw_reference.rs`, relative where no unit is given.
#[rustfmt::skip]
const WHOLE_SCREW_REFERENCE: &[Measured] = &[
    largest("whole screw, stored groove torque", 5e-7, 3e-7),
    largest("whole screw, stored ball torque in N mm", 5e-3, 3.8e-3),
    largest("whole screw, torque by the relative slip", 0.01, 5.3e-3),
    largest("whole screw, groove torque over a turn", 4e-4, 1.9e-4),
    largest("whole screw, eight steps", 1.5e-3, 9.9e-4),
    largest("whole screw, one step", 9e-3, 5.7e-3),
];

/// `formulas/math_sweeps.rs`: over the bound of the largest error.
#[rustfmt::skip]
const SINES: &[Measured] = &[
    largest("sine and cosine, rms over the bound", 0.12, 0.072),
    largest("sine and cosine, mean over the bound", 2.5e-3, 1.5e-3),
];

/// `stiffness`, relative; coefficients of friction over the difference of the boundary's and the film's.
#[rustfmt::skip]
const STIFFNESS: &[Measured] = &[
    row("stiffness of a contact, across", [6.6e-6, 3.5e-6, 5e-7], [4.4e-6, 2.3e-6, 1.5e-7]),
    row("stiffness of a contact, along", [7.2e-6, 3.9e-6, 5e-7], [4.8e-6, 2.6e-6, 1.4e-7]),
    row("stiffness of a contact, torsion", [2.6e-5, 1.5e-5, 1.2e-6], [1.7e-5, 1.0e-5, 3.8e-7]),
    row("every catalogue size, slip", [5.4e-7, 2.4e-7, 9e-8], [1.8e-7, 7.9e-8, 3.0e-8]),
    row("every catalogue size, slip stiffness", [4.5e-6, 3.7e-6, 3.6e-6], [2.9e-6, 2.4e-6, 2.4e-6]),
    row("every catalogue size, spin", [7.5e-6, 7e-6, 6.8e-6], [4.9e-6, 4.5e-6, 4.5e-6]),
    row("every catalogue size, spin stiffness", [1.5e-5, 1.3e-5, 1.3e-5], [1.2e-5, 1.2e-5, 1.2e-5]),
    row("every catalogue size, drift", [3.5e-6, 1.5e-6, 1.1e-6], [2.3e-6, 1.0e-6, 7.3e-7]),
    row("torque of slip and of spin over their sum", [2e-4, 4.2e-5, 5e-6], [1.3e-4, 2.8e-5, 1.4e-6]),
    row("torque by mechanisms over that of exact balls", [0.34, 0.09, 0.03], [0.32, 0.076, 0.028]),
    row("rational form of the coefficient, 20 C", [0.069, 0.04, 0.014], [0.068, 0.039, 0.013]),
    row("rational form and viscosity, -40 to -20 C", [0.058, 0.015, 0.007], [0.057, 0.014, 6.4e-3]),
];

/// `formulas/rolling.rs`, relative.
#[rustfmt::skip]
const ROLLING: &[Measured] = &[
    row("rolling resistance, hysteresis", [5.7e-6, 4.1e-6, 3.5e-6], [3.8e-6, 2.7e-6, 2.3e-6]),
    row("rolling resistance, lubricant", [3e-7, 1.5e-7, 1.1e-7], [1.2e-7, 7.8e-8, 7.3e-8]),
    row("rolling resistance, both", [3.3e-6, 7.5e-7, 4e-7], [2.2e-6, 5.0e-7, 2.1e-7]),
];

/// `scenes/memory/coefficients.rs`: friction torque, relative.
#[rustfmt::skip]
const FRICTION_TORQUE: &[Measured] = &[
];

/// `law/golden.rs`: friction over the limit, by the number of elements.
#[rustfmt::skip]
const LOOPS: &[Measured] = &[
    row("random loops, slip4", [3.4e-2, 8e-3, 1e-3], [3.3e-2, 7.7e-3, 2.4e-4]),
    row("random loops, slip6", [1.7e-2, 3.8e-3, 1e-3], [1.6e-2, 3.7e-3, 2.3e-4]),
    row("random loops, slip8", [9.8e-3, 2.3e-3, 3e-4], [9.6e-3, 2.2e-3, 5.6e-5]),
    row("random loops, slip10", [6.3e-3, 1.5e-3, 3e-4], [6.1e-3, 1.4e-3, 6.3e-5]),
    row("random loops, spin4", [0.11, 2.6e-2, 1e-3], [0.10, 2.5e-2, 3.4e-4]),
    row("random loops, spin6", [5.2e-2, 1.2e-2, 2e-3], [5.1e-2, 1.1e-2, 1.1e-3]),
    row("random loops, spin8", [3.1e-2, 6.8e-3, 1e-3], [3.0e-2, 6.6e-3, 3.5e-4]),
    row("random loops, spin10", [2.3e-2, 4.8e-3, 3e-4], [2.2e-2, 4.6e-3, 6.7e-5]),
];

/// `reference/ball_screw_ring_reference.rs`, relative where no unit is given.
#[rustfmt::skip]
const RING_REFERENCE: &[Measured] = &[
    largest("ring, residual", 6e-9, 4e-9),
    largest("ring, balance of power", 6.3e-9, 2.1e-9),
    largest("ring, complementarity", 1e-12, 0.0),
    largest("ring, places in rad", 6.3e-14, 2.1e-14),
    largest("ring, speeds of touching balls", 1e-12, 0.0),
    largest("ring, distances all around", 2e-15, 6.7e-16),
    largest("ring of balls alike, force in N", 1e-11, 0.0),
    largest("ring of balls alike, ball torque in N m", 1e-14, 0.0),
    largest("ring of balls alike, speed", 1e-14, 0.0),
    largest("ring of balls alike, groove torque", 1.3e-13, 4.1e-14),
    largest("ring as a row, force in N", 5.1e-10, 1.7e-10),
    largest("ring as a row, speed", 1.6e-12, 5.2e-13),
    largest("ring as a row, loads in N", 5.1e-11, 1.7e-11),
    largest("ring as a row, groove torque", 1.1e-12, 3.5e-13),
    largest("ring as a row, ball torque", 3.3e-11, 1.1e-11),
    largest("mirrored ring, torque", 4.5e-14, 1.5e-14),
    largest("mirrored ring, force in N", 2e-13, 6.6e-14),
    largest("ring at other speeds, angle in rad", 2.1e-15, 6.7e-16),
    largest("ring at other speeds, torque", 3.9e-14, 1.3e-14),
    largest("ring with a return, carried load", 0.2, 0.13),
    largest("ring, force that points outward", 2e-2, 1.3e-2),
    largest("ring in 20 steps, places in rad", 1e-3, 9.5e-4),
    largest("ring without lead, torque", 1.2e-13, 3.9e-14),
];

/// `reference/ball_screw_row_reference.rs`, relative where no unit is given.
#[rustfmt::skip]
const ROW_REFERENCE: &[Measured] = &[
    largest("stored rows, 32 nodes: force in N", 1.7e-8, 5.6e-9),
    largest("stored rows, 32 nodes: force", 1.8e-8, 6.0e-9),
    largest("stored rows, 32 nodes: speed over the nut's", 1.5e-9, 5.0e-10),
    largest("stored rows, 32 nodes: loads in N", 1.5e-6, 4.9e-7),
    largest("stored rows, 32 nodes: torque", 1.4e-8, 4.4e-9),
    largest("stored rows, exact: force in N", 4e-4, 2.8e-4),
    largest("stored rows, exact: force", 5e-3, 4.1e-3),
    largest("stored rows, exact: speed over the nut's", 4.7e-6, 3.1e-6),
    largest("stored rows, exact: loads in N", 6e-4, 4.2e-4),
    largest("stored rows, exact: torque", 7.5e-6, 5.0e-6),
    largest("row of balls alike, force in N", 1e-11, 0.0),
    largest("mirrored row, force in N", 1e-10, 0.0),
    largest("mirrored row, loads in N", 1e-10, 0.0),
    largest("row of one and elastic balls, speed", 2.1e-12, 6.7e-13),
    largest("row of one and elastic balls, power loss", 1.3e-9, 4.3e-10),
    largest("row of one and elastic balls, place in m", 6.3e-16, 2.1e-16),
    largest("row with friction of balls, balance of power", 1e-9, 3.4e-10),
    largest("row with friction of balls, change of force", 1.1e-2, 6.9e-3),
    largest("row, loss over a friction that vanishes", 4.4e-2, 2.9e-2),
    largest("random rows, residual", 8.7e-8, 2.9e-8),
    largest("random rows, balance of power", 1e-8, 3.8e-9),
    largest("random rows, balance of forces in N", 1.5e-8, 4.9e-9),
    largest("random rows, speeds of touching balls", 1e-11, 0.0),
];

/// `reference/linear_ball_reference.rs`: speeds over the track's, power in W.
#[rustfmt::skip]
const LINEAR_MIRRORED: &[Measured] = &[
    largest("symmetrical linear balls, sum of deviations", 1e-15, 0.0),
    largest("mated groove, speed deviation", 3.3e-16, 1.1e-16),
    largest("mirrored linear ball, speed", 1e-15, 0.0),
    largest("mirrored linear ball, deviation", 1e-15, 0.0),
    largest("mirrored linear ball, power", 1e-14, 0.0),
    largest("mirrored linear ball, force in N", 1e-13, 0.0),
    largest("mirrored linear ball, slip", 1e-15, 0.0),
    largest("linear ball, power over friction", 6.6e-16, 2.2e-16),
];

/// `formulas/friction_map.rs`: roundings.
#[rustfmt::skip]
const MAP_ROUNDINGS: &[Measured] = &[
    largest("friction map inside the contact", 3e-7, 2.8e-7),
    largest("friction map, tabulated spin moment", 1.9e-7, 6.3e-8),
    largest("friction map, tabulated slope", 4e-7, 2.2e-7),
];

/// `law/elements.rs` and `law/seat.rs`, relative: roundings of f32.
#[rustfmt::skip]
const ELEMENTS: &[Measured] = &[
    largest("elements, initial stiffness", 3.6e-7, 1.2e-7),
    largest("seat, place of sliding", 1.2e-7, 0.0),
    largest("spin in the seat's play", 1.2e-7, 0.0),
    largest("spin beside the seat, limit", 1e-7, 6.0e-8),
    largest("two halves of elements", 1.2e-7, 0.0),
];

/// `scenes/uncaged.rs` and `scenes/stiff.rs`: shares and efficiencies, absolute.
#[rustfmt::skip]
const UNCAGED_SCENE: &[Measured] = &[
    largest("quarter of a turn, ball torque in N m", 1e-6, 0.0),
    largest("low speeds, friction over its share of the full", 1.001, 1.0),
    largest("screw without cage, efficiency", 1.1e-7, 3.5e-8),
];
