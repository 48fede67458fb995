extern crate std;
use super::{LoopSlipMap, Slips};

/// Steps of Simpson's rule for the integrals.
const STEPS: u16 = 400;

/// `C1` to `C5` of `contact/integrals.rs` at `lambda = root²`, by Simpson's rule.
fn integrals(k: f64, root: f64) -> [f64; 5] {
    let mut sums = [0.0; 5];
    // With `sqrt(s) = root + scale y/(1 - y)`; at infinity the integrands vanish, or are 2 over the scale.
    let scale = root + k.sqrt();
    for step in 0..STEPS {
        let y = f64::from(step) / f64::from(STEPS);
        let rest = 1.0 - y;
        let r = root + scale * y / rest;
        let (long, short) = (1.0 + r * r, k * k + r * r);
        let share = 2.0 * r * r / (long * short).sqrt() * scale / (rest * rest);
        let weight = if step == 0 {
            1.0
        } else {
            f64::from(2 + 2 * (step % 2))
        };
        for (sum, by) in
            sums.iter_mut()
                .zip([long, short, long * long, long * short, short * short])
        {
            *sum += weight * share / by;
        }
    }
    let [first, second, rest @ ..] = sums;
    let end = 2.0 / scale;
    let third = 1.0 / (3.0 * f64::from(STEPS));
    let [c1, c2] = [first + end, second + end].map(|sum| sum * third);
    let [c3, c4, c5] = rest.map(|sum| sum * third);
    [c1, c2, c3, c4, c5]
}

/// Derivatives of `P` by `z` (across) and `x` (along), its moment, and second derivatives by `z`, mixed, and by `x`.
fn exact(k: f64, across: f64, along: f64) -> [f64; 6] {
    let (x, z) = (along * along, across * across);
    let excess = 0.5 * (1.0 + k * k - x - z);
    let beyond = k * k * (x - 1.0) + z;
    let lambda = if beyond > 0.0 {
        let root = (excess * excess + beyond).sqrt();
        if excess > 0.0 {
            beyond / (excess + root)
        } else {
            root - excess
        }
    } else {
        0.0
    };
    let [c1, c2, c3, c4, c5] = integrals(k, lambda.sqrt());
    let whole = 2.0 * lambda * (lambda / ((1.0 + lambda) * (k * k + lambda))).sqrt();
    let c0 = whole + c1 + k * k * c2;
    let quartic = c3 * x * x + 2.0 * c4 * x * z + c5 * z * z;
    [
        0.75 * across * (c2 - c4 * x - c5 * z),
        0.75 * along * (c1 - c3 * x - c4 * z),
        0.1875 * (c0 - 2.0 * c1 * x - 2.0 * c2 * z + 3.0 * quartic),
        0.75 * (c2 - c4 * x - 3.0 * c5 * z),
        -1.5 * c4 * across * along,
        0.75 * (c1 - 3.0 * c3 * x - c4 * z),
    ]
}

/// Against the integrals, over axis ratios, directions and distances of the velocity centre: the interpolated near field, and
/// the multipole series, which leaves most where it begins, two semi-major axes away.
#[test]
fn as_the_integrals() {
    // Forces over their limit, and second derivatives over the sum of those by both slips: near, far.
    for (ratios, bounds) in [
        (
            [0.1, 0.11, 0.12, 0.13, 0.14],
            [[1.3e-3, 9e-4], [6.5e-4, 1.2e-2]],
        ),
        ([0.15, 0.2, 0.3, 0.5, 0.9], [[4e-4, 6e-4], [6.3e-4, 1.2e-2]]),
    ] {
        let mut worst = [[0.0_f64; 2]; 2];
        for ratio in ratios {
            let looped = LoopSlipMap::new(ratio).unwrap();
            let (semi_major, spin, stick) = (0.02_f32, 0.7_f32, 0.05_f32);
            // Of the speed of the end of the major axis, stick included.
            let rim = f64::from(spin).hypot(f64::from(stick));
            let end = f64::from(semi_major) * rim;
            for place in 0..400 {
                let distance = 1e-3 * 1e5_f64.powf(f64::from(place) / 399.0);
                for direction in 0..13 {
                    let (sin, cos) = (0.5 * f64::from(direction)).sin_cos();
                    let slips = [distance * sin, distance * cos].map(|slip| (end * slip) as f32);
                    let found = looped.at(&Slips {
                        across: slips[0],
                        along: slips[1],
                        spin,
                        stick: stick * stick,
                        size: semi_major * semi_major,
                    });
                    let [z, x] = slips.map(|slip| f64::from(slip) / end);
                    let [across, along, moment, across_across, mixed, along_along] =
                        exact(f64::from(ratio), z, x);
                    let [forces, stiffnesses] = &mut worst[usize::from(distance > 2.0)];
                    let arm = f64::from(found.moment) / f64::from(spin);
                    for (found, exact) in [
                        (f64::from(found.across), across),
                        (f64::from(found.along), along),
                        (arm * rim / f64::from(semi_major), moment),
                    ] {
                        *forces = forces.max((found - exact).abs());
                    }
                    let unit = across_across + along_along;
                    for (found, exact) in [
                        (found.across_across, across_across),
                        (found.mixed, mixed),
                        (found.along_along, along_along),
                    ] {
                        let error = (f64::from(found) * end - exact).abs() / unit;
                        *stiffnesses = stiffnesses.max(error);
                    }
                    // Numbers of the spin alone: roundings.
                    let tilt = f64::from(found.tilt) * rim * rim / f64::from(spin);
                    let stick = f64::from(found.stick) / arm * (rim / f64::from(stick)).powi(2);
                    assert!((tilt - 1.0).abs() < 1e-6 && (stick - 1.0).abs() < 1e-6);
                }
            }
        }
        std::println!("forces and second derivatives, near and far: {worst:?}");
        for (worst, bound) in worst.iter().flatten().zip(bounds.iter().flatten()) {
            assert!(worst < bound, "{worst:.1e} {bound:.1e}");
        }
    }
}
