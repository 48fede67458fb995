//! Error sweeps of the scalar kernels against float64.
//!
//! In CI a prime stride and every place where something changes (powers of two, multiples of pi/2,
//! the largest and smallest numbers); all inputs with
//! `cargo test --release -p epas-reference --test all formulas::math_sweeps -- --ignored --nocapture`.

use crate::recorded;
use epas_friction::math;
use epas_reference::promises;
use epas_testkit::errors::Errors;
use epas_testkit::measured;

#[path = "../../../../src/math/libm.rs"]
mod with_libm;
#[path = "../../../../src/math/micromath.rs"]
mod with_micromath;

type ErrorAt = fn(f32) -> f64;

fn record(errors: &Errors, name: &str) {
    recorded::Sweep {
        quantity: name,
        inputs: errors.count,
        largest: errors.largest,
        rms: errors.rms(),
        mean: errors.mean(),
        command: COMMAND,
    }
    .print();
}

fn add(errors: &mut Errors, input: f32, error: f64) {
    errors.add_case(error, || format!("{input:e} ({:#010x})", input.to_bits()));
}

/// Distance of `computed` from `exact` in units of the last place of the f32 nearest to `exact`.
fn ulps(computed: f32, exact: f64) -> f64 {
    let nearest = exact as f32;
    let unit = if nearest == 0.0 {
        f64::from(f32::from_bits(1))
    } else {
        let magnitude = nearest.abs();
        f64::from(magnitude.max(f32::MIN_POSITIVE))
            .log2()
            .floor()
            .exp2()
            * f64::from(f32::EPSILON)
    };
    (f64::from(computed) - exact) / unit
}

/// Sweeps bit patterns `first..=last` with a stride on both processors, each with its own sums.
fn sweep(first: u32, last: u32, stride: usize, error: impl Fn(f32) -> f64 + Sync) -> Errors {
    let threads = std::thread::available_parallelism().map_or(2, usize::from);
    let mut total = Errors::default();
    std::thread::scope(|scope| {
        let error = &error;
        let workers: Vec<_> = (0..threads)
            .map(|thread| {
                scope.spawn(move || {
                    let mut errors = Errors::default();
                    let start = u64::from(first) + (thread * stride) as u64;
                    for bits in (start..=u64::from(last)).step_by(stride * threads) {
                        let input = f32::from_bits(bits as u32);
                        add(&mut errors, input, error(input));
                    }
                    errors
                })
            })
            .collect();
        for worker in workers {
            total.join(&worker.join().unwrap());
        }
    });
    total
}

/// Bit patterns around every power of two: where an exponent changes.
fn around_powers_of_two(error: impl Fn(f32) -> f64) -> Errors {
    let mut errors = Errors::default();
    for exponent in 0..255_u32 {
        for offset in -300_i32..=300 {
            let bits = (exponent << 23).wrapping_add_signed(offset);
            if (1..=LARGEST).contains(&bits) {
                let input = f32::from_bits(bits);
                add(&mut errors, input, error(input));
            }
        }
    }
    errors
}

const LARGEST: u32 = 0x7f7f_ffff;
const STRIDE: usize = 1009;
const COMMAND: &str = "cargo test --release -p epas-reference --test all formulas::math_sweeps -- --ignored --nocapture";

fn check_roots(stride: usize) {
    let kernels: [(&str, f64, ErrorAt); 4] = [
        // Correctly rounded: half an ulp, and a rounding of the float64 square root.
        ("sqrt", 0.500_000_1, |x| {
            ulps(math::sqrt(x), f64::from(x).sqrt())
        }),
        ("sqrt of set-up", 0.500_000_1, |x| {
            ulps(math::constant::sqrt(x), f64::from(x).sqrt())
        }),
        // Half an ulp of the last sum, 2^-7 of it from the product before, 1e-9 of the series.
        ("cbrt", 0.52, |x| ulps(math::cbrt(x), f64::from(x).cbrt())),
        ("cbrt_squared", promises::of("cbrt_squared").largest, |x| {
            ulps(math::cbrt_squared(x), f64::from(x).cbrt().powi(2))
        }),
    ];
    let [sqrt, _, cbrt, squared] = kernels.map(|(name, bound, error)| {
        let errors = sweep(1, LARGEST, stride, error);
        if stride == 1 {
            record(&errors, &format!("math::{name}, ulp"));
        }
        let corners = around_powers_of_two(error);
        assert!(errors.largest <= bound, "{name} at {}", errors.worst);
        assert!(corners.largest <= bound, "{name} at {}", corners.worst);
        // A rounding error is spread evenly over a unit in the last place: 1/sqrt(12) rms. Of two million samples the rms
        // scatters by 0.13/sqrt(2e6) = 9e-5, the mean by 0.29/sqrt(2e6) = 2e-4: three times that.
        assert!((errors.rms() - 0.288_7).abs() < 3e-4, "{name}");
        assert!(errors.mean().abs() < 6e-4, "{name} is biased");
        errors
    });
    // `cbrt_and_squared` has the bits of both, see `symmetries_hold_to_the_bit`.
    let mut both = cbrt.clone();
    both.join(&squared);
    sqrt.assert_promised(promises::of("sqrt"));
    cbrt.assert_promised(promises::of("cbrt"));
    squared.assert_promised(promises::of("cbrt_squared"));
    both.assert_promised(promises::of("cbrt_and_squared"));
}

