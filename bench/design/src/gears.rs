//! The gear of the project's own firmware (`bench/firmware`), folded: Lin 2019, chapter 3.6, with 100 N of preload on each flank of the nut.

use epas_friction::{BallScrew, Clearance, DISSERTATION_DESIGNS, Error, Limits, RollingResistance};

use crate::{CagedDesign, CagedFold};

/// Clearance of the preloaded gear, and that of the worn one, m.
const OVERSIZE: f32 = -4.068_737e-7;
const WORN: f32 = 2e-6;

/// Friction coefficients of the gear whose coefficient changes.
const FRICTION_RANGE: [f32; 2] = [0.05, 0.15];

/// The gear with a cage.
///
/// # Errors
/// None that is known.
pub fn lin_3_6() -> Result<CagedDesign, Error> {
    let [_, design, _] = DISSERTATION_DESIGNS;
    Ok(CagedDesign {
        design: BallScrew::new(design.parameters)?,
        friction: 0.075,
        rolling_resistance: RollingResistance::STEEL,
        clearance: Clearance::new(OVERSIZE)?,
        loaded_balls: 36,
        reversal_speed: 0.5,
        limits: Limits {
            nut_speed: 100.0,
            axial_load: 20_000.0,
            friction_torque: 20.0,
        },
    })
}

/// What the firmware has of it, each with the name of its `static`: for one friction coefficient, for a range of them, and worn, with play.
///
/// # Errors
/// None that is known.
pub fn firmware() -> Result<[(&'static str, CagedFold); 3], Error> {
    let gear = lin_3_6()?;
    let worn = CagedDesign {
        clearance: Clearance::new(WORN)?,
        ..gear
    };
    let range = CagedFold {
        friction: Some(FRICTION_RANGE),
        ..CagedFold::of(gear)
    };
    Ok([
        ("LIN_3_6", CagedFold::of(gear)),
        ("LIN_3_6_RANGE", range),
        ("LIN_3_6_WORN", CagedFold::of(worn)),
    ])
}
