//! Functions that no step calls, nor parts of them: firmware calls them by their names.

use super::parts::ANALYTIC_BALL;
use super::promise::Promise;

/// [`LiteratureCurvature::first`](crate::curvature::LiteratureCurvature::first): the catalogue formula, as accurate as it is.
pub const LITERATURE_CURVATURE: Promise = Promise {
    function: "LiteratureCurvature::first",
    domain: "31 catalogue sizes, contact angles 0 to 70 deg, both grooves",
    largest: 1.3,
    rms: 0.35,
    mean: 0.2,
    outside: "worse with steeper contact angles",
    cycles: 31,
    counted: &["curvature_literature"],
    ..GOTHIC_ARCH
};

/// [`CircularGrooveCurvature::first`](crate::curvature::CircularGrooveCurvature::first).
pub const CIRCULAR_CURVATURE: Promise = Promise {
    function: "CircularGrooveCurvature::first",
    largest: 1e-2,
    rms: 4.5e-3,
    mean: 5e-4,
    cycles: 31,
    counted: &["curvature_circular_groove"],
    ..LITERATURE_CURVATURE
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
    counted: &["curvature_fitted"],
    ..GOTHIC_ARCH
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
    counted: &["curvature_exact"],
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
    counted: &["hertz_ellipse"],
};

/// [`EfficiencyGeometry::rolling_efficiency`](crate::efficiency::EfficiencyGeometry::rolling_efficiency).
pub const ROLLING_EFFICIENCY: Promise = Promise {
    function: "EfficiencyGeometry::rolling_efficiency",
    largest: 7e-7,
    cycles: 38,
    counted: &["efficiency_rolling"],
    ..EFFICIENCY
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
    counted: &["efficiency_sliding"],
};

/// [`EfficiencyGeometry::sliding_backdrive_efficiency`](crate::efficiency::EfficiencyGeometry::sliding_backdrive_efficiency).
pub const BACKDRIVE_EFFICIENCY: Promise = Promise {
    function: "EfficiencyGeometry::sliding_backdrive_efficiency",
    outside: "negative where back-driving locks",
    cycles: 37,
    counted: &["efficiency_backdrive"],
    ..EFFICIENCY
};

/// [`EfficiencyGeometry::rolling_backdrive_efficiency`](crate::efficiency::EfficiencyGeometry::rolling_backdrive_efficiency).
/// Counted in a program that asks for the direction of power, takes this efficiency or
/// [`ROLLING_EFFICIENCY`] by it, and computes the torque that friction takes: alone it takes less.
pub const ROLLING_BACKDRIVE_EFFICIENCY: Promise = Promise {
    function: "EfficiencyGeometry::rolling_backdrive_efficiency",
    domain: "friction 0.001 to 0.3, lead angles 0.5 to 60, contact angles 5 to 85 deg, no rolling resistance",
    largest: 8e-8,
    outside: "rolling resistance and no lead: negative infinity, for no load moves the screw",
    cycles: 77,
    counted: &["step_efficiency"],
    ..ROLLING_EFFICIENCY
};

/// [`ContactKinematics::update`](crate::kinematics::ContactKinematics::update).
pub const KINEMATICS_UPDATE: Promise = Promise {
    function: "ContactKinematics::update, then tick",
    not_finite: "refused: the contacts before stay",
    tiny: "refused",
    cycles: 450,
    counted: &["kinematics_update"],
    ..KINEMATICS
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
    counted: &["kinematics_tick"],
};

/// Speed-free [`SlipRatios`](crate::kinematics::SlipRatios) of one contact.
pub const SLIP_RATIOS: Promise = Promise {
    function: "ContactCoefficients::ratios",
    error: "slide-to-roll ratio, absolute",
    largest: 2e-7,
    rms: 2e-8,
    mean: 1e-9,
    not_finite: "refused at set-up or update",
    tiny: "no slip: 0",
    cycles: 430,
    counted: &["kinematics_ratios"],
    ..KINEMATICS
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
    counted: &["friction_map"],
};

/// [`AnalyticLinearBall::speed_deviation`](crate::ball::AnalyticLinearBall::speed_deviation) of two balls and the force between them.
pub const ANALYTIC_PAIR: Promise = Promise {
    function: "AnalyticLinearBall::speed_deviation, twice, with the force",
    domain: "side-force ratios to 0.8, bottom groove turned by up to 2 deg, 100 N",
    error: "force between two balls, N, up to 6",
    largest: 0.63,
    rms: 0.27,
    mean: 0.19,
    cycles: 250,
    counted: &["linear_ball_analytic"],
    ..ANALYTIC_BALL
};

/// [`ScrewRow::at`](crate::ball::ScrewRow::at): what all balls of a row have in common under one load.
pub const SCREW_ROW: Promise = Promise {
    function: "ScrewRow::at",
    domain: "screw of Lin 2019, Table 2.1, 0.1 to 1000 N a ball, friction 0.05 to 0.12",
    error: "groove torque of a ball under the mean load, relative",
    largest: 6.5e-3,
    rms: 1.5e-3,
    mean: 4e-4,
    outside: "loads to 1e-3 N a ball as 1e-3 N",
    not_finite: "no load",
    tiny: "as 1e-3 N",
    cycles: 900,
    counted: &["ball_screw_row"],
};

/// [`ScrewLoop::ball`](crate::ball::ScrewLoop::ball): one ball in the loop; [`ScrewTick::ball`](crate::ball::ScrewTick::ball)
/// is the same in SI units.
pub const SCREW_BALL: Promise = Promise {
    function: "ScrewLoop::ball",
    error: "speed over that of the pitch circle, deviations to 3 deg",
    largest: 2e-7,
    rms: 5e-8,
    mean: 4e-8,
    outside: "deviations beyond the largest one: as that; impedance of shares 0.1 to 3: 6 %",
    not_finite: "NaN: no deviation; infinity: the largest one",
    tiny: "no deviation: the nominal speed",
    cycles: 118,
    counted: &["ball_screw_ball"],
    ..SCREW_ROW
};
