//! The scenes that the firmware runs, each set up as its user would.

use epas_friction::{
    BallScrew, CagedBallScrewConfiguration, DISSERTATION_DESIGNS, Error, FrictionBranch, Limits,
};

pub use epas_friction::CagedBallScrew;

/// The rack-assist gear of Lin 2019, chapter 4: 29 mm pitch circle, lead 7 mm.
///
/// # Errors
/// None.
pub fn design() -> Result<BallScrew, Error> {
    BallScrew::new(DISSERTATION_DESIGNS[2].parameters)
}

/// Its caged form.
///
/// # Errors
/// None.
pub fn caged_configuration() -> Result<CagedBallScrewConfiguration, Error> {
    Ok(CagedBallScrewConfiguration {
        design: design()?,
        friction: 0.075,
        rolling_tangent: 0.0,
        branch: FrictionBranch::Rolling,
        preload: 100.0,
        reversal_speed: 0.5,
        limits: Limits {
            nut_speed: 500.0,
            axial_load: 20_000.0,
            friction_torque: 5.0,
        },
    })
}
