//! Our own kernels in single precision, for a core whose division takes 14 cycles, and whose double precision is software.

/// Largest angle, rad, that [`sin_cos`] reduces.
pub const LARGEST_ANGLE: f32 = 8192.0;

/// A cube root as the sum of two numbers: `short` has eight bits, `remainder` is below 2^-7 of it.
struct Root {
    short: f32,
    remainder: f32,
}

impl Root {
    #[inline]
    const fn value(&self) -> f32 {
        self.short + self.remainder
    }

    /// `short² + remainder (2 short + remainder)`: the first term is exact, and only the last sum rounds to a half ulp.
    #[inline]
    const fn squared(&self) -> f32 {
        let Self { short, remainder } = *self;
        short * short + remainder * ((short + short) + remainder)
    }
}

/// Cube root; see [`math::cbrt`](super::cbrt).
#[inline]
pub const fn cbrt(x: f32) -> f32 {
    root(x).value()
}

/// Square of the cube root; see [`math::cbrt_squared`](super::cbrt_squared).
#[inline]
pub const fn cbrt_squared(x: f32) -> f32 {
    root(x).squared()
}

/// Cube root and its square; see [`math::cbrt_and_squared`](super::cbrt_and_squared).
#[inline]
pub const fn cbrt_and_squared(x: f32) -> (f32, f32) {
    let root = root(x);
    (root.value(), root.squared())
}

/// Bits of 2^-125: of a smaller number the cube in `normal_root` would be subnormal.
const SMALLEST_CUBE: u32 = 0x0100_0000;

#[inline]
const fn root(x: f32) -> Root {
    const SPAN: u32 = f32::INFINITY.to_bits() - SMALLEST_CUBE;
    if x.abs().to_bits().wrapping_sub(SMALLEST_CUBE) < SPAN {
        normal_root(x)
    } else {
        let (short, remainder) = rare_root(x);
        Root { short, remainder }
    }
}

/// Bits of the seed of [`normal_root`] less a third of the argument's bits.
#[doc(hidden)]
pub const SEED: u32 = 0x5477_9d9d;

/// Its cubic `(ZERO - h) ((h - CENTRE)² + OFFSET)`.
#[doc(hidden)]
pub const ZERO: f32 = 1.448_389_2;
#[doc(hidden)]
pub const CENTRE: f32 = 0.351_304_5;
#[doc(hidden)]
pub const OFFSET: f32 = 0.744_889_5;

/// Cube root of a number from 2^-125 on, either sign, without a division. With `s` for the root:
///
/// 1. The seed `t`, about `1/s`: the exponent divided by -3 in integers. `h = |x| t³` then lies between 0.45 and
///    0.56, in the same way for every power of eight.
/// 2. `t` times a cubic in `h` is `1/(sqrt(3) s)` within 2.2e-6; this seed makes the leading coefficient of the minimax cubic -1, and `sqrt(3)` the
///    square of the result the `1/(3 s²)` of Newton's method. Made again in `host-tests/tests/generators/cube_roots.rs`.
/// 3. `near = 3 x / (3 s²)`, within 4.4e-6 and a rounding. Its first eight bits are `short`, so that `short³`
///    is exact in 24 bits, and exact too is `short³ - x`, the difference of two neighbours.
/// 4. Newton's step from `near` by `near³ - x = (near - short)(near² + near short + short²) + short³ - x`.
///    It leaves 3e-11; the remainder, `near - short` less the step, is below 2^-7 of the root and so are its roundings.
#[inline]
const fn normal_root(x: f32) -> Root {
    // In an order that leaves few operations waiting.
    let magnitude = x.abs();
    let t = f32::from_bits(SEED - magnitude.to_bits() / 3);
    let t_squared = t * t;
    let h = (magnitude * t) * t_squared;
    let from_centre = h - CENTRE;
    let to_zero = t * (ZERO - h);
    let inverse = to_zero * (from_centre * from_centre + OFFSET);
    let third_of_near = x * inverse;
    let three = 3.0 * inverse;
    let near = third_of_near * three;
    let derivative = inverse * inverse;

    let short = f32::from_bits(near.to_bits() & 0xffff_0000);
    let beyond = near - short;
    let short_squared = short * short;
    let sum = near * (near + short);
    let cube = short_squared * short;
    let sum = sum + short_squared;
    let difference = cube - x;
    // Each product by the derivative before they are added: of small numbers they would be subnormal.
    let slope = sum * derivative;
    let step = difference * derivative;
    Root {
        short,
        remainder: beyond - (beyond * slope + step),
    }
}

/// Both parts of the root of other numbers: below 2^-125 times 2^48 and back; zeros, infinities and NaN stand for both parts.
#[cold]
#[inline(never)]
const fn rare_root(x: f32) -> (f32, f32) {
    const TWO_TO_48: f32 = 281_474_976_710_656.0;
    const ONE_BY_TWO_TO_16: f32 = 1.0 / 65_536.0;
    if x.abs().to_bits().wrapping_sub(1) < SMALLEST_CUBE {
        let Root { short, remainder } = normal_root(x * TWO_TO_48);
        (short * ONE_BY_TWO_TO_16, remainder * ONE_BY_TWO_TO_16)
    } else {
        (x, x)
    }
}

