//! Bounds that are measured, not derived: what was found, and what is accepted, with room for another compiler or
//! other rounding. All sweeps give the same numbers in every run.

/// One measured quantity.
pub struct Measured {
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

/// Asserts that an error is at most what the row of its name accepts.
pub fn assert(name: &str, error: f64) {
    let [accepted, ..] = of(name).accepted;
    println!("{name}: {error:.1e}");
    assert!(
        error.abs() <= accepted,
        "{name}: {error:e}; accepted is {accepted:e}"
    );
}

/// The row of a name.
///
/// # Panics
/// Where there is none or more than one, or less is accepted than was found.
pub fn of(name: &str) -> &'static Measured {
    let mut rows = TABLES
        .iter()
        .flat_map(|table| table.iter())
        .filter(|row| row.name == name);
    let row = rows
        .next()
        .unwrap_or_else(|| panic!("{name} is not in kit/measured.rs"));
    assert!(rows.next().is_none(), "{name} stands twice");
    for (accepted, found) in row.accepted.iter().zip(row.found) {
        assert!(found <= *accepted, "{name}: {found:e} above {accepted:e}");
    }
    row
}

const TABLES: &[&[Measured]] = &[SCREW_BALL, SLIP_MAP, FRICTION_MAP, UNCAGED, LINEAR_BALL];

