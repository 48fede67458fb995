//! What the functions of the loop promise, in one table: for the tests that hold them to it, for the
//! report, and for this page.
//!
//! Errors are against the exact model in f64, ceilings over the whole domain; cycles are modelled ones of
//! a Cortex-M4F with the own scalar kernels, ceilings as well. Constants that nobody reads take no place in
//! a firmware's image.
#![doc = include_str!("promises.md")]

/// What one function promises.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Promise {
    /// The function.
    pub function: &'static str,
    /// Inputs for which the errors hold.
    pub domain: &'static str,
    /// What the error is of, and in which unit.
    pub error: &'static str,
    /// Largest error.
    pub largest: f64,
    /// Root mean square error.
    pub rms: f64,
    /// Mean error, of either sign: the bias.
    pub mean: f64,
    /// Behaviour outside the domain.
    pub outside: &'static str,
    /// Behaviour for NaN and infinities.
    pub not_finite: &'static str,
    /// Behaviour for zeros of either sign and subnormal numbers.
    pub tiny: &'static str,
    /// Most cycles; 0 where it belongs to set-up.
    pub cycles: u32,
}

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
};

/// [`math::cbrt_squared`](crate::math::cbrt_squared).
pub const CBRT_SQUARED: Promise = Promise {
    function: "math::cbrt_squared",
    largest: 0.54,
    not_finite: "NaN; infinity",
    tiny: "zeros give 0, subnormals are numbers",
    ..CBRT
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
};

/// [`GothicArch::principal`](crate::curvature::GothicArch::principal).
pub const GOTHIC_ARCH: Promise = Promise {
    function: "GothicArch::principal",
    domain: "31 catalogue sizes, contact angles 0 to 80 deg, both grooves",
    error: "first curvature, relative",
    largest: 6e-7,
    rms: 1.2e-7,
    mean: 1e-8,
    outside: "1e-7 of the second curvature where the nut's first one vanishes (89 deg); folded grooves are \
              refused",
    not_finite: "refused at set-up",
    tiny: "no lead: the bearing's formula to the last digits",
    cycles: 140,
};

/// [`FittedCurvature::first`](crate::curvature::FittedCurvature::first).
pub const FITTED_CURVATURE: Promise = Promise {
    function: "FittedCurvature::first",
    domain: "31 catalogue sizes, contact angles 0 to 72 deg, both grooves",
    largest: 8e-7,
    rms: 2e-7,
    mean: 6e-8,
    outside: "extrapolates smoothly; refit for steeper contact angles",
    cycles: 45,
    ..GOTHIC_ARCH
};

/// [`HertzContact::at`](crate::hertz::HertzContact::at) with its constants.
pub const HERTZ: Promise = Promise {
    function: "HertzContact::at",
    domain: "ratios of the relative radii 1 to 1e5, loads 1e-3 to 1e6 N",
    error: "semi-axes, deflection and pressure, relative",
    largest: 1e-5,
    rms: 4e-6,
    mean: 1e-6,
    outside: "radii: refused; loads up to 0: no ellipse",
    not_finite: "NaN: no ellipse; infinity counts as the largest number",
    tiny: "zero: no ellipse, subnormals are loads",
    cycles: 110,
};

/// [`EfficiencyGeometry::sliding_efficiency`](crate::efficiency::EfficiencyGeometry::sliding_efficiency).
pub const EFFICIENCY: Promise = Promise {
    function: "EfficiencyGeometry::sliding_efficiency",
    domain: "friction 0.001 to 0.3, lead angles 0.5 to 60, contact angles 5 to 85 deg, before the lock",
    error: "absolute",
    largest: 3e-7,
    rms: 3e-8,
    mean: 5e-9,
    outside: "negative where the drive locks: `locks` says so before any division",
    not_finite: "refused at set-up",
    tiny: "no friction: 1",
    cycles: 40,
};

