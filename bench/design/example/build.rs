//! Folds the screw of this firmware into `gear.rs`.

use epas_design::{CagedDesign, CagedFold, Failure};
use epas_friction::geometry::STEERING_SIZES;
use epas_friction::{BallScrew, Limits, defaults};

fn gear() -> Result<CagedDesign, epas_friction::Error> {
    Ok(CagedDesign {
        design: BallScrew::new(STEERING_SIZES[0].parameters())?,
        friction: 0.1,
        rolling_resistance: defaults::ROLLING_RESISTANCE,
        clearance: defaults::CLEARANCE,
        loaded_balls: 40,
        reversal_speed: 2.0,
        limits: Limits {
            nut_speed: 200.0,
            axial_load: 20e3,
            friction_torque: 20.0,
        },
    })
}

fn main() -> Result<(), Failure> {
    CagedFold::of(gear()?)
        .folded()?
        .write_rust("GEAR", std::env::var("OUT_DIR").unwrap())
}
