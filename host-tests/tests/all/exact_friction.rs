//! Friction of one contact by quadrature of the contact integral, in f64.

use std::f64::consts::{FRAC_PI_2, PI};

/// Force, moment and power of one contact over `mu F`, `mu F a`, `mu F a |w|` at offset ratio `x`.
///
/// The integrals of Lin 2019, eqs. (3.16)-(3.18), in polar coordinates about the velocity centre: along
/// one chord, `sqrt(1 - t² - s²)` times a power of the radius integrates to a polynomial in the chord's
/// middle and half length, so that one smooth integral over the direction is left. The direction `phi`
/// is mapped by `tan phi = k tan psi`, which spreads the nodes evenly over the ellipse.
pub fn quadrature(axis_ratio: f64, x: f64, nodes: usize) -> [f64; 3] {
    // Inside, the integrand is periodic and equal weights converge exponentially; outside, the chords
    // end where the ellipse is touched, and `sin` takes the end points.
    let reach = if x.abs() <= 1.0 {
        FRAC_PI_2
    } else {
        (1.0 / x.abs()).asin()
    };
    let mut sum = [0.0; 3];
    for node in 0..nodes {
        let (psi, weight) = if x.abs() <= 1.0 {
            let step = PI / nodes as f64;
            ((node as f64 + 0.5) * step - FRAC_PI_2, step)
        } else {
            let step = PI / nodes as f64;
            let theta = (node as f64 + 0.5) * step - FRAC_PI_2;
            (reach * theta.sin(), reach * theta.cos() * step)
        };
        let (sin_psi, cos_psi) = psi.sin_cos();
        let length2 = cos_psi * cos_psi + axis_ratio * axis_ratio * sin_psi * sin_psi;
        let (cos, sin) = (
            cos_psi / length2.sqrt(),
            axis_ratio * sin_psi / length2.sqrt(),
        );
        let weight = weight * axis_ratio / length2;

        let steepness = cos * cos + (sin / axis_ratio).powi(2);
        let middle = -x * cos / steepness;
        let half2 = ((1.0 - x * x) / steepness + middle * middle).max(0.0);
        let common = weight * steepness.sqrt() * FRAC_PI_2 * half2 * 1.5 / (PI * axis_ratio);
        let second = middle * middle + 0.25 * half2;
        sum[0] -= common * middle * cos;
        sum[1] += common * (x * cos * middle + second);
        sum[2] += common * second;
    }
    sum
}
