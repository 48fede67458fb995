//! Ordinary mechanisms, one of every scene.

use epas_friction::{
    CATALOGUE, CagedBallScrewConfiguration, DeviationMap, FrictionBranch, GrooveFit, GrooveSize,
    Harmonic, Limits, LinearBearing, LinearBearingConfiguration, LinearBearingParameters,
    LinearLimits, LoadShare, LoadShares, Material, UncagedBallScrewConfiguration,
};

/// Balls of [`uncaged`].
pub const SCREW_BALLS: usize = 37;

/// Balls of [`linear`].
pub const LINEAR_BALLS: usize = 16;

/// Two waves of 2.3 degrees a turn, Lin 2019, Fig. 3.23.
static SCREW_MAP: DeviationMap = match DeviationMap::from_harmonics(
    1,
    &[Harmonic {
        order: 2,
        cosine: 0.0,
        sine: 0.04014,
    }],
) {
    Ok(map) => map,
    Err(_) => panic!("a deviation is too large"),
};

static NUT_MAP: DeviationMap = match DeviationMap::from_harmonics(
    1,
    &[Harmonic {
        order: 3,
        cosine: 0.01,
        sine: 0.02,
    }],
) {
    Ok(map) => map,
    Err(_) => panic!("a deviation is too large"),
};

pub const LIMITS: Limits = Limits {
    nut_speed: 500.0,
    axial_load: 20_000.0,
    friction_torque: 5.0,
};

/// 32 x 20 x 6.35, caged.
pub fn caged() -> CagedBallScrewConfiguration {
    CagedBallScrewConfiguration {
        design: CATALOGUE[15].design().unwrap(),
        friction: 0.075,
        rolling_tangent: 0.0,
        branch: FrictionBranch::Rolling,
        preload: 300.0,
        reversal_speed: 0.5,
        limits: LIMITS,
    }
}

/// 32 x 20 x 6.35 with two and a half turns of 37 balls and a return.
pub fn uncaged() -> UncagedBallScrewConfiguration {
    UncagedBallScrewConfiguration {
        design: CATALOGUE[15].design().unwrap(),
        friction: 0.075,
        ball_friction: 0.1,
        fit: GrooveFit::Zero,
        turns: 2.5,
        return_length: 0.01,
        screw_deviation: &SCREW_MAP,
        nut_deviation: &NUT_MAP,
        load_shares: LoadShares::EVEN,
        reversal_speed: 0.5,
        tick: 1e-4,
        limits: LIMITS,
    }
}

/// Balls of 10 mm, Lin 2019, Table 3.3.
pub fn linear() -> LinearBearingConfiguration {
    LinearBearingConfiguration {
        bearing: LinearBearing::new(LinearBearingParameters {
            ball_radius: 0.005,
            groove: GrooveSize::Conformity(0.56),
            contact_angle: core::f32::consts::FRAC_PI_4,
            ball_material: Material::STEEL,
            groove_material: Material::STEEL,
        })
        .unwrap(),
        friction: 0.1,
        ball_friction: 0.1,
        loaded_length: 0.12,
        return_length: 0.05,
        wavelength: 0.06,
        rail_deviation: &SCREW_MAP,
        carriage_deviation: &NUT_MAP,
        load_shares: &[LoadShare::MEAN],
        reversal_speed: 1e-3,
        tick: 1e-4,
        limits: LinearLimits {
            speed: 3.0,
            load: 20_000.0,
            friction_force: 500.0,
        },
    }
}