/// `balls/screw_ball.rs`: orbital speeds over the nut's, the rest relative; forces of given pairs over the largest force
/// that friction lets a ball hold along the track.
#[rustfmt::skip]
const SCREW_BALL: &[Measured] = &[
    row("vanishing loads, third contact", [1e-4, 3e-5, 3e-6], [6.4e-5, 1.5e-5, 2.4e-7]),
    row("vanishing loads, two contacts", [1e-6, 3e-7, 2e-7], [1.2e-7, 3.6e-8, 3.2e-9]),
    row("10 N, SR-NL, pinning: closed form", [0.035, 0.028, 0.0245], [6e-3, 4e-3, 3.5e-3]),
    row("10 N, SR-NL, pinning: refined", [0.03, 0.027, 0.024], [7.7e-3, 7.5e-3, 7.5e-3]),
    row("10 N, SR-NL, opposite: closed form", [0.13, 0.104, 0.091], [0.1, 0.057, 0.045]),
    row("10 N, SR-NL, opposite: refined", [0.06, 0.054, 0.048], [0.04, 0.022, 0.018]),
    row("10 N, SL-NR, pinning: closed form", [0.035, 0.028, 0.0245], [0.031, 0.021, 0.018]),
    row("10 N, SL-NR, pinning: refined", [0.03, 0.027, 0.024], [0.021, 0.012, 6.3e-3]),
    row("10 N, SL-NR, opposite: closed form", [0.13, 0.104, 0.091], [0.11, 0.063, 0.053]),
    row("10 N, SL-NR, opposite: refined", [0.06, 0.054, 0.048], [0.042, 0.027, 0.025]),
    row("25 N, SR-NL, pinning: closed form", [0.035, 0.028, 0.0245], [0.013, 8e-3, 4.7e-3]),
    row("25 N, SR-NL, pinning: refined", [0.03, 0.027, 0.024], [0.015, 0.014, 0.013]),
    row("25 N, SR-NL, opposite: closed form", [0.25, 0.2, 0.175], [0.21, 0.11, 0.078]),
    row("25 N, SR-NL, opposite: refined", [0.18, 0.162, 0.144], [0.15, 0.078, 0.054]),
    row("25 N, SL-NR, pinning: closed form", [0.035, 0.028, 0.0245], [0.032, 0.019, 0.012]),
    row("25 N, SL-NR, pinning: refined", [0.03, 0.027, 0.024], [0.018, 0.012, 5.2e-3]),
    row("25 N, SL-NR, opposite: closed form", [0.25, 0.2, 0.175], [0.18, 0.099, 0.08]),
    row("25 N, SL-NR, opposite: refined", [0.18, 0.162, 0.144], [0.12, 0.067, 0.055]),
    row("50 N, SR-NL, pinning: closed form", [0.03, 0.024, 0.021], [0.015, 0.011, 9.5e-5]),
    row("50 N, SR-NL, pinning: refined", [0.04, 0.036, 0.032], [0.025, 0.021, 0.02]),
    row("50 N, SR-NL, opposite: closed form", [0.5, 0.4, 0.35], [0.44, 0.24, 0.17]),
    row("50 N, SR-NL, opposite: refined", [0.45, 0.405, 0.36], [0.38, 0.2, 0.14]),
    row("50 N, SL-NR, pinning: closed form", [0.03, 0.024, 0.021], [0.026, 0.019, 3.4e-4]),
    row("50 N, SL-NR, pinning: refined", [0.04, 0.036, 0.032], [0.034, 0.023, 0.019]),
    row("50 N, SL-NR, opposite: closed form", [0.5, 0.4, 0.35], [0.42, 0.23, 0.17]),
    row("50 N, SL-NR, opposite: refined", [0.45, 0.405, 0.36], [0.35, 0.19, 0.14]),
    row("100 N, SR-NL, pinning: closed form", [0.08, 0.064, 0.056], [0.048, 0.037, 6.5e-3]),
    row("100 N, SR-NL, pinning: refined", [0.09, 0.081, 0.072], [0.06, 0.042, 0.023]),
    row("100 N, SR-NL, opposite: closed form", [1.1, 0.88, 0.77], [0.94, 0.58, 0.49]),
    row("100 N, SR-NL, opposite: refined", [1.0, 0.9, 0.8], [0.83, 0.52, 0.45]),
    row("100 N, SL-NR, pinning: closed form", [0.08, 0.064, 0.056], [0.071, 0.048, 0.019]),
    row("100 N, SL-NR, pinning: refined", [0.09, 0.081, 0.072], [0.081, 0.054, 0.035]),
    row("100 N, SL-NR, opposite: closed form", [1.1, 0.88, 0.77], [1.0, 0.62, 0.54]),
    row("100 N, SL-NR, opposite: refined", [1.0, 0.9, 0.8], [0.87, 0.56, 0.49]),
    row("four contacts, 1 degree, orbital speed after 0 steps", [9e-4, 2e-4, 1.4e-4], [7.5e-4, 1.3e-4, 1.5e-5]),
    row("four contacts, 1 degree, orbital speed after 1 steps", [1e-4, 3e-5, 2.1e-5], [3.5e-5, 8.3e-6, 9.5e-7]),
    row("four contacts, 1 degree, orbital speed after 2 steps", [1e-4, 3e-5, 2.1e-5], [5.6e-5, 9e-6, 1e-6]),
    row("four contacts, 1 degree, orbital speed after 3 steps", [2e-5, 3e-6, 2.1e-6], [1.8e-6, 3.6e-7, 4.9e-8]),
    row("four contacts, 1 degree, orbital speed after 4 steps", [3e-6, 6e-7, 4.2e-7], [8.1e-7, 2e-7, 6.1e-8]),
    row("four contacts, 1 degree, orbital speed after 5 steps", [2e-6, 5e-7, 3.5e-7], [8.1e-7, 1.9e-7, 7.9e-8]),
    row("four contacts, 1 degree, groove torque after 0 steps", [0.07, 0.02, 0.014], [0.046, 8.6e-3, 3.4e-3]),
    row("four contacts, 1 degree, groove torque after 1 steps", [0.05, 8e-3, 5.6e-3], [0.037, 5.9e-3, 1.3e-3]),
    row("four contacts, 1 degree, groove torque after 2 steps", [0.05, 7e-3, 4.9e-3], [0.036, 5.8e-3, 7.4e-4]),
    row("four contacts, 1 degree, groove torque after 3 steps", [2e-3, 3e-4, 2.1e-4], [8.5e-4, 1.6e-4, 3.5e-5]),
    row("four contacts, 1 degree, groove torque after 4 steps", [3e-4, 1e-4, 7e-5], [6.6e-5, 2.9e-5, 2.1e-6]),
    row("four contacts, 1 degree, groove torque after 5 steps", [3e-4, 1e-4, 7e-5], [6.6e-5, 2.9e-5, 1.1e-6]),
    row("four contacts, 3 degrees, orbital speed after 0 steps", [7e-3, 2e-3, 1.4e-3], [6e-3, 1.2e-3, 1.7e-4]),
    row("four contacts, 3 degrees, orbital speed after 1 steps", [8e-4, 2e-4, 1.4e-4], [6.1e-4, 1.3e-4, 2.9e-5]),
    row("four contacts, 3 degrees, orbital speed after 2 steps", [1e-4, 3e-5, 2.1e-5], [6.6e-5, 1.7e-5, 6.9e-7]),
    row("four contacts, 3 degrees, orbital speed after 3 steps", [3e-5, 5e-6, 3.5e-6], [7.3e-6, 1.5e-6, 6e-7]),
    row("four contacts, 3 degrees, orbital speed after 4 steps", [1e-5, 2e-6, 1.4e-6], [3.4e-6, 8.5e-7, 4.4e-7]),
    row("four contacts, 3 degrees, orbital speed after 5 steps", [1e-5, 2e-6, 1.4e-6], [3.4e-6, 8.4e-7, 4.7e-7]),
    row("four contacts, 3 degrees, groove torque after 0 steps", [0.11, 0.03, 0.021], [0.094, 0.018, 7.1e-3]),
    row("four contacts, 3 degrees, groove torque after 1 steps", [0.05, 0.01, 7e-3], [0.036, 7.9e-3, 2.4e-3]),
    row("four contacts, 3 degrees, groove torque after 2 steps", [0.05, 8e-3, 5.6e-3], [0.036, 5.9e-3, 5.9e-4]),
    row("four contacts, 3 degrees, groove torque after 3 steps", [2e-3, 5e-4, 3.5e-4], [1.3e-3, 2.3e-4, 5.6e-5]),
    row("four contacts, 3 degrees, groove torque after 4 steps", [6e-4, 2e-4, 1.4e-4], [2.3e-4, 7.8e-5, 8.6e-6]),
    row("four contacts, 3 degrees, groove torque after 5 steps", [6e-4, 2e-4, 1.4e-4], [2.3e-4, 7.8e-5, 6.6e-6]),
    row("given pairs, contact force, closed form", [0.06, 0.015, 0.0105], [0.04, 8.6e-3, 3.5e-3]),
    row("given pairs, contact force after 1 step", [0.03, 5e-3, 3.5e-3], [0.017, 3.7e-3, 1.3e-3]),
    row("given pairs, contact force after 2 steps", [4e-3, 6e-4, 4.2e-4], [2.3e-3, 3.9e-4, 8.7e-5]),
    row("given pairs, contact force after 3 steps", [2e-4, 3e-5, 2.1e-5], [6.9e-5, 1.5e-5, 3.3e-6]),
    row("given pairs, contact force after 4 steps", [1e-4, 2e-5, 1.4e-5], [3.3e-5, 9.8e-6, 1.6e-6]),
    row("given pairs, contact force after 5 steps", [1e-4, 2e-5, 1.4e-5], [3.3e-5, 9e-6, 1.1e-6]),
    row("given pairs, power loss after 5 steps", [3e-4, 1e-4, 2e-5], [1.2e-4, 5.1e-5, 7.6e-6]),
    row("row, orbital speed", [4e-7, 1e-7, 1e-7], [1.3e-7, 5.6e-8, 4.4e-8]),
    row("row, compliance, mean load", [0.01, 3e-3, 3e-3], [3.8e-3, 9.9e-4, 5.9e-4]),
    row("row, compliance, shares 0.1 to 3", [0.08, 0.03, 0.03], [0.056, 0.019, 0.012]),
    row("row, groove torque, mean load", [0.01, 3e-3, 3e-3], [6.2e-3, 1.6e-3, 3.6e-4]),
    row("row, groove torque, shares 0.1 to 3", [0.15, 0.05, 0.05], [0.12, 0.036, 0.015]),
    row("row, main load", [5e-3, 2e-3, 2e-4], [2.9e-3, 7.8e-4, 5.3e-5]),
    row("row, third load", [0.08, 0.03, 3e-3], [0.059, 0.016, 1.2e-3]),
    row("row, rubbing", [4e-7, 2e-7, 1e-7], [2.6e-7, 1.3e-7, 2.2e-8]),
    row("stored pairs, orbital speed, closed form", [1.4e-3, 5e-4, 2e-4], [1.3e-3, 3.8e-4, 1.2e-4]),
    row("stored pairs, orbital speed after 3 steps", [3e-7, 2e-7, 2e-7], [2.4e-7, 1.1e-7, 6.1e-8]),
    row("stored pairs, contact force, closed form", [0.19, 0.09, 0.09], [0.18, 0.085, 0.06]),
    row("stored pairs, contact force after 1 step", [0.023, 0.012, 0.012], [0.02, 8.1e-3, 3.2e-3]),
    row("stored pairs, contact force after 2 steps", [5e-3, 3e-3, 3e-3], [4.2e-3, 2.2e-3, 1.9e-3]),
    row("stored pairs, contact force after 3 steps", [5e-3, 3e-3, 3e-3], [4.1e-3, 2.2e-3, 1.9e-3]),
    row("load of the main contacts", [0.03, 0.02, 0.02], [0.025, 0.017, 0.015]),
    row("load of the third contact", [0.3, 0.2, 0.2], [0.24, 0.16, 0.15]),
    row("third contact slides, from the start, orbital speed after 0 steps", [2e-3, 7e-4, 4.9e-4], [1.5e-3, 5e-4, 2e-5]),
    row("third contact slides, from the start, orbital speed after 1 steps", [2e-3, 3e-4, 2.1e-4], [9.5e-4, 2e-4, 1.2e-5]),
    row("third contact slides, from the start, orbital speed after 2 steps", [2e-3, 3e-4, 2.1e-4], [9.2e-4, 1.6e-4, 1.7e-5]),
    row("third contact slides, from the start, orbital speed after 3 steps", [2e-3, 3e-4, 2.1e-4], [9e-4, 1.5e-4, 1.4e-5]),
    row("third contact slides, from the start, orbital speed after 4 steps", [2e-3, 2e-4, 1.4e-4], [8.6e-4, 1.4e-4, 9.5e-6]),
    row("third contact slides, from the start, orbital speed after 5 steps", [2e-3, 2e-4, 1.4e-4], [7.7e-4, 1.3e-4, 5.2e-6]),
    row("third contact slides, from the start, groove torque after 0 steps", [0.02, 4e-3, 2.8e-3], [0.011, 2.5e-3, 1.4e-3]),
    row("third contact slides, from the start, groove torque after 1 steps", [0.01, 3e-3, 2.1e-3], [7.9e-3, 1.7e-3, 1.6e-4]),
    row("third contact slides, from the start, groove torque after 2 steps", [0.01, 2e-3, 1.4e-3], [5.4e-3, 1.3e-3, 5.6e-5]),
    row("third contact slides, from the start, groove torque after 3 steps", [0.01, 2e-3, 1.4e-3], [4.5e-3, 9.7e-4, 3.5e-5]),
    row("third contact slides, from the start, groove torque after 4 steps", [0.01, 1e-3, 7e-4], [4e-3, 6.4e-4, 4.1e-6]),
    row("third contact slides, from the start, groove torque after 5 steps", [0.01, 1e-3, 7e-4], [3.7e-3, 5.5e-4, 2.3e-5]),
    row("third contact pinned, orbital speed after 0 steps", [7e-4, 1e-4, 7e-5], [4.5e-4, 6.4e-5, 1.1e-6]),
    row("third contact pinned, orbital speed after 1 steps", [2e-4, 2e-5, 1.4e-5], [9e-5, 1.3e-5, 2e-7]),
    row("third contact pinned, orbital speed after 2 steps", [1e-4, 2e-5, 1.4e-5], [4.5e-5, 7.8e-6, 2.1e-7]),
    row("third contact pinned, orbital speed after 3 steps", [1e-4, 2e-5, 1.4e-5], [4.8e-5, 7.4e-6, 1.3e-7]),
    row("third contact pinned, orbital speed after 4 steps", [3e-5, 5e-6, 3.5e-6], [1.4e-5, 2.4e-6, 6.9e-8]),
    row("third contact pinned, orbital speed after 5 steps", [1e-5, 2e-6, 1.4e-6], [5.2e-6, 7.7e-7, 4.7e-9]),
    row("third contact pinned, groove torque after 0 steps", [0.05, 0.01, 7e-3], [0.037, 7.3e-3, 3e-3]),
    row("third contact pinned, groove torque after 1 steps", [0.04, 5e-3, 3.5e-3], [0.026, 3.5e-3, 7.6e-4]),
    row("third contact pinned, groove torque after 2 steps", [0.04, 6e-3, 4.2e-3], [0.025, 4.5e-3, 9.6e-4]),
    row("third contact pinned, groove torque after 3 steps", [0.02, 3e-3, 2.1e-3], [0.011, 1.9e-3, 4.7e-4]),
    row("third contact pinned, groove torque after 4 steps", [4e-3, 6e-4, 4.2e-4], [1.9e-3, 3.8e-4, 1.1e-4]),
    row("third contact pinned, groove torque after 5 steps", [6e-4, 2e-4, 1.4e-4], [3.2e-4, 1.1e-4, 3.5e-5]),
    row("third contact slides, from the closed form, orbital speed after 0 steps", [0.012, 3e-3, 2.1e-3], [9e-3, 2.5e-3, 1.4e-4]),
    row("third contact slides, from the closed form, orbital speed after 1 steps", [0.012, 3e-3, 2.1e-3], [8.2e-3, 2.2e-3, 1.6e-4]),
    row("third contact slides, from the closed form, orbital speed after 2 steps", [0.012, 3e-3, 2.1e-3], [8.1e-3, 2.1e-3, 2.3e-4]),
    row("third contact slides, from the closed form, orbital speed after 3 steps", [0.012, 3e-3, 2.1e-3], [6.8e-3, 1.8e-3, 2.7e-4]),
    row("third contact slides, from the closed form, orbital speed after 4 steps", [0.012, 3e-3, 2.1e-3], [6.2e-3, 1.3e-3, 1.8e-4]),
    row("third contact slides, from the closed form, orbital speed after 5 steps", [0.012, 3e-3, 2.1e-3], [6.1e-3, 1.1e-3, 1.5e-4]),
    row("third contact slides, from the closed form, groove torque after 0 steps", [0.08, 0.02, 0.014], [0.056, 0.016, 9.2e-3]),
    row("third contact slides, from the closed form, groove torque after 1 steps", [0.08, 0.02, 0.014], [0.055, 0.015, 7.4e-3]),
    row("third contact slides, from the closed form, groove torque after 2 steps", [0.08, 0.02, 0.014], [0.054, 0.014, 6.4e-3]),
    row("third contact slides, from the closed form, groove torque after 3 steps", [0.08, 0.02, 0.014], [0.045, 0.011, 5e-3]),
    row("third contact slides, from the closed form, groove torque after 4 steps", [0.08, 0.02, 0.014], [0.022, 5.5e-3, 2.2e-3]),
    row("third contact slides, from the closed form, groove torque after 5 steps", [0.08, 0.02, 0.014], [0.014, 3.4e-3, 1.1e-3]),
    row("two contacts, orbital speed after 0 steps", [4e-4, 7e-5, 4.9e-5], [5.4e-5, 8.9e-6, 1.2e-6]),
    row("two contacts, orbital speed after 1 steps", [4e-4, 7e-5, 4.9e-5], [2.4e-5, 7.9e-6, 4.3e-7]),
    row("two contacts, orbital speed after 2 steps", [4e-4, 7e-5, 4.9e-5], [4.2e-5, 1.5e-5, 4.8e-7]),
    row("two contacts, orbital speed after 3 steps", [4e-4, 7e-5, 4.9e-5], [6.3e-5, 2.2e-5, 7.7e-7]),
    row("two contacts, orbital speed after 4 steps", [4e-4, 7e-5, 4.9e-5], [8.6e-5, 3.1e-5, 1.3e-6]),
    row("two contacts, orbital speed after 5 steps", [4e-4, 7e-5, 4.9e-5], [1.2e-4, 4.2e-5, 2.3e-6]),
    row("two contacts, groove torque after 0 steps", [6e-4, 1e-4, 7e-5], [1.2e-4, 3.3e-5, 1.1e-5]),
    row("two contacts, groove torque after 1 steps", [0.01, 3e-3, 2.1e-3], [5.4e-3, 1.6e-3, 1.1e-3]),
    row("two contacts, groove torque after 2 steps", [0.01, 3e-3, 2.1e-3], [4.8e-3, 1.5e-3, 1.1e-3]),
    row("two contacts, groove torque after 3 steps", [0.01, 3e-3, 2.1e-3], [3.6e-3, 1.1e-3, 8.9e-4]),
    row("two contacts, groove torque after 4 steps", [0.01, 3e-3, 2.1e-3], [2.4e-3, 7.3e-4, 5.8e-4]),
    row("two contacts, groove torque after 5 steps", [0.01, 3e-3, 2.1e-3], [1.5e-3, 4.2e-4, 3.3e-4]),
];

