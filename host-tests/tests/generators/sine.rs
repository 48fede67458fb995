//! Sine and cosine: the fit, the table, and the parts of the steps that are taken away from an angle.

use std::f64::consts::{FRAC_PI_2, PI};

use epas_friction::math::own::{COS_FOURTH, QUARTER_PARTS, SIN_THIRD, SINES, STEP_PARTS};

use crate::remez::{equioscillates, minimax};

/// Largest angle that the table leaves.
const END: f64 = PI / 64.0;

#[test]
fn the_sine_takes_the_best_cubic() {
    // sin r - (r + c r³) over sin r. Below 1e-3 the quotient of the small difference by r³ has lost its digits.
    let exact = |r: f64| (r.sin() - r) / r.powi(3);
    let interval = (1e-3, END);
    let best = minimax(exact, |r| r.powi(3) / r.sin(), interval, (0, 0));
    // An f32 of a sixth is within 7.5e-9 of what it stands for.
    assert!((best.numerator[0] - f64::from(SIN_THIRD)).abs() < 8e-9);
    let stored = |r: f64| (r + f64::from(SIN_THIRD) * r.powi(3)) / r.sin() - 1.0;
    // Measured: 8.31e-9.
    assert!(equioscillates("sine", stored, interval, 2, 0.01) < 8.4e-9);
}

#[test]
fn the_cosine_takes_taylors_series() {
    assert_eq!(COS_FOURTH, (1.0_f64 / 24.0) as f32);
    // Derived: the next term and what follows it, and half an ulp of 1/24 in f32, 1.9e-9.
    let stored = 1.0 - END * END / 2.0 + f64::from(COS_FOURTH) * END.powi(4);
    let left = (stored - END.cos()).abs();
    assert!(left < 1.1 * END.powi(6) / 720.0 + END.powi(4) * 2e-9);
}

#[test]
fn the_table_holds_rounded_sines() {
    for (step, &sine) in SINES.iter().enumerate() {
        assert_eq!(sine, (PI * step as f64 / 32.0).sin() as f32);
    }
}

/// The parts add up to the step as far as f32 goes beyond its last part, and the first ones have so few bits that their
/// products with a multiple are exact: 24 bits less those of the part are left for it.
#[test]
fn steps_are_taken_away_in_parts() {
    let significant = |part: f32| 24 - (part.to_bits() & 0x7f_ffff | 0x80_0000).trailing_zeros();
    let left = |whole: f64, parts: &[f32]| {
        let sum: f64 = parts.iter().map(|part| f64::from(*part)).sum();
        (sum - whole).abs()
    };
    let [first, second, third] = STEP_PARTS;
    assert_eq!([first, second].map(significant), [5, 20]);
    // Half an ulp of the last part.
    assert!(left(PI / 32.0, &STEP_PARTS) <= f64::from(third) * 2.0_f64.powi(-24));
    let [first, .., last] = QUARTER_PARTS;
    assert_eq!(significant(first), 8);
    assert!(left(FRAC_PI_2, &QUARTER_PARTS) <= f64::from(last) * 2.0_f64.powi(-24));
    // Each part is the next one's remainder, rounded or cut. Measured: 3.1e-4.
    for (count, &part) in QUARTER_PARTS.iter().enumerate() {
        let rest = left(FRAC_PI_2, &QUARTER_PARTS[..count]);
        assert!((rest / f64::from(part) - 1.0).abs() < 1e-3);
    }
}