/// [`FrictionMap::evaluate`](crate::contact::FrictionMap::evaluate).
pub const FRICTION_MAP: Promise = Promise {
    function: "FrictionMap::evaluate",
    domain: "axis ratios 0.05 to 1, every offset",
    error: "force over mu F",
    largest: 8.2e-4,
    rms: 1.4e-4,
    mean: 1e-5,
    outside: "axis ratios down to 0.01: 3e-3; below refused",
    not_finite: "infinities: pure sliding; NaN counts as a large offset",
    tiny: "odd in the offset, also for zeros",
    cycles: 50,
};

/// [`ContactKinematics::tick`](crate::kinematics::ContactKinematics::tick).
pub const KINEMATICS: Promise = Promise {
    function: "ContactKinematics::tick",
    domain: "helix angles to 40 deg, grips from 0.25",
    error: "rolling slip over the entrainment speed",
    largest: 2.2e-7,
    rms: 4e-8,
    mean: 1e-8,
    outside: "refused at set-up or update",
    not_finite: "a speed that is none, or beyond 1e6 rad/s: all 0",
    tiny: "proportional to the speed",
    cycles: 60,
};

/// [`AnalyticLinearBall::speed_deviation`](crate::ball::AnalyticLinearBall::speed_deviation).
pub const ANALYTIC_BALL: Promise = Promise {
    function: "AnalyticLinearBall::speed_deviation",
    domain: "side-force ratios to 0.8, contact angles within 3 deg of each other",
    error: "speed deviation over v/2",
    largest: 1.5e-2,
    rms: 2e-3,
    mean: 1e-3,
    outside: "beyond a ratio of 0.85 it misses two-point rolling",
    not_finite: "angles: deviation 0; forces: no load",
    tiny: "no load: the compliance of 3e-14 N",
    cycles: 125,
};

/// [`FourPointBall::step`](crate::refined::FourPointBall::step), two of them from the start.
pub const FOUR_POINT_BALL: Promise = Promise {
    function: "FourPointBall::step, twice",
    largest: 3.3e-4,
    rms: 2.2e-5,
    mean: 1e-5,
    outside: "follows the change to two-point rolling within some ticks",
    not_finite: "angles: nominal; forces: lost contact; a spoilt state: nominal rolling",
    tiny: "a contact without load is lost",
    cycles: 3000,
    ..ANALYTIC_BALL
};

/// [`Press::solve`](crate::train::Press::solve).
pub const PRESS: Promise = Promise {
    function: "Press::solve",
    domain: "2 to 64 balls, impedances that differ by up to 1e6; cycles for 37 balls",
    error: "force over the largest force",
    largest: 2e-6,
    rms: 4e-7,
    mean: 1e-7,
    outside: "1e-5 for impedances up to 1e12; free speeds beyond 1 or impedances beyond 1e-9 to 1e9: no forces, and it says so",
    not_finite: "free speeds and impedances as outside; rooms that are NaN: no contact",
    tiny: "rooms up to 0: contact",
    cycles: 7500,
};

/// Every promise, in the order of the crate's modules.
pub const ALL: [Promise; 13] = [
    SQRT,
    CBRT,
    CBRT_SQUARED,
    SIN_COS,
    GOTHIC_ARCH,
    FITTED_CURVATURE,
    HERTZ,
    EFFICIENCY,
    KINEMATICS,
    FRICTION_MAP,
    ANALYTIC_BALL,
    FOUR_POINT_BALL,
    PRESS,
];

/// Ticks within which a scene flags what is wrong with its inputs.
pub const TICKS_TO_FLAG: u32 = 1;

/// Ticks after a failure until outputs are unflagged and right for the state. A train keeps where its balls
/// and the deviations' phase are, and goes on from there: behind by the travel of the missed ticks, until
/// `set_nut_angle` or `set_carriage_position` brings the phase back, or `reset` everything.
pub const TICKS_TO_RECOVER: u32 = 1;
