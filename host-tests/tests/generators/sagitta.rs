//! The cubic that stands for the fourth power in the sagitta of a deformed surface.

use epas_friction::kinematics::{FOURTH_POWER, LARGEST_ELLIPSE};

use crate::remez::{equioscillates, minimax, polynomial};

#[test]
fn the_fourth_power_takes_the_best_cubic_without_a_constant() {
    let end = f64::from(LARGEST_ELLIPSE).powi(2);
    // z⁴ over z: what is fitted has no constant, and the weight vanishes with z.
    let interval = (1e-3 * end, end);
    let best = minimax(|z| z.powi(3), |z| z, interval, (2, 0));
    let stored = FOURTH_POWER.map(f64::from);
    // Measured: 3.1e-7. Formed in f32 by some six operations from numbers of its own size, 6e-8 each.
    for (found, stored) in best.numerator.iter().zip(stored) {
        assert!((found / stored - 1.0).abs() < 4.0 * f64::from(f32::EPSILON));
    }
    let error = |z: f64| z * polynomial(&stored, z) - z.powi(4);
    // Derived: Chebyshev's polynomial leaves h^4/8 = 5.987e-7, h = 0.09/(1 + cos(pi/8)).
    assert!(equioscillates("fourth power", error, interval, 4, 0.01) < 6e-7);
}
