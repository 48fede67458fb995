//! Seeds of the cube roots, and the polynomials that correct them.

use epas_friction::math::own as cube_root;
use epas_friction::math::powers as inverse_cube_root;

use crate::remez::{equioscillates, minimax, polynomial};

/// Least and largest `x y³` of the seed `y` with the bits of `seed` less a third of the bits of `x`.
///
/// One power of eight is enough: the next one repeats it. Between the places where an exponent of `x` or `y` changes, which are visited, `x
/// y³` is the product of a linear function and the cube of another: a scan in steps of 2^-17 meets an extreme there to the square of that.
fn range(seed: u32) -> (f64, f64) {
    const EXPONENT: u32 = 1 << 23;
    let product = |bits: u32| {
        let seeded = f64::from(f32::from_bits(seed - bits / 3));
        f64::from(f32::from_bits(bits)) * seeded.powi(3)
    };
    let (first, last) = (1.0_f32.to_bits(), 8.0_f32.to_bits());
    let exponent_of_seed = (seed - last / 3) / EXPONENT + 1;
    let change_of_seed = 3 * (seed - exponent_of_seed * EXPONENT);
    let changes = [1, 2, 3].map(|octave| first + octave * EXPONENT);
    changes
        .into_iter()
        .chain([change_of_seed])
        .flat_map(|change| change - 4..=change + 4)
        .chain((first..=last).step_by(64))
        .filter(|bits| (first..=last).contains(bits))
        .map(product)
        .fold((f64::MAX, 0.0), |(least, most), c| {
            (c.min(least), c.max(most))
        })
}

#[test]
fn the_inverse_cube_root_takes_the_best_parabola() {
    let interval = range(inverse_cube_root::SEED);
    let exact = |c: f64| c.powf(-1.0 / 3.0);
    let best = minimax(exact, |c| 1.0 / exact(c), interval, (2, 0));
    let [p0, p1, p2] = inverse_cube_root::PARABOLA.map(f64::from);
    let stored = [p0, -p1, p2];
    // Eight digits are stored; an f32 near one holds them to 6e-8, and an end of the range that is off by 1e-7 moves the
    // coefficients, which are as large as its width's inverse squared, by 1e-6.
    for (found, stored) in best.numerator.iter().zip(stored) {
        assert!((found - stored).abs() < 1e-6, "{found} {stored}");
    }
    let error = |c| polynomial(&stored, c) / exact(c) - 1.0;
    let largest = equioscillates("inverse cube root", error, interval, 4, 0.01);
    // Measured: 2.654e-5.
    assert!(largest < 2.7e-5);
}

/// The narrower the range of `c`, the better the parabola: the error follows the third power of its width.
#[test]
fn no_seed_has_a_much_narrower_range() {
    let spread = |seed| {
        let (least, most) = range(seed);
        most / least
    };
    let stored = spread(inverse_cube_root::SEED);
    // A seed of 2^23 more or less halves or doubles `y`, and repeats the ratio.
    let best = (0..1024)
        .map(|step| spread(inverse_cube_root::SEED - (1 << 22) + step * (1 << 13)))
        .fold(f64::MAX, f64::min);
    assert!(stored < best * 1.000_2);
}

#[test]
fn the_cube_root_takes_the_best_cubic_with_the_leading_coefficient_minus_one() {
    let interval = range(cube_root::SEED);
    let exact = |h: f64| h.powf(-1.0 / 3.0) / 3.0_f64.sqrt();
    let best = minimax(exact, |h| 1.0 / exact(h), interval, (3, 0));
    // Off by as much, the leading coefficient moves the cubic by 1e-4 (0.1/2)³/4, 3e-9: a thousandth of its error.
    assert!((best.numerator[3] + 1.0).abs() < 1e-4);
    let [zero, centre, offset] =
        [cube_root::ZERO, cube_root::CENTRE, cube_root::OFFSET].map(f64::from);
    let stored = |h: f64| (zero - h) * ((h - centre) * (h - centre) + offset);
    // Half an ulp of 1.45 over 0.95, of 0.74 over 0.76, and 0.3 times that of 0.35 over 0.76: the three constants
    // may raise or lower the error by 1.1e-7, a twentieth of it, and a tenth lies between highest and lowest.
    let largest = equioscillates(
        "cube root",
        |h| stored(h) / exact(h) - 1.0,
        interval,
        5,
        0.11,
    );
    assert!(largest < best.error + 1.1e-7 && largest < 2.2e-6);
}
