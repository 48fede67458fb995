//! The gears of the project's own firmware (`bench/firmware`), folded: the geometry of the published designs `lin-3.6` and `lin-4.1` with numbers of
//! their own, and so names of their own. Beside them the gears on which folding is tested.

use epas_friction::{
    BallScrew, BallScrewParameters, Clearance, DISSERTATION_DESIGNS, Error, Limits,
    RollingResistance, defaults,
};

use crate::{CagedDesign, CagedFold, UncagedDesign, UncagedFold};

/// Clearance of the preloaded gear, and that of the worn one, m.
const OVERSIZE: f32 = -4.068_737e-7;
const WORN: f32 = 2e-6;

/// Friction coefficients of a gear whose coefficient changes.
const FRICTION_RANGE: [f32; 2] = [0.05, 0.15];

/// The gear of the scenes: geometry of Lin 2019, Table 3.6, with 100 N of preload on each flank of the nut.
pub fn gear_33x20() -> Result<CagedDesign, Error> {
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

/// The gear of the friction task: geometry of Lin 2019, Table 4.1, a rack-assist screw, 29 mm pitch circle, lead 7 mm.
pub fn gear_29x7() -> Result<CagedDesign, Error> {
    let [_, _, design] = DISSERTATION_DESIGNS;
    Ok(CagedDesign {
        design: BallScrew::new(design.parameters)?,
        friction: 0.12,
        rolling_resistance: defaults::ROLLING_RESISTANCE,
        clearance: defaults::CLEARANCE,
        loaded_balls: design.loaded_balls,
        // Without a meaning where friction remembers.
        reversal_speed: 0.2,
        limits: Limits {
            nut_speed: 500.0,
            axial_load: 20_000.0,
            friction_torque: 5.0,
        },
    })
}

/// What the firmware has of them, each with the name of its `static`: that of the scenes for one friction coefficient, for a range of them,
/// and worn, with play; that of the friction task for a range.
pub fn firmware() -> Result<[(&'static str, CagedFold); 4], Error> {
    let gear = gear_33x20()?;
    let worn = CagedDesign {
        clearance: Clearance::new(WORN)?,
        ..gear
    };
    let range = |gear| CagedFold {
        friction: Some(FRICTION_RANGE),
        ..CagedFold::of(gear)
    };
    Ok([
        ("GEAR_33X20", CagedFold::of(gear)),
        ("GEAR_33X20_RANGE", range(gear)),
        ("GEAR_33X20_WORN", CagedFold::of(worn)),
        ("GEAR_29X7_RANGE", range(gear_29x7()?)),
    ])
}

/// Largest deviations of the contact angles of the gear without cage, rad: those of the firmware's maps, rounded up.
const DEVIATIONS: [f32; 2] = [0.01745, 0.00873];

/// What the firmware has without cage, each with the name of its `static`: the gear of the scenes for one friction coefficient, and for a range.
pub fn firmware_uncaged() -> Result<[(&'static str, UncagedFold); 2], Error> {
    let one = UncagedFold::of(UncagedDesign {
        gear: gear_33x20()?,
        deviations: DEVIATIONS,
    });
    let range = UncagedFold {
        friction: Some(FRICTION_RANGE),
        ..one
    };
    Ok([("GEAR_33X20_BALL", one), ("GEAR_33X20_BALL_RANGE", range)])
}

/// Clearances, m, of the gears on which folding is tested: from 5 um of oversize to 20 um of play.
pub const TESTED_CLEARANCES: [f32; 7] = [-5e-6, -1e-6, 0.0, 2e-6, 5e-6, 10e-6, 20e-6];

/// Friction coefficients of the gears on which folding is tested.
pub const TESTED_FRICTIONS: [f32; 3] = [0.05, 0.1, 0.15];

/// A gear on which folding is tested: a screw of any size with 37 loaded balls, a clearance, m, and a friction coefficient.
pub fn tested(
    parameters: BallScrewParameters,
    clearance: f32,
    friction: f32,
) -> Result<CagedFold, Error> {
    let design = BallScrew::new(parameters)?;
    Ok(CagedFold::of(CagedDesign {
        design,
        friction,
        rolling_resistance: defaults::ROLLING_RESISTANCE,
        clearance: Clearance::new(clearance)?.checked(&design)?,
        loaded_balls: 37,
        reversal_speed: 0.5,
        limits: Limits {
            nut_speed: 1e3,
            axial_load: 1e5,
            friction_torque: 100.0,
        },
    }))
}
