//! Our own kernels: single precision throughout, made for a core whose division takes 14 cycles, whose
//! fused multiply-add takes 3, whose constants take 2 to load, and whose double precision is software.

/// Largest angle, rad, that [`sin_cos`] reduces.
pub const LARGEST_ANGLE: f32 = 8192.0;

/// A cube root as the sum of two numbers, the first of eight bits.
struct Root {
    short: f32,
    rest: f32,
}

impl Root {
    #[inline]
    const fn value(&self) -> f32 {
        self.short + self.rest
    }

    /// `short²` is exact (16 bits) and the rest is small, so that only the last sum rounds to a half ulp.
    #[inline]
    const fn squared(&self) -> f32 {
        let Self { short, rest } = *self;
        short * short + rest * ((short + short) + rest)
    }
}

/// Cube root; see [`math::cbrt`](super::cbrt).
#[inline]
#[must_use]
pub const fn cbrt(x: f32) -> f32 {
    root(x).value()
}

/// Square of the cube root; see [`math::cbrt_squared`](super::cbrt_squared).
#[inline]
#[must_use]
pub const fn cbrt_squared(x: f32) -> f32 {
    root(x).squared()
}

/// Cube root and its square; see [`math::cbrt_and_squared`](super::cbrt_and_squared).
#[inline]
#[must_use]
pub const fn cbrt_and_squared(x: f32) -> (f32, f32) {
    let root = root(x);
    (root.value(), root.squared())
}

/// Cube root of any number.
#[inline]
const fn root(x: f32) -> Root {
    // Below 2^-120 a difference in `common_root` would be subnormal, from 2^126 on `3 x` could overflow.
    const SMALLEST: u32 = 0x0380_0000;
    const SPAN: u32 = 0x7e80_0000 - SMALLEST;
    if x.abs().to_bits().wrapping_sub(SMALLEST) < SPAN {
        common_root(x)
    } else {
        let (short, rest) = rare_root(x);
        Root { short, rest }
    }
}

/// Cube root of a number of common magnitude, either sign, without a division. With `s` for it:
///
/// 1. `t`, about `1/s`: the exponent divided by -3 in integers. `h = |x| t³` then lies between 0.45 and
///    0.56, the same for every power of eight.
/// 2. A cubic in `h` makes it `1/(sqrt(3) s)` within 2e-6. Of all seeds `t`, this one's minimax cubic has
///    the leading coefficient -1: it takes three constants, and the square of the result is the
///    derivative of Newton's method, `1/(3 s²)`.
/// 3. `near = 3 x / (3 s²)`, within 4e-6 and a rounding. Its first eight bits are `short`, so that `short³`
///    is exact in 24 bits, and exact too is `short³ - x`, the difference of two neighbours.
/// 4. Newton's step from `near` by `near³ - x = (near - short)(near² + near short + short²) + short³ - x`.
///    It leaves 3e-11; the rest of the root, `near - short` less the step, is below 2^-7 of it and so are
///    its roundings.
#[inline(always)]
const fn common_root(x: f32) -> Root {
    const SEED: u32 = 0x5477_9d9d;
    const ZERO: f32 = 1.448_389_2;
    const CENTRE: f32 = 0.351_304_5;
    const OFFSET: f32 = 0.744_889_5;

    let magnitude = x.abs();
    let t = f32::from_bits(SEED - magnitude.to_bits() / 3);
    let h = (magnitude * t) * (t * t);
    let from_centre = h - CENTRE;
    let inverse = t * ((ZERO - h) * (from_centre * from_centre + OFFSET));
    let derivative = inverse * inverse;

    let near = (3.0 * x) * derivative;
    let short = f32::from_bits(near.to_bits() & 0xffff_0000);
    let beyond = near - short;
    let short_squared = short * short;
    let excess = beyond * (near * (near + short) + short_squared) + (short_squared * short - x);
    Root {
        short,
        rest: beyond - excess * derivative,
    }
}

/// Subnormals and the two ends of the range by an exact cube of two; zeros, infinities and NaN are their
/// own roots: twice themselves, squared or not.
#[cold]
#[inline(never)]
const fn rare_root(x: f32) -> (f32, f32) {
    const TWO_TO_48: f32 = 281_474_976_710_656.0;
    const TWO_TO_16: f32 = 65_536.0;
    if x == 0.0 || !x.is_finite() {
        return (x, x);
    }
    let (before, after) = if x.abs() < 1.0 {
        (TWO_TO_48, 1.0 / TWO_TO_16)
    } else {
        (1.0 / TWO_TO_48, TWO_TO_16)
    };
    let Root { short, rest } = common_root(x * before);
    (short * after, rest * after)
}

