//! Coefficients of fits, nodes and tables as they are stored, for `host-tests/tests/generators`, which makes them again
//! and compares. Firmware has no use for them.

/// Axis ratio of a contact ellipse: `hertz`.
pub mod axis_ratio {
    /// Coefficients of the numerator, from the constant on.
    pub const NUMERATOR: [f32; 6] = crate::hertz::AXIS_RATIO_NUMERATOR;
    /// Coefficients of the denominator, from the constant on.
    pub const DENOMINATOR: [f32; 5] = crate::hertz::AXIS_RATIO_DENOMINATOR;
}

/// Inverse cube root of a load: `math::powers`.
pub mod inverse_cube_root {
    /// Bits of the seed less a third of the argument's bits.
    pub const SEED: u32 = crate::math::powers::SEED;
    /// `p0 - c (p1 - p2 c)`.
    pub const PARABOLA: [f32; 3] = crate::math::powers::PARABOLA;
}

/// Cube root: `math::own`.
pub mod cube_root {
    /// Bits of the seed less a third of the argument's bits.
    pub const SEED: u32 = crate::math::own::SEED;
    /// Real zero of the cubic.
    pub const ZERO: f32 = crate::math::own::ZERO;
    /// Place of least distance to its complex zeros.
    pub const CENTRE: f32 = crate::math::own::CENTRE;
    /// Square of that distance.
    pub const OFFSET: f32 = crate::math::own::OFFSET;
}

/// Sine and cosine: `math::own`.
pub mod sine {
    /// Coefficient of the third power in the sine.
    pub const SIN_THIRD: f32 = crate::math::own::SIN_THIRD;
    /// Coefficient of the fourth power in the cosine.
    pub const COS_FOURTH: f32 = crate::math::own::COS_FOURTH;
    /// Sines of the multiples of pi/32, 0 to 16.
    pub const SINES: [f32; 17] = crate::math::own::SINES;
    /// pi/32 in parts.
    pub const STEP_PARTS: [f32; 3] = crate::math::own::STEP_PARTS;
    /// pi/2 in parts.
    pub const QUARTER_PARTS: [f32; 4] = crate::math::own::QUARTER_PARTS;
}

/// Sagitta of the deformed surface: `kinematics`.
pub mod sagitta {
    /// `z^4` by `z`, `z^2`, `z^3`.
    pub const FOURTH_POWER: [f32; 3] = crate::kinematics::path::FOURTH_POWER;
    /// Largest semi-major axis over the ball radius.
    pub const LARGEST_ELLIPSE: f32 = crate::kinematics::path::LARGEST_ELLIPSE;
}

/// Fitted curvature of a groove: `curvature`.
pub mod curvature {
    /// Nodes of interpolation.
    pub const CHEBYSHEV: [f32; 5] = crate::curvature::fitted::CHEBYSHEV;
}

/// Preloaded springs: `ball::preload`.
pub mod preload {
    /// Coefficients of the displacement's series.
    pub const CLOSING: [f32; 3] = crate::ball::preload::CLOSING;
    /// Load over preload at which the unloaded side is lost.
    pub const LOST: f32 = crate::ball::preload::LOST;
    /// Coefficient of the fourth power in the sum of both forces.
    pub const QUARTIC: f32 = crate::ball::preload::QUARTIC;
}

/// Friction of a contact: `math::elliptic`.
pub mod elliptic {
    /// Nodes and weights of quadrature.
    pub const GAUSS: [(f32, f32); 5] = crate::math::elliptic::GAUSS;
}

/// Scenes: `scene::circuit`, and `ball::two_point` of the linear one.
pub mod scene {
    /// Sines of a deviation map's samples.
    pub const SINES: [f32; 64] = crate::scene::circuit::deviation::SINES;
    /// `2^(-4/3)`.
    pub const HALF_TO_FOUR_THIRDS: f32 = crate::ball::two_point::HALF_TO_FOUR_THIRDS;
}
