//! Powers of a contact force, to five digits.

/// Bits of the seed of [`inverse_cube_roots`] less a third of the argument's bits.
#[doc(hidden)]
pub const SEED: u32 = 0x548d_0ddb;

/// The seed's correction `p0 - c (p1 - p2 c)`, a parabola in `c = x y³`.
#[doc(hidden)]
pub const PARABOLA: [f32; 3] = [1.743_091_7, 1.224_815, 0.490_906_86];

/// `x^(-1/3)` of two positive normal numbers, with a relative error of 2.7e-5: `x` times it is
/// `x^(2/3)`, `x` times its square is `x^(1/3)`. Zero gives a finite number, so that both are zero.
///
/// The exponent divided by -3 in integers gives a seed `y`; `c = x y³` then lies between 0.653 and 0.774 for every `x`, and the minimax parabola of
/// `c^(-1/3)` does the rest (`host-tests/tests/generators/cube_roots.rs`). A third of the price of a cube root, and no division. Two at once, operation
/// by operation: a core without reordering waits a cycle for the result of the one before.
#[inline]
pub(crate) const fn inverse_cube_roots(x: [f32; 2]) -> [f32; 2] {
    let [p0, p1, p2] = PARABOLA;
    let [p, q] = x;
    // Wraps only for numbers that have no meaning here.
    let y = f32::from_bits(SEED.wrapping_sub(p.to_bits() / 3));
    let z = f32::from_bits(SEED.wrapping_sub(q.to_bits() / 3));
    let (c, d) = (p * y, q * z);
    let (e, f) = (y * y, z * z);
    let (c, d) = (c * e, d * f);
    let (e, f) = (p2 * c, p2 * d);
    let (e, f) = (p1 - e, p1 - f);
    let (e, f) = (c * e, d * f);
    let (e, f) = (p0 - e, p0 - f);
    [y * e, z * f]
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;

    #[test]
    fn powers_of_loads() {
        let (mut worst, mut sum, mut count) = (0.0_f64, 0.0, 0.0);
        let mut load = 1e-6_f32;
        while load < 1e7 {
            let exact = f64::from(load).powf(-1.0 / 3.0);
            let error = f64::from(inverse_cube_roots([load, 1.0])[0]) / exact - 1.0;
            assert!(error.abs() < 2.75e-5, "{load}: {error:e}");
            worst = worst.max(error.abs());
            sum += error;
            count += 1.0;
            load *= 1.000_1;
        }
        std::println!(
            "inverse cube root: max {worst:.1e} mean {:+.1e}",
            sum / count
        );
        assert!((sum / count).abs() < 5e-6);
        assert_eq!(0.0 * inverse_cube_roots([0.0, 1.0])[0], 0.0);
    }

    #[test]
    fn numbers_of_no_meaning_do_not_panic() {
        let [_, two] = inverse_cube_roots([1.0, 2.0]);
        for x in [
            -1.0,
            -2.9e37,
            f32::MIN,
            f32::NEG_INFINITY,
            f32::NAN,
            -f32::NAN,
        ] {
            assert_eq!(inverse_cube_roots([x, 2.0])[1], two);
            assert_eq!(inverse_cube_roots([2.0, x])[0], two);
        }
    }
}