/// `formulas/slip_map.rs`. Two terms of the far field are off by the largest error of the stiffness where it takes over.
#[rustfmt::skip]
const SLIP_MAP: &[Measured] = &[
    row("slip map, power, relative", [3e-4, 3e-5, 1e-6], [1.4e-4, 9.4e-6, 1.1e-7]),
    row("slip map, force over its limit", [5e-4, 3e-5, 1e-6], [3.1e-4, 1.2e-5, 1e-8]),
    row("slip map, moment over that of sliding at the semi-major axis", [5e-4, 3e-5, 1e-6], [3.1e-4, 1.5e-5, 1.4e-8]),
    row("slip map, stiffness over the sum of both", [6e-3, 3e-4, 1e-5], [3.7e-3, 1.8e-4, 2.2e-6]),
];

/// `formulas/friction_map.rs`: force over its limit, moment over that of spin alone, power over the largest of offset and
/// semi-major axis.
#[rustfmt::skip]
const FRICTION_MAP: &[Measured] = &[
    row("friction map, force", [8.2e-4, 1.4e-4, 1e-6], [7.8e-4, 1.3e-4, 0.0]),
    row("friction map, moment", [1.8e-3, 3.5e-4, 8e-5], [1.7e-3, 3.5e-4, 5.6e-5]),
    row("friction map, power", [2.5e-4, 3.1e-5, 1e-5], [2.4e-4, 3.0e-5, 2.5e-6]),
];