fn check_angles(stride: usize) {
    let full_turn = std::f32::consts::TAU.to_bits();
    let largest = math::own::LARGEST_ANGLE.to_bits();
    let absolute_sin = |x: f32| f64::from(math::sin_cos(x).0) - f64::from(x).sin();
    let absolute_cos = |x: f32| f64::from(math::sin_cos(x).1) - f64::from(x).cos();
    let relative_sin = |x: f32| absolute_sin(x) / f64::from(x).sin();
    let relative_cos = |x: f32| absolute_cos(x) / f64::from(x).cos();
    let mut full = Errors::default();
    for (name, bound, bits, error) in [
        // Roundings of 2^-25 at values below one: of the table's number, and of the last sum.
        (
            "sin, absolute",
            1.2e-7,
            full_turn,
            &absolute_sin as &(dyn Fn(f32) -> f64 + Sync),
        ),
        ("cos, absolute", 1e-7, full_turn, &absolute_cos),
        // The same beside a smallest value of 0.5 in the leading octave, 2^-24 of the reduced angle.
        ("sin, relative", 2e-7, full_turn, &relative_sin),
        ("cos, relative", 2e-7, full_turn, &relative_cos),
        // The reduced angle of a large one adds the rest of pi/2 beyond its three parts.
        ("sin to 8192, absolute", 2e-7, largest, &absolute_sin),
        ("cos to 8192, absolute", 2e-7, largest, &absolute_cos),
    ] {
        let mut errors = sweep(1, bits, stride, error);
        for multiple in 1..=4 {
            let zero = (f64::from(multiple) * std::f64::consts::FRAC_PI_2) as f32;
            for offset in -2000_i32..=2000 {
                let near = zero.to_bits().wrapping_add_signed(offset);
                if near <= bits {
                    let input = f32::from_bits(near);
                    add(&mut errors, input, error(input));
                }
            }
        }
        if stride == 1 {
            record(&errors, &format!("math::sin_cos: {name}"));
        }
        assert!(errors.largest <= bound, "{name} at {}", errors.worst);
        measured::assert("sine and cosine, rms over the bound", errors.rms() / bound);
        measured::assert(
            "sine and cosine, mean over the bound",
            errors.mean() / bound,
        );
        if bits == full_turn && name.ends_with("absolute") {
            full.join(&errors);
        }
    }
    full.assert_promised(promises::of("sin_cos"));
}

#[test]
fn roots_keep_their_bounds() {
    check_roots(STRIDE);
}

#[test]
fn angles_keep_their_bounds() {
    check_angles(STRIDE);
}

#[test]
#[ignore = "all inputs: some minutes; CI takes a stride of them"]
fn roots_keep_their_bounds_over_all_inputs() {
    check_roots(1);
}

#[test]
#[ignore = "all inputs: some minutes; CI takes a stride of them"]
fn angles_keep_their_bounds_over_all_inputs() {
    check_angles(1);
}

/// Every significand, with an odd and an even exponent: the others differ by a power of four, and so do their roots. The
/// standard library's root is the processor's, correctly rounded.
#[test]
fn the_root_of_set_up_is_that_of_the_processor() {
    for x in (1.0_f32.to_bits()..4.0_f32.to_bits()).map(f32::from_bits) {
        assert_eq!(math::constant::sqrt(x).to_bits(), x.sqrt().to_bits(), "{x}");
    }
}

