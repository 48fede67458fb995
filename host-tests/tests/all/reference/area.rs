//! The friction integrals (3.16) to (3.18) over the area of the contact ellipse, without any reduction: the check of
//! the friction maps and the reduction to one integral.

use std::f64::consts::FRAC_PI_2;
use std::num::NonZeroUsize;

use gauss_quad::GaussLegendre;

use epas_reference::friction::patch::{Patch, PatchVelocity};

const NODES: usize = 12;
/// Panels halve towards the velocity centre down to 2^-24 of the ellipse.
const LEVELS: i32 = 24;

/// Power and its gradient by `(slip_major, slip_minor, spin)` by a two-dimensional Gauss rule over the ellipse.
///
/// With `x = a sin p cos q` and `y = b sin q` the half-ellipsoid of pressure is smooth up to the rim. The direction of slip jumps at the
/// velocity centre, so the panels are halved towards it in both directions, which makes the rule converge to about 1e-12 of the friction
/// limit for a centre in any place, on the rim too. Takes some ten million evaluations: for tests, not for solvers.
///
/// Returns `(power, gradient)` in the units of [`Patch`].
///
/// Source: Lin 2019, eqs. (3.15) to (3.18).
pub fn friction_over_area(patch: &Patch, velocity: PatchVelocity) -> (f64, [f64; 3]) {
    let [v1, v2, w] = velocity.to_array();
    let (a, b) = (patch.semi_major, patch.semi_minor);
    let rule = GaussLegendre::new(NonZeroUsize::new(NODES).unwrap_or(NonZeroUsize::MIN));
    let centre = |slip: f64, axis: f64| if w == 0.0 { 2.0 } else { slip / (w * axis) };
    let (centre_x, centre_y) = (-centre(v2, a), centre(v1, b));
    let pressure = 3.0 / (2.0 * std::f64::consts::PI) * patch.friction_limit;
    let mut power = 0.0;
    let mut gradient = [0.0; 3];
    // Where the chord's end passes the velocity centre, the integral over the chord bends sharply.
    let bend = centre_x.abs().min(1.0).acos();
    for (q_low, q_high) in panels(&[-bend, centre_y.clamp(-1.0, 1.0).asin(), bend]) {
        for &(q_node, q_weight) in rule.as_node_weight_pairs() {
            let (sin_q, cos_q) = at(q_low, q_high, q_node).sin_cos();
            let p_centre = (centre_x / cos_q).clamp(-1.0, 1.0).asin();
            for (p_low, p_high) in panels(&[p_centre]) {
                for &(p_node, p_weight) in rule.as_node_weight_pairs() {
                    let (sin_p, cos_p) = at(p_low, p_high, p_node).sin_cos();
                    let (x, y) = (a * sin_p * cos_q, b * sin_q);
                    let measure = cos_q * cos_p * (cos_q * cos_p) * cos_q;
                    let weight = 0.25 * (q_high - q_low) * (p_high - p_low) * q_weight * p_weight;
                    let load = pressure * weight * measure;
                    let slip = [v1 - w * y, v2 + w * x];
                    let speed = slip[0].hypot(slip[1]);
                    if speed > 0.0 {
                        power += load * speed;
                        gradient[0] += load * slip[0] / speed;
                        gradient[1] += load * slip[1] / speed;
                        gradient[2] += load * (x * slip[1] - y * slip[0]) / speed;
                    }
                }
            }
        }
    }
    (power, gradient)
}

fn at(low: f64, high: f64, node: f64) -> f64 {
    0.5 * (low + high + (high - low) * node)
}

/// Splits -pi/2 to pi/2 at `points`, with panels that halve towards each of them from both sides.
fn panels(points: &[f64]) -> Vec<(f64, f64)> {
    let mut knots = points.to_vec();
    knots.sort_by(f64::total_cmp);
    let mut edges = vec![-FRAC_PI_2];
    let mut last = None;
    for &knot in &knots {
        let from = edges.last().copied().unwrap_or(-FRAC_PI_2);
        if knot <= from {
            last = Some(from);
            continue;
        }
        // Between two points the panels are largest in the middle; before the first one, at the end.
        if last.is_some() {
            let middle = 0.5 * (from + knot);
            edges.extend(
                (1..=LEVELS)
                    .rev()
                    .map(|level| from + (middle - from) * 0.5_f64.powi(level)),
            );
            edges.push(middle);
        }
        let start = edges.last().copied().unwrap_or(from);
        edges.extend((1..=LEVELS).map(|level| knot - (knot - start) * 0.5_f64.powi(level)));
        edges.push(knot);
        last = Some(knot);
    }
    let from = edges.last().copied().unwrap_or(-FRAC_PI_2);
    edges.extend(
        (1..=LEVELS)
            .rev()
            .map(|level| from + (FRAC_PI_2 - from) * 0.5_f64.powi(level)),
    );
    edges.push(FRAC_PI_2);
    edges
        .iter()
        .zip(edges.iter().skip(1))
        .filter(|(low, high)| high > low)
        .map(|(&low, &high)| (low, high))
        .collect()
}
