//! Dahl's bristle, which is LuGre's too, and Stribeck's curve, which LuGre's bristle follows: for comparison, calibration and report.

/// Friction of a bristle after a turn that pulls by `pull`, the stiffness times the turn, under a limit, all in one unit: Dahl's law with the
/// exponent 1, by the implicit step `T <- (T + pull) / (1 + |pull| / L)`, which is stable for any turn.
pub fn bristle(friction: f64, pull: f64, limit: f64) -> f64 {
    (friction + pull) / (1.0 + pull.abs() / limit)
}

/// Stribeck's curve: friction of sliding at a speed, `in_motion + (at_rest - in_motion) exp(-(v/v_s)^2)` with Stribeck's speed `v_s`, in the
/// unit of both frictions.
pub fn stribeck(speed: f64, [at_rest, in_motion]: [f64; 2], stribeck_speed: f64) -> f64 {
    in_motion + (at_rest - in_motion) * (-(speed / stribeck_speed).powi(2)).exp()
}
