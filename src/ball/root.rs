//! Powers of a contact force.

/// Loads are taken at most this large, N.
const LARGEST_LOAD: f32 = 1e7;

/// `x^(-1/3)` of a positive normal number, with a relative error of 2e-7: `x` times it is `x^(2/3)`, `x`
/// times its square is `x^(1/3)`. Zero gives a finite number, so that both products are zero.
///
/// The exponent divided by -3 in integers (error 3.5 %), a step of second order on `c = x y³` (error
/// 2.4e-4), and a step of first order; without a division, at half the price of a cube root.
#[inline]
pub(super) fn inverse_cube_root(x: f32) -> f32 {
    const EXPONENT: u32 = 0x548c_2b4b;
    let start = f32::from_bits(EXPONENT - x.to_bits() / 3);
    let closeness = x * start * (start * start);
    let rough = start * (1.752_319_7 - closeness * (1.250_952_4 - 0.509_381_83 * closeness));
    let closeness = x * rough * (rough * rough);
    rough * (1.333_333_4 - 0.333_333_34 * closeness)
}

/// A load above zero as it is, up to 1e7 N; zero for one below, and for NaN.
#[inline]
pub(super) fn loaded(load: f32) -> f32 {
    // Positive numbers are in the order of their bits, everything else is larger: one comparison.
    if load.to_bits() <= LARGEST_LOAD.to_bits() {
        load
    } else if load > 0.0 {
        LARGEST_LOAD
    } else {
        0.0
    }
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
            let error = f64::from(inverse_cube_root(load)) / exact - 1.0;
            assert!(error.abs() < 3e-7, "{load}: {error:e}");
            worst = worst.max(error.abs());
            sum += error;
            count += 1.0;
            load *= 1.000_1;
        }
        std::println!(
            "inverse cube root: max {worst:.1e} mean {:+.1e}",
            sum / count
        );
        assert!((sum / count).abs() < 1e-7);
        assert_eq!(0.0 * inverse_cube_root(0.0), 0.0);
    }

    #[test]
    fn loads_that_are_none() {
        for load in [0.0, -0.0, -1.0, f32::NAN, -f32::NAN, f32::NEG_INFINITY] {
            assert_eq!(loaded(load), 0.0);
        }
        assert_eq!(loaded(f32::INFINITY), 1e7);
        assert_eq!(loaded(70.0), 70.0);
    }
}