/// `scenes/uncaged.rs`, relative: groove torque; ball-to-ball torque and the largest force over their peaks; counts of
/// contacts.
///
/// Impedances of the row differ from the reference's by up to 0.3 %. Every contact that closes or opens makes a step of the
/// torque by up to a fifth of its peak; the states where it has done so in one of the two only, up to a dozen of 200, make
/// the largest error and most of the rms.
#[rustfmt::skip]
const UNCAGED: &[Measured] = &[
    largest("whole screw, groove torque", 1e-3, 6.3e-4),
    row("whole screw, ball torque", [0.25, 0.03, 0.005], [0.21, 0.016, 2.2e-3]),
    largest("whole screw, largest force", 0.2, 0.13),
    largest("whole screw, contacts apart", 2.0, 2.0),
    largest("whole screw, states with other contacts", 12.0, 8.0),
    largest("whole screw, work of normal forces over friction", 1e-4, 1.2e-5),
    largest("whole screw, rubbing of the pairs", 1e-4, 2.6e-7),
];

/// `balls/linear_ball.rs`: speed deviations in units of half the track speed, losses relative.
#[rustfmt::skip]
const LINEAR_BALL: &[Measured] = &[
    largest("four-point, (3.43)", 4.2e-3, 4.1e-3),
    largest("four-point, start", 4.1e-3, 4.1e-3),
    largest("four-point, +1", 1.5e-3, 1.4e-3),
    largest("four-point, +2", 1.5e-4, 2.5e-5),
    largest("four-point, +3", 2e-5, 2.3e-6),
    largest("four-point, loss", 1e-3, 2.7e-4),
    largest("next to the two-point switch, (3.43)", 2.5e-2, 2.1e-2),
    largest("next to the two-point switch, start", 7e-3, 5.6e-3),
    largest("next to the two-point switch, +1", 3e-3, 2.6e-3),
    largest("next to the two-point switch, +2", 5e-4, 3.5e-4),
    largest("next to the two-point switch, +3", 5e-4, 3.5e-4),
    largest("next to the two-point switch, loss", 2e-3, 1.8e-3),
    row("random linear ball, +3", [5e-5, 3e-6, 1e-6], [4.8e-6, 7.5e-7, 4.1e-8]),
    largest("random linear ball, loss", 1e-3, 2.9e-4),
    largest("swinging load, amplitude 0.6", 5e-5, 1.2e-6),
    largest("swinging load, amplitude 0.8", 3e-4, 5.4e-5),
    largest("swinging load, amplitude 0.85", 3e-4, 7.5e-5),
    largest("swinging load, amplitude 0.9", 2.5e-2, 1.8e-2),
];