/// Sine and cosine; see [`math::sin_cos`](super::sin_cos).
///
/// The nearest of 64 directions from a table, turned by the remainder `r` of the angle, at most pi/64: `sin r = r - 0.166 650 r³`, the minimax fit
/// of relative error 8e-9, and `cos r - 1 = -r²/2 + r⁴/24`, which leaves 2e-11. Made again in `host-tests/tests/generators/sine.rs`.
#[inline]
pub const fn sin_cos(x: f32) -> (f32, f32) {
    let (steps, remainder) = reduced(x);
    // Both results operation by operation: a core without reordering waits a cycle for the result of the one before.
    let step = (steps as usize) % STEPS;
    let (cos_step, sin_step) = (TURN[step], TURN[step + STEPS / 4]);
    let square = remainder * remainder;
    let (cos_less_one, cube) = (COS_FOURTH * square, remainder * square);
    let (cos_less_one, sin) = (cos_less_one - 0.5, SIN_THIRD * cube);
    let (cos_less_one, sin) = (cos_less_one * square, remainder + sin);
    let (sin_shrink, cos_shrink) = (sin_step * cos_less_one, cos_step * cos_less_one);
    let (sin_change, cos_change) = (sin_shrink + cos_step * sin, cos_shrink - sin_step * sin);
    (sin_step + sin_change, cos_step + cos_change)
}

/// Coefficient of the third power in the sine of up to pi/64.
#[doc(hidden)]
pub const SIN_THIRD: f32 = -1.666_500_3e-1;

/// Coefficient of the fourth power in the cosine: 1/24.
#[doc(hidden)]
pub const COS_FOURTH: f32 = 4.166_666_8e-2;

const STEPS: usize = 64;

/// Sines of 0, pi/32, 2 pi/32 and so on to pi/2.
#[doc(hidden)]
pub const SINES: [f32; STEPS / 4 + 1] = [
    0.0, 0.09801714, 0.19509032, 0.29028466, 0.38268343, 0.47139674, 0.55557024, 0.6343933,
    0.70710677, 0.77301043, 0.8314696, 0.8819213, 0.9238795, 0.95694035, 0.98078525, 0.9951847,
    1.0,
];

/// Cosines of 0, pi/32, 2 pi/32 and so on, through a turn and a quarter. Of the multiple `n` of pi/32 in an angle, [`reduced`] returns `-n` modulo 64:
/// at that index stands its cosine, 16 further on, `cos(pi/2 - n pi/32)`, its sine.
const TURN: [f32; STEPS + STEPS / 4] = {
    const QUARTER: usize = STEPS / 4;
    let mut turn = [0.0; STEPS + QUARTER];
    let mut index = 0;
    while index < turn.len() {
        let step = index % QUARTER;
        turn[index] = match index / QUARTER % 4 {
            0 => SINES[QUARTER - step],
            1 => 0.0 - SINES[step],
            2 => 0.0 - SINES[QUARTER - step],
            _ => SINES[step],
        };
        index += 1;
    }
    turn
};

/// The nearest multiple of pi/32 (the last six bits of its negative) and what it leaves of an angle.
#[inline]
const fn reduced(x: f32) -> (u32, f32) {
    let (count, remainder) = reduced_from_near(x);
    // False for NaN too.
    if count <= 2 * LARGEST_MULTIPLE {
        (count, remainder)
    } else {
        reduced_from_afar(x)
    }
}

/// Largest multiple of pi/32 that is taken away at once: four turns.
const LARGEST_MULTIPLE: u32 = 256;

/// pi/32 as a sum, of which the first two parts have 5 and 20 bits.
#[doc(hidden)]
pub const STEP_PARTS: [f32; 3] = [9.765_625e-2, 5.185_203_6e-4, 6.200_585e-11];

/// pi/2 as a sum, of which the first part has 8 bits.
#[doc(hidden)]
pub const QUARTER_PARTS: [f32; 4] = [
    1.570_312_5,
    4.837_512_969_970_703e-4,
    7.549533620476723e-08,
    2.5633440682570896e-12,
];

/// [`reduced`] for angles of no more than four turns; others give a multiple that is out of range. pi/32 is taken away in three parts, the first two of
/// so few bits (5 and 20) that their products and differences are exact where a sine or cosine vanishes: the remainder keeps full relative precision.
#[inline]
const fn reduced_from_near(x: f32) -> (u32, f32) {
    // Adding it rounds to the nearest integer in the low bits, counted from -LARGEST_MULTIPLE.
    const TWO_TO_23: f32 = 8_388_608.0;
    const ROUND: f32 = TWO_TO_23 + LARGEST_MULTIPLE as f32;
    let [part_1, part_2, part_3] = STEP_PARTS;

    let shifted = ROUND - x * (16.0 * core::f32::consts::FRAC_2_PI);
    let multiple = ROUND - shifted;
    let remainder = ((x - multiple * part_1) - multiple * part_2) - multiple * part_3;
    (
        shifted.to_bits().wrapping_sub(TWO_TO_23.to_bits()),
        remainder,
    )
}

/// [`reduced`] for angles of more than four turns: first multiples of pi/2, without full relative precision next to the zeros.
#[cold]
#[inline(never)]
const fn reduced_from_afar(x: f32) -> (u32, f32) {
    const ROUND: f32 = 12_582_912.0; // 1.5 x 2^23
    let [part_1, part_2, part_3, part_4] = QUARTER_PARTS;

    if x.abs() <= LARGEST_ANGLE {
        let shifted = ROUND - x * core::f32::consts::FRAC_2_PI;
        let multiple = ROUND - shifted;
        let remainder =
            ((x - multiple * part_1) - multiple * part_2) - multiple * part_3 - multiple * part_4;
        let (count, remainder) = reduced_from_near(remainder);
        let quarters = shifted.to_bits().wrapping_mul(STEPS as u32 / 4);
        (count.wrapping_add(quarters), remainder)
    } else if x.is_finite() {
        (0, 0.0)
    } else {
        (0, f32::NAN)
    }
}
