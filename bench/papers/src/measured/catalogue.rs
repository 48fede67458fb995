//! Rules that makers of ball screws print.

use std::f64::consts::PI;

const K: f64 = 0.018;

/// Share of the theoretical efficiency that is left in practice, with wipers and seals.
pub const PRACTICE: f64 = 0.9;

/// Theoretical efficiency of driving, `1/(1 + K d0/lead)` with `K = 0.018`, from diameter and lead in one unit: a
/// friction torque of `K/(2 pi) F d0`.
///
/// Source: SKF's catalogue of ball screws, from memory.
pub fn efficiency(diameter: f64, lead: f64) -> f64 {
    1.0 / (1.0 + K * diameter / lead)
}

/// Friction coefficients of the chart of efficiency over lead angle: a plain screw's efficiency `tan(angle)/tan(angle + atan(f))`.
///
/// Source: Rexroth's catalogue, seen.
pub const CHART_FRICTION: [f64; 2] = [0.005, 0.01];

/// Friction coefficient of the chart at which a plain screw has an efficiency.
pub fn chart_friction(lead_angle: f64, efficiency: f64) -> f64 {
    ((lead_angle.tan() / efficiency).atan() - lead_angle).tan()
}

/// Drag torque of a preloaded screw over `preload lead/2 pi`: `0.05 (tan lead angle)^-1/2`.
///
/// Source: JIS B 1192, from memory.
pub fn drag_coefficient(diameter: f64, lead: f64) -> f64 {
    0.05 / (lead / (PI * diameter)).sqrt()
}

pub const DRAG_RANGE: [f64; 2] = [0.1, 0.3];
