//! Scalar kernels.

use super::promise::Promise;

/// [`math::sqrt`](crate::math::sqrt).
pub const SQRT: Promise = Promise {
    function: "math::sqrt",
    domain: "every number not below 0",
    error: "ulp",
    largest: 0.5,
    rms: 0.3,
    mean: 1e-2,
    outside: "NaN below 0",
    not_finite: "NaN, infinity as they are",
    tiny: "zeros keep their sign, subnormals are numbers",
    cycles: 30,
    counted: &["sqrt"],
};

/// [`math::cbrt`](crate::math::cbrt).
pub const CBRT: Promise = Promise {
    function: "math::cbrt",
    domain: "every number",
    error: "ulp",
    largest: 0.52,
    rms: 0.3,
    mean: 1e-2,
    outside: "there is none",
    not_finite: "NaN, infinities as they are",
    tiny: "zeros keep their sign, subnormals are numbers",
    cycles: 110,
    counted: &["cbrt"],
};

/// [`math::cbrt_squared`](crate::math::cbrt_squared).
pub const CBRT_SQUARED: Promise = Promise {
    function: "math::cbrt_squared",
    largest: 0.54,
    not_finite: "NaN; infinity",
    tiny: "zeros give 0, subnormals are numbers",
    cycles: 118,
    counted: &["cbrt_squared"],
    ..CBRT
};

/// [`math::cbrt_and_squared`](crate::math::cbrt_and_squared).
pub const CBRT_AND_SQUARED: Promise = Promise {
    function: "math::cbrt_and_squared",
    cycles: 119,
    counted: &["cbrt_and_squared"],
    ..CBRT_SQUARED
};

/// [`math::sin_cos`](crate::math::sin_cos).
pub const SIN_COS: Promise = Promise {
    function: "math::sin_cos",
    domain: "angles to 2 pi either way",
    error: "absolute",
    largest: 6.3e-8,
    rms: 3e-8,
    mean: 3e-9,
    outside: "9e-8 to 8192 rad; (0, 1) beyond",
    not_finite: "NaN",
    tiny: "the sine of either zero is +0, subnormals are numbers",
    cycles: 60,
    counted: &["sin_cos"],
};