#[test]
fn special_values_are_as_documented() {
    for x in [0.0_f32, f32::INFINITY] {
        assert_eq!(math::cbrt(x), x);
        assert_eq!(math::cbrt(-x), -x);
        assert!(math::cbrt(-x).is_sign_negative());
        assert_eq!(math::cbrt_squared(-x), x);
        assert_eq!(math::sqrt(x), x);
    }
    for sqrt in [math::sqrt, math::constant::sqrt] {
        assert!(sqrt(-0.0) == 0.0 && sqrt(-0.0).is_sign_negative());
        assert!(sqrt(-1.0).is_nan() && sqrt(f32::NEG_INFINITY).is_nan() && sqrt(f32::NAN).is_nan());
        assert!(sqrt(f32::INFINITY) == f32::INFINITY && sqrt(0.0).to_bits() == 0);
    }
    for x in [f32::NAN, -f32::NAN] {
        assert!(math::sqrt(x).is_nan());
        assert!(math::cbrt(x).is_nan() && math::cbrt_squared(x).is_nan());
        assert!(math::sin_cos(x).0.is_nan() && math::sin_cos(x).1.is_nan());
    }
    assert!(math::sin_cos(f32::INFINITY).0.is_nan());
    assert_eq!(math::sin_cos(8193.0), (0.0, 1.0));
    assert_eq!(math::sin_cos(f32::MIN), (0.0, 1.0));
    assert_eq!(math::sin_cos(0.0), (0.0, 1.0));
    assert!(math::sin_cos(-0.0).0.is_sign_positive());
}

#[test]
fn symmetries_hold_to_the_bit() {
    for bits in (1..LARGEST).step_by(100_003) {
        let x = f32::from_bits(bits);
        assert_eq!(math::cbrt(-x), -math::cbrt(x));
        assert_eq!(math::cbrt_squared(-x), math::cbrt_squared(x));
        assert_eq!(
            math::cbrt_and_squared(x),
            (math::cbrt(x), math::cbrt_squared(x))
        );
        let (sin, cos) = math::sin_cos(x);
        if x <= math::own::LARGEST_ANGLE {
            assert_eq!(math::sin_cos(-x), (-sin, cos), "{x:e}");
        }
        assert!(sin.abs() <= 1.0 && cos.abs() <= 1.0, "{x:e}");
    }
}

/// What the documentation says of the two other backends, so that the choice rests on figures.
#[test]
fn other_backends_err_as_documented() {
    let relative = |computed: f32, exact: f64| f64::from(computed) / exact - 1.0;
    let normal = f32::MIN_POSITIVE.to_bits();
    let full_turn = std::f32::consts::TAU.to_bits();
    let cases: [(&str, f64, f64, u32, u32, ErrorAt); 5] = [
        ("libm cbrt, ulp", 0.499, 0.51, normal, LARGEST, |x| {
            ulps(with_libm::cbrt(x), f64::from(x).cbrt())
        }),
        (
            "libm sin, absolute",
            2.5e-8,
            6.5e-8,
            normal,
            full_turn,
            |x| f64::from(with_libm::sin_cos(x).0) - f64::from(x).sin(),
        ),
        (
            "micromath sin, absolute",
            9e-4,
            1.2e-3,
            normal,
            full_turn,
            |x| f64::from(with_micromath::sin_cos(x).0) - f64::from(x).sin(),
        ),
        (
            "micromath cos, absolute",
            9e-4,
            1.2e-3,
            normal,
            full_turn,
            |x| f64::from(with_micromath::sin_cos(x).1) - f64::from(x).cos(),
        ),
        (
            "micromath sqrt, relative",
            0.05,
            0.07,
            normal,
            LARGEST,
            |x| f64::from(with_micromath::sqrt(x)) / f64::from(x).sqrt() - 1.0,
        ),
    ];
    for (name, least, most, first, last, error) in cases {
        let errors = sweep(first, last, STRIDE, error);
        assert!(
            (least..=most).contains(&errors.largest),
            "{name}: {:e}",
            errors.largest
        );
    }
    let cbrt = sweep(normal, LARGEST, STRIDE, |x| {
        relative(with_micromath::cbrt(x), f64::from(x).cbrt())
    });
    assert!(
        cbrt.largest > 0.01,
        "micromath has become accurate: say so in the documentation"
    );
    let _ = with_libm::cbrt_squared(1.0) + with_micromath::cbrt_squared(1.0);
    let _ = (
        with_libm::cbrt_and_squared(1.0),
        with_micromath::cbrt_and_squared(1.0),
    );
}