/// Sine and cosine; see [`math::sin_cos`](super::sin_cos).
///
/// The nearest of 64 directions from a table, turned by the rest of the angle. The rest is at most pi/64: two terms of
/// each series are enough, and hardly anything of them is added to the numbers of the table, so that there is
/// little more than the rounding of these and of the last sums.
#[inline]
#[must_use]
pub const fn sin_cos(x: f32) -> (f32, f32) {
    let (steps, rest) = reduced(x);
    // Both results side by side: each operation then finds its operands ready, which saves a core without
    // reordering a cycle at every second one. No index is out of bounds.
    let step = (steps as usize) % STEPS;
    let (cos_step, sin_step) = (TURN[step], TURN[step + STEPS / 4]);
    let square = rest * rest;
    let (versine, cube) = (4.166_666_8e-2 * square, rest * square);
    let (versine, sin) = (versine - 0.5, -1.666_500_3e-1 * cube);
    let (versine, sin) = (versine * square, rest + sin);
    let (sin_versine, cos_versine) = (sin_step * versine, cos_step * versine);
    let (sin_change, cos_change) = (sin_versine + cos_step * sin, cos_versine - sin_step * sin);
    (sin_step + sin_change, cos_step + cos_change)
}

/// Directions of a turn.
const STEPS: usize = 64;

/// Cosines of the directions, backwards, which are the sines of those a quarter of a turn further on.
const TURN: [f32; STEPS + STEPS / 4] = {
    // Sines of pi/32, 2 pi/32 and so on.
    const SINES: [f32; STEPS / 4 + 1] = [
        0.0, 0.09801714, 0.19509032, 0.29028466, 0.38268343, 0.47139674, 0.55557024, 0.6343933,
        0.70710677, 0.77301043, 0.8314696, 0.8819213, 0.9238795, 0.95694035, 0.98078525, 0.9951847,
        1.0,
    ];
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
#[inline(always)]
const fn reduced(x: f32) -> (u32, f32) {
    let (count, rest) = reduced_from_near(x);
    // False for NaN too.
    if count <= 2 * LARGEST_MULTIPLE {
        (count, rest)
    } else {
        reduced_from_afar(x)
    }
}

/// Largest multiple of pi/32 that is taken away at once: four turns.
const LARGEST_MULTIPLE: u32 = 256;

/// The same for angles of no more than four turns; others give a multiple that is out of range.
///
/// pi/32 is taken away in three parts, the first two of so few bits (5 and 20) that their products and
/// differences are exact where a sine or cosine vanishes, up to the sixteenth quarter of a turn: the rest keeps full
/// relative precision there, however small it is.
#[inline(always)]
const fn reduced_from_near(x: f32) -> (u32, f32) {
    // Adding it rounds to the nearest integer, and leaves that integer in the low bits, counted from
    // -LARGEST_MULTIPLE.
    const TWO_TO_23: f32 = 8_388_608.0;
    const ROUND: f32 = TWO_TO_23 + LARGEST_MULTIPLE as f32;
    const PART_1: f32 = 9.765_625e-2;
    const PART_2: f32 = 5.185_203_6e-4;
    const PART_3: f32 = 6.200_585e-11;

    // Subtracted twice from the same constant, which is loaded once.
    let shifted = ROUND - x * (16.0 * core::f32::consts::FRAC_2_PI);
    let multiple = ROUND - shifted;
    let rest = ((x - multiple * PART_1) - multiple * PART_2) - multiple * PART_3;
    (shifted.to_bits().wrapping_sub(TWO_TO_23.to_bits()), rest)
}

/// The same for angles of more than four turns: first multiples of pi/2, in four parts of which the first one has eight
/// bits, without full relative precision next to the zeros.
#[cold]
#[inline(never)]
const fn reduced_from_afar(x: f32) -> (u32, f32) {
    const ROUND: f32 = 12_582_912.0; // 1.5 x 2^23
    const PART_1: f32 = 1.570_312_5;
    const PART_2: f32 = 4.837_512_969_970_703e-4;
    const PART_3: f32 = 7.549533620476723e-08;
    const PART_4: f32 = 2.5633440682570896e-12;

    if x.abs() <= LARGEST_ANGLE {
        let shifted = ROUND - x * core::f32::consts::FRAC_2_PI;
        let multiple = ROUND - shifted;
        let rest =
            ((x - multiple * PART_1) - multiple * PART_2) - multiple * PART_3 - multiple * PART_4;
        let (count, rest) = reduced_from_near(rest);
        let quarters = shifted.to_bits().wrapping_mul(STEPS as u32 / 4);
        (count.wrapping_add(quarters), rest)
    } else if x.is_finite() {
        (0, 0.0)
    } else {
        (0, f32::NAN)
    }
}
